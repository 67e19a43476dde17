// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QRect>
#include <QtCore/QString>

#include <functional>

class QWidget;

namespace ps {

/// A key as it is typed.
struct KeyTexts {
  QString time, value;  ///< value "": it has none that is typed
};

/// Two fields over a part of a row, for time and value of a key: Enter in either gives both to `take`, Esc and a click
/// elsewhere do not.
void keyInPlace(QWidget& row, const QRect& place, const KeyTexts& shown, std::function<void(const KeyTexts&)> take);

}  // namespace ps
