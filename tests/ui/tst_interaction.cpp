// SPDX-License-Identifier: Apache-2.0
// Hands in the real window: menus of rows and of the view, strokes, legend.
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/graphs/graphexport.h"
#include "ui/library/librarypage.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/panels/pluginpage.h"
#include "ui/render/framing.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/selection.h"
#include "ui/timeline/transport.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"
#include "ui/window/commandpalette.h"
#include "ui/window/dock.h"
#include "ui/window/libraryactions.h"
#include "ui/window/noticebar.h"
#include "ui/window/paneltable.h"
#include "ui/window/shortcutswindow.h"
#include "ui/window/welcome.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QPointer>
#include <QtCore/QScopeGuard>
#include <QtCore/QTimer>
#include <QtGui/QAccessible>
#include <QtGui/QAction>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QDialog>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

using namespace ps;

namespace {

const Address kSpacing{Owner::Solver, "", "particle_spacing"};

/// Pixels of two pictures that differ; all of them where their sizes do.
int differing(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) return a.width() * a.height();
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
  }
  return count;
}

}  // namespace

class TestInteraction : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    Theme::apply(*qApp, true);
    MainWindow::Options options;
    options.project = options.sample = kSample;
    options.samples = QStringLiteral(PS_SOURCE_DIR "/projects");  // the first page has their cards
    options.restore = false;
    options.session.autosave = false;
    m_window = shownWindow(options, {1280, 800});
    QVERIFY(m_window);
  }
  void init() { backToTheStart(); }
  void cleanupTestCase() { m_window.reset(); }

  /// The menu of a row asks for a panel made anew while the row is still on the call stack.
  void aRowIsPinnedFromItsMenu() {
    ParameterPanel* panel = m_window->inspector().materialPanel();
    m_window->inspectorDock()->showPage(QStringLiteral("Material"));
    const QString key = QStringLiteral("material/water/viscosity");
    const auto pinned = [&] {
      const auto rows = panel->rows();
      return std::count_if(rows.begin(), rows.end(),
                           [&](ParameterRow* row) { return row->model().pinned && row->key() == key; });
    };
    const auto choose = [&](const QString& text) {
      QTimer::singleShot(0, m_window.get(), [text] {
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        QVERIFY(menu);
        for (QAction* action : menu->actions()) {
          if (action->text().startsWith(text)) menu->setActiveAction(action);
        }
        QTest::keyClick(menu, Qt::Key_Return);
      });
      ParameterRow* row = panel->row(key);
      QContextMenuEvent ask(QContextMenuEvent::Keyboard, QPoint(20, 10), row->mapToGlobal(QPoint(20, 10)));
      QApplication::sendEvent(row, &ask);
    };
    QCOMPARE(pinned(), 0);
    choose(QStringLiteral("Pin"));
    QCOMPARE(pinned(), 1);
    QCOMPARE(document().project().view.pinned.back(), key.toStdString());
    for (const ParameterRow* row : panel->rows())
      QCOMPARE(row->model().isPinned && row->key() == key, row->key() == key);
    choose(QStringLiteral("Remove"));
    QCOMPARE(pinned(), 0);
  }

  void colourLeavesThePanelsAlone() {
    const ParameterRow* row = m_window->inspector().materialPanel()->row(QStringLiteral("material/water/viscosity"));
    m_window->action(QStringLiteral("view.colour3"))->trigger();
    m_window->action(QStringLiteral("view.colour2"))->trigger();
    QCOMPARE(m_window->inspector().materialPanel()->row(QStringLiteral("material/water/viscosity")), row);
  }

  /// A plugin's own parameter gives properties other defaults: their rows show and compare with those.
  void pluginParametersRefreshProperties() {
    const Address density{Owner::Material, "water", "density_liquid"},
        maximum{Owner::Material, "water", "density_maximum"};
    const ParameterRow* row = m_window->inspector().materialPanel()->row(QString::fromStdString(density.text()));
    QVERIFY(row && std::holds_alternative<Response>(row->model().value));
    const Value with = row->model().value;
    QCOMPARE(document().setParameter(maximum, false), QString());
    QVERIFY(!(row->model().value == with));
    QVERIFY(row->model().value == document().value(density));
    QVERIFY(!row->isChanged());
    document().undoStack().undo();
    QVERIFY(row->model().value == with);
  }

  /// A right click that does not drag opens the menu of the view; its entries are the window's actions.
  void theViewHasAMenu() {
    QTest::mouseClick(view(), Qt::RightButton, {}, QPoint(view()->width() / 2, view()->height() / 3));
    const auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QStringList texts;
    for (const QAction* action : menu->actions()) {
      texts << action->text();
      if (!action->menu()) continue;
      for (QAction* entry : action->menu()->actions()) texts << entry->text();
      if (action->text() == QStringLiteral("Look from")) action->menu()->actions()[2]->trigger();
    }
    for (const char* text : {"Frame selection", "Frame all", "Look from", "Top", "Colour", "Phase"})
      QVERIFY2(texts.contains(QLatin1String(text)), text);
    QCOMPARE(view()->navigator().camera().elevation, 90.0);
    QApplication::activePopupWidget()->close();
    const Camera before = view()->navigator().camera();
    QTest::mousePress(view(), Qt::RightButton, {}, QPoint(300, 200));
    QTest::mouseMove(view(), QPoint(300, 240));
    QTest::mouseRelease(view(), Qt::RightButton, {}, QPoint(300, 240));
    QVERIFY(!QApplication::activePopupWidget());
    QVERIFY(view()->navigator().camera().distance < before.distance);
  }

  void aWallIsShownWhole() {
    m_window->inspectorDock()->showPage(QStringLiteral("Body"));
    m_window->outliner()->setFocus();
    m_window->selection().select(OutlineKind::Wall, "lid");
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Scene"));
    ParameterPanel* panel = m_window->inspector().scenePanel();
    const ParameterRow* row = panel->row(QStringLiteral("wall/lid/temperature"));
    QVERIFY(row && panel->rect().contains(row->mapTo(panel, row->rect().bottomLeft())));
    QVERIFY(!panel->isAncestorOf(QApplication::focusWidget()));
    QVERIFY(m_window->inspector().bodyPanel()->rows().empty());  // no body is selected
  }

  /// A page that goes while one of its rows has the focus does not leave it to a field that takes letters.
  void keysStayKeysWhenAPageGoes() {
    Dock* dock = m_window->inspectorDock();
    const auto row = [&] {
      dock->showPage(QStringLiteral("Material"));
      ParameterRow* first = m_window->inspector().materialPanel()->rows().front();
      first->setFocus();
      return first->hasFocus();
    };
    QVERIFY(row());
    dock->showPage(QStringLiteral("Solver"));
    QVERIFY(qobject_cast<QTabBar*>(m_window->focusWidget()));
    QVERIFY(row());
    const auto buttons = m_window->findChildren<QToolButton*>();
    const auto eraser = std::find_if(buttons.begin(), buttons.end(), [](const QToolButton* button) {
      return button->accessibleName().endsWith(QStringLiteral("(E)"));
    });
    QVERIFY(eraser != buttons.end());
    QTest::mouseClick(*eraser, Qt::LeftButton);
    QCOMPARE(dock->currentPage(), QStringLiteral("Brush"));
    QVERIFY(view()->hasFocus());
  }

  /// From what stands above its rows into them, and through them.
  void tabGoesThroughAPanelInItsOrder() {
    m_window->inspectorDock()->showPage(QStringLiteral("Material"));
    ParameterPanel* panel = m_window->inspector().materialPanel();
    auto* changed = panel->findChild<QPushButton*>(QStringLiteral("psChanged"));
    changed->setFocus();
    QTRY_VERIFY(changed->hasFocus());
    std::vector<ParameterRow*> passed, all;
    for (ParameterRow* row : panel->rows()) {
      if (row->focusPolicy() != Qt::NoFocus) all.push_back(row);
    }
    QVERIFY(all.size() > 10 && all.size() < panel->rows().size());  // some rest, and are passed over
    QWidget* at = changed;
    while (panel->isAncestorOf(at)) {
      if (auto* row = qobject_cast<ParameterRow*>(at)) passed.push_back(row);
      QTest::keyClick(at, Qt::Key_Tab);
      at = QApplication::focusWidget();
    }
    QVERIFY(passed == all);
  }

  /// The header of a dock is read before its pages, and so are its buttons.
  void tabGoesThroughAHeaderFirst() {
    auto* dock = m_window->findChild<Dock*>(QStringLiteral("dock.graphs"));
    auto* tabs = dock->findChild<QTabBar*>();
    std::vector<QWidget*> buttons;
    for (QToolButton* button : dock->titleBarWidget()->findChildren<QToolButton*>()) {
      if ((button->focusPolicy() & Qt::TabFocus) && button->isVisible()) buttons.push_back(button);
    }
    std::sort(buttons.begin(), buttons.end(), [](const QWidget* a, const QWidget* b) { return a->x() < b->x(); });
    QVERIFY(buttons.size() >= 2);
    QWidget* at = tabs;
    for (const QWidget* button : buttons) {
      do {
        at = at->nextInFocusChain();
      } while (!(at->focusPolicy() & Qt::TabFocus) || !at->isVisible());
      QCOMPARE(at, button);
    }
  }

  void everyStopHasARing_data() {
    QTest::addColumn<QString>("page");
    for (const PanelRow& row : panelTable()) QTest::newRow(row.title) << QString::fromLatin1(row.title);
    for (const char* page : {"Plugins", "Library", "Welcome", "Preferences"})
      QTest::newRow(page) << QString::fromLatin1(page);
  }
  /// Tab goes on from each stop of a page and of its dock's header, Shift+Tab back; what has the focus is seen to.
  void everyStopHasARing() {
    QFETCH(QString, page);
    constexpr int kRing = 30;  // pixels at least; a caret is less
    QApplication::setActiveWindow(m_window.get());
    m_window->selection().selectBody("ice");
    session().log().add(MessageLevel::Info, QStringLiteral("Test"), QStringLiteral("Something to read"));
    const auto after = qScopeGuard([this] {
      for (QDialog* dialog : m_window->findChildren<QDialog*>()) dialog->close();
      Q_EMIT m_window->pluginPage()->closeRequested();
      Q_EMIT m_window->library().page()->closeRequested();
      m_window->welcome().leave();
      m_window->showWorkspace(MainWindow::kSceneTab);
      QApplication::setActiveWindow(m_window.get());
      view()->setFocus();
    });
    const QWidget* area = areaOf(page);
    QVERIFY(area);
    QTRY_VERIFY_WITH_TIMEOUT(area->isVisible(), kLong);
    QTest::qWait(500);  // what is read beside the window makes rows anew
    QApplication::setActiveWindow(area->window());
    std::vector<QPointer<QWidget>> stops;
    for (QWidget* stop : stopsIn(*area)) stops.emplace_back(stop);
    QVERIFY(!stops.empty());
    for (const QPointer<QWidget>& stop : stops) {
      if (!stop || !stop->isVisible() || !stop->isEnabled()) continue;
      const QByteArray name = stop->metaObject()->className() + QByteArray(" ") + stop->accessibleName().toUtf8();
      stop->setFocus(Qt::TabFocusReason);
      QTRY_VERIFY2(stop->hasFocus(), name.constData());
      // Of buttons of which one is chosen Tab stops at that one, and arrows go to the others.
      const bool byTab = stop->focusPolicy() & Qt::TabFocus;
      QImage focused = stop->grab().toImage();
      QTest::keyClick(stop, Qt::Key_Tab);
      if (qobject_cast<QLabel*>(stop) && stop->hasFocus()) {  // it stops at its links first
        focused = stop->grab().toImage();
        QTest::keyClick(stop, Qt::Key_Tab);
      }
      QWidget* next = QApplication::focusWidget();
      QVERIFY2(next && next != stop, name.constData());
      QVERIFY2(differing(focused, stop->grab().toImage()) >= kRing, name.constData());
      if (!byTab || !area->isAncestorOf(next)) continue;
      QTest::keyClick(next, Qt::Key_Backtab, Qt::ShiftModifier);
      QVERIFY2(stop->hasFocus(), name.constData());
    }
  }

  /// A key turns the view under a pointer that rests.
  void theBrushStandsUnderThePointerInAnotherView() {
    m_window->tools().activate("brush");
    const QPoint at = view()->rect().center() + QPoint(60, 10);
    QCursor::setPos(view()->mapToGlobal(at));
    QTest::mouseMove(view(), at);
    const auto shown = [this] { return m_window->tools().tool().picture().cursor; };
    QVERIFY(shown());
    const Vector3 before = shown()->centre;
    view()->show(StandardView::Top);
    QVERIFY(shown() && shown()->centre != before);
    const Vector3 after = shown()->centre;
    m_window->tools().activate("select");
    m_window->tools().activate("brush");  // which looks where the pointer is
    QCOMPARE(shown()->centre, after);
  }

  /// The lid is far above the ice and belongs to the scene; so it does with F when nothing is selected.
  void framingShowsTheTray_data() {
    QTest::addColumn<QString>("action");
    QTest::newRow("all") << "view.frameAll";
    QTest::newRow("selection, when there is none") << "view.frame";
  }
  void framingShowsTheTray() {
    QFETCH(QString, action);
    view()->show(StandardView::Scene);
    m_window->selection().clear();
    m_window->action(action)->trigger();
    const auto& walls = document().project().environment.walls;
    const auto lid = std::find_if(walls.begin(), walls.end(), [](const SceneWall& wall) { return wall.id == "lid"; });
    QVERIFY(lid != walls.end());
    for (const double x : {-0.36, 0.36}) {
      for (const double z : {-0.36, 0.36}) {
        const auto seen =
            project(view()->navigator().camera(), view()->width(), view()->height(), {x, lid->point[1], z});
        QVERIFY(seen && (*seen)[0] >= 0 && (*seen)[0] <= view()->width() && (*seen)[1] >= 0 &&
                (*seen)[1] <= view()->height());
      }
    }
  }

  /// What asks for something stands beside the window. Only the question for a file, which is the system's, holds it.
  void noDialogHoldsTheWindow() {
    struct Watch : QObject {
      QStringList shown, modal;
      bool eventFilter(QObject* watched, QEvent* event) override {
        auto* dialog = event->type() == QEvent::Show ? qobject_cast<QDialog*>(watched) : nullptr;
        if (qobject_cast<QFileDialog*>(dialog)) {
          QTimer::singleShot(0, dialog, &QDialog::reject);
        } else if (dialog) {
          shown << dialog->windowTitle();
          if (dialog->isModal()) modal << dialog->windowTitle();
        }
        return false;
      }
    } watch;
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > 0, kLong);
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    qApp->installEventFilter(&watch);
    for (QAction* action : m_window->findChildren<QAction*>(Qt::FindDirectChildrenOnly)) {
      if (action->text().endsWith(QStringLiteral("…")) || action->objectName() == QStringLiteral("help.shortcuts"))
        action->trigger();
    }
    const auto buttons = m_window->library().page()->findChildren<QPushButton*>();
    for (QPushButton* button : buttons) {
      if (button->text().endsWith(QStringLiteral("…"))) button->click();
    }
    qApp->removeEventFilter(&watch);
    qDeleteAll(m_window->findChildren<QDialog*>(QString(), Qt::FindDirectChildrenOnly));
    m_window->palette()->hide();
    m_window->welcome().leave();
    QApplication::setActiveWindow(m_window.get());
    QVERIFY2(watch.modal.isEmpty(), qPrintable(watch.modal.join(QStringLiteral(", "))));
    for (const char* title : {"Export a film", "Export the run", "Mix two materials", "Preferences",
                              "Project properties", "Keyboard shortcuts"})
      QVERIFY2(watch.shown.contains(QString::fromLatin1(title)), title);
  }

  void themesAreMarked() {
    for (const bool dark : {false, true}) {
      m_window->setDark(dark);
      Q_EMIT viewMenu()->aboutToShow();
      QCOMPARE(m_window->action(QStringLiteral("view.dark"))->isChecked(), dark);
      QCOMPARE(m_window->action(QStringLiteral("view.light"))->isChecked(), !dark);
    }
  }

  /// The list is made from the actions themselves: every shortcut is in it.
  void everyShortcutIsListed() {
    QStringList all;
    for (const ShortcutGroup& group : shortcutGroups(*m_window)) {
      QVERIFY2(!group.lines.empty(), qPrintable(group.title));
      for (const auto& [keys, does] : group.lines) all << keys + QLatin1Char('\t') + does;
    }
    for (const QAction* action : m_window->findChildren<QAction*>(Qt::FindDirectChildrenOnly)) {
      if (!action->objectName().contains(QLatin1Char('.')) || action->shortcut().isEmpty()) continue;
      const QString keys = action->shortcut().toString(QKeySequence::NativeText);
      QVERIFY2(!all.filter(keys).isEmpty(), qPrintable(action->objectName()));
    }
    QVERIFY(all.contains(QStringLiteral("Ctrl+Z\tUndo")));
    QVERIFY(all.contains(QStringLiteral("Ctrl+Shift+Z, Ctrl+Y\tRedo")));
    QVERIFY(all.contains(QStringLiteral("3 in Sketch\tDraw with the scene's material 3")));
    QVERIFY(all.contains(QStringLiteral("3 outside Sketch, Alt+3\tLook from: Top")));
    QVERIFY(all.contains(QStringLiteral("T\tPlace a tap")));  // the menu Add has it too
    QVERIFY(!all.filter(QStringLiteral("Alt+Drag")).isEmpty());
    m_window->action(QStringLiteral("help.shortcuts"))->trigger();
    m_window->action(QStringLiteral("help.shortcuts"))->trigger();
    const auto windows = m_window->findChildren<QDialog*>();
    QCOMPARE(windows.size(), 1);
    QVERIFY(windows.front()->isVisible() && !windows.front()->isModal());
    windows.front()->close();
  }

  /// Words go whole, the span of time last.
  void theClockOfHeatFits() {
    const ThermalTexts texts{QStringLiteral("Heat ×2000 = "), QStringLiteral("2 h 20 min"),
                             QStringLiteral(" of real heating")};
    QCOMPARE(texts.fitting(texts.width()).whole(), texts.whole());
    QCOMPARE(texts.fitting(texts.width() - 1).whole(), QStringLiteral("Heat ×2000 = 2 h 20 min"));
    QCOMPARE(texts.fitting(10).whole(), QStringLiteral("2 h 20 min"));
  }

  void legendEndsCanBeDragged_data() {
    QTest::addColumn<bool>("upper");
    QTest::newRow("upper") << true;
    QTest::newRow("lower") << false;
  }
  /// A tenth of the bar is a tenth of the range; nothing else moves; a double click is automatic again.
  void legendEndsCanBeDragged() {
    QFETCH(bool, upper);
    m_window->action(QStringLiteral("view.colour2"))->trigger();
    view()->grabFramebuffer();  // the legend lies where the new colour's last painting put it
    QVERIFY(!view()->overlayHits().legendBar.isEmpty());
    const auto before = view()->legendRange();
    const Camera camera = view()->navigator().camera();
    const QRectF bar = view()->overlayHits().legendBar;
    const QPoint end((upper ? bar.topRight() : bar.bottomRight()).toPoint() + QPoint(10, 0));
    const int way = static_cast<int>(bar.height() / 10) * (upper ? -1 : 1);
    // Not by the pointer of the screen, over which windows of other tests may lie.
    const auto send = [&](QEvent::Type type, const QPoint& at, Qt::MouseButton button, Qt::MouseButtons held) {
      QMouseEvent event(type, at, view()->mapToGlobal(at), button, held, Qt::NoModifier);
      QApplication::sendEvent(view(), &event);
    };
    const auto drag = [&](bool release) {
      send(QEvent::MouseButtonPress, end, Qt::LeftButton, Qt::LeftButton);
      for (const int share : {2, 1})
        send(QEvent::MouseMove, end + QPoint(0, way / share), Qt::NoButton, Qt::LeftButton);
      if (release) send(QEvent::MouseButtonRelease, end + QPoint(0, way), Qt::LeftButton, Qt::NoButton);
    };
    send(QEvent::MouseMove, end, Qt::NoButton, Qt::NoButton);
    QCOMPARE(view()->cursor().shape(), Qt::SizeVerCursor);
    drag(true);
    QTRY_VERIFY_WITH_TIMEOUT(view()->legendRange() != before, kLong);
    const auto after = view()->legendRange();
    const double width = before.second - before.first,
                 moved = upper ? after.second - before.second : before.first - after.first;
    QVERIFY2(std::abs(moved - width / 10) < width / 50, qPrintable(QString::number(moved)));  // a pixel, then rounding
    QCOMPARE(upper ? after.first : after.second, upper ? before.first : before.second);
    QCOMPARE(view()->navigator().camera().azimuth, camera.azimuth);
    drag(false);
    QVERIFY(view()->cancelGesture());  // Esc
    send(QEvent::MouseButtonRelease, end + QPoint(0, way), Qt::LeftButton, Qt::NoButton);
    view()->repaint();
    QVERIFY(view()->legendRange() == after);
    QTest::mouseDClick(view(), Qt::LeftButton, {}, bar.center().toPoint());
    QTRY_VERIFY_WITH_TIMEOUT(view()->legendRange() == before, kLong);
  }

  /// The ends pass one another at no drag, and stand on values that can be read.
  void legendRangesStayInOrder() {
    const ParticleFields fields;
    const ParticleField &temperature = *fields.find("temperature"), &speed = *fields.find("speed");
    LegendRange range;
    QVERIFY(range.update(temperature, {263.15, 373.15}) == (std::pair{263.15, 373.15}));
    range.moveEnd(false, 3);
    const auto narrow = range.update(temperature, {200, 500});
    QVERIFY(narrow.first < narrow.second);
    QCOMPARE(narrow.second, 373.15);
    const double celsius = narrow.first - 273.15;
    QVERIFY(std::abs(celsius - std::round(celsius)) < 1e-9);
    QVERIFY(range.update(speed, {0, 5}) == (std::pair{0.0, 5.0}));  // another map is automatic
    QVERIFY(range.update(speed, {0, 3}) == (std::pair{0.0, 5.0}));  // and stands as long as half of it is used
    QVERIFY(range.update(speed, {0, 2}) == (std::pair{0.0, 2.0}));
  }

  /// By its action, its keys and its strip; it is no edit, turns with who looks, and ends with Esc.
  void aSectionOpensTheScene() {
    const auto act = [&](const char* name) { m_window->action(QString::fromLatin1(name))->trigger(); };
    const auto kept = [&] { return view()->viewSection(); };
    const auto paint = [&] { view()->grabFramebuffer(); };
    const int steps = document().undoStack().count();
    QVERIFY(!kept() && !m_window->action(QStringLiteral("view.sectionFlip"))->isEnabled());
    act("view.section");
    QVERIFY(kept() && kept()->across == "view" && m_window->action(QStringLiteral("view.section"))->isChecked());
    const auto bodies = boxesOfBodies(*view()->snapshot());
    QCOMPARE(bodies.size(), size_t{1});
    const auto& [low, high] = *bodies[0];
    QVERIFY((kept()->through - (low + high) / 2).norm() < 0.1 * (high - low).norm());
    paint();
    QVERIFY(view()->shownLook().section == view()->section());
    QVERIFY(document().project().view.section == kept());  // as a project keeps it
    QVERIFY(view()->summary().contains(QStringLiteral("Section that faces you")));

    const double offset = view()->section()->plane.offset, spacing = view()->snapshot()->spacing;
    act("view.sectionDeeper");
    QVERIFY(std::abs(view()->section()->plane.offset - offset - spacing) < 1e-9);
    act("view.sectionBack");
    QVERIFY(std::abs(view()->section()->plane.offset - offset) < 1e-9);

    view()->show(StandardView::Top);
    QVERIFY((view()->section()->plane.normal - Vector3(0, -1, 0)).norm() < 1e-9);
    view()->show(StandardView::Right);
    act("view.sectionX");
    QVERIFY(kept()->across == "x" && (view()->section()->plane.normal - Vector3(-1, 0, 0)).norm() < 1e-9);
    view()->show(StandardView::Left);  // it stays where it is
    QVERIFY((view()->section()->plane.normal - Vector3(-1, 0, 0)).norm() < 1e-9);

    paint();
    const SectionHits hits = view()->overlayHits().section;
    QVERIFY(!hits.slider.isEmpty() && hits.ways.size() == 4);
    const auto click = [&](const QPointF& at, const QPointF& to) {
      for (const auto& [type, place] : {std::pair(QEvent::MouseButtonPress, at), std::pair(QEvent::MouseMove, to),
                                        std::pair(QEvent::MouseButtonRelease, to)}) {
        QMouseEvent event(type, place, view()->mapToGlobal(place), Qt::LeftButton,
                          type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(view(), &event);
      }
    };
    const QPointF middle = hits.slider.center(), quarter(hits.slider.width() / 4, 0);
    click(middle, middle - quarter);
    const double less = kept()->through.x();
    click(middle, middle + quarter);
    QVERIFY2(kept()->through.x() < less, "farther to the right more is cut away");
    click(hits.flip.center(), hits.flip.center());
    QVERIFY(kept()->flipped && view()->section()->plane.normal == Vector3(1, 0, 0));
    click(hits.ways[3].second.center(), hits.ways[3].second.center());
    QCOMPARE(kept()->across, std::string("z"));

    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY(!kept() && !view()->section() && !m_window->action(QStringLiteral("view.section"))->isChecked());
    paint();
    QVERIFY(!document().project().view.section);
    QVERIFY(!view()->shownLook().section && view()->overlayHits().section.strip.isEmpty());
    act("view.sectionZ");
    act("view.section");
    QVERIFY(!kept());
    QCOMPARE(document().undoStack().count(), steps);
  }

  /// The label names a direction only as long as one looks from there.
  void theAxisBallTakesTheNameAway() {
    view()->show(StandardView::Top);
    QVERIFY(view()->navigator().viewName().startsWith(QStringLiteral("Top")));
    view()->frameAll();
    QVERIFY(view()->navigator().viewName().startsWith(QStringLiteral("Top")));
    view()->update();
    const auto end = [this](double azimuth) {
      for (const auto& axis : view()->overlayHits().axes) {
        if (axis.azimuth == azimuth) return axis.rect;
      }
      return QRectF();
    };
    // Painted from above, where the ends of x lie apart.
    QTRY_VERIFY_WITH_TIMEOUT(!end(90).isEmpty() && !end(90).intersects(end(-90)), kLong);
    QTest::mouseClick(view(), Qt::LeftButton, {}, end(90).center().toPoint());
    QCOMPARE(view()->navigator().camera().azimuth, 90.0);
    QCOMPARE(view()->navigator().viewName(), QStringLiteral("Perspective"));
  }

  /// Of the row at hand, while the tree has the focus.
  void theOutlinerShowsItsFocus() {
    m_window->selection().select(OutlineKind::Body, "ice");
    auto* tree = m_window->outliner()->findChild<QTreeView*>();
    const QColor accent = Theme::current()[Token::Accent];
    const auto ringed = [&] {
      const QRect row = tree->visualRect(tree->currentIndex());
      const QImage picture = tree->viewport()->grab().toImage();
      return picture.pixelColor((QPointF(row.center().x(), row.top() + 1) * picture.devicePixelRatio()).toPoint()) ==
             accent;
    };
    tree->setFocus(Qt::TabFocusReason);
    QTRY_VERIFY(tree->hasFocus());
    QVERIFY(ringed());
    view()->setFocus();
    QVERIFY(!ringed());
  }

  /// "Solid" would be what it is made of.
  void aBodyIsCalledByItsShape() {
    m_window->action(QStringLiteral("add.cylinder"))->trigger();
    const auto parts = m_window->inspector().bodyPanel()->findChildren<QWidget*>();
    const auto header = std::find_if(parts.begin(), parts.end(), [](const QWidget* part) {
      return part->accessibleName() == QStringLiteral("Cylinder");
    });
    QVERIFY(header != parts.end());
    QCOMPARE((*header)->accessibleDescription(), QStringLiteral("Water · cylinder"));
  }

  void eyeAndLockWithoutAMouse() {
    m_window->selection().select(OutlineKind::Body, "ice");
    m_window->action(QStringLiteral("edit.visible"))->trigger();
    QVERIFY(!document().body("ice")->visible);
    m_window->action(QStringLiteral("edit.locked"))->trigger();
    QVERIFY(document().body("ice")->locked);
    m_window->action(QStringLiteral("edit.visible"))->trigger();
    m_window->action(QStringLiteral("edit.locked"))->trigger();
    QVERIFY(document().body("ice")->visible && !document().body("ice")->locked);
    QCOMPARE(document().undoStack().count(), 4);
    m_window->selection().select(OutlineKind::Wall, "floor");
    m_window->action(QStringLiteral("edit.visible"))->trigger();
    m_window->action(QStringLiteral("edit.locked"))->trigger();
    QVERIFY(!document().wall("floor")->visible && document().wall("floor")->locked);
    QCOMPARE(document().undoStack().count(), 6);
    document().undoStack().undo();
    document().undoStack().undo();
    QVERIFY(document().wall("floor")->visible && !document().wall("floor")->locked);
  }

  void toolAndMaterialAreTold() {
    const auto value = [](QWidget* widget) {
      return QAccessible::queryAccessibleInterface(widget)->text(QAccessible::Value);
    };
    QCOMPARE(value(view()), QStringLiteral("Select and orbit"));
    m_window->tools().activate("brush");
    QVERIFY2(value(view()).startsWith(QStringLiteral("Brush, sphere, radius 50 mm, Water")), qPrintable(value(view())));
    QCOMPARE(value(m_window->findChild<MaterialsPanel*>()), QStringLiteral("Water"));
  }

  void csvHasEveryFrame() {
    std::vector<FrameStats> history(2);
    history[0].temperatureMean = 263.15;
    const auto probe = [](const char* id, const char* name, const char* quantity) {
      Probe made;
      made.id = id, made.name = name, made.quantity = quantity;
      return made;
    };
    const std::vector<Probe> probes{probe("a", "Ice, core", "temperature"), probe("b", "n", "count")};
    history[0].probes = {1.0 / 3, std::nan("")};
    history[0].measured = std::make_shared<const std::vector<Probe>>(probes);
    history[1].time = 0.1;
    history[1].phases[2].mass = 2.5;
    history[1].probes = {280, 0.5};  // the first measured something else then
    history[1].measured = std::make_shared<const std::vector<Probe>>(
        std::vector<Probe>{probe("a", "Ice, core", "temperature_max"), probes[1]});
    const QByteArray csv = historyCsv(history, probes, ParticleFields());
    QCOMPARE(csv, QByteArray("time_s,thermal_time_s,mean.temperature[K],solid.mass[kg],melting.mass[kg],"
                             "liquid.mass[kg],boiling.mass[kg],gas.mass[kg],\"Ice, core.temperature[K]\",n.count[1]\n"
                             "0,0,263.15,0,0,0,0,0,0.3333333333333333,\n"
                             "0.1,0,0,0,0,2.5,0,0,,0.5\n"));
  }

  /// Undo while the button is down: the stroke in the making goes, the one before goes, and both stay gone.
  void undoDuringAStroke() {
    const std::set<uint32_t> before = idsNow(session());
    const size_t bodies = document().project().bodies.size();
    m_window->action(QStringLiteral("sketch.brush"))->trigger();
    const QPoint start(view()->width() / 2 - 60, view()->height() / 2);
    stroke(start, {72, 0}, true);
    QCOMPARE(document().project().bodies.size(), bodies + 1);
    stroke(start + QPoint(0, 20), {72, 0}, false);
    QVERIFY(idsNow(session()).size() > before.size());
    m_window->action(QStringLiteral("edit.undo"))->trigger();
    QTest::mouseMove(view(), start + QPoint(90, 20));
    QTest::mouseRelease(view(), Qt::LeftButton, {}, start + QPoint(90, 20));
    QCOMPARE(document().project().bodies.size(), bodies);
    QVERIFY(document().undoStack().canRedo());
    QVERIFY(idsNow(session()) == before);
  }

  void strokesAreRefused_data() {
    QTest::addColumn<double>("spacing");
    QTest::addColumn<bool>("reset");
    QTest::addColumn<double>("radius");
    QTest::addColumn<QString>("why");
    QTest::newRow("another spacing waits for the reset") << 0.03 << false << 0.05 << "Press Home first";
    QTest::newRow("it came") << 0.03 << true << 0.05 << "";
    QTest::newRow("a stamp of too many cells") << 0.02 << false << 0.5 << "Make the brush smaller";
  }
  void strokesAreRefused() {
    QFETCH(double, spacing);
    QFETCH(bool, reset);
    QFETCH(double, radius);
    QFETCH(QString, why);
    document().setParameter(kSpacing, spacing);
    if (reset) toTheStart();
    const std::set<uint32_t> before = idsNow(session());
    const int steps = document().undoStack().count();
    m_window->action(QStringLiteral("sketch.brush"))->trigger();
    BrushSettings brush = m_window->tools().brush();
    const double usual = brush.radius;
    brush.radius = radius;
    m_window->tools().setBrush(brush);
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    stroke(QPoint(view()->width() / 2 - 60, view()->height() / 2), {40, 0}, true);
    QCOMPARE(idsNow(session()) == before, !why.isEmpty());
    QCOMPARE(document().undoStack().count() == steps, !why.isEmpty());
    QStringList told;  // "" takes away what was said before
    for (const QList<QVariant>& said : refused) told << said[1].toString();
    told.removeAll(QString());
    QCOMPARE(told.size(), why.isEmpty() ? 0 : 1);
    if (!why.isEmpty()) QVERIFY2(told[0].contains(why), qPrintable(told[0]));
    brush.radius = usual;
    m_window->tools().setBrush(brush);
  }

 private:
  /// The dock with that page in front, the page in the middle, or the dialog; nullptr where it did not come.
  const QWidget* areaOf(const QString& page) {
    const auto trigger = [this](const char* action) { m_window->action(QLatin1String(action))->trigger(); };
    if (page == QLatin1String("Plugins")) {
      trigger("help.plugins");
      return m_window->pluginPage();
    }
    if (page == QLatin1String("Library")) {
      trigger("add.library");
      return m_window->library().page();
    }
    if (page == QLatin1String("Welcome")) {
      trigger("help.welcome");
      return m_window->findChild<QWidget*>(QStringLiteral("psWelcome"));
    }
    if (page == QLatin1String("Preferences")) {
      trigger("edit.preferences");
      return m_window->findChild<QDialog*>(QStringLiteral("psPreferences"));
    }
    Dock* dock = m_window->layoutOfDocks().dockOf(page);
    for (const DockRow& row : dockTable()) {
      if (!dock || dock->objectName() != QLatin1String(row.name)) continue;
      constexpr std::array kTabs{
          std::pair(Workspace::Scene, MainWindow::kSceneTab), std::pair(Workspace::Tune, MainWindow::kTuneTab),
          std::pair(Workspace::Sketch, MainWindow::kSketchTab), std::pair(Workspace::Film, MainWindow::kFilmTab)};
      for (const auto& [workspace, tab] : kTabs) {
        if (workspace == row.workspaces.front()) m_window->showWorkspace(tab);
      }
    }
    if (page == QLatin1String("Brush")) m_window->tools().activate("brush");
    m_window->layoutOfDocks().showPage(page);
    dock = m_window->layoutOfDocks().dockOf(page);  // materials may be in another one now
    return dock && dock->currentPage() == page ? dock : nullptr;
  }
  /// What Tab stops at in an area, in its order.
  static std::vector<QWidget*> stopsIn(const QWidget& area) {
    std::vector<QWidget*> stops;
    const QWidget* window = area.window();
    for (QWidget* at = window->nextInFocusChain(); at != window; at = at->nextInFocusChain()) {
      if (area.isAncestorOf(at) && (at->focusPolicy() & Qt::TabFocus) && at->isVisible() && at->isEnabled() &&
          !at->focusProxy())
        stops.push_back(at);
    }
    return stops;
  }
  QMenu* viewMenu() {
    for (const QAction* menu : m_window->findChild<QMenuBar*>()->actions()) {
      if (menu->text() == QStringLiteral("View")) return menu->menu();
    }
    return nullptr;
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestInteraction test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_interaction.moc"
