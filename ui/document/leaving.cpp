// SPDX-License-Identifier: Apache-2.0
#include "ui/document/leaving.h"

#include "ui/document/document.h"

#include <string>
#include <vector>

namespace ps {
namespace {

/// Whether a parameter is the thing's: of a body that of its shape and of what holds it, too.
bool isOf(const Address& parameter, const Address& thing) {
  if (parameter.id != thing.id) return false;
  const bool ofBody = parameter.owner == Owner::Shape || parameter.owner == Owner::Constraint;
  return parameter.owner == thing.owner || (thing.owner == Owner::Body && ofBody);
}

/// Whether a probe sees this and nothing else; what a tap has poured is named as bodies are.
bool seesAlone(const Probe& probe, const Address& thing) {
  switch (thing.owner) {
    case Owner::Body:
    case Owner::Emitter:
      return probe.body == thing.id;
    case Owner::Wall:
      return probe.wall == thing.id;
    case Owner::Material:
      return probe.material == thing.id;
    default:
      return false;
  }
}

}  // namespace

void takeOut(Document& document, const Address& thing, const QString& title, const std::function<void()>& removal) {
  std::vector<Document::Keys> keys;
  for (const Track& track : document.project().tracks) {
    const auto address = Address::parse(track.parameter);
    if (address && isOf(*address, thing)) keys.push_back({*address, {}});
  }
  std::vector<std::string> probes;
  for (const Probe& probe : document.project().probes) {
    if (seesAlone(probe, thing)) probes.push_back(probe.id);
  }
  const bool alone = keys.empty() && probes.empty();
  if (!alone) document.undoStack().beginMacro(title);
  document.setKeys(keys, title);
  for (const std::string& probe : probes) document.removeProbe(probe);
  removal();
  if (!alone) document.undoStack().endMacro();
}

}  // namespace ps
