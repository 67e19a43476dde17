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

/// Draws it without a display, on any thread. Throws Error where there is no OpenGL.
QImage drawShot(const SceneShot& shot, const QSize& size);

}  // namespace ps
