// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ps::render {

class Projector;

/// How a surface answers light; the shaders know the same numbers. A mote is plain and casts no shadow. Solid and wet
/// matter add their clearness, from 0 to kClearest; patterned matter adds its Pattern, and so do surfaces of liquids in
/// colours of data, which are not clear.
enum class Kind {
  Plain = 0,
  Matte = 3,
  PlateTop = 4,
  PlateSide = 5,
  Dark = 6,
  Mote = 7,
  Patterned = 8,
  Solid = 16,
  Wet = 32
};
inline constexpr float kClearest = 15;

/// One particle as the shaders read it: two texels.
struct Instance {
  float x, y, z, radius;          ///< m
  float red, green, blue, extra;  ///< sRGB; Kind for spheres, a seed for vapour
};

struct Extent {
  std::array<float, 3> minimum{1e30f, 1e30f, 1e30f}, maximum{-1e30f, -1e30f, -1e30f};  ///< m, spheres included
  bool empty() const { return minimum[0] > maximum[0]; }
  bool holds(const Vector3& p) const;
  void add(float x, float y, float z, float radius);
  std::array<Vector3, 8> corners() const;
};

/// A horizontal rectangle of the floor on which a map says what stands above it.
struct ContactMap {
  static constexpr int kCells = 64;
  std::array<float, 2> corner{}, size{1, 1};  ///< x and z, m
  float floor = 0;                            ///< height, m
  std::vector<uint8_t> texels;                ///< RGBA8: mean colour, how much is covered
  std::array<std::vector<float>, 6> sums;     ///< while it is filled: near, far, weights, colours; kept for its memory
};

struct InstanceRequest {
  const Snapshot* now = nullptr;
  const Snapshot* previous = nullptr;  ///< nullptr: no interpolation
  float blend = 1;                     ///< 0: previous, 1: now
  std::string colour = kMatterColour;  ///< or a field that `now` has
  double minimum = 0, maximum = 1, meltingPoint = 273.15;
  bool surfaces = true;                 ///< liquids become a surface, else spheres
  std::array<float, 3> steam{1, 1, 1};  ///< colour of vapour where colours show no data
  std::vector<uint8_t> outlined;        ///< 1 for bodies that get an outline, by index
  const Snapshot* ghost = nullptr;      ///< of another run; nullptr: none
  std::optional<Section> section;       ///< leaves out those whose middle it cuts away
};

/// A part of a list.
struct Range {
  size_t first = 0, count = 0;
};

/// What there is to draw, in ranges of `particles`. What is buried shows only from among it.
struct Instances {
  std::vector<Instance> particles;
  size_t buriedSpheres = 0, spheres = 0;           ///< in this order
  size_t dense = 0, clear = 0, buriedLiquids = 0;  ///< of surfaces; the dense ones hide what lies behind them
  size_t vapours = 0;
  size_t ghosts = 0;               ///< what shows of another run's matter
  size_t outlined = 0;             ///< once more what makes the outlined body's picture, but for its droplets
  std::optional<float> clearness;  ///< of all liquids, 0..1, where it is one
  Extent sphereExtent, liquidExtent, vapourExtent;
  float radius = 0.01f;                                       ///< mean of what is neither vapour nor static, m
  std::vector<Instance> all, liquid, vapour, ghost, outline;  ///< while it is filled; kept for their memory

  size_t liquids() const { return dense + clear + buriedLiquids; }
  Range sphereRange(bool amongThem) const {
    return amongThem ? Range{0, buriedSpheres + spheres} : Range{buriedSpheres, spheres};
  }
  Range casterRange() const { return {buriedSpheres, spheres + dense}; }
  Range liquidRange(bool amongThem) const { return {buriedSpheres + spheres, amongThem ? liquids() : dense + clear}; }
  Range vapourRange() const { return {buriedSpheres + spheres + liquids(), vapours}; }
  Range ghostRange() const { return {buriedSpheres + spheres + liquids() + vapours, ghosts}; }
  Range outlineRange() const { return {particles.size() - outlined, outlined}; }
};

/// Whether a liquid's surface hides more than it shows; all do where colours are data.
bool isDense(const Instance& liquid);

/// Values of `previous` are found by id where the order differs; particles that are new stand where they are now.
/// Snapshots of different revisions are not mixed.
void collectInstances(const InstanceRequest& request, Instances& out);
/// The spheres that may be seen, nearest first, in place of what `visible` held. A sphere is hidden when spheres at
/// least a radius nearer cover every cell, 2 pixels wide, of its disc.
void sortVisible(const Projector& projector, std::span<const Instance> spheres, std::vector<Instance>& visible);
/// Puts what no view from outside can see behind the rest, which keeps its order: whatever lies in a cell, `cell` (m)
/// wide, that has `full` spheres or more and 26 neighbours with as many; spheres much smaller than `radius` (m) do not
/// count. Returns the number of the rest: all of a list too small, or spread too thin, to be worth the search.
size_t exposedFirst(const Extent& extent, float radius, float cell, int full, std::vector<Instance>& list);
/// Puts what lies in small pieces behind the rest, which keeps its order: fewer than `least` spheres in cells, `cell`
/// (m) wide, of which each touches another. Returns the number of the rest; all where there is no larger piece, or
/// where they are spread too thin.
size_t piecesFirst(const Extent& extent, float cell, size_t least, std::vector<Instance>& list);
/// Fills texels from spheres and liquids; clear liquids count less.
void fillContactMap(const Instances& instances, ContactMap& map);

}  // namespace ps::render
