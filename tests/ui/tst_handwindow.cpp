// SPDX-License-Identifier: Apache-2.0
// A spoon from the menu is led through the scene with the mouse, and the status line tells what it feels.
#include "core/geometry/toolbodies.h"
#include "core/scene/pose.h"
#include "samplewindow.h"
#include "ui/render/camera.h"
#include "ui/session/selection.h"
#include "ui/window/statusline.h"

#include <QtGui/QAction>

using namespace ps;

class TestHandWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { beginInTheView(); }
  void cleanupTestCase() { m_window.reset(); }

  void aSpoonIsAddedAndLed() {
    const std::string id = added("spoon");
    const Body before = *document().body(id);
    const Vector3 stood = matterOf(id);
    QVERIFY(std::get<bool>(document().value({Owner::Body, id, "fixed"})));
    QVERIFY(!before.material.empty());
    const int steps = document().undoStack().count();
    session().play();
    QTest::keyClick(view(), Qt::Key_A);
    QCOMPARE(m_window->tools().active(), std::string("hand"));
    const QPoint from = seenAt(id);
    QTest::mousePress(view(), Qt::LeftButton, {}, from);
    for (int k = 1; k <= 12; ++k) {
      QTest::mouseMove(view(), from + QPoint(2 * k, 9 * k));
      QTest::qWait(40);
      if (k == 6) QTest::keyClick(view(), Qt::Key_E);
    }
    QTRY_VERIFY_WITH_TIMEOUT(status()->parts().join(QLatin1Char('|')).contains(QStringLiteral("on Spoon")), kLong);
    picture(QStringLiteral("spoon.png"));
    QTest::mouseRelease(view(), Qt::LeftButton, {}, from + QPoint(24, 108));
    QCOMPARE(document().undoStack().count(), steps + 1);
    const auto move = moveBetween(before, *document().body(id));
    QVERIFY(move && move->turns());
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->tools.at(0).behind == 0, kLong);
    QVERIFY((matterOf(id) - stood).norm() > 0.01);
    document().undoStack().undo();
    QVERIFY(document().body(id)->shape == before.shape);
    QTRY_VERIFY_WITH_TIMEOUT((matterOf(id) - stood).norm() < 1e-4, kLong);  // single precision, after two ways
  }

  void eachToolHasAnEntry_data() {
    QTest::addColumn<QString>("name");
    for (const ToolForm& form : toolForms()) QTest::newRow(form.id) << QString::fromLatin1(form.id);
  }
  void eachToolHasAnEntry() {
    QFETCH(QString, name);
    const size_t particles = session().snapshot()->id.size();
    const std::string id = added(name);
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot()->id.size() > particles + 20, kLong);
    picture(QStringLiteral("tool-%1.png").arg(name));
    document().undoStack().undo();
    QVERIFY(!document().body(id));
  }

 private:
  StatusLine* status() { return m_window->findChild<StatusLine*>(); }
  std::string added(const QString& name) {
    const size_t bodies = document().project().bodies.size();
    m_window->action(QStringLiteral("add.tool.") + name)->trigger();
    if (document().project().bodies.size() != bodies + 1) return {};
    return document().project().bodies.back().id;
  }
  /// m, the mean of its particles.
  Vector3 matterOf(const std::string& id) {
    return onEngine<Vector3>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.solver().particles();
      const std::vector<std::string>& ids = engine.bodyIds();
      Vector3 sum(0, 0, 0);
      double count = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (ids[store.body()[i]] != id) continue;
        sum += vectorOf(store.position()[i]);
        ++count;
      }
      return Vector3(sum / count);
    });
  }
  /// A pixel of the view under which matter of a body lies, once it is shown.
  QPoint seenAt(const std::string& id) {
    QPoint found;
    const bool shown = QTest::qWaitFor(
        [&] {
          const SnapshotPtr now = view()->snapshot();
          for (int y = 4; now && y < view()->height(); y += 6) {
            for (int x = view()->width() / 4; x < 3 * view()->width() / 4; x += 6) {
              const auto hit =
                  pickParticle(*now, view()->navigator().camera(), view()->width(), view()->height(), x, y);
              if (!hit || (*now->bodyIds)[now->body[*hit]] != id) continue;
              found = QPoint(x, y);
              return true;
            }
          }
          return false;
        },
        kLong);
    return shown ? found : QPoint();
  }
};

QTEST_MAIN(TestHandWindow)
#include "tst_handwindow.moc"
