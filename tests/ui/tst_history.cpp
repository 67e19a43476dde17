// SPDX-License-Identifier: Apache-2.0
// What undo keeps in memory, and that it lets the oldest steps go: in the history itself, in a document, in a window.
#include "tests/shared/scenes.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/document/history.h"
#include "ui/session/preferences.h"
#include "ui/session/scenelink.h"
#include "ui/tools/tooltable.h"

#include <QtGui/QAction>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLabel>

#include <memory>
#include <string>
#include <vector>

using namespace ps;

namespace {

using Block = std::shared_ptr<const std::vector<char>>;
constexpr size_t kMany = size_t{1} << 20;

Block block() { return std::make_shared<const std::vector<char>>(kMany); }

/// Adds a number, and holds on to a block.
class Adding final : public WeighedCommand {
 public:
  Adding(int& sum, int number, Block held, int kind = -1)
      : m_sum(sum), m_number(number), m_held(std::move(held)), m_kind(kind) {}
  void undo() override { m_sum -= m_number; }
  void redo() override { m_sum += m_number; }
  int id() const override { return m_kind; }
  bool mergeWith(const QUndoCommand* other) override {
    m_number += static_cast<const Adding*>(other)->m_number;
    setObsolete(m_number == 0);
    return true;
  }
  void weigh(Weight& weight) const override {
    if (m_held) weight.shared[m_held.get()] = m_held->size();
  }

 private:
  int& m_sum;
  int m_number;
  Block m_held;
  int m_kind;
};

size_t sizeOf(const std::shared_ptr<StrokeRecord>& stroke) {
  return stroke->cells.capacity() * sizeof(stroke->cells[0]);
}

/// Of some cells, as a brush drew them; it changes nothing.
std::shared_ptr<StrokeRecord> strokeOf(size_t cells) {
  auto stroke = std::make_shared<StrokeRecord>();
  stroke->deed = "Heat matter";
  stroke->cells.resize(cells);
  return stroke;
}

}  // namespace

class TestHistory : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  /// Steps, macros, merges and the clean place behave as Qt's do.
  void stepsGoBackAndForth() {
    History history;
    int sum = 0;
    QSignalSpy clean(&history, &History::cleanChanged);
    history.push(new Adding(sum, 1, {}));
    QVERIFY(!history.isClean());
    history.setClean();
    history.beginMacro(QStringLiteral("two"));
    QVERIFY(!history.canUndo() && !history.isClean());
    history.push(new Adding(sum, 10, {}));
    history.beginMacro(QStringLiteral("within"));
    history.push(new Adding(sum, 20, {}));
    history.endMacro();
    history.endMacro();
    QCOMPARE(sum, 31);
    QCOMPARE(history.count(), 2);
    QCOMPARE(history.undoText(), QStringLiteral("two"));
    history.undo();
    QVERIFY(sum == 1 && history.isClean() && history.canRedo());
    history.redo();
    QCOMPARE(sum, 31);
    for (const int number : {2, 3}) history.push(new Adding(sum, number, {}, 7));
    QVERIFY(sum == 36 && history.count() == 3);
    history.push(new Adding(sum, -5, {}, 7));  // it ends where it began
    QVERIFY(sum == 31 && history.count() == 2 && history.index() == 2);
    history.undo();
    history.undo();
    QVERIFY(sum == 0 && !history.canUndo() && history.index() == 0);
    history.push(new Adding(sum, 5, {}));  // what was clean cannot come back
    QVERIFY(history.count() == 1 && history.cleanIndex() == -1 && !history.canRedo());
    QCOMPARE(clean.count(), 7);  // left and come back to, again and again
  }

  /// Above the limit the oldest go, with all that they hold; what is left can be undone, and the last one always.
  void theOldestAreLetGo() {
    History history;
    int sum = 0;
    std::vector<std::weak_ptr<const std::vector<char>>> held;
    QSignalSpy letGo(&history, &History::letGo);
    history.setLimit(4 * kMany + kMany / 2);
    for (int k = 0; k < 10; ++k) {
      Block one = block();
      held.push_back(one);
      history.push(new Adding(sum, 1, std::move(one)));
      if (k == 1) history.setClean();
      QVERIFY(history.bytes() <= history.limit());
    }
    QVERIFY(history.count() == 4 && history.index() == 4 && history.letGoSteps() == 6 && history.position() == 10);
    QVERIFY(letGo.count() > 0 && history.cleanIndex() == -1);
    for (size_t k = 0; k < held.size(); ++k) QCOMPARE(held[k].expired(), k < 6);
    while (history.canUndo()) history.undo();
    QCOMPARE(sum, 6);  // as it was when the oldest that is left was made
    while (history.canRedo()) history.redo();
    QCOMPARE(sum, 10);
    history.setLimit(1);
    QVERIFY(history.count() == 1 && history.canUndo() && !held.back().expired());
    history.clear();
    QVERIFY(held.back().expired() && history.bytes() == 0 && history.letGoSteps() == 0);
  }

  /// What steps share counts once, and what the document holds as well would not come back with them.
  void sharedBlocksCountOnce() {
    History history;
    int sum = 0;
    const Block shared = block();
    for (int k = 0; k < 5; ++k) history.push(new Adding(sum, 1, shared));
    QVERIFY(history.bytes() > kMany && history.bytes() < kMany + 5000);
    history.setDocument([&](Weight& held) { held.shared[shared.get()] = shared->size(); });
    QVERIFY(history.bytes() < 5000);
    history.setLimit(kMany);
    QCOMPARE(history.count(), 5);
    // Redone no more, given back.
    const std::weak_ptr<const std::vector<char>> gone = [&] {
      Block other = block();
      history.push(new Adding(sum, 1, other));
      return other;
    }();
    history.undo();
    QVERIFY(!gone.expired());
    history.push(new Adding(sum, 1, {}));
    QVERIFY(gone.expired() && history.bytes() < 5000);
  }

  /// Each kind of edit that can be large is as heavy as what it holds, and gives it back.
  void editsOfTheDocumentWeigh() {
    Document document;
    document.open(scenes::iceOnPlate(5, 370), {});
    History& history = document.undoStack();
    auto added = [&, last = history.bytes()]() mutable {
      const size_t before = std::exchange(last, history.bytes());
      return history.bytes() - before;
    };
    auto stroke = strokeOf(100000);
    const std::weak_ptr<StrokeRecord> drawn = stroke;
    const std::weak_ptr<const MatterKey> matter = stroke->matter;
    const size_t cells = sizeOf(stroke);
    document.addStroke(std::move(stroke));
    size_t more = added();
    QVERIFY2(more >= cells && more < cells + cells / 10, qPrintable(QString::number(more)));
    auto mesh = std::make_shared<SceneMesh>();
    mesh->id = "large";
    mesh->points.resize(100000);
    mesh->triangles.resize(200000);
    const size_t triangles = 100000 * 12 + 200000 * 12;
    Body body;
    body.shape = SolidShape{{}, "large", std::move(mesh), {}};
    body.id = "rock";
    const std::string rock = document.addBody(std::move(body));
    const std::weak_ptr<const SceneMesh> surface = std::get<SolidShape>(document.body(rock)->shape).mesh;
    QVERIFY(added() < triangles / 2);  // the scene holds it
    document.removeBody(rock);
    more = added();
    QVERIFY2(more >= triangles && more < triangles + triangles / 10, qPrintable(QString::number(more)));
    auto state = std::make_shared<ProjectState>();
    PackedBlock packed;
    packed.data.resize(3000000);
    state->blocks.push_back(packed);
    const std::weak_ptr<const ProjectState> kept = state;
    document.keepState(std::move(state));
    QVERIFY(added() < 100000);
    document.removeState();
    more = added();
    QVERIFY2(more >= 3000000 && more < 3300000, qPrintable(QString::number(more)));
    QVERIFY(!drawn.expired() && !surface.expired() && !kept.expired());
    for (const double t : {350.0, 360.0}) document.setParameter({Owner::Wall, "floor", "temperature"}, t);
    history.setLimit(1);
    QVERIFY(drawn.expired() && matter.expired() && surface.expired() && kept.expired());
    QCOMPARE(history.count(), 1);
    QVERIFY(history.bytes() < 2000);
    history.undo();
    QCOMPARE(std::get<double>(document.value({Owner::Wall, "floor", "temperature"})), 350.0);
  }

  /// A gesture that is taken back leaves nothing, also where the history has let go of steps meanwhile.
  void aGestureIsTakenBackWhole() {
    Document document;
    document.open(scenes::iceOnPlate(5, 370), {});
    const Address floor{Owner::Wall, "floor", "temperature"};
    const auto at = [&] { return std::get<double>(document.value(floor)); };
    document.addStroke(strokeOf(1000));
    document.setParameter(floor, 300.0);
    document.beginGesture();
    for (const double t : {310.0, 320.0}) document.setParameter(floor, t);
    document.undoStack().setLimit(1);
    QCOMPARE(document.undoStack().count(), 1);
    document.takeGestureBack();
    document.endGesture();
    QCOMPARE(at(), 300.0);
    QVERIFY(!document.undoStack().canUndo());
  }

  /// Matter that strokes took out of the running scene lies with the engine: it counts, and goes too. What they did
  /// stays done, and is still told when the project is saved.
  void theEngineLetsMatterGo() {
    open();
    QVERIFY(m_window);
    backToTheStart();
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > 3, kLong);
    session().pause();
    m_window->tools().activate(kEraseTool);
    const QPoint middle = view()->rect().center();
    const int steps = document().undoStack().index();
    for (const int x : {-50, -25, 0, 25}) stroke(middle + QPoint(x, 0), {20, 0}, true);
    QCOMPARE(document().undoStack().index(), steps + 4);
    const auto kept = [this] {
      return onEngine<size_t>(session(), [](Engine& engine) {
        size_t bytes = 0;
        const SnapshotPtr now = engine.snapshot();
        for (const auto& [key, size] : *now->keptForUndo) bytes += size;
        return bytes;
      });
    };
    const size_t before = kept(), particles = idsNow(session()).size();
    QVERIFY2(before > 100000, qPrintable(QString::number(before)));
    QTRY_VERIFY_WITH_TIMEOUT(document().undoStack().bytes() >= before, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(session().link()->strokesOfTheRun(), size_t{4}, kLong);
    document().undoStack().setLimit(1);
    QCOMPARE(document().undoStack().count(), 1);
    const size_t after = kept();
    QVERIFY2(after < before / 2, qPrintable(QStringLiteral("%1 of %2").arg(after).arg(before)));
    QCOMPARE(idsNow(session()).size(), particles);
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > 8, kLong);
    session().pause();
    QTRY_COMPARE_WITH_TIMEOUT(session().link()->strokesOfTheRun(), size_t{4}, kLong);
    document().undoStack().undo();
    QVERIFY(idsNow(session()).size() > particles);
    QTRY_COMPARE_WITH_TIMEOUT(session().link()->strokesOfTheRun(), size_t{3}, kLong);
    session().applyUndoMemory();
    document().open(project(), {});
  }

  /// Where nothing is left to undo the action says why; the preference says how much, and acts at once.
  void theWindowSaysSo() {
    QAction* undo = m_window->action(QStringLiteral("edit.undo"));
    QVERIFY(!undo->isEnabled());
    QCOMPARE(undo->property("whyNot").toString(), QStringLiteral("Nothing to undo"));
    for (int k = 0; k < 3; ++k) document().addStroke(strokeOf(size_t{5} << 20));  // 60 MiB each
    QCOMPARE(document().undoStack().count(), 3);
    m_window->action(QStringLiteral("edit.preferences"))->trigger();
    auto* dialog = m_window->findChild<QDialog*>(QStringLiteral("psPreferences"));
    QVERIFY(dialog);
    const auto* used = dialog->findChild<QLabel*>(QStringLiteral("psUndoUsed"));
    QVERIFY(used);
    QTRY_COMPARE(used->text(), QStringLiteral("190 MB of memory"));
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) dialog->grab().save(folder + QStringLiteral("/history-preferences.png"));
    QComboBox* most = nullptr;
    for (QComboBox* box : dialog->findChildren<QComboBox*>()) {
      if (box->accessibleName() == QStringLiteral("Keeps at most")) most = box;
    }
    QVERIFY(most);
    QCOMPARE(most->currentText(), QStringLiteral("512 MiB"));
    most->setCurrentIndex(most->findText(QStringLiteral("128 MiB")));
    Q_EMIT most->activated(most->currentIndex());
    QCOMPARE(document().undoStack().count(), 2);
    QCOMPARE(preferences::undoMemory(), 128);
    QTRY_COMPARE(used->text(), QStringLiteral("130 MB of memory"));
    dialog->close();
    while (document().undoStack().canUndo()) undo->trigger();
    QVERIFY(!undo->isEnabled());
    QVERIFY2(undo->toolTip().startsWith(QStringLiteral("The step before this one was let go: undo keeps at most 128")),
             qPrintable(undo->toolTip()));
    preferences::setUndoMemory(512);
    session().applyUndoMemory();
    document().addStroke(strokeOf(1));
    QVERIFY(undo->isEnabled() && undo->property("whyNot").toString().isEmpty());
  }
  void cleanupTestCase() { m_window.reset(); }

 private:
  Project project() { return document().project(); }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestHistory test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_history.moc"
