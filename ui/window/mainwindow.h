// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/session.h"
#include "ui/window/actions.h"
#include "ui/window/commandpalette.h"
#include "ui/window/windowlayout.h"

#include <QtWidgets/QMainWindow>

#include <array>
#include <memory>
#include <vector>

class QStackedWidget;

namespace ps {

class BodyActions;
class CurveTarget;
class EditActions;
class FavouriteBrushes;
class FileActions;
class GraphsPanel;
class Help;
class Inspector;
class LibraryActions;
class NoticeBar;
class Notices;
class Outliner;
class PageChooser;
class PluginPage;
class RestoreOffer;
class Resuming;
class Selection;
class SketchActions;
class StatusLine;
class ThingActions;
class Toolbox;
class TopBar;
class Tour;
class Transport;
class ViewActions;
class WaysOut;
class Viewport;
class ViewportPane;
class VrMode;
class Welcome;

/// The editor's window. Shows at once; plugins and the project follow. It makes its parts and hands them to each other:
/// panels, views and menus follow session, document, selection and toolbox by themselves.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  struct Options {
    Session::Options session;
    QString project;                ///< to open first; "": the last session, else the sample
    QString sample;                 ///< path of the first sample; "": an empty scene
    QString presets;                ///< folder of the user's materials; "": the usual one
    QString samples;                ///< folder of all samples, with their pictures and templates; "": none
    bool restore = true;            ///< last session, window state and theme of the user's settings
    bool exitOnBadProject = false;  ///< for pictures by command: startFailed() instead of a notice
    bool dark = true;               ///< where `restore` finds nothing or is off
    bool themeAsked = false;        ///< `dark` holds for this time, whatever is stored, and is not stored
  };
  explicit MainWindow(const Options& options);
  ~MainWindow() override;

  void start();  ///< after show()
  Session& session() { return *m_session; }
  Selection& selection() { return *m_selection; }
  Toolbox& tools() { return *m_tools; }
  Viewport* viewport() const;
  Inspector& inspector() { return *m_inspector; }
  WindowLayout& layoutOfDocks() { return *m_layout; }
  Dock* inspectorDock() const { return m_layout->dock(QStringLiteral("dock.inspector")); }
  Outliner* outliner() const;
  GraphsPanel* graphs() const;
  PluginPage* pluginPage() const { return m_plugins; }
  StatusLine* statusLine() const { return m_status; }
  Transport* transport() const;
  CurveTarget& curves() { return *m_curves; }
  /// Tabs of the top bar, in their order.
  enum WorkspaceTab { kSceneTab, kTuneTab, kSketchTab, kFilmTab };
  static constexpr std::array kWorkspaces{"Scene", "Tune", "Sketch", "Film"};  ///< what the tabs are called
  void showWorkspace(WorkspaceTab tab);
  WorkspaceTab workspaceTab() const;
  void openPage(const QString& title);  ///< as somebody asks for it, in Scene where this workspace has no place for it
  CommandPalette* palette() const { return m_palette; }
  NoticeBar* notice() const;
  bool showsPlugins() const;
  Welcome& welcome() const { return *m_welcome; }
  LibraryActions& library() const { return *m_library; }
  FavouriteBrushes& favourites() const { return *m_favourites; }
  Help& help() const { return *m_help; }
  Tour& tour() const { return *m_tour; }
  WaysOut& waysOut() const { return *m_waysOut; }
  VrMode& vr() const { return *m_vr; }
  void startTour();  ///< of five steps over the scene
  bool isDark() const { return m_layout->isDark(); }
  void setDark(bool dark) { m_layout->setDark(dark); }
  QAction* action(const QString& name) const { return m_actions.find(name); }
  std::vector<PaletteEntry> paletteEntries();
  void openFile(const QString& path);
  void saveTo(const QString& path);
  /// See PageChooser::reveal().
  bool revealParameter(const Address& address, bool focus = true);

 Q_SIGNALS:
  void projectShown();  ///< the first snapshot of an opened project is on screen
  void startFailed(const QString& problem);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void makeTopBar();
  void onTool();
  void makeMiddle();
  void makeMenus();
  void connectGraphs();
  void makeHelpMenu(QMenu* menu);
  void makeSimulationMenu(QMenu* menu);
  void connectParts();
  void connectFiles();
  void connectTools();
  void connectPanels();
  void connectMessages();
  void connectView(Viewport& view);
  bool cancelLongWork();  ///< false where there is none
  void onReady();
  void showPluginProblems();
  void updateTitle();

  const Options m_options;
  std::unique_ptr<Session> m_session;
  std::unique_ptr<Selection> m_selection;
  std::unique_ptr<Resuming> m_resuming;
  std::unique_ptr<Toolbox> m_tools;
  Actions m_actions{*this};
  TopBar* m_top = nullptr;
  QStackedWidget* m_centre = nullptr;
  ViewportPane* m_pane = nullptr;
  PluginPage* m_plugins = nullptr;
  StatusLine* m_status = nullptr;
  Inspector* m_inspector = nullptr;
  CurveTarget* m_curves = nullptr;
  WindowLayout* m_layout = nullptr;
  CommandPalette* m_palette = nullptr;
  Notices* m_notices = nullptr;
  RestoreOffer* m_restore = nullptr;
  FileActions* m_files = nullptr;
  PageChooser* m_pages = nullptr;
  Welcome* m_welcome = nullptr;
  LibraryActions* m_library = nullptr;
  FavouriteBrushes* m_favourites = nullptr;
  Help* m_help = nullptr;
  Tour* m_tour = nullptr;
  WaysOut* m_waysOut = nullptr;
  std::unique_ptr<EditActions> m_edit;
  std::unique_ptr<ThingActions> m_things;
  BodyActions* m_bodies = nullptr;
  std::unique_ptr<ViewActions> m_views;
  std::unique_ptr<SketchActions> m_sketch;
  std::unique_ptr<VrMode> m_vr;
  uint64_t m_warnedAt = 0;  ///< change count of work that a first attempt to close could not keep
};

}  // namespace ps
