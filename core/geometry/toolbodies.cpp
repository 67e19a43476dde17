// SPDX-License-Identifier: Apache-2.0
// Tools are closed parts side by side, kApart spacings from each other: faces that lie in one another would count as
// surfaces that liquid meets, and what is held in place needs nothing to hold it together.
#include "core/geometry/toolbodies.h"

#include "core/scene/solidform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

namespace ps {
namespace {

using Kind = ToolForm::Kind;

constexpr ToolForm kForms[] = {
    {Kind::Rod, "rod", "Rod", "A rod with round ends, to stir and poke."},
    {Kind::Plate, "tool-plate", "Plate", "A thin plate that stands upright, to push, press and scrape."},
    {Kind::Spoon, "spoon", "Spoon", "Half a ball with a handle, to scoop and pour."},
    {Kind::Sieve, "sieve", "Sieve", "A grid with a rim, through which liquid runs."},
    {Kind::Comb, "comb", "Comb", "A row of teeth, to draw furrows."},
    {Kind::Hand, "hand", "Hand", "A flat hand with fingers, to carry and press."},
};
constexpr double kApart = 0.02;                      // spacings
constexpr double kWall = 2, kOpening = 4, kRim = 4;  // spacings
constexpr int kAround = 32, kDown = 8;               // faces of a spoon
constexpr double kLeastBowl = 5, kLeastTooth = 8;    // spacings

/// Lengths in spacings, but for those of its making, m.
class Builder {
 public:
  Builder(double length, double spacing) : m_long(length / spacing), m_spacing(spacing) {}

  SceneMesh build(Kind kind) {
    if (kind == Kind::Spoon) spoon();
    if (kind == Kind::Sieve) sieve();
    if (kind == Kind::Comb) comb();
    if (kind == Kind::Hand) hand();
    return std::move(m_mesh);
  }

 private:
  uint32_t point(const Vector3& p) {
    const Vector3 place = m_spacing * p;
    m_mesh.points.push_back({static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])});
    return static_cast<uint32_t>(m_mesh.points.size() - 1);
  }
  void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    m_mesh.triangles.push_back({a, b, c});
    m_mesh.triangles.push_back({a, c, d});
  }
  void box(const Vector3& low, const Vector3& high) {
    std::array<uint32_t, 8> at{};
    for (uint32_t k = 0; k < 8; ++k)
      at[k] = point({k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]});
    quad(at[0], at[2], at[3], at[1]), quad(at[4], at[5], at[7], at[6]);
    quad(at[0], at[1], at[5], at[4]), quad(at[2], at[6], at[7], at[3]);
    quad(at[0], at[4], at[6], at[2]), quad(at[1], at[3], at[7], at[5]);
  }
  /// Half a ball, open at its top, which is at height 0.
  void bowl(double outer, double inner) {
    const auto ring = [&](double radius, int k) {
      const double down = 0.5 * std::numbers::pi * k / kDown;
      const auto first = static_cast<uint32_t>(m_mesh.points.size());
      for (int s = 0; s < kAround; ++s) {
        const double turn = 2 * std::numbers::pi * s / kAround, wide = radius * std::cos(down);
        point({wide * std::cos(turn), -radius * std::sin(down), wide * std::sin(turn)});
      }
      return first;
    };
    const auto join = [&](uint32_t upper, uint32_t lower, bool outwards) {
      for (uint32_t s = 0; s < kAround; ++s) {
        const uint32_t t = (s + 1) % kAround;
        if (outwards)
          quad(upper + s, upper + t, lower + t, lower + s);
        else
          quad(upper + s, lower + s, lower + t, upper + t);
      }
    };
    const auto shell = [&](double radius, bool outwards) {
      const uint32_t rim = ring(radius, 0);
      uint32_t last = rim;
      for (int k = 1; k < kDown; ++k) {
        const uint32_t next = ring(radius, k);
        join(last, next, outwards);
        last = next;
      }
      const uint32_t pole = point({0, -radius, 0});
      for (uint32_t s = 0; s < kAround; ++s) {
        const uint32_t t = (s + 1) % kAround;
        m_mesh.triangles.push_back(outwards ? std::array<uint32_t, 3>{last + s, last + t, pole}
                                            : std::array<uint32_t, 3>{last + t, last + s, pole});
      }
      return rim;
    };
    const uint32_t outside = shell(outer, true), inside = shell(inner, false);
    join(inside, outside, true);
  }

  void spoon() {
    const double radius = std::max(kLeastBowl, m_long / 5);
    bowl(radius, radius - kWall);
    box({radius + kApart, -kWall, -kWall}, {radius + kApart + std::max(2 * radius, 0.6 * m_long), 0, kWall});
  }
  void sieve() {
    const int holes = std::clamp(static_cast<int>(std::lround((0.6 * m_long - kWall) / (kWall + kOpening))), 3, 9);
    const double pitch = kWall + kOpening, half = 0.5 * (holes * pitch + kWall);
    const auto bar = [&](int k) { return k * pitch - half; };
    const auto top = [&](int k) { return k == 0 || k == holes ? kWall + kRim : kWall; };
    for (int k = 0; k <= holes; ++k) {
      box({-half, 0, bar(k)}, {half, top(k), bar(k) + kWall});
      for (int j = 0; j <= holes && k < holes; ++j)
        box({bar(j), 0, bar(k) + kWall + kApart}, {bar(j) + kWall, top(j), bar(k + 1) - kApart});
    }
    // Where the rim goes on over the bars that end at it.
    for (int k = 1; k < holes; ++k) {
      for (const int j : {0, holes})
        box({bar(j), kWall + kApart, bar(k)}, {bar(j) + kWall, kWall + kRim, bar(k) + kWall});
    }
    box({half + kApart, kRim, -kWall}, {half + kApart + 0.6 * m_long, kWall + kRim, kWall});
  }
  void comb() {
    const int teeth = std::clamp(static_cast<int>(std::lround(m_long / (kWall + kOpening))), 4, 12);
    const double pitch = kWall + kOpening, half = 0.5 * (teeth * pitch - kOpening);
    box({-half, 0, -0.5 * kWall}, {half, 2 * kWall, 0.5 * kWall});
    const double down = std::max(kLeastTooth, m_long / 3);
    for (int k = 0; k < teeth; ++k)
      box({k * pitch - half, -down, -0.5 * kWall}, {k * pitch - half + kWall, -kApart, 0.5 * kWall});
  }
  void hand() {
    const double finger = std::max(kWall, m_long / 10), gap = std::max(0.5 * kWall, 0.3 * finger);
    const double wide = 4 * finger + 3 * gap, palm = 0.9 * wide, thick = std::max(kWall, 0.7 * finger);
    box({-wide / 2, 0, 0}, {wide / 2, palm, thick});
    constexpr double kFingers[] = {0.7, 0.9, 1, 0.85};
    for (int k = 0; k < 4; ++k) {
      const double left = k * (finger + gap) - wide / 2;
      box({left, palm + kApart, 0}, {left + finger, palm + 0.8 * wide * kFingers[k], thick});
    }
    box({wide / 2 + kApart, 0.25 * palm, 0}, {wide / 2 + 0.55 * wide, 0.25 * palm + finger, thick});
  }

  double m_long, m_spacing;
  SceneMesh m_mesh;
};

}  // namespace

std::span<const ToolForm> toolForms() { return kForms; }

Body toolBody(ToolForm::Kind kind, double length, double spacing) {
  const ToolForm& form =
      *std::find_if(std::begin(kForms), std::end(kForms), [&](const ToolForm& one) { return one.kind == kind; });
  SolidShape solid;
  auto& values = solid.parameters.values;
  Vector3 size(length, length, length);
  if (kind == Kind::Rod) {
    values["kind"] = std::string("capsule");
    size[0] = size[2] = std::max(2 * kWall * spacing, length / 12);
  } else if (kind == Kind::Plate) {
    values["kind"] = std::string("block");
    size = {0.6 * length, 0.6 * length, kWall * spacing};
  } else {
    SceneMesh mesh = Builder(length, spacing).build(kind);
    mesh.id = form.id;
    mesh.name = form.name;
    const MeshBounds bounds = boundsOf(mesh);
    size = bounds.maximum - bounds.minimum;
    values["kind"] = std::string("mesh");
    values["fill"] = std::string("lattice");  // along which its parts lie; what is led has no surface to slide on
    solid.meshId = mesh.id;
    solid.mesh = std::make_shared<const SceneMesh>(std::move(mesh));
  }
  values["size_x"] = size[0], values["size_y"] = size[1], values["size_z"] = size[2];
  Body body;
  body.id = form.id;
  body.name = form.name;
  body.parameters.values["fixed"] = true;
  body.shape = std::move(solid);
  return body;
}

}  // namespace ps
