// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/favouritebrush.h"

#include <QtCore/QObject>

#include <vector>

class QMenu;

namespace ps {

class Actions;
class Notices;
class Selection;
class Session;
class Toolbox;

/// Brushes that somebody keeps for all projects: a menu to take one in hand, keep the present one, and forget one.
class FavouriteBrushes : public QObject {
 public:
  FavouriteBrushes(Session& session, Selection& selection, Toolbox& tools, const Actions& actions, Notices& notices,
                   QObject* parent);
  void addTo(QMenu* menu);
  QMenu* menu() const { return m_menu; }

  /// As they are kept now, by whichever window.
  std::vector<FavouriteBrush> all() const;
  void keep();
  void take(const FavouriteBrush& favourite);
  void forget(const FavouriteBrush& favourite);

 private:
  void fill();

  Session& m_session;
  Selection& m_selection;
  Toolbox& m_tools;
  const Actions& m_actions;
  Notices& m_notices;
  QMenu *m_menu = nullptr, *m_forget = nullptr;
};

}  // namespace ps
