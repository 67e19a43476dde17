// SPDX-License-Identifier: Apache-2.0
// Taps and drains by hands in the real window: placed, selected, dragged, renamed, copied, deleted.
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/portpainter.h"
#include "ui/viewport/viewport.h"
#include "ui/window/noticebar.h"

#include <QtGui/QAction>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

double distance(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

class TestPorts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    m_window = sampleWindow({1000, 700});
    QVERIFY(m_window);
  }

  void init() {
    session().pause();
    while (document().undoStack().canUndo()) document().undoStack().undo();
    const uint64_t revision = session().snapshot()->revision;
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision && view()->snapshot() == session().snapshot(),
                             kLong);
    m_window->tools().activate("select");
    view()->show(StandardView::Scene);
  }

  void cleanupTestCase() { m_window.reset(); }

  void aClickPlacesATapOnTheSurface() {
    QTest::keyClick(view(), Qt::Key_T);
    QCOMPARE(m_window->tools().active(), std::string("tap"));
    QVERIFY(view()->summary().contains(QStringLiteral("tap")));
    QTest::mouseClick(view(), Qt::LeftButton, {}, floorPixel());
    QCOMPARE(project().emitters.size(), size_t{1});
    const Emitter& tap = project().emitters.front();
    QCOMPARE(tap.id, std::string("tap"));
    QCOMPARE(tap.name, std::string("Tap"));
    QCOMPARE(tap.material, m_window->tools().brush().material);
    QCOMPARE(tap.direction, (Vector3{0, 1, 0}));
    QVERIFY(std::abs(tap.point[1] - 0.5 * session().snapshot()->spacing) < 1e-9);
    QCOMPARE(m_window->tools().active(), std::string("select"));
    QCOMPARE(m_window->selection().port(), (Port{false, "tap"}));
    QCOMPARE(outliner()->selected(), std::pair(OutlineKind::Emitter, std::string("tap")));
    QVERIFY(m_window->inspector().scenePanel()->row(QStringLiteral("emitter/tap/speed")));
    QCOMPARE(document().undoStack().count(), 1);
    // It pours.
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.flow.poured.count > 0, kLong);
    document().undoStack().undo();
    QVERIFY(project().emitters.empty() && !m_window->selection().port());
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.flow.held.count, uint64_t{0}, kLong);
    document().undoStack().redo();
    QCOMPARE(project().emitters.size(), size_t{1});
  }

  /// Of a body one sees nothing while it is hidden, and of what a tap has poured neither.
  void whatAHiddenTapHasPouredIsHidden() {
    const std::string tap = placedTap().id;
    onEngine<bool>(session(), [](Engine& engine) {
      for (int frame = 0; frame < 20; ++frame) engine.step();
      return true;
    });
    session().step();
    const auto poured = [&](const SnapshotPtr& shown) {
      const auto& ids = *shown->bodyIds;
      const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), tap) - ids.begin());
      return std::count(shown->body.begin(), shown->body.end(), index);
    };
    QTRY_VERIFY_WITH_TIMEOUT(poured(view()->snapshot()) > 0, kLong);
    const auto whole = session().snapshot()->id.size();
    document().setVisible({{Owner::Emitter, tap, ""}}, false);
    QVERIFY(poured(view()->snapshot()) == 0);
    QVERIFY(!view()->snapshot()->id.empty());  // the block is still seen
    QCOMPARE(session().snapshot()->id.size(), whole);
    document().undoStack().undo();
    QVERIFY(poured(view()->snapshot()) > 0);
  }

  void draggedUpATapPoursDown() {
    Emitter tap = placedTap();
    QCOMPARE(tap.direction, (Vector3{0, -1, 0}));
    QVERIFY(tap.point[1] > 0.1);
  }

  void aTapOnMatterPoursAwayFromIt() {
    const auto pixel = pixelOf({0, 0.3, 0});  // the ice block is below
    m_window->tools().activate("tap");
    for (int y = 0; y < view()->height(); ++y) {
      const QPoint at(pixel.x(), y);
      if (!pickParticle(*view()->snapshot(), view()->navigator().camera(), view()->width(), view()->height(), at.x(),
                        at.y()))
        continue;
      QTest::mouseClick(view(), Qt::LeftButton, {}, at + QPoint(0, 12));
      break;
    }
    QCOMPARE(project().emitters.size(), size_t{1});
    QVERIFY(project().emitters.front().direction[1] > 0.5);
    QVERIFY(project().emitters.front().point[1] > 0.02);
  }

  void aDrainStandsOnTheSurfaceAndTakesMatter() {
    m_window->action(QStringLiteral("sketch.drain"))->trigger();
    QCOMPARE(m_window->tools().active(), std::string("drain"));
    drag(floorPixel(), {90, 0}, true);
    QCOMPARE(project().sinks.size(), size_t{1});
    const Sink drain = project().sinks.front();
    QCOMPARE(m_window->selection().port(), (Port{true, "drain"}));
    const double edge = drain.maximum[0] - drain.minimum[0];
    QVERIFY(edge > 10.5 * session().snapshot()->spacing);  // wider than a click makes it
    QCOMPARE(outliner()->selected(), std::pair(OutlineKind::Sink, std::string("drain")));
    placedTap();  // above it
    const FlowTotal flow = onEngine<FlowTotal>(session(), [](Engine& engine) {
      for (int frame = 0; frame < 40; ++frame) engine.step();
      return engine.stats().flow;
    });
    QVERIFY(flow.poured.count > 100 && flow.drained.count > 0);
  }

  void aDragMovesATapInOneStep() {
    const Emitter tap = placedTap();
    const int steps = document().undoStack().count();
    const QPoint at = pixelOf(tap.point);
    QCOMPARE(view()->portHandleAt(at)->part, PortHandle::Part::Whole);
    drag(at, {60, 0}, true);
    const Emitter moved = project().emitters.front();
    QVERIFY(distance(moved.point, tap.point) > 0.01);
    QCOMPARE(moved.point[1], tap.point[1]);  // along the plane that one draws on

    QVERIFY((pixelOf(moved.point) - at - QPoint(60, 0)).manhattanLength() <= 2);
    QCOMPARE(document().undoStack().count(), steps + 1);
    const Vector3 lives =
        onEngine<Vector3>(session(), [](Engine& engine) { return engine.project().emitters.front().point; });
    QCOMPARE(lives, moved.point);
    document().undoStack().undo();
    QCOMPARE(project().emitters.front().point, tap.point);
    drag(at, {0, 30}, true, Qt::ShiftModifier);
    QVERIFY(project().emitters.front().point[1] < tap.point[1]);
    QCOMPARE(project().emitters.front().point[0], tap.point[0]);
  }

  void escapeTakesADragBack() {
    const Emitter tap = placedTap();
    const int steps = document().undoStack().count();
    drag(pixelOf(tap.point), {60, 0}, false);
    QVERIFY(project().emitters.front().point != tap.point);
    QTest::keyClick(view(), Qt::Key_Escape);
    QCOMPARE(project().emitters.front().point, tap.point);
    QCOMPARE(document().undoStack().count(), steps);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, pixelOf(tap.point));
    QCOMPARE(project().emitters.front().point, tap.point);
  }

  void theArrowTurnsTheJet() {
    const Emitter tap = placedTap();
    const QPoint tip = pixelOf(arrowTip(tap, leastJet(view()->navigator().camera(), view()->height(), tap.point)));
    QCOMPARE(view()->portHandleAt(tip)->part, PortHandle::Part::Tip);
    drag(tip, {50, -25}, true);
    const Emitter& turned = project().emitters.front();
    QCOMPARE(turned.point, tap.point);
    QVERIFY(turned.direction[1] > -0.95);
    QVERIFY(std::abs(distance(turned.direction, {0, 0, 0}) - 1) < 1e-9);
  }

  void aCornerStretchesADrain() {
    m_window->tools().activate("drain");
    QTest::mouseClick(view(), Qt::LeftButton, {}, floorPixel());
    const Sink drain = project().sinks.front();
    const QPoint corner = pixelOf(cornerOf(drain, 7));
    const auto handle = view()->portHandleAt(corner);
    QVERIFY(handle && handle->part == PortHandle::Part::Corner);
    drag(corner, {20, -30}, true);
    const Sink& larger = project().sinks.front();
    QVERIFY(larger.maximum[1] > drain.maximum[1]);
    QCOMPARE(larger.minimum[1], drain.minimum[1]);
    document().undoStack().undo();
    QCOMPARE(project().sinks.front().maximum, drain.maximum);
  }

  void theyAreRenamedCopiedAndDeleted() {
    placedTap();
    const std::string name = project().emitters.front().name;
    QVERIFY(name.starts_with("Tap"));
    outliner()->view()->setFocus();
    m_window->action(QStringLiteral("edit.rename"))->trigger();
    auto* field = outliner()->view()->findChild<QLineEdit*>();
    QVERIFY(field);
    field->setText(QStringLiteral("Spout"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(project().emitters.front().name, std::string("Spout"));
    QTest::keyClick(view(), Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(project().emitters.size(), size_t{2});
    QCOMPARE(project().emitters.back().name, std::string("Spout 2"));
    QVERIFY(distance(project().emitters.back().point, project().emitters.front().point) > 0.01);
    QCOMPARE(m_window->selection().port(), (Port{false, project().emitters.back().id}));
    view()->setFocus();
    QTest::keyClick(view(), Qt::Key_Delete);
    QCOMPARE(project().emitters.size(), size_t{1});
    QVERIFY(!m_window->selection().port());
    for (int k = 0; k < 2; ++k) document().undoStack().undo();
    QCOMPARE(project().emitters.size(), size_t{1});
    document().undoStack().undo();
    QCOMPARE(project().emitters.front().name, name);
  }

  /// What a tap has poured has no other owner: it goes and comes back with the tap.
  void matterGoesWithItsTap() {
    const std::set<uint32_t> before = idsNow(session());
    const Port tap{false, placedTap().id};
    const auto poured = [this](int frames) {
      return onEngine<uint64_t>(session(), [frames](Engine& engine) {
        for (int frame = 0; frame < frames; ++frame) engine.step();
        return engine.stats().flow.poured.count;
      });
    };
    const uint64_t count = poured(20);
    QVERIFY(count > 0);
    document().removePort(tap);
    QCOMPARE(idsNow(session()), before);
    document().undoStack().undo();
    QCOMPARE(idsNow(session()).size(), before.size() + count);
    document().undoStack().redo();
    QCOMPARE(idsNow(session()), before);
    document().undoStack().undo();
    document().undoStack().undo();  // placing it
    QCOMPARE(idsNow(session()), before);
  }

  void itsMenuHoldsWhatCanBeDone() {
    placedTap();
    QTreeView* tree = outliner()->view();
    const QPoint at = tree->visualRect(tree->currentIndex()).center();
    Q_EMIT tree->customContextMenuRequested(at);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QStringList texts;
    for (const QAction* action : menu->actions()) texts << action->text();
    menu->close();
    QVERIFY(texts.contains(QStringLiteral("Rename")) && texts.contains(QStringLiteral("Delete")));
    QVERIFY(texts.contains(QStringLiteral("Lock or unlock")));
  }

  void aClickElsewhereSelectsNothing() {
    const Emitter tap = placedTap();
    QTest::mouseClick(view(), Qt::LeftButton, {}, QPoint(30, view()->height() / 2));
    QVERIFY(!m_window->selection().port());
    QTest::mouseClick(view(), Qt::LeftButton, {}, pixelOf(tap.point));
    QCOMPARE(m_window->selection().port(), (Port{false, tap.id}));
  }

  void withoutAMaterialNothingIsPlaced() {
    QCOMPARE(document().removeBody(project().bodies.front().id), QString());
    QCOMPARE(document().removeMaterial("water"), QString());
    m_window->tools().activate("tap");
    QTest::mouseClick(view(), Qt::LeftButton, {}, floorPixel());
    QVERIFY(project().emitters.empty());
    QVERIFY(m_window->findChild<NoticeBar*>()->text().contains(QStringLiteral("no material")));
  }

 private:
  Session& session() { return m_window->session(); }
  Document& document() { return session().document(); }
  const Project& project() { return document().project(); }
  Viewport* view() { return m_window->viewport(); }
  Outliner* outliner() { return m_window->findChild<Outliner*>(); }
  QPoint pixelOf(const Vector3& p) {
    const auto pixel = ps::project(view()->navigator().camera(), view()->width(), view()->height(), p);
    return pixel ? QPoint(qRound((*pixel)[0]), qRound((*pixel)[1])) : QPoint(-1, -1);
  }
  /// On the plate, beside the ice.
  QPoint floorPixel() { return pixelOf({0.22, 0, 0.1}); }
  Emitter placedTap() {
    m_window->tools().activate("tap");
    drag(floorPixel(), {0, -110}, true);
    return project().emitters.at(0);
  }
  void drag(const QPoint& from, const QPoint& way, bool release, Qt::KeyboardModifiers modifiers = {}) {
    hands::press(*view(), from, way, modifiers, modifiers);
    if (release) QTest::mouseRelease(view(), Qt::LeftButton, modifiers, from + way);
  }

  std::unique_ptr<MainWindow> m_window;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestPorts test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_ports.moc"
