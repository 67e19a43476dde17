// SPDX-License-Identifier: Apache-2.0
// The whisk of plugins/examples in the window: a key, rows, undo and favourites by what it declares alone.
#include "samplewindow.h"
#include "ui/panels/brushpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/preferences.h"
#include "ui/tools/favouritebrush.h"
#include "ui/tools/tooltable.h"
#include "ui/window/favouritebrushes.h"

#include <QtCore/QTemporaryDir>

#include <cmath>

using namespace ps;

class TestExampleBrush : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    const QString file = QStringLiteral("example_whisk.so");
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QLatin1Char('/') + file, m_folder.filePath(file)));
    m_window = sampleWindow({1280, 800}, {m_folder.path().toStdString()});
    QVERIFY(m_window);
  }
  void init() {
    beginInTheView();
    QTest::keyClick(view(), Qt::Key_J);
  }
  void cleanupTestCase() { m_window.reset(); }

  void itsKeyTakesIt() {
    QCOMPARE(m_window->tools().brush().shape, std::string(kWhisk));
    QVERIFY(m_window->tools().tool().usesBrush() && m_window->tools().touchesMatter());
  }

  void itsParametersAreRows() {
    auto* panel = m_window->findChild<BrushPanel*>();
    // Of 300 W where heat is as fast as it really is; here it is 2000 times as fast.
    for (const auto& [key, label, value] :
         {std::tuple("power", "Power", 0.15), std::tuple("speed", "Turns", 6 * std::acos(-1.0))}) {
      const ParameterRow* row = panel->row(QStringLiteral("brush/") + QString::fromLatin1(key));
      QVERIFY2(row, key);
      QCOMPARE(QString::fromUtf8(row->model().declaration.label), QString::fromLatin1(label));
      QVERIFY2(std::abs(row->number() / value - 1) < 1e-9, qPrintable(QString::number(row->number())));
    }
    setPower(2000);
    QCOMPARE(panel->row(QStringLiteral("brush/power"))->number(), 2000.0);
    setPower(300);
  }

  void undoTakesBackItsHeat() {
    setPower(2000);
    const double before = heaters();
    const int steps = document().undoStack().index();
    const QPoint ice = view()->rect().center();
    session().play();
    QTest::mousePress(view(), Qt::LeftButton, {}, ice);
    QTRY_VERIFY_WITH_TIMEOUT(heaters() > before + 10, kLong);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, ice);
    session().pause();
    QTRY_COMPARE_WITH_TIMEOUT(document().undoStack().index(), steps + 1, kLong);
    QVERIFY(document().undoStack().undoText().contains(QStringLiteral("Whisk")));
    const double heated = heaters() - before;
    document().undoStack().undo();
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(heaters() - before) < 1e-3 * heated, kLong);
    setPower(300);
  }

  /// As JSON, under its own keys.
  void favouritesKeepWhatItDeclares() {
    preferences::setFavouriteBrushes({});
    setPower(1200);
    m_window->favourites().keep();
    const std::vector<FavouriteBrush> kept = m_window->favourites().all();
    QCOMPARE(kept.size(), size_t{1});
    QCOMPARE(kept[0].brush.shape, std::string(kWhisk));
    QVERIFY(preferences::favouriteBrushes().contains("\"power\""));
    setPower(300);
    m_window->favourites().take(kept[0]);
    QCOMPARE(m_window->findChild<BrushPanel*>()->row(QStringLiteral("brush/power"))->number(), 1200.0);
    setPower(300);
    preferences::setFavouriteBrushes({});
  }

 private:
  static constexpr const char* kWhisk = "org.example.whisk";

  void setPower(double watts) {
    BrushSettings brush = m_window->tools().brush();
    brush.parameters[kWhisk].values["power"] = watts;
    m_window->tools().setBrush(brush);
  }
  double heaters() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().heatLedger().heaters; });
  }

  QTemporaryDir m_folder;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestExampleBrush test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_examplebrush.moc"
