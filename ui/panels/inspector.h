// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/panels/rownotes.h"
#include "ui/rows/parameterpanel.h"

#include <QtCore/QObject>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ps {

class Document;
class Selection;
enum class OutlineKind;
class Session;

/// The panels Body, Material, Scene and Solver, made from declarations alone, kept in step with the document both ways.
/// The first shows what is selected: bodies, probes, or walls, taps or drains where they are several, edited together;
/// the second the materials that are, likewise.
/// Keys of their rows are addresses. Each gesture in a row is one undo step of the document.
class Inspector : public QObject {
  Q_OBJECT
 public:
  Inspector(Session& session, Selection& selection, QObject* parent = nullptr);
  ParameterPanel* bodyPanel() const { return m_body; }
  ParameterPanel* materialPanel() const { return m_material; }
  ParameterPanel* scenePanel() const { return m_scene; }
  ParameterPanel* solverPanel() const { return m_solver; }

  void rebuild();
  void setBodies(const std::vector<std::string>& ids);  ///< rows are of the last one, edits reach all
  void setBody(const std::string& id) { setBodies(id.empty() ? std::vector<std::string>{} : std::vector{id}); }
  /// Of one kind, in the place of bodies: probes, walls, emitters or sinks, without keys; likewise.
  void setThings(std::vector<Address> things);
  void setMaterials(const std::vector<std::string>& ids);  ///< rows are of the last one, edits reach all
  void setMaterial(const std::string& id) { setMaterials(id.empty() ? std::vector<std::string>{} : std::vector{id}); }
  std::string material() const { return m_materials.empty() ? std::string() : m_materials.back().id; }
  bool has(const Address& address) const;  ///< whether a row may be shown for it
  /// The panel that shows an address, after selecting its owner alone; nullptr when there is none.
  ParameterPanel* panelFor(const Address& address);

  /// How often the value of one thing was compared with another's so far, for rows of several.
  size_t comparedValues() const { return m_compared; }
  /// How often one of several things was looked for by its id, to find the rows that they share.
  size_t searchedThings() const { return m_searched; }

  /// The one under the pointer, or the one that has the focus; nullptr: there is none.
  ParameterRow* rowAtHand() const;

  /// Operating points and notes of limits; comes by itself a few times a second.
  void setSnapshot(const Snapshot& snapshot);

 Q_SIGNALS:
  void curveWanted(const ps::Address& address);               ///< of a response: the small curve in its row was clicked
  void wayOutWanted(const QString& link);                     ///< see ui/panels/wayout.h
  void keyRefused(const QString& title, const QString& why);  ///< "No key was set.", why not

 private:
  void onChanged(const ChangeEvent& event);
  void note(const ParameterChanged& change);
  bool selectAlone(OutlineKind kind, const std::string& id);
  void refreshIdle(const Address& changed);
  std::vector<ParameterPanel*> panels() const { return {m_body, m_material, m_scene, m_solver}; }
  void connectPanel(ParameterPanel* panel);
  void onEdited(const QString& key, const Value& value, Edit edit, const ParameterPanel* panel);
  void onKey(const QString& key, const Value& shown);
  void onWay(const QString& key, ToNext way);
  /// Marks of rows whose parameters have keys, and what these give now.
  void showTracks();
  void showTrack(const Address& address, KeyMark mark, ToNext way);
  double now() const;  ///< s, of the scene's time
  void onScaled(const QString& key, double factor, double added, const ParameterPanel* panel);
  void onReset(const QString& key, const ParameterPanel* panel);
  void showProblem(const QString& key, const QString& problem);
  void onLink(const QString& key, const QString& link);
  void rebuildBody();
  bool rebuildThings();  ///< false: bodies are shown
  void showThingsHeader();
  void onProbe(const std::string& id);
  void rebuildMaterial();
  void showMaterialHeader();
  QString materialDetail() const;
  void showTemperatures(const Snapshot& snapshot);
  /// K, at which a material's curves are read: the mean of its particles, or of all matter where it has none.
  double temperatureOf(const std::string& material) const;
  double ambientTemperature() const;  ///< K, at which curves are read where there is no matter
  // inspectorbodies.cpp
  void showSelected();
  /// What the first panel shows, without keys; rows are of the last one.
  const std::vector<Address>& shown() const;
  /// All that are shown with a row's owner, its own kind, likewise.
  const std::vector<Address>& fellowsOf(const Address& address) const;
  std::vector<Address> addressesOf(const Address& address, const ParameterPanel* panel) const;
  bool isMixed(const Address& address) const;
  void shareRows(std::vector<RowModel>& rows, const std::vector<Address>& things) const;
  bool showCount();  ///< of several, in the header; false: one is shown
  QString countOfBodies() const;
  void countSoon();
  void refreshMixed(const Address& changed);
  QString setAll(const std::vector<Address>& all, const Value& value);
  QString setEach(const std::vector<std::pair<Address, Value>>& values);
  QString setOne(const Address& address, const Value& value);
  QString whyKeyed(const std::vector<Address>& all) const;
  QString titleOfAll(const Address& address, size_t count) const;
  void showEdges(const std::string& id);  ///< which ones are held, as the body is turned by now
  void showPlace(const std::string& id);
  void refreshProperties(const std::string& material);
  void rebuildScene();
  void showSceneHeader();
  void rebuildSolver();
  /// Rows of the owner of `any`, whatever its key; a group of its own replaces the declarations' groups.
  void addRows(std::vector<RowModel>& rows, Address any, api::ParameterList list, const QString& group = {},
               const ParameterSet& defaults = {});
  void addPinned(std::vector<RowModel>& rows);
  void markPinned();
  const char* keep(const QString& text);

  Session& m_session;
  Document& m_document;
  Selection& m_selection;
  ParameterPanel *m_body, *m_material, *m_scene, *m_solver;
  RowNotes m_notes;
  std::vector<Address> m_bodies, m_things;                 ///< what is shown; bodies while none of the others is there
  std::vector<Address> m_materials;                        ///< the last one is material()
  mutable std::map<std::string, std::string> m_differing;  ///< one of them with another value, by the row's address
  mutable size_t m_compared = 0, m_searched = 0;
  std::set<std::string> m_texts;                        ///< headings and labels that rows borrow; grows with names only
  bool m_counts = false;                                ///< soon: once for all bodies that an edit reaches
  QString m_count;                                      ///< of several bodies, as the header says it
  QString m_grade;                                      ///< of the material's sources, as the header says it
  std::set<std::string> m_tracked;                      ///< addresses of what has keys, as rows show it
  double m_shownAt = -1;                                ///< s, for which rows show what keys give
  std::optional<double> m_editedAt;                     ///< s of the scene, when the drag of a row began
  std::vector<std::pair<Address, Value>> m_editedFrom;  ///< what all had then
  double m_sceneMean = 293.15;                          ///< K
  std::map<std::string, double> m_mean;                 ///< K, by material; of those that have particles
};

}  // namespace ps
