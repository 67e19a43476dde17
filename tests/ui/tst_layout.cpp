// SPDX-License-Identifier: Apache-2.0
// Where docks stand: as the layout table has it for the window's width, or as somebody arranged them, also after a
// restart in which the window gets its size late.
#include "core/io/projectio.h"
#include "samplewindow.h"
#include "tests/shared/scenes.h"
#include "tests/ui/paintedtexts.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/session/preferences.h"
#include "ui/tools/tooltable.h"
#include "ui/window/dock.h"
#include "ui/window/topbar.h"

#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QStyle>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>

#include <algorithm>

using namespace ps;

class TestLayout : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    QSettings().clear();
    preferences::setWelcomeAtStart(false);
    preferences::setTourDone();
    m_directory = std::make_unique<QTemporaryDir>();
    m_path = m_directory->filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(4, 370), m_path.toStdString());
  }
  void cleanup() { m_window.reset(); }
  void cleanupTestCase() { QSettings().clear(); }

  void aSmallWindowHasOneDockOfBoth() {
    open({1280, 800});
    QVERIFY(!dock("dock.materials")->isVisible());
    auto* tabs = dock("dock.outliner")->findChild<QTabBar*>();
    QCOMPARE(tabs->count(), 2);
    QVERIFY(m_window->findChild<Outliner*>()->isVisible());
    tabs->setCurrentIndex(1);
    QVERIFY(materials()->isVisible());
    QVERIFY(!m_window->findChild<Outliner*>()->isVisible());
  }

  void aLargeOneHasOneAboveTheOther() {
    open({1600, 1000});
    QVERIFY(m_window->findChild<Outliner*>()->isVisible() && materials()->isVisible());
    QVERIFY(dock("dock.materials")->y() > dock("dock.outliner")->geometry().bottom());
  }

  /// To 2 px. Graphs and timeline together: the timeline is as high as it has rows, and what it leaves the graphs take,
  /// or the view. At 1280 the inspector is 20 wider than drawn, or its longest labels would be cut.
  void theTableHolds_data() {
    QTest::addColumn<QSize>("size");
    QTest::addColumn<int>("left");
    QTest::addColumn<int>("right");
    QTest::addColumn<int>("materials");
    QTest::addColumn<int>("graphs");
    QTest::addColumn<int>("bottom");
    QTest::addColumn<QSize>("view");
    QTest::newRow("1280") << QSize(1280, 800) << 204 << 332 + 20 << 0 << 152 << 152 + 96 << QSize(738 - 20, 449);
    QTest::newRow("1600") << QSize(1600, 1000) << 236 << 392 << 252 << 178 << 178 + 124 << QSize(966, 594);
    QTest::newRow("2560") << QSize(2560, 1440) << 300 << 460 << 252 << 260 << 260 + 160 << QSize(1794, 917);
  }
  void theTableHolds() {
    QFETCH(QSize, size);
    QFETCH(int, left);
    QFETCH(int, right);
    QFETCH(int, materials);
    QFETCH(int, graphs);
    QFETCH(int, bottom);
    QFETCH(QSize, view);
    open(size);
    const auto is = [](int value, int wanted) {
      if (std::abs(value - wanted) > 2) qWarning("%d, not %d", value, wanted);
      return std::abs(value - wanted) <= 2;
    };
    QVERIFY(is(dock("dock.outliner")->width(), left));
    QVERIFY(is(dock("dock.inspector")->width(), right));
    QVERIFY(materials == 0 || is(dock("dock.materials")->height(), materials));
    const int low = dock("dock.graphs")->height(), time = dock("dock.transport")->height();
    QVERIFY(low >= graphs && low + time <= bottom + 2);
    const QSize shown = m_window->viewport()->size();
    QVERIFY(is(shown.width(), view.width()) && shown.height() >= view.height() - 2);
    // Panels end in a quarter of a circle of 5 px, and 3 of the window's ground lie between them.
    const QImage picture = m_window->grab().toImage();
    const QColor ground = Theme::current()[Token::Window], panel = Theme::current()[Token::Panel];
    for (const Dock* each : m_window->layoutOfDocks().docks()) {
      if (!each->isVisible()) continue;
      const QRect at = each->geometry();
      for (const QPoint& corner : {at.topLeft(), at.topRight(), at.bottomLeft(), at.bottomRight()})
        QCOMPARE(picture.pixelColor(corner), ground);
      QCOMPARE(picture.pixelColor(at.left() + 6, at.top() + 1), panel);
      QCOMPARE(picture.pixelColor(at.center().x(), at.top() - 2), ground);
    }
    for (const Dock* each : m_window->layoutOfDocks().docks())
      QVERIFY(!each->isVisible() || each->titleBarWidget()->height() == 28 ||
              !each->findChild<QTabBar*>()->isVisible());
    for (const auto tab : {MainWindow::kFilmTab, MainWindow::kSketchTab, MainWindow::kTuneTab})
      m_window->showWorkspace(tab);
    QVERIFY(is(dock("dock.responses")->width(), left));
    QVERIFY(is(m_window->viewport()->width(), 480));  // the least that any view has
  }

  /// In words where there is room for them beside all menus.
  void theTopBarSaysWhatVrIs() {
    open({1600, 1000});
    auto* bar = m_window->findChild<TopBar*>();
    const auto textWidth = [bar] { return bar->headset()->fontMetrics().horizontalAdvance(bar->headset()->text()); };
    for (const int width : {1600, 1280}) {
      resize({width, 800});
      QTRY_COMPARE(bar->headset()->toolButtonStyle(), Qt::ToolButtonTextBesideIcon);
      QCOMPARE(bar->headset()->text(), QStringLiteral("Enter VR"));
      QTRY_VERIFY(bar->headset()->width() >= textWidth() + 16);
      const QMenuBar* menus = bar->menus();
      QVERIFY(menus->rect().contains(menus->actionGeometry(menus->actions().last())));
      QVERIFY(bar->headset()->geometry().right() < bar->width());
    }
    resize({966, 600});
    QTRY_COMPARE(bar->headset()->toolButtonStyle(), Qt::ToolButtonIconOnly);
    QTRY_VERIFY(bar->headset()->width() < textWidth());
  }

  /// No frames, arrows and panes of Qt's own, one style sheet, no letters but our own.
  void nothingLooksLikeDefaultQt() {
    open({1280, 800});
    const QStringList families{QStringLiteral("PhaseSketch UI"), QStringLiteral("PhaseSketch Symbols")};
    int seen = 0;
    for (const QWidget* widget : m_window->findChildren<QWidget*>()) {
      const char* name = widget->metaObject()->className();
      for (const char* foreign : {"QGroupBox", "QAbstractSpinBox", "QToolBox", "QTabWidget", "QMdiArea"})
        QVERIFY2(!widget->inherits(foreign), name);
      QVERIFY2(widget->styleSheet().isEmpty(), name);
      QVERIFY2(families.contains(widget->font().family()), qPrintable(widget->font().family()));
      ++seen;
    }
    QVERIFY(seen > 200);
    // Nor a floppy disk and a red cross on the buttons of dialogs.
    QCOMPARE(qApp->style()->styleHint(QStyle::SH_DialogButtonBox_ButtonsHaveIcons), 0);
  }

  /// Inspector, view and outliner are 300, 480 and 180 wide at the least, with 3 between them.
  void theWindowCanBeSmall() {
    open({1280, 800});
    const QSize least = m_window->minimumSizeHint();
    QVERIFY2(least.width() <= 300 + 480 + 180 + 2 * 3 && least.height() <= 600,
             qPrintable(QStringLiteral("%1 × %2").arg(least.width()).arg(least.height())));
    resize({966, 600});
    QTRY_VERIFY_WITH_TIMEOUT(m_window->viewport()->width() >= 480 && m_window->viewport()->height() >= 300, kLong);
    for (const Dock* each : m_window->layoutOfDocks().docks())
      QVERIFY2(!each->isVisible() || m_window->rect().contains(each->geometry()), qPrintable(each->objectName()));
  }

  void aLayoutOfNobodyFollowsTheWindow() {
    open({1600, 1000});
    resize({1280, 800});
    QVERIFY(!dock("dock.materials")->isVisible());
    resize({1600, 1000});
    QTRY_VERIFY(dock("dock.materials")->isVisible() && materials()->isVisible());
    QTRY_COMPARE(dock("dock.outliner")->width(), 236);
  }

  /// A workspace that one comes back to in a narrower window is laid for that.
  void aNarrowerWindowCutsNoTab() {
    open({1600, 1000});
    m_window->showWorkspace(MainWindow::kTuneTab);
    m_window->showWorkspace(MainWindow::kSceneTab);
    resize({1280, 800});
    m_window->showWorkspace(MainWindow::kTuneTab);
    QTest::qWait(50);
    int known = 0;
    for (const QTabBar* bar : m_window->findChildren<QTabBar*>()) {
      if (!bar->isVisible() || bar->visibleRegion().isEmpty()) continue;
      ++known;
      const QRect last = bar->tabRect(bar->count() - 1);
      QVERIFY2(bar->visibleRegion().boundingRect().contains(last), qPrintable(bar->tabText(bar->count() - 1)));
      for (const QToolButton* arrow : bar->findChildren<QToolButton*>()) QVERIFY(!arrow->isVisible());
    }
    QVERIFY(known >= 2);
  }

  void whatSomebodyArrangedStays() {
    open({1600, 1000});
    dragBetweenLeftDocks(-60);
    resize({1280, 800});
    QVERIFY(dock("dock.materials")->isVisible() && materials()->isVisible());
    m_window->action(QStringLiteral("window.layout"))->trigger();
    QVERIFY(!dock("dock.materials")->isVisible());
  }

  /// As a window does that was closed maximised: its first size is the one that it had before.
  void aWindowThatGetsItsSizeLateHasItsDocksAsLeft_data() {
    QTest::addColumn<bool>("arranged");
    QTest::newRow("by somebody") << true;
    QTest::newRow("by nobody") << false;
  }
  void aWindowThatGetsItsSizeLateHasItsDocksAsLeft() {
    QFETCH(bool, arranged);
    open({1600, 1000});
    if (arranged) dragBetweenLeftDocks(-90);
    const int left = dock("dock.materials")->height();
    for (int restart = 0; restart < 3; ++restart) {
      QVERIFY(m_window->close());
      m_window.reset();
      open({900, 480}, true);
      resize({1600, 1000});
      QTRY_COMPARE(dock("dock.materials")->height(), left);
    }
  }

  /// The menu Window hides and shows docks, and says which are in sight; what is hidden is so after a restart.
  void docksAreHiddenAndShown() {
    open({1600, 1000});
    QAction* graphs = m_window->action(QStringLiteral("window.dock.graphs"));
    const QStringList checked{QStringLiteral("window.dock.outliner"),  QStringLiteral("window.dock.materials"),
                              QStringLiteral("window.dock.inspector"), QStringLiteral("window.dock.graphs"),
                              QStringLiteral("window.dock.transport"), QStringLiteral("window.workspaceScene")};
    QCOMPARE(checkedInWindowMenu(), (QStringList{checked.last()} + checked.mid(0, 5)));
    graphs->trigger();
    QVERIFY(!dock("dock.graphs")->isVisible());
    QVERIFY(!graphs->isChecked());
    m_window->showWorkspace(MainWindow::kFilmTab);
    m_window->showWorkspace(MainWindow::kSceneTab);
    QVERIFY(!dock("dock.graphs")->isVisible());
    m_window->action(QStringLiteral("window.full"))->trigger();
    QVERIFY(checkedInWindowMenu().contains(QStringLiteral("window.full")));
    QVERIFY(!dock("dock.outliner")->isVisible());
    m_window->action(QStringLiteral("window.full"))->trigger();
    QVERIFY(dock("dock.outliner")->isVisible() && !dock("dock.graphs")->isVisible());
    QVERIFY(m_window->close());
    m_window.reset();
    open({1600, 1000}, true);
    QVERIFY(!dock("dock.graphs")->isVisible());
    QVERIFY(!checkedInWindowMenu().contains(QStringLiteral("window.dock.graphs")));
    m_window->action(QStringLiteral("window.dock.graphs"))->trigger();
    QVERIFY(dock("dock.graphs")->isVisible());
    m_window->action(QStringLiteral("window.dock.outliner"))->trigger();
    QVERIFY(!dock("dock.outliner")->isVisible());
    m_window->action(QStringLiteral("window.layout"))->trigger();
    QVERIFY(dock("dock.outliner")->isVisible());
  }

  /// One of another workspace leads there; materials that share a dock with the outliner come to the front.
  void docksOfOtherPlacesAreGoneTo() {
    open({1280, 800});
    m_window->action(QStringLiteral("window.dock.film"))->trigger();
    QCOMPARE(m_window->workspaceTab(), MainWindow::kFilmTab);
    QVERIFY(dock("dock.film")->isVisible());
    m_window->action(QStringLiteral("window.workspaceScene"))->trigger();
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSceneTab);
    QAction* shared = m_window->action(QStringLiteral("window.dock.materials"));
    shared->trigger();
    QVERIFY(materials()->isVisible() && shared->isChecked());
    shared->trigger();
    QVERIFY(!materials()->isVisible() && m_window->findChild<Outliner*>()->isVisible() && !shared->isChecked());
    QVERIFY(m_window->close());
  }

  /// What stands over the picture, and its light, are chosen under View, and stay as chosen.
  void whatTheViewShowsIsChosen() {
    open({1280, 800});
    Viewport* view = m_window->viewport();
    QTRY_VERIFY(!view->overlayHits().axes.empty());
    m_window->session().document().setColour("temperature");
    QTRY_VERIFY(!view->overlayHits().legend.isEmpty() && !view->overlayHits().hintClose.isEmpty());
    for (const char* off : {"view.axes", "view.legend", "view.hint", "view.outlines"})
      m_window->action(QString::fromLatin1(off))->trigger();
    QTRY_VERIFY(view->overlayHits().axes.empty() && view->overlayHits().legend.isEmpty());
    QVERIFY(view->overlayHits().hintClose.isEmpty());
    m_window->selection().select(OutlineKind::Body, m_window->session().document().project().bodies.front().id);
    QVERIFY(!view->look().outline);
    QVERIFY(view->look().dark);
    m_window->action(QStringLiteral("view.studio.bright"))->trigger();
    QVERIFY(!view->look().dark);
    m_window->action(QStringLiteral("view.light"))->trigger();
    m_window->action(QStringLiteral("view.studio.dark"))->trigger();
    QVERIFY(view->look().dark);
    m_window->action(QStringLiteral("view.studio.theme"))->trigger();
    QVERIFY(!view->look().dark);
    m_window->action(QStringLiteral("view.studio.dark"))->trigger();
    QVERIFY(m_window->close());
    m_window.reset();
    open({1280, 800}, true);
    view = m_window->viewport();
    QVERIFY(view->look().dark);
    OverlayChoice left;
    left.axes = left.legend = left.hints = left.outlines = false;
    QVERIFY(view->overlays() == left);
    m_window->action(QStringLiteral("view.outlines"))->trigger();
    m_window->selection().select(OutlineKind::Body, m_window->session().document().project().bodies.front().id);
    QTRY_VERIFY(view->look().outline);
  }

  /// By the button beside the colours, too, which gives way where there is no room: the menu View has all of it.
  void whatTheViewShowsIsChosenBesideTheColours() {
    open({1600, 1000});
    const auto buttons = m_window->findChildren<QToolButton*>();
    const auto found = std::find_if(buttons.begin(), buttons.end(), [](const QToolButton* button) {
      return button->accessibleName() == QStringLiteral("What stands over the picture, and its light");
    });
    QVERIFY(found != buttons.end());
    const QToolButton* button = *found;
    QVERIFY(button->isVisible());
    const QList<QAction*> entries = button->menu()->actions();
    QAction* axes = m_window->action(QStringLiteral("view.axes"));
    QAction* bright = m_window->action(QStringLiteral("view.studio.bright"));
    QVERIFY(entries.contains(axes) && entries.contains(bright));
    axes->trigger();
    bright->trigger();
    Viewport* view = m_window->viewport();
    QVERIFY(!view->overlays().axes && !view->look().dark);
    view->setOverlays({});
    view->setStudio(Studio::AsTheme);
    Q_EMIT button->menu()->aboutToShow();  // it says what is so, whoever has chosen it
    QVERIFY(axes->isChecked() && !bright->isChecked());
    resize({966, 600});
    QTRY_VERIFY_WITH_TIMEOUT(m_window->viewport()->width() < 600, kLong);
    const QWidget* bar = button->parentWidget()->parentWidget();
    QVERIFY(!button->isVisible() || bar->rect().contains(QRect(button->mapTo(bar, QPoint()), button->size())));
  }

  /// Brushes, the view, the brush's panel and a slim timeline.
  void sketchHasDocksOfItsOwn_data() {
    QTest::addColumn<QSize>("size");
    for (const QSize& size : {QSize(1280, 800), QSize(1600, 1000), QSize(2560, 1440)})
      QTest::addRow("%d", size.width()) << size;
  }
  void sketchHasDocksOfItsOwn() {
    QFETCH(QSize, size);
    open(size);
    QCOMPARE(m_window->session().document().putKey({Owner::Scene, "", "gravity"}, 10, 3), QString());
    const int rows = dock("dock.transport")->height(), wide = m_window->viewport()->width();
    m_window->showWorkspace(MainWindow::kSketchTab);
    QCOMPARE(m_window->size(), size);
    QCOMPARE(shownDocks(), (QStringList{"dock.brushes", "dock.inspector", "dock.transport"}));
    const Dock *brushes = dock("dock.brushes"), *inspector = dock("dock.inspector"), *time = dock("dock.transport");
    QCOMPARE(brushes->width(), 98);
    QCOMPARE(inspector->width(), 324);
    QVERIFY(brushes->x() < 5 && inspector->geometry().right() > size.width() - 5);
    QVERIFY(time->x() > brushes->geometry().right() && time->geometry().right() < inspector->x());
    QVERIFY(brushes->geometry().bottom() == inspector->geometry().bottom() && time->height() < rows);
    QVERIFY(m_window->viewport()->width() > wide);
    const auto* tabs = inspector->findChild<QTabBar*>();
    QCOMPARE(tabs->tabText(0), QStringLiteral("Brush"));
    QCOMPARE(inspector->currentPage(), QStringLiteral("Brush"));
    for (const QAbstractButton* button : brushes->findChildren<QAbstractButton*>()) {
      if (!button->property("material").isNull()) QCOMPARE(button->visibleRegion(), QRegion(button->rect()));
    }
    m_window->showWorkspace(MainWindow::kSceneTab);
    QCOMPARE(m_window->size(), size);
    QCOMPARE(dock("dock.transport")->height(), rows);
    QCOMPARE(tabs->tabText(tabs->count() - 1), QStringLiteral("Brush"));
    QVERIFY(!dock("dock.brushes")->isVisible() && dock("dock.outliner")->isVisible());
    QTRY_COMPARE(m_window->viewport()->width(), wide);
  }

  /// Those of the scene have a place in it too.
  void docksOfSketchComeBackAsLeft() {
    open({1600, 1000});
    m_window->showWorkspace(MainWindow::kSketchTab);
    m_window->action(QStringLiteral("window.dock.outliner"))->trigger();
    m_window->action(QStringLiteral("window.dock.brushes"))->trigger();
    const QStringList left{"dock.inspector", "dock.outliner", "dock.transport"};
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSketchTab);
    QCOMPARE(shownDocks(), left);
    m_window->tools().activate("select");
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSceneTab);
    QVERIFY(shownDocks().contains("dock.graphs") && shownDocks().contains("dock.outliner"));
    m_window->tools().activate(kBrushTool);
    QCOMPARE(shownDocks(), left);
    QVERIFY(m_window->close());
    m_window.reset();
    open({1600, 1000}, true);
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSketchTab);
    QCOMPARE(shownDocks(), left);
    m_window->showWorkspace(MainWindow::kSceneTab);
    QVERIFY(shownDocks().contains("dock.graphs"));
    m_window->showWorkspace(MainWindow::kSketchTab);
    QCOMPARE(shownDocks(), left);
    m_window->action(QStringLiteral("window.layout"))->trigger();
    QCOMPARE(shownDocks(), (QStringList{"dock.brushes", "dock.inspector", "dock.transport"}));
  }

  /// The view stays as large as it was made, and gives way to the docks of whichever workspace that is by then.
  void oneDrawsInTheFullViewport() {
    open({1280, 800});
    QAction* full = m_window->action(QStringLiteral("window.full"));
    full->trigger();
    QTRY_COMPARE(m_window->viewport()->width(), 1280);
    m_window->tools().activate(kBrushTool);
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSketchTab);
    QVERIFY(shownDocks().isEmpty());
    QTRY_COMPARE(m_window->viewport()->width(), 1280);
    full->trigger();
    QCOMPARE(shownDocks(), (QStringList{"dock.brushes", "dock.inspector", "dock.transport"}));
    full->trigger();
    m_window->tools().activate("select");
    QVERIFY(shownDocks().isEmpty());
    full->trigger();
    QVERIFY(shownDocks().contains("dock.outliner") && !shownDocks().contains("dock.brushes"));
    full->trigger();
    m_window->showWorkspace(MainWindow::kFilmTab);
    QVERIFY(shownDocks().contains("dock.film"));
  }

  void messagesAreShownWhereverOneIs() {
    open({1280, 800});
    QAction* messages = m_window->action(QStringLiteral("help.messages"));
    const auto shown = [this] {
      return dock("dock.graphs")->isVisible() && dock("dock.graphs")->currentPage() == QStringLiteral("Messages");
    };
    m_window->showWorkspace(MainWindow::kSketchTab);
    messages->trigger();
    QVERIFY(shown());
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSketchTab);
    m_window->showWorkspace(MainWindow::kFilmTab);
    QVERIFY(!shown());
    messages->trigger();
    QVERIFY(shown());
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSceneTab);
  }

  /// Long ones in as many lines as they need, at any width.
  void messagesAreReadWhole() {
    open({1280, 800});
    const QString last = QStringLiteral("meanwhile.");
    MessageLog& log = m_window->session().log();
    log.add(MessageLevel::Info, QStringLiteral("Short"), QStringLiteral("All is well."));
    log.add(MessageLevel::Info, QStringLiteral("Long"),
            QStringLiteral("Bodies of a plugin that is not installed keep what they were and ").repeated(4) +
                QStringLiteral("stand still ") + last);
    m_window->action(QStringLiteral("help.messages"))->trigger();
    QTreeView* view = nullptr;
    for (QTreeView* each : m_window->findChildren<QTreeView*>()) {
      if (each->accessibleName() == QStringLiteral("Messages")) view = each;
    }
    QVERIFY(view);
    QTRY_VERIFY(view->isVisible() && view->model()->rowCount() >= 2);
    for (const int width : {1280, 1100}) {
      m_window->resize(width, 800);
      const auto height = [&](int row) { return view->visualRect(view->model()->index(row, 2)).height(); };
      QTRY_VERIFY2(height(0) > 1.7 * height(1), qPrintable(QString::number(height(0))));
      QString painted;
      for (const PaintedText& text : paintedBy(*view->viewport())) painted += text.text + QLatin1Char(' ');
      QVERIFY2(painted.contains(last), qPrintable(painted));
    }
  }

  /// They kept neither workspace nor pages.
  void layoutsOfOlderProgramsComeBack() {
    open({1600, 1000});
    dragBetweenLeftDocks(-60);
    const int left = dock("dock.materials")->height();
    m_window->showWorkspace(MainWindow::kTuneTab);
    QVERIFY(m_window->close());
    m_window.reset();
    QSettings settings;
    settings.remove(QStringLiteral("window/workspace"));
    settings.remove(QStringLiteral("window/pages"));
    open({1600, 1000}, true);
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSceneTab);
    QTRY_COMPARE(dock("dock.materials")->height(), left);
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Material"));
  }

  void pagesOfOneDockComeBackAsThat() {
    open({1280, 800});
    QVERIFY(m_window->close());
    m_window.reset();
    open({1280, 800}, true);
    QVERIFY(!dock("dock.materials")->isVisible());
    QCOMPARE(dock("dock.outliner")->findChild<QTabBar*>()->count(), 2);
  }

 private:
  void open(const QSize& size, bool again = false) {
    Theme::apply(*qApp, true);
    MainWindow::Options options;
    options.project = again ? QString() : m_path;  // else what was open last
    options.sample = m_path;
    options.session.autosaveDirectory = m_directory->filePath(QStringLiteral("copies"));
    m_window = shownWindow(options, size);
    QVERIFY(m_window);
    m_window->session().pause();
    QTest::qWait(50);
  }
  QStringList checkedInWindowMenu() {
    for (QAction* menu : m_window->findChild<QMenuBar*>()->actions()) {
      if (menu->text() != QStringLiteral("Window")) continue;
      Q_EMIT menu->menu()->aboutToShow();
      QStringList checked;
      for (const QAction* action : menu->menu()->actions()) {
        if (action->isChecked()) checked << action->objectName();
      }
      return checked;
    }
    return {};
  }
  void resize(const QSize& size) {
    m_window->resize(size);
    QTRY_COMPARE(m_window->size(), size);
    QTest::qWait(50);
  }
  void dragBetweenLeftDocks(int by) {
    const QRect above = dock("dock.outliner")->geometry();
    const QPoint separator(above.center().x(), (above.bottom() + dock("dock.materials")->y()) / 2);
    const int before = above.height();
    QTest::mouseMove(m_window.get(), separator);
    QTest::mousePress(m_window.get(), Qt::LeftButton, {}, separator);
    QTest::mouseMove(m_window.get(), separator + QPoint(0, by));
    QTest::qWait(50);  // docks follow when events are done
    QTest::mouseRelease(m_window.get(), Qt::LeftButton, {}, separator + QPoint(0, by));
    QTRY_COMPARE(dock("dock.outliner")->height(), before + by);
  }
  QStringList shownDocks() {
    QStringList names;
    for (const Dock* one : m_window->layoutOfDocks().docks()) {
      if (one->isVisible()) names << one->objectName();
    }
    names.sort();
    return names;
  }
  Dock* dock(const char* name) { return m_window->findChild<Dock*>(QString::fromLatin1(name)); }
  MaterialsPanel* materials() { return m_window->findChild<MaterialsPanel*>(); }
  std::unique_ptr<QTemporaryDir> m_directory;
  QString m_path;
  std::unique_ptr<MainWindow> m_window;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestLayout test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_layout.moc"
