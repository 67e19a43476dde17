// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

class QMenu;
class QPoint;

namespace ps {

enum class RowCommand;
enum class WallForm;

class Actions;
class Document;
class Inspector;
class Notices;
class Outliner;
class ParameterRow;
class Selection;
class Session;

/// What is done with the scene's things: the menu Edit but for undo, and the walls.
class EditActions {
 public:
  EditActions(Session& session, Selection& selection, Outliner& outliner, Inspector& inspector, const Actions& actions,
              Notices& notices);
  void makeMenu(QMenu* menu);
  void makeWallMenu(QMenu* menu);
  void openItemMenu(const QPoint& global) const;  ///< of what is selected

 private:
  ParameterRow* orRefused(ParameterRow* row, const QString& refusal);  ///< says where there is none
  void addRowCommands();
  void performAtHand(RowCommand command);  ///< with the row that is meant
  void makeProbeEntries(QMenu* menu);
  void addProbe(bool whole);                             ///< of all that is selected rather than of its middle
  bool plotWall();                                       ///< false: no wall is selected that has a temperature
  void addRoundWall(WallForm form);                      ///< see roundWall()
  void addWalls(const std::vector<std::string>& sides);  ///< of kWallSides
  Session& m_session;
  Document& m_document;
  Selection& m_selection;
  Outliner& m_outliner;
  Inspector& m_inspector;
  const Actions& m_actions;
  Notices& m_notices;
};

}  // namespace ps
