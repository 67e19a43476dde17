// SPDX-License-Identifier: Apache-2.0
#include "ui/document/document.h"

#include "core/scene/group.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"

#include <QtCore/QFileInfo>

#include <algorithm>

namespace ps {

namespace {

/// Whether an address says what a body is made of: no number in a set, and a command of its own.
bool isComposition(const Address& address) {
  return address.owner == Owner::Body && (address.key == kStructureKey || address.key == kBodyMaterialKey ||
                                          !pluginBehind(address.key, kNeighbourKey).empty());
}

/// By an edit of its pins, or of its sketch's strokes. Other edits of shapes say so by their parameters.
bool isMadeOtherwise(const Body& before, const Body& after) {
  if (before.pins != after.pins) return true;
  const auto* old = std::get_if<VoxelShape>(&before.shape);
  const auto* sketch = std::get_if<VoxelShape>(&after.shape);
  return old && sketch && (old->runs != sketch->runs || old->palette != sketch->palette);
}

}  // namespace

Document::Document(QObject* parent) : QObject(parent) {
  connect(&m_undo, &History::cleanChanged, this, [this] { notify(FileChanged{}); });
  m_undo.setDocument([this](Weight& held) {
    held.add(m_project.state);
    for (const auto& mesh : m_project.meshes) held.add(mesh);
    for (const SceneMaterial& material : m_project.materials) held.add(material.mixture);
    for (const Body& body : m_project.bodies) {
      if (const auto* solid = std::get_if<SolidShape>(&body.shape)) held.add(solid->mesh);
    }
  });
}
Document::~Document() { m_undo.disconnect(this); }

/// The same once more: its materials are others by now.
void Document::setPlugins(const PluginRegistry* plugins) {
  if (std::exchange(m_plugins, plugins) == plugins && plugins) Q_EMIT changed(MaterialsChanged{});
}

void Document::open(Project project, const QString& path, bool dirty, bool play, const FileStamp& file) {
  if (isDirty()) Q_EMIT replacing();
  m_project = std::move(project);
  m_path = path;
  m_file = file;
  m_gestureDepth = 0;
  m_neverClean = dirty;
  m_undo.clear();
  m_usedIds.clear();
  for (const Body& body : m_project.bodies) m_usedIds.insert(body.id);
  for (const Emitter& emitter : m_project.emitters) m_usedIds.insert(emitter.id);
  m_opened = ++m_changes;
  notify(ProjectOpened{play});
  notify(FileChanged{});
}

QString Document::title() const {
  if (!m_project.title.empty()) return QString::fromStdString(m_project.title);
  return m_path.isEmpty() ? QStringLiteral("New scene") : QFileInfo(m_path).completeBaseName();
}

bool Document::isDirty() const { return m_neverClean || !m_undo.isClean(); }

bool Document::saved(const QString& path, uint64_t changeCount, const FileStamp& file) {
  if (!had(changeCount)) return false;
  m_path = path;
  m_file = file;
  if (changeCount == m_changes) {
    m_neverClean = false;
    m_undo.setClean();
  }
  notify(FileChanged{});
  return true;
}

Value Document::value(const Address& address) const { return valueAt(m_project, m_plugins, address); }
Value Document::defaultValue(const Address& address) const { return defaultOf(m_project, m_plugins, address); }
const api::ParameterDeclaration* Document::declaration(const Address& address) const {
  return declarationOf(m_project, m_plugins, address);
}

void Document::beginGesture(const QString& text) {
  if (m_gestureDepth++ > 0) return;
  ++m_gesture;
  m_gestureText = text;
  m_gestureBegan = m_undo.position();
}

bool Document::actsAtReset(const Address& address) const {
  const api::ParameterDeclaration* declared = declaration(address);
  if (!declared) return false;
  const Body* body = this->body(address.id);
  const bool fixed = body && toggleOf(body->parameters, bodyParameters(), "fixed");
  return declared->actsAt == api::ActsAt::NextReset || (declared->actsAt == api::ActsAt::NextFrameIfFixed && !fixed);
}

void Document::endGesture() {
  if (m_gestureDepth > 0 && --m_gestureDepth == 0) ++m_gesture;
}

/// What came before is left alone, also where somebody has undone some of it meanwhile.
void Document::takeGestureBack() {
  if (m_gestureDepth == 0) return;
  while (m_undo.position() > m_gestureBegan && m_undo.canUndo()) m_undo.undo();
}

QString Document::setParameter(const Address& address, const Value& value) {
  const auto refusal = [&] { return QString::fromStdString(problemWith(m_project, m_plugins, address, value)); };
  if (address.owner == Owner::Body && address.key == kStructureKey) {
    if (const QString problem = refusal(); !problem.isEmpty()) return problem;
    setStructure(address.id, std::get<std::string>(value));
    return {};
  }
  if (const std::string plugin = pluginBehind(address.key, kNeighbourKey);
      address.owner == Owner::Body && !plugin.empty()) {
    if (const QString problem = refusal(); !problem.isEmpty()) return problem;
    setNeighbourConstraint(address.id, plugin, std::get<bool>(conformed(value, *declaration(address))));
    return {};
  }
  if (address.owner == Owner::Body && address.key == kBodyMaterialKey) {
    if (const QString problem = refusal(); !problem.isEmpty()) return problem;
    setBodyMaterial(address.id, std::get<std::string>(value));
    return {};
  }
  if (const std::string other = adhesionPartner(address); !other.empty()) {
    if (const QString problem = refusal(); !problem.isEmpty()) return problem;
    setAdhesion(address.id, other, std::get<bool>(conformed(value, *declaration(address))));
    return {};
  }
  if (address.owner == Owner::Probe) return setProbeParameter(address, value);
  const std::optional<Value> outside = outsideValue(m_project, address);
  const ParameterSet* set = findSet(m_project, address);
  if (!set && !outside)
    return QStringLiteral("%1 is no longer part of the scene.").arg(QString::fromStdString(address.text()));
  if (const QString problem = refusal(); !problem.isEmpty()) return problem;
  const api::ParameterDeclaration* declared = declaration(address);
  const std::optional<Value> before = storedValue(m_project, address), after = asStored(address, value);
  if (m_gestureDepth == 0) ++m_gesture;
  const QString text =
      m_gestureText.isEmpty() || m_gestureDepth == 0
          ? QStringLiteral("%1 of %2").arg(QString::fromUtf8(declared->label), ownerLabel(m_project, address))
          : m_gestureText;
  if (m_gestureDepth == 0 && before == after) return {};
  std::vector<TrackEdit> follow = tracksAfter(address, value);
  if (follow.empty()) {
    m_undo.push(new ParameterCommand(*this, {{address, before, after}}, m_gesture, text));
    return {};
  }
  m_undo.beginMacro(text);
  m_undo.push(new ParameterCommand(*this, {{address, before, after}}, m_gesture, text));
  m_undo.push(new TrackCommand(*this, std::move(follow), m_gesture, text));
  m_undo.endMacro();
  return {};
}

/// Judged together: of two that must keep an order, the first may pass where the other was.
QString Document::setParameters(const std::vector<std::pair<Address, Value>>& values, const QString& text) {
  if (std::any_of(values.begin(), values.end(), [](const auto& one) { return one.first.owner == Owner::Probe; }))
    return setProbeParameters(values, text);
  Project together = m_project;
  for (const auto& [address, value] : values) {
    ParameterSet* set = findSet(together, address);
    if (!setOutsideValue(together, address, value) && set) set->values[address.key] = value;
  }
  for (const auto& [address, value] : values) {
    const std::string problem = problemWith(together, m_plugins, address, value);
    if (problem.empty()) continue;
    const QString sentence = QString::fromStdString(problem);
    return values.size() < 2 ? sentence : QStringLiteral("%1: %2").arg(ownerLabel(m_project, address), sentence);
  }
  if (std::any_of(values.begin(), values.end(),
                  [](const auto& one) { return isComposition(one.first) || !adhesionPartner(one.first).empty(); })) {
    m_undo.beginMacro(text);
    for (const auto& [address, value] : values) setParameter(address, value);
    m_undo.endMacro();
    return {};
  }
  std::vector<ParameterEdit> edits;
  for (const auto& [address, value] : values)
    edits.push_back({address, storedValue(m_project, address), asStored(address, value)});
  if (m_gestureDepth == 0) ++m_gesture;
  m_undo.push(new ParameterCommand(*this, std::move(edits), m_gesture, text));
  return {};
}

/// A default is not stored, unless it lies outside of the sets.
std::optional<Value> Document::asStored(const Address& address, const std::optional<Value>& value) const {
  const api::ParameterDeclaration* declared = declaration(address);
  if (!value || !declared) return value;
  const Value whole = conformed(*value, *declared);
  if (outsideValue(m_project, address) || !(whole == conformed(defaultValue(address), *declared))) return whole;
  return std::nullopt;
}

/// Mends the command that set it, whatever came behind: its undo and redo would be refused again. Whoever saved since
/// has saved the refused value.
void Document::takeBack(const Address& address, const Value& asked, const std::optional<Value>& goesOn) {
  const std::optional<Value> refused = asStored(address, asked), kept = asStored(address, goesOn);
  if (storedValue(m_project, address) != refused || refused == kept) return;
  for (int i = m_undo.index(); i-- > 0;) {
    auto* command = dynamic_cast<ParameterCommand*>(m_undo.command(i));
    if (!command || !command->amend(address, refused, kept)) continue;
    if (m_undo.cleanIndex() > i) m_undo.resetClean();
    break;
  }
  applyParameter(address, kept);
}

const Body* Document::body(const std::string& id) const {
  const auto found =
      std::find_if(m_project.bodies.begin(), m_project.bodies.end(), [&](const Body& b) { return b.id == id; });
  return found == m_project.bodies.end() ? nullptr : &*found;
}

void Document::editBody(const std::string& id, const QString& text, const std::function<void(Body&)>& change) {
  const Body* before = body(id);
  if (!before) return;
  BodyEdit edit{id, *before, *before, 0};
  change(*edit.after);
  m_undo.push(new BodiesCommand(*this, {edit}, text));
}

void Document::renameBody(const std::string& id, const QString& name) {
  const Body* old = body(id);
  const std::string wanted = name.trimmed().toStdString();
  if (!old || wanted.empty() || wanted == old->name) return;
  editBody(id, QStringLiteral("rename of %1").arg(nameOf(*old)), [&](Body& b) { b.name = wanted; });
}

std::string Document::freeBodyId(const std::string& stem) {
  for (int n = 1;; ++n) {
    std::string id = n == 1 ? stem : stem + "-" + std::to_string(n);
    if (!body(id) && !emitter(id) && m_usedIds.insert(id).second) return id;
  }
}

void Document::addStroke(std::shared_ptr<StrokeRecord> stroke, const std::string& group) {
  const QString text = !stroke->deed.empty()      ? QString::fromStdString(stroke->deed)
                       : stroke->erase            ? QStringLiteral("erasing stroke")
                       : stroke->material.empty() ? QStringLiteral("brush stroke")
                                                  : QStringLiteral("painting stroke");
  const bool joins = !group.empty() && !stroke->body.empty() && !body(stroke->body);
  const std::string member = memberOf(Owner::Body, stroke->body);
  if (joins) m_undo.beginMacro(text);
  m_undo.push(new StrokeCommand(*this, std::move(stroke), text));
  if (!joins) return;
  SceneOrder after = order();
  for (SceneGroup& one : after.groups) {
    if (one.id == group) one.members.push_back(member);
  }
  setOrder(std::move(after), text);
  m_undo.endMacro();
}

void Document::setSketch(const std::string& id, const VoxelShape& sketch, const QString& title) {
  editBody(id, title, [&](Body& b) { b.shape = sketch; });
}

void Document::addStrokes(const std::vector<std::shared_ptr<StrokeRecord>>& parts, const QString& text) {
  if (parts.size() > 1) m_undo.beginMacro(text);
  for (const std::shared_ptr<StrokeRecord>& part : parts) m_undo.push(new StrokeCommand(*this, part, text));
  if (parts.size() > 1) m_undo.endMacro();
}

void Document::setPinned(const std::string& address, bool pinned) {
  std::vector<std::string> pins = m_project.view.pinned;
  const auto found = std::find(pins.begin(), pins.end(), address);
  if (pinned == (found != pins.end())) return;
  if (pinned) {
    pins.push_back(address);
  } else {
    pins.erase(found);
  }
  m_undo.push(new PinsCommand(*this, m_project.view.pinned, pins,
                              pinned ? QStringLiteral("pinning a row") : QStringLiteral("unpinning a row")));
}

void Document::keepState(std::shared_ptr<const ProjectState> state) {
  m_undo.push(new StateCommand(*this, m_project.state, std::move(state), QStringLiteral("keeping the present state")));
}

void Document::removeState() {
  if (m_project.state)
    m_undo.push(new StateCommand(*this, m_project.state, nullptr, QStringLiteral("removal of the saved state")));
}

ProjectAbout Document::about() const {
  return {m_project.title, m_project.description, m_project.toTry, m_project.duration, m_project.thumbnail};
}

void Document::setAbout(ProjectAbout about, const QString& text) {
  if (about != this->about()) m_undo.push(new AboutCommand(*this, this->about(), std::move(about), text));
}

void Document::setColour(const std::string& colour) {
  if (m_project.view.colour == colour) return;
  m_project.view.colour = colour;
  notify(ViewChanged{});
}

void Document::setView(const ViewState& view) {
  m_project.view.camera = view.camera;
  m_project.view.section = view.section;
}

void Document::applyParameter(const Address& address, const std::optional<Value>& value) {
  ParameterSet* set = findSet(m_project, address);
  const Value before = this->value(address);
  const bool outside = value && setOutsideValue(m_project, address, *value);
  if (!set && !outside) return;
  if (outside) {
    // Done.
  } else if (value) {
    set->values[address.key] = *value;
  } else {
    set->values.erase(address.key);
  }
  ++m_changes;
  notify(ParameterChanged{address, value, before});
}

/// What may change of a body's composition by an edit: as it is now.
std::vector<ParameterChanged> Document::compositionOf(const SceneEdit& edit) const {
  std::vector<ParameterChanged> parts;
  const auto* body = std::get_if<BodyEdit>(&edit);
  if (!body || !body->before || !body->after) return parts;  // it comes or goes as a whole
  const Address any{Owner::Body, body->id, ""};
  const api::ParameterList declared = declarationsOf(m_project, m_plugins, any);
  for (size_t i = 0; i < declared.count; ++i) {
    const Address address{any.owner, any.id, declared[i].key};
    if (isComposition(address)) parts.push_back({address, {}, value(address)});
  }
  return parts;
}

void Document::applyBodies(const std::vector<SceneEdit>& edits, bool forward, const MatterRef& matter) {
  std::vector<std::vector<ParameterChanged>> compositions;
  for (const SceneEdit& edit : edits) compositions.push_back(compositionOf(edit));
  applyEdits(m_project, edits, forward);
  ++m_changes;
  for (size_t i = 0; i < edits.size(); ++i) {
    std::vector<ParameterChanged>& composition = compositions[i];
    std::erase_if(composition, [this](ParameterChanged& part) {
      part.value = value(part.address);
      return *part.value == part.before;
    });
    const auto* body = std::get_if<BodyEdit>(&edits[i]);
    const bool remade = body && body->before && body->after && isMadeOtherwise(*body->before, *body->after);
    notify(BodyChanged{bodyOf(edits[i]), matter, {}, std::move(composition), remade});
  }
}

void Document::applyMaterials(const std::vector<SceneMaterial>& materials) {
  const bool other = std::any_of(materials.begin(), materials.end(), [this](const SceneMaterial& after) {
    return std::any_of(m_project.materials.begin(), m_project.materials.end(),
                       [&](const SceneMaterial& before) { return before.id == after.id && before.base != after.base; });
  });
  m_project.materials = materials;
  ++m_changes;
  notify(MaterialsChanged{other});
}

void Document::applyStroke(const std::shared_ptr<StrokeRecord>& stroke, bool done, bool live) {
  applyEdits(m_project, stroke->edits, done);
  ++m_changes;
  notify(StrokeChanged{stroke, done, live});
}

void Document::applyState(const std::shared_ptr<const ProjectState>& state) {
  m_project.state = state;
  ++m_changes;
  notify(StateChanged{});
}

void Document::applyAbout(const ProjectAbout& about) {
  m_project.title = about.title;
  m_project.description = about.description;
  m_project.toTry = about.toTry;
  m_project.duration = about.duration;
  m_project.thumbnail = about.thumbnail;
  ++m_changes;
  notify(AboutChanged{});
}

void Document::applyPins(const std::vector<std::string>& pins) {
  m_project.view.pinned = pins;
  ++m_changes;
  notify(PinsChanged{});
}

void Document::notify(const ChangeEvent& event) { Q_EMIT changed(event); }

}  // namespace ps
