// SPDX-License-Identifier: Apache-2.0
#include "ui/window/screenshot.h"

#include <QtGui/QPainter>
#include <QtOpenGLWidgets/QOpenGLWidget>
#include <QtWidgets/QWidget>

namespace ps {
namespace {

/// Paints again what lies over a part of the window: notices, the palette, the card of the tour.
void paintAbove(QPainter& painter, const QWidget& part, const QWidget& window) {
  const QRect place(part.mapTo(&window, QPoint(0, 0)), part.size());
  for (const QWidget* at = &part; at != &window; at = at->parentWidget()) {
    const QObjectList& siblings = at->parentWidget()->children();
    for (qsizetype k = siblings.indexOf(at) + 1; k < siblings.size(); ++k) {  // in the order that they are painted in
      auto* widget = qobject_cast<QWidget*>(siblings[k]);
      if (!widget || !widget->isVisible() || widget->isWindow()) continue;
      const QPoint corner = widget->mapTo(&window, QPoint(0, 0));
      if (place.intersects(QRect(corner, widget->size())))
        widget->render(&painter, corner, QRegion(), QWidget::DrawChildren);
    }
  }
}

}  // namespace

QImage windowImage(QWidget& window) {
  QImage image = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
  const double ratio = image.devicePixelRatio();
  for (QOpenGLWidget* scene : window.findChildren<QOpenGLWidget*>()) {
    if (!scene->isVisible() || !scene->isValid()) continue;
    QImage picture = scene->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
    picture.setDevicePixelRatio(ratio);
    QPainter painter(&image);
    painter.drawImage(scene->mapTo(&window, QPoint(0, 0)), picture);
    paintAbove(painter, *scene, window);
  }
  return image;
}

}  // namespace ps
