// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"
#include "core/sketch/cellset.h"
#include "core/sketch/nearmatter.h"
#include "core/sketch/stampcells.h"
#include "core/sketch/symmetry.h"

#include <phasesketch/brush.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ps {

/// Points of a straight piece of stroke from `from` (left out: the piece before it stamped it) to `to` (held): n =
/// ceil(|to - from|/spacing) of them, evenly spaced, none farther than `spacing` from the one before. Pressure and time
/// are interpolated. Empty when the two points are one.
std::vector<api::StrokeSample> interpolateStroke(const api::StrokeSample& from, const api::StrokeSample& to,
                                                 double spacing);

/// Turns the pointer's raw samples, which arrive once per frame or faster, into dense ones at arc lengths 0, dx, 2 dx,
/// ... along the polyline and its end. The dense samples depend on the path alone, not on how often it was sampled: a
/// straight stroke gives the same points at 10 and at 1000 samples per second (to rounding). How fast the hand is
/// follows from the times of the raw samples, whatever velocity these have: a mean over 0.05 s, which forgets
/// exponentially.
class StrokeResampler {
 public:
  /// `spacing` in m, > 0: throws InputError otherwise.
  explicit StrokeResampler(double spacing);
  /// Dense samples that have become certain with this raw one. Samples that are not finite are skipped.
  std::vector<api::StrokeSample> add(const api::StrokeSample& raw);
  void add(const api::StrokeSample& raw, std::vector<api::StrokeSample>& dense);  ///< puts them behind what is there
  /// The end point, where it was not sampled yet. Afterwards the resampler is as new.
  std::vector<api::StrokeSample> finish();

 private:
  double m_spacing;
  double m_sinceLast = 0;  // m, arc length since the last dense sample
  std::optional<api::StrokeSample> m_last;
};

/// All dense samples of a finished stroke.
std::vector<api::StrokeSample> resampleStroke(std::span<const api::StrokeSample> raw, double spacing);

/// What a stroke asks for: sets without a common cell (the later edit of a cell wins).
struct StrokeEdits {
  CellSet added, removed, painted, smoothed, filled, coloured;
  bool empty() const {
    return added.empty() && removed.empty() && painted.empty() && smoothed.empty() && filled.empty() &&
           coloured.empty();
  }
  CellSet& of(api::EditKind kind) {
    if (kind == api::EditKind::Smooth) return smoothed;
    if (kind == api::EditKind::Fill) return filled;
    if (kind == api::EditKind::Colour) return coloured;
    return kind == api::EditKind::Add ? added : kind == api::EditKind::Remove ? removed : painted;
  }
};

/// How a stroke is drawn.
struct StrokeSetup {
  SketchGrid grid;
  double radius = 0.05;            ///< m
  Vector3 up{0, 1, 0};             ///< away from what is drawn on; any length, zero counts as upright
  std::vector<double> parameters;  ///< the brush's own, in the order of its declarations
  std::optional<VoxelShape::Symmetry> symmetry{};
  Vector3 look{0, 0, 0};                      ///< unit vector, or zero: see api::StrokeContext
  std::shared_ptr<const StampCells> stamp{};  ///< nullptr: none
  MatterWithin matterWithin{};                ///< of a brush that sees matter; nothing: nobody knows the scene
};

/// A brush threw, or gave what cannot be.
class BrushFault : public Error {
 public:
  using Error::Error;
};

/// Cells that one stroke may touch before it is refused: about 2 GB of particles.
inline constexpr size_t kMaxStrokeCells = size_t{1} << 23;

/// Unit vectors side, up and front of a stroke on what lies across `up`, as columns: as near to the world's axes as
/// that allows. `up` of any length; zero counts as upright.
Matrix3 strokeAxes(const Vector3& up);
/// What turns one pair of axes into another one, as in api::StrokeSample.
Vector3 turnBetween(const Matrix3& from, const Matrix3& to);
Matrix3 turnMatrix(const Vector3& turn);

/// What the brush knows of a stroke, but for the matter that it sees: up, side and front of strokeAxes(). Borrows the
/// setup's numbers and its stamp.
api::StrokeContext contextOf(const StrokeSetup& setup);

/// What asking a brush takes from call to call of one stroke.
struct BrushRoom {
  std::vector<SketchImage> images;  ///< of the setup's symmetry, as soon as it has been asked
  std::vector<api::StrokeSample> copies;
};

/// Asks a brush for one copy of a stroke: what it knows of it and sees there, and the samples as they lie there.
using BrushCall = std::function<void(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples)>;
/// Calls a brush for each copy by symmetry of dense samples. Throws BrushFault for what the call throws, and for a
/// reach that no brush may have; an Error is the host's own, and goes on as it is.
void askBrush(const api::BrushPlugin& brush, const StrokeSetup& setup, std::span<const api::StrokeSample> samples,
              const BrushCall& call, BrushRoom& room);

/// Runs a brush over one stroke, piece by piece. What it needs it keeps from piece to piece: by and by it allocates
/// nothing, but for what a brush sees of matter.
class BrushRun final : api::EditSink {
 public:
  /// Runs the brush over dense samples and all their copies by symmetry, for the same brush and setup each time. The
  /// edits are lost with the next call. Throws InputError when they cover more than kMaxStrokeCells, and BrushFault for
  /// what the brush itself throws.
  StrokeEdits& apply(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                     std::span<const api::StrokeSample> samples);

 private:
  void submit(api::EditKind kind, api::Span<const api::Cell> cells) override;
  void flush();

  BrushRoom m_room;
  StrokeEdits m_edits;
  api::EditKind m_kind = api::EditKind::Add;
  std::vector<api::Cell> m_pending;
};

/// The same, once.
StrokeEdits applyBrush(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                       std::span<const api::StrokeSample> samples);
/// The same into a set of cells: Add puts cells in, Remove takes them out, others leave them.
void applyBrush(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                std::span<const api::StrokeSample> samples, CellSet& cells);
/// Whether a cell's particle has room within the scene's bounds and before its walls.
bool isInScene(const Environment& environment, const SketchGrid& grid, const api::Cell& cell);

/// What a stroke asks a brush for.
api::EditKind kindOf(const api::BrushPlugin& brush, bool erase);
/// The coat (core/scene/coat.h) that a brush for colours gives; kNoColour of another one, and of what is no colour.
std::string colourOf(const api::BrushPlugin& brush, const StrokeSetup& setup);
/// How a saved stroke was drawn.
StrokeSetup setupOf(const api::BrushPlugin& brush, const VoxelShape::Stroke& stroke, const SketchGrid& grid);
/// Draws a saved stroke again (its samples are the raw ones).
StrokeEdits replayStroke(const api::BrushPlugin& brush, const VoxelShape::Stroke& stroke, const SketchGrid& grid,
                         const MatterWithin& matterWithin = {});

}  // namespace ps
