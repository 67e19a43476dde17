// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/tools/viewtool.h"

#include <QtCore/QPointF>
#include <QtCore/QRectF>
#include <QtCore/QString>

#include <optional>
#include <utility>
#include <vector>

class QPainter;

namespace ps {

/// A tag at a place of the scene: "Ice block −9.2 °C".
struct SceneTag {
  Vector3 place{0, 0, 0};
  QString name, value;
};

/// The brush under the pointer.
struct BrushCursor {
  Vector3 centre{0, 0, 0};  ///< m
  Vector3 extent{0, 0, 0};  ///< half extents, m
  double floor = 0;         ///< m, height of what lies below
  bool box = false, erase = false;
};

/// Everything that is painted over the picture, in logical pixels.
struct OverlayState {
  QSizeF size;
  Camera camera;
  QString viewName;
  ColourBy colour = ColourBy::Material;
  std::pair<double, double> range{0, 1};                ///< SI
  double meltingPoint = 273.15, boilingPoint = 373.15;  ///< K; infinite or NaN: no mark
  bool empty = false;                                   ///< no snapshot yet
  bool hint = false;
  ViewTool tool = ViewTool::Select;
  std::optional<SceneTag> tag;
  std::optional<BrushCursor> cursor;
  QString invitation;  ///< in the middle of an empty scene: what to do
};

/// What the pointer can hit.
struct OverlayHits {
  QRectF hintClose;
  struct Axis {
    QRectF rect;
    double azimuth, elevation;
  };
  std::vector<Axis> axes;
  QRectF legend;     ///< empty: there is none
  QRectF legendBar;  ///< its gradient; empty where colours are classes
};

/// Paints legend, view label, scale bar, hint strip, axis ball, tags and the brush's true volume.
OverlayHits paintOverlays(QPainter& painter, const OverlayState& state);
/// Nothing but a sentence on the ground of the window: no picture can be had.
void paintMessage(QPainter& painter, const QSizeF& size, const QString& title, const QString& text);

}  // namespace ps
