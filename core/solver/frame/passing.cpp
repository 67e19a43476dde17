// SPDX-License-Identifier: Apache-2.0
#include "core/solver/frame/solverimpl.h"

namespace ps {

void Solver::pass(std::span<const uint32_t> ids, uint32_t from, uint32_t to) {
  m->configure();
  bool any = false;
  for (const uint32_t i : m->store.indicesOf(ids)) {
    if (m->store.body()[i] != from) continue;
    m->store.body()[i] = to;
    any = true;
  }
  if (!any) return;
  m->constraints.passed(m->store, from, to);
  m->reordered = m->structureChanged = true;
  m->lastGoodValid = false;
}

}  // namespace ps
