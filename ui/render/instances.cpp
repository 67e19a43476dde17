// SPDX-License-Identifier: Apache-2.0
#include "ui/render/instances.h"

#include "core/base/parallel.h"
#include "ui/render/colourmap.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ps::render {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;
constexpr float kHeldLighter = 0.08f;    // towards white: what is held until it is let go
constexpr float kTouching = 2.5f;        // radii, cells in which particles that touch are neighbours
constexpr size_t kPiece = 8;             // particles of the smallest piece that gets an outline beside larger ones
constexpr float kSurfaceGrowth = 1.25f;  // a liquid's surface lies about this far out, in radii of its particles

// Index in the previous snapshot by index in this one; empty when both have the same order.
std::vector<uint32_t> matchById(const Snapshot& now, const Snapshot& previous) {
  if (now.id == previous.id) return {};
  std::vector<std::pair<uint32_t, uint32_t>> old(previous.id.size());
  for (size_t i = 0; i < old.size(); ++i) old[i] = {previous.id[i], static_cast<uint32_t>(i)};
  std::sort(old.begin(), old.end());
  std::vector<uint32_t> match(now.id.size(), kNone);
  for (size_t i = 0; i < match.size(); ++i) {
    const auto found = std::lower_bound(old.begin(), old.end(), std::pair<uint32_t, uint32_t>{now.id[i], 0});
    if (found != old.end() && found->first == now.id[i]) match[i] = found->second;
  }
  return match;
}

float luma(const Colour& c) { return 0.299f * c[0] + 0.587f * c[1] + 0.114f * c[2]; }

Colour towardsWhite(const Colour& c, float amount) {
  return {c[0] + (1 - c[0]) * amount, c[1] + (1 - c[1]) * amount, c[2] + (1 - c[2]) * amount};
}

/// sRGB and clearness.
std::array<float, 4> lookOf(const Snapshot& s, size_t i) {
  const size_t material = s.material[i];
  if (const uint32_t own = i < s.colour.size() ? s.colour[i] : 0; own != 0) {
    const auto part = [&](int shift) { return static_cast<float>((own >> shift) & 0xff) / 255; };
    return {part(16), part(8), part(0), material < s.materialLook.size() ? s.materialLook[material][3] : 0};
  }
  return material < s.materialLook.size() ? s.materialLook[material] : std::array<float, 4>{0.6f, 0.6f, 0.6f, 0};
}

// The three states of one material look different: clear matter scatters light when it is frozen, foam is white.
Colour materialColour(const Snapshot& s, size_t i) {
  const auto [red, green, blue, clearness] = lookOf(s, i);
  const Colour own{red, green, blue};
  const float light = luma(own), scatter = std::sqrt(light) * (1 - 0.85f * light);
  switch (s.motion[i]) {
    case api::Motion::Static:
      return own;
    case api::Motion::Solid:
      return towardsWhite(own, (s.phase[i] == api::Phase::Solid ? 0.85f : 0.5f) * scatter * clearness);
    case api::Motion::Liquid:
      return towardsWhite(own, 0.7f * std::clamp(s.gasFraction[i], 0.f, 1.f));
    case api::Motion::Gas:
      break;
  }
  return own;
}

/// As shaders read it: a Kind, and for solids and liquids its clearness in steps above it. `surface`: it is part of a
/// liquid's.
float kindOf(const InstanceRequest& request, size_t i, Pattern pattern, bool surface) {
  const Snapshot& s = *request.now;
  if (pattern != Pattern::Plain)
    return static_cast<float>(surface ? Kind::Wet : Kind::Patterned) + static_cast<float>(pattern);
  if (s.motion[i] == api::Motion::Static) return static_cast<float>(Kind::Matte);
  if (request.colour != kMatterColour) return static_cast<float>(Kind::Plain);
  const bool flows = s.motion[i] == api::Motion::Liquid;
  const Kind kind = s.phase[i] == api::Phase::Solid && !flows ? Kind::Solid : Kind::Wet;
  return static_cast<float>(kind) + std::round(kClearest * std::clamp(lookOf(s, i)[3], 0.f, 1.f));
}

// Everything that does not depend on the order in which particles are drawn.
class Evaluator {
 public:
  explicit Evaluator(const InstanceRequest& request)
      : m_request(request),
        m_field(*request.now, request.colour),
        m_table(request.colour, request.minimum, request.maximum, request.meltingPoint),
        m_previous(usable(request) ? request.previous : nullptr),
        m_blend(std::clamp(request.blend, 0.f, 1.f)) {
    if (!m_previous) return;
    m_match = matchById(*request.now, *m_previous);
    if (m_field && !m_field.field().classes) m_before.emplace(*m_previous, request.colour);
  }

  /// Of the class that it is in, where the colours are of classes.
  Pattern patternAt(size_t i) const { return m_field ? patternOf(m_request.colour, m_field[i]) : Pattern::Plain; }

  Instance at(size_t i) const {
    const Snapshot& s = *m_request.now;
    const size_t old = !m_previous ? kNone : m_match.empty() ? i : m_match[i];
    const auto mix = [&](float now, float before) { return before + (now - before) * m_blend; };
    api::Float4 p = s.position[i];
    if (old != kNone) {
      const api::Float4& q = m_previous->position[old];
      // Through the face that it has crossed, not across the whole box.
      const auto along = [&](float now, float before, size_t axis) {
        return before + s.period.shortest(now - before, axis) * m_blend;
      };
      p = {along(p.x, q.x, 0), along(p.y, q.y, 1), along(p.z, q.z, 2), mix(p.w, q.w)};
    }
    const Colour c = colourOf(i, old);
    return {p.x, p.y, p.z, p.w, c[0], c[1], c[2], 0};
  }

 private:
  static bool usable(const InstanceRequest& request) {
    return request.previous && request.previous != request.now && request.blend < 1 &&
           request.previous->revision == request.now->revision;
  }

  Colour colourOf(size_t i, size_t old) const {
    const Snapshot& s = *m_request.now;
    if (!m_field) {
      const bool held = s.body[i] < s.heldBodies.size() && s.heldBodies[s.body[i]] != 0;
      return held ? towardsWhite(materialColour(s, i), kHeldLighter) : materialColour(s, i);
    }
    const float value = m_field[i];
    if (old == kNone || !m_before || !*m_before) return m_table.at(value);
    const float before = (*m_before)[old];
    return m_table.at(before + (value - before) * m_blend);
  }

  const InstanceRequest& m_request;
  ShownField m_field;
  std::optional<ShownField> m_before;  ///< where values lie between those of two snapshots
  ColourTable m_table;
  const Snapshot* m_previous;
  float m_blend;
  std::vector<uint32_t> m_match;
};

/// How many particles make a piece that gets an outline: a body that has fewer of them is no droplet of another.
size_t leastPiece(const InstanceRequest& request) {
  std::vector<size_t> counts(request.outlined.size());
  for (size_t i = 0; i < request.now->body.size(); ++i) {
    const uint32_t body = request.now->body[i];
    if (body < counts.size() && request.outlined[body] != 0 && request.now->motion[i] != api::Motion::Gas)
      ++counts[body];
  }
  size_t least = kPiece;
  for (const size_t count : counts) {
    if (count > 0) least = std::min(least, count);
  }
  return least;
}

// Puts the lists one after the other.
void arrange(const InstanceRequest& request, Instances& out) {
  std::vector<Instance>& all = out.particles;
  const float lattice = 2 * out.radius, coarse = 4 * out.radius;
  out.spheres = exposedFirst(out.sphereExtent, out.radius, lattice, 1, all);
  out.buriedSpheres = all.size() - out.spheres;
  std::rotate(all.begin(), all.begin() + static_cast<ptrdiff_t>(out.spheres), all.end());

  // Liquids have no lattice: a small cell may be empty deep within them.
  std::vector<Instance>& liquids = out.liquid;
  const size_t exposed = exposedFirst(out.liquidExtent, out.radius, coarse, 6, liquids);
  const auto surface = liquids.begin() + static_cast<ptrdiff_t>(exposed);
  out.dense = static_cast<size_t>(std::partition(liquids.begin(), surface, isDense) - liquids.begin());
  out.clear = exposed - out.dense;
  out.buriedLiquids = liquids.size() - exposed;
  const auto differs = [&](const Instance& p) { return p.extra != liquids[0].extra; };
  out.clearness.reset();
  if (!liquids.empty() && std::none_of(liquids.begin(), liquids.end(), differs))
    out.clearness = std::clamp((liquids[0].extra - static_cast<float>(Kind::Wet)) / kClearest, 0.f, 1.f);

  out.vapours = out.vapour.size();
  Extent extent;
  for (const Instance& p : out.outline) extent.add(p.x, p.y, p.z, p.radius);
  out.outline.resize(exposedFirst(extent, out.radius, lattice, 1, out.outline));
  out.outlined =
      out.outline.empty() ? 0 : piecesFirst(extent, kTouching * out.radius, leastPiece(request), out.outline);
  out.outline.resize(out.outlined);
  for (const std::vector<Instance>* list : {&out.liquid, &out.vapour, &out.ghost, &out.outline})
    all.insert(all.end(), list->begin(), list->end());
}

/// What moves of another run's matter, and can be seen from outside of it.
void collectGhost(const Snapshot* ghost, const std::optional<Section>& section, Instances& out) {
  out.ghost.clear();
  Extent extent;
  for (size_t i = 0; ghost && i < ghost->position.size(); ++i) {
    const auto& [x, y, z, radius] = ghost->position[i];
    if (ghost->motion[i] == api::Motion::Static || !std::isfinite(x + y + z + radius) || radius <= 0) continue;
    if (section && !section->shows({x, y, z})) continue;
    out.ghost.push_back({x, y, z, radius, 0, 0, 0, 0});
    extent.add(x, y, z, radius);
  }
  out.ghosts = exposedFirst(extent, out.radius, 4 * out.radius, 6, out.ghost);
  out.ghost.resize(out.ghosts);
}

}  // namespace

bool isDense(const Instance& p) { return p.extra < static_cast<float>(Kind::Wet) + kClearest / 2; }

bool Extent::holds(const Vector3& p) const {
  for (size_t k = 0; k < 3; ++k) {
    const double along = p[static_cast<Eigen::Index>(k)];
    if (along < static_cast<double>(minimum[k]) || along > static_cast<double>(maximum[k])) return false;
  }
  return true;
}

void Extent::add(float x, float y, float z, float radius) {
  const std::array<float, 3> p{x, y, z};
  for (size_t k = 0; k < 3; ++k) {
    minimum[k] = std::min(minimum[k], p[k] - radius);
    maximum[k] = std::max(maximum[k], p[k] + radius);
  }
}

std::array<Vector3, 8> Extent::corners() const {
  std::array<Vector3, 8> corners;
  for (size_t i = 0; i < 8; ++i)
    for (size_t k = 0; k < 3; ++k)
      corners[i][static_cast<Eigen::Index>(k)] = static_cast<double>(i >> k & 1 ? maximum[k] : minimum[k]);
  return corners;
}

void collectInstances(const InstanceRequest& request, Instances& out) {
  const Snapshot& s = *request.now;
  const size_t count = s.position.size();
  const Evaluator evaluator(request);
  std::vector<Instance>& all = out.all;
  all.resize(count);
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) all[i] = evaluator.at(i);
  });

  std::vector<Instance>&spheres = out.particles, &liquids = out.liquid, &vapours = out.vapour;
  spheres.clear();
  liquids.clear();
  vapours.clear();
  out.outline.clear();
  const bool data = request.colour != kMatterColour;
  double radii = 0;
  size_t counted = 0;
  for (size_t i = 0; i < count; ++i) {
    Instance& p = all[i];
    if (!std::isfinite(p.x + p.y + p.z + p.radius) || p.radius <= 0) continue;
    if (request.section && !request.section->shows({p.x, p.y, p.z})) continue;
    const api::Motion motion = s.motion[i];
    if (motion == api::Motion::Gas) {
      Instance cloud = p;
      cloud.extra = static_cast<float>(s.id[i] % 4096) * 0.731f;
      cloud.red = request.steam[0], cloud.green = request.steam[1], cloud.blue = request.steam[2];
      vapours.push_back(cloud);
      if (!data) continue;
      p.radius *= 0.32f;  // the parcel's point of data inside its cloud
      p.extra = static_cast<float>(Kind::Mote);
      spheres.push_back(p);
      continue;
    }
    if (motion != api::Motion::Static) {
      radii += static_cast<double>(p.radius);
      ++counted;
    }
    const bool surface = motion == api::Motion::Liquid && request.surfaces;
    p.extra = kindOf(request, i, evaluator.patternAt(i), surface);
    (surface ? liquids : spheres).push_back(p);
    if (s.body[i] >= request.outlined.size() || request.outlined[s.body[i]] == 0) continue;
    out.outline.push_back(p);
    if (surface) out.outline.back().radius *= kSurfaceGrowth;
  }
  if (counted) out.radius = static_cast<float>(radii / static_cast<double>(counted));
  out.sphereExtent = out.liquidExtent = out.vapourExtent = {};
  for (const Instance& p : spheres) out.sphereExtent.add(p.x, p.y, p.z, p.radius);
  for (const Instance& p : liquids) out.liquidExtent.add(p.x, p.y, p.z, p.radius * 1.6f);
  for (const Instance& p : vapours) out.vapourExtent.add(p.x, p.y, p.z, p.radius * 8);
  collectGhost(request.ghost, request.section, out);
  arrange(request, out);
}

}  // namespace ps::render
