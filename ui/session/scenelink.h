// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/document/strokerecord.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Document;
class EngineThread;
struct EngineEvent;

/// Carries a document's changes to the engine's thread, and the live pieces of a stroke past the document. Commands act
/// between frames, in order; what is to be remembered of particles (ids, fields) the engine keeps by name.
class SceneLink : public QObject {
  Q_OBJECT
 public:
  SceneLink(Document& document, EngineThread& engine, QObject* parent = nullptr);
  ~SceneLink() override;

  /// Back to the start, edits kept. Undoing an earlier stroke still removes exactly its particles.
  void reset();
  /// Paused at the start nothing is lost by a reset: what acts at the next one is followed by it, after the last value
  /// of a drag. Not when making the scene was given up, or failed, until the next such value.
  bool appliesAtOnce() const;
  void applyWaiting();  ///< now, where it is still to come
  /// To the state that the project holds, edits kept; the engine refuses one that no longer fits.
  void returnToState();
  /// What strokes had made when a state was kept: after a return to it, undoing them takes just that.
  void keepNames(const std::shared_ptr<const ProjectState>& state, std::shared_ptr<const NamedMatter> named);
  /// The engine could not build the scene: its snapshot is empty, and an event says why. Each change of the scene,
  /// reset() and rebuild() try again; made by a change, it plays if the project was opened to play.
  bool isBroken() const;
  void rebuild(bool play);
  /// What the engine's thread has to say, event by event: a value that was refused leaves the document.
  void hear(const EngineEvent& event);
  /// A piece of a stroke in the making: `body` is the painted body as it was before, `cells` are new.
  void paint(const StrokeRecord& stroke, std::shared_ptr<const Body> body, std::vector<std::array<int, 3>> cells);
  /// What is in the cells now becomes of the stroke's material, except matter of locked bodies.
  void repaint(const StrokeRecord& stroke, std::vector<std::array<int, 3>> cells);
  /// Removes what is in the cells now, except matter of locked bodies.
  void erase(const StrokeRecord& stroke, std::vector<std::array<int, 3>> cells);
  /// A hand that touches matter is there now; matter of locked bodies is spared. See TouchMatter.
  void touch(const StrokeRecord& stroke, TouchMatter touch);
  /// The scene as it is, hidden bodies among it; nullptr before the first.
  SnapshotPtr scene() const;
  /// Whether time passes in the scene.
  bool runs() const;
  /// Whether a hand draws or erases, by a stroke that the document does not know yet.
  bool isDrawing() const { return any(m_drawn); }
  /// Strokes of which neither the project's bodies nor its state know: they erased or painted after the start, where
  /// matter no longer stands where bodies put it, or drew where there is no room at the start.
  size_t strokesOfTheRun() const;
  /// Those, and hands in matter that heated, cut or welded it in this run: what is not at the start, nor in the state.
  size_t strokesHomeLeaves() const;
  /// Takes back a stroke that the document does not know yet (Esc).
  void cancel(const std::shared_ptr<StrokeRecord>& stroke);

 Q_SIGNALS:
  /// The stroke of this matter is about to erase, or to cut there, and not for the first time perhaps: who asks the
  /// engine now sees it as it is before.
  void parting(const ps::MatterRef& stroke, const std::vector<ps::api::Touch>& cuts);
  void matterEdited();               ///< as it stands now: a hand wants to see it
  void strokesLeft(size_t strokes);  ///< reset() went back to a start that has nothing of these

 private:
  void onChanged(const ChangeEvent& event);
  void remember(const StrokeChanged& event);
  MatterKey draws(const StrokeRecord& stroke);  ///< the key of a piece of it
  void takeDrawn(const std::string& body);
  void onStroke(const StrokeChanged& event);
  void undoStroke(const std::shared_ptr<StrokeRecord>& stroke);
  void redoStroke(const std::shared_ptr<StrokeRecord>& stroke);
  void showFields();
  void onBody(const BodyChanged& event);
  void onParting(const BodyParted& event);
  void pushProject();
  void resetSoon();
  void nothingWaits();
  void onPort(const PortChanged& event);
  std::vector<std::string> lockedBodies() const;
  MatterKey keyOf(const MatterRef& matter);  ///< for a command of this run
  bool isOfThisRun(const MatterRef& matter) const;
  void forgetMatter();
  /// The matter of strokes that are done, for the start of a run.
  std::vector<NameMatter> namedMatter();

  Document& m_document;
  EngineThread& m_engine;
  bool m_play = false;     ///< once there is a scene: what the opened project asks for
  uint64_t m_builtAt = 0;  ///< Document::changeCount() of what the engine was given as a whole last
  QTimer m_soon;
  bool m_waits = false;    ///< a reset, for the last value of a drag
  bool m_givenUp = false;  ///< the scene was not made as the last values have it
  struct Drawn {
    std::weak_ptr<const MatterKey> matter;
    std::string on;  ///< the body to which it adds; "": it erases or paints
  };
  using Strokes = std::vector<Drawn>;
  static bool any(const Strokes& strokes);
  static bool drop(Strokes& strokes, const MatterRef& stroke);  ///< whether it was among them
  Strokes m_drawn;                                              ///< by hands, which the document does not know yet
  Strokes m_cutOff;                                             ///< the same, when a reset came while they were drawn
  bool m_taking = false;  ///< a refused value out of the document: the engine has the other one
  struct KnownMatter {
    std::weak_ptr<const MatterKey> matter;
    uint64_t run = 0;
  };
  std::vector<MatterKey> keysOfState() const;
  /// What had a name in the state that the project holds, where this program kept it.
  std::shared_ptr<const NamedMatter> keptNames() const;
  std::vector<std::pair<std::weak_ptr<const ProjectState>, std::shared_ptr<const NamedMatter>>> m_kept;
  uint64_t m_run = 1;  ///< counts resets, and returns to a state: matter of another run is not known by its ids
  std::map<MatterKey, KnownMatter> m_matter;  ///< that the engine may know, and of which run
  struct KnownStroke {
    std::weak_ptr<StrokeRecord> stroke;
    bool done = true;   ///< not undone
    RigidMove way{};    ///< by which its body has been moved since
    double factor = 1;  ///< by which it has been made larger, before that
    MatterKey key = 0;
    bool onlyNow = false;
    uint64_t run = 0;  ///< to which what it drew belongs, once nobody can undo it
  };
  std::vector<KnownStroke> m_strokes;
};

}  // namespace ps
