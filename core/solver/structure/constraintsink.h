// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"
#include "core/solver/structure/constraintsystem.h"

#include <vector>

namespace ps {

struct ConstraintSystem::Edits {
  std::vector<uint8_t> removed;   ///< per constraint; empty: none
  std::vector<size_t> removedAt;  ///< the same as a list
  std::vector<uint32_t> particles;
  std::vector<float> values;
  bool empty() const { return removedAt.empty() && particles.empty(); }
};

/// Collects what a plugin adds and removes; it takes effect when the call has returned.
class ConstraintSystem::Sink final : public api::ConstraintSink {
 public:
  Sink(ConstraintSystem& system, Set& set, const ParticleStore& store, Edits& edits)
      : m_system(system), m_set(set), m_store(store), m_edits(edits) {}
  void add(const uint32_t* particles, const float* values) override {
    if (++m_calls % kProgressSlice == 0) tellProgress(m_set, kProgressSlice);
    if (!particles || (!values && m_set.valueCount > 0)) throw Error("added a constraint by a null pointer");
    for (size_t a = 0; a < m_set.arity; ++a) {
      if (particles[a] >= m_store.size()) throw Error("added a constraint on a particle that does not exist");
      for (size_t b = 0; b < a; ++b) {
        if (particles[a] == particles[b]) throw Error("added a constraint that names a particle twice");
      }
    }
    m_system.lookUp(m_set, m_store);
    if (!m_set.keys.insert(m_system.keyOf(m_set, m_store, particles))) return;
    m_edits.particles.insert(m_edits.particles.end(), particles, particles + m_set.arity);
    m_edits.values.insert(m_edits.values.end(), values, values + m_set.valueCount);
  }
  void remove(size_t k) override {
    if (k >= m_set.count) throw Error("removed a constraint that does not exist");
    if (m_edits.removed.empty()) m_edits.removed.assign(m_set.count, 0);
    if (m_edits.removed[k] != 0) return;
    m_system.lookUp(m_set, m_store);
    m_edits.removed[k] = 1;
    m_edits.removedAt.push_back(k);
    m_set.keys.erase(m_system.keyOf(m_set, m_store, m_set.particles.data() + k * m_set.arity));
  }

 private:
  ConstraintSystem& m_system;
  Set& m_set;
  const ParticleStore& m_store;
  Edits& m_edits;
  size_t m_calls = 0;
};

/// While it lives, plugins see who has been cut apart.
class ConstraintSystem::CutsShown {
 public:
  CutsShown(ConstraintSystem& system, const ParticleStore& store) : m_system(system) {
    system.m_cutView = system.m_cuts.view(store);
  }
  ~CutsShown() { m_system.m_cutView = nullptr; }
  CutsShown(const CutsShown&) = delete;
  CutsShown& operator=(const CutsShown&) = delete;

 private:
  ConstraintSystem& m_system;
};

}  // namespace ps
