// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/rownotes.h"

#include "core/simulation/events.h"
#include "core/simulation/finersteps.h"
#include "core/simulation/rules.h"
#include "core/simulation/sceneneed.h"
#include "ui/document/document.h"
#include "ui/document/missingplugins.h"
#include "ui/panels/wayout.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"

#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// `cost`: of the reset.
QString waitingText(const QString& cost = {}) {
  return QStringLiteral("Acts once back at the start%1. [Back to the start](%2)")
      .arg(cost, QLatin1String(RowNotes::kReset));
}

/// Behind what the row is told already.
template <class Note>
void add(std::map<QString, Note>& notes, const QString& key, Note note) {
  const auto [at, fresh] = notes.try_emplace(key, note);
  if (fresh) return;
  at->second.text += QLatin1Char('\n') + note.text;
  if (!std::isnan(note.delivered)) at->second.delivered = note.delivered;
}

/// Which substeps a fine spacing takes: those of a new scene are for a coarse one.
template <class Note>
void addFiner(std::map<QString, Note>& notes, const Project& project) {
  const std::optional<int> substeps = substepsAtSpacing(project);
  if (!substeps) return;
  const QString text = QStringLiteral("Matter this fine sinks into itself unless its steps are finer, too. ");
  add(notes, QString::fromStdString(Address{Owner::Solver, "", "particle_spacing"}.text()),
      Note{text + QStringLiteral("[Use %1 substeps](solver/substeps=%1)").arg(*substeps), kNone});
}

}  // namespace

RowNotes::RowNotes(const Document& document, std::vector<ParameterPanel*> panels)
    : m_document(document), m_panels(std::move(panels)) {}

void RowNotes::clear() {
  m_limits.clear();
  m_knowsStart = true;
  m_made.clear();
  m_shown.clear();
  m_culprit.clear();
}

void RowNotes::setSnapshot(const Snapshot& snapshot) {
  m_limits = snapshot.limits;
  m_bodies = snapshot.bodyIds;
  m_particles = snapshot.id.size();
  m_knowsStart = snapshot.knowsStart;
  setRun(snapshot.revision);
  show();
}

void RowNotes::setRun(uint64_t revision) {
  if (revision != m_revision) m_made.clear();
  m_revision = revision;
}

void RowNotes::onChanged(const ParameterChanged& change) {
  noteWaiting(change);
  show();
}

void RowNotes::noteWaiting(const ParameterChanged& change) {
  const Address& address = change.address;
  if (!m_document.actsAtReset(address)) return;
  const auto [made, first] = m_made.try_emplace(address.text(), change.before);
  if (!first && made->second == m_document.value(address)) m_made.erase(made);
}

void RowNotes::addMissing(std::map<QString, Note>& notes) const {
  if (!m_document.plugins()) return;
  for (const MissingPlugin& missing : missingPlugins(m_document.project(), *m_document.plugins())) {
    const QString note = wayout::note(missing, m_document);
    for (const Address& row : missing.rows) add(notes, QString::fromStdString(row.text()), {note, kNone});
  }
}

void RowNotes::addAdvice(std::map<QString, Note>& notes) const {
  for (const ParameterPanel* panel : m_panels) {
    for (const ParameterRow* row : panel->rows()) {
      // A pinned row stands twice.
      if (!row->model().declaration.relations || notes.contains(row->key())) continue;
      const auto address = Address::parse(row->key().toStdString());
      if (!address) continue;
      const std::string advice = adviceOf(m_document.project(), m_document.plugins(), *address);
      if (!advice.empty()) add(notes, row->key(), {asNote(QString::fromStdString(advice)), kNone});
    }
  }
}

void RowNotes::hear(const EngineEvent& event) {
  const QString key = event.culprit ? QString::fromStdString(event.culprit->text()) : QString();
  const QString text = sentence(QString::fromStdString(event.message));
  if (event.kind == EngineEvent::Kind::Refused && !key.isEmpty()) {
    for (ParameterPanel* panel : m_panels) panel->setError(key, text);
    return;
  }
  if (event.kind != EngineEvent::Kind::NotOpened && event.kind != EngineEvent::Kind::Settled) return;
  for (ParameterPanel* panel : m_panels) panel->setError(m_culprit, {});
  m_culprit = key;
  m_problem = text;
  show();
}

/// "solver/particle_spacing=0.01" as a link that does it.
QString RowNotes::linkOf(const std::string& use) const {
  const size_t equals = use.find('=');
  const auto address = Address::parse(use.substr(0, equals));
  const api::ParameterDeclaration* declaration = address ? m_document.declaration(*address) : nullptr;
  if (equals == std::string::npos || !declaration) return {};
  const QString value = QString::fromStdString(use.substr(equals + 1));
  const auto number = parseNumber(value);
  return QStringLiteral(" [Use %1 for %2](%3)")
      .arg(number ? formatValue(*declaration, *number) : value, QString::fromUtf8(declaration->label),
           QString::fromStdString(use));
}

void RowNotes::addLimits(std::map<QString, Note>& notes) const {
  const double substeps = numberOf(m_document.project().solver.parameters, solverParameters(), "substeps");
  for (const Limit& limit : m_limits) {
    const auto address = limitAddress(limit, m_bodies.get());
    if (!address) continue;
    const api::ParameterDeclaration* declaration = m_document.declaration(*address);
    QString text = asNote(limitText(limit, declaration)) + QLatin1Char('.');
    // Heat has steps of its own, and a curve that leaves its range leaves it at any step.
    if (!limit.use.empty())
      text += linkOf(limit.use);
    else if (!limit.kelvin && limit.why.empty() && address->owner != Owner::Solver)
      text +=
          QStringLiteral(" [Use %1 substeps](solver/substeps=%1) to come closer").arg(static_cast<int>(substeps) * 2);
    const bool another = declaration && limit.unit != declaration->unit;  // than what the slider shows
    add(notes, QString::fromStdString(address->text()), {text, limit.kelvin || another ? kNone : limit.delivered});
  }
}

/// ": 1.2 million particles, about 1.9 GB, 12× today's" of what changes their number.
QString RowNotes::costOf(const std::string& address) const {
  if (address != Address{Owner::Solver, "", "particle_spacing"}.text() || m_particles == 0) return {};
  const SceneNeed need = needOf(m_document.project(), m_document.plugins());
  const double times = need.particles / static_cast<double>(m_particles);
  return QStringLiteral(": %1, about %2, %3× today’s")
      .arg(QString::fromStdString(particlesText(need.particles)), QString::fromStdString(memoryText(need.bytes)),
           formatFixed(times, times < 10 ? 1 : 0));
}

void RowNotes::addWaiting(std::map<QString, Note>& notes) const {
  if (m_nothingWaits) return;
  for (const auto& [address, value] : m_made)
    add(notes, QString::fromStdString(address), {waitingText(costOf(address)), kNone});
}

/// Probes of what stood in a box at the start, chosen when nobody had noted where that was.
void RowNotes::addStarts(std::map<QString, Note>& notes) const {
  const Project& project = m_document.project();
  for (const Probe& probe : project.probes) {
    if (m_knowsStart || project.bodies.empty() || !probe.region || probe.regionWhen == Probe::kNow) continue;
    const Address row{Owner::Probe, probe.id, "box_when"};
    add(notes, QString::fromStdString(row.text()), {waitingText(), kNone});
  }
}

void RowNotes::show() {
  std::map<QString, Note> notes;
  addMissing(notes);
  addAdvice(notes);
  addLimits(notes);
  addFiner(notes, m_document.project());
  addWaiting(notes);
  addStarts(notes);
  for (ParameterPanel* panel : m_panels) {
    for (const auto& [key, note] : m_shown)
      if (!notes.count(key)) panel->setLimit(key, {});
    for (const auto& [key, note] : notes) panel->setLimit(key, note.text, note.delivered);
  }
  m_shown = std::move(notes);
  if (m_culprit.isEmpty()) return;
  for (ParameterPanel* panel : m_panels) panel->setError(m_culprit, m_problem);
}

}  // namespace ps
