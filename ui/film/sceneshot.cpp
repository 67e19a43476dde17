// SPDX-License-Identifier: Apache-2.0
#include "ui/film/sceneshot.h"

#include "ui/render/camera.h"

#include <QImage>

#include <algorithm>

namespace ps {
namespace {

/// From pictures of the same on black and on white: what is as bright on both hides its ground. One share stands for
/// all colours, so that what clear matter tints is right on a ground between the two.
QImage withoutGround(const QImage& onBlack, const QImage& onWhite) {
  QImage alone(onBlack.size(), QImage::Format_ARGB32_Premultiplied);
  for (int y = 0; y < alone.height(); ++y) {
    for (int x = 0; x < alone.width(); ++x) {
      const QRgb dark = onBlack.pixel(x, y), bright = onWhite.pixel(x, y);
      const int shows = (qRed(bright) - qRed(dark) + qGreen(bright) - qGreen(dark) + qBlue(bright) - qBlue(dark)) / 3;
      const int hides = std::clamp(255 - shows, 0, 255);
      const auto between = [&](int on0, int on255) { return std::clamp((on0 + on255 - shows) / 2, 0, hides); };
      reinterpret_cast<QRgb*>(alone.scanLine(y))[x] =
          qRgba(between(qRed(dark), qRed(bright)), between(qGreen(dark), qGreen(bright)),
                between(qBlue(dark), qBlue(bright)), hides);
    }
  }
  return alone;
}

}  // namespace

QImage ShotPainter::draw(const SceneShot& shot, const QSize& size) {
  const PictureSize picture{size.width(), size.height(), true};
  m_renderer.prepare(*shot.snapshot, nullptr, 1, shot.scene, shot.look);
  const std::vector<uint8_t> pixels =
      renderImage(m_renderer, eyeOf(shot.camera, picture.width, picture.height), picture);
  return QImage(pixels.data(), picture.width, picture.height, 4 * picture.width, QImage::Format_RGBA8888)
      .convertToFormat(QImage::Format_RGB32);
}

QImage ShotPainter::cutOut(SceneShot shot, const QSize& size) {
  shot.look.backdrop = {0.f, 0.f, 0.f};
  const QImage onBlack = draw(shot, size);
  shot.look.backdrop = {1.f, 1.f, 1.f};
  return withoutGround(onBlack, draw(shot, size));
}

QImage drawShot(const SceneShot& shot, const QSize& size) { return ShotPainter().draw(shot, size); }

}  // namespace ps
