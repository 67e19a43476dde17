// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/radiation.h"

#include "core/base/parallelarrays.h"
#include "core/solver/contact/wallplane.h"
#include "core/solver/heat/raysample.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace ps {
namespace {

constexpr double kLift = 0.001;   ///< spacings beyond a face at which its rays begin
constexpr double kNear = 2.5;     ///< spacings within which matter of one body is its own surface's roughness
constexpr double kSameWay = 0.5;  ///< cosine between normals of matter that faces the same way
/// Sum of V W below which a particle may miss a neighbour: with one gone it falls by 0.07.
constexpr float kWhole = 0.98f;
constexpr double kFar = 1e30;
constexpr size_t kMostPerParticle = 64, kLeastPerParticle = 2;
/// Mirrors and grey surfaces that a ray follows; what is still between them then exchanges nothing.
constexpr int kMostMet = 64;

bool exchanges(const Wall& wall) {
  return wall.heat == WallHeat::FixedTemperature || wall.heat == WallHeat::Convective;
}

/// Bounds may lie in the walls themselves: a spacing more counts as within.
bool within(const Bounds& bounds, const Vector3& x, double spacing) {
  const api::Double3 &low = bounds.minimum, &high = bounds.maximum;
  const auto inside = [&](size_t axis, double at, double from, double to) {
    return bounds.periodic[axis] || (at >= from - spacing && at <= to + spacing);
  };
  return inside(0, x.x(), low.x, high.x) && inside(1, x.y(), low.y, high.y) && inside(2, x.z(), low.z, high.z);
}

/// In [0, 1); moves on to the next number.
double nextUnit(uint32_t& chance) {
  chance = scattered(chance + 0x9e3779b9u);
  return RaySamples::unit(chance);
}

bool happens(double share, uint32_t& chance) { return nextUnit(chance) < share; }

/// The bare face of some number among them.
size_t faceOf(const SurfaceBox& box, size_t number) {
  size_t left = number;
  for (size_t face = 0;; ++face) {
    if (box.isBare(face) && left-- == 0) return face;
  }
}

}  // namespace

std::pair<size_t, double> Radiation::nearestWall(const Ray& ray) const {
  constexpr double kRounding = 1 + 1e-12;
  std::pair<size_t, double> nearest{m_mirrors.size(), kFar};
  for (size_t w = 0; w < m_mirrors.size(); ++w) {
    const WallFace& face = m_mirrors[w].face;
    if (face.isCurved()) {
      const std::optional<double> distance = face.meets(ray.from, ray.way);
      if (distance && *distance < nearest.second) nearest = {w, *distance};
      continue;
    }
    const Plane& plane = face.plane();
    const double towards = -plane.normal.dot(ray.way), height = plane.heightOf(ray.from);
    // Most are farther than one that is known, which is told without a division.
    if (!(towards > 0) || height > kRounding * nearest.second * towards) continue;
    const double distance = std::max(0.0, height / towards);
    if (distance < nearest.second) nearest = {w, distance};
  }
  return nearest;
}

void Radiation::forget() {
  m_found.forget();
  m_begin.clear();
  m_sights.clear();
  m_narrowestGap = 0;
}

void Radiation::trace(const RadiationScene& scene) {
  const size_t n = scene.store.size();
  m_walls = scene.walls.size();
  m_mirrors.clear();
  for (const Wall& wall : scene.walls) m_mirrors.push_back({faceOf(wall), exchanges(wall)});
  assignAll(m_sky, n, 0.0f);
  assignAll(m_wall, n * m_walls, 0.0f);
  findBoxes(scene);
  m_perParticle = kMostPerParticle;
  while (m_perParticle > kLeastPerParticle && m_perParticle * m_emitters.size() > kRays) m_perParticle /= 2;
  m_grid.build(scene.store, m_boxes, m_boxOf, scene.spacing);
  m_met.assign(m_emitters.size() * m_perParticle, RayGrid::kNone);
  m_area.resize(m_met.size());
  m_outer.assign(m_emitters.size(), 0.0f);
  forChunks(m_emitters.size(), grain::kRays, [&](size_t first, size_t last) { follow(scene, first, last); });
  scaleToBodies(scene);
  couple(n);
}

void Radiation::findBoxes(const RadiationScene& scene) {
  const ParticleStore& store = scene.store;
  assignAll(m_boxOf, store.size(), uint32_t{RayGrid::kNone});
  m_boxes.clear();
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] == api::Motion::Gas) continue;
    if (scene.surface.open(i) == 0 && scene.filled[i] >= kWhole) continue;
    m_boxOf[i] = static_cast<uint32_t>(m_boxes.size());
    m_boxes.emplace_back().particle = static_cast<uint32_t>(i);
  }
  m_found.find({store, scene.walls, scene.surface, scene.filled, scene.level, scene.spacing}, scene.lists, m_boxes);
  m_emitters.clear();
  m_narrowestGap = 0;
  for (size_t b = 0; b < m_boxes.size(); ++b) {
    const double gap = double{m_boxes[b].gap};
    if (gap > 0 && (m_narrowestGap == 0 || gap < m_narrowestGap)) m_narrowestGap = gap;
    if (m_boxes[b].bare != 0 && scene.emissivity[store.material()[m_boxes[b].particle]] > 0)
      m_emitters.push_back(static_cast<uint32_t>(b));
  }
}

void Radiation::follow(const RadiationScene& scene, size_t first, size_t last) {
  for (size_t e = first; e < last; ++e) {
    const RaySamples samples(scene.store.id()[m_boxes[m_emitters[e]].particle]);
    for (size_t k = 0; k < m_perParticle; ++k) followOne(scene, e, samples, k);
  }
}

void Radiation::followOne(const RadiationScene& scene, size_t emitter, const RaySamples& samples, size_t k) {
  const SurfaceBox& box = m_boxes[m_emitters[emitter]];
  const uint32_t i = box.particle;
  const auto index = static_cast<uint32_t>(scene.frame * m_perParticle + k);
  const size_t faces = static_cast<size_t>(std::popcount(box.bare));
  // Faces that are more than the rays of a frame take turns, so that none is left out.
  const bool turns = faces > m_perParticle;
  const size_t which = (turns ? index : k) % faces, face = faceOf(box, which);
  const size_t parts = turns ? m_perParticle : faces * ((m_perParticle - which + faces - 1) / faces);
  const double area = double{box.area} / static_cast<double>(parts), dx = scene.spacing;
  const double emissivity = scene.emissivity[scene.store.material()[i]];
  const Vector3 normal = box.normal(face), one = box.axis((face / 2 + 1) % 3), other = box.axis((face / 2 + 2) % 3);
  const double lift = (face == 0 ? double{box.height} : 0.5) + kLift;
  Ray ray;
  ray.from = vectorOf(scene.store.position()[i]) + lift * dx * normal + (samples.at(index, 2) - 0.5) * dx * one +
             (samples.at(index, 3) - 0.5) * dx * other;
  ray.way = diffuse(normal, one, other, samples.at(index, 0), samples.at(index, 1));
  ray.source = i;
  ray.first = ray.straight = true;
  ray.chance = scattered(scene.store.id()[i]) + index;
  const End end = endOf(scene, ray);
  if (end.covered) return;
  m_outer[emitter] += static_cast<float>(area);
  const auto part = static_cast<float>(area * emissivity);
  if (end.particle != RayGrid::kNone) {
    m_met[emitter * m_perParticle + k] = end.particle;
    m_area[emitter * m_perParticle + k] = part;
  } else if (end.sky) {
    m_sky[i] += part;
  } else if (end.wall < scene.walls.size()) {
    m_wall[i * m_walls + end.wall] += part;
  }
}

bool Radiation::isNear(const RadiationScene& scene, uint32_t one, uint32_t other) const {
  const double reach = kNear * scene.spacing;
  return vectorOf(scene.store.separation(one, other)).squaredNorm() < reach * reach;
}

bool Radiation::passes(const RadiationScene& scene, const Ray& ray, const RayGrid::Hit& hit) const {
  if (hit.particle == ray.source) return ray.straight;
  if (!ray.straight || !isNear(scene, ray.source, hit.particle)) return false;
  const SurfaceBox& own = m_boxes[m_boxOf[ray.source]];
  const bool sameBody = scene.store.body()[ray.source] == scene.store.body()[hit.particle];
  if (!own.turned) return !sameBody && !(hit.distance > 0);
  if (sameBody || !(hit.distance > 0)) return true;
  const uint32_t box = m_boxOf[hit.particle];
  if (box == RayGrid::kNone) return false;
  const Vector3 here = own.meanNormal(), there = m_boxes[box].meanNormal();
  return here.dot(there) > kSameWay * std::sqrt(here.squaredNorm() * there.squaredNorm());
}

/// Whether a face is covered by the turned cubes of its own body beside it.
bool Radiation::isCovered(const RadiationScene& scene, const Ray& ray, const RayGrid::Hit& hit) const {
  const uint32_t* body = scene.store.body();
  if (!ray.first || !ray.straight || body[hit.particle] != body[ray.source]) return false;
  const uint32_t box = m_boxOf[hit.particle];
  const bool smoothed = box == RayGrid::kNone || m_boxes[box].turned || !(hit.distance > 0);
  return smoothed && isNear(scene, ray.source, hit.particle);
}

bool Radiation::reflect(const RadiationScene& scene, const RayGrid::Hit& hit, Ray& ray) const {
  if (hit.face < 0) return false;
  const SurfaceBox& box = m_boxes[m_boxOf[hit.particle]];
  const auto face = static_cast<size_t>(hit.face);
  const Vector3 normal = box.normal(face);
  ray.from += hit.distance * ray.way + kLift * scene.spacing * normal;
  const double u = nextUnit(ray.chance), v = nextUnit(ray.chance);
  ray.way = diffuse(normal, box.axis((face / 2 + 1) % 3), box.axis((face / 2 + 2) % 3), u, v);
  ray.source = hit.particle;
  ray.first = false;
  ray.straight = true;
  return true;
}

Radiation::End Radiation::endOf(const RadiationScene& scene, Ray ray) const {
  const End nowhere{RayGrid::kNone, scene.walls.size(), false, false};
  for (int met = 0; met <= kMostMet; ++met) {
    const auto [nearest, distance] = nearestWall(ray);
    const RayGrid::Hit hit = m_grid.firstOn(scene.store, ray.from, ray.way, distance,
                                            [&](const RayGrid::Hit& there) { return passes(scene, ray, there); });
    if (hit.particle != RayGrid::kNone) {
      if (isCovered(scene, ray, hit)) return {RayGrid::kNone, nowhere.wall, false, true};
      const double absorbed = scene.emissivity[scene.store.material()[hit.particle]];
      if (happens(absorbed, ray.chance) || !reflect(scene, hit, ray)) return {hit.particle, nowhere.wall, false, false};
      continue;
    }
    if (nearest == m_mirrors.size()) return {RayGrid::kNone, nearest, m_grid.comesOut(ray.way), false};
    const Mirror& mirror = m_mirrors[nearest];
    if (mirror.exchanges && happens(scene.walls[nearest].emissivity, ray.chance))
      return {RayGrid::kNone, nearest, false, false};
    ray.from += distance * ray.way;
    if (!mirror.exchanges && !within(scene.bounds, ray.from, scene.spacing))
      return {RayGrid::kNone, nowhere.wall, true, false};
    const Vector3 normal = mirror.face.at(ray.from).normal;
    ray.way -= 2 * normal.dot(ray.way) * normal;
    ray.straight = false;
  }
  return nowhere;
}

/// Brings bodies of given area to it.
void Radiation::scaleToBodies(const RadiationScene& scene) {
  const std::span<const double> given = scene.givenArea;
  if (std::none_of(given.begin(), given.end(), [](double area) { return area > 0; })) return;
  const uint32_t* body = scene.store.body();
  m_areaOf.assign(given.size(), 0);
  for (size_t e = 0; e < m_emitters.size(); ++e) {
    const uint32_t b = body[m_boxes[m_emitters[e]].particle];
    if (b < given.size()) m_areaOf[b] += double{m_outer[e]};
  }
  for (size_t e = 0; e < m_emitters.size(); ++e) {
    const uint32_t i = m_boxes[m_emitters[e]].particle, b = body[i];
    if (b >= given.size() || !(given[b] > 0) || !(m_areaOf[b] > 0)) continue;
    const auto scale = static_cast<float>(given[b] / m_areaOf[b]);
    m_sky[i] *= scale;
    for (size_t w = 0; w < m_walls; ++w) m_wall[i * m_walls + w] *= scale;
    for (size_t k = 0; k < m_perParticle; ++k) m_area[e * m_perParticle + k] *= scale;
  }
}

/// Lists of who sees whom from the rays, in order of rays: both ends of a ray carry the same area.
void Radiation::couple(size_t count) {
  m_begin.assign(count + 1, 0);
  const auto source = [&](size_t ray) { return m_boxes[m_emitters[ray / m_perParticle]].particle; };
  for (size_t r = 0; r < m_met.size(); ++r) {
    if (m_met[r] == RayGrid::kNone) continue;
    ++m_begin[source(r) + 1];
    ++m_begin[m_met[r] + 1];
  }
  for (size_t i = 0; i < count; ++i) m_begin[i + 1] += m_begin[i];
  m_sights.resize(m_begin[count]);
  m_next.assign(m_begin.begin(), m_begin.end());
  for (size_t r = 0; r < m_met.size(); ++r) {
    if (m_met[r] == RayGrid::kNone) continue;
    const uint32_t i = source(r), j = m_met[r];
    m_sights[m_next[i]++] = {j, 0.5f * m_area[r]};
    m_sights[m_next[j]++] = {i, 0.5f * m_area[r]};
  }
}

}  // namespace ps
