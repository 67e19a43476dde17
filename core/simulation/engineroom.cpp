// SPDX-License-Identifier: Apache-2.0
// What matter that is added to a living scene asks of the machine's memory.
#include "core/base/log.h"
#include "core/simulation/engineimpl.h"
#include "core/simulation/sceneneed.h"
#include "core/simulation/sceneproblem.h"

#include <utility>

namespace ps {
namespace {

/// Of the room that there is, until it is looked up again: to look takes a good part of what a stroke's sample may.
constexpr double kShare = 1.0 / 16;

}  // namespace

void Engine::Impl::requireRoomFor(double more, const Body& body) {
  const double each = particleBytes(project, &plugins, body, {spacing, scaleOf(project).reach});
  const auto living = static_cast<double>(solver->particles().size());
  if (more * each > addingRoom) {
    const Memory memory = memoryNow();
    ps::requireRoomFor(living, more, each, memory);
    addingRoom = kShare * (roomToGrow(memory) - more * each);
    return;
  }
  requireFewer(living + more);
  addingRoom -= more * each;
}

void Engine::Impl::measurePouring() {
  pouredBytes = pouredParticleBytes(project, &plugins, {spacing, scaleOf(project).reach});
}

bool Engine::Impl::mayPour(size_t more) {
  if (static_cast<double>(solver->particles().size() + more) > kMaximumParticles) return false;
  const double bytes = static_cast<double>(more) * pouredBytes;
  if (bytes > pouringRoom) pouringRoom = kShare * roomToGrow(memoryNow());
  if (bytes <= pouringRoom) {
    pouringRoom -= bytes;
    return true;
  }
  if (!std::exchange(toldFull, true)) {
    log(LogLevel::Warning, "emitters wait: the memory holds no more than the " +
                               particlesText(static_cast<double>(solver->particles().size())) +
                               " that there are; let less pour or raise the particle spacing");
  }
  return false;
}

}  // namespace ps
