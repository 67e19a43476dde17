// SPDX-License-Identifier: Apache-2.0
// All that a solver carries from one frame to the next. Settings are not of it: who restores a state has set the scene
// up already. Nor are the lists of stages, which follow from the neighbour lists and the structure (listsChanged()),
// and what a stage works out anew in every frame.
#include "core/base/error.h"
#include "core/solver/frame/solverimpl.h"

#include <algorithm>

namespace ps {

void Solver::Impl::save(StateWriter& writer) const {
  const uint64_t frames[] = {frame, lastSort};
  const double seconds[] = {time, thermalTime}, joules[] = {energyOffset};
  writer.array("clock/frames", std::span<const uint64_t>(frames));
  writer.array("clock/seconds", std::span<const double>(seconds));
  writer.array("clock/energy_offset", std::span<const double>(joules));
  writer.value("clock/reordered", static_cast<uint8_t>(reordered ? 1 : 0));
  store.save(writer);
  neighbours.save(writer, !reordered && neighbours.built().size() == store.size());
  motion.save(writer);
  constraints.save(writer);
  rigid.save(writer);
  rebound.save(writer);
  heat.save(writer, store);
}

void Solver::Impl::restore(const StateReader& reader) {
  const std::vector<uint64_t> frames = reader.array<uint64_t>("clock/frames", 2, 1);
  const std::vector<double> seconds = reader.array<double>("clock/seconds", 2, 1);
  frame = frames[0], lastSort = frames[1];
  time = seconds[0], thermalTime = seconds[1];
  energyOffset = reader.value<double>("clock/energy_offset");
  store.restore(reader);
  const uint32_t *material = store.material(), *end = material + store.size();
  if (std::any_of(material, end, [&](uint32_t index) { return index >= materials.size(); }))
    StateReader::fail("field/material", "names a material that the scene has not");
  ps::advance(0);
  neighbours.restore(reader, store);
  shapes.forget();
  ps::advance(0);
  reordered = reader.value<uint8_t>("clock/reordered") != 0 || neighbours.built().size() != store.size();
  motion.restore(reader, store);
  constraints.restore(reader, store);
  rigid.restore(reader);
  rebound.restore(reader);
  heat.restore(reader, store);
  structureChanged = true;
}

/// Into memory that is used again frame by frame.
void Solver::Impl::keepLastGood() {
  lastGoodValid = false;
  lastGood.clear();
  saveTo(lastGood, *this);
  lastGoodValid = true;
}

void Solver::Impl::backToLastGood() {
  if (lastGoodValid) restore(StateReader(lastGood.bytes()));
}

void Solver::save(StateWriter& writer) const {
  m->configure();
  m->save(writer);
}

void Solver::restore(const StateReader& reader) {
  m->configure();
  m->restore(reader);
  m->lastGoodValid = false;
}

uint64_t Solver::stateHash() const { return savedHash(*this); }

}  // namespace ps
