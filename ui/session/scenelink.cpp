// SPDX-License-Identifier: Apache-2.0
#include "ui/session/scenelink.h"

#include "core/scene/coat.h"
#include "core/scene/pose.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/lattice.h"
#include "core/simulation/namedmatter.h"
#include "ui/document/document.h"
#include "ui/document/parting.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>

// Why matter is named: particles have moved since a stroke made them, so only the engine, which knows their ids, tells
// them apart, and a reset gives all particles new ids. Right after one, before anything has moved, the cells of a
// stroke still say which particles are its own.
namespace ps {
namespace {

constexpr int kDragRest = 150;  // ms without another value, after which the scene is made anew

/// The cells of an erased piece of each body and palette entry, back in their places. `bodies`: as they are without it.
std::vector<AddCells> refill(const StrokeRecord& stroke, const Document& document) {
  std::vector<AddCells> cells;
  for (const SceneEdit& edit : stroke.edits) {
    const Body* body = document.body(bodyOf(edit));
    if (!body) continue;
    const auto whole = std::make_shared<const Body>(asVoxels(*body, stroke.lattice.spacing));
    auto byPalette = takenCells(edit, stroke.lattice.spacing);
    for (size_t palette = 0; palette < byPalette.size(); ++palette) {
      if (!byPalette[palette].empty())
        cells.push_back({whole, std::move(byPalette[palette]), static_cast<int>(palette), 0});
    }
  }
  return cells;
}

/// Cells that a stroke has filled in the document, on its lattice: others of those that it touched may be of an earlier
/// one.
std::vector<std::array<int, 3>> filledCells(const StrokeRecord& stroke) {
  CellSet cells;
  for (const SceneEdit& edit : stroke.edits) {
    if (const auto* some = std::get_if<CellsEdit>(&edit); some && !some->erase)
      cells.add(VoxelCanvas(some->cells).cells().cells());
    if (const auto* body = std::get_if<BodyEdit>(&edit); body && !body->before && body->after)
      cells.add(VoxelCanvas(std::get<VoxelShape>(body->after->shape).runs).cells().cells());
  }
  return cells.indices();
}

/// Nothing, where its step has noted it elsewhere.
std::optional<VoxelShape::Stroke> notedStroke(const StrokeRecord& stroke) {
  for (const SceneEdit& edit : stroke.edits) {
    if (const auto* some = std::get_if<CellsEdit>(&edit); some && !some->strokes.empty()) return some->strokes.back();
    const auto* body = std::get_if<BodyEdit>(&edit);
    const auto* made = body && body->after ? std::get_if<VoxelShape>(&body->after->shape) : nullptr;
    if (made && !made->strokes.empty()) return made->strokes.back();
  }
  return std::nullopt;
}

CellSet sketchCells(const Body* body) {
  const auto* voxels = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
  return voxels ? VoxelCanvas(voxels->runs).cells() : CellSet();
}

/// Cells of a stroke that its body has lost to others, which have it among their strokes: it came apart.
std::vector<NameMatter> passedOn(const NameMatter& named, const StrokeRecord& stroke, const Document& document) {
  std::vector<NameMatter> passed;
  const std::optional<VoxelShape::Stroke> noted = notedStroke(stroke);
  for (const Body& body : document.project().bodies) {
    const auto* voxels = std::get_if<VoxelShape>(&body.shape);
    if (!noted || !voxels || body.id == named.body) continue;
    if (std::find(voxels->strokes.begin(), voxels->strokes.end(), *noted) == voxels->strokes.end()) continue;
    const CellSet own = sketchCells(document.body(named.body)), theirs = sketchCells(&body);
    CellIndices cells = named.cells;
    std::erase_if(cells, [&](const CellIndex& c) {
      const api::Cell cell{c[0], c[1], c[2]};
      return own.contains(cell) || !theirs.contains(cell);
    });
    if (!cells.empty()) passed.push_back({named.key, body.id, latticeOf(*voxels), std::move(cells)});
  }
  return passed;
}

/// What a stroke has painted in the document, by what it was painted from.
std::vector<NameMatter> paintedMatter(const StrokeRecord& stroke, const Document& document) {
  std::vector<NameMatter> named;
  for (const SceneEdit& edit : stroke.edits) {
    const auto* painted = std::get_if<RepaintEdit>(&edit);
    const Body* body = painted ? document.body(painted->id) : nullptr;
    const auto* voxels = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
    if (!voxels) continue;
    const VoxelShape lattice = latticeOf(*voxels);
    for (size_t palette = 0; palette < voxels->palette.size(); ++palette) {
      VoxelShape part;
      part.runs = painted->cells.before;
      CellIndices cells = cellsOf(part, static_cast<int>(palette));
      if (cells.empty()) continue;
      const VoxelShape::Paint& was = voxels->palette[palette];
      const std::string coat = isColour(stroke.material) ? coatOf(colourNumber(was.colour)) : was.material;
      named.push_back({*stroke.matter, body->id, lattice, std::move(cells), coat});
    }
  }
  return named;
}

}  // namespace

SceneLink::SceneLink(Document& document, EngineThread& engine, QObject* parent)
    : QObject(parent), m_document(document), m_engine(engine) {
  connect(&document, &Document::changed, this, &SceneLink::onChanged);
  connect(&document.undoStack(), &History::letGo, this, &SceneLink::forgetMatter);
  m_soon.setSingleShot(true);
  m_soon.setInterval(kDragRest);
  connect(&m_soon, &QTimer::timeout, this, [this] {
    if (m_engine.making() || any(m_drawn))
      m_soon.start();
    else if (appliesAtOnce())
      applyWaiting();
    else
      nothingWaits();  // another moment stands there by now: a run came back, or a state
  });
}
SceneLink::~SceneLink() = default;

void SceneLink::onChanged(const ChangeEvent& event) {
  if (m_taking) return;
  forgetMatter();
  const auto* stroke = std::get_if<StrokeChanged>(&event);
  if (stroke) remember(*stroke);
  if (stroke || std::holds_alternative<BodyChanged>(event) || std::holds_alternative<PortChanged>(event))
    Q_EMIT matterEdited();
  if (const auto* opened = std::get_if<ProjectOpened>(&event)) {
    m_strokes.clear();
    nothingWaits();
    ++m_run;
    m_play = opened->play;
    m_builtAt = m_document.changeCount();
    m_engine.open(m_document.project(), m_play);
    if (m_document.project().graphs) showFields();
  } else if (const auto* parameter = std::get_if<ParameterChanged>(&event)) {
    // What a parameter falls back to is the engine's to work out, from the plugins: it may be a curve of another value.
    if (m_document.actsAtReset(parameter->address)) resetSoon();
    if (isBroken()) {
      rebuild(m_play);
    } else if (parameter->value || parameter->address.owner == Owner::Shape) {  // a place is moved from: never a curve
      m_engine.setParameter(parameter->address,
                            parameter->value ? *parameter->value : m_document.value(parameter->address));
    } else {
      pushProject();
    }
  } else if (const auto* body = std::get_if<BodyChanged>(&event)) {
    onBody(*body);
  } else if (const auto* parted = std::get_if<BodyParted>(&event)) {
    onParting(*parted);
  } else if (const auto* port = std::get_if<PortChanged>(&event)) {
    onPort(*port);
  } else if (std::holds_alternative<MaterialsChanged>(event) || std::holds_alternative<WallsChanged>(event) ||
             std::holds_alternative<OrderChanged>(event)) {
    const auto* materials = std::get_if<MaterialsChanged>(&event);
    if (materials && materials->other) resetSoon();
    if (isBroken()) {
      rebuild(m_play);
    } else {
      pushProject();
    }
  } else if (std::holds_alternative<TracksChanged>(event)) {
    if (!isBroken()) m_engine.apply(SetTracks{m_document.project().tracks});
  } else if (std::holds_alternative<ProbesChanged>(event)) {
    if (!isBroken()) m_engine.apply(SetProbes{m_document.project().probes});
  } else if (std::holds_alternative<ViewChanged>(event)) {
    showFields();
  } else if (std::holds_alternative<GraphsChanged>(event)) {
    showFields();
  } else if (stroke) {
    onStroke(*stroke);
  }
}

/// What colours mean, and graphs spread out.
void SceneLink::showFields() {
  ShowFields shown{{m_document.project().view.colour}};
  for (const Graph& graph : m_document.graphs()) {
    if (graph.kind == Graph::Kind::Histogram || graph.kind == Graph::Kind::Profile) shown.names.push_back(graph.field);
  }
  m_engine.apply(std::move(shown));
}

void SceneLink::onBody(const BodyChanged& event) {
  const auto waits = [this](const ParameterChanged& part) { return m_document.actsAtReset(part.address); };
  if (event.remade || event.resized || std::any_of(event.composition.begin(), event.composition.end(), waits))
    resetSoon();
  for (KnownStroke& known : m_strokes) {
    const auto stroke = event.move || event.resized ? known.stroke.lock() : nullptr;
    if (!stroke || stroke->body != event.id) continue;
    if (event.resized) {
      const auto& [factor, about] = *event.resized;
      known.factor *= factor;
      known.way.shift = about + factor * (known.way.shift - about);
    }
    if (event.move) known.way = event.move->after(known.way);
  }
  if (isBroken()) {
    rebuild(m_play);
    return;
  }
  const auto eraseAgain = [this] {
    for (const Drawn& drawn : m_drawn) {
      const MatterRef matter = drawn.on.empty() ? drawn.matter.lock() : nullptr;
      if (matter && isOfThisRun(matter)) m_engine.apply(TakeMatter{*matter});
    }
  };
  const Body* body = m_document.body(event.id);
  if (event.move && body) {
    // While no time passes nothing is led anywhere, and one wants to see it where it goes.
    m_engine.apply(MoveBody{std::make_shared<const Body>(*body), *event.move, event.led && runs()});
    return;
  }
  if (event.matter && !body) {
    takeDrawn(event.id);
    m_engine.apply(TakeBody{event.id, keyOf(event.matter)});
    eraseAgain();
  }
  pushProject();
  if (!event.matter || !body) return;
  std::vector<NameMatter> named = namedMatter();
  std::erase_if(named, [&](const NameMatter& matter) { return matter.body != body->id; });
  m_engine.apply(ReturnBody{std::make_shared<const Body>(*body), keyOf(event.matter), std::move(named)});
  eraseAgain();
}

/// At the start the scene is made anew as well, by resetSoon() of the body that has other cells.
void SceneLink::onParting(const BodyParted& event) {
  if (isBroken()) return;
  const Parting& parting = *event.parting;
  for (const Parting::Piece& piece : parting.pieces) {
    m_engine.apply(event.done ? PassMatter{parting.body, piece.body, parting.lattice, piece.cells, false}
                              : PassMatter{piece.body, parting.body, {}, {}, true});
  }
}

void SceneLink::onPort(const PortChanged& event) {
  if (isBroken()) {
    rebuild(m_play);
    return;
  }
  const bool gone = event.matter && !m_document.emitter(event.id);
  pushProject();
  if (gone) {
    m_engine.apply(TakeBody{event.id, keyOf(event.matter)});
  } else if (event.matter) {
    m_engine.apply(ReturnBody{nullptr, keyOf(event.matter), {}});
  }
}

MatterKey SceneLink::keyOf(const MatterRef& matter) {
  m_matter[*matter] = {matter, m_run};
  return *matter;
}

bool SceneLink::isOfThisRun(const MatterRef& matter) const {
  const auto known = m_matter.find(*matter);
  return known != m_matter.end() && known->second.run == m_run;
}

/// No command can undo or redo it any more. What such strokes drew after the start stays in the scene of this run.
void SceneLink::forgetMatter() {
  for (KnownStroke& known : m_strokes) {
    const auto matter =
        known.stroke.expired() && known.done && known.onlyNow ? m_matter.find(known.key) : m_matter.end();
    if (matter != m_matter.end()) known.run = matter->second.run;
  }
  std::erase_if(m_strokes, [this](const KnownStroke& one) { return one.stroke.expired() && one.run != m_run; });
  std::erase_if(m_kept, [](const auto& kept) { return kept.first.expired(); });
  ForgetMatter forgotten;
  for (auto known = m_matter.begin(); known != m_matter.end();) {
    if (known->second.matter.expired()) {
      forgotten.keys.push_back(known->first);
      known = m_matter.erase(known);
    } else {
      ++known;
    }
  }
  if (!forgotten.keys.empty()) m_engine.apply(std::move(forgotten));
}

void SceneLink::remember(const StrokeChanged& event) {
  if (event.live) {
    m_strokes.push_back({event.stroke, true, {}, 1, *event.stroke->matter, event.stroke->onlyNow});
    drop(m_drawn, event.stroke->matter);
    if (drop(m_cutOff, event.stroke->matter)) resetSoon();
  }
  for (KnownStroke& known : m_strokes) {
    if (known.stroke.lock() == event.stroke) known.done = event.done;
  }
}

void SceneLink::onStroke(const StrokeChanged& event) {
  // What was painted on the start holds together, or flows, as the scene is made from it.
  if (!event.stroke->material.empty() && !event.stroke->edits.empty()) resetSoon();
  if (isBroken()) {
    rebuild(m_play);
  } else if (event.live) {
    if (event.stroke->deed.empty()) pushProject();
  } else if (event.done) {
    redoStroke(event.stroke);
  } else {
    undoStroke(event.stroke);
  }
}

void SceneLink::pushProject() { m_engine.update(m_document.project()); }

std::vector<NameMatter> SceneLink::namedMatter() {
  std::vector<NameMatter> named;
  for (const KnownStroke& known : m_strokes) {
    const auto stroke = known.stroke.lock();
    if (!stroke || !known.done || stroke->erase || stroke->onlyNow || !stroke->deed.empty()) continue;
    if (!stroke->material.empty()) {
      const std::vector<NameMatter> painted = paintedMatter(*stroke, m_document);
      if (!painted.empty()) keyOf(stroke->matter);
      named.insert(named.end(), painted.begin(), painted.end());
      continue;
    }
    named.push_back({keyOf(stroke->matter), stroke->body, stroke->lattice, filledCells(*stroke)});
    VoxelShape& lattice = named.back().lattice;
    lattice.origin *= known.factor, lattice.spacing *= known.factor, lattice.shift *= known.factor;
    carryLattice(lattice, known.way);
    std::vector<NameMatter> passed = passedOn(named.back(), *stroke, m_document);
    std::move(passed.begin(), passed.end(), std::back_inserter(named));
  }
  return named;
}

bool SceneLink::appliesAtOnce() const {
  const SnapshotPtr snapshot = m_engine.snapshot();
  return !m_givenUp && snapshot && snapshot->bodyIds && snapshot->stats.frame == 0 && !m_engine.playing();
}

void SceneLink::resetSoon() {
  m_givenUp = false;
  if (!appliesAtOnce()) return;
  m_waits = true;
  m_soon.start();
}

void SceneLink::applyWaiting() {
  if (m_waits && !any(m_drawn)) reset();
}

void SceneLink::nothingWaits() {
  m_soon.stop();
  m_waits = m_givenUp = false;
}

void SceneLink::reset() {
  nothingWaits();
  m_cutOff = m_drawn;  // what hands have drawn so far is not in the document yet
  if (isBroken()) {
    rebuild(m_play);
  } else {
    const size_t left = strokesHomeLeaves();
    ++m_run;
    m_engine.apply(Reset{namedMatter()});
    if (left > 0) Q_EMIT strokesLeft(left);
  }
}

void SceneLink::keepNames(const std::shared_ptr<const ProjectState>& state, std::shared_ptr<const NamedMatter> named) {
  std::erase_if(m_kept, [](const auto& kept) { return kept.first.expired(); });
  m_kept.emplace_back(state, std::move(named));
}

std::shared_ptr<const NamedMatter> SceneLink::keptNames() const {
  const auto& state = m_document.project().state;
  for (const auto& [kept, names] : m_kept) {
    if (state && kept.lock() == state) return names;
  }
  return nullptr;
}

void SceneLink::returnToState() {
  const std::shared_ptr<const ProjectState>& state = m_document.project().state;
  if (!state || isBroken()) return;
  nothingWaits();
  forgetMatter();
  ++m_run;
  const std::shared_ptr<const NamedMatter> named = keptNames();
  m_engine.apply(ReturnToState{state, named});
  if (!named) return;
  ForgetMatter unasked;  // by any command that could still come
  for (const MatterKey key : named->keysInScene()) {
    if (const auto known = m_matter.find(key); known != m_matter.end())
      known->second.run = m_run;
    else
      unasked.keys.push_back(key);
  }
  if (!unasked.keys.empty()) m_engine.apply(std::move(unasked));
}

bool SceneLink::isBroken() const {
  const SnapshotPtr snapshot = m_engine.snapshot();
  return snapshot && !snapshot->bodyIds;
}

void SceneLink::rebuild(bool play) {
  ++m_run;
  m_builtAt = m_document.changeCount();
  Project start = m_document.project();
  start.state = nullptr;  // it is matter at the start that cells name
  m_engine.open(start, play);
  for (NameMatter& named : namedMatter()) m_engine.apply(std::move(named));
}

void SceneLink::hear(const EngineEvent& event) {
  const bool refused = event.kind == EngineEvent::Kind::Refused;
  if (event.kind == EngineEvent::Kind::Cancelled) nothingWaits();
  // What is refused of a value that acts at once says nothing of how the scene is made.
  if (event.kind == EngineEvent::Kind::Cancelled ||
      (refused && (!event.culprit || !event.asked || m_document.actsAtReset(*event.culprit))))
    m_givenUp = true;
  // Edits that came while the engine tried met no scene.
  if (event.kind == EngineEvent::Kind::NotOpened && isBroken() && m_builtAt != m_document.changeCount())
    rebuild(m_play);
  if (!refused || !event.culprit || !event.asked) return;
  m_taking = true;
  m_document.takeBack(*event.culprit, *event.asked, event.kept);
  m_taking = false;
}

bool SceneLink::any(const Strokes& strokes) {
  return std::any_of(strokes.begin(), strokes.end(), [](const Drawn& stroke) { return !stroke.matter.expired(); });
}

bool SceneLink::drop(Strokes& strokes, const MatterRef& stroke) {
  return std::erase_if(strokes, [&](const Drawn& one) { return one.matter.lock() == stroke; }) > 0;
}

MatterKey SceneLink::draws(const StrokeRecord& stroke) {
  drop(m_drawn, stroke.matter);
  m_drawn.push_back({stroke.matter, stroke.erase ? std::string() : stroke.body});
  return keyOf(stroke.matter);
}

/// What hands have drawn on a body that goes is none of what comes back with it: the document knows nothing of it.
/// What they have erased of it is there again, so that it goes as a whole, and a stroke that is given up brings back
/// nothing of it: but not while the scene runs, where a frame of that would be felt. Where its deletion is undone in
/// the middle of a stroke, which goes on then, the start is made anew with all of it.
void SceneLink::takeDrawn(const std::string& body) {
  const bool paused = !runs();
  for (const Drawn& drawn : m_drawn) {
    const MatterRef matter = drawn.matter.lock();
    if (!matter || (!drawn.on.empty() && drawn.on != body)) continue;
    m_cutOff.push_back(drawn);
    if (!drawn.on.empty())
      m_engine.apply(TakeMatter{keyOf(matter)});
    else if (paused && isOfThisRun(matter))
      m_engine.apply(PutBack{*matter});
  }
}

void SceneLink::paint(const StrokeRecord& stroke, std::shared_ptr<const Body> body,
                      std::vector<std::array<int, 3>> cells) {
  m_engine.apply(AddCells{std::move(body), std::move(cells), stroke.palette, draws(stroke), stroke.way});
  Q_EMIT matterEdited();
}

void SceneLink::repaint(const StrokeRecord& stroke, std::vector<std::array<int, 3>> cells) {
  m_engine.apply(PaintCells{stroke.lattice, std::move(cells), stroke.material, lockedBodies(), draws(stroke)});
  Q_EMIT matterEdited();
}

void SceneLink::erase(const StrokeRecord& stroke, std::vector<std::array<int, 3>> cells) {
  Q_EMIT parting(stroke.matter, {});
  m_engine.apply(TakeCells{stroke.lattice, std::move(cells), lockedBodies(), draws(stroke)});
  Q_EMIT matterEdited();
}

std::vector<std::string> SceneLink::lockedBodies() const {
  std::vector<std::string> locked;
  for (const Body& body : m_document.project().bodies) {
    if (body.locked) locked.push_back(body.id);
  }
  return locked;
}

void SceneLink::touch(const StrokeRecord& stroke, TouchMatter touch) {
  touch.key = keyOf(stroke.matter);
  touch.spared = lockedBodies();
  std::vector<api::Touch> cuts;
  for (const auto* touches : {&touch.path, &touch.still}) {
    std::copy_if(touches->begin(), touches->end(), std::back_inserter(cuts),
                 [](const api::Touch& one) { return one.kind == api::TouchKind::Cut; });
  }
  if (!cuts.empty()) Q_EMIT parting(stroke.matter, cuts);
  m_engine.apply(std::move(touch));
  Q_EMIT matterEdited();
}

SnapshotPtr SceneLink::scene() const { return m_engine.snapshot(); }

bool SceneLink::runs() const { return m_engine.playing(); }

/// In order; of what the state that the project holds has by name.
std::vector<MatterKey> SceneLink::keysOfState() const {
  const auto kept = keptNames();
  std::vector<MatterKey> keys = kept ? kept->keys() : std::vector<MatterKey>{};
  std::sort(keys.begin(), keys.end());
  return keys;
}

size_t SceneLink::strokesOfTheRun() const {
  const SnapshotPtr snapshot = m_engine.snapshot();
  if (!snapshot) return 0;
  const std::vector<MatterKey> known = keysOfState();
  const auto isKnown = [&](MatterKey key) { return std::binary_search(known.begin(), known.end(), key); };
  const auto& done = snapshot->erasedOrPainted;
  const auto drawn = std::count_if(m_strokes.begin(), m_strokes.end(), [&](const KnownStroke& one) {
    if (one.stroke.expired()) return one.run == m_run && !isKnown(one.key);
    const auto stroke = one.done ? one.stroke.lock() : nullptr;
    return stroke && stroke->onlyNow && isOfThisRun(stroke->matter) && !isKnown(*stroke->matter);
  });
  return static_cast<size_t>(std::count_if(done.begin(), done.end(), std::not_fn(isKnown)) + drawn);
}

/// Of hands the engine says as well whether it knows them: the run may have gone back to before them.
size_t SceneLink::strokesHomeLeaves() const {
  const SnapshotPtr snapshot = m_engine.snapshot();
  if (!snapshot || !snapshot->keptForUndo) return strokesOfTheRun();
  const std::vector<MatterKey> known = keysOfState();
  const auto touched = std::count_if(m_strokes.begin(), m_strokes.end(), [&](const KnownStroke& one) {
    const auto stroke = one.done ? one.stroke.lock() : nullptr;
    return stroke && !stroke->deed.empty() && isOfThisRun(stroke->matter) &&
           !std::binary_search(known.begin(), known.end(), *stroke->matter) &&
           snapshot->keptForUndo->contains(*stroke->matter);
  });
  return strokesOfTheRun() + static_cast<size_t>(touched);
}

void SceneLink::cancel(const std::shared_ptr<StrokeRecord>& stroke) {
  drop(m_drawn, stroke->matter);
  drop(m_cutOff, stroke->matter);
  undoStroke(stroke);
}

void SceneLink::undoStroke(const std::shared_ptr<StrokeRecord>& stroke) {
  if (!stroke->deed.empty()) {
    m_engine.apply(UndoTouch{keyOf(stroke->matter)});
    return;
  }
  if (!stroke->material.empty()) {
    m_engine.apply(UndoTouch{keyOf(stroke->matter)});
  } else if (stroke->erase) {
    std::vector<AddCells> cells;
    if (!isOfThisRun(stroke->matter)) cells = refill(*stroke, m_document);
    m_engine.apply(PutBack{keyOf(stroke->matter), std::move(cells)});
  } else {
    m_engine.apply(TakeMatter{keyOf(stroke->matter)});
  }
  pushProject();
}

void SceneLink::redoStroke(const std::shared_ptr<StrokeRecord>& stroke) {
  if (!stroke->deed.empty()) {
    m_engine.apply(RedoTouch{keyOf(stroke->matter)});
    return;
  }
  pushProject();
  const bool known = isOfThisRun(stroke->matter);
  const MatterKey key = keyOf(stroke->matter);
  if (!stroke->material.empty()) {
    // After a reset only its cells say what it painted, and only at the start, where the document has it too.
    if (known)
      m_engine.apply(RedoTouch{key});
    else if (!stroke->edits.empty())
      m_engine.apply(PaintCells{stroke->lattice, stroke->cells, stroke->material, lockedBodies(), key});
    return;
  }
  if (stroke->erase) {
    m_engine.apply(TakeMatter{key, stroke->lattice, stroke->cells});
    return;
  }
  const Body* body = m_document.body(stroke->body);
  const auto painted = std::make_shared<const Body>(body ? *body : Body{});
  // Of what came to a body that had moved, not all has its place where the body begins.
  CellIndices cells = stroke->way.isNothing() ? stroke->cells : filledCells(*stroke);
  m_engine.apply(PutBack{key, {AddCells{painted, std::move(cells), stroke->palette, key}}});
}

}  // namespace ps
