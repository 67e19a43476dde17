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

/// Brushes that somebody keeps for all projects, and those that come with the program: a menu to take one in hand, keep
/// the present one, and forget one; a form to name them, and to give them to others.
class FavouriteBrushes : public QObject {
 public:
  FavouriteBrushes(Session& session, Selection& selection, Toolbox& tools, const Actions& actions, Notices& notices,
                   QObject* parent);
  void addTo(QMenu* menu);
  QMenu* menu() const { return m_menu; }

  /// As they are kept now, by whichever window.
  std::vector<FavouriteBrush> all() const;
  bool keep();  ///< false: it is kept already
  void take(const FavouriteBrush& favourite);
  void forget(const FavouriteBrush& favourite);
  void restore(const FavouriteBrush& favourite);  ///< one that was forgotten
  /// "" or why it has no such name.
  QString rename(const FavouriteBrush& favourite, const QString& name);
  /// Into a file, or out of one, beside those that are kept; "" or why not. One of both that is the same stays as it
  /// is, and one of another's name gets a number.
  static QString exportTo(const std::vector<FavouriteBrush>& favourites, const QString& path);
  QString importFrom(const QString& path);
  void openForm();

  std::vector<ReadyBrush> ready() const;
  void take(const ReadyBrush& ready);

 private:
  void takeInHand(const BrushSettings& brush);
  void fill();
  void addReady();

  Session& m_session;
  Selection& m_selection;
  Toolbox& m_tools;
  const Actions& m_actions;
  Notices& m_notices;
  QMenu *m_menu = nullptr, *m_forget = nullptr, *m_ready = nullptr;
};

}  // namespace ps
