// SPDX-License-Identifier: Apache-2.0
#include "ui/window/favouritebrushes.h"

#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/plaintext.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/actions.h"
#include "ui/window/notices.h"

#include <QtGui/QAction>
#include <QtWidgets/QMenu>

#include <algorithm>

namespace ps {
namespace {
const QString kWhere = QStringLiteral("Favourite brushes");
}

FavouriteBrushes::FavouriteBrushes(Session& session, Selection& selection, Toolbox& tools, const Actions& actions,
                                   Notices& notices, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_selection(selection),
      m_tools(tools),
      m_actions(actions),
      m_notices(notices) {}

void FavouriteBrushes::addTo(QMenu* menu) {
  QAction* keeps = m_actions.add(menu, QStringLiteral("sketch.keepBrush"), QStringLiteral("Keep this brush"), {},
                                 [this] { keep(); });
  keeps->setToolTip(QStringLiteral("Its shape, size, matter and guides, for all projects"));
  m_menu = menu->addMenu(kWhere);
  m_menu->setToolTipsVisible(true);
  m_forget = new QMenu(QStringLiteral("Forget"), m_menu);
  connect(m_menu, &QMenu::aboutToShow, this, &FavouriteBrushes::fill);
}

std::vector<FavouriteBrush> FavouriteBrushes::all() const {
  const PluginRegistry* plugins = m_session.plugins();
  return plugins ? favouritesOf(preferences::favouriteBrushes(), *plugins) : std::vector<FavouriteBrush>{};
}

void FavouriteBrushes::keep() {
  const PluginRegistry* plugins = m_session.plugins();
  if (!plugins) return;
  FavouriteBrush favourite = favouriteOf(m_tools.brush(), *plugins, m_session.document().project());
  std::vector<FavouriteBrush> kept = all();
  const auto same = [&](const FavouriteBrush& one) { return one.brush == favourite.brush; };
  if (std::any_of(kept.begin(), kept.end(), same)) {
    m_notices.message(MessageLevel::Info, kWhere, QStringLiteral("“%1” is kept already.").arg(favourite.name));
    return;
  }
  // Two that differ in other values than those that name them.
  const QString name = favourite.name;
  const auto taken = [&](const FavouriteBrush& one) { return one.name == favourite.name; };
  for (int n = 2; std::any_of(kept.begin(), kept.end(), taken); ++n)
    favourite.name = QStringLiteral("%1 (%2)").arg(name).arg(n);
  kept.push_back(favourite);
  preferences::setFavouriteBrushes(textOf(kept));
  m_notices.message(MessageLevel::Info, kWhere, QStringLiteral("“%1” is kept.").arg(favourite.name));
}

void FavouriteBrushes::take(const FavouriteBrush& favourite) {
  if (!m_session.plugins() || !m_session.plugins()->brush(favourite.brush.shape)) {
    m_notices.refuse(QStringLiteral("“%1” is not taken.").arg(favourite.name),
                     QStringLiteral("Its brush is not installed. See Plugins."));
    return;
  }
  if (!m_tools.tool().usesBrush()) m_tools.activate(kBrushTool);
  m_tools.takeBrush(favourite.brush.shape);
  m_tools.setBrush(taken(favourite, m_tools.brush(), m_session.document().project()));
  m_selection.setMaterial(m_tools.brush().material);
}

void FavouriteBrushes::forget(const FavouriteBrush& favourite) {
  std::vector<FavouriteBrush> kept = all();
  std::erase(kept, favourite);
  preferences::setFavouriteBrushes(textOf(kept));
}

void FavouriteBrushes::fill() {
  m_menu->clear();
  m_forget->clear();
  const std::vector<FavouriteBrush> kept = all();
  for (const FavouriteBrush& favourite : kept) {
    const QString shape = QString::fromStdString(favourite.brush.shape);
    m_menu->addAction(icon(iconNames().contains(shape) ? shape : QStringLiteral("brush")), asButtonText(favourite.name),
                      this, [this, favourite] { take(favourite); });
  }
  if (kept.empty()) m_menu->addAction(QStringLiteral("None is kept yet"))->setEnabled(false);
  m_menu->addSeparator();
  m_menu->addAction(m_actions.find(QStringLiteral("sketch.keepBrush")));
  if (kept.empty()) return;
  m_menu->addMenu(m_forget);
  for (const FavouriteBrush& favourite : kept)
    m_forget->addAction(asButtonText(favourite.name), this, [this, favourite] { forget(favourite); });
}

}  // namespace ps
