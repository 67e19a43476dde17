// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/plugin.h>

#define PHASESKETCH_BRUSH_IID "org.phasesketch.Brush/0.9"

namespace ps::api {

/// Capability of a brush whose stamp fills the box of its extent(): extension(kBoxStamp) is not nullptr. The cursor is
/// then drawn as that box, otherwise as the ball within it.
inline constexpr const char* kBoxStamp = "box_stamp";

struct StrokeSample {
  Double3 position;   ///< m
  double pressure;    ///< 0 .. 1
  double time;        ///< s since the stroke began
  Double3 direction;  ///< unit vector along which the hand goes; zero where it has not moved yet
};

/// Where a stroke lands: a lattice of cells of edge `spacing` whose cell (0, 0, 0) is centred at `origin`.
struct StrokeContext {
  double spacing;  ///< m
  Double3 origin;  ///< m
  double radius;   ///< m, the brush's size
  /// Unit vectors at right angles: away from what is drawn on, and along it. In a mirror they are mirrored as well, so
  /// that a brush that goes by them alone is drawn as its own mirror image.
  Double3 up, side, front;
  Span<const double> parameters;
};

struct Cell {
  int32_t x, y, z;
};

enum class EditKind : uint32_t { Add, Remove };

/// Takes a stroke's edits. A cell may be submitted any number of times; undo, recording and replay know edits only.
class EditSink {
 public:
  virtual void submit(EditKind kind, Span<const Cell> cells) = 0;

 protected:
  ~EditSink() = default;
};

class BrushPlugin : public Plugin {
 public:
  /// Turns samples into edits. Samples are dense: neighbours lie at most one spacing apart. A stroke may come in several
  /// calls; where it goes on, the first sample is the last one of the call before, so that a brush knows the way between
  /// them. May throw.
  virtual void stroke(const StrokeContext&, EditKind, const List<StrokeSample>&, EditSink&) const = 0;
  /// Half extents in m of one stamp, for the cursor.
  virtual Double3 extent(const StrokeContext&) const noexcept = 0;
};

}  // namespace ps::api
