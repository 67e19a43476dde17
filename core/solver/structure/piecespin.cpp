// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/piecespin.h"

#include "core/base/parallel.h"
#include "core/solver/structure/constraintsystem.h"
#include "core/solver/structure/piecelists.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <atomic>

namespace ps {
namespace {

/// Least determinant of an inertia, as a share of the cube of its trace: ropes that are straight have no spin about
/// themselves.
constexpr double kLeastDeterminant = 1e-6;
/// Places are in single precision: what a piece has less of, as a share of the moments about the origin, is rounding.
constexpr double kRounding = 1e-10;
/// What there is among the members of a piece.
constexpr unsigned kFixed = 1, kGrouped = 2;

}  // namespace

void PieceSpin::refresh(const ParticleStore& store, const StructureGraph& graph, const PieceLists& pieces) {
  m_runs.clear();
  m_pieces.clear();
  m_members = pieces.members();
  m_kinds.assign(pieces.count(), 0);
  forChunks(m_members.size(), grain::kNumbers, [&](size_t first, size_t last) {
    pieces.eachPart(first, last, [&](size_t piece, std::span<const uint32_t> members) {
      unsigned kinds = 0;
      for (const uint32_t i : members) {
        kinds |= store.velocity()[i].w == 0 ? kFixed : 0u;
        kinds |= graph.groupBegin[i + 1] != graph.groupBegin[i] ? kGrouped : 0u;
      }
      std::atomic_ref(m_kinds[piece]).fetch_or(static_cast<uint8_t>(kinds), std::memory_order_relaxed);
    });
  });
  for (size_t piece = 0; piece < pieces.count(); ++piece) {
    if ((m_kinds[piece] & kFixed) != 0) continue;
    const size_t last = pieces.begin()[piece + 1];
    for (size_t k = pieces.begin()[piece]; k < last; k += grain::kParticles)
      m_runs.push_back({k, std::min(last, k + grain::kParticles), m_pieces.size()});
    m_pieces.emplace_back().grouped = (m_kinds[piece] & kGrouped) != 0;
  }
  m_sums.resize(m_runs.size());
}

PieceSpin::Sums PieceSpin::sumOf(const ParticleStore& store, const Run& run, std::span<const api::Float4> couple,
                                 double dt) const {
  Sums sums;
  if (m_pieces[run.piece].grouped && couple.empty()) return sums;
  for (size_t k = run.first; k < run.last; ++k) {
    const uint32_t i = m_members[k];
    const double mass = store.mass()[i];
    const Vector3 at = vectorOf(store.position()[i]), predicted = vectorOf(store.velocity()[i]);
    const Vector3 velocity = (at - vectorOf(store.previous()[i])) / dt;
    sums.mass += mass;
    sums.place += mass * at;
    sums.predicted += mass * predicted;
    sums.momentum += mass * velocity;
    sums.torque += mass * predicted.cross(velocity);
    sums.moments += mass * at * at.transpose();
    if (!couple.empty()) sums.couple += vectorOf(couple[i]);
  }
  return sums;
}

void PieceSpin::read(const ParticleStore& store, std::span<const api::Float4> couple, double dt) {
  forChunks(m_runs.size(), 1, [&](size_t first, size_t last) {
    for (size_t r = first; r < last; ++r) m_sums[r] = sumOf(store, m_runs[r], couple, dt);
  });
  for (size_t r = 0; r < m_runs.size();) {
    const size_t piece = m_runs[r].piece;
    Sums all;
    for (; r < m_runs.size() && m_runs[r].piece == piece; ++r) {
      all.mass += m_sums[r].mass;
      all.place += m_sums[r].place;
      all.predicted += m_sums[r].predicted;
      all.momentum += m_sums[r].momentum;
      all.torque += m_sums[r].torque;
      all.couple += m_sums[r].couple;
      all.moments += m_sums[r].moments;
    }
    Piece& result = m_pieces[piece];
    result.spin.setZero();
    if (!(all.mass > 0)) continue;
    result.centre = all.place / all.mass;
    Vector3 lost = all.couple / dt;
    if (!result.grouped) lost += dt * (all.torque - all.predicted.cross(all.momentum) / all.mass);
    if (lost.isZero(0)) continue;
    const Matrix3 moments = all.moments - all.mass * result.centre * result.centre.transpose();
    const Matrix3 inertia = moments.trace() * Matrix3::Identity() - moments;
    const double trace = inertia.trace();
    if (!(trace > kRounding * all.moments.trace())) continue;  // all in one place, as in a corner of the scene
    if (inertia.determinant() > kLeastDeterminant * trace * trace * trace) result.spin = inertia.inverse() * lost;
  }
}

void PieceSpin::apply(ParticleStore& store) const {
  forChunks(m_runs.size(), 1, [&](size_t first, size_t last) {
    for (size_t r = first; r < last; ++r) {
      const Piece& piece = m_pieces[m_runs[r].piece];
      if (piece.spin.isZero(0)) continue;
      for (size_t k = m_runs[r].first; k < m_runs[r].last; ++k) {
        const Vector3 arm = vectorOf(store.position()[m_members[k]]) - piece.centre;
        addTo(store.velocity()[m_members[k]], piece.spin.cross(arm));
      }
    }
  });
}

}  // namespace ps
