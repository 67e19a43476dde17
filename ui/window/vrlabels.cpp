// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrlabels.h"

#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"
#include "ui/vr/handlabels.h"

#include <QtGui/QPainter>

#include <algorithm>

namespace ps {

VrLabels::VrLabels() {
  setTextFormat(Qt::RichText);
  setMargin(8);
}

QString scaleText(double scale) {
  const double ratio = std::max(scale, 1 / scale);
  const QString number = formatFixed(ratio, ratio < 9.95 ? 1 : 0), one = QStringLiteral("1");
  if (number == formatFixed(1, 1)) return QStringLiteral("1 : 1");
  return QStringLiteral("%1 : %2").arg(scale < 1 ? one : number, scale < 1 ? number : one);
}

void VrLabels::setProfile(std::string_view profile, size_t hand, const vr::HandRoles& roles) {
  if (profile == m_profile && roles == m_roles) return;
  m_profile = profile;
  m_hand = hand;
  m_roles = roles;
  showRows();
}

void VrLabels::setScale(double scale) {
  const QString text = scale > 0 ? scaleText(scale) : QString();
  if (text == m_scale) return;
  m_scale = text;
  showRows();
}

void VrLabels::showRows() {
  const auto row = [](const QString& part, const QString& does) {
    return QStringLiteral("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
        .arg(part.toHtmlEscaped(), does.toHtmlEscaped());
  };
  QString rows;
  if (showsScale()) {
    rows = row(QStringLiteral("Scene"), m_scale);
  } else {
    for (const auto& [part, does] : vr::labelsOf(m_profile, m_hand, m_roles))
      rows += row(QString::fromStdString(part), QString::fromStdString(does));
  }
  setText(rows.isEmpty() ? rows : QStringLiteral("<table cellspacing='2'>%1</table>").arg(rows));
  setFixedSize(sizeHint());
}

void VrLabels::paintEvent(QPaintEvent* event) {
  QPainter(this).fillRect(rect(), Theme::current()[Token::Panel]);
  QLabel::paintEvent(event);
}

}  // namespace ps
