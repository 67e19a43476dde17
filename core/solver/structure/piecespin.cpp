// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/piecespin.h"

#include "core/base/parallel.h"
#include "core/solver/structure/constraintsystem.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>

namespace ps {
namespace {

/// Least determinant of an inertia, as a share of the cube of its trace: ropes that are straight have no spin about
/// themselves.
constexpr double kLeastDeterminant = 1e-6;

}  // namespace

void PieceSpin::findPieces(const ParticleStore& store, const StructureGraph& graph) {
  m_piece.assign(store.size(), kNone);
  m_count.clear();
  for (uint32_t first = 0; first < store.size(); ++first) {
    if (m_piece[first] != kNone || graph.begin[first + 1] == graph.begin[first]) continue;
    const uint32_t piece = static_cast<uint32_t>(m_count.size());
    m_count.push_back(0);
    bool keepsItself = false;
    m_piece[first] = piece;
    m_open.push_back(first);
    while (!m_open.empty()) {
      const uint32_t i = m_open.back();
      m_open.pop_back();
      ++m_count[piece];
      keepsItself = keepsItself || store.velocity()[i].w == 0 || graph.groupBegin[i + 1] != graph.groupBegin[i];
      for (uint32_t k = graph.begin[i]; k < graph.begin[i + 1]; ++k) {
        if (m_piece[graph.partner[k]] != kNone) continue;
        m_piece[graph.partner[k]] = piece;
        m_open.push_back(graph.partner[k]);
      }
    }
    if (keepsItself) m_count[piece] = 0;
  }
}

void PieceSpin::refresh(const ParticleStore& store, ConstraintSystem& constraints) {
  m_runs.clear();
  m_pieces.clear();
  m_members.clear();
  if (constraints.count() == 0) return;
  findPieces(store, constraints.graph(store.size()));
  size_t members = 0;
  for (uint32_t& count : m_count) {
    const size_t first = members, last = members + count;
    for (size_t k = first; k < last; k += grain::kParticles)
      m_runs.push_back({k, std::min(last, k + grain::kParticles), m_pieces.size()});
    if (count > 0) m_pieces.emplace_back();
    count = count > 0 ? static_cast<uint32_t>(first) : kNone;  // from now on where the next member goes
    members = last;
  }
  m_members.resize(members);
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (m_piece[i] != kNone && m_count[m_piece[i]] != kNone) m_members[m_count[m_piece[i]]++] = i;
  }
  m_sums.resize(m_runs.size());
}

void PieceSpin::read(const ParticleStore& store, double dt) {
  forChunks(m_runs.size(), 1, [&](size_t first, size_t last) {
    for (size_t r = first; r < last; ++r) {
      Sums sums;
      for (size_t k = m_runs[r].first; k < m_runs[r].last; ++k) {
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
      }
      m_sums[r] = sums;
    }
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
      all.moments += m_sums[r].moments;
    }
    Piece& result = m_pieces[piece];
    result.centre = all.place / all.mass;
    result.spin.setZero();
    const Vector3 lost = dt * (all.torque - all.predicted.cross(all.momentum) / all.mass);
    const Matrix3 moments = all.moments - all.mass * result.centre * result.centre.transpose();
    const Matrix3 inertia = moments.trace() * Matrix3::Identity() - moments;
    const double trace = inertia.trace();
    if (inertia.determinant() > kLeastDeterminant * trace * trace * trace) result.spin = inertia.inverse() * lost;
  }
}

void PieceSpin::apply(ParticleStore& store) const {
  forChunks(m_runs.size(), 1, [&](size_t first, size_t last) {
    for (size_t r = first; r < last; ++r) {
      const Piece& piece = m_pieces[m_runs[r].piece];
      for (size_t k = m_runs[r].first; k < m_runs[r].last; ++k) {
        const Vector3 arm = vectorOf(store.position()[m_members[k]]) - piece.centre;
        addTo(store.velocity()[m_members[k]], piece.spin.cross(arm));
      }
    }
  });
}

}  // namespace ps
