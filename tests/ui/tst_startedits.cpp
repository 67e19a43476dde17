// SPDX-License-Identifier: Apache-2.0
// What acts at the next reset, while the scene stands paused at its start: it acts at once, and nothing waits.
#include "core/solver/solver.h"
#include "samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/scenelink.h"
#include "ui/session/selection.h"
#include "ui/tools/tooltable.h"

#include <QtGui/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <cmath>

using namespace ps;

namespace {

const Address kSpacing{Owner::Solver, "", "particle_spacing"}, kStructure{Owner::Body, "ice", kStructureKey};

}  // namespace

class TestStartEdits : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanupTestCase() { m_window.reset(); }

  void aSpacingActsAtOnce() {
    const size_t before = idsNow(session()).size();
    const double spacing = std::get<double>(document().value(kSpacing));
    QCOMPARE(document().setParameter(kSpacing, 1.5 * spacing), QString());
    QCOMPARE(note(), QString());  // none comes and goes
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->spacing > 1.4 * spacing, kLong);
    QVERIFY(idsNow(session()).size() < before);
    QVERIFY(!session().playing());
    QCOMPARE(session().newest()->stats.frame, uint64_t{0});
    QCOMPARE(note(), QString());
    document().undoStack().undo();
    QTRY_COMPARE_WITH_TIMEOUT(idsNow(session()).size(), before, kLong);
  }

  /// Values of a drag: the scene is made for the last of them.
  void aDragMakesTheSceneForItsEnd() {
    const double spacing = std::get<double>(document().value(kSpacing));
    document().beginGesture();
    for (const double times : {1.1, 1.2, 1.5}) QCOMPARE(document().setParameter(kSpacing, times * spacing), QString());
    document().endGesture();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->spacing > 1.45 * spacing, kLong);
  }

  /// Who plays right away plays what was set.
  void playDoesNotOvertakeIt() {
    const double spacing = std::get<double>(document().value(kSpacing));
    QCOMPARE(document().setParameter(kSpacing, 1.5 * spacing), QString());
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > 0 && session().newest()->spacing > 1.4 * spacing, kLong);
    QVERIFY(session().playing());
  }

  void afterTheStartItWaits() {
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame == 1, kLong);
    const uint64_t revision = session().newest()->revision;
    QCOMPARE(document().setParameter(kSpacing, 1.5 * std::get<double>(document().value(kSpacing))), QString());
    QTRY_VERIFY2_WITH_TIMEOUT(note().startsWith(QStringLiteral("Acts once back at the start")), qPrintable(note()),
                              kLong);
    QVERIFY(!session().appliesAtOnce());
    session().link()->applyWaiting();
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.revision(); }), revision);
    session().reset();
    QTRY_COMPARE_WITH_TIMEOUT(note(), QString(), kLong);
  }

  /// What is no number acts as well: how a body is held together, what it is made of, where it is pinned.
  void aCompositionActsAtOnce() {
    const uint64_t start = startHash();
    QCOMPARE(document().setParameter(kStructure, std::string(kNoStructure)), QString());
    const uint64_t loose = afterTheNextMaking();
    QVERIFY(loose != start);
    document().undoStack().undo();
    QCOMPARE(afterTheNextMaking(), start);
    m_window->selection().selectBody("ice");
    m_window->action(QStringLiteral("edit.pin"))->trigger();
    QVERIFY(afterTheNextMaking() != start);
    document().renameBody("ice", QStringLiteral("Cube"));
    const uint64_t revision = session().newest()->revision;
    QTest::qWait(300);  // twice as long as a drag rests
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.revision(); }), revision);
  }

  void afterTheStartACompositionWaits() {
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame == 1, kLong);
    m_window->selection().selectBody("ice");
    QCOMPARE(document().setParameter(kStructure, std::string(kNoStructure)), QString());
    QTRY_VERIFY2_WITH_TIMEOUT(structureNote().startsWith(QStringLiteral("Acts once back at the start")),
                              qPrintable(structureNote()), kLong);
    document().undoStack().undo();
    QTRY_COMPARE_WITH_TIMEOUT(structureNote(), QString(), kLong);
  }

  /// What is painted at the start plays as it does when the project is opened again.
  void paintedMatterIsMadeFromTheProject() {
    document().addMaterial("iron");
    BrushSettings brush = m_window->tools().brush();
    brush.material = "iron";
    m_window->tools().setBrush(brush);
    m_window->action(QStringLiteral("sketch.shape.paint"))->trigger();
    QTest::qWait(600);  // what the test before has undone is made by then
    const uint64_t start = startHash(), revision = session().newest()->revision;
    // The hand rests amid the stroke for longer than a drag does: nothing of it is lost.
    const double spacing = std::get<double>(document().value(kSpacing));
    for (const double times : {1.5, 1.0}) QCOMPARE(document().setParameter(kSpacing, times * spacing), QString());
    stroke(QPoint(view()->width() / 2 - 40, view()->height() / 2), {80, 0}, false);
    QTest::qWait(300);
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.revision(); }), revision);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, QPoint(view()->width() / 2 + 40, view()->height() / 2));
    const uint64_t painted = afterTheNextMaking();
    QVERIFY(painted != start);
    toTheStart();
    QCOMPARE(startHash(), painted);
    document().undoStack().undo();
    QCOMPARE(afterTheNextMaking(), start);
  }

  /// The run goes on with what it has, the row says what would come, and the way back to the start brings it.
  void aSpacingTypedWhileItRunsSaysSo() {
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > 0 && !session().appliesAtOnce(), kLong);
    const uint64_t revision = session().newest()->revision;
    QVERIFY(m_window->revealParameter(kSpacing));
    ParameterRow* row = m_window->inspector().solverPanel()->row(QString::fromStdString(kSpacing.text()));
    QVERIFY(row);
    row->startTyping();
    auto* field = row->findChild<QLineEdit*>();
    QVERIFY(field);
    QTest::keyClicks(field, QStringLiteral("25 mm"));
    QTest::keyClick(field, Qt::Key_Return);
    QVERIFY(std::abs(std::get<double>(document().value(kSpacing)) - 0.025) < 1e-9);
    QTRY_VERIFY2_WITH_TIMEOUT(note().startsWith(QStringLiteral("Acts once back at the start: ")), qPrintable(note()),
                              kLong);
    QVERIFY2(note().contains(QStringLiteral("Back to the start")), qPrintable(note()));
    QVERIFY(session().playing());
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.revision(); }), revision);
    m_window->action(QStringLiteral("simulation.reset"))->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->spacing > 0.024, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(note(), QString(), kLong);
  }

  /// Making the scene was given up: what was set waits, and says so.
  void whatWasGivenUpWaits() {
    QCOMPARE(document().setParameter(kSpacing, 1.5 * std::get<double>(document().value(kSpacing))), QString());
    EngineEvent cancelled;
    cancelled.kind = EngineEvent::Kind::Cancelled;
    session().link()->hear(cancelled);
    Q_EMIT session().happened(cancelled);
    QVERIFY(!session().appliesAtOnce());
    const uint64_t revision = session().newest()->revision;
    QTest::qWait(300);  // twice as long as a drag rests
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.revision(); }), revision);
    session().reset();
    QVERIFY(session().appliesAtOnce());
  }

 private:
  QString note() const { return noteOf(*m_window->inspector().solverPanel(), kSpacing); }
  QString structureNote() const { return noteOf(*m_window->inspector().bodyPanel(), kStructure); }
  static QString noteOf(const ParameterPanel& panel, const Address& address) {
    const auto* row = panel.row(QString::fromStdString(address.text()));
    const auto* label = row ? row->findChild<QLabel*>(QStringLiteral("psLimit")) : nullptr;
    return label ? label->text() : QString();
  }
  uint64_t startHash() {
    return onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stateHash(); });
  }
  /// The hash of a scene that is made by what was set, without anybody asking for it.
  uint64_t afterTheNextMaking() {
    const uint64_t revision = session().newest()->revision;
    const auto made = [&] { return session().newest()->revision != revision && session().newest()->bodyIds; };
    if (!QTest::qWaitFor(made, kLong)) return 0;
    return startHash();
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestStartEdits test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_startedits.moc"
