// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QRect>
#include <QtCore/QString>

#include <functional>

class QWidget;

namespace ps {

/// A field over a part of a row, in which something of it is named: Enter gives the name to `take`, Esc and a click
/// elsewhere do not. `words` say what is named.
void nameInPlace(QWidget& row, const QRect& place, const QString& name, const QString& words,
                 std::function<void(const QString&)> take);

}  // namespace ps
