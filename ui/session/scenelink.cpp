// SPDX-License-Identifier: Apache-2.0
#include "ui/session/scenelink.h"

#include "core/simulation/engine.h"
#include "ui/document/document.h"

#include <algorithm>
#include <set>

// Why traces and runs: particles have moved since a stroke made them, so only their ids tell them apart, and a reset
// gives all particles new ids. Right after one, before anything has moved, the cells of a stroke still name its
// particles.
namespace ps {
namespace {

std::vector<uint32_t> ofBody(Engine& engine, const std::vector<uint32_t>& ids, const std::string& body) {
  const std::vector<std::string>& bodies = engine.bodyIds();
  const auto index = static_cast<uint32_t>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin());
  const ParticleStore& store = engine.solver().particles();
  std::vector<uint32_t> own;
  for (const uint32_t id : ids) {
    const size_t row = store.indexOf(id);
    if (row < store.size() && store.body()[row] == index) own.push_back(id);
  }
  return own;
}

std::vector<uint32_t> unlocked(Engine& engine, const std::vector<uint32_t>& ids, const std::set<std::string>& locked) {
  if (locked.empty()) return ids;
  const std::vector<std::string>& bodies = engine.bodyIds();
  const ParticleStore& store = engine.solver().particles();
  std::vector<uint32_t> free;
  for (const uint32_t id : ids) {
    const size_t row = store.indexOf(id);
    if (row >= store.size()) continue;
    const uint32_t body = store.body()[row];
    if (body >= bodies.size() || !locked.count(bodies[body])) free.push_back(id);
  }
  return free;
}

void take(Engine& engine, StrokeTrace& trace, const std::vector<uint32_t>& ids) {
  if (ids.empty()) return;
  trace.taken.push_back(engine.takeParticles(ids));
}

/// Puts back what is out of the scene, the last taken first.
void putBack(Engine& engine, StrokeTrace& trace) {
  for (auto matter = trace.taken.rbegin(); matter != trace.taken.rend(); ++matter) engine.putBack(*matter);
  trace.taken.clear();
}

std::vector<uint32_t> idsOfBody(Engine& engine, const std::string& body) {
  const ParticleStore& store = engine.solver().particles();
  return ofBody(engine, {store.id(), store.id() + store.size()}, body);
}

/// Finds the particles that the cells of a stroke have become; nothing has moved yet.
void findMatter(Engine& engine, uint64_t run, const StrokeRecord& stroke, bool done) {
  StrokeTrace& trace = *stroke.trace;
  trace.ids.clear();
  trace.taken.clear();
  if (stroke.erase || !done) return;
  trace.ids = ofBody(engine, engine.particlesIn(stroke.lattice, stroke.cells), stroke.body);
  trace.run = run;
}

/// A run that has just begun.
void beginRun(Engine& engine, uint64_t& run, const std::vector<SceneLink::KnownStroke>& strokes) {
  ++run;
  for (const auto& [stroke, done] : strokes) findMatter(engine, run, *stroke, done);
}

/// Matter that an erasure carved out of bodies at the start, back in its cells. `bodies`: as they are without it.
void refill(Engine& engine, const StrokeRecord& stroke, const std::vector<Body>& bodies) {
  for (const SceneEdit& edit : stroke.edits) {
    const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.id == bodyOf(edit); });
    if (body == bodies.end()) continue;
    const Body whole = asVoxels(*body, stroke.lattice.spacing);
    const auto byPalette = takenCells(edit, stroke.lattice.spacing);
    for (size_t palette = 0; palette < byPalette.size(); ++palette) {
      if (!byPalette[palette].empty()) engine.addCells(whole, byPalette[palette], static_cast<int>(palette));
    }
  }
}

}  // namespace

SceneLink::SceneLink(Document& document, EngineThread& engine, QObject* parent)
    : QObject(parent), m_document(document), m_engine(engine), m_run(std::make_shared<uint64_t>(1)) {
  connect(&document, &Document::changed, this, &SceneLink::onChanged);
}
SceneLink::~SceneLink() = default;

void SceneLink::onChanged(const ChangeEvent& event) {
  const auto* stroke = std::get_if<StrokeChanged>(&event);
  if (stroke) remember(*stroke);
  if (const auto* opened = std::get_if<ProjectOpened>(&event)) {
    m_strokes.clear();
    m_engine.post([run = m_run](Engine&) { ++*run; });
    m_engine.open(m_document.project(), opened->play);
  } else if (const auto* parameter = std::get_if<ParameterChanged>(&event)) {
    // What a parameter falls back to is the engine's to work out, from the plugins: it may be a curve of another value.
    if (isBroken()) {
      rebuild(false);
    } else if (parameter->value) {
      m_engine.setParameter(parameter->address, *parameter->value);
    } else {
      pushProject();
    }
  } else if (const auto* body = std::get_if<BodyChanged>(&event)) {
    onBody(*body);
  } else if (std::holds_alternative<MaterialsChanged>(event) || std::holds_alternative<PortChanged>(event) ||
             std::holds_alternative<WallsChanged>(event)) {
    if (isBroken()) {
      rebuild(false);
    } else {
      pushProject();
    }
  } else if (stroke) {
    onStroke(*stroke);
  }
}

void SceneLink::onBody(const BodyChanged& event) {
  if (isBroken()) {
    rebuild(false);
    return;
  }
  if (event.matter && !m_document.body(event.id)) {
    m_engine.post([run = m_run, trace = event.matter, id = event.id](Engine& engine) {
      trace->run = *run;
      trace->taken.clear();
      take(engine, *trace, idsOfBody(engine, id));
    });
  }
  pushProject();
  const Body* body = event.matter ? m_document.body(event.id) : nullptr;
  if (!body) return;
  m_engine.post([run = m_run, trace = event.matter, body = *body, strokes = strokes()](Engine& engine) {
    if (trace->run == *run) {
      putBack(engine, *trace);
      return;
    }
    engine.addBody(body);
    trace->run = *run;
    trace->taken.clear();
    for (const auto& [stroke, done] : strokes) {
      if (stroke->body == body.id) findMatter(engine, *run, *stroke, done);
    }
  });
}

void SceneLink::remember(const StrokeChanged& event) {
  if (event.live) m_strokes.push_back({event.stroke, true});
  for (auto& [stroke, done] : m_strokes) {
    if (stroke.lock() == event.stroke) done = event.done;
  }
}

void SceneLink::onStroke(const StrokeChanged& event) {
  if (isBroken()) {
    rebuild(false);
  } else if (event.live) {
    pushProject();
  } else if (event.done) {
    redoStroke(event.stroke);
  } else {
    undoStroke(event.stroke);
  }
}

void SceneLink::pushProject() { m_engine.update(m_document.project()); }

std::vector<SceneLink::KnownStroke> SceneLink::strokes() const {
  std::vector<KnownStroke> strokes;
  for (const auto& [weak, done] : m_strokes) {
    if (auto stroke = weak.lock()) strokes.emplace_back(std::move(stroke), done);
  }
  return strokes;
}

void SceneLink::reset() {
  if (isBroken()) {
    rebuild(false);
    return;
  }
  m_engine.post([run = m_run, strokes = strokes()](Engine& engine) {
    engine.reset();
    beginRun(engine, *run, strokes);
  });
}

bool SceneLink::isBroken() const {
  const SnapshotPtr snapshot = m_engine.snapshot();
  return snapshot && !snapshot->bodyIds;
}

void SceneLink::rebuild(bool play) {
  m_engine.open(m_document.project(), play);
  m_engine.post([run = m_run, strokes = strokes()](Engine& engine) { beginRun(engine, *run, strokes); });
}

void SceneLink::paint(const StrokeRecord& stroke, std::shared_ptr<const Body> body,
                      std::vector<std::array<int, 3>> cells) {
  m_engine.post([run = m_run, trace = stroke.trace, body = std::move(body), palette = stroke.palette,
                 cells = std::move(cells)](Engine& engine) {
    const std::vector<uint32_t> ids = engine.addCells(*body, cells, palette);
    trace->run = *run;
    trace->ids.insert(trace->ids.end(), ids.begin(), ids.end());
  });
}

void SceneLink::erase(const StrokeRecord& stroke, std::vector<std::array<int, 3>> cells) {
  std::set<std::string> locked;
  for (const Body& body : m_document.project().bodies) {
    if (body.locked) locked.insert(body.id);
  }
  m_engine.post(
      [run = m_run, trace = stroke.trace, lattice = stroke.lattice, locked, cells = std::move(cells)](Engine& engine) {
        trace->run = *run;
        const std::vector<uint32_t> ids = unlocked(engine, engine.particlesIn(lattice, cells), locked);
        trace->ids.insert(trace->ids.end(), ids.begin(), ids.end());
        take(engine, *trace, ids);
      });
}

void SceneLink::cancel(const std::shared_ptr<StrokeRecord>& stroke) { undoStroke(stroke); }

void SceneLink::undoStroke(const std::shared_ptr<StrokeRecord>& stroke) {
  std::vector<Body> bodies;
  for (const SceneEdit& edit : stroke->edits) {
    const Body* body = stroke->erase ? m_document.body(bodyOf(edit)) : nullptr;
    if (body) bodies.push_back(*body);
  }
  m_engine.post([run = m_run, stroke, bodies = std::move(bodies)](Engine& engine) {
    StrokeTrace& trace = *stroke->trace;
    if (!stroke->erase) {
      if (trace.run == *run) take(engine, trace, trace.ids);
    } else if (trace.run == *run) {
      putBack(engine, trace);
    } else {
      refill(engine, *stroke, bodies);
    }
  });
  pushProject();
}

void SceneLink::redoStroke(const std::shared_ptr<StrokeRecord>& stroke) {
  pushProject();
  const Body* body = m_document.body(stroke->body);
  m_engine.post([run = m_run, stroke, body = body ? *body : Body{}](Engine& engine) {
    StrokeTrace& trace = *stroke->trace;
    if (!stroke->erase && trace.run == *run) {
      putBack(engine, trace);
    } else if (!stroke->erase) {
      trace.ids = engine.addCells(body, stroke->cells, stroke->palette);
    } else if (trace.run == *run && !trace.ids.empty()) {
      take(engine, trace, trace.ids);
    } else {
      take(engine, trace, engine.particlesIn(stroke->lattice, stroke->cells));
    }
    trace.run = *run;
  });
}

}  // namespace ps
