// SPDX-License-Identifier: Apache-2.0
// Several things in the inspector: rows that all of them have, a dash where they disagree, and edits that reach all.
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/rowmodels.h"
#include "ui/session/selection.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"

#include <QtCore/QTimer>

#include <algorithm>
#include <utility>

namespace ps {
namespace {

Address withId(Address address, const std::string& id) {
  address.id = id;
  return address;
}

/// Whether it is of that thing: shape and constraints are a body's.
bool isOf(const Address& address, const Address& thing) {
  const bool ofBody = address.owner == Owner::Shape || address.owner == Owner::Constraint;
  return address.id == thing.id && (ofBody ? Owner::Body : address.owner) == thing.owner;
}

QString countOf(Owner owner, size_t count) {
  const auto counted = [count](const char* one, const char* many) {
    return countText(count, QString::fromLatin1(one), QString::fromLatin1(many));
  };
  return owner == Owner::Wall      ? counted("wall", "walls")
         : owner == Owner::Emitter ? counted("tap", "taps")
         : owner == Owner::Sink    ? counted("drain", "drains")
         : owner == Owner::Probe   ? counted("probe", "probes")
                                   : counted("body", "bodies");
}

}  // namespace

void Inspector::setBodies(const std::vector<std::string>& ids) {
  m_bodies.clear();
  for (const std::string& id : ids) m_bodies.push_back({Owner::Body, id, ""});
  setThings({});
}

void Inspector::setThings(std::vector<Address> things) {
  m_things = std::move(things);
  m_differing.clear();
  rebuildBody();
}

/// All of the last one's kind. A single wall, tap or drain has its rows on the page of the scene, among the others.
void Inspector::showSelected() {
  if (m_selection.empty()) return;
  std::vector<Address> things;
  for (const SelectedItem& item : m_selection.items()) {
    const auto thing = item.kind == m_selection.kind() ? thingOf(item) : std::nullopt;
    if (thing) things.push_back(*thing);
  }
  const OutlineKind kind = m_selection.kind();
  const bool ofScene = kind == OutlineKind::Wall || kind == OutlineKind::Emitter || kind == OutlineKind::Sink;
  if (kind == OutlineKind::Probe || (ofScene && things.size() > 1))
    setThings(std::move(things));
  else
    setBodies(m_selection.bodies());
}

const std::vector<Address>& Inspector::shown() const {
  return !m_things.empty() && m_document.marks(m_things.back()) ? m_things : m_bodies;
}

/// Of the row and of all other things that are shown with it; the row's own alone where it is of none of them.
std::vector<Address> Inspector::addressesOf(const Address& address) const {
  std::vector<Address> all{address};
  const std::vector<Address>& things = shown();
  if (things.empty() || !isOf(address, things.back())) return all;
  for (size_t k = 0; k + 1 < things.size(); ++k) all.push_back(withId(address, things[k].id));
  return all;
}

/// An edit of all comes as one event of each, after which the row is asked again: who was found to differ is asked
/// first, and the others from the last on, which an edit reaches last. Else n events would compare n values each.
bool Inspector::isMixed(const Address& address) const {
  const std::vector<Address>& things = shown();
  if (things.size() < 2 || !isOf(address, things.back())) return false;
  const Value own = m_document.value(address);
  const auto differs = [&](const std::string& id) {
    ++m_compared;
    return !(m_document.value(withId(address, id)) == own);
  };
  std::string& known = m_differing[address.text()];
  if (!known.empty() && differs(known)) return true;
  const auto found =
      std::find_if(things.rbegin() + 1, things.rend(), [&](const Address& thing) { return differs(thing.id); });
  known = found == things.rend() ? std::string() : found->id;
  return !known.empty();
}

void Inspector::shareRows(std::vector<RowModel>& rows) const {
  if (shown().size() < 2) return;
  std::erase_if(rows, [&](const RowModel& row) {
    const auto address = Address::parse(row.key.toStdString());
    const std::vector<Address> all = addressesOf(*address);
    return !std::all_of(all.begin(), all.end(), [&](const Address& one) { return hasRow(m_document, one); });
  });
  for (RowModel& row : rows) row.mixed = isMixed(*Address::parse(row.key.toStdString()));
}

/// "3 bodies", with their names below.
bool Inspector::showCount() {
  const std::vector<Address>& things = shown();
  if (things.size() < 2) return false;
  QStringList names;
  for (const Address& thing : things) {
    if (m_document.marks(thing)) names << ownerLabel(m_document.project(), thing);
  }
  const bool bodies = m_things.empty();
  m_body->setHeader(countOf(things.back().owner, static_cast<size_t>(names.size())), names.join(QStringLiteral(", ")),
                    bodies ? m_count : QString());
  if (bodies) countSoon();
  return true;
}

/// Of those that are shown, as they stand at the start: before what is dragged or typed acts there. "" where none is.
QString Inspector::countOfBodies() const {
  const double spacing = numberOf(m_document.project().solver.parameters, solverParameters(), "particle_spacing");
  double count = 0;
  for (const Address& one : m_bodies) {
    if (const Body* body = m_document.body(one.id)) count += particleCount(*body, spacing);
  }
  return count > 0 ? particlesAhead(count) : QString();
}

void Inspector::countSoon() {
  if (std::exchange(m_counts, true)) return;
  QTimer::singleShot(0, this, [this] {
    m_counts = false;
    m_count = countOfBodies();
    if (m_things.empty()) m_body->setHeaderDetail(m_count);
  });
}

/// One of several things has another value.
void Inspector::refreshMixed(const Address& changed) {
  const std::vector<Address>& things = shown();
  if (std::none_of(things.begin(), things.end(), [&](const Address& thing) { return isOf(changed, thing); })) return;
  const Address own = withId(changed, things.back().id);
  m_body->setMixed(QString::fromStdString(own.text()), isMixed(own));
}

QString Inspector::setAll(const std::vector<Address>& all, const Value& value) {
  if (all.size() == 1) return setOne(all.front(), value);
  if (const QString keyed = whyKeyed(all); !keyed.isEmpty()) return keyed;
  std::vector<std::pair<Address, Value>> values;
  for (const Address& one : all) values.emplace_back(one, value);
  return m_document.setParameters(values, titleOfAll(all.front(), all.size()));
}

/// Their own values are hidden by keys; "" where none has any.
QString Inspector::whyKeyed(const std::vector<Address>& all) const {
  QStringList names;
  for (const Address& one : all) {
    if (m_document.track(one)) names << ownerLabel(m_document.project(), one);
  }
  return names.isEmpty()
             ? QString()
             : QStringLiteral("%1 has keys over time here: select it alone.").arg(names.join(QStringLiteral(", ")));
}

QString Inspector::titleOfAll(const Address& address, size_t count) const {
  const api::ParameterDeclaration* declaration = m_document.declaration(address);
  const Owner owner = shown().empty() ? Owner::Body : shown().back().owner;
  return QStringLiteral("%1 of %2")
      .arg(declaration ? QString::fromUtf8(declaration->label) : QString(), countOf(owner, count));
}

void Inspector::onScaled(const QString& key, double factor, bool together) {
  const auto address = Address::parse(key.toStdString());
  const api::ParameterDeclaration* declaration = address ? m_document.declaration(*address) : nullptr;
  if (!declaration) return;
  const std::vector<Address> all = together ? addressesOf(*address) : std::vector{*address};
  std::vector<std::pair<Address, Value>> values;
  for (const Address& one : all) {
    const Value value = m_document.value(one);
    if (const auto* number = std::get_if<double>(&value))
      values.emplace_back(one, scaledValue(*declaration, *number, factor));
  }
  if (values.empty()) return;
  QString problem = whyKeyed(all);
  if (problem.isEmpty()) problem = m_document.setParameters(values, titleOfAll(*address, values.size()));
  for (ParameterPanel* panel : panels()) panel->setError(key, problem);
}

/// A body is at another pose.
void Inspector::showPlace(const std::string& id) {
  const Body* body = m_document.body(id);
  if (!body || !std::holds_alternative<SolidShape>(body->shape)) return;
  const api::ParameterList list = solidParameters();
  for (size_t k = 0; k < list.count; ++k) {
    if (list[k].actsAt != api::ActsAt::WithItsMatter) continue;
    const Address address{Owner::Shape, id, list[k].key};
    for (ParameterPanel* panel : panels())
      panel->setValue(QString::fromStdString(address.text()), m_document.value(address));
    refreshMixed(address);
  }
}

/// What rows edit is what is selected: of several bodies nobody would see which one it is. False: it is already.
bool Inspector::selectAlone(OutlineKind kind, const std::string& id) {
  if (m_selection.items() == std::vector<SelectedItem>{{kind, id}}) return false;
  if (kind == OutlineKind::Body && !m_document.body(id)) return false;
  if (kind == OutlineKind::Probe && !m_document.probe(id)) return false;
  m_selection.select(kind, id);
  return true;
}

ParameterPanel* Inspector::panelFor(const Address& address) {
  if (address.owner == Owner::Material) {
    m_selection.setMaterial(address.id);
    setMaterial(address.id);
    return m_material;
  }
  if (address.owner == Owner::Probe) {
    if (!selectAlone(OutlineKind::Probe, address.id)) setThings({{Owner::Probe, address.id, ""}});
    return m_body;
  }
  if (address.owner == Owner::Body || address.owner == Owner::Constraint || address.owner == Owner::Shape) {
    if (!selectAlone(OutlineKind::Body, address.id)) setBody(address.id);
    return m_body;
  }
  return m_solver->row(QString::fromStdString(address.text())) ? m_solver : m_scene;
}

}  // namespace ps
