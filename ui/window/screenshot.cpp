// SPDX-License-Identifier: Apache-2.0
#include "ui/window/screenshot.h"

#include <QtGui/QPainter>
#include <QtOpenGLWidgets/QOpenGLWidget>
#include <QtWidgets/QWidget>

namespace ps {

QImage windowImage(QWidget& window) {
  QImage image = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
  const double ratio = image.devicePixelRatio();
  for (QOpenGLWidget* scene : window.findChildren<QOpenGLWidget*>()) {
    if (!scene->isVisible() || !scene->isValid()) continue;
    QImage picture = scene->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
    picture.setDevicePixelRatio(ratio);
    QPainter painter(&image);
    painter.drawImage(scene->mapTo(&window, QPoint(0, 0)), picture);
    // What floats over the scene (the palette) goes back on top.
    for (QWidget* floating : window.findChildren<QWidget*>(QStringLiteral("psPalette"), Qt::FindDirectChildrenOnly)) {
      if (floating->isVisible()) painter.drawPixmap(floating->pos(), floating->grab());
    }
  }
  return image;
}

}  // namespace ps
