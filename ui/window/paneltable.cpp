// SPDX-License-Identifier: Apache-2.0
#include "ui/window/paneltable.h"

#include "ui/curves/curvechecks.h"
#include "ui/curves/curvepanel.h"
#include "ui/curves/matterdiagram.h"
#include "ui/curves/pointspanel.h"
#include "ui/curves/responselist.h"
#include "ui/fitting/fitpanel.h"
#include "ui/graphs/energypanel.h"
#include "ui/graphs/graphspanel.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/messagespage.h"
#include "ui/panels/outliner.h"
#include "ui/panels/strokelistedits.h"
#include "ui/panels/strokeslist.h"
#include "ui/session/session.h"
#include "ui/timeline/timeline.h"
#include "ui/tools/toolbox.h"
#include "ui/window/brushbar.h"
#include "ui/window/filmform.h"

#include <QtWidgets/QScrollArea>
#include <QtWidgets/QTreeView>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

/// For panels that may be higher than there is room.
QScrollArea* scrolling(QWidget* panel) {
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(panel);
  return scroll;
}

QWidget* makePoints(const PanelContext& context) {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(new PointsPanel(context.curves), 1);
  column->addWidget(new CurveChecks(context.session, context.curves));
  return scrolling(page);
}

/// Arrows of the tree are as wide as a level of it.
QWidget* makeOutliner(const PanelContext& context) {
  auto* outliner = new Outliner(context.session, context.selection);
  if (context.by == PointedBy::Hand) outliner->view()->setIndentation(kHandLeast);
  return outliner;
}

QWidget* makeMaterials(const PanelContext& context) {
  auto* materials = new MaterialsPanel(context.session, context.selection);
  QScrollArea* scroll = scrolling(materials);
  QObject::connect(materials, &MaterialsPanel::revealed, scroll, [scroll](const QRect& tile) {
    scroll->ensureVisible(tile.center().x(), tile.center().y(), 0, tile.height() / 2);
  });
  return scroll;
}

/// The rows scroll; the strokes stay in sight below them.
QWidget* makeBrush(const PanelContext& context) {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(new BrushPanel(context.tools), 1);
  auto* strokes = new StrokesList(context.session, context.tools);
  QObject::connect(&strokes->edits(), &StrokeListEdits::told, &context.tools, &Toolbox::refuse);
  column->addWidget(strokes);
  return page;
}

QWidget* makeFilm(const PanelContext& context) { return scrolling(new FilmForm(context.session, context.view)); }

}  // namespace

const std::vector<PanelRow>& panelTable() {
  using Context = const PanelContext&;
  static const std::vector<PanelRow> kTable{
      {"dock.outliner", "Outliner", makeOutliner, "scene"},
      {"dock.materials", "Materials", makeMaterials, "tuning"},
      {"dock.inspector", "Body", [](Context c) -> QWidget* { return c.inspector.bodyPanel(); }, "scene"},
      {"dock.inspector", "Material", [](Context c) -> QWidget* { return c.inspector.materialPanel(); }, "tuning"},
      {"dock.inspector", "Scene", [](Context c) -> QWidget* { return c.inspector.scenePanel(); }, "scene"},
      {"dock.inspector", "Solver", [](Context c) -> QWidget* { return c.inspector.solverPanel(); }, "numerics"},
      {"dock.inspector", "Brush", makeBrush, "sketching"},
      {"dock.graphs", "Graphs", [](Context c) -> QWidget* { return new GraphsPanel(c.session); }, "graphs"},
      {"dock.graphs", "Energy", [](Context c) -> QWidget* { return new EnergyPanel(c.session); }, "graphs"},
      {"dock.graphs", "Draw the result", [](Context c) -> QWidget* { return new FitPanel(c.session); }, "graphs"},
      {"dock.graphs", "Messages", [](Context c) -> QWidget* { return new MessagesPage(c.session); }},
      {"dock.graphs", "Heating curve",
       [](Context c) -> QWidget* { return new MatterDiagram(MatterDiagram::Kind::Heating, c.session, c.curves); },
       "tuning"},
      {"dock.graphs", "Phase diagram",
       [](Context c) -> QWidget* { return new MatterDiagram(MatterDiagram::Kind::Phases, c.session, c.curves); },
       "tuning"},
      {"dock.responses", "Responses", [](Context c) -> QWidget* { return new ResponseList(c.session, c.curves); },
       "tuning"},
      {"dock.curve", "Curve", [](Context c) -> QWidget* { return new CurvePanel(c.session, c.curves); }, "tuning"},
      {"dock.points", "Points", makePoints, "tuning"},
      {"dock.film", "Film", makeFilm, "files"},
      {"dock.brushes", "Brushes",
       [](Context c) -> QWidget* { return new BrushBar(c.session, c.selection, c.tools, c.view); }, "sketching"},
      {"dock.transport", "Transport", [](Context c) -> QWidget* { return new Timeline(c.session, c.by); }, "timeline"},
  };
  return kTable;
}

const std::vector<DockRow>& dockTable() {
  using enum Workspace;
  static const std::vector<DockRow> kTable{{"dock.outliner", "Outliner", "", {Scene}, {Sketch}},
                                           {"dock.materials", "Materials", "", {Scene}, {Sketch}},
                                           {"dock.inspector", "Inspector", "Material", {Scene, Sketch}, {}},
                                           {"dock.graphs", "Graphs", "", {Scene, Tune}, {Sketch}},
                                           {"dock.transport", "Timeline", "", {Scene, Tune, Film, Sketch}, {}},
                                           {"dock.responses", "Responses", "", {Tune}, {}},
                                           {"dock.curve", "Curve", "", {Tune}, {}},
                                           {"dock.points", "Points", "", {Tune}, {}},
                                           {"dock.film", "Film", "", {Film}, {}},
                                           {"dock.brushes", "Brushes", "", {Sketch}, {}}};
  return kTable;
}

bool shows(const DockRow& dock, Workspace workspace) {
  return std::find(dock.workspaces.begin(), dock.workspaces.end(), workspace) != dock.workspaces.end();
}

bool offers(const DockRow& dock, Workspace workspace) {
  return shows(dock, workspace) ||
         std::find(dock.offeredIn.begin(), dock.offeredIn.end(), workspace) != dock.offeredIn.end();
}

}  // namespace ps
