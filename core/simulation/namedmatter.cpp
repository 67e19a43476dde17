// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/namedmatter.h"

#include "core/scene/coat.h"
#include "core/simulation/engine.h"
#include "core/solver/matterbytes.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

std::vector<uint32_t> ofBody(const Engine& engine, std::vector<uint32_t> ids, const std::string& body) {
  const std::vector<std::string>& bodies = engine.bodyIds();
  const auto index = static_cast<uint32_t>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin());
  const ParticleStore& store = engine.particles();
  std::erase_if(ids, [&](uint32_t id) {
    const size_t row = store.indexOf(id);
    return row >= store.size() || store.body()[row] != index;
  });
  return ids;
}

/// Without matter of some bodies.
std::vector<uint32_t> sparing(const Engine& engine, std::vector<uint32_t> ids, const std::vector<std::string>& spared) {
  if (spared.empty()) return ids;
  const std::vector<std::string>& bodies = engine.bodyIds();
  const ParticleStore& store = engine.particles();
  std::erase_if(ids, [&](uint32_t id) {
    const size_t row = store.indexOf(id);
    if (row >= store.size()) return true;
    const uint32_t body = store.body()[row];
    return body < bodies.size() && std::find(spared.begin(), spared.end(), bodies[body]) != spared.end();
  });
  return ids;
}

}  // namespace

NamedMatter::NamedMatter(const MatterIds& named) {
  for (const auto& [key, ids] : named) m_entries[key].ids = ids;
}

MatterIds NamedMatter::present() const {
  MatterIds named;
  for (const auto& [key, entry] : m_entries) {
    if (entry.isPresent()) named[key] = entry.ids;
  }
  return named;
}

std::vector<MatterKey> NamedMatter::outside() const {
  std::vector<MatterKey> keys;
  for (const auto& [key, entry] : m_entries) {
    if (!entry.isPresent()) keys.push_back(key);
  }
  return keys;
}

NamedMatter NamedMatter::inScene() const {
  NamedMatter there;
  for (const MatterKey key : keysInScene()) there.m_entries.emplace(key, m_entries.at(key)).first->second.hand.reset();
  return there;
}

std::vector<MatterKey> NamedMatter::keysInScene() const {
  std::vector<MatterKey> keys;
  for (const auto& [key, entry] : m_entries) {
    if (entry.extracted.empty()) keys.push_back(key);
  }
  return keys;
}

std::vector<MatterKey> NamedMatter::erasedOrPainted() const {
  std::vector<MatterKey> keys = m_settled;
  for (const auto& [key, entry] : m_entries) {
    if (entry.erasedOrPainted()) keys.push_back(key);
  }
  return keys;
}

std::shared_ptr<const MatterBytes> NamedMatter::bytes() const {
  if (m_bytes) return m_bytes;
  MatterBytes all;
  for (const auto& [key, entry] : m_entries) all.emplace(key, bytesOf(entry));
  m_bytes = std::make_shared<const MatterBytes>(std::move(all));
  return m_bytes;
}

uint64_t NamedMatter::bytesOf(const Entry& entry) {
  constexpr uint64_t kNode = 40;  // of the map
  uint64_t bytes = kNode + sizeof(entry) + 4 * entry.ids.capacity();
  for (const ExtractedMatter& matter : entry.extracted) bytes += ps::bytesOf(matter);
  for (const HeatById* heat : {&entry.heat, &entry.taken}) bytes += sizeof((*heat)[0]) * heat->capacity();
  for (const auto* ties : {&entry.ties, &entry.untied}) {
    for (const TieChange& change : *ties) bytes += ps::bytesOf(change);
  }
  for (const auto* coats : {&entry.painted, &entry.bare, &entry.before, &entry.stripped}) {
    for (const Coat& coat : *coats)
      bytes += sizeof(coat) + 4 * coat.ids.capacity() + 8 * coat.colours.capacity() + ps::bytesOf(coat.was);
  }
  return bytes;
}

std::vector<MatterKey> NamedMatter::keys() const {
  std::vector<MatterKey> keys;
  for (const auto& [key, entry] : m_entries) keys.push_back(key);
  return keys;
}

std::vector<MatterKey> NamedMatter::hands() const {
  std::vector<MatterKey> keys;
  for (const auto& [key, entry] : m_entries) {
    if (entry.hand && entry.hand->isAtWork()) keys.push_back(key);
  }
  return keys;
}

std::vector<ToolContact> NamedMatter::contacts() const {
  std::vector<ToolContact> list;
  for (const auto& [key, entry] : m_entries) {
    if (!entry.hand || entry.hand->effort() == 0) continue;
    ToolContact& contact = list.emplace_back();
    contact.body = contactOf(key);
    contact.force = {entry.hand->effort(), 0, 0};
  }
  return list;
}

void NamedMatter::act(Engine& engine) {
  for (auto& [key, entry] : m_entries) {
    if (entry.hand) act(engine, entry);
  }
}

void NamedMatter::act(Engine& engine, Entry& entry) {
  m_bytes.reset();
  HandDeeds done = entry.hand->act(engine);
  addTo(entry.heat, done.heat);
  std::move(done.ties.begin(), done.ties.end(), std::back_inserter(entry.ties));
  if (entry.hand->isGone()) entry.hand.reset();
}

/// What has let go does the rest now: undo takes what is born by a later edit away before that of the hand, which would
/// not find there what it gave to it.
void NamedMatter::finishHands(Engine& engine) {
  for (auto& [key, entry] : m_entries) {
    if (entry.hand && entry.hand->isAtWork() && entry.hand->hasLetGo()) act(engine, entry);
  }
}

void NamedMatter::extract(Engine& engine, Entry& entry, const std::vector<uint32_t>& ids) {
  if (!ids.empty()) entry.extracted.push_back(engine.extractParticles(ids));
}

void NamedMatter::putBack(Engine& engine, Entry& entry) {
  for (auto matter = entry.extracted.rbegin(); matter != entry.extracted.rend(); ++matter) engine.putBack(*matter);
  entry.extracted.clear();
}

void NamedMatter::obey(Engine& engine, const AddCells& command) {
  finishHands(engine);
  const std::vector<uint32_t> ids = engine.addCells(*command.body, command.cells, command.palette, command.way);
  if (command.key == 0) return;
  Entry& entry = m_entries[command.key];
  entry.ids.insert(entry.ids.end(), ids.begin(), ids.end());
}

void NamedMatter::obey(Engine& engine, const TakeCells& command) {
  const std::vector<uint32_t> ids = sparing(engine, engine.particlesIn(command.lattice, command.cells), command.spared);
  Entry& entry = m_entries[command.key];
  entry.afterStart = engine.solver().frame() > 0;
  entry.ids.insert(entry.ids.end(), ids.begin(), ids.end());
  extract(engine, entry, ids);
}

void NamedMatter::obey(Engine& engine, const TakeBody& command) {
  const ParticleStore& store = engine.particles();
  Entry& entry = m_entries[command.key];
  entry = {};
  entry.ids = ofBody(engine, {store.id(), store.id() + store.size()}, command.body);
  extract(engine, entry, entry.ids);
}

void NamedMatter::obey(Engine& engine, const TakeMatter& command) {
  const auto found = m_entries.find(command.key);
  if (found != m_entries.end()) {  // it may have taken nothing: what stands there by now is none of its
    extract(engine, found->second, found->second.ids);
  } else if (!command.cells.empty()) {
    extract(engine, m_entries[command.key], engine.particlesIn(command.lattice, command.cells));
  }
}

void NamedMatter::obey(Engine& engine, const PutBack& command) {
  if (const auto found = m_entries.find(command.key); found != m_entries.end()) {
    putBack(engine, found->second);
    return;
  }
  for (const AddCells& cells : command.cells) obey(engine, cells);
}

/// In their order; what has been done moves over.
void NamedMatter::paint(Engine& engine, std::vector<Coat>& coats, std::vector<Coat>& painted) {
  for (Coat& coat : coats) {
    if (isColour(coat.material)) {
      coat.colours = engine.colour(coat.ids, colourNumber(coat.material));
    } else {
      coat.was = engine.paint(coat.ids, coat.material);
    }
    painted.push_back(std::move(coat));
  }
  coats.clear();
}

/// The last one first.
void NamedMatter::unpaint(Engine& engine, std::vector<Coat>& painted, std::vector<Coat>& coats) {
  for (auto coat = painted.rbegin(); coat != painted.rend(); ++coat) {
    engine.unpaint(coat->was);
    coat->was = {};
    std::map<uint32_t, std::vector<uint32_t>> byColour;
    for (const auto& [id, before] : coat->colours) byColour[before].push_back(id);
    for (const auto& [before, ids] : byColour) engine.colour(ids, before);
    coat->colours.clear();
  }
  std::move(painted.begin(), painted.end(), std::back_inserter(coats));
  painted.clear();
}

/// The last one first.
void NamedMatter::undoTies(Engine& engine, Entry& entry) {
  for (auto change = entry.ties.rbegin(); change != entry.ties.rend(); ++change) engine.undo(*change);
  std::move(entry.ties.begin(), entry.ties.end(), std::back_inserter(entry.untied));
  entry.ties.clear();
}

void NamedMatter::redoTies(Engine& engine, Entry& entry) {
  for (const TieChange& change : entry.untied) engine.redo(change);
  std::move(entry.untied.begin(), entry.untied.end(), std::back_inserter(entry.ties));
  entry.untied.clear();
}

void NamedMatter::obey(Engine& engine, const PaintCells& command) {
  std::vector<Coat> coats{
      {sparing(engine, engine.particlesIn(command.lattice, command.cells), command.spared), command.material}};
  std::vector<Coat> painted;
  paint(engine, coats, painted);
  if (command.key == 0 || painted[0].isNothing()) return;
  Entry& entry = m_entries[command.key];
  entry.afterStart = engine.solver().frame() > 0;
  entry.painted.push_back(std::move(painted[0]));
}

void NamedMatter::obey(Engine& engine, const NameMatter& command) {
  std::vector<uint32_t> ids = ofBody(engine, engine.particlesIn(command.lattice, command.cells), command.body);
  Entry& entry = m_entries[command.key];
  if (!command.paintedFrom.empty()) {
    entry.before.push_back({std::move(ids), command.paintedFrom});
    return;
  }
  // Of a sketch that has come apart its pieces are named one after the other.
  const ParticleStore& store = engine.particles();
  for (const uint32_t i : store.indicesOf(entry.ids)) ids.push_back(store.id()[i]);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  entry = {};
  entry.ids = std::move(ids);
}

void NamedMatter::obey(Engine& engine, const ReturnBody& command) {
  if (const auto found = m_entries.find(command.key); found != m_entries.end()) {
    putBack(engine, found->second);
    return;
  }
  if (!command.body) return;
  finishHands(engine);
  std::vector<uint32_t> ids = engine.addBody(*command.body);
  Entry& entry = m_entries[command.key] = {};
  entry.ids = std::move(ids);
  for (const NameMatter& named : command.named) obey(engine, named);
}

void NamedMatter::obey(Engine&, const ForgetMatter& command) {
  for (const MatterKey key : command.keys) {
    const auto found = m_entries.find(key);
    if (found == m_entries.end()) continue;
    if (found->second.erasedOrPainted()) m_settled.push_back(key);
    m_entries.erase(found);
  }
}

void NamedMatter::obey(Engine& engine, const TouchMatter& command) {
  Hand::require(command, engine);
  Entry& entry = m_entries[command.key];
  if (!entry.hand) entry.hand.emplace();
  entry.hand->move(command);
  if (entry.hand->isGone()) entry.hand.reset();
}

void NamedMatter::obey(Engine& engine, const UndoTouch& command) {
  const auto found = m_entries.find(command.key);
  if (found == m_entries.end()) return;
  Entry& entry = found->second;
  entry.hand.reset();
  if (!entry.heat.empty()) entry.taken = negated(giveHeat(engine, negated(entry.heat)));  // else it is taken already
  entry.heat.clear();
  undoTies(engine, entry);
  unpaint(engine, entry.painted, entry.bare);
  paint(engine, entry.before, entry.stripped);
}

void NamedMatter::obey(Engine& engine, const RedoTouch& command) {
  const auto found = m_entries.find(command.key);
  if (found == m_entries.end()) return;
  found->second.heat = giveHeat(engine, found->second.taken);
  found->second.taken.clear();
  redoTies(engine, found->second);
  unpaint(engine, found->second.stripped, found->second.before);
  paint(engine, found->second.bare, found->second.painted);
}

}  // namespace ps
