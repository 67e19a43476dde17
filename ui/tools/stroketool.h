// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "core/sketch/cellset.h"
#include "core/sketch/drawingplane.h"
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"
#include "ui/tools/viewtool.h"

#include <QtCore/QString>

#include <memory>

namespace ps {

class Document;
class SceneLink;

/// Cells that the box around one stamp of a brush may hold: what can be stamped at every movement of the pointer.
inline constexpr double kMaximumStamp = 32768;

/// A stroke in the making: takes the pointer's places, lets the brush plugin turn them into cells, sends new cells
/// straight to the engine, and hands the document one command at the end.
class StrokeTool {
 public:
  void attach(Document* document, SceneLink* link);

  /// "" or why no stroke can begin ("The cube brush is not installed…"). `now`: the scene as it is drawn on.
  QString begin(const BrushSettings& brush, bool erase, const Snapshot& now, const Vector3& point);
  /// "" or what went wrong; the stroke then ends as far as it came.
  QString move(const Vector3& point, double seconds);
  void finish();
  void cancel();
  bool active() const { return m_record != nullptr; }
  size_t cellCount() const { return m_cells.size(); }

  /// Half extents of one stamp in m, for the cursor; radius on all axes when the brush is not installed.
  Vector3 extent(const BrushSettings& brush) const;

 private:
  QString whyNot(const BrushSettings& brush, bool erase, const Snapshot& now) const;
  Body paintedBody(const BrushSettings& brush, int& palette) const;
  void feed(const std::vector<api::StrokeSample>& samples);
  template <class Work>
  QString guarded(Work work) const;  ///< "" or what a brush threw
  bool isInside(const api::Cell& cell) const;
  StrokeSetup setup(const BrushSettings& brush) const;
  double spacing() const;
  void collectErasure(StrokeRecord& record) const;

  Document* m_document = nullptr;
  SceneLink* m_link = nullptr;
  BrushSettings m_brush;
  std::shared_ptr<StrokeRecord> m_record;
  std::shared_ptr<const Body> m_body;  ///< that an adding stroke paints, as it was before
  bool m_atStart = false;
  std::unique_ptr<StrokeResampler> m_resampler;
  StrokeSetup m_setup;
  CellSet m_cells;
  VoxelShape::Stroke m_stroke;
};

}  // namespace ps
