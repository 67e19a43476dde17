// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/stroke.h"

#include <functional>
#include <optional>
#include <vector>

namespace ps {

/// What a stroke is drawn in.
struct StrokeScene {
  Environment environment;
  /// Whether a place, in m, is free: asked of brushes that fill. Of its own, as the stroke began.
  std::function<bool(const Vector3&)> isFree{};
};

/// A stroke in the making, of one hand: takes raw places along it at any rate, lets the brush turn them into cells, and
/// gives those that have not come before. It knows of no document, window or engine; any one thread at a time may use
/// it. What it gives does not depend on how often the way was sampled.
class StrokeMaker {
 public:
  /// The brush must live longer. Throws InputError for a spacing that is not above 0.
  StrokeMaker(const api::BrushPlugin& brush, StrokeSetup setup, bool erases, StrokeScene scene);

  /// Places in m, as the setup's grid stands. Throws BrushFault for what the brush throws, and InputError where it asks
  /// for more than a stroke may hold; what has come so far stands, and no more may be asked for.
  std::vector<api::Cell> add(const api::StrokeSample& raw);
  /// The next place is not joined to the last one: cells that the rest of the way brings.
  std::vector<api::Cell> lift();
  api::EditKind kind() const { return m_kind; }

 private:
  std::vector<api::Cell> feed(std::vector<api::StrokeSample> samples);
  CellSet floodedFrom(const CellSet& seeds) const;

  const api::BrushPlugin& m_brush;
  StrokeSetup m_setup;
  StrokeScene m_scene;
  api::EditKind m_kind;
  StrokeResampler m_resampler;
  std::optional<api::StrokeSample> m_fed;  ///< the last one of the piece
  CellSet m_cells;                         ///< that have come so far
};

}  // namespace ps
