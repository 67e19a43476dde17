// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/filestamp.h"
#include "core/scene/project.h"
#include "ui/document/about.h"
#include "ui/document/changeevent.h"
#include "ui/document/history.h"
#include "ui/document/placement.h"
#include "ui/document/port.h"
#include "ui/document/strokerecord.h"

#include <QtCore/QObject>
#include <QtCore/QString>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class PluginRegistry;
struct ProbeEdit;
struct TrackEdit;

/// The document of the editor: a project and its history. Every edit is an undo command and ends in one changed()
/// signal with a typed event; nothing here knows the engine or a widget. UI thread only.
class Document : public QObject {
  Q_OBJECT
 public:
  explicit Document(QObject* parent = nullptr);
  ~Document() override;

  /// Declarations of plugins, defaults of materials. May be nullptr while plugins are being loaded.
  void setPlugins(const PluginRegistry* plugins);
  const PluginRegistry* plugins() const { return m_plugins; }

  const Project& project() const { return m_project; }
  History& undoStack() { return m_undo; }
  const History& undoStack() const { return m_undo; }

  /// Replaces the project and forgets the history. `dirty`: it differs from the file (a restored autosave). `file`:
  /// what the file was when the project was read from it or came to differ from it.
  void open(Project project, const QString& path, bool dirty = false, bool play = true, const FileStamp& file = {});
  const QString& path() const { return m_path; }  ///< "" when it was never saved
  QString title() const;                          ///< the project's title, else the file's name, else "New scene"
  bool isDirty() const;
  const FileStamp& file() const { return m_file; }  ///< as it was read or saved last, here
  /// The file at `path` now holds the project as it was at `changeCount` (see changeCount()). False, and nothing
  /// happens, when another project has taken its place since.
  bool saved(const QString& path, uint64_t changeCount, const FileStamp& file = {});
  /// Whether the project had this count (see changeCount()) since it was opened.
  bool had(uint64_t changeCount) const { return changeCount >= m_opened; }
  /// Rises with every change of the project, and when another takes its place.
  uint64_t changeCount() const { return m_changes; }

  ProjectAbout about() const;
  void setAbout(ProjectAbout about, const QString& text);

  // Parameters
  Value value(const Address& address) const;
  Value defaultValue(const Address& address) const;
  const api::ParameterDeclaration* declaration(const Address& address) const;
  /// Of the scene as it is made: another value acts at the next reset.
  bool actsAtReset(const Address& address) const;
  /// Edits between these two are one undo step.
  void beginGesture(const QString& text = {});
  void endGesture();
  /// What the open gesture has done so far, as if it had never been.
  void takeGestureBack();
  /// Sets a value (the default removes the explicit one). Returns "" or why it is refused; the old one then stays.
  QString setParameter(const Address& address, const Value& value);
  /// Several parameters as one undo step, judged together (of probes those alone); within a gesture those of the same
  /// addresses are one. Returns "" or why one is refused; nothing is then set.
  QString setParameters(const std::vector<std::pair<Address, Value>>& values, const QString& text);
  /// The engine has refused a value and goes on with another (see storedValue()): so does the document, as if it had
  /// never been set. Nothing happens when it has another value by now.
  void takeBack(const Address& address, const Value& asked, const std::optional<Value>& goesOn);

  // Bodies
  const Body* body(const std::string& id) const;
  void renameBody(const std::string& id, const QString& name);
  /// An id that no body and no emitter has had since the project was opened: "sketch-2". Matter of those that are gone
  /// may live on in the scene, or come back by undo.
  std::string freeBodyId(const std::string& stem);
  /// A body more, last of all; its id gets a number when it is taken, and so does its mesh's where the scene has
  /// another of that name. A mesh that is there already is shared. Returns the body's id.
  std::string addBody(Body body);
  /// Takes a body out of the scene with its matter. Returns "" or why it stays.
  QString removeBody(const std::string& id);
  /// What holds a body together: a constraint plugin's id in place of those that did, or "none". Acts at the next
  /// reset.
  void setStructure(const std::string& id, const std::string& plugin);
  /// Adds a constraint between neighbours to a body, or takes it away.
  void setNeighbourConstraint(const std::string& id, const std::string& plugin, bool used);
  void setBodyMaterial(const std::string& id, const std::string& material);
  /// Whether a material holds on to another one of the scene.
  void setAdhesion(const std::string& id, const std::string& other, bool holds);
  /// Notes a stroke whose particles are in the engine already. A body that it begins joins a group, in the same step;
  /// "": none.
  void addStroke(std::shared_ptr<StrokeRecord> stroke, const std::string& group = {});
  /// What a sketched body is from now on, as its strokes draw it. Acts at the next reset.
  void setSketch(const std::string& id, const VoxelShape& sketch, const QString& title);
  /// A sketched body has come apart: pieces of it, cells as piecesOf() has them, are bodies of their own from now on,
  /// with their matter, the body's groups and its keys. What none of them has is the body's. One step. Returns their
  /// ids; none: nothing is to be parted.
  std::vector<std::string> partBody(const std::string& id, const std::vector<CellIndices>& pieces);
  /// Parts of one stroke, as one step; at least one.
  void addStrokes(const std::vector<std::shared_ptr<StrokeRecord>>& parts, const QString& text);

  // Emitters and sinks. They stay within the scene's bounds.
  const Emitter* emitter(const std::string& id) const;
  const Sink* sink(const std::string& id) const;
  QString portName(const Port& port) const;  ///< "" when it is gone
  /// Its id, "tap" or "drain" where it has none, gets a number when it is taken; a name comes from the id.
  Port addEmitter(Emitter emitter);
  Port addSink(Sink sink);
  /// Replaces the one of its id: another place or name. Within a gesture all edits are one undo step.
  void editEmitter(Emitter after, const QString& title);
  void editSink(Sink after, const QString& title);
  void renamePort(const Port& port, const QString& name);
  /// Takes a tap out of the scene with what it has poured, as a body goes with its matter; what a drain took stays
  /// away.
  void removePort(const Port& port);

  // Walls
  const SceneWall* wall(const std::string& id) const;
  /// Walls that let no heat through, where the scene ends: ids of kWallSides. As one step; sides that are closed
  /// already are left out. Returns "" or why none came.
  QString addWalls(const std::vector<std::string>& sides);
  void removeWall(const std::string& id);
  void renameWall(const std::string& id, const QString& name);

  // Things of several kinds
  std::optional<ThingMarks> marks(const Address& thing) const;  ///< whatever its key; nothing: it is gone
  void setVisible(const std::vector<Address>& things, bool visible);
  void setLocked(const std::vector<Address>& things, bool locked);
  void setBodiesVisible(const std::vector<std::string>& ids, bool visible);
  /// Bodies, emitters, sinks, walls and probes of a project come into this one, as one step, with their tracks, groups
  /// and materials, but for materials that the scene has already; what they refer to among themselves follows their new
  /// ids. A copy of some of a group's members joins that group, one of all of them is a group more. Returns them as
  /// they are here.
  Placement insertThings(Project things, const QString& title);
  /// How things stand in lists, and their groups (see livingGroups()).
  SceneOrder order() const;
  void setOrder(SceneOrder after, const QString& title);
  /// Members as groups name them; they leave the groups that they were in. Returns the id.
  std::string addGroup(std::vector<std::string> members);
  void removeGroups(const std::vector<std::string>& ids);  ///< their members stay
  void renameGroup(const std::string& id, const QString& name);

  // Places
  /// Things of the scene stand as these say, by their ids; what is not there is left out. Matter of bodies is carried
  /// along; other sizes act at the next reset. Within a gesture all edits of the same things are one undo step.
  void place(Placement after, const QString& title);

  // Materials
  /// The scene's material of an installed one, added where there is none yet. Returns its id.
  std::string addMaterial(const std::string& base);
  /// A material of the scene becomes another installed one, with that one's values and name; its bodies, taps and other
  /// references stay. Acts at the next reset. One step, which brings back all that it said before.
  void useOtherMaterial(const std::string& id, const std::string& base);
  /// "" or why a material cannot leave the scene: which body is of it.
  QString whyMaterialStays(const std::string& id) const;
  QString removeMaterial(const std::string& id);  ///< returns whyMaterialStays()

  // The state that the project opens at: see ProjectState. The scene that runs stays what it is.
  void keepState(std::shared_ptr<const ProjectState> state);
  void removeState();

  // Keys over time: see Track. Within a gesture all edits of the same parameters' are one undo step.
  const Track* track(const Address& address) const;  ///< nullptr: it has no keys
  double keySlack() const;                           ///< s around a key in which a time is on it: half a frame
  /// Of what has the keys: a point of a curve has a number in brackets behind its address, see TrackTarget.
  const api::ParameterDeclaration* keyDeclaration(const Address& address) const;
  QString whyNoKeys(const Address& address) const;  ///< "" or why it can have none, as a sentence
  /// A key at a time in s, or another value of the one that is there. Returns "" or why there is none.
  QString putKey(const Address& address, double time, double value);
  /// It stays between its neighbours. Returns "" or why it stays where it is.
  QString moveKey(const Address& address, size_t index, double time, double value);
  void removeKey(const Address& address, size_t index);  ///< the last takes the track with it
  QString setWay(const Address& address, size_t index, ToNext way);
  void removeTrack(const Address& address);  ///< of a curve those of all its points
  /// All keys of some parameters at once, as one step; none: without. Returns "" or what is wrong with a key that was
  /// not there before, and then nothing happens.
  using Keys = std::pair<Address, std::vector<TrackKey>>;
  QString setKeys(const std::vector<Keys>& tracks, const QString& text);
  QString trackTitle(const Address& address) const;  ///< "Temperature of Hot plate"

  // Markers, by their place in the project's list. Within a gesture all edits are one undo step.
  /// Named by its number. Returns its place.
  size_t addMarker(double time);
  void editMarker(size_t place, double time, const QString& name);
  void removeMarker(size_t place);

  // Probes. What they measure are parameters of theirs: see probeParameters().
  const Probe* probe(const std::string& id) const;
  /// Its id, "probe" where it has none, gets a number when it is taken; a name comes from the id. Returns the id.
  std::string addProbe(Probe probe);
  void editProbe(Probe after, const QString& title);  ///< replaces the one of its id
  void renameProbe(const std::string& id, const QString& name);
  void removeProbe(const std::string& id);  ///< with its curves

  // Graphs. Where the project says nothing of them they are those that suit its probes, until the first edit.
  std::vector<Graph> graphs() const;
  /// At a place among the others; its id gets a number when it is taken. Returns the id.
  std::string addGraph(Graph graph, size_t place, const QString& title);
  void removeGraph(const std::string& id);
  void moveGraph(const std::string& id, int places);
  void editGraph(const std::string& id, const QString& title, const std::function<void(Graph&)>& change);
  /// A curve more, see GraphSource: in this graph, where it is one over time, or else in one of its own beside it. One
  /// that is there already stays the only one.
  void plot(const std::string& id, const std::string& source);
  /// The same with a probe that is made for it, as one step. Returns the probe's id.
  std::string plotProbe(const std::string& id, Probe probe);
  void removeSeries(const std::string& id, const std::string& source);

  // View: saved with the project, no undo steps except pins
  void setPinned(const std::string& address, bool pinned);
  void setColour(const std::string& colour);
  void setView(const ViewState& view);  ///< camera and section; silent

  // Used by commands
  void applyParameter(const Address& address, const std::optional<Value>& value);
  void applyBodies(const std::vector<SceneEdit>& edits, bool forward, const MatterRef& matter);
  void applyParting(const std::shared_ptr<const Parting>& parting, bool done);
  void applyPort(const AnyPortEdit& edit, bool forward);
  void applyPlacement(const Placement& to);
  void applyWalls(const std::vector<SceneWall>& walls);
  void applyMarks(const std::vector<ThingMarks>& marks);
  void applyMaterials(const std::vector<SceneMaterial>& materials);
  void applyStroke(const std::shared_ptr<StrokeRecord>& stroke, bool done, bool live);
  void applyState(const std::shared_ptr<const ProjectState>& state);
  void applyPins(const std::vector<std::string>& pins);
  void applyAbout(const ProjectAbout& about);
  void applyTrack(const TrackEdit& edit, bool forward);
  void applyOrder(const SceneOrder& order);
  void applyGraphs(const std::optional<std::vector<Graph>>& graphs);
  void applyMarkers(const std::vector<Marker>& markers);
  void applyProbe(const ProbeEdit& edit, bool forward);

 Q_SIGNALS:
  void replacing();  ///< unsaved work is about to give its place to another project
  void changed(const ps::ChangeEvent& event);

 private:
  void notify(const ChangeEvent& event);
  QString setProbeParameter(const Address& address, const Value& value);
  QString setProbeParameters(const std::vector<std::pair<Address, Value>>& values, const QString& text);
  /// The probe with another value there; nothing where it is the same, or where `problem` says why it is refused.
  std::optional<Probe> probeWith(const Address& address, const Value& value, QString& problem) const;
  void pushProbe(ProbeEdit edit, const QString& title);
  void setGraphs(std::vector<Graph> graphs, const QString& title);
  void setMarkers(std::vector<Marker> markers, const QString& title);
  std::vector<TrackEdit> tracksAfter(const Address& curve, const Value& after) const;
  std::vector<ParameterChanged> compositionOf(const SceneEdit& edit) const;
  std::optional<Value> asStored(const Address& address, const std::optional<Value>& value) const;
  void takeAlong(const std::string& id, const std::vector<std::string>& pieces, const QString& title);
  void editBody(const std::string& id, const QString& text, const std::function<void(Body&)>& change);
  /// Those that `change` has changed, as one step.
  void setMarks(const std::vector<Address>& things, const QString& title,
                const std::function<void(ThingMarks&)>& change);
  template <class Item>
  void pushPort(std::optional<Item> before, std::optional<Item> after, size_t index, const QString& title);

  const PluginRegistry* m_plugins = nullptr;
  Project m_project;
  QString m_path;
  FileStamp m_file;
  History m_undo;
  int m_gesture = 0, m_gestureDepth = 0;
  QString m_gestureText;
  int64_t m_gestureBegan = 0;            ///< position of the history
  bool m_neverClean = false;             ///< the file holds no state of this history
  std::set<std::string> m_usedIds;       ///< of bodies and emitters
  uint64_t m_changes = 0, m_opened = 0;  ///< changes: now, and when the project was opened
};

}  // namespace ps
