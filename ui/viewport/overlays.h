// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/tools/tool.h"
#include "ui/viewport/overlaychoice.h"
#include "ui/viewport/sectionstrip.h"

#include <QtCore/QPointF>
#include <QtCore/QRectF>
#include <QtCore/QString>

#include <optional>
#include <utility>
#include <vector>

class QPainter;

namespace ps {

/// One key or gesture of the strip of hints.
struct OverlayHint {
  QString keys, does;
};

/// Everything that is painted over the picture, in logical pixels.
struct OverlayState {
  QSizeF size;
  Camera camera;
  QString viewName;
  FieldPtr field;                                       ///< that colours show; nullptr: matter's own colours
  std::pair<double, double> range{0, 1};                ///< SI
  std::vector<std::pair<QString, QString>> classes;     ///< letters and names of colours that the scene names: bodies
  double meltingPoint = 273.15, boilingPoint = 373.15;  ///< K; infinite or NaN: no mark
  QString without = QStringLiteral("none here");        ///< what the legend says where nothing has the field's values
  bool empty = false;                                   ///< no snapshot yet
  OverlayChoice shown;
  double top = 0;                  ///< logical pixels of the view that something else lies over
  std::vector<OverlayHint> hints;  ///< empty: no strip
  std::optional<SceneTag> tag;
  std::optional<BrushCursor> cursor;
  std::optional<SectionNote> section;
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
  QRectF legend;                    ///< empty: there is none
  QRectF legendBar;                 ///< its gradient; empty where colours are classes
  QString legendTitle, legendUnit;  ///< as painted
  QString legendWithout;            ///< what stands in place of numbers; "": there are some
  int legendClasses = 0;            ///< swatches in place of a gradient
  SectionHits section;
};

/// Paints legend, view label, strip of the section, scale bar, hint strip, axis ball, tags and the brush's true volume.
OverlayHits paintOverlays(QPainter& painter, const OverlayState& state);
/// Nothing but a sentence on the ground of the window: no picture can be had.
void paintMessage(QPainter& painter, const QSizeF& size, const QString& title, const QString& text);

}  // namespace ps
