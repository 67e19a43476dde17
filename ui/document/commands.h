// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/about.h"
#include "ui/document/history.h"
#include "ui/document/parting.h"
#include "ui/document/placement.h"
#include "ui/document/port.h"
#include "ui/document/strokerecord.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ps {

class Document;

/// One parameter from an old to a new value; "nothing" is the default.
struct ParameterEdit {
  Address address;
  std::optional<Value> before, after;
};

/// Parameters that change together. Commands of one gesture on the same addresses merge, so that a whole drag is one
/// step; one that ends where it began vanishes.
class ParameterCommand : public WeighedCommand {
 public:
  ParameterCommand(Document& document, std::vector<ParameterEdit> edits, int gesture, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override;
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override;
  /// What it set was refused, and `kept` stays: neither undo nor redo sets it again. False for another command.
  bool amend(const Address& address, const std::optional<Value>& refused, const std::optional<Value>& kept);

 private:
  bool isNothing() const;
  Document& m_document;
  std::vector<ParameterEdit> m_edits;
  int m_gesture;
};

/// Bodies replaced as values: names, structure. With `matter`: added or removed with their particles.
class BodiesCommand : public WeighedCommand {
 public:
  BodiesCommand(Document& document, std::vector<SceneEdit> edits, const QString& text, MatterRef matter = nullptr);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_edits, m_matter); }

 private:
  void apply(bool forward);
  Document& m_document;
  std::vector<SceneEdit> m_edits;
  MatterRef m_matter;
};

/// A body that is parted into pieces.
class PartingCommand : public WeighedCommand {
 public:
  PartingCommand(Document& document, std::shared_ptr<const Parting> parting, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override;

 private:
  Document& m_document;
  std::shared_ptr<const Parting> m_parting;
};

/// An emitter or a sink that comes, goes, moves or is renamed. Moves of one gesture merge; one that ends where it began
/// vanishes.
class PortCommand : public WeighedCommand {
 public:
  PortCommand(Document& document, AnyPortEdit edit, int gesture, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override;
  int id() const override { return 2; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Document& m_document;
  AnyPortEdit m_edit;
  int m_gesture;
};

/// Things put somewhere else, together. Commands of one gesture merge; one that ends where it began vanishes.
class PlacementCommand : public WeighedCommand {
 public:
  PlacementCommand(Document& document, Placement before, Placement after, int gesture, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }
  int id() const override { return 6; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Document& m_document;
  Placement m_before, m_after;
  int m_gesture;
};

/// Walls that come or go: the list before and after.
class WallsCommand : public WeighedCommand {
 public:
  WallsCommand(Document& document, std::vector<SceneWall> before, std::vector<SceneWall> after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  std::vector<SceneWall> m_before, m_after;
};

/// Things that are shown or hidden, locked or free.
class MarksCommand : public WeighedCommand {
 public:
  MarksCommand(Document& document, std::vector<ThingMarks> before, std::vector<ThingMarks> after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  std::vector<ThingMarks> m_before, m_after;
};

/// Materials that come or go, or hold on to others: the list before and after.
class MaterialsCommand : public WeighedCommand {
 public:
  MaterialsCommand(Document& document, std::vector<SceneMaterial> before, std::vector<SceneMaterial> after,
                   const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  std::vector<SceneMaterial> m_before, m_after;
};

/// A finished stroke. Its particles are in the engine before the command is pushed.
class StrokeCommand : public WeighedCommand {
 public:
  StrokeCommand(Document& document, std::shared_ptr<StrokeRecord> stroke, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_stroke); }

 private:
  Document& m_document;
  std::shared_ptr<StrokeRecord> m_stroke;
  bool m_live = true;
};

/// The state that the project opens at; nullptr for its start.
class StateCommand : public WeighedCommand {
 public:
  using State = std::shared_ptr<const ProjectState>;
  StateCommand(Document& document, State before, State after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  State m_before, m_after;
};

/// The track of one parameter before and after, and where it stands among all.
struct TrackEdit {
  size_t index = 0;
  std::optional<Track> before, after;  ///< nothing: there is none
};

/// Keys of parameters. Commands of one gesture merge; one that ends where it began vanishes.
class TrackCommand : public WeighedCommand {
 public:
  TrackCommand(Document& document, std::vector<TrackEdit> edits, int gesture, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override;
  int id() const override { return 3; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  bool isNothing() const;
  Document& m_document;
  std::vector<TrackEdit> m_edits;  ///< one after the other
  int m_gesture;
};

/// Groups, and the order in which things stand: all of both before and after.
class OrderCommand : public WeighedCommand {
 public:
  OrderCommand(Document& document, SceneOrder before, SceneOrder after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  SceneOrder m_before, m_after;
};

/// Graphs that come, go or change: all of them before and after; nothing: those that suit the probes.
class GraphsCommand : public WeighedCommand {
 public:
  using Graphs = std::optional<std::vector<Graph>>;
  GraphsCommand(Document& document, Graphs before, Graphs after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  Graphs m_before, m_after;
};

/// Markers that come, go or change: all of them before and after. Commands of one gesture merge; one that ends where it
/// began vanishes.
class MarkersCommand : public WeighedCommand {
 public:
  MarkersCommand(Document& document, std::vector<Marker> before, std::vector<Marker> after, int gesture,
                 const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }
  int id() const override { return 5; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Document& m_document;
  std::vector<Marker> m_before, m_after;
  int m_gesture;
};

/// A probe that comes, goes or changes, and where it stands among all.
struct ProbeEdit {
  size_t index = 0;
  std::optional<Probe> before, after;  ///< nothing: there is none
};

/// Edits of one probe in one gesture merge; one that ends where it began vanishes.
class ProbeCommand : public WeighedCommand {
 public:
  ProbeCommand(Document& document, ProbeEdit edit, int gesture, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_edit.before, m_edit.after); }
  int id() const override { return 4; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Document& m_document;
  ProbeEdit m_edit;
  int m_gesture;
};

/// What the project says of itself, before and after.
class AboutCommand : public WeighedCommand {
 public:
  AboutCommand(Document& document, ProjectAbout before, ProjectAbout after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override;

 private:
  Document& m_document;
  ProjectAbout m_before, m_after;
};

/// The rows of "Try these".
class PinsCommand : public WeighedCommand {
 public:
  PinsCommand(Document& document, std::vector<std::string> before, std::vector<std::string> after, const QString& text);
  void undo() override;
  void redo() override;
  void weigh(Weight& weight) const override { weight.add(m_before, m_after); }

 private:
  Document& m_document;
  std::vector<std::string> m_before, m_after;
};

}  // namespace ps
