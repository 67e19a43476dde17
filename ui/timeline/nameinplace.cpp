// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/nameinplace.h"

#include "ui/theme/theme.h"

#include <QtGui/QShortcut>
#include <QtWidgets/QLineEdit>

#include <algorithm>
#include <utility>

namespace ps {
namespace {

constexpr int kWide = 180;    ///< logical pixels
constexpr int kLength = 100;  ///< characters

}  // namespace

void nameInPlace(QWidget& row, const QRect& place, const QString& name, const QString& words,
                 std::function<void(const QString&)> take) {
  auto* line = new QLineEdit(name, &row);
  line->setAccessibleName(words);
  line->setMaxLength(kLength);
  line->setFont(Theme::font(TextRole::Small));
  const int wide = std::min(kWide, row.width());
  line->setGeometry(std::clamp(place.left(), 0, row.width() - wide), place.top(), wide, place.height());
  line->selectAll();
  line->show();
  line->setFocus();
  QObject::connect(line, &QLineEdit::returnPressed, &row, [line, &row, take = std::move(take)] {
    take(line->text());
    row.setFocus();  // else it goes to whatever comes next, which may want Space for itself
  });
  QObject::connect(line, &QLineEdit::editingFinished, line, &QObject::deleteLater);  // also where the focus leaves
  auto* escape = new QShortcut(QKeySequence(Qt::Key_Escape), line, nullptr, nullptr, Qt::WidgetShortcut);
  QObject::connect(escape, &QShortcut::activated, &row, [&row] { row.setFocus(); });
}

}  // namespace ps
