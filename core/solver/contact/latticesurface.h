// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/math/vector.h"
#include "core/solver/contact/nearneighbours.h"
#include "core/solver/truesurface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace ps {

/// Two solids touch face to face at this distance along the normal, in spacings.
inline constexpr double kFaceDistance = 1;
/// A face takes part as far beside a particle as half the diagonal of its lattice's squares reaches, in spacings.
inline constexpr double kFaceWidth = 0.75;
/// Least cosine between a face's normal and the line of centres.
inline constexpr double kFacing = 0.35;

/// The smoothed surface of lattices: a particle's outward normal points away from the neighbours of its own lattice,
/// and their number tells a face from an edge. Contact along it slides over a flat lattice as over a plane, where
/// single spheres would interlock. Neighbours are found when lists are made, normals from where they are now. Fixed
/// matter whose shape is known is met at its surface: the tangent planes at its particles, blended by distance from who
/// meets them (implicit moving least squares: Kolluri 2008, "Provably good moving least squares", eq. 1), so that the
/// normal turns smoothly where it is curved. Error: where its radius is R, it lies some d^2/R off.
class LatticeSurface {
 public:
  static constexpr uint32_t kNone = ~0u;
  /// Neighbours of the same lattice that count, at most: a cubic one has 18 within reach.
  static constexpr size_t kMostOwn = 32;
  /// A face has as many, of 18 inside, 13 in a face, 9 on an edge, 6 in a corner.
  static constexpr uint32_t kFaceNeighbours = 11;

  /// Neighbours of a particle in its own lattice.
  struct Own {
    std::array<uint32_t, kMostOwn> particles;
    uint32_t count = 0;
  };
  struct Normal {
    Vector3 normal;           ///< unit, outward; zero inside and where there is no lattice
    uint32_t neighbours = 0;  ///< as flat as that
    bool twoSided = false;    ///< a layer one particle thick: the other side is as good
    double lift = 0;          ///< m, by how much more than half a spacing the surface lies above the centre
  };
  /// How two particles face each other.
  struct Facing {
    Vector3 normal;       ///< unit, from the second to the first
    bool face = false;    ///< along a face's normal; otherwise along the line of centres, between round ones
    bool beside = false;  ///< along a face's normal, but the face does not reach so far
    double lift = 0;      ///< m, beyond kFaceDistance, at which the two touch along a face's normal
  };

  void configure(double spacing) { m_spacing = spacing; }
  /// Forgets all particles.
  void clear(size_t particles);
  /// Makes room for particle i, once, and returns its slot.
  uint32_t add(uint32_t i) {
    if (m_slot[i] == kNone) {
      m_slot[i] = static_cast<uint32_t>(m_who.size());
      m_who.push_back(i);
      m_own.emplace_back();
    }
    return m_slot[i];
  }
  uint32_t slotOf(uint32_t i) const { return m_slot[i]; }
  uint32_t whoIs(size_t slot) const { return m_who[slot]; }
  bool has(uint32_t i) const { return i < m_slot.size() && m_slot[i] != kNone; }
  size_t size() const { return m_who.size(); }
  Own& own(size_t slot) { return m_own[slot]; }
  /// Finds the lattice around the particle of each slot; same(i, j) says whether a neighbour j belongs to it, and is
  /// asked from several threads. By positions that the lists were made for: what is found depends on nothing else.
  template <class Same>
  void find(const ParticleStore& store, const Neighbours& neighbours, const Same& same) {
    find(store, neighbours, same, [](uint32_t, Own&) { return false; });
  }
  /// The same, but for those whose neighbours recall(i, own) knows.
  template <class Same, class Recall>
  void find(const ParticleStore& store, const Neighbours& neighbours, const Same& same, const Recall& recall) {
    m_room.resize(std::max(m_room.size(), chunkCount(m_who.size(), grain::kNeighbours)));
    const NearNeighbours near(store, neighbours);
    readTrue(store);
    forChunks(m_who.size(), grain::kNeighbours, [&](size_t first, size_t last) {
      std::vector<uint32_t>& room = m_room[first / grain::kNeighbours];
      for (size_t slot = first; slot < last; ++slot) {
        if (!recall(m_who[slot], m_own[slot])) findOne(store, neighbours.built(), near, slot, same, room);
      }
    });
  }
  /// The same for one slot alone, from one thread.
  template <class Same>
  void find(const ParticleStore& store, const Neighbours& neighbours, uint32_t slot, const Same& same) {
    if (m_room.empty()) m_room.emplace_back();
    readTrue(store);
    findOne(store, neighbours.built(), NearNeighbours(store, neighbours), slot, same, m_room[0]);
  }
  /// Whether neither it nor its neighbours move in this substep: all of them are fixed, and none is led.
  bool isStill(const ParticleStore& store, uint32_t i) const {
    const Own& own = m_own[m_slot[i]];
    const auto stands = [&](uint32_t p) {
      const api::Float4& v = store.velocity()[p];
      return v.w == 0 && v.x == 0 && v.y == 0 && v.z == 0;
    };
    return stands(i) && std::all_of(own.particles.begin(), own.particles.begin() + own.count, stands);
  }
  /// Where its neighbours are now.
  Normal normalOf(const ParticleStore& store, uint32_t i) const;
  /// `line` leads from j to i, m. Round ones face each other along it.
  Facing facing(const Normal& i, const Normal& j, const Vector3& line) const;
  /// The same where particle j may be of fixed matter whose shape is known.
  Facing facing(const ParticleStore& store, uint32_t j, const Normal& ofI, const Normal& ofJ,
                const Vector3& line) const {
    return isTrue(store, j) ? onShape(store, j, line) : facing(ofI, ofJ, line);
  }

 private:
  bool isTrue(const ParticleStore& store, uint32_t i) const {
    return m_true && m_true[i].w > 0 && store.motion()[i] == api::Motion::Static;
  }
  Facing onShape(const ParticleStore& store, uint32_t j, const Vector3& line) const;
  /// Until there are new lists.
  void readTrue(const ParticleStore& store) {
    m_true = static_cast<const api::Float4*>(store.read(field::kTrueSurface, api::FieldType::Float4));
  }
  static constexpr double kOwnReach = 1.5;  ///< spacings
  template <class Same>
  void findOne(const ParticleStore& store, std::span<const api::Float4> at, const NearNeighbours& near, size_t slot,
               const Same& same, std::vector<uint32_t>& room) {
    constexpr double kRounding = 1.0001;  // of single precision
    const uint32_t i = m_who[slot];
    Own& own = m_own[slot];
    own.count = 0;
    const double reach2 = kOwnReach * kOwnReach * m_spacing * m_spacing;
    for (const uint32_t j : near.of(i, static_cast<float>(kRounding * reach2), room)) {
      if (own.count == kMostOwn) break;
      float x = at[i].x - at[j].x, y = at[i].y - at[j].y, z = at[i].z - at[j].z;
      store.period().shorten(x, y, z);
      if (Vector3(x, y, z).squaredNorm() < reach2 && same(i, j)) own.particles[own.count++] = j;
    }
  }

  double m_spacing = 0;  ///< m
  std::vector<uint32_t> m_slot, m_who;
  std::vector<Own> m_own;
  const api::Float4* m_true = nullptr;        ///< field::kTrueSurface, if there is one
  std::vector<std::vector<uint32_t>> m_room;  ///< by chunk of slots
};

}  // namespace ps
