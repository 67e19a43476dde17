// SPDX-License-Identifier: Apache-2.0
#include "ui/session/session.h"

#include "core/base/statestream.h"
#include "core/plugin_host/registry.h"
#include "core/scene/track.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/tracks.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/runwork.h"
#include "ui/session/scenelink.h"
#include "ui/session/swatches.h"
#include "ui/session/transitions.h"
#include "ui/session/wording.h"
#include "ui/session/worker.h"

#include <clocale>
#include <utility>

namespace ps {
namespace {
constexpr int kValuesInterval = 66;   // ms: values at 15 Hz
constexpr int kTotalsInterval = 200;  // ms
constexpr int kMakingInterval = 200;  // ms
}  // namespace

Session::Session(const Options& options, QObject* parent)
    : QObject(parent),
      m_options(options),
      m_log(std::make_unique<MessageLog>()),
      m_document(std::make_unique<Document>()),
      m_transitions(std::make_unique<Transitions>(*m_document)),
      m_recorded(std::make_unique<RecordedView>(*this)),
      m_fields(std::make_unique<const ParticleFields>()),
      m_swatches(std::make_unique<Swatches>()),
      m_worker(std::make_unique<Worker>()) {
  m_log->takeLog();
  m_values.setInterval(kValuesInterval);
  m_values.setSingleShot(true);
  connect(&m_values, &QTimer::timeout, this, &Session::tellValues);
  m_totals.setInterval(kTotalsInterval);
  m_totals.setSingleShot(true);
  connect(&m_totals, &QTimer::timeout, this, &Session::totalsDue);
  connect(this, &Session::totalsDue, this, [this] {
    if (const SnapshotPtr now = newest()) m_document->undoStack().setMatter(now->keptForUndo);
  });
  applyUndoMemory();
  m_making.setInterval(kMakingInterval);
  connect(&m_making, &QTimer::timeout, this, &Session::tellMaking);
  connect(m_document.get(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (!std::holds_alternative<ProjectOpened>(event)) return;
    m_opening = true;
    const SnapshotPtr last = newest();
    m_before = last ? last->revision : 0;
  });
  connect(m_recorded.get(), &RecordedView::changed, this, &Session::onShown);
  connect(m_recorded.get(), &RecordedView::playingChanged, this, &Session::tellPlaying);
  m_files = std::make_unique<DocumentFiles>(*m_document, *m_worker);
  m_recordings = std::make_unique<RecordingFiles>(*this);
  m_work = std::make_unique<RunWork>(*this);
  if (options.autosave) {
    const QString& directory = options.autosaveDirectory;
    m_autosave = std::make_unique<Autosave>(*m_document, *m_worker,
                                            directory.isEmpty() ? Autosave::standardDirectory() : directory);
    connect(m_files.get(), &DocumentFiles::reopened, m_autosave.get(), &Autosave::takeOver);
    m_files->keepWith(*m_autosave);
    m_autosave->setInterval(preferences::autosaveInterval());
    m_autosave->start();
  }
}

Session::~Session() {
  close();
  m_recordings.reset();
  m_work.reset();
  m_worker.reset();
  m_link.reset();
  m_engine.reset();
  m_document->setPlugins(nullptr);
}

void Session::start() {
  std::vector<std::string> paths = m_options.pluginPaths;
  if (const QString own = preferences::folder(preferences::Folder::Plugins); !own.isEmpty())
    paths.insert(paths.begin(), own.toStdString());
  m_worker->run([this, paths = std::move(paths)] {
    PluginRegistry::Options options;
    options.extraPaths = paths;
    QMetaObject::invokeMethod(this,
                              [this, plugins = std::make_shared<PluginRegistry>(options)] { adoptPlugins(plugins); });
  });
}

void Session::adoptPlugins(std::shared_ptr<PluginRegistry> plugins) {
  std::setlocale(LC_NUMERIC, "C");  // a plugin may have set it
  m_plugins = std::move(plugins);
  m_document->setPlugins(m_plugins.get());
  m_fields = std::make_unique<const ParticleFields>(*m_plugins);
  m_engine = std::make_unique<EngineThread>(
      *m_plugins,
      [this] {
        if (m_pending.exchange(true)) return;
        QMetaObject::invokeMethod(
            this,
            [this] {
              m_pending = false;
              const bool now = playing();
              onSnapshot();
              if (now != m_wasPlaying) {
                m_wasPlaying = now;
                Q_EMIT playingChanged();
              }
            },
            Qt::QueuedConnection);
      },
      preferences::recordBudget());
  m_link = std::make_unique<SceneLink>(*m_document, *m_engine);
  connect(m_link.get(), &SceneLink::matterEdited, m_recorded.get(), &RecordedView::showNewest);
  for (const PluginInfo& plugin : m_plugins->plugins()) {
    if (plugin.problem.empty()) continue;
    const std::string name = !plugin.id.empty() ? plugin.id : plugin.path;
    m_log->add(MessageLevel::Warning, QStringLiteral("Plugin ") + QString::fromStdString(name),
               QString::fromStdString(plugin.problem));
  }
  Q_EMIT ready();
}

void Session::tellMaking() {
  const auto state = m_engine ? m_engine->making() : std::nullopt;
  if (state) {
    m_toldMaking = true;
    if (state->done < m_made) m_makingSince.start();
    m_made = state->done;
    const double seconds = static_cast<double>(m_makingSince.elapsed()) / 1000;
    Q_EMIT making(QString::fromUtf8(state->stage ? state->stage : "Beginning"), m_made, secondsLeft(seconds, m_made));
    return;
  }
  m_making.stop();
  if (std::exchange(m_toldMaking, false)) Q_EMIT madeOrNot();
}

bool Session::cancelMaking() {
  if (!m_toldMaking || !m_engine->making()) return false;
  m_engine->cancelMaking();
  return true;
}

void Session::onSnapshot() {
  if (m_engine && m_engine->making() && !m_making.isActive()) {
    m_made = 0;
    m_makingSince.start();
    m_making.start();
  }
  if (!m_values.isActive()) m_values.start();
  const SnapshotPtr now = newest();
  m_recorded->follow(now);
  Q_EMIT snapshotArrived();
  if (!m_opening || !now || now->revision == m_before) return;
  m_opening = false;
  tellValues();
  Q_EMIT totalsDue();
  Q_EMIT projectShown();
}

void Session::tellValues() {
  if (!m_engine) return;
  for (const EngineEvent& event : m_engine->events(m_eventsRead)) {
    m_eventsRead = event.number + 1;
    m_link->hear(event);
    Q_EMIT happened(event);
  }
  Q_EMIT valuesDue();
  if (!m_totals.isActive()) m_totals.start();
}

/// Values that follow tracks are those of the time that is shown.
void Session::onShown() {
  Q_EMIT snapshotArrived();
  if (!m_values.isActive()) m_values.start();
}

double Session::now() const {
  const SnapshotPtr shown = snapshot();
  return shown ? shown->stats.time : 0;
}

Value Session::valueNow(const Address& address) const {
  Value value = m_document->value(address);
  const api::ParameterDeclaration* declaration = m_document->declaration(address);
  for (const Track& track : m_document->project().tracks) {
    const auto target = TrackTarget::parse(track.parameter);
    if (!declaration || !target || !(target->address == address)) continue;
    if (!whyNoKeys(m_document->project(), m_document->plugins(), *target).empty()) continue;
    const auto given = trackValue(track.keys, now(), keySlack(2 * m_document->keySlack()));
    if (!given) continue;
    const Value said = valueOfKey(*given, *declaration);
    auto* curve = std::get_if<Response>(&value);
    if (!target->point)
      value = said;
    else if (curve && *target->point < curve->points.size())
      curve->points[*target->point].y = responseOf(said).constant;
  }
  return value;
}

Environment Session::surroundings() const { return environmentAt(m_document->project(), m_document->plugins(), now()); }

SnapshotPtr Session::snapshot() const { return m_recorded->shown() ? m_recorded->shown() : newest(); }
SnapshotPtr Session::newest() const { return m_engine ? m_engine->snapshot() : nullptr; }
SnapshotPtr Session::previousSnapshot() const {
  return m_engine && !m_recorded->shown() ? m_engine->previousSnapshot() : nullptr;
}
bool Session::playing() const { return m_recorded->playing() || (m_engine && m_engine->playing()); }

void Session::tellPlaying() {
  m_wasPlaying = playing();
  Q_EMIT playingChanged();
}

void Session::setSpeed(double speed) {
  m_recorded->setSpeed(speed);
  if (m_engine) m_engine->setSpeed(speed);
}

bool Session::appliesAtOnce() const { return m_link && m_link->appliesAtOnce(); }

bool Session::isBroken() const { return m_link && m_link->isBroken(); }

void Session::play() {
  if (!m_engine) return;
  if (isBroken()) {
    m_link->rebuild(true);
    return;
  }
  if (m_recorded->isMeant()) {
    m_recorded->play();
    return;
  }
  m_recorded->showNewest();
  m_link->applyWaiting();
  m_engine->play();
  tellPlaying();
}

void Session::pause() {
  if (!m_engine) return;
  m_recorded->pause();
  m_engine->pause();
  tellPlaying();
}

void Session::playPause() {
  if (playing()) {
    pause();
  } else {
    play();
  }
}

void Session::step() {
  if (!m_engine) return;
  if (m_recorded->isActive()) {
    m_recorded->step(1);
    return;
  }
  if (isBroken()) m_link->rebuild(false);
  m_link->applyWaiting();
  m_engine->stepOnce();
  m_wasPlaying = false;
  Q_EMIT playingChanged();
}

void Session::reset() {
  if (m_link) m_link->reset();
}

void Session::returnToState() {
  if (m_link) m_link->returnToState();
}

/// The engine's thread writes the stream, the worker packs it: neither makes the interface wait.
void Session::keepState() {
  if (!m_engine || isBroken()) {
    Q_EMIT stateNotKept(QStringLiteral("there is no scene that runs"));
    return;
  }
  m_engine->ask([this, bodies = m_document->project().bodies, count = m_document->changeCount()](const Engine& engine) {
    auto stream = std::make_shared<StateBuffer>();
    saveTo(*stream, engine);
    QMetaObject::invokeMethod(this, [this, stream, named = engine.names(), bodies, count] {
      packState({stream, named, bodies, count});
    });
  });
}

void Session::packState(KeptState kept) {
  m_worker->run([this, kept = std::move(kept)] {
    std::shared_ptr<const ProjectState> state;
    QString problem;
    try {
      state = projectState(kept.stream->bytes(), kept.bodies);
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, state, problem, named = kept.named, count = kept.count] {
      if (!m_document->had(count)) return;  // another project has taken its place
      if (state) m_link->keepNames(state, named);
      if (state) m_document->keepState(state);
      if (state) Q_EMIT stateKept();
      if (!state) Q_EMIT stateNotKept(problem);
    });
  });
}

void Session::applyUndoMemory() {
  const size_t most = static_cast<size_t>(preferences::undoMemory()) * preferences::kMiB;
  m_document->undoStack().setLimit(most > 0 ? most : History::kEndless);
}

void Session::applyRecordBudget() {
  if (m_engine) m_engine->setRecordBudget(preferences::recordBudget(m_engine->recording().cost().disk));
}

void Session::applyAutosave() {
  if (m_autosave) m_autosave->setInterval(preferences::autosaveInterval());
}

QString Session::close() {
  if (m_closed || !m_autosave) return {};
  const bool hasRun = m_recordings->keep(m_autosave->runPath());
  const QString problem = m_autosave->close(hasRun);
  m_closed = problem.isEmpty();
  return problem;
}

}  // namespace ps
