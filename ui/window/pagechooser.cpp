// SPDX-License-Identifier: Apache-2.0
#include "ui/window/pagechooser.h"

#include "ui/panels/inspector.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"
#include "ui/window/dock.h"
#include "ui/window/windowlayout.h"

#include <algorithm>

namespace ps {
namespace {

const QString kInspector = QStringLiteral("dock.inspector");
const QString kBody = QStringLiteral("Body"), kMaterial = QStringLiteral("Material"), kScene = QStringLiteral("Scene"),
              kSolver = QStringLiteral("Solver"), kBrush = QStringLiteral("Brush");

/// What the first page is called for what is selected, which it shows in the place of bodies; "" where it does not.
QString titleInstead(const Selection& selection) {
  const OutlineKind kind = selection.kind();
  const auto& items = selection.items();
  const auto count =
      std::count_if(items.begin(), items.end(), [&](const SelectedItem& item) { return item.kind == kind; });
  if (kind == OutlineKind::Probe) return count > 1 ? QStringLiteral("Probes") : QStringLiteral("Probe");
  if (count < 2) return {};
  return kind == OutlineKind::Wall      ? QStringLiteral("Walls")
         : kind == OutlineKind::Emitter ? QStringLiteral("Taps")
         : kind == OutlineKind::Sink    ? QStringLiteral("Drains")
                                        : QString();
}

}  // namespace

PageChooser::PageChooser(Selection& selection, Toolbox& tools, Inspector& inspector, WindowLayout& layout,
                         QObject* parent)
    : QObject(parent), m_selection(selection), m_tools(tools), m_inspector(inspector), m_layout(layout) {
  connect(&selection, &Selection::changed, this, &PageChooser::onSelection);
  connect(&selection, &Selection::materialPicked, this, [this] {
    if (!m_tools.tool().usesBrush()) m_layout.showPage(kMaterial);
  });
  connect(&tools, &Toolbox::toolChanged, this, &PageChooser::onTool);
}

void PageChooser::onTool() {
  const bool draws = m_tools.tool().usesBrush(), shown = m_layout.dock(kInspector)->currentPage() == kBrush;
  if (draws && !shown) m_layout.turnTo(kBrush);
  if (!draws && shown) m_layout.turnTo(kMaterial);
}

void PageChooser::onSelection() {
  const QString instead = titleInstead(m_selection);
  m_layout.setPageTitle(kBody, instead.isEmpty() ? kBody : instead);
  if (m_selection.empty()) return;
  if (!instead.isEmpty() && m_selection.kind() != OutlineKind::Probe) {
    m_layout.showPage(kBody);
    return;
  }
  const std::string id = m_selection.id();
  switch (m_selection.kind()) {
    case OutlineKind::Body:
      if (m_layout.dock(kInspector)->currentPage() != kMaterial) m_layout.showPage(kBody);
      break;
    case OutlineKind::Emitter:
      reveal({Owner::Emitter, id, "speed"}, false);
      break;
    case OutlineKind::Sink:
      reveal({Owner::Sink, id, "open"}, false);
      break;
    case OutlineKind::Wall:
      reveal({Owner::Wall, id, "heat"}, false);  // the outliner keeps the focus: arrows walk on
      break;
    case OutlineKind::Environment:
    case OutlineKind::Scene:
    case OutlineKind::Group:
      m_layout.showPage(kScene);
      break;
    case OutlineKind::Pin:  // its body's rows say nothing of it
      break;
    case OutlineKind::Probe:
      m_layout.showPage(kBody);
      [[fallthrough]];
    case OutlineKind::Probes:
      m_layout.showPage(QStringLiteral("Graphs"));
      break;
  }
}

bool PageChooser::reveal(const Address& address, bool focus) {
  // Of one that is gone the panel would show another in its place.
  if (!m_inspector.has(address)) return false;
  ParameterPanel* panel = m_inspector.panelFor(address);
  if (!panel) return false;
  m_layout.showPage(panel == m_inspector.bodyPanel()       ? kBody
                    : panel == m_inspector.materialPanel() ? kMaterial
                    : panel == m_inspector.scenePanel()    ? kScene
                                                           : kSolver);
  panel->setFilter({});
  panel->setChangedOnly(false);
  return panel->reveal(QString::fromStdString(address.text()), focus);
}

}  // namespace ps
