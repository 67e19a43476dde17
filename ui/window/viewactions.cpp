// SPDX-License-Identifier: Apache-2.0
#include "ui/window/viewactions.h"

#include "core/simulation/particlefield.h"
#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/windowlayout.h"
#include "ui/window/workspacekeys.h"

#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

constexpr int kViews = 9, kKeys = 9;

QString nameOf(const OverlayRow& row) { return QStringLiteral("view.") + QLatin1String(row.key); }
QString nameOf(const StudioRow& row) { return QStringLiteral("view.studio.") + QLatin1String(row.key); }

/// Colours are numbered in their order; the first few have keys.
QString colourAction(qsizetype index) { return QStringLiteral("view.colour%1").arg(index + 1); }

}  // namespace

void ViewActions::makeMenu(QMenu* menu) {
  const auto viewAct = [this](auto act) {
    return [this, act] {
      if (m_view) act(*m_view);
    };
  };
  m_actions.add(menu, QStringLiteral("view.frame"), QStringLiteral("Frame selection"),
                {QKeySequence(QStringLiteral("F"))}, viewAct([](Viewport& v) { v.frameSelection(); }));
  m_actions.add(menu, QStringLiteral("view.frameAll"), QStringLiteral("Frame all"),
                {QKeySequence(QStringLiteral("Shift+F"))}, viewAct([](Viewport& v) { v.frameAll(); }));
  QMenu* views = menu->addMenu(QStringLiteral("Look from"));
  const char* const names[kViews] = {
      "Front", "Right", "Top", "Back", "Left", "Bottom", "Orthographic lens on or off", "Scene camera", "Last view"};
  for (int i = 0; i < kViews; ++i) {
    QAction* look = m_actions.add(views, QStringLiteral("view.look%1").arg(i + 1), QString::fromLatin1(names[i]),
                                  {QKeySequence(QStringLiteral("Alt+%1").arg(i + 1))},
                                  viewAct([i](Viewport& v) { v.show(static_cast<StandardView>(i + 1)); }));
    addKeys(*look, KeysIn::Elsewhere, {QKeySequence(QString::number(i + 1))});
  }
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  addColours(colours);
  QObject::connect(&m_session, &Session::ready, colours, [this, colours] { addColours(colours); });
  makeSection(menu->addMenu(QStringLiteral("Section")));
  QMenu *shown = menu->addMenu(QStringLiteral("Show")), *light = menu->addMenu(QStringLiteral("Light"));
  makeShow(shown);
  makeLight(light);
  makeLook(*shown, *light);
  menu->addSeparator();
  makeThemes(menu);
}

/// What stands over the picture.
void ViewActions::makeShow(QMenu* menu) {
  for (const OverlayRow& row : kOverlayRows) {
    QAction* action = m_actions.add(menu, nameOf(row), QString::fromLatin1(row.label), {}, [this, on = row.on] {
      if (!m_view) return;
      OverlayChoice shown = m_view->overlays();
      shown.*on = !(shown.*on);
      m_view->setOverlays(shown);
    });
    action->setProperty(kWords, QString::fromLatin1(row.words));
    action->setCheckable(true);
  }
  QObject::connect(menu, &QMenu::aboutToShow, menu, [this] { followLook(); });
}

/// Whose light falls on the scene, whatever theme the window has.
void ViewActions::makeLight(QMenu* menu) {
  auto* studios = new QActionGroup(&m_actions.window());
  for (const StudioRow& row : kStudioRows) {
    QAction* action = m_actions.add(menu, nameOf(row), QString::fromLatin1(row.label), {}, [this, studio = row.studio] {
      if (m_view) m_view->setStudio(studio);
    });
    action->setProperty(kWords, QStringLiteral("light background backdrop"));
    action->setCheckable(true);
    studios->addAction(action);
  }
  QObject::connect(menu, &QMenu::aboutToShow, menu, [this] { followLook(); });
}

void ViewActions::makeLook(const QMenu& shown, const QMenu& light) {
  m_look = new QMenu(&m_actions.window());
  m_look->addActions(shown.actions());
  m_look->addSeparator();
  m_look->addActions(light.actions());
  QObject::connect(m_look, &QMenu::aboutToShow, m_look, [this] { followLook(); });
}

void ViewActions::followLook() const {
  for (const OverlayRow& row : kOverlayRows)
    m_actions.find(nameOf(row))->setChecked(m_view && m_view->overlays().*row.on);
  for (const StudioRow& row : kStudioRows)
    m_actions.find(nameOf(row))->setChecked(m_view && m_view->studio() == row.studio);
}

/// What only acts on a section is enabled while there is one.
void ViewActions::makeSection(QMenu* menu) {
  const auto add = [&](const char* id, const char* text, const char* keys, auto act) {
    return m_actions.add(menu, QStringLiteral("view.section") + QString::fromLatin1(id), QString::fromLatin1(text),
                         *keys ? QList{QKeySequence(QString::fromLatin1(keys))} : QList<QKeySequence>{}, [this, act] {
                           if (m_view) act(*m_view);
                         });
  };
  QAction* shown = add("", "Section on or off", "X", [](Viewport& v) {
    if (!v.endSection()) v.cutAcross("view");
  });
  shown->setCheckable(true);
  menu->addSeparator();
  add("View", "Section that faces you", "", [](Viewport& v) { v.cutAcross("view"); });
  add("X", "Section across x", "", [](Viewport& v) { v.cutAcross("x"); });
  add("Y", "Section across y", "", [](Viewport& v) { v.cutAcross("y"); });
  add("Z", "Section across z", "", [](Viewport& v) { v.cutAcross("z"); });
  menu->addSeparator();
  const QList<QAction*> moves{add("Flip", "Flip the section", "Shift+X", [](Viewport& v) { v.flipSection(); }),
                              add("Deeper", "Move the section deeper", ".", [](Viewport& v) { v.moveSection(1); }),
                              add("Back", "Move the section back", ",", [](Viewport& v) { v.moveSection(-1); })};
  const auto follow = [this, shown, moves] {
    const bool on = m_view && m_view->viewSection();
    shown->setChecked(on);
    for (QAction* move : moves) move->setEnabled(on);
  };
  if (m_view) QObject::connect(m_view, &Viewport::sectionChanged, menu, follow);
  QObject::connect(shown, &QAction::triggered, menu, follow);  // without a view nothing changes
  follow();
}

void ViewActions::addColours(QMenu* menu) {
  if (menu->isEmpty()) addColour(menu, kMatterColour, "Matter");
  const std::vector<FieldPtr>& fields = m_session.fields().all();
  for (auto i = static_cast<size_t>(menu->actions().size()) - 1; i < fields.size(); ++i)
    addColour(menu, fields[i]->name, fields[i]->label);
}

void ViewActions::addColour(QMenu* menu, const std::string& name, const std::string& label) {
  const qsizetype index = menu->actions().size();
  QList<QKeySequence> keys;
  if (index < kKeys) keys << QKeySequence(QStringLiteral("Ctrl+%1").arg(index + 1));
  m_actions.add(menu, colourAction(index), QString::fromStdString(label), keys,
                [this, name] { m_session.document().setColour(name); });
}

void ViewActions::makeThemes(QMenu* menu) {
  auto* themes = new QActionGroup(&m_actions.window());
  for (const bool dark : {true, false}) {
    QAction* theme = m_actions.add(menu, dark ? QStringLiteral("view.dark") : QStringLiteral("view.light"),
                                   dark ? QStringLiteral("Dark theme") : QStringLiteral("Light theme"), {},
                                   [this, dark] { m_layout.setDark(dark); });
    theme->setCheckable(true);
    themes->addAction(theme);
  }
  QObject::connect(menu, &QMenu::aboutToShow, menu, [this] {
    const auto name = m_layout.isDark() ? QStringLiteral("view.dark") : QStringLiteral("view.light");
    m_actions.find(name)->setChecked(true);
  });
}

void ViewActions::openViewMenu(const QPoint& global) const {
  auto* menu = new QMenu(&m_actions.window());
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(m_actions.find(QStringLiteral("view.frame")));
  menu->addAction(m_actions.find(QStringLiteral("view.frameAll")));
  QMenu* views = menu->addMenu(QStringLiteral("Look from"));
  for (int i = 1; i <= kViews; ++i) views->addAction(m_actions.find(QStringLiteral("view.look%1").arg(i)));
  menu->addAction(m_actions.find(QStringLiteral("view.section")));
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  for (qsizetype i = 0; QAction* colour = m_actions.find(colourAction(i)); ++i) colours->addAction(colour);
  menu->popup(global);
}

}  // namespace ps
