// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/progress.h"
#include "core/sketch/stroke.h"

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ps {

/// What a stroke is drawn in.
struct StrokeScene {
  Environment environment;
  /// Whether a place, in m, was free when the stroke began: asked where a brush fills.
  std::function<bool(const Vector3&)> isFree{};
};

/// A stroke in the making, of one hand: takes raw places along it at any rate, lets the brush turn them into cells, and
/// gives those that have not come before. It knows of no document, window or engine; any one thread at a time may use
/// it. What it gives does not depend on how often the way was sampled.
class StrokeMaker {
 public:
  /// The brush, of that id, must live longer. Throws InputError for a spacing that is not above 0.
  StrokeMaker(std::string id, const api::BrushPlugin& brush, StrokeSetup setup, bool erases, StrokeScene scene);

  /// Places in m, as the setup's grid stands. Throws BrushFault for what the brush throws, and InputError where it asks
  /// for more than a stroke may hold; what has come so far stands, and no more may be asked for. The cells are lost
  /// with the next call.
  std::span<const api::Cell> add(std::span<const api::StrokeSample> raw);
  /// The next place is not joined to the last one: cells that the rest of the way brings.
  std::span<const api::Cell> lift();
  api::EditKind kind() const { return m_kind; }
  bool asksBrush() const noexcept { return m_asks; }  ///< now; from any thread
  /// What is being filled is given up: add() or lift() throws Cancelled; from any thread.
  void cancel() { m_filling.cancel(); }
  double filled() const { return m_filling.state().done; }  ///< 0..1 of the most that may run full; from any thread
  /// The brush gave cells outside of the scene or in its walls, which are left out; from any thread.
  bool leavesScene() const noexcept { return m_leavesScene; }

 private:
  StrokeEdits& ask();
  std::span<const api::Cell> feed();
  CellSet floodedFrom(const CellSet& seeds);

  std::string m_id;
  const api::BrushPlugin& m_brush;
  StrokeSetup m_setup;
  StrokeScene m_scene;
  api::EditKind m_kind;
  StrokeResampler m_resampler;
  BrushRun m_run;
  std::optional<api::StrokeSample> m_fed;  ///< the last one of the piece
  std::vector<api::StrokeSample> m_dense;  ///< to be fed, with that one in front
  CellSet m_cells;                         ///< that have come so far
  std::vector<api::Cell> m_fresh;          ///< and those of the last call
  Progress m_filling;                      ///< of all that runs full, as one stage
  std::atomic<bool> m_asks = false, m_leavesScene = false;
};

}  // namespace ps
