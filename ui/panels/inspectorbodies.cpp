// SPDX-License-Identifier: Apache-2.0
// Several things in the inspector: rows that all of them have, a dash where they disagree, and edits that reach all.
#include "core/scene/knowncount.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/rowmodels.h"
#include "ui/panels/sharedrows.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/selection.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"

#include <QtCore/QTimer>

#include <algorithm>
#include <optional>
#include <utility>

namespace ps {
namespace {

Address withId(Address address, const std::string& id) {
  address.id = id;
  return address;
}

QString countOf(Owner owner, size_t count) {
  const auto counted = [count](const char* one, const char* many) {
    return countText(count, QString::fromLatin1(one), QString::fromLatin1(many));
  };
  return owner == Owner::Wall       ? counted("wall", "walls")
         : owner == Owner::Emitter  ? counted("tap", "taps")
         : owner == Owner::Sink     ? counted("drain", "drains")
         : owner == Owner::Probe    ? counted("probe", "probes")
         : owner == Owner::Material ? counted("material", "materials")
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

const std::vector<Address>& Inspector::fellowsOf(const Address& address) const {
  return address.owner == Owner::Material ? m_materials : shown();
}

/// Of the row and of all other things that are shown with it; the row's own alone where it is of none of them, or on a
/// page that shows others.
std::vector<Address> Inspector::addressesOf(const Address& address, const ParameterPanel* panel) const {
  std::vector<Address> all{address};
  if (panel != (address.owner == Owner::Material ? m_material : m_body)) return all;
  const std::vector<Address>& things = fellowsOf(address);
  if (things.empty() || !SharedRows::isOf(address, things.back())) return all;
  for (size_t k = 0; k + 1 < things.size(); ++k) all.push_back(withId(address, things[k].id));
  return all;
}

/// An edit of all comes as one event of each, after which the row is asked again: who was found to differ is asked
/// first, and the others from the last on, which an edit reaches last. Else n events would compare n values each.
bool Inspector::isMixed(const Address& address) const {
  const std::vector<Address>& things = fellowsOf(address);
  if (things.size() < 2 || !SharedRows::isOf(address, things.back())) return false;
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

/// Rows of others, which are pinned, stay as they are.
void Inspector::shareRows(std::vector<RowModel>& rows, const std::vector<Address>& things) const {
  if (things.size() < 2) return;
  SharedRows shared(m_document, things);
  std::erase_if(rows, [&](const RowModel& row) {
    // What is kept of a plugin that is missing may be called anything.
    const auto address = Address::parse(row.key.toStdString());
    return !address || (SharedRows::isOf(*address, things.back()) && !shared.allHave(*address));
  });
  for (RowModel& row : rows) {
    const Address address = *Address::parse(row.key.toStdString());
    if (!SharedRows::isOf(address, things.back())) continue;
    std::string& differing = m_differing[address.text()];
    differing = shared.differing(address);
    row.together = true;
    row.mixed = !differing.empty();
    row.source.clear();
  }
  m_compared += shared.compared();
  m_searched += shared.searches();
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
  bool known = true;
  for (const Address& one : m_bodies) {
    const Body* body = m_document.body(one.id);
    if (!body) continue;
    const std::optional<double> exact = knownCount(*body, spacing);
    known = known && exact;
    count += exact ? *exact : particleCount(*body, spacing);
  }
  if (count == 0) return {};
  if (!known) return particlesAhead(count);
  return countText(static_cast<size_t>(count), QStringLiteral("particle"), QStringLiteral("particles"));
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
  const std::vector<Address>& things = fellowsOf(changed);
  if (std::none_of(things.begin(), things.end(),
                   [&](const Address& thing) { return SharedRows::isOf(changed, thing); }))
    return;
  const Address own = withId(changed, things.back().id);
  (changed.owner == Owner::Material ? m_material : m_body)->setMixed(QString::fromStdString(own.text()), isMixed(own));
}

QString Inspector::setAll(const std::vector<Address>& all, const Value& value) {
  if (all.size() == 1) return setOne(all.front(), value);
  std::vector<std::pair<Address, Value>> values;
  for (const Address& one : all) values.emplace_back(one, value);
  return setEach(values);
}

QString Inspector::setEach(const std::vector<std::pair<Address, Value>>& values) {
  std::vector<Address> all;
  for (const auto& [one, value] : values) all.push_back(one);
  if (const QString keyed = whyKeyed(all); !keyed.isEmpty()) return keyed;
  return m_document.setParameters(values, titleOfAll(all.front(), all.size()));
}

/// Their own values are hidden by keys; "" where none has any.
QString Inspector::whyKeyed(const std::vector<Address>& all) const {
  QStringList names;
  for (const Address& one : all) {
    const bool keyed = m_tracked.contains(one.text()) || m_document.track(one);  // m_tracked: of a curve's points too
    if (keyed) names << ownerLabel(m_document.project(), one);
  }
  return names.isEmpty()
             ? QString()
             : QStringLiteral("%1 has keys over time here: select it alone.").arg(names.join(QStringLiteral(", ")));
}

QString Inspector::titleOfAll(const Address& address, size_t count) const {
  const api::ParameterDeclaration* declaration = m_document.declaration(address);
  const std::vector<Address>& things = fellowsOf(address);
  const Owner owner = things.empty() ? Owner::Body : things.back().owner;
  return QStringLiteral("%1 of %2")
      .arg(declaration ? QString::fromUtf8(declaration->label) : QString(), countOf(owner, count));
}

void Inspector::showProblem(const QString& key, const QString& problem) {
  for (ParameterPanel* panel : panels()) panel->setError(key, problem);
}

/// All or none: of one that cannot be scaled the row says why. A curve that is dragged starts from what it was.
void Inspector::onScaled(const QString& key, double factor, double added, const ParameterPanel* panel) {
  const auto address = Address::parse(key.toStdString());
  if (!address || !m_document.declaration(*address)) return;
  std::vector<std::pair<Address, Value>> values = m_editedFrom;
  if (values.empty()) {
    for (const Address& one : addressesOf(*address, panel)) values.emplace_back(one, m_document.value(one));
  }
  for (auto& [one, value] : values) {
    const QString problem = scale(value, *m_document.declaration(one), factor, added);
    if (problem.isEmpty()) continue;
    return showProblem(key, QStringLiteral("%1: %2").arg(ownerLabel(m_document.project(), one), problem));
  }
  showProblem(key, setEach(values));
}

/// Each to its own default.
void Inspector::onReset(const QString& key, const ParameterPanel* panel) {
  const auto address = Address::parse(key.toStdString());
  if (!address || !m_document.declaration(*address)) return;
  std::vector<std::pair<Address, Value>> values;
  for (const Address& one : addressesOf(*address, panel)) values.emplace_back(one, m_document.defaultValue(one));
  showProblem(key, setEach(values));
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
  showEdges(id);
}

void Inspector::showEdges(const std::string& id) {
  const Address held{Owner::Shape, id, "held"};
  if (const api::ParameterDeclaration* declaration = m_document.declaration(held))
    m_body->setChoiceLabels(QString::fromStdString(held.text()),
                            choiceLabels(m_document.project(), m_document.plugins(), held, *declaration));
}

/// What rows edit is what is selected: of several bodies nobody would see which one it is. False: it is already.
bool Inspector::selectAlone(OutlineKind kind, const std::string& id) {
  if (m_selection.items() == std::vector<SelectedItem>{{kind, id}}) return false;
  if (kind == OutlineKind::Body && !m_document.body(id)) return false;
  if (kind == OutlineKind::Probe && !m_document.probe(id)) return false;
  m_selection.select(kind, id);
  return true;
}

bool Inspector::has(const Address& address) const { return hasRow(m_document, address); }

ParameterPanel* Inspector::panelFor(const Address& address) {
  if (address.owner == Owner::Material) {
    m_selection.setMaterial(address.id);
    setMaterials({address.id});
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
