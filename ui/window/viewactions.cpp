// SPDX-License-Identifier: Apache-2.0
#include "ui/window/viewactions.h"

#include "ui/document/document.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/windowlayout.h"

#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

constexpr int kViews = 9, kColours = 5;

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
    m_actions.add(views, QStringLiteral("view.look%1").arg(i + 1), QString::fromLatin1(names[i]),
                  {QKeySequence(QString::number(i + 1)), QKeySequence(QStringLiteral("Alt+%1").arg(i + 1))},
                  viewAct([i](Viewport& v) { v.show(static_cast<StandardView>(i + 1)); }));
  }
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  const char* const colourNames[kColours] = {"Matter", "Temperature", "Phase", "Speed", "Density error"};
  for (int i = 0; i < kColours; ++i) {
    m_actions.add(colours, QStringLiteral("view.colour%1").arg(i + 1), QString::fromLatin1(colourNames[i]),
                  {QKeySequence(QStringLiteral("Ctrl+%1").arg(i + 1))},
                  [this, i] { m_document.setColour(colourName(static_cast<ColourBy>(i))); });
  }
  menu->addSeparator();
  makeThemes(menu);
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("view.full"), QStringLiteral("Full viewport"),
                {QKeySequence(QStringLiteral("F11"))}, [this] { m_layout.setFullViewport(!m_layout.fullViewport()); });
  m_actions.add(menu, QStringLiteral("view.layout"), QStringLiteral("Default layout"), {},
                [this] { m_layout.applyDefault(); });
  m_actions.add(menu, QStringLiteral("view.hint"), QStringLiteral("Show hints"), {},
                viewAct([](Viewport& v) { v.setHintShown(!v.hintShown()); }));
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
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  for (int i = 1; i <= kColours; ++i) colours->addAction(m_actions.find(QStringLiteral("view.colour%1").arg(i)));
  menu->popup(global);
}

}  // namespace ps
