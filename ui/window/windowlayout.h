// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QByteArray>
#include <QtCore/QObject>
#include <QtCore/QString>

#include <map>
#include <vector>

class QMainWindow;

namespace ps {

class Dock;
class Viewport;
struct PanelContext;
enum class Workspace;

/// Docks of the window with their pages, their sizes, the theme, and what of them is remembered between sessions.
class WindowLayout : public QObject {
  Q_OBJECT
 public:
  struct Options {
    bool remember = true;     ///< window state and theme in the user's settings
    bool dark = true;         ///< where nothing is remembered
    bool themeAsked = false;  ///< `dark` holds for this time, whatever is stored, and is not stored
  };
  WindowLayout(QMainWindow& window, const Options& options);
  /// Makes the docks and panels of the tables.
  void makeDocks(const PanelContext& context);
  Dock* dock(const QString& name) const;  ///< DockRow::name; nullptr for another
  void showPage(const QString& title);    ///< of whichever dock has it, in sight where the workspace shows that dock
  Workspace workspace() const { return m_workspace; }
  /// Shows its docks as they were left, or as they are by default.
  void setWorkspace(Workspace workspace);
  void setPageTitle(const QString& title, const QString& shown);
  void applyDefault();
  void restore();
  void save() const;
  bool fullViewport() const { return m_full; }
  void setFullViewport(bool on);
  bool isDark() const { return m_options.dark; }
  void setDark(bool dark);
  void onResized(int widthBefore);  ///< of the window; below 0: it had none
  void onShown();

 Q_SIGNALS:
  void themeChanged();

 private:
  bool shows(size_t dock) const;  ///< in this workspace
  void putAway();
  void showDocks();  ///< of this workspace
  void lay();        ///< this workspace, as it is by default
  void layScene();
  void layTune();
  void layFilm();
  void sizeDocks();  ///< as the layout table has it for this width
  QMainWindow& m_window;
  Options m_options;
  Viewport* m_view = nullptr;
  std::vector<Dock*> m_docks;
  bool m_full = false, m_sizeAtShow = true;
  QByteArray m_beforeFull;
  Workspace m_workspace{};
  std::map<Workspace, QByteArray> m_left;  ///< states of those that were shown before
};

}  // namespace ps
