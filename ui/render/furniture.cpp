// SPDX-License-Identifier: Apache-2.0
#include "ui/render/furniture.h"

#include "core/math/plane.h"
#include "core/scene/scenewall.h"
#include "ui/render/colourmap.h"
#include "ui/render/uniforms.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

namespace ps::render {
namespace {

std::array<float, 4> with(const Colour& c, double last) { return {c[0], c[1], c[2], static_cast<float>(last)}; }
std::array<float, 4> with(const Colour& c, Kind kind) { return with(c, static_cast<double>(kind)); }

struct Cut {
  Plane plane;  // what is above it stays
  bool wall;
};

// Sutherland-Hodgman against one plane. New edges lie on that plane.
void clip(Face& face, const Cut& cut) {
  Face out;
  const size_t n = face.corners.size();
  for (size_t i = 0; i < n; ++i) {
    const Vector3 &a = face.corners[i], &b = face.corners[(i + 1) % n];
    const double da = cut.plane.heightOf(a), db = cut.plane.heightOf(b);
    if (da >= 0) {
      out.corners.push_back(a);
      out.walled.push_back(face.walled[i]);
    }
    if ((da >= 0) == (db >= 0)) continue;
    out.corners.push_back(a + da / (da - db) * (b - a));
    out.walled.push_back(da >= 0 ? cut.wall : face.walled[i]);
  }
  face = std::move(out);
}

bool isRound(const Environment& environment, size_t wall) { return faceOf(environment.walls[wall]).isCurved(); }

std::vector<Cut> cutsOf(const Environment& environment, size_t except) {
  std::vector<Cut> cuts;
  for (size_t k = 0; k < 3; ++k) {
    Vector3 axis{0, 0, 0};
    axis[k] = 1;
    cuts.push_back({{axis, environment.boundsMinimum[k]}, false});
    axis[k] = -1;
    cuts.push_back({{axis, -environment.boundsMaximum[k]}, false});
  }
  for (size_t i = 0; i < environment.walls.size(); ++i) {
    if (i == except || isRound(environment, i)) continue;
    const Vector3 normal = environment.walls[i].normal.normalized();
    cuts.push_back({{normal, normal.dot(environment.walls[i].point)}, true});
  }
  return cuts;
}

enum class Role { Floor, Side, Lid };
Role roleOf(const SceneWall& wall) {
  const double up = wall.normal.normalized()[1];
  return up > kLevel ? Role::Floor : up < -kLevel ? Role::Lid : Role::Side;
}

void addFaded(std::vector<EdgeVertex>& out, const Vector3& a, const Vector3& b, double opacityA, double opacityB) {
  const auto end = [&](const Vector3& here, const Vector3& there, double opacity, float side, float turn) {
    return EdgeVertex{floats(here), floats(there), {side * turn, static_cast<float>(opacity), side, 0}};
  };
  const EdgeVertex corners[4] = {end(a, b, opacityA, -1, 1), end(a, b, opacityA, 1, 1), end(b, a, opacityB, 1, -1),
                                 end(b, a, opacityB, -1, -1)};
  for (const size_t k : {0u, 1u, 2u, 0u, 2u, 3u}) out.push_back(corners[k]);
}

bool isLevel(const Vector3& a, const Vector3& b) { return std::abs(a[1] - b[1]) < 1e-6; }

/// Where panes end: at a lid, or where they fade out.
struct Top {
  double height = 0;  // m
  bool open = true;   // they fade
  bool lid = false;   // one is seen
};

/// The edges of a pane that are drawn, from the floor up to a lid, or fading out where the bounds are its only upper
/// end: visit(a, b, whether a, whether b is where it has faded out).
template <class Visit>
void eachPaneEdge(const Face& shown, double floor, const Top& top, const Visit& visit) {
  const size_t n = shown.corners.size();
  if (n < 3) return;
  const auto faded = [&](const Vector3& p) { return top.open && p[1] > top.height - 1e-6; };
  for (size_t i = 0; i < n; ++i) {
    const Vector3 &a = shown.corners[i], &b = shown.corners[(i + 1) % n];
    if (faded(a) && faded(b)) continue;
    if (isLevel(a, b) && std::min(a[1], b[1]) < floor + 1e-6) continue;  // the rim is there
    visit(a, b, faded(a), faded(b));
  }
}

void addPane(Furniture& out, const Face& shown, const Top& top) {
  eachPaneEdge(shown, out.floor, top, [&](const Vector3& a, const Vector3& b, bool fadedA, bool fadedB) {
    // Upright edges belong to two panes and get half from each.
    const double opacity = isLevel(a, b) ? 0.42 : 0.22;
    addFaded(out.edges, a, b, fadedA ? 0 : opacity, fadedB ? 0 : opacity);
  });
}

void placeFloor(Furniture& out, const Environment& environment) {
  out.floor = static_cast<float>(environment.boundsMinimum[1]);
  Vector3 low = environment.boundsMinimum, high = environment.boundsMaximum;
  double largest = 0;
  for (size_t i = 0; i < environment.walls.size(); ++i) {
    if (isRound(environment, i) || roleOf(environment.walls[i]) != Role::Floor) continue;
    const Face face = wallFace(environment, i);
    if (face.corners.size() < 3) continue;
    Vector3 first = face.corners[0], last = face.corners[0];
    for (const Vector3& p : face.corners) first = first.cwiseMin(p), last = last.cwiseMax(p);
    const double area = (last[0] - first[0]) * (last[2] - first[2]);
    if (area <= largest) continue;
    largest = area;
    low = first;
    high = last;
    out.hasFloor = true;
    out.floor = static_cast<float>((first[1] + last[1]) / 2);
    out.floorHeat = static_cast<float>(glowOf(environment.walls[i]));
  }
  out.centre = {static_cast<float>(low[0] + high[0]) / 2, static_cast<float>(low[2] + high[2]) / 2};
  out.half = {static_cast<float>(high[0] - low[0]) / 2, static_cast<float>(high[2] - low[2]) / 2};
  out.size = std::max({2 * out.half[0], 2 * out.half[1], 1e-4f});
}

Top topOf(const Environment& environment, const Furniture& floor) {
  Top top{floor.floor + 0.55 * floor.size};
  for (size_t i = 0; i < environment.walls.size(); ++i) {
    if (isRound(environment, i) || roleOf(environment.walls[i]) != Role::Lid) continue;
    const Face face = wallFace(environment, i);
    for (const Vector3& p : face.corners) top.height = top.open ? p[1] : std::max(top.height, p[1]), top.open = false;
    top.lid = top.lid || !face.corners.empty();
  }
  if (top.open) top.height = std::min(top.height, environment.boundsMaximum[1]);
  return top;
}

using Lines = std::vector<std::pair<Vector3, Vector3>>;
constexpr int kAround = 48;  // corners of a ring

void addRing(Lines& lines, const Vector3& centre, const Vector3& u, const Vector3& v) {
  const auto corner = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / kAround;
    return Vector3(centre + std::cos(angle) * u + std::sin(angle) * v);
  };
  for (int k = 0; k < kAround; ++k) lines.emplace_back(corner(k), corner(k + 1));
}

Lines sphereLines(const WallFace& face, const std::vector<Plane>& ends) {
  Lines all, seen;
  for (Eigen::Index a = 0; a < 3; ++a)
    addRing(all, face.centre(), face.radius() * Vector3::Unit((a + 1) % 3), face.radius() * Vector3::Unit((a + 2) % 3));
  const auto isSeen = [&](const std::pair<Vector3, Vector3>& line) {
    return std::all_of(ends.begin(), ends.end(), [&](const Plane& end) {
      return end.heightOf(line.first) > -1e-9 && end.heightOf(line.second) > -1e-9;
    });
  };
  std::copy_if(all.begin(), all.end(), std::back_inserter(seen), isSeen);
  return seen;
}

/// What is seen of a cylinder: from where its axis comes into the scene to where it leaves it, and two radii across.
struct Barrel {
  Vector3 low, high, u, v;  // m
};

/// Nothing of one that stands beside the scene.
std::optional<Barrel> barrelOf(const WallFace& face, const std::vector<Plane>& ends) {
  double from = -1e4, to = 1e4;
  for (const Plane& end : ends) {
    const double rise = end.normal.dot(face.axis()), height = end.heightOf(face.centre());
    if (rise > 1e-6) from = std::max(from, -height / rise);
    if (rise < -1e-6) to = std::min(to, -height / rise);
  }
  if (!(from < to)) return std::nullopt;
  const Vector3 u = face.radius() * face.axis().unitOrthogonal();
  return Barrel{face.centre() + from * face.axis(), face.centre() + to * face.axis(), u, face.axis().cross(u)};
}

Lines cylinderLines(const WallFace& face, const std::vector<Plane>& ends) {
  constexpr int kStraight = 8;
  Lines lines;
  const std::optional<Barrel> barrel = barrelOf(face, ends);
  if (!barrel) return lines;
  const auto& [low, high, u, v] = *barrel;
  addRing(lines, low, u, v);
  addRing(lines, high, u, v);
  for (int k = 0; k < kStraight; ++k) {
    const double angle = 2 * std::numbers::pi * k / kStraight;
    const Vector3 out = std::cos(angle) * u + std::sin(angle) * v;
    lines.emplace_back(low + out, high + out);
  }
  return lines;
}

/// Where what is seen of a curved wall ends.
std::vector<Plane> endsOf(const Environment& environment, size_t wall, const WallFace& face) {
  Furniture floor;
  placeFloor(floor, environment);
  std::vector<Plane> ends;
  for (const Cut& cut : cutsOf(environment, wall)) {
    if (cut.wall || face.form() == WallForm::Cylinder) ends.push_back(cut.plane);
  }
  const bool fades = face.form() == WallForm::Cylinder && std::abs(face.axis().y()) > kLevel;
  if (fades) ends.push_back({{0, -1, 0}, -topOf(environment, floor).height});
  return ends;
}

/// The polygon as a fan of triangles; normals are the face's.
void addCurved(std::vector<MeshVertex>& out, const Face& shown, const WallFace& face,
               const std::array<float, 4>& material) {
  for (size_t k = 2; k < shown.corners.size(); ++k) {
    for (const size_t i : {size_t{0}, k - 1, k})
      out.push_back({floats(shown.corners[i]), floats(face.at(shown.corners[i]).normal), material});
  }
}

/// A curved wall as glass: what is seen of it, in facets.
void addGlass(std::vector<MeshVertex>& out, const Environment& environment, size_t wall,
              const std::optional<Section>& section, const std::array<float, 4>& material) {
  const WallFace face = faceOf(environment.walls[wall]);
  if (!face.isCurved()) return;
  const std::vector<Plane> ends = endsOf(environment, wall, face);
  const auto addLeft = [&](Face quad) {
    if (section) clip(quad, {section->plane, false});
    addCurved(out, quad, face, material);
  };
  const auto step = [](int k) { return 2 * std::numbers::pi * k / kAround; };
  if (face.form() == WallForm::Cylinder) {
    const std::optional<Barrel> barrel = barrelOf(face, ends);
    for (int k = 0; barrel && k < kAround; ++k) {
      const auto across = [&](double a) { return Vector3(std::cos(a) * barrel->u + std::sin(a) * barrel->v); };
      const Vector3 a = across(step(k)), b = across(step(k + 1));
      addLeft({{barrel->low + a, barrel->low + b, barrel->high + b, barrel->high + a}, {false, false, false, false}});
    }
    return;
  }
  const auto place = [&](int up, int around) {
    const double latitude = step(up) - std::numbers::pi / 2, r = std::cos(latitude);
    return Vector3(face.centre() +
                   face.radius() * Vector3(r * std::cos(step(around)), std::sin(latitude), r * std::sin(step(around))));
  };
  for (int up = 0; up < kAround / 2; ++up) {
    for (int k = 0; k < kAround; ++k) {
      Face quad{{place(up, k), place(up, k + 1), place(up + 1, k + 1), place(up + 1, k)}, {false, false, false, false}};
      for (const Plane& end : ends) clip(quad, {end, false});
      addLeft(std::move(quad));
    }
  }
}

}  // namespace

void addEdge(std::vector<EdgeVertex>& out, const Vector3& a, const Vector3& b, double opacity) {
  addFaded(out, a, b, opacity, opacity);
}

double glowOf(const SceneWall& wall) {
  if (!hasTemperature(wall)) return 0;
  const double kelvin = numberOf(wall.parameters, wallParameters(), "temperature");
  const double t = std::clamp((kelvin - 310) / (440 - 310), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Face wallFace(const Environment& environment, size_t wall) {
  if (isRound(environment, wall)) return {};
  const Vector3 normal = environment.walls[wall].normal.normalized();
  const Vector3 helper = std::abs(normal[1]) < 0.9 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
  const Vector3 u = helper.cross(normal).normalized(), v = normal.cross(u);
  const double far = 1e3 + 10 * (std::abs(environment.boundsMaximum[0]) + std::abs(environment.boundsMinimum[0]));
  const Vector3& p = environment.walls[wall].point;
  Face face{{p - far * u - far * v, p + far * u - far * v, p + far * u + far * v, p - far * u + far * v},
            {false, false, false, false}};
  for (const Cut& cut : cutsOf(environment, wall)) {
    // A wall on the bounds themselves, or just outside of them, is still seen.
    if (!cut.wall && std::abs(cut.plane.normal.dot(normal)) > 0.999) continue;
    clip(face, cut);
  }
  return face.corners.size() >= 3 ? face : Face{};
}

Face seenFace(const Environment& environment, size_t wall) {
  Face face = wallFace(environment, wall);
  if (face.corners.empty() || roleOf(environment.walls[wall]) != Role::Side) return face;
  Furniture floor;
  placeFloor(floor, environment);
  clip(face, {{{0, -1, 0}, -topOf(environment, floor).height}, false});
  return face.corners.size() >= 3 ? face : Face{};
}

Face leftOf(const Environment& environment, size_t wall, const std::optional<Section>& section) {
  const Face whole = seenFace(environment, wall);
  if (!section || whole.corners.empty()) return whole;
  Face left = whole;
  clip(left, {section->plane, false});
  if (left.corners.size() < 3) return {};
  return roleOf(environment.walls[wall]) == Role::Floor ? whole : left;
}

std::vector<std::pair<Vector3, Vector3>> paneLines(const Environment& environment, size_t wall,
                                                   const std::optional<Section>& section) {
  constexpr double kSeen = 2.0 / 3;  // of an edge that fades: beyond, less than a third of its ink is left
  Lines lines;
  if (isRound(environment, wall) || roleOf(environment.walls[wall]) != Role::Side) return lines;
  Furniture floor;
  placeFloor(floor, environment);
  eachPaneEdge(leftOf(environment, wall, section), floor.floor, topOf(environment, floor),
               [&](const Vector3& a, const Vector3& b, bool fadedA, bool fadedB) {
                 lines.emplace_back(fadedA ? Vector3(b + kSeen * (a - b)) : a,
                                    fadedB ? Vector3(a + kSeen * (b - a)) : b);
               });
  return lines;
}

std::vector<std::pair<Vector3, Vector3>> roundLines(const Environment& environment, size_t wall, bool whole) {
  const WallFace face = faceOf(environment.walls[wall]);
  if (!face.isCurved()) return {};
  if (face.form() == WallForm::Sphere)
    return sphereLines(face, whole ? std::vector<Plane>{} : endsOf(environment, wall, face));
  return cylinderLines(face, endsOf(environment, wall, face));
}

Extent extentOf(const std::vector<MeshVertex>& mesh) {
  Extent extent;
  for (const MeshVertex& corner : mesh) extent.add(corner.position[0], corner.position[1], corner.position[2], 0);
  return extent;
}

bool sameFurniture(const Environment& a, const Environment& b) {
  return a.boundsMinimum == b.boundsMinimum && a.boundsMaximum == b.boundsMaximum &&
         std::equal(a.walls.begin(), a.walls.end(), b.walls.begin(), b.walls.end(),
                    [](const SceneWall& v, const SceneWall& w) {
                      return v.point == w.point && v.normal == w.normal && v.parameters == w.parameters &&
                             v.visible == w.visible;
                    });
}

Furniture buildFurniture(const Environment& environment, bool dark, const std::optional<Section>& section) {
  Furniture out;
  placeFloor(out, environment);
  const double size = out.size, thickness = 0.065 * size, margin = 0.07 * size;
  out.ground = out.floor - static_cast<float>(out.hasFloor ? thickness + 0.035 * size : 0.02 * size);
  const Top top = topOf(environment, out);
  out.hasLid = top.lid;
  out.lidHeight = static_cast<float>(top.height);
  out.hasFloor = false;  // until it is seen that a section leaves one
  const Colour lid = sceneColour(dark, "lid");
  for (size_t i = 0; i < environment.walls.size(); ++i) {
    if (!environment.walls[i].visible) continue;
    constexpr double kRound = 0.3, kGlass = 0.06;
    addGlass(out.clear, environment, i, section, with(lid, kGlass));
    for (const auto& [from, to] : ps::leftOf(roundLines(environment, i), section)) addEdge(out.edges, from, to, kRound);
    const Face face = leftOf(environment, i, section);
    if (face.corners.empty()) continue;
    const Vector3 normal = environment.walls[i].normal.normalized();
    switch (roleOf(environment.walls[i])) {
      case Role::Floor: {
        out.hasFloor = true;
        addSlab(out.opaque, face.corners, normal, {margin, 0.05 * size, 0.012 * size, thickness},
                with(sceneColour(dark, "metal"), Kind::PlateTop), with(sceneColour(dark, "rim"), Kind::PlateSide));
        std::vector<Vector3> foot = offsetOutline(face.corners, normal, -0.05 * size);
        for (Vector3& p : foot) p -= 0.9 * thickness * normal;
        const auto shade = with(sceneColour(dark, "foot"), Kind::Dark);
        addSlab(out.opaque, foot, normal, {0, 0.03 * size, 0.004 * size, 0.1 * thickness + 0.035 * size}, shade, shade);
        addRim(out.opaque, face, normal, 0.010 * size, 0.022 * size, with(sceneColour(dark, "rim"), Kind::PlateSide));
        break;
      }
      case Role::Lid:
        addSlab(out.clear, face.corners, normal, {0.02 * size, 0.025 * size, 0.004 * size, 0.022 * size},
                with(lid, 0.16), with(lid, 0.22));
        break;
      case Role::Side:
        addPane(out, face, top);
        break;
    }
  }
  out.opaqueExtent = extentOf(out.opaque);
  return out;
}

}  // namespace ps::render
