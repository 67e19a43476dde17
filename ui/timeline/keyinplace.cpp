// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/keyinplace.h"

#include "ui/theme/theme.h"

#include <QtGui/QShortcut>
#include <QtWidgets/QApplication>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLineEdit>

#include <algorithm>

namespace ps {
namespace {

constexpr int kTime = 80, kValue = 110;  ///< logical pixels

QLineEdit* field(QWidget& box, const QString& text, const QString& words, int width) {
  auto* line = new QLineEdit(text, &box);
  line->setAccessibleName(words);
  line->setToolTip(words);
  line->setFont(Theme::font(TextRole::Small));
  line->setFixedWidth(width);
  return line;
}

}  // namespace

void keyInPlace(QWidget& row, const QRect& place, const KeyTexts& shown, std::function<void(const KeyTexts&)> take) {
  auto* box = new QWidget(&row);
  auto* line = new QHBoxLayout(box);
  line->setContentsMargins(0, 0, 0, 0);
  line->setSpacing(2);
  QLineEdit* time = field(*box, shown.time, QStringLiteral("Time of the key"), kTime);
  QLineEdit* value = field(*box, shown.value, QStringLiteral("Value of the key"), kValue);
  value->setVisible(!shown.value.isEmpty());
  line->addWidget(time);
  line->addWidget(value);
  const auto close = [box, &row] {
    row.setFocus();
    box->hide();
    box->deleteLater();
  };
  for (QLineEdit* each : {time, value}) {
    QObject::connect(each, &QLineEdit::returnPressed, box, [time, value, take, close] {
      const KeyTexts typed{time->text(), value->text()};
      close();
      take(typed);
    });
    auto* escape = new QShortcut(QKeySequence(Qt::Key_Escape), each, nullptr, nullptr, Qt::WidgetShortcut);
    QObject::connect(escape, &QShortcut::activated, box, close);
  }
  QObject::connect(qApp, &QApplication::focusChanged, box, [box](QWidget*, QWidget* now) {
    if (!now || !box->isAncestorOf(now)) box->deleteLater();
  });
  const int wide = std::min(shown.value.isEmpty() ? kTime : kTime + 2 + kValue, row.width());
  box->setGeometry(std::clamp(place.left(), 0, row.width() - wide), place.top(), wide, place.height());
  box->show();
  time->selectAll();
  time->setFocus();
}

}  // namespace ps
