// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/session/autosave.h"
#include "ui/session/messagelog.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <atomic>
#include <memory>

namespace ps {

class Document;
class DocumentFiles;
class EngineThread;
class ParticleFields;
class PluginRegistry;
class RecordedView;
class RecordingFiles;
class RunWork;
class SceneLink;
class Transitions;
class StateBuffer;
class Swatches;
class Worker;
struct EngineEvent;

/// What a window works on: plugins, document, engine, files, autosave. Plugins are loaded on a worker thread so that
/// the window shows first; until ready() there is no engine. Knows no widget.
class Session : public QObject {
  Q_OBJECT
 public:
  struct Options {
    bool autosave = true;
    std::vector<std::string> pluginPaths;  ///< besides the usual ones
    QString autosaveDirectory;             ///< "": the user's state directory
  };
  explicit Session(const Options& options, QObject* parent = nullptr);
  ~Session() override;

  void start();  ///< begins to load plugins; ready() follows
  bool isReady() const { return m_engine != nullptr; }
  /// The project's first snapshot has not come yet: what is recorded is the run of the one before. See projectShown().
  bool isOpening() const { return m_opening; }

  Document& document() { return *m_document; }
  DocumentFiles& files() { return *m_files; }
  MessageLog& log() { return *m_log; }
  Worker& worker() { return *m_worker; }
  PluginRegistry* plugins() { return m_plugins.get(); }
  /// The same, for work in the background that may outlive the session.
  const std::shared_ptr<PluginRegistry>& registry() const { return m_plugins; }
  Swatches& swatches() { return *m_swatches; }                ///< pictures of materials, for whatever shows them
  const ParticleFields& fields() const { return *m_fields; }  ///< of particles; until ready() ours alone
  EngineThread* engine() { return m_engine.get(); }
  SceneLink* link() { return m_link.get(); }
  Autosave* autosave() { return m_autosave.get(); }

  Transitions& transitions() { return *m_transitions; }

  RecordedView& recorded() { return *m_recorded; }  ///< what is shown of the run

  RecordingFiles& recordings() { return *m_recordings; }
  RunWork& work() { return *m_work; }

  SnapshotPtr snapshot() const;          ///< that is shown: a recorded one, or the newest
  SnapshotPtr previousSnapshot() const;  ///< the one before the newest, where that is shown
  SnapshotPtr newest() const;
  double now() const;                            ///< s, of the snapshot that is shown
  Value valueNow(const Address& address) const;  ///< by its track, where that acts, or else by the document
  Environment surroundings() const;              ///< walls and air, as tracks have them now
  void playPause();
  /// The record, where a frame of it is shown or it loops; else the run goes on.
  void play();
  void pause();
  /// Simulated seconds per second, of the run where the solver keeps up, and of its record; positive.
  void setSpeed(double speed);
  void step();           ///< of the record, while a recorded frame is shown
  void reset();          ///< to the start, whether or not the project holds a state
  void returnToState();  ///< to the state that the project holds
  /// Takes matter as it stands into the project, between two frames: stateKept() or stateNotKept() follows.
  void keepState();
  bool playing() const;
  /// What acts at the next reset acts at once: the scene stands paused at its start, where nothing is lost by that.
  bool appliesAtOnce() const;
  /// Gives up the scene that making() tells of. False where it tells of none.
  bool cancelMaking();
  /// The engine has no scene: the project cannot be built as it is (see SceneLink::isBroken()).
  bool isBroken() const;
  // Preferences as they are by now.
  void applyUndoMemory();
  void applyRecordBudget();
  void applyAutosave();
  /// Last copy of unsaved work, written once. Returns "", or why it could not be: the session then goes on.
  QString close();

 Q_SIGNALS:
  void ready();
  void snapshotArrived();  ///< coalesced: at most one per turn of the event loop
  void valuesDue();        ///< there are newer numbers to show: at most 15 times a second
  void totalsDue();        ///< the same for what goes through all particles: at most 5 times a second
  void playingChanged();
  void happened(const ps::EngineEvent& event);  ///< in the order of their numbers, none left out
  void stateKept();
  void stateNotKept(const QString& problem);
  /// A scene, for a while already; `done` 0..1; `left` in s, -1 where it is too early to tell; often.
  void making(const QString& stage, double done, double left);
  void madeOrNot();     ///< after the last of those
  void projectShown();  ///< the first snapshot of an opened project has arrived

 private:
  void adoptPlugins(std::shared_ptr<PluginRegistry> plugins);
  void onSnapshot();
  /// What the engine's thread gives of a state that is to be kept.
  struct KeptState {
    std::shared_ptr<const StateBuffer> stream;
    std::shared_ptr<const NamedMatter> named;
    std::vector<Body> bodies;
    uint64_t count = 0;  ///< Document::changeCount() when it was asked for
  };
  void packState(KeptState kept);
  void tellValues();
  void tellMaking();
  void onShown();
  void tellPlaying();

  Options m_options;
  std::unique_ptr<MessageLog> m_log;
  std::unique_ptr<Document> m_document;
  std::unique_ptr<Transitions> m_transitions;
  std::unique_ptr<RecordedView> m_recorded;
  std::unique_ptr<DocumentFiles> m_files;
  std::unique_ptr<Autosave> m_autosave;
  std::shared_ptr<PluginRegistry> m_plugins;
  std::unique_ptr<const ParticleFields> m_fields;
  std::atomic<bool> m_pending{false};
  bool m_wasPlaying = false, m_closed = false;
  bool m_opening = true;  ///< the project's first snapshot has not come yet
  uint64_t m_before = 0;  ///< revision of the last snapshot of the project before
  uint64_t m_eventsRead = 0;
  QTimer m_values, m_totals;
  QTimer m_making;  ///< runs while a scene is being made
  QElapsedTimer m_makingSince;
  double m_made = 0;  ///< share that was told last; less than that is another scene's
  bool m_toldMaking = false;
  std::unique_ptr<EngineThread> m_engine;
  std::unique_ptr<SceneLink> m_link;
  std::unique_ptr<RecordingFiles> m_recordings;  // ends before the engine, whose record it reads
  std::unique_ptr<RunWork> m_work;               // likewise
  std::unique_ptr<Swatches> m_swatches;
  std::unique_ptr<Worker> m_worker;  // ends first: its jobs point at the others
};

}  // namespace ps
