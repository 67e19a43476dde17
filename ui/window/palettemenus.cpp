// SPDX-License-Identifier: Apache-2.0
#include "ui/window/palettemenus.h"

#include "ui/document/document.h"
#include "ui/graphs/graphspanel.h"
#include "ui/panels/strokeslist.h"
#include "ui/session/session.h"
#include "ui/theme/plaintext.h"
#include "ui/timeline/markerrow.h"
#include "ui/timeline/transport.h"
#include "ui/window/actions.h"
#include "ui/window/mainwindow.h"
#include "ui/window/welcome.h"

#include <QtGui/QAction>
#include <QtWidgets/QMenu>

#include <memory>
#include <string>

namespace ps {
namespace {

using Entries = std::vector<PaletteEntry>;
using Show = std::function<void()>;

/// A menu's actions, and those of its submenus that are filled, under the name of what they are for.
void addMenu(Entries& entries, const std::shared_ptr<QMenu>& menu, const QString& of, const QString& where,
             const Show& show) {
  const auto add = [&](QAction* action, const QString& before) {
    if (action->isSeparator() || action->menu()) return;
    const QString text = cleanText(*action);  // with the key behind a tab
    entries.push_back({before + text.section(QLatin1Char('\t'), 0, 0),
                       where,
                       text.section(QLatin1Char('\t'), 1),
                       {},
                       [show, menu, action] {
                         show();
                         action->trigger();
                       },
                       false,
                       action->isEnabled() ? QString() : QStringLiteral("Not possible at present")});
  };
  for (QAction* action : menu->actions()) {
    add(action, of);
    if (!action->menu() || !action->isEnabled()) continue;
    const QString inner = of + fromButtonText(action->text()) + QStringLiteral(": ");
    for (QAction* each : action->menu()->actions()) add(each, inner);
  }
}

void addGraphs(Entries& entries, MainWindow& window, const Show& show) {
  GraphsPanel* graphs = window.graphs();
  std::vector<std::string> ids{{}};  // of the place where none is, too
  for (const Graph& graph : window.session().document().graphs()) ids.push_back(graph.id);
  for (const std::string& id : ids) {
    const std::shared_ptr<QMenu> menu(graphs->makeMenu(id));
    menu->setParent(nullptr);  // it lasts as long as what is found
    const Plot* plot = graphs->plot(id);
    addMenu(entries, menu, {}, plot ? QStringLiteral("Graph “%1”").arg(plot->title()) : QStringLiteral("Graphs"), show);
  }
}

/// In Sketch there is the ruler alone.
void addMarkers(Entries& entries, MainWindow& window) {
  auto* row = window.findChild<MarkerRow*>();
  if (!row) return;
  const auto show = [&window] {
    window.welcome().leave();
    if (window.workspaceTab() == MainWindow::kSketchTab) window.showWorkspace(MainWindow::kSceneTab);
  };
  const std::vector<Marker>& markers = window.session().document().project().markers;
  for (size_t k = 0; k < markers.size(); ++k) {
    const auto menu = std::make_shared<QMenu>();
    row->fillMenu(*menu, k);
    addMenu(entries, menu, QString::fromStdString(markers[k].name) + QStringLiteral(": "), QStringLiteral("Timeline"),
            show);
  }
}

/// Each can be chosen; what is done is done with the one that is, or with the last.
void addStrokes(Entries& entries, MainWindow& window, const Show& show) {
  auto* list = window.findChild<StrokesList*>();
  if (!list || list->lines().empty()) return;
  const auto count = static_cast<int>(list->lines().size());
  const auto title = [](int line) { return QStringLiteral("Stroke %1: ").arg(line + 1); };
  const Body* body = window.session().document().body(list->body());
  const QString where = body ? QString::fromStdString(body->name) : QStringLiteral("Sketch");
  for (int line = 0; line < count; ++line)
    entries.push_back({title(line) + list->lines()[static_cast<size_t>(line)].name, where,
                       list->lines()[static_cast<size_t>(line)].length, QStringLiteral("choose"), [list, show, line] {
                         show();
                         list->setCurrent(line);
                       }});
  const int line = list->current() < 0 ? count - 1 : list->current();
  const std::shared_ptr<QMenu> menu(list->menuOf(line));
  menu->setParent(nullptr);
  addMenu(entries, menu, title(line), where, show);
}

}  // namespace

void addContextMenus(Entries& entries, MainWindow& window, const std::function<void(const QString&)>& show) {
  addGraphs(entries, window, [show] { show(QStringLiteral("Graphs")); });
  const auto runs = std::make_shared<QMenu>();
  window.transport()->fillMenu(*runs);
  addMenu(entries, runs, {}, QStringLiteral("Timeline"), [] {});
  addMarkers(entries, window);
  addStrokes(entries, window, [show] { show(QStringLiteral("Brush")); });
}

}  // namespace ps
