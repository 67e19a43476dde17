// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QRectF>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtGui/QColor>
#include <QtGui/QIcon>
#include <QtGui/QPixmap>

class QPainter;

namespace ps {

/// Icon `:/icons/NAME.svg`, 16 units wide, drawn in one colour: text2 at rest, text under the pointer, accent when on,
/// disabled when disabled. `accentWhenOn` false: for item views, to which an open branch is "on". Follows the theme in
/// force and the screen's scale. An unknown name gives an empty icon and a warning in the log.
QIcon icon(const QString& name, bool accentWhenOn = true);

/// An icon in a colour of the caller's choice, `size` logical pixels wide, for a device pixel ratio. Cached.
QPixmap iconPixmap(const QString& name, const QColor& colour, int size = 16, double devicePixelRatio = 1);

/// Draws an icon into a square of logical pixels, sharp at the painter's device pixel ratio.
void paintIcon(QPainter& painter, const QRectF& square, const QString& name, const QColor& colour);

/// Names of all icons that the program carries.
QStringList iconNames();

}  // namespace ps
