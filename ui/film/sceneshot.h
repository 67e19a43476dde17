// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"

class QImage;
class QSize;

namespace ps {

/// A scene as a view shows it.
struct SceneShot {
  SnapshotPtr snapshot;
  RenderScene scene;
  Look look;
  Camera camera;
};

/// Draws scenes without a display, on the thread that made it. Throws Error where there is no OpenGL.
class ShotPainter {
 public:
  QImage draw(const SceneShot& shot, const QSize& size);
  /// The matter alone, on nothing: one picture for any ground, through which clear matter shows it.
  QImage cutOut(SceneShot shot, const QSize& size);

 private:
  HeadlessContext m_context;
  Renderer m_renderer;
};

/// Draws one without a display, on any thread. Throws Error where there is no OpenGL.
QImage drawShot(const SceneShot& shot, const QSize& size);

}  // namespace ps
