// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"
#include "ui/panels/outliner.h"
#include "ui/session/session.h"
#include "ui/tools/viewtool.h"
#include "ui/window/commandpalette.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>
#include <QtWidgets/QMainWindow>

#include <functional>
#include <memory>
#include <vector>

class QAction;
class QStackedWidget;
class QMenu;

namespace ps {

class BrushPanel;
class Dock;
class EnergyPanel;
class GraphsPanel;
class Inspector;
class MaterialsPanel;
class NoticeBar;
class PluginPage;
class StatusLine;
class TopBar;
class Transport;
class Viewport;
class ViewportPane;
struct EngineEvent;

/// The editor's window. Shows at once; plugins and the project follow. Nothing here steps, reads or writes by itself:
/// the session does, on threads of its own.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  struct Options {
    Session::Options session;
    QString project;                ///< to open first; "": the last session, else the sample
    QString sample;                 ///< path of the first sample; "": an empty scene
    bool restore = true;            ///< last session, window state and theme of the user's settings
    bool exitOnBadProject = false;  ///< for pictures by command: startFailed() instead of a notice
    bool dark = true;               ///< where `restore` finds nothing or is off
    bool themeAsked = false;        ///< `dark` holds for this time, whatever is stored, and is not stored
  };
  explicit MainWindow(const Options& options);
  ~MainWindow() override;

  void start();  ///< after show()
  Session& session() { return *m_session; }
  Viewport* viewport() const;
  Inspector& inspector() { return *m_inspector; }
  Dock* inspectorDock() const { return m_right; }
  Outliner* outliner() const { return m_outliner; }
  GraphsPanel* graphs() const { return m_graphs; }
  PluginPage* pluginPage() const { return m_plugins; }
  StatusLine* statusLine() const { return m_status; }
  Transport* transport() const { return m_transport; }
  CommandPalette* palette() const { return m_palette; }
  NoticeBar* notice() const;
  bool showsPlugins() const;
  bool isDark() const { return m_dark; }
  void setDark(bool dark);
  QAction* action(const QString& name) const;  ///< "file.save", "view.frame": nullptr when there is none
  std::vector<PaletteEntry> paletteEntries();
  void openFile(const QString& path);
  void saveTo(const QString& path);
  /// Jumps to a parameter's row: chooses its owner and tab, scrolls, gives it the focus where asked.
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
  // mainwindowlayout.cpp
  void makeDocks();
  void applyDefaultLayout();
  void sizeDocks();  ///< as the layout table has it for this width
  void restoreWindow();
  void saveWindow() const;
  void setFullViewport(bool on);
  // mainwindowactions.cpp
  using Act = std::function<void()>;
  QAction* add(QMenu* menu, const QString& name, const QString& text, const QList<QKeySequence>& keys, Act act);
  void makeActions();
  void makeFileMenu();
  void makeEditMenu();
  void makeViewMenu();
  void makeSimulationMenu();
  void makeSketchMenu();
  void makeHelpMenu();
  void fillRecent();
  void checkTheme();              ///< the mark at the one in force
  void updateRestore();           ///< enabled while unsaved work waits
  void setFilesEnabled(bool on);  ///< what needs plugins, in the menu File
  void openPalette();
  void setWorkspace(int index);
  void setTool(ViewTool tool);
  void setColour(int index);
  void stepBrush(int direction);
  void duplicateSelected();  ///< body, tap or drain
  void deleteSelected();
  void addWalls(const std::vector<std::string>& sides);  ///< of kWallSides
  // mainwindowfiles.cpp
  void chooseOpen();
  void save();
  void chooseSave();
  void exportCsv();
  void exportPicture();
  void writeFile(const QString& path, std::function<QByteArray()> content, const QString& what);
  void onOpened(const QString& path, const QStringList& warnings, double seconds);
  void onOpenFailed(const QString& path, const QString& problem);
  void onSaved(const QString& path, bool present);
  void onSaveFailed(const QString& path, const QString& problem, bool present);
  void showNotSaved(const QString& problem, const QString& more);
  bool isSample(const QString& path) const;
  void updateTitle();
  // mainwindowrestore.cpp
  void openFirst();
  std::vector<AutosavedSession> unsavedWork() const;
  void offerAtStart();
  void offerRestore();
  void offerNext();  ///< of m_offered
  void connectAutosave();
  void showReplaced(const QString& text);
  // mainwindow.cpp
  void connectSession();
  void connectPanels();
  void onReady();
  void onChanged(const ChangeEvent& event);
  void onProjectOpened();
  void onSnapshot();
  void appendHistory();
  void refreshSlow();  ///< values at most 15 times a second
  void refreshStatus();
  void showFailure(const EngineEvent& event);
  void showBroken(const QString& problem);  ///< the scene could not be built
  void updateTransitions();
  void useCurrentMaterial();  ///< as the brush's
  void selectBody(const std::string& id);
  void selectPort(const Port& port);
  void onOutlinerSelection(OutlineKind kind, const std::string& id);
  void refuse(const QString& title, const QString& why);  ///< a notice; with "" for `why` the last one goes
  void showMessage(MessageLevel level, const QString& where, const QString& text);

  Options m_options;
  std::unique_ptr<Session> m_session;
  bool m_dark = true, m_fullViewport = false, m_opening = false, m_first = true, m_sizeAtShow = true;
  QString m_graphicsText, m_fileText;
  std::optional<Address> m_noteAddress;
  TopBar* m_top = nullptr;
  QStackedWidget* m_centre = nullptr;
  ViewportPane* m_pane = nullptr;
  PluginPage* m_plugins = nullptr;
  Dock *m_left = nullptr, *m_materialsDock = nullptr, *m_bottom = nullptr, *m_transportDock = nullptr,
       *m_right = nullptr;
  Outliner* m_outliner = nullptr;
  MaterialsPanel* m_materials = nullptr;
  Inspector* m_inspector = nullptr;
  BrushPanel* m_brush = nullptr;
  GraphsPanel* m_graphs = nullptr;
  EnergyPanel* m_energy = nullptr;
  Transport* m_transport = nullptr;
  StatusLine* m_status = nullptr;
  CommandPalette* m_palette = nullptr;
  QMenu* m_recent = nullptr;
  int m_messagesPage = -1;
  QTimer m_slow;
  QElapsedTimer m_sinceSlow;
  size_t m_historyRead = 0;
  uint64_t m_revision = 0, m_before = 0;  ///< of the snapshot seen last; of the one when a project was opened
  uint64_t m_warnedAt = 0;                ///< change count of work that a first attempt to close could not keep
  std::shared_ptr<const ReplacedWork> m_replaced;
  QStringList m_offered;  ///< stems of unsaved work that is still to be decided about
  uint64_t m_eventsRead = 0;
  QByteArray m_beforeFull;
};

}  // namespace ps
