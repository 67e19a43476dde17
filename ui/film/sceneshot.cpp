// SPDX-License-Identifier: Apache-2.0
#include "ui/film/sceneshot.h"

#include "ui/render/camera.h"

#include <QImage>

namespace ps {

QImage drawShot(const SceneShot& shot, const QSize& size) {
  HeadlessContext context;
  context.makeCurrent();
  Renderer renderer;
  const PictureSize picture{size.width(), size.height(), true};
  renderer.prepare(*shot.snapshot, nullptr, 1, shot.scene, shot.look);
  const std::vector<uint8_t> pixels = renderImage(renderer, eyeOf(shot.camera, picture.width, picture.height), picture);
  return QImage(pixels.data(), picture.width, picture.height, 4 * picture.width, QImage::Format_RGBA8888)
      .convertToFormat(QImage::Format_RGB32);
}

}  // namespace ps
