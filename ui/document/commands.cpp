// SPDX-License-Identifier: Apache-2.0
#include "ui/document/commands.h"

#include "ui/document/document.h"

#include <algorithm>

namespace ps {

ParameterCommand::ParameterCommand(Document& document, std::vector<ParameterEdit> edits, int gesture,
                                   const QString& text)
    : WeighedCommand(text), m_document(document), m_edits(std::move(edits)), m_gesture(gesture) {
  setObsolete(isNothing());
}

void ParameterCommand::undo() {
  for (auto edit = m_edits.rbegin(); edit != m_edits.rend(); ++edit)
    m_document.applyParameter(edit->address, edit->before);
}
void ParameterCommand::redo() {
  for (const ParameterEdit& edit : m_edits) m_document.applyParameter(edit.address, edit.after);
}

void ParameterCommand::weigh(Weight& weight) const {
  weight.own += m_edits.capacity() * sizeof(ParameterEdit);
  for (const ParameterEdit& edit : m_edits) weight.add(edit.address, edit.before, edit.after);
}

bool ParameterCommand::isNothing() const {
  return std::all_of(m_edits.begin(), m_edits.end(),
                     [](const ParameterEdit& edit) { return edit.before == edit.after; });
}

bool ParameterCommand::amend(const Address& address, const std::optional<Value>& refused,
                             const std::optional<Value>& kept) {
  const auto edit = std::find_if(m_edits.begin(), m_edits.end(), [&](const ParameterEdit& one) {
    return one.address == address && one.after == refused;
  });
  if (edit == m_edits.end()) return false;
  edit->after = kept;
  setObsolete(isNothing());
  return true;
}

bool ParameterCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const ParameterCommand*>(other);
  const bool same = std::equal(
      m_edits.begin(), m_edits.end(), next->m_edits.begin(), next->m_edits.end(),
      [](const ParameterEdit& first, const ParameterEdit& second) { return first.address == second.address; });
  if (next->m_gesture != m_gesture || !same) return false;
  for (size_t k = 0; k < m_edits.size(); ++k) m_edits[k].after = next->m_edits[k].after;
  setObsolete(isNothing());
  return true;
}

BodiesCommand::BodiesCommand(Document& document, std::vector<SceneEdit> edits, const QString& text, MatterRef matter)
    : WeighedCommand(text), m_document(document), m_edits(std::move(edits)), m_matter(std::move(matter)) {}

void BodiesCommand::undo() { apply(false); }
void BodiesCommand::redo() { apply(true); }

void BodiesCommand::apply(bool forward) { m_document.applyBodies(m_edits, forward, m_matter); }

namespace {
bool samePlace(const Emitter& a, const Emitter& b) {
  return a.point == b.point && a.direction == b.direction && a.parameters == b.parameters;
}
bool samePlace(const Sink& a, const Sink& b) {
  return a.minimum == b.minimum && a.maximum == b.maximum && a.parameters == b.parameters;
}
}  // namespace

PortCommand::PortCommand(Document& document, AnyPortEdit edit, int gesture, const QString& text)
    : WeighedCommand(text), m_document(document), m_edit(std::move(edit)), m_gesture(gesture) {}

void PortCommand::undo() { m_document.applyPort(m_edit, false); }
void PortCommand::redo() { m_document.applyPort(m_edit, true); }

void PortCommand::weigh(Weight& weight) const {
  std::visit([&](const auto& edit) { weight.add(edit); }, m_edit);
}

bool PortCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const PortCommand*>(other);
  if (next->m_gesture != m_gesture || next->m_edit.index() != m_edit.index()) return false;
  return std::visit(
      [&](auto& edit) {
        const auto& later = std::get<std::decay_t<decltype(edit)>>(next->m_edit);
        if (!edit.before || !edit.after || !later.after || later.after->id != edit.after->id) return false;
        edit.after = later.after;
        setObsolete(samePlace(*edit.before, *edit.after) && edit.before->name == edit.after->name);
        return true;
      },
      m_edit);
}

namespace {
bool samePlace(const Body& a, const Body& b) { return a.shape == b.shape; }
bool samePlace(const SceneWall& a, const SceneWall& b) {
  return a.point == b.point && a.normal == b.normal && a.parameters == b.parameters;
}
bool samePlace(const Probe& a, const Probe& b) { return a == b; }
bool samePlace(const BodyPins& a, const BodyPins& b) { return a.boxes == b.boxes; }

template <class Item>
bool sameThings(const std::vector<Item>& a, const std::vector<Item>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Item& x, const Item& y) { return x.id == y.id; });
}
template <class Item>
bool samePlaces(const std::vector<Item>& a, const std::vector<Item>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Item& x, const Item& y) { return samePlace(x, y); });
}
bool samePlaces(const Placement& a, const Placement& b) {
  return samePlaces(a.bodies, b.bodies) && samePlaces(a.emitters, b.emitters) && samePlaces(a.sinks, b.sinks) &&
         samePlaces(a.walls, b.walls) && samePlaces(a.probes, b.probes) && samePlaces(a.pins, b.pins);
}
bool sameThings(const Placement& a, const Placement& b) {
  return sameThings(a.bodies, b.bodies) && sameThings(a.emitters, b.emitters) && sameThings(a.sinks, b.sinks) &&
         sameThings(a.walls, b.walls) && sameThings(a.probes, b.probes) && sameThings(a.pins, b.pins);
}
}  // namespace

PlacementCommand::PlacementCommand(Document& document, Placement before, Placement after, int gesture,
                                   const QString& text)
    : WeighedCommand(text),
      m_document(document),
      m_before(std::move(before)),
      m_after(std::move(after)),
      m_gesture(gesture) {
  setObsolete(samePlaces(m_before, m_after));
}

void PlacementCommand::undo() { m_document.applyPlacement(m_before); }
void PlacementCommand::redo() { m_document.applyPlacement(m_after); }

bool PlacementCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const PlacementCommand*>(other);
  if (next->m_gesture != m_gesture || !sameThings(m_after, next->m_after)) return false;
  m_after = next->m_after;
  setObsolete(samePlaces(m_before, m_after));
  return true;
}

WallsCommand::WallsCommand(Document& document, std::vector<SceneWall> before, std::vector<SceneWall> after,
                           const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void WallsCommand::undo() { m_document.applyWalls(m_before); }
void WallsCommand::redo() { m_document.applyWalls(m_after); }

MarksCommand::MarksCommand(Document& document, std::vector<ThingMarks> before, std::vector<ThingMarks> after,
                           const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void MarksCommand::undo() { m_document.applyMarks(m_before); }
void MarksCommand::redo() { m_document.applyMarks(m_after); }

MaterialsCommand::MaterialsCommand(Document& document, std::vector<SceneMaterial> before,
                                   std::vector<SceneMaterial> after, const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void MaterialsCommand::undo() { m_document.applyMaterials(m_before); }
void MaterialsCommand::redo() { m_document.applyMaterials(m_after); }

StrokeCommand::StrokeCommand(Document& document, std::shared_ptr<StrokeRecord> stroke, const QString& text)
    : WeighedCommand(text), m_document(document), m_stroke(std::move(stroke)) {}

void StrokeCommand::undo() { m_document.applyStroke(m_stroke, false, false); }

void StrokeCommand::redo() {
  m_document.applyStroke(m_stroke, true, m_live);
  m_live = false;
}

StateCommand::StateCommand(Document& document, State before, State after, const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void StateCommand::undo() { m_document.applyState(m_before); }
void StateCommand::redo() { m_document.applyState(m_after); }

TrackCommand::TrackCommand(Document& document, std::vector<TrackEdit> edits, int gesture, const QString& text)
    : WeighedCommand(text), m_document(document), m_edits(std::move(edits)), m_gesture(gesture) {
  setObsolete(isNothing());
}

void TrackCommand::undo() {
  for (auto edit = m_edits.rbegin(); edit != m_edits.rend(); ++edit) m_document.applyTrack(*edit, false);
}
void TrackCommand::redo() {
  for (const TrackEdit& edit : m_edits) m_document.applyTrack(edit, true);
}

void TrackCommand::weigh(Weight& weight) const {
  weight.own += m_edits.capacity() * sizeof(TrackEdit);
  for (const TrackEdit& edit : m_edits) weight.add(edit.before, edit.after);
}

bool TrackCommand::isNothing() const {
  return std::all_of(m_edits.begin(), m_edits.end(), [](const TrackEdit& edit) { return edit.before == edit.after; });
}

bool TrackCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const TrackCommand*>(other);
  const bool same = std::equal(m_edits.begin(), m_edits.end(), next->m_edits.begin(), next->m_edits.end(),
                               [](const TrackEdit& first, const TrackEdit& second) {
                                 return first.after && second.before && first.after == second.before;
                               });
  if (next->m_gesture != m_gesture || !same) return false;
  for (size_t k = 0; k < m_edits.size(); ++k) m_edits[k].after = next->m_edits[k].after;
  setObsolete(isNothing());
  return true;
}

OrderCommand::OrderCommand(Document& document, SceneOrder before, SceneOrder after, const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {
  setObsolete(m_before == m_after);
}

void OrderCommand::undo() { m_document.applyOrder(m_before); }
void OrderCommand::redo() { m_document.applyOrder(m_after); }

GraphsCommand::GraphsCommand(Document& document, Graphs before, Graphs after, const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void GraphsCommand::undo() { m_document.applyGraphs(m_before); }
void GraphsCommand::redo() { m_document.applyGraphs(m_after); }

MarkersCommand::MarkersCommand(Document& document, std::vector<Marker> before, std::vector<Marker> after, int gesture,
                               const QString& text)
    : WeighedCommand(text),
      m_document(document),
      m_before(std::move(before)),
      m_after(std::move(after)),
      m_gesture(gesture) {}

void MarkersCommand::undo() { m_document.applyMarkers(m_before); }
void MarkersCommand::redo() { m_document.applyMarkers(m_after); }

bool MarkersCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const MarkersCommand*>(other);
  if (next->m_gesture != m_gesture) return false;
  m_after = next->m_after;
  setObsolete(m_before == m_after);
  return true;
}

ProbeCommand::ProbeCommand(Document& document, ProbeEdit edit, int gesture, const QString& text)
    : WeighedCommand(text), m_document(document), m_edit(std::move(edit)), m_gesture(gesture) {
  setObsolete(m_edit.before == m_edit.after);
}

void ProbeCommand::undo() { m_document.applyProbe(m_edit, false); }
void ProbeCommand::redo() { m_document.applyProbe(m_edit, true); }

bool ProbeCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const ProbeCommand*>(other);
  if (next->m_gesture != m_gesture || !m_edit.before || !m_edit.after || !next->m_edit.after ||
      next->m_edit.after->id != m_edit.after->id)
    return false;
  m_edit.after = next->m_edit.after;
  setObsolete(m_edit.before == m_edit.after);
  return true;
}

AboutCommand::AboutCommand(Document& document, ProjectAbout before, ProjectAbout after, const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void AboutCommand::undo() { m_document.applyAbout(m_before); }
void AboutCommand::redo() { m_document.applyAbout(m_after); }

void AboutCommand::weigh(Weight& weight) const {
  for (const ProjectAbout* about : {&m_before, &m_after})
    weight.add(about->title, about->description, about->toTry, about->thumbnail);
}

PinsCommand::PinsCommand(Document& document, std::vector<std::string> before, std::vector<std::string> after,
                         const QString& text)
    : WeighedCommand(text), m_document(document), m_before(std::move(before)), m_after(std::move(after)) {}

void PinsCommand::undo() { m_document.applyPins(m_before); }
void PinsCommand::redo() { m_document.applyPins(m_after); }

}  // namespace ps
