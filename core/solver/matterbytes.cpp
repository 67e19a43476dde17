// SPDX-License-Identifier: Apache-2.0
#include "core/solver/matterbytes.h"

#include "core/solver/structure/constraintsystem.h"

namespace ps {
namespace {

template <class Item>
size_t sizeOf(const std::vector<Item>& items) {
  return items.capacity() * sizeof(Item);
}

size_t bytesOf(const CopiedParticles& particles) {
  size_t bytes = sizeOf(particles.id);
  for (const auto& [name, values] : particles.fields) bytes += sizeof(name) + sizeOf(values);
  return bytes;
}

size_t bytesOf(const CopiedGroup& group) {
  return sizeof(group) + sizeOf(group.id) + sizeOf(group.extracted) + sizeOf(group.values) + sizeOf(group.memberValues);
}

size_t bytesOf(const CopiedConstraints& constraints) {
  size_t bytes = sizeof(constraints) + sizeOf(constraints.cuts);
  for (const CopiedConstraints::Set& set : constraints.sets) {
    bytes += sizeof(set) + sizeOf(set.id) + sizeOf(set.values);
    for (const CopiedGroup& group : set.groups) bytes += bytesOf(group);
    for (const CopiedGroup& group : set.split.before) bytes += bytesOf(group);
    for (const std::vector<uint32_t>& ids : set.split.after) bytes += sizeof(ids) + sizeOf(ids);
  }
  return bytes;
}

}  // namespace

size_t bytesOf(const ExtractedMatter& matter) {
  return bytesOf(matter.particles) + (matter.constraints ? bytesOf(*matter.constraints) : 0);
}

size_t bytesOf(const TieChange& change) {
  return sizeof(change) + sizeOf(change.cuts) + (change.ties ? bytesOf(*change.ties) : 0);
}

size_t bytesOf(const PaintedMatter& matter) { return bytesOf(matter.before) + bytesOf(matter.after); }

}  // namespace ps
