// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/plugin.h>

#define PHASESKETCH_BRUSH_IID "org.phasesketch.Brush/0.9"

namespace ps::api {

/// Capability of a brush whose stamp fills the box of its extent(): extension(kBoxStamp) is not nullptr. The cursor is
/// then drawn as that box, otherwise as the ball within it.
inline constexpr const char* kBoxStamp = "box_stamp";

/// Capability of a brush that works on the matter that is there, instead of drawing cells: extension(kTouchesMatter) is
/// its MatterBrush, and its metadata list the name. Its stroke() is never called.
inline constexpr const char* kTouchesMatter = "touches_matter";

/// Capability of a brush that makes the matter that is there of another material, instead of drawing cells:
/// extension(kPaintsMatter) is not nullptr, and its metadata list the name. Its stroke() gets and submits
/// EditKind::Paint, or Remove where its user erases with it.
inline constexpr const char* kPaintsMatter = "paints_matter";

/// Capability of a brush that rounds what is drawn, instead of drawing cells: extension(kSmoothsMatter) is not nullptr,
/// and its metadata list the name. Its stroke() gets and submits EditKind::Smooth, or Remove where its user erases with
/// it.
inline constexpr const char* kSmoothsMatter = "smooths_matter";

/// Capability of a brush that fills hollows, instead of drawing cells: extension(kFillsHollows) is not nullptr, and its
/// metadata list the name. Its stroke() gets and submits EditKind::Fill, or Remove where its user erases with it.
inline constexpr const char* kFillsHollows = "fills_hollows";

/// Capability of a brush that gives the matter that is there a colour of its own, instead of drawing cells:
/// extension(kColoursMatter) is its ColourBrush, and its metadata list the name. Its stroke() gets and submits
/// EditKind::Colour, or Remove where its user erases with it.
inline constexpr const char* kColoursMatter = "colours_matter";

/// Capability of a brush that stamps the shape of a body: extension(kStampsShape) is not nullptr, and its metadata list
/// the name. Its StrokeContext has the shape's cells, and it submits EditKind::Add or Remove.
inline constexpr const char* kStampsShape = "stamps_shape";

/// Capability of a brush of any kind that goes by the matter near the hand: extension(kSeesMatter) is its SeeingBrush.
/// Its StrokeContext shows that matter.
inline constexpr const char* kSeesMatter = "sees_matter";

struct StrokeSample {
  Double3 position;   ///< m
  double pressure;    ///< 0 .. 1; 1 where nothing tells how hard it is
  double time;        ///< s since the stroke began
  Double3 direction;  ///< unit vector along which the hand goes; zero where it has not moved yet
  /// m/s, of the hand: a mean over 0.05 s or so. Zero where it has just begun, and where it stays in matter.
  Double3 velocity{0, 0, 0};
  /// How the pen or the hand is turned against the stroke's up, side and front: tilt and rotation as one turn about
  /// this axis by its length in rad. Zero: not at all, or by something, such as a mouse, that has no pose. A pen that
  /// stands upright on its tablet stands along up; a hand's pose is what turns up, side and front into its own.
  Double3 turn{0, 0, 0};
  double way = 0;  ///< m, along which the hand has gone since the stroke began
};

struct Cell {
  int32_t x, y, z;
};

/// Matter that a brush sees, to be read only: `count` values each, in an order that means nothing, of which no pointer
/// is null where there are any. They last as long as the call.
struct NearMatter {
  size_t count = 0;
  const Float4* position = nullptr;    ///< m, as samples lie; w: radius of a sphere of the rest volume, m
  const float* temperature = nullptr;  ///< K
  const float* speed = nullptr;        ///< m/s
  const Phase* phase = nullptr;
  const Motion* motion = nullptr;
  const uint32_t* body = nullptr;      ///< equal for what belongs to one body
  const uint32_t* material = nullptr;  ///< equal for what is of one material
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
  /// Unit vector along which whoever touches matter looks, as the stroke began; zero where nobody knows. Mirrored too.
  Double3 look{0, 0, 0};
  /// Of a brush that stamps a shape: the cells of it, in order of z, y, x, on a lattice of its own with edges of
  /// `shapeSpacing` m along the unit vectors `shapeX`, `shapeY` and `shapeZ`. In cells of that lattice the box around
  /// them has its middle at `shapeMiddle` and half the edges `shapeHalf`. Empty where there is no shape. Mirrored too.
  Span<const Cell> shape{};
  double shapeSpacing = 0;
  Double3 shapeMiddle{0, 0, 0}, shapeHalf{0, 0, 0};
  Double3 shapeX{1, 0, 0}, shapeY{0, 1, 0}, shapeZ{0, 0, 1};
  /// Of a brush that sees matter: all within its reach of any of the samples. Where it draws, as the scene was when the
  /// stroke began, without its own; where it touches, as it was when the hand was last heard of. Where a sketch is
  /// drawn again: the scene at its start with what is drawn before, all of it solid and at rest. nullptr where nobody
  /// knows the scene, as for the picture of the brush at the pointer.
  const NearMatter* matter = nullptr;
};

enum class EditKind : uint32_t {
  Add,     ///< free cells are filled with the material that is drawn with
  Remove,  ///< what stands in cells goes
  Paint,   ///< what stands in cells becomes that material, as warm as it is; free cells stay free
  Smooth,  ///< of these cells, filled ones at edges and bumps are emptied, and free ones in hollows are filled
  Fill,    ///< like Add, and all free cells that are reached from each, from face to face, no higher than it is
  Colour,  ///< what stands in cells gets the colour of the brush; free cells stay free
};

/// Takes a stroke's edits. A cell may be submitted any number of times; undo, recording and replay know edits only.
class EditSink {
 public:
  virtual void submit(EditKind kind, Span<const Cell> cells) = 0;

 protected:
  ~EditSink() = default;
};

enum class TouchKind : uint32_t {
  Heat,  ///< gives heat, or takes it
  Push,  ///< brings matter to a velocity
  Hold,  ///< takes hold of what is within when the hand begins, and carries it along until it ends
  Cut,   ///< parts what is tied, for as long as it stays solid
  Weld,  ///< ties solid matter to what it touches, across cuts and bodies
};

/// What a hand does to the matter within a ball, all the time that it is there. What a kind has no use for is 0.
struct Touch {
  TouchKind kind = TouchKind::Heat;
  uint32_t reserved = 0;
  Double3 centre{0, 0, 0};  ///< m
  double radius = 0;        ///< m, above 0
  /// 0 .. 1: over this share of the radius, from the rim inwards, it fades to nothing.
  double falloff = 0;
  /// W of thermal time that all matter within gets together, by its mass; below 0 they are taken.
  double power = 0;
  double limit = 0;  ///< K, beyond which matter is neither heated nor cooled; 1 .. 10000
  double force = 0;  ///< N, the most that all matter within, or held, gets together, by its mass; not below 0
  /// Of Push: m/s in the centre, and rad/s about it, up to 100 and 1000.
  Double3 velocity{0, 0, 0}, spin{0, 0, 0};
  /// Of Cut: unit vector across a blade, which is the disc through the ball's middle; ties that go through it are cut.
  /// Zero: the whole ball cuts ties that have a part within.
  Double3 normal{0, 0, 0};
};

/// Takes what a hand does. The touches of one call of touch() share the time of its samples evenly.
class TouchSink {
 public:
  virtual void submit(const List<Touch>& touches) = 0;

 protected:
  ~TouchSink() = default;
};

/// A brush's way with matter; see kTouchesMatter. It need not see a particle: the host finds those within, books the
/// heat that they get, and takes it back by undo as it does with ties that were cut or welded. What was pushed or held
/// goes on as it was let go.
class MatterBrush {
 public:
  /// Turns the places where the hand has been since the last call into touches, for each sample as many as for any
  /// other; Remove asks for the opposite of what the brush is called. Called with one sample, it says what happens as
  /// long as the hand stays there. May throw.
  virtual void touch(const StrokeContext&, EditKind, const List<StrokeSample>&, TouchSink&) const = 0;

 protected:
  ~MatterBrush() = default;
};

/// What a brush sees; see kSeesMatter.
class SeeingBrush {
 public:
  /// m from each sample, 0 .. 10. The context shows no matter yet.
  virtual double reach(const StrokeContext&) const noexcept = 0;

 protected:
  ~SeeingBrush() = default;
};

/// A brush's way with colours; see kColoursMatter.
class ColourBrush {
 public:
  /// Red, green and blue (sRGB), 0 .. 1 each, that matter gets; below 0 it gets the colour of its material again.
  virtual Double3 colour(const StrokeContext&) const noexcept = 0;

 protected:
  ~ColourBrush() = default;
};

/// Called from any thread, also from several at once: each hand has a stroke of its own.
class BrushPlugin : public Plugin {
 public:
  /// Turns samples into edits. Samples are dense: neighbours lie at most one spacing apart. A stroke may come in
  /// several calls; where it goes on, the first sample is the last one of the call before, so that a brush knows the
  /// way between them. May throw.
  virtual void stroke(const StrokeContext&, EditKind, const List<StrokeSample>&, EditSink&) const = 0;
  /// Half extents in m of one stamp, for the cursor.
  virtual Double3 extent(const StrokeContext&) const noexcept = 0;
};

}  // namespace ps::api
