// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/cellset.h"
#include "core/sketch/drawingplane.h"
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"
#include "ui/viewport/viewtool.h"

#include <QtCore/QString>

#include <memory>

namespace ps {

class Document;
class SceneLink;

/// A stroke in the making: takes the pointer's places, lets the brush plugin turn them into cells, sends new cells
/// straight to the engine, and hands the document one command at the end.
class StrokeTool {
 public:
  void attach(Document* document, SceneLink* link);

  /// "" or why no stroke can begin ("The cube brush is not installed…").
  QString begin(const BrushSettings& brush, bool erase, bool atStart, const Vec3& point);
  /// "" or what went wrong; the stroke then ends as far as it came.
  QString move(const Vec3& point, double seconds);
  void finish();
  void cancel();
  bool active() const { return m_record != nullptr; }
  size_t cellCount() const { return m_cells.size(); }

  /// Half extents of one stamp in m, for the cursor; radius on all axes when the brush is not installed.
  Vec3 extent(const BrushSettings& brush) const;

 private:
  Body paintedBody(const BrushSettings& brush, int& palette) const;
  QString feed(const std::vector<api::StrokeSample>& samples);
  bool isInside(const api::Cell& cell) const;
  StrokeSetup setup(const BrushSettings& brush) const;
  double spacing() const;
  void collectErasure();

  Document* m_document = nullptr;
  SceneLink* m_link = nullptr;
  BrushSettings m_brush;
  std::shared_ptr<StrokeRecord> m_record;
  Body m_body;
  bool m_newBody = false, m_atStart = false;
  std::unique_ptr<StrokeResampler> m_resampler;
  StrokeSetup m_setup;
  CellSet m_cells;
  VoxelShape::Stroke m_stroke;
};

}  // namespace ps
