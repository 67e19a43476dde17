// SPDX-License-Identifier: Apache-2.0
// Where the docks of each workspace stand as long as nobody has arranged them.
#include "ui/window/docklayouts.h"

#include "ui/window/dock.h"
#include "ui/window/paneltable.h"
#include "ui/window/windowlayout.h"

#include <QtWidgets/QMainWindow>

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

// The narrow inspector has room for its longest label; graphs, for all lines of the ledger beside the energy's, take
// what the timeline leaves as long as it has no rows.
constexpr DockColumn kColumns[] = {{0, true, 204, 352, 270, 140, 190, 400, 150, 400},
                                   {1500, false, 236, 392, 430, 252, 206, 520, 206, 500},
                                   {2200, false, 300, 460, 786, 252, 288, 760, 288, 640}};
constexpr int kBrushPanel = 324;  ///< px, in Sketch, whatever width the window has

}  // namespace

const DockColumn& dockColumn(int width) {
  return *std::find_if(std::rbegin(kColumns), std::rend(kColumns) - 1,
                       [width](const DockColumn& column) { return width >= column.from; });
}

void WindowLayout::lay() {
  switch (m_workspace) {
    case Workspace::Scene:
      return layScene();
    case Workspace::Tune:
      return layTune();
    case Workspace::Film:
      return layFilm();
    case Workspace::Sketch:
      return laySketch();
  }
}

/// Docks move while they are hidden: those in sight would ask for room that they need nowhere.
void WindowLayout::putAway() {
  for (Dock* dock : m_docks) {
    dock->setFloating(false);
    dock->hide();
  }
}

void WindowLayout::showDocks() {
  for (size_t i = 0; i < m_docks.size(); ++i) m_docks[i]->setVisible(shows(i));
  sizeDocks();
}

void WindowLayout::layScene() {
  setJoined(dockColumn(m_window.width()).joined);
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  // All have a place, so that a saved state says of each that it is hidden.
  for (size_t i = 0; i < m_docks.size(); ++i) {
    if (!shows(i)) m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[i]);
  }
  putAway();
  m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[0]);
  m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[2]);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[3]);
  if (!m_joined) m_window.splitDockWidget(m_docks[0], m_docks[1], Qt::Vertical);
  m_window.splitDockWidget(m_docks[3], m_docks[4], Qt::Vertical);
  showDocks();
}

/// The curve takes the middle, over graphs and transport; the view stands on the right, over the points.
void WindowLayout::layTune() {
  Dock *responses = m_docks[5], *curve = m_docks[6], *points = m_docks[7];
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  m_window.addDockWidget(Qt::LeftDockWidgetArea, responses);
  m_window.splitDockWidget(responses, curve, Qt::Horizontal);
  m_window.splitDockWidget(curve, m_docks[3], Qt::Vertical);
  m_window.splitDockWidget(m_docks[3], m_docks[4], Qt::Vertical);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, points);
  showDocks();
}

/// The view takes what there is, over the transport.
void WindowLayout::layFilm() {
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[8]);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[4]);
  showDocks();
}

/// The brushes stand at the left edge from top to bottom, and beside them, once somebody wants them, outliner and
/// materials.
void WindowLayout::laySketch() {
  Dock* brushes = m_docks[9];
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  m_window.addDockWidget(Qt::LeftDockWidgetArea, brushes);
  m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[2]);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[3]);
  m_window.splitDockWidget(brushes, m_docks[0], Qt::Horizontal);
  m_window.splitDockWidget(m_docks[0], m_docks[1], Qt::Vertical);
  m_window.splitDockWidget(m_docks[3], m_docks[4], Qt::Vertical);
  putAway();
  showDocks();
}

void WindowLayout::sizeDocks() {
  const DockColumn& column = dockColumn(m_window.width());
  if (m_workspace == Workspace::Sketch) return m_window.resizeDocks({m_docks[2]}, {kBrushPanel}, Qt::Horizontal);
  if (m_workspace == Workspace::Tune) {
    const int list = column.left, preview = 480;
    m_window.resizeDocks({m_docks[5], m_docks[6]}, {list, m_window.width() - list - preview}, Qt::Horizontal);
    m_window.resizeDocks({m_docks[6], m_docks[3], m_docks[4]}, {column.curve, column.curveGraphs, 40}, Qt::Vertical);
    m_window.resizeDocks({m_docks[7]}, {column.points}, Qt::Vertical);
    return;
  }
  if (m_workspace == Workspace::Film) return m_window.resizeDocks({m_docks[8]}, {column.right}, Qt::Horizontal);
  m_window.resizeDocks({m_docks[0], m_docks[2]}, {column.left, column.right}, Qt::Horizontal);
  if (!m_joined) m_window.resizeDocks({m_docks[0], m_docks[1]}, {column.outliner, column.materials}, Qt::Vertical);
  m_window.resizeDocks({m_docks[3], m_docks[4]}, {column.graphs, 40}, Qt::Vertical);
}

}  // namespace ps
