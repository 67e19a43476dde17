// SPDX-License-Identifier: Apache-2.0
// Ties are gone through colour by colour, as Gauss-Seidel does, so that each writes its particles alone; sums are those
// of chunks. All is in double precision: the search directions of conjugate gradients lose their angles first.
#include "core/solver/structure/implicitties.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

constexpr uint32_t kNone = ~0u;
/// Of the force of all ties: what may be left, in the norm of the inverse masses. Each substep begins with what the
/// last one has left, so that a load at rest is carried whole.
constexpr double kTolerance = 0.1;
/// Spacings by which what is left may move a particle, in the mean: below it are rounded places.
constexpr double kRounding = 2e-6;

}  // namespace

void ImplicitTies::clear() {
  m_done = true;
  m_sources.clear();
  m_ties.clear();
  m_places.clear();
  m_colourStart.assign(1, 0);
  m_members.clear();
}

void ImplicitTies::add(const Source& source) {
  const uint32_t index = static_cast<uint32_t>(m_sources.size());
  m_sources.push_back(source);
  for (size_t colour = 0; colour + 1 < source.colourStart.size(); ++colour) {
    for (size_t k = source.colourStart[colour]; k < source.colourStart[colour + 1]; ++k) {
      if (!(source.stiffness[k] > 0)) continue;
      m_ties.push_back({source.particles[2 * k], source.particles[2 * k + 1], 0, 0, 0, 0, 0, 0});
      m_places.push_back({index, static_cast<uint32_t>(k)});
    }
    if (m_ties.size() > m_colourStart.back()) m_colourStart.push_back(m_ties.size());
  }
}

void ImplicitTies::number(const ParticleStore& store) {
  if (m_ties.empty()) return;
  m_local.assign(store.size(), kNone);
  for (const Tie& tie : m_ties) m_local[tie.a] = m_local[tie.b] = 0;
  m_members.clear();
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (m_local[i] == kNone) continue;
    m_local[i] = static_cast<uint32_t>(m_members.size());
    m_members.push_back(i);
  }
  for (Tie& tie : m_ties) tie.a = m_local[tie.a], tie.b = m_local[tie.b];
  m_inverseMass.resize(m_members.size());
  for (auto* v : {&m_way, &m_residual, &m_search, &m_image}) v->resize(m_members.size());
}

/// Adds size(tie) along each tie to its first particle and takes it from its second.
template <class Size>
void ImplicitTies::pull(std::vector<Vector3>& out, const Size& size) const {
  for (size_t colour = 0; colour + 1 < m_colourStart.size(); ++colour) {
    const size_t begin = m_colourStart[colour];
    forChunks(m_colourStart[colour + 1] - begin, grain::kConstraints, [&](size_t first, size_t last) {
      for (size_t k = begin + first; k < begin + last; ++k) {
        const Tie& tie = m_ties[k];
        const Vector3 along = size(tie) * Vector3(double{tie.x}, double{tie.y}, double{tie.z});
        out[tie.a] += along;
        out[tie.b] -= along;
      }
    });
  }
}

template <class Term>
double ImplicitTies::sum(const Term& term) const {
  const auto chunk = [&](size_t first, size_t last) {
    double s = 0;
    for (size_t m = first; m < last; ++m) s += term(m);
    return s;
  };
  return parallelSum(m_members.size(), grain::kParticles, std::cref(chunk));
}

void ImplicitTies::read(const ParticleStore& store) {
  const api::ParticleView view = store.view();
  forChunks(m_ties.size(), grain::kConstraints, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      Tie& tie = m_ties[k];
      const Source& source = m_sources[m_places[k].source];
      const uint32_t of = m_places[k].tie;
      const api::Float4 d = api::separation(view, m_members[tie.a], m_members[tie.b]);
      const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), per = length > 0 ? 1 / length : 0;
      tie.x = per * d.x, tie.y = per * d.y, tie.z = per * d.z;
      tie.pull = source.pull[of], tie.stiffness = source.stiffness[of], tie.multiplier = source.multiplier[of];
    }
  });
}

/// m_way: by the last multipliers.
void ImplicitTies::start(const ParticleStore& store) {
  read(store);
  forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t m = first; m < last; ++m) {
      m_inverseMass[m] = double{store.velocity()[m_members[m]].w};
      m_way[m].setZero();
    }
  });
  pull(m_way, [](const Tie& tie) { return double{tie.multiplier}; });
  forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t m = first; m < last; ++m) m_way[m] *= m_inverseMass[m];
  });
}

/// m_image: the force of all ties where the particles are; m_residual: what is left of it after m_way.
void ImplicitTies::beginResidual(double perDt2) {
  forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t m = first; m < last; ++m) {
      m_image[m].setZero();
      m_residual[m].setZero();
      if (m_inverseMass[m] > 0) m_residual[m] = -perDt2 / m_inverseMass[m] * m_way[m];
    }
  });
  pull(m_image, [](const Tie& tie) { return double{tie.pull}; });
  pull(m_residual, [&](const Tie& tie) {
    const Vector3 apart = m_way[tie.a] - m_way[tie.b];
    return double{tie.pull} - double{tie.stiffness} * (tie.x * apart.x() + tie.y * apart.y() + tie.z * apart.z());
  });
}

/// m_image = (M/dt2 + J^T k J) m_search; their product.
double ImplicitTies::multiplied(double perDt2) {
  forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t m = first; m < last; ++m) {
      m_image[m].setZero();
      if (m_inverseMass[m] > 0) m_image[m] = perDt2 / m_inverseMass[m] * m_search[m];
    }
  });
  pull(m_image, [&](const Tie& tie) {
    const Vector3 apart = m_search[tie.a] - m_search[tie.b];
    return double{tie.stiffness} * (tie.x * apart.x() + tie.y * apart.y() + tie.z * apart.z());
  });
  return sum([&](size_t m) { return m_search[m].dot(m_image[m]); });
}

/// Until what is left is `enough`, kg-1 N2; false when it does not get there.
bool ImplicitTies::iterate(double perDt2, double enough) {
  const auto left = [&](size_t m) { return m_inverseMass[m] * m_residual[m].squaredNorm(); };
  double now = sum(left), before = 0;
  for (int iteration = 0; now > enough; ++iteration) {
    if (iteration == kMostIterations) return false;
    const double keep = iteration > 0 ? now / before : 0;
    forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
      for (size_t m = first; m < last; ++m) {
        if (keep == 0) m_search[m].setZero();
        m_search[m] = m_inverseMass[m] * m_residual[m] + keep * m_search[m];
      }
    });
    const double product = multiplied(perDt2);
    if (!(product > 0)) return false;
    const double step = now / product;
    forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
      for (size_t m = first; m < last; ++m) {
        m_way[m] += step * m_search[m];
        m_residual[m] -= step * m_image[m];
      }
    });
    before = now;
    now = sum(left);
  }
  return true;
}

void ImplicitTies::solve(ParticleStore& store, double dt, double spacing) {
  const double perDt2 = 1 / (dt * dt);
  start(store);
  beginResidual(perDt2);
  const double force = sum([&](size_t m) { return m_inverseMass[m] * m_image[m].squaredNorm(); });
  const double mass = sum([&](size_t m) { return m_inverseMass[m] > 0 ? 1 / m_inverseMass[m] : 0; });
  const double rounding = kRounding * spacing * perDt2;
  const bool done = iterate(perDt2, std::max(kTolerance * kTolerance * force, mass * rounding * rounding));
  m_done = m_done && done;
  if (done) {
    forChunks(m_members.size(), grain::kParticles, [&](size_t first, size_t last) {
      for (size_t m = first; m < last; ++m) addTo(store.position()[m_members[m]], m_way[m]);
    });
  }
  forChunks(m_ties.size(), grain::kConstraints, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const Tie& tie = m_ties[k];
      const Vector3 apart = m_way[tie.a] - m_way[tie.b];
      const double pull =
          double{tie.pull} - double{tie.stiffness} * (tie.x * apart.x() + tie.y * apart.y() + tie.z * apart.z());
      m_sources[m_places[k].source].multiplier[m_places[k].tie] = done ? static_cast<float>(dt * dt * pull) : 0.0f;
    }
  });
}

}  // namespace ps
