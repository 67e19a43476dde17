// SPDX-License-Identifier: Apache-2.0
// Every page of every dock, pages in the middle, dialogs, menus and the window of each workspace with what is painted
// over its scene: dark and light, at 100 and 200 %, and small windows at 125 and 300 %. What is painted is read back as
// text, so that nothing is cut without a word; pictures are kept beside the test's home.
#include "core/plugin_host/registry.h"
#include "core/simulation/particlefield.h"
#include "tests/ui/paintedtexts.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/theme/plaintext.h"
#include "ui/viewport/overlays.h"
#include "ui/window/actions.h"
#include "ui/window/dock.h"
#include "ui/window/paneltable.h"
#include "ui/window/screenshot.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QDir>
#include <QtCore/QProcess>
#include <QtGui/QAction>
#include <QtGui/QHelpEvent>
#include <QtGui/QTextDocumentFragment>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QToolTip>

#include <algorithm>

using namespace ps;

namespace {

constexpr QChar kCut(0x2026);
constexpr int kSentence = 32;  // letters, of what may be cut in it all the same

/// It means that there is more to be asked, not that it is cut: of a button, and of an action where actions are listed.
bool isOwnText(const QWidget& widget, const QString& text) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  if (button && fromButtonText(button->text()) == text) return true;
  const QList<QAction*> actions =
      widget.window()->parentWidget() ? widget.window()->parentWidget()->actions() : widget.window()->actions();
  return std::any_of(actions.begin(), actions.end(), [&](const QAction* action) {
    return fromButtonText(action->text()) == text || cleanText(*action) == text;
  });
}

/// What stands in the tooltip after the pointer has rested there.
QString tipAt(QWidget& widget, const QPoint& at) {
  QHelpEvent help(QEvent::ToolTip, at, widget.mapToGlobal(at));
  QApplication::sendEvent(&widget, &help);
  return QTextDocumentFragment::fromHtml(QToolTip::text()).toPlainText();
}

/// Tabs that their bar shows in part, or not at all: it scrolls where there is no room.
QStringList hiddenTabs(const QWidget& widget) {
  QStringList hidden;
  for (const QTabBar* bar : widget.findChildren<QTabBar*>()) {
    if (!bar->isVisibleTo(&widget) || bar->visibleRegion().isEmpty()) continue;
    QRect room = bar->visibleRegion().boundingRect();
    for (const QToolButton* arrow : bar->findChildren<QToolButton*>()) {
      if (arrow->isVisibleTo(bar)) room.setRight(std::min(room.right(), arrow->x() - 1));
    }
    for (int tab = 0; tab < bar->count(); ++tab) {
      if (bar->isTabVisible(tab) && !room.contains(bar->tabRect(tab)))
        hidden << QStringLiteral("the tab “%1” is cut").arg(fromButtonText(bar->tabText(tab)));
    }
  }
  return hidden;
}

/// What is painted over the scene, as the view has it now.
OverlayState overlaysOf(MainWindow& window) {
  const Viewport& view = *window.viewport();
  OverlayState state;
  state.size = view.size();
  state.camera = view.navigator().camera();
  state.viewName = view.navigator().viewName();
  state.field = window.session().fields().find(view.colour());
  state.range = view.legendRange();
  state.boilingPoint = window.session().transitions().boils();
  state.shown = view.overlays();
  if (state.shown.hints) state.hints = view.hints();
  state.invitation = view.invitation();
  return state;
}

/// Texts of it that are cut, reach out of the view or lie on each other. Letters of the axes may: they turn.
QStringList faultsOver(const OverlayState& state) {
  TextDevice device(state.size.toSize());
  {
    QPainter painter(&device);
    paintOverlays(painter, state);
  }
  const auto inner = [](const PaintedText& painted) { return painted.place.adjusted(1, 3, -1, -3); };
  QStringList faults;
  device.texts.removeIf([](const PaintedText& painted) { return painted.text.size() < 2; });
  if (device.texts.size() < 2) faults << QStringLiteral("hardly a text over the scene");
  for (qsizetype k = 0; k < device.texts.size(); ++k) {
    const PaintedText& painted = device.texts[k];
    if (painted.text.contains(kCut)) faults << QStringLiteral("“%1” is cut").arg(painted.text);
    if (!QRectF({}, state.size).contains(painted.place.adjusted(1, 1, -1, -1)))
      faults << QStringLiteral("“%1” reaches out of the view").arg(painted.text);
    for (qsizetype other = 0; other < k; ++other) {
      if (inner(painted).intersects(inner(device.texts[other])))
        faults << QStringLiteral("“%1” lies on “%2”").arg(painted.text, device.texts[other].text);
    }
  }
  return faults;
}

/// Colours in a picture, as far as they tell that there is something in it.
int coloursIn(const QImage& picture) {
  QSet<QRgb> colours;
  for (int y = 0; y < picture.height() && colours.size() < 100; y += 2) {
    for (int x = 0; x < picture.width(); x += 2) colours << picture.pixel(x, y);
  }
  return static_cast<int>(colours.size());
}

}  // namespace

class TestPanelPictures : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QVERIFY(QDir().mkpath(QStringLiteral("pictures")));
    Theme::apply(*qApp, true);
    MainWindow::Options options;
    options.project = options.sample = kSample;
    options.samples = QStringLiteral(PS_SOURCE_DIR "/projects");
    options.restore = false;
    options.session.autosave = false;
    m_window = shownWindow(options, {1600, 1000});
    QVERIFY(m_window);
    session().pause();
    document().undoStack().clear();
  }

  void everyPage_data() {
    QTest::addColumn<bool>("dark");
    QTest::addColumn<QSize>("size");
    QTest::newRow("dark") << true << QSize(1600, 1000);
    QTest::newRow("light") << false << QSize(1600, 1000);
    QTest::newRow("small") << true << QSize(1280, 800);
  }
  void everyPage() {
    QFETCH(bool, dark);
    QFETCH(QSize, size);
    m_window->setDark(dark);
    m_window->resize(size);
    for (const PanelRow& row : panelTable()) {
      const auto& docks = dockTable();
      const auto place = std::find_if(docks.begin(), docks.end(),
                                      [&](const DockRow& dock) { return QByteArray(dock.name) == row.dock; });
      QVERIFY(place != docks.end());
      m_window->layoutOfDocks().setWorkspace(place->workspaces.front());
      const QString title = QString::fromLatin1(row.title);
      m_window->layoutOfDocks().showPage(title);
      Dock* dock = m_window->layoutOfDocks().dockOf(title);
      QTRY_VERIFY_WITH_TIMEOUT(dock && dock->isVisible() && dock->currentPage() == title, kLong);
      look(*dock, title);
    }
  }

  void pagesInTheMiddle_data() { everyPage_data(); }
  void pagesInTheMiddle() {
    QFETCH(bool, dark);
    QFETCH(QSize, size);
    m_window->setDark(dark);
    m_window->resize(size);
    for (const char* action : {"add.library", "help.welcome", "help.plugins"}) {
      m_window->action(QLatin1String(action))->trigger();
      QTest::qWait(200);
      look(*m_window->centralWidget(), QLatin1String(action));
      QTest::keyClick(m_window.get(), Qt::Key_Escape);
    }
  }

  void dialogs_data() {
    QTest::addColumn<bool>("dark");
    QTest::newRow("dark") << true;
    QTest::newRow("light") << false;
  }
  void dialogs() {
    QFETCH(bool, dark);
    m_window->setDark(dark);
    for (const char* action : {"edit.preferences", "edit.project", "file.film", "file.export", "help.shortcuts",
                               "help.first-steps", "help.sketching", "help.values"}) {
      m_window->action(QLatin1String(action))->trigger();
      QDialog* dialog = nullptr;
      QTRY_VERIFY_WITH_TIMEOUT((dialog = shownDialog()) != nullptr, kLong);
      look(*dialog, QLatin1String(action));
      dialog->close();
      QTRY_VERIFY_WITH_TIMEOUT(!shownDialog(), kLong);
    }
  }

  void theFieldThatFindsEverything_data() { dialogs_data(); }
  void theFieldThatFindsEverything() {
    QFETCH(bool, dark);
    m_window->setDark(dark);
    m_window->action(QStringLiteral("edit.search"))->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(m_window->palette()->isVisible(), kLong);
    look(*m_window->palette(), QStringLiteral("edit.search"));
    QTest::keyClick(m_window->palette()->field(), Qt::Key_Escape);
  }

  void menus_data() { dialogs_data(); }
  void menus() {
    QFETCH(bool, dark);
    m_window->setDark(dark);
    for (QAction* each : m_window->findChild<QMenuBar*>()->actions())
      lookAtMenu(*each->menu(), QStringLiteral("menu ") + fromButtonText(each->text()));
  }

  void workspaces_data() {
    everyPage_data();
    QTest::newRow("small-light") << false << QSize(1280, 800);
  }
  void workspaces() {
    QFETCH(bool, dark);
    QFETCH(QSize, size);
    m_window->setDark(dark);
    m_window->resize(size);
    document().setColour("temperature");  // which has the largest legend
    const QTabBar* tabs = m_window->findChild<QTabBar*>(QStringLiteral("psWorkspaces"));
    for (int tab = tabs->count() - 1; tab >= 0; --tab) {
      m_window->showWorkspace(static_cast<MainWindow::WorkspaceTab>(tab));
      QTest::qWait(200);
      look(*m_window, QStringLiteral("window ") + tabs->tabText(tab));
      const QStringList faults = faultsOver(overlaysOf(*m_window));
      QVERIFY2(faults.isEmpty(),
               qPrintable(tabs->tabText(tab) + QStringLiteral(": ") + faults.join(QStringLiteral("; "))));
    }
    const OverlayHits& hits = view()->overlayHits();  // in Scene
    QTRY_VERIFY_WITH_TIMEOUT(!hits.legend.isEmpty() && !hits.hintClose.isEmpty() && !hits.axes.empty(), kLong);
  }

  /// What can be selected, and every brush, in the narrowest inspector.
  void everyThing() {
    m_window->setDark(true);
    m_window->resize(1280, 800);
    m_window->layoutOfDocks().setWorkspace(Workspace::Scene);
    Emitter tap;
    tap.material = "water";
    tap.point = {0, 0.6, 0};
    std::vector<SelectedItem> things{{OutlineKind::Wall, "floor"}, {OutlineKind::Probe, "coldest"}};
    things.push_back({OutlineKind::Emitter, document().addEmitter(tap).id});
    things.push_back({OutlineKind::Sink, document().addSink({}).id});
    for (const char* solid : {"add.sheet", "add.rope", "add.bowl"}) {
      m_window->action(QLatin1String(solid))->trigger();
      things.push_back({OutlineKind::Body, document().project().bodies.back().id});
    }
    WindowLayout& layout = m_window->layoutOfDocks();
    for (const SelectedItem& thing : things) {
      m_window->selection().select(thing.kind, thing.id);
      for (const char* page : {"Body", "Scene"}) {
        layout.showPage(QLatin1String(page));
        look(*m_window->inspectorDock(), QString::fromStdString(thing.id) + QLatin1Char(' ') + QLatin1String(page));
      }
    }
    layout.showPage(QStringLiteral("Brush"));
    BrushSettings brush = m_window->tools().brush();
    for (const std::string& id : session().plugins()->ids(PluginKind::Brush)) {
      brush.shape = id;
      m_window->tools().setBrush(brush);
      look(*m_window->inspectorDock(), QStringLiteral("brush ") + QString::fromStdString(id));
    }
    while (document().undoStack().canUndo()) document().undoStack().undo();
  }

  void theSameAtOtherScales_data() {
    QTest::addColumn<QString>("scale");
    QTest::addColumn<QStringList>("what");
    const QStringList small{"everyPage:small", "pagesInTheMiddle:small", "dialogs:dark", "menus:dark",
                            "theFieldThatFindsEverything:dark"};
    QTest::newRow("125 %") << "1.25" << small + QStringList{"workspaces:small"};
    QTest::newRow("200 %") << "2"
                           << QStringList{"everyPage:dark",
                                          "everyPage:light",
                                          "pagesInTheMiddle:dark",
                                          "pagesInTheMiddle:light",
                                          "dialogs",
                                          "theFieldThatFindsEverything",
                                          "menus",
                                          "workspaces:small",
                                          "workspaces:small-light"};
    QTest::newRow("300 %") << "3" << small;
  }
  void theSameAtOtherScales() {
    QFETCH(QString, scale);
    QFETCH(QStringList, what);
    if (qEnvironmentVariableIsSet("QT_SCALE_FACTOR")) return;
    QProcess again;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("QT_SCALE_FACTOR"), scale);
    again.setProcessEnvironment(environment);
    again.setProcessChannelMode(QProcess::MergedChannels);
    m_window->hide();
    again.start(QCoreApplication::applicationFilePath(), what);
    QVERIFY(again.waitForFinished(10 * kLong));
    QVERIFY2(again.exitStatus() == QProcess::NormalExit && again.exitCode() == 0, again.readAll().constData());
  }

 private:
  QDialog* shownDialog() const {
    for (QDialog* dialog : m_window->findChildren<QDialog*>()) {
      if (dialog->isVisible()) return dialog;
    }
    return nullptr;
  }
  /// And at what opens from it.
  void lookAtMenu(QMenu& menu, const QString& title) {
    menu.popup(m_window->mapToGlobal(QPoint(40, 40)));
    QTRY_VERIFY_WITH_TIMEOUT(menu.isVisible(), kLong);
    look(menu, title);
    menu.close();
    for (QAction* entry : menu.actions()) {
      if (entry->menu() && !entry->menu()->isEmpty() && entry->isEnabled())
        lookAtMenu(*entry->menu(), title + QLatin1Char(' ') + fromButtonText(entry->text()));
    }
  }
  /// Keeps the picture, and sees to it that it shows something and that what is cut can be read by its tip.
  void look(QWidget& widget, const QString& title) {
    QCoreApplication::processEvents();
    const qreal scale = widget.devicePixelRatioF();
    const QImage picture = widget.isWindow() ? windowImage(widget) : widget.grab().toImage();
    QCOMPARE(picture.size(), QSize(widget.size() * scale));
    const QString name =
        QStringLiteral("%1 %2 %3 %4.png")
            .arg(title)
            .arg(m_window->width())
            .arg(100 * scale)
            .arg(m_window->layoutOfDocks().isDark() ? QStringLiteral("dark") : QStringLiteral("light"));
    QVERIFY(picture.save(QStringLiteral("pictures/") + name));
    QVERIFY2(coloursIn(picture) > 5, qPrintable(name));
    QStringList problems;
    for (const QString& tab : hiddenTabs(widget)) problems << QStringLiteral("%1: %2").arg(name, tab);
    for (QWidget* part : widget.findChildren<QWidget*>()) {
      if (!part->isVisibleTo(&widget) || part->visibleRegion().isEmpty()) continue;
      for (const PaintedText& painted : paintedBy(*part)) {
        const QString& text = painted.text;
        // Letters are as wide as on a screen of 100 % here, which is up to 2 % off at others, and where they are cut
        // to their room more.
        const double slack = 1 + 0.02 * painted.place.width();
        if (!text.contains(kCut) && (painted.place.left() < -slack || painted.place.right() > part->width() + slack))
          problems << QStringLiteral("%1: “%2” reaches out of its %3").arg(name, text, part->metaObject()->className());
        if (!text.endsWith(kCut) || isOwnText(*part, text)) continue;
        const QString tip = tipAt(*part, painted.at.toPoint());
        if (!tip.contains(text.chopped(1).trimmed()))
          problems << QStringLiteral("%1: of “%2” the tip has “%3”").arg(name, text, tip);
        if (text.size() < kSentence) problems << QStringLiteral("%1: “%2” is cut").arg(name, text);
      }
    }
    QVERIFY2(problems.isEmpty(), qPrintable(problems.join(QLatin1Char('\n'))));
  }
};

QTEST_MAIN(TestPanelPictures)
#include "tst_panelpictures.moc"
