// SPDX-License-Identifier: Apache-2.0
// Several bodies in the inspector: rows that all of them have, a dash where they disagree, and edits that reach all.
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

Address ofBody(Address address, const std::string& id) {
  address.id = id;
  return address;
}

bool isOfBodies(const Address& address) {
  return address.owner == Owner::Body || address.owner == Owner::Shape || address.owner == Owner::Constraint;
}

}  // namespace

void Inspector::setBodies(const std::vector<std::string>& ids) {
  m_probeId.clear();
  m_bodyId = ids.empty() ? std::string() : ids.back();
  m_differing.clear();
  m_others.assign(ids.begin(), ids.empty() ? ids.end() : ids.end() - 1);
  rebuildBody();
}

/// Of the row and of all other bodies that are shown with it; the row's own alone where it is of none of them.
std::vector<Address> Inspector::addressesOf(const Address& address) const {
  std::vector<Address> all{address};
  if (!isOfBodies(address) || address.id != m_bodyId) return all;
  for (const std::string& id : m_others) all.push_back(ofBody(address, id));
  return all;
}

/// An edit of all comes as one event of each, after which the row is asked again: who was found to differ is asked
/// first, and the others from the last on, which an edit reaches last. Else n events would compare n values each.
bool Inspector::isMixed(const Address& address) const {
  if (m_others.empty() || !isOfBodies(address) || address.id != m_bodyId) return false;
  const Value own = m_document.value(address);
  const auto differs = [&](const std::string& id) {
    ++m_compared;
    return !(m_document.value(ofBody(address, id)) == own);
  };
  std::string& known = m_differing[address.text()];
  if (!known.empty() && differs(known)) return true;
  const auto found = std::find_if(m_others.rbegin(), m_others.rend(), differs);
  known = found == m_others.rend() ? std::string() : *found;
  return !known.empty();
}

void Inspector::shareRows(std::vector<RowModel>& rows) const {
  if (m_others.empty()) return;
  std::erase_if(rows, [&](const RowModel& row) {
    const auto address = Address::parse(row.key.toStdString());
    const std::vector<Address> all = addressesOf(*address);
    return !std::all_of(all.begin(), all.end(), [&](const Address& one) { return hasRow(m_document, one); });
  });
  for (RowModel& row : rows) row.mixed = isMixed(*Address::parse(row.key.toStdString()));
}

/// "3 bodies", with their names below.
bool Inspector::showBodiesHeader() {
  if (m_others.empty()) return false;
  QStringList names;
  for (const std::string& id : m_others) {
    if (const Body* body = m_document.body(id)) names << nameOf(*body);
  }
  if (const Body* body = m_document.body(m_bodyId)) names << nameOf(*body);
  m_body->setHeader(countText(static_cast<size_t>(names.size()), QStringLiteral("body"), QStringLiteral("bodies")),
                    names.join(QStringLiteral(", ")), m_count);
  countSoon();
  return true;
}

/// Of those that are shown, as they stand at the start: before what is dragged or typed acts there. "" where none is.
QString Inspector::countOfBodies() const {
  const double spacing = numberOf(m_document.project().solver.parameters, solverParameters(), "particle_spacing");
  double count = 0;
  for (const Address& one : addressesOf({Owner::Body, m_bodyId, ""})) {
    if (const Body* body = m_document.body(one.id)) count += particleCount(*body, spacing);
  }
  return count > 0 ? particlesAhead(count) : QString();
}

void Inspector::countSoon() {
  if (std::exchange(m_counts, true)) return;
  QTimer::singleShot(0, this, [this] {
    m_counts = false;
    m_count = countOfBodies();
    if (m_probeId.empty()) m_body->setHeaderDetail(m_count);
  });
}

/// One of several bodies has another value.
void Inspector::refreshMixed(const Address& changed) {
  if (m_others.empty() || std::find(m_others.begin(), m_others.end(), changed.id) == m_others.end()) {
    if (changed.id != m_bodyId) return;
  }
  const Address own = ofBody(changed, m_bodyId);
  m_body->setMixed(QString::fromStdString(own.text()), isMixed(own));
}

QString Inspector::setAll(const Address& address, const Value& value) {
  const std::vector<Address> all = addressesOf(address);
  if (all.size() == 1) return setOne(address, value);
  if (const QString keyed = whyKeyed(all); !keyed.isEmpty()) return keyed;
  std::vector<std::pair<Address, Value>> values;
  for (const Address& one : all) values.emplace_back(one, value);
  return m_document.setParameters(values, titleOfAll(address, all.size()));
}

/// Their own values are hidden by keys; "" where none has any.
QString Inspector::whyKeyed(const std::vector<Address>& all) const {
  QStringList names;
  for (const Address& one : all) {
    const Body* body = m_document.track(one) ? m_document.body(one.id) : nullptr;
    if (body) names << nameOf(*body);
  }
  return names.isEmpty()
             ? QString()
             : QStringLiteral("%1 has keys over time here: select it alone.").arg(names.join(QStringLiteral(", ")));
}

QString Inspector::titleOfAll(const Address& address, size_t count) const {
  const api::ParameterDeclaration* declaration = m_document.declaration(address);
  return QStringLiteral("%1 of %2 bodies")
      .arg(declaration ? QString::fromUtf8(declaration->label) : QString())
      .arg(count);
}

void Inspector::onScaled(const QString& key, double factor) {
  const auto address = Address::parse(key.toStdString());
  const api::ParameterDeclaration* declaration = address ? m_document.declaration(*address) : nullptr;
  if (!declaration) return;
  std::vector<std::pair<Address, Value>> values;
  for (const Address& one : addressesOf(*address)) {
    const Value value = m_document.value(one);
    if (const auto* number = std::get_if<double>(&value))
      values.emplace_back(one, scaledValue(*declaration, *number, factor));
  }
  if (values.empty()) return;
  QString problem = whyKeyed(addressesOf(*address));
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
    if (!selectAlone(OutlineKind::Probe, address.id)) setProbe(address.id);
    return m_body;
  }
  if (address.owner == Owner::Body || address.owner == Owner::Constraint || address.owner == Owner::Shape) {
    if (!selectAlone(OutlineKind::Body, address.id)) setBody(address.id);
    return m_body;
  }
  return m_solver->row(QString::fromStdString(address.text())) ? m_solver : m_scene;
}

}  // namespace ps
