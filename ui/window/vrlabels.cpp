// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrlabels.h"

#include "ui/theme/theme.h"
#include "ui/vr/handlabels.h"

#include <QtGui/QPainter>

namespace ps {

VrLabels::VrLabels() {
  setTextFormat(Qt::RichText);
  setMargin(8);
}

void VrLabels::setProfile(std::string_view profile, size_t hand, const vr::HandRoles& roles) {
  if (profile == m_profile && roles == m_roles) return;
  m_profile = profile;
  m_roles = roles;
  QString rows;
  for (const auto& [part, does] : vr::labelsOf(profile, hand, roles))
    rows += QStringLiteral("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
                .arg(QString::fromStdString(part).toHtmlEscaped(), QString::fromStdString(does).toHtmlEscaped());
  setText(rows.isEmpty() ? rows : QStringLiteral("<table cellspacing='2'>%1</table>").arg(rows));
  setFixedSize(sizeHint());
}

void VrLabels::paintEvent(QPaintEvent* event) {
  QPainter(this).fillRect(rect(), Theme::current()[Token::Panel]);
  QLabel::paintEvent(event);
}

}  // namespace ps
