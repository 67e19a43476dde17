// SPDX-License-Identifier: Apache-2.0
#include "core/solver/frame/hovering.h"

#include "core/base/parallelarrays.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kWatch = 1;       ///< s
constexpr double kStill = 0.05;    ///< share of the speed of sinking
constexpr double kDenser = 0.002;  ///< least excess of density that counts
constexpr double kStokes = 0.05;   ///< share of Stokes's speed that walls may leave
constexpr double kYields = 0.02;   ///< least yield stress that may hold a piece, in its weight over its face
constexpr double kCarried = 0.3;   ///< rise of the liquid that may carry a piece, in speeds of sinking
/// A gap of one spacing below a piece is the layer of liquid that stays (TrappedFilm).
constexpr double kGap = 1;
/// Least cosine between the vertical and what is below, and to a wall's normal.
constexpr double kBelow = 0.3;
/// What fills less than this share of its kernel is not wet all around: a face in air has 0.7, and a body has so many
/// such particles if any side of it is dry.
constexpr double kFilled = 0.8, kDryShare = 0.02;

double densityOf(const ParticleStore& store, uint32_t i) {
  return double{store.mass()[i]} / double{store.position()[i].w};
}

}  // namespace

void Hovering::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                         std::span<const BakedMaterial> materials) {
  m_settings = settings;
  m_materials = materials;
  m_walls.clear();
  for (const Wall& wall : walls) m_walls.emplace_back(wall);
  m_kernel = Kernel(settings.kernel, settings.spacing * settings.supportRatio);
  m_halfSpace = HalfSpaceTable(m_kernel);
  const Vector3 gravity = vectorOf(settings.gravity);
  m_gravity = gravity.norm();
  m_up = Vector3::Zero();
  if (m_gravity > 0) m_up = -1 / m_gravity * gravity;
}

void Hovering::observe(const Matter& matter) {
  m_former.swap(m_pieces);
  m_pieces.clear();
  if (matter.wetSolids.empty() || m_up.isZero()) return;
  findPieces(matter);
  remember();
  const auto isDue = [](const Piece& piece) { return piece.seconds >= kWatch; };
  if (std::none_of(m_pieces.begin(), m_pieces.end(), isDue)) return;
  for (Piece& piece : m_pieces) {
    if (!isDue(piece)) continue;
    piece.solid = piece.liquid = 0;
    judge(matter, piece);
    piece.seconds = 0;
  }
}

void Hovering::findPieces(const Matter& matter) {
  const PieceLists& lists = matter.pieces;
  m_isWet.assign(lists.count(), 0);
  for (const uint32_t i : matter.wetSolids) {
    const uint32_t first = matter.pieceOf[i];
    if (first == ConstraintSystem::kNoPiece || m_isWet[lists.pieceOf(first)] != 0) continue;
    Piece& piece = m_pieces.emplace_back();
    piece.list = lists.pieceOf(first);
    m_isWet[piece.list] = 1;
  }
  if (m_pieces.empty()) return;
  m_hangs.clear();
  if (!matter.hanging.empty()) {
    assignAll(m_hangs, matter.store.size(), uint8_t{0});
    forChunks(matter.hanging.size(), grain::kNumbers, [&](size_t first, size_t last) {
      for (const uint32_t i : matter.hanging.subspan(first, last - first)) m_hangs[i] = 1;
    });
  }
  m_runs.clear();
  for (size_t p = 0; p < m_pieces.size(); ++p) {
    const std::span<const uint32_t> members = lists.members(m_pieces[p].list);
    for (size_t first = 0; first < members.size(); first += grain::kParticles)
      m_runs.push_back({p, members.subspan(first, std::min(grain::kParticles, members.size() - first))});
  }
  m_parts.assign(m_runs.size(), {});
  forChunks(m_runs.size(), 1, [&](size_t first, size_t last) {
    for (size_t r = first; r < last; ++r) add(matter, m_runs[r], m_parts[r]);
  });
  for (size_t r = 0; r < m_runs.size(); ++r) {
    Piece& piece = m_pieces[m_runs[r].piece];
    if (piece.id == kNone) piece.material = matter.store.material()[m_runs[r].members[0]];
    piece.id = std::min(piece.id, m_parts[r].id);
    piece.free = piece.free && m_parts[r].free;
    piece.mass += m_parts[r].mass;
    piece.volume += m_parts[r].volume;
    piece.moment += m_parts[r].moment;
  }
}

void Hovering::add(const Matter& matter, const Run& run, Piece& piece) const {
  const ParticleStore& store = matter.store;
  Piece sums;
  for (const uint32_t i : run.members) {
    const uint32_t body = store.body()[i];
    const bool thin = body < matter.thinBodies.size() && matter.thinBodies[body] != 0;
    if (store.velocity()[i].w == 0 || (!m_hangs.empty() && m_hangs[i] != 0) || thin) sums.free = false;
    sums.id = std::min(sums.id, store.id()[i]);
    const double mass = store.mass()[i];
    sums.mass += mass;
    sums.volume += double{store.position()[i].w};
    sums.moment += mass * vectorOf(store.position()[i]).dot(m_up);
  }
  piece = sums;
}

/// Goes on with what was watched in the frame before.
void Hovering::remember() {
  const auto byId = [](const Piece& a, const Piece& b) { return a.id < b.id; };
  std::sort(m_former.begin(), m_former.end(), byId);
  for (Piece& piece : m_pieces) {
    const auto found = std::lower_bound(m_former.begin(), m_former.end(), piece, byId);
    if (found != m_former.end() && found->id == piece.id) {
      piece.seconds = found->seconds, piece.start = found->start, piece.farthest = found->farthest;
      piece.solid = found->solid, piece.liquid = found->liquid;
    }
    if (piece.seconds == 0) piece.start = piece.height(), piece.farthest = 0;
    piece.seconds += m_settings.dt;
    piece.farthest = std::max(piece.farthest, std::abs(piece.height() - piece.start));
  }
}

double Hovering::wallShare(const api::Float4& at) const {
  const float nearest = static_cast<float>(0.5 * m_settings.spacing);
  double share = 0;
  for (const WallSurface& wall : m_walls) share += double{m_halfSpace.at(std::max(nearest, wall.heightOf(at))).share};
  return share;
}

/// Adds what is around a member.
void Hovering::lookAround(const Matter& matter, uint32_t i, Around& around) const {
  const ParticleStore& store = matter.store;
  const double spacing = m_settings.spacing;
  const api::Float4& at = store.position()[i];
  for (const WallSurface& wall : m_walls) {
    const WallPlane plane = wall.at(at);
    const bool below = Vector3{plane.x, plane.y, plane.z}.dot(m_up) > kBelow;
    around.stands = around.stands || (below && double{plane.heightOf(at)} < (kGap + 0.5) * spacing);
  }
  const api::NeighbourView view = matter.neighbours.view();
  double filled = double{at.w} * m_kernel.value(0) + wallShare(at);
  for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
    const uint32_t j = view.index[q];
    const api::Motion motion = store.motion()[j];
    if (motion == api::Motion::Gas) continue;
    const Vector3 line = vectorOf(store.separation(i, j));
    const double distance = line.norm();
    if (!(distance < m_kernel.supportRadius())) continue;
    filled += double{store.position()[j].w} * m_kernel.value(distance);
    if (motion != api::Motion::Liquid) {
      const bool other = matter.pieceOf[j] == ConstraintSystem::kNoPiece || matter.pieceOf[j] != matter.pieceOf[i];
      around.stands = around.stands || (other && distance < (kGap + 1) * spacing && line.dot(m_up) > kBelow * distance);
      continue;
    }
    const BakedMaterial& material = m_materials[store.material()[j]];
    const double temperature = store.temperature()[j];
    around.liquid += 1;
    around.density += densityOf(store, j);
    around.rise += vectorOf(store.velocity()[j]).dot(m_up);
    around.viscosity += material.viscosity(temperature);
    around.yieldStress = std::max(around.yieldStress, material.yieldStress(temperature));
  }
  ++around.members;
  around.dry += filled < kFilled ? 1 : 0;
}

void Hovering::Around::add(const Around& other) {
  liquid += other.liquid, density += other.density, rise += other.rise, viscosity += other.viscosity;
  yieldStress = std::max(yieldStress, other.yieldStress);
  members += other.members, dry += other.dry;
  stands = stands || other.stands;
}

/// Of one that stands on something the rest need not be known.
Hovering::Around Hovering::around(const Matter& matter, std::span<const uint32_t> members) {
  m_around.assign(chunkCount(members.size(), grain::kNeighbours), {});
  anyChunk(members.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    Around own;
    for (size_t k = first; k < last && !own.stands; ++k) lookAround(matter, members[k], own);
    m_around[first / grain::kNeighbours] = own;
    return own.stands;
  });
  Around all;
  for (const Around& some : m_around) all.add(some);
  return all;
}

void Hovering::judge(const Matter& matter, Piece& piece) {
  if (!piece.free) return;
  const double density = piece.mass / piece.volume, size = std::cbrt(piece.volume);
  const double fastest = std::sqrt(std::max(0.0, m_gravity * size));
  if (piece.farthest > kStill * fastest * piece.seconds) return;  // too fast in any liquid that is not much lighter
  const Around around = this->around(matter, matter.pieces.members(piece.list));
  if (around.stands || around.liquid == 0) return;
  if (static_cast<double>(around.dry) > kDryShare * static_cast<double>(around.members)) return;
  const double liquid = around.density / around.liquid, excess = density / liquid - 1;
  if (!(excess > kDenser) || around.yieldStress > kYields * excess * liquid * m_gravity * size) return;
  const double viscosity = around.viscosity / around.liquid, free = std::sqrt(excess) * fastest;
  const double thick = kStokes * excess * liquid * m_gravity * size * size / 18;
  const double sinks = thick < free * viscosity ? thick / viscosity : free;
  if (piece.farthest > kStill * sinks * piece.seconds || around.rise > kCarried * free * around.liquid) return;
  piece.solid = density;
  piece.liquid = liquid;
}

void Hovering::limits(std::vector<Limit>& out) const {
  for (size_t m = 0; m < m_materials.size(); ++m) {
    const Piece* worst = nullptr;
    for (const Piece& piece : m_pieces) {
      const bool hangs = piece.solid > 0 && piece.material == m;
      if (hangs && (!worst || piece.solid / piece.liquid > worst->solid / worst->liquid)) worst = &piece;
    }
    if (!worst) continue;
    Limit limit{std::string(m_materials[m].id()) + ".density_solid", worst->solid, worst->liquid, "kg/m³"};
    limit.why = "it should sink, but particles of this spacing hold it";
    limit.use = useOf("solver/particle_spacing", 0.5 * m_settings.spacing);
    out.push_back(std::move(limit));
  }
}

}  // namespace ps
