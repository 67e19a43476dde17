// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QList>
#include <QtCore/QString>
#include <QtGui/QKeySequence>

#include <functional>

class QAction;
class QMainWindow;
class QMenu;

namespace ps {

/// Property of actions: see PaletteEntry::replaces.
inline constexpr const char* kReplaces = "replacesScene";

/// Property of an action that is disabled: a sentence that says why.
inline constexpr const char* kWhyNot = "whyNot";
/// Ctrl+K finds an action by these words too: a property of it.
inline constexpr const char* kWords = "words";

/// The actions of a window, each declared once by a name like "file.save": menus, keys and the palette have them.
class Actions {
 public:
  explicit Actions(QMainWindow& window) : m_window(window) {}
  using Act = std::function<void()>;
  /// `text` is shown as it stands: an "&" in it is one.
  QAction* add(QMenu* menu, const QString& name, const QString& text, const QList<QKeySequence>& keys, Act act) const;
  /// An action that was made elsewhere.
  QAction* adopt(QAction* action, const QString& name, const QList<QKeySequence>& keys) const;
  QAction* find(const QString& name) const;  ///< nullptr when there is none
  QList<QAction*> all() const;               ///< in the order in which they were added
  QMainWindow& window() const { return m_window; }

 private:
  QMainWindow& m_window;
};

/// What an action is called, as it was given to Actions::add().
QString cleanText(const QAction& action);

}  // namespace ps
