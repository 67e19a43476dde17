// SPDX-License-Identifier: Apache-2.0
// What acts at the next reset, while the scene stands paused at its start: it acts at once, and nothing waits.
#include "core/solver/solver.h"
#include "samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/scenelink.h"

#include <QtWidgets/QLabel>

using namespace ps;

namespace {

const Address kSpacing{Owner::Solver, "", "particle_spacing"};

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
    QTRY_VERIFY2_WITH_TIMEOUT(note().startsWith(QStringLiteral("Acts at the next reset")), qPrintable(note()), kLong);
    QVERIFY(!session().appliesAtOnce());
    session().link()->applyWaiting();
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.revision(); }), revision);
    session().reset();
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
  QString note() const {
    const auto* row = m_window->inspector().solverPanel()->row(QString::fromStdString(kSpacing.text()));
    const auto* label = row->findChild<QLabel*>(QStringLiteral("psLimit"));
    return label ? label->text() : QString();
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestStartEdits test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_startedits.moc"
