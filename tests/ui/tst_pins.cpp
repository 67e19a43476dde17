// SPDX-License-Identifier: Apache-2.0
// Pins in the real window: put on a body, copied from one to another, deleted, each as one step there and back.
#include "core/io/projectio.h"
#include "core/scene/pose.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/pinaddress.h"
#include "ui/panels/outliner.h"
#include "ui/session/pinexcerpt.h"
#include "ui/session/selection.h"

#include <QtGui/QAction>
#include <QtGui/QClipboard>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <cmath>

using namespace ps;

class TestPins : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    QVERIFY(m_window);
    session().pause();
    QTest::keyClick(m_window.get(), Qt::Key_Escape);
  }
  void init() {
    backToTheStart();
    m_window->selection().clear();
    view()->setFocus();
  }
  void cleanupTestCase() { m_window.reset(); }

  /// By its topmost layers; of matter those that stand in the box stay where they are.
  void aPinIsAdded() {
    const std::string before = text();
    trigger("edit.pin");
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("Select the body")),
             qPrintable(m_window->notice()->text()));
    QCOMPARE(text(), before);
    m_window->selection().selectBody(kIce);
    trigger("edit.pin");
    QCOMPARE(pins().size(), size_t{1});
    QVERIFY(m_window->selection().has(OutlineKind::Pin, "ice/0"));
    const BodyBounds box = boundsOf(*document().body(kIce));
    QVERIFY(pins()[0].contains({box.middle().x(), box.maximum.y(), box.middle().z()}));
    QVERIFY(!pins()[0].contains(box.middle()));
    const size_t free = held();
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(held() > free, kLong);
    const std::string after = text();
    QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(text(), before);
    QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QCOMPARE(text(), after);
  }

  /// The key takes the chosen one alone, and then means no other.
  void deleteTakesThePin() {
    threePins();
    const std::string before = text();
    const Region second = pins()[1], third = pins()[2];
    m_window->selection().selectAll({{OutlineKind::Pin, "ice/0"}});
    QTest::keyClick(view(), Qt::Key_Delete);
    QCOMPARE(pins(), (std::vector<Region>{second, third}));
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("deletion of a pin of Ice block"));
    QCOMPARE(m_window->selection().items(), (std::vector<SelectedItem>{{OutlineKind::Body, kIce}}));
    QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(text(), before);
    m_window->selection().selectAll({{OutlineKind::Pin, "ice/0"}, {OutlineKind::Pin, "ice/2"}});
    QTest::keyClick(view(), Qt::Key_Delete);
    QCOMPARE(pins(), std::vector<Region>{second});
    document().undoStack().undo();
    // A locked body keeps its pins.
    document().setLocked({{Owner::Body, kIce, ""}}, true);
    m_window->selection().selectAll({{OutlineKind::Pin, "ice/1"}});
    QTest::keyClick(view(), Qt::Key_Delete);
    QCOMPARE(pins().size(), size_t{3});
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("locked")));
  }

  /// Each has a row below its body's, by which it is selected and deleted.
  void pinsHaveRows() {
    threePins();
    QTreeView* tree = m_window->outliner()->view();
    const auto rowOf = [&](const char* id) {
      const QModelIndexList found = tree->model()->match(tree->model()->index(0, 0), outline::kId, QLatin1String(id), 1,
                                                         Qt::MatchExactly | Qt::MatchRecursive);
      return found.isEmpty() ? QModelIndex() : found.front();
    };
    const QModelIndex second = rowOf("ice/1");
    QVERIFY(second.isValid());
    QCOMPARE(second.data().toString(), QStringLiteral("Pin 2"));
    QCOMPARE(second.parent().data(outline::kId).toString(), QLatin1String(kIce));
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualRect(second).center());
    QCOMPARE(m_window->selection().items(), (std::vector<SelectedItem>{{OutlineKind::Pin, "ice/1"}}));
    QTest::keyClick(tree, Qt::Key_Delete);
    QCOMPARE(pins().size(), size_t{2});
    QVERIFY(rowOf("ice/1").isValid() && !rowOf("ice/2").isValid());
    document().undoStack().undo();
    QVERIFY(rowOf("ice/2").isValid());
  }

  /// A body that goes takes its pins along; both come back by one step.
  void aBodyAndAPinGoTogether() {
    threePins();
    const std::string before = text();
    m_window->selection().selectAll({{OutlineKind::Body, kIce}, {OutlineKind::Pin, "ice/1"}});
    QTest::keyClick(view(), Qt::Key_Delete);
    QVERIFY(document().project().bodies.empty() && m_window->selection().empty());
    document().undoStack().undo();
    QCOMPARE(text(), before);
  }

  /// On its own body a copy stands beside it, on another one where it held the first.
  void pinsAreCopiedAndCut() {
    m_window->selection().selectBody(kIce);
    trigger("edit.pin");
    const std::string before = text();
    const Region first = pins()[0];
    QTest::keyClick(view(), Qt::Key_C, Qt::ControlModifier);
    QTest::keyClick(view(), Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(pins().size(), size_t{2});
    QVERIFY(pins()[0] == first && std::abs(pins()[1].minimum.x() - first.maximum.x()) < 1e-9);
    QVERIFY(m_window->selection().has(OutlineKind::Pin, "ice/1"));
    QTest::keyClick(view(), Qt::Key_X, Qt::ControlModifier);
    QCOMPARE(text(), before);
    QTest::keyClick(view(), Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(pins().size(), size_t{2});
    QTest::keyClick(view(), Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(pins().size(), size_t{3});
    // To another body.
    m_window->selection().selectAll({{OutlineKind::Pin, "ice/0"}});
    QTest::keyClick(view(), Qt::Key_C, Qt::ControlModifier);
    trigger("add.block");
    const std::string block = document().project().bodies.back().id;
    QTest::keyClick(m_window.get(), Qt::Key_V, Qt::ControlModifier);
    const Body& held = *document().body(block);
    QCOMPARE(held.pins.size(), size_t{1});
    const Vector3 way = boundsOf(held).middle() - boundsOf(*document().body(kIce)).middle();
    QVERIFY((held.pins[0].minimum - first.minimum - way).norm() < 1e-9);
    // Nobody to hold: said.
    m_window->selection().clear();
    const std::string text = this->text();
    QTest::keyClick(m_window.get(), Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(this->text(), text);
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("Select the body")));
    // Numbers that are none are no pins.
    QVERIFY(!pinsIn("{\"pins\": [{\"minimum\": [0, 0], \"maximum\": [1, 1, 1]}]}") && !pinsIn("{}") && !pinsIn("x"));
    QVERIFY(!pinsIn("{\"pins\": [{\"minimum\": [2, 0, 0], \"maximum\": [1, 1, 1]}]}"));
  }

 private:
  static constexpr const char* kIce = "ice";
  std::string text() { return writeProject(document().project()); }
  const std::vector<Region>& pins() { return document().body(kIce)->pins; }
  void trigger(const char* action) { m_window->action(QString::fromLatin1(action))->trigger(); }
  void threePins() {
    m_window->selection().selectBody(kIce);
    for (int k = 0; k < 3; ++k) trigger("edit.pin");
    QCOMPARE(pins().size(), size_t{3});
  }
  /// Particles that are held in place.
  size_t held() {
    return onEngine<size_t>(session(), [](Engine& engine) {
      const ParticleStore& store = engine.solver().particles();
      return static_cast<size_t>(std::count(store.motion(), store.motion() + store.size(), api::Motion::Static));
    });
  }
};

QTEST_MAIN(TestPins)
#include "tst_pins.moc"
