// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/timeline/transport.h"

#include <vector>

class QWidget;

namespace ps {

class CurveTarget;
class Inspector;
class Selection;
class Session;
class Toolbox;
class Viewport;

/// What panels are made with; they follow it by themselves.
struct PanelContext {
  Session& session;
  Selection& selection;
  Toolbox& tools;
  Inspector& inspector;
  CurveTarget& curves;
  Viewport* view;  ///< nullptr where there is no picture
  PointedBy by = PointedBy::Mouse;
};

/// One page of a dock. A new panel is a class in a file of its own and a row in the table.
struct PanelRow {
  const char* dock;   ///< DockRow::name
  const char* title;  ///< of its tab
  QWidget* (*make)(const PanelContext&);
  const char* help = "first-steps";  ///< page that F1 opens in it
};
const std::vector<PanelRow>& panelTable();

/// Which docks the window shows. Their numbers are stored: a new one comes last.
enum class Workspace { Scene, Tune, Film, Sketch };

/// The docks, in the order in which they are laid out.
struct DockRow {
  const char* name;  ///< in saved layouts
  const char* title;
  const char* first;                  ///< page that shows at first; "": the first one
  std::vector<Workspace> workspaces;  ///< that show it
  std::vector<Workspace> offeredIn;   ///< that have a place for it, and show it where somebody wants it
};
const std::vector<DockRow>& dockTable();
bool shows(const DockRow& dock, Workspace workspace);   ///< by default
bool offers(const DockRow& dock, Workspace workspace);  ///< by default or where somebody wants it

}  // namespace ps
