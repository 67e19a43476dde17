// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QByteArray>
#include <QtCore/QObject>
#include <QtCore/QSize>
#include <QtCore/QString>

#include <map>
#include <vector>

class QMainWindow;
class QSettings;

namespace ps {

class Dock;
class ParameterPanel;
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
  const std::vector<Dock*>& docks() const { return m_docks; }
  Dock* dockOf(const QString& page) const;  ///< by its title; nullptr: there is none
  void showPage(const QString& title);      ///< of whichever dock has it, in sight where the workspace shows that dock
  void openPage(const QString& title);      ///< the same, where the workspace offers that dock
  void turnTo(const QString& title);        ///< the same, in sight where the dock is
  bool offersPage(const QString& title) const;
  /// Of docks(), by its number: whether this workspace shows it now. Materials that are a page of the outliner's dock
  /// are shown where that page is.
  bool isShown(size_t dock) const;
  void setDockShown(size_t dock, bool on);  ///< as somebody wants it: see setOwn()
  Workspace workspace() const { return m_workspace; }
  /// Shows its docks as they were left, or as they are by default.
  void setWorkspace(Workspace workspace);
  void setPageTitle(const QString& title, const QString& shown);
  void applyDefault();
  /// Workspace, docks, theme and what stands over the view, as save() kept them.
  void restore();
  /// Pages of docks and folded groups of rows, likewise; what is selected or taken in hand turns to others.
  void restorePages();
  void save() const;
  bool fullViewport() const { return m_full; }
  void setFullViewport(bool on);
  /// Outliner and materials as pages of one dock, as narrow windows have them by default, or one above the other.
  void joinMaterials(bool joined);
  bool materialsJoined() const { return m_joined; }
  void setOwn();  ///< somebody arranged this workspace: no size of the window moves its docks any more
  bool isDark() const { return m_options.dark; }
  void setDark(bool dark);
  void onResized(int widthBefore);  ///< of the window; below 0: it had none
  void onShown();

 Q_SIGNALS:
  void themeChanged();
  void workspaceChanged();

 private:
  bool shows(size_t dock) const;   ///< in this workspace
  bool offers(size_t dock) const;  ///< the same
  size_t indexOf(const Dock* dock) const;
  QByteArray stateNow() const;
  void restoreOrLay(const QByteArray& state);
  std::map<QString, ParameterPanel*> rowPanels() const;  ///< by the titles of their pages
  void restoreWindow(const QSettings& settings);
  void fitToWorkspace();  ///< what is in docks that several workspaces have
  void putAway();
  void showDocks();  ///< of this workspace
  void lay();        ///< this workspace, as it is by default
  void layScene();
  void layTune();
  void layFilm();
  void laySketch();
  void sizeDocks();  ///< as the layout table has it for this width
  void fitColumn();  ///< the same, where nobody arranged them
  bool isOwn() const;
  void setJoined(bool joined);
  bool restoreDocks(const QByteArray& state);
  bool takeWaiting();  ///< soon, where the window is as large as for what waits
  bool eventFilter(QObject* watched, QEvent* event) override;
  QMainWindow& m_window;
  Options m_options;
  Viewport* m_view = nullptr;
  std::vector<Dock*> m_docks;
  bool m_full = false, m_sizeAtShow = true;
  QByteArray m_beforeFull;
  Workspace m_workspace{};
  std::map<Workspace, QByteArray> m_left;  ///< states of those that were shown before
  std::map<Workspace, int> m_leftWidth;    ///< px, of the window then
  int m_own = 0;                           ///< a bit for each workspace that somebody arranged
  bool m_joined = false;                   ///< materials are a page of the outliner's dock
  QByteArray m_waiting;                    ///< a state, until the window is as large as
  QSize m_waitingSize;
  std::vector<QSize> m_pressed;  ///< of the docks, when a button went down on the window itself
};

}  // namespace ps
