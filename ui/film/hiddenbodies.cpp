// SPDX-License-Identifier: Apache-2.0
#include "ui/film/hiddenbodies.h"

namespace ps {
namespace {

template <class T>
void keep(std::vector<T>& values, const std::vector<size_t>& rows) {
  if (values.empty()) return;
  std::vector<T> kept;
  kept.reserve(rows.size());
  for (const size_t row : rows) kept.push_back(values[row]);
  values = std::move(kept);
}

}  // namespace

std::set<std::string> hiddenBodies(const Project& project) {
  std::set<std::string> hidden;
  for (const Body& body : project.bodies) {
    if (!body.visible) hidden.insert(body.id);
  }
  for (const Emitter& tap : project.emitters) {
    if (!tap.visible) hidden.insert(tap.id);
  }
  return hidden;
}

SnapshotPtr withoutBodies(const SnapshotPtr& snapshot, const std::set<std::string>& hidden) {
  if (!snapshot || hidden.empty() || !snapshot->bodyIds) return snapshot;
  std::vector<bool> isHidden;
  for (const std::string& id : *snapshot->bodyIds) isHidden.push_back(hidden.count(id) > 0);
  std::vector<size_t> rows;
  for (size_t i = 0; i < snapshot->body.size(); ++i) {
    if (snapshot->body[i] >= isHidden.size() || !isHidden[snapshot->body[i]]) rows.push_back(i);
  }
  if (rows.size() == snapshot->body.size()) return snapshot;
  auto copy = std::make_shared<Snapshot>(*snapshot);
  keep(copy->position, rows);
  keep(copy->temperature, rows);
  keep(copy->speed, rows);
  keep(copy->densityError, rows);
  keep(copy->gasFraction, rows);
  keep(copy->phase, rows);
  keep(copy->motion, rows);
  keep(copy->id, rows);
  keep(copy->body, rows);
  keep(copy->material, rows);
  for (FieldValues& field : copy->fields) keep(field.values, rows);
  return copy;
}

}  // namespace ps
