// SPDX-License-Identifier: Apache-2.0
// Draw the result, by hand in the real window: a curve is drawn over the sample's, a parameter may change, values are
// found, taken over as one step, undone and done again.
#include "core/io/projectio.h"
#include "tests/ui/answered.h"
#include "tests/ui/samplewindow.h"
#include "ui/fitting/fitpanel.h"
#include "ui/fitting/fitparameterrows.h"
#include "ui/fitting/wantedview.h"
#include "ui/window/windowlayout.h"

#include <QtTest/QSignalSpy>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDockWidget>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

const FitTarget kFloor{{Owner::Wall, "floor", "temperature"}};

}  // namespace

class TestDrawResult : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    QVERIFY(m_window);
    session().pause();
    m_window->layoutOfDocks().showPage(QStringLiteral("Draw the result"));
    QVERIFY(panel()->isVisible());
  }
  void init() {
    backToTheStart();
    wantedView()->setWanted({});
  }

  /// A stroke has points from left to right whichever way the hand goes, and takes the place of what it passes.
  void aStrokeIsDrawnOverWhatWasThere() {
    const auto values = [this] { return wantedView()->wanted().value; };
    draw({0.1, 0.2}, {0.6, 0.8});
    const Series down = wantedView()->wanted();
    QVERIFY(down.time.size() > 5);
    QVERIFY(std::is_sorted(down.time.begin(), down.time.end()));
    QVERIFY(std::is_sorted(down.value.rbegin(), down.value.rend()));
    draw({0.4, 0.2}, {0.2, 0.2});  // back over its middle
    const Series level = wantedView()->wanted();
    QVERIFY(std::is_sorted(level.time.begin(), level.time.end()));
    QCOMPARE(level.time.front(), down.time.front());
    QCOMPARE(level.time.back(), down.time.back());
    QVERIFY(!std::is_sorted(level.value.rbegin(), level.value.rend()));
    QSignalSpy changed(wantedView(), &WantedView::wantedChanged);
    QTest::keyClick(wantedView(), Qt::Key_Delete);
    QVERIFY(values().empty());
    QCOMPARE(changed.count(), 1);
  }

  void nothingIsSearchedWithoutACurveAndAParameter() {
    QVERIFY(!button("Find values")->isEnabled());
    QCOMPARE(panel()->parameters()->add(kFloor), QString());
    QVERIFY(!panel()->parameters()->add(kFloor).isEmpty());  // it is there already
    QVERIFY(!button("Find values")->isEnabled());
    draw({0.1, 0.2}, {0.3, 0.5});
    QVERIFY(button("Find values")->isEnabled());
    QVERIFY(!button("Apply")->isEnabled());
  }

  /// The start of the ice's melting, by the plate.
  void valuesAreFoundAndTakenOverAsOneStep() {
    chooseQuantity("Ice: Solid mass");
    panel()->parameters()->add(kFloor);
    Series wanted;
    for (int k = 1; k <= 4; ++k) wanted.time.push_back(0.1 * k), wanted.value.push_back(44000 - 4000.0 * k);  // g
    wantedView()->setWanted(wanted);
    picture("draw-wanted.png");
    const std::string before = writeProject(document().project());
    const int index = document().undoStack().index();
    QSignalSpy ended(panel(), &FitPanel::ended);
    QTest::mouseClick(button("Find values"), Qt::LeftButton);
    QVERIFY(button("Cancel")->isVisible());
    QVERIFY(ended.wait(4 * kLong));
    QCOMPARE(writeProject(document().project()), before);  // nothing changes before it is asked for
    picture("draw-found.png");
    QVERIFY(button("Apply")->isEnabled());
    QTest::mouseClick(button("Apply"), Qt::LeftButton);
    QCOMPARE(document().undoStack().index(), index + 1);
    const std::string after = writeProject(document().project());
    QVERIFY(after != before);
    QVERIFY(std::get<double>(document().value(kFloor.address)) > 425);  // hotter than it is
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    document().undoStack().redo();
    QCOMPARE(writeProject(document().project()), after);
  }

  /// A key of it may change where the parameter itself cannot; that is one step too.
  void theValueOfAKeyIsFound() {
    QCOMPARE(document().putKey(kFloor.address, 0, 420), QString());
    QCOMPARE(document().putKey(kFloor.address, 0.3, 300), QString());
    QVERIFY(panel()->parameters()->add(kFloor).contains(QStringLiteral("follows its keys; choose one of them")));
    const FitTarget first(kFloor.address, {}, 0);
    const QString name = panel()->parameters()->nameOf(first);
    QCOMPARE(name, QStringLiteral("Hot plate temperature, key at 0 s"));
    const auto* candidates = panel()->findChild<QComboBox*>(QStringLiteral("psCandidates"));
    QVERIFY(candidates && candidates->findText(name) >= 0);
    QCOMPARE(candidates->findText(QStringLiteral("Hot plate temperature")), -1);
    QCOMPARE(panel()->parameters()->add(first), QString());
    chooseQuantity("All matter: Mean temperature");
    Series wanted;  // °C
    for (int k = 1; k <= 3; ++k) wanted.time.push_back(0.1 * k), wanted.value.push_back(-10 + 1.5 * k);
    wantedView()->setWanted(wanted);
    const std::string before = writeProject(document().project());
    const int index = document().undoStack().index();
    QSignalSpy ended(panel(), &FitPanel::ended);
    QTest::mouseClick(button("Find values"), Qt::LeftButton);
    QVERIFY(ended.wait(4 * kLong));
    QTest::mouseClick(button("Apply"), Qt::LeftButton);
    QCOMPARE(document().undoStack().index(), index + 1);
    const std::vector<TrackKey>& keys = document().track(kFloor.address)->keys;
    QVERIFY2(std::abs(keys[0].value - 420) > 1, qPrintable(QString::number(keys[0].value)));
    QCOMPARE(keys[1].value, 300.0);
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    document().removeTrack(kFloor.address);  // takes what may change with it
    QVERIFY(panel()->parameters()->parameters().empty());
  }

  /// It is the key of a time, wherever others come or go; a moved one stays the same.
  void aKeyIsFollowed() {
    QCOMPARE(document().putKey(kFloor.address, 0.2, 420), QString());
    QCOMPARE(document().putKey(kFloor.address, 0.4, 300), QString());
    auto* rows = panel()->parameters();
    QCOMPARE(rows->add(FitTarget(kFloor.address, {}, 1)), QString());
    QCOMPARE(document().putKey(kFloor.address, 0.1, 350), QString());
    QCOMPARE(rows->parameters().front().target.key, std::optional<size_t>(2));
    document().removeKey(kFloor.address, 0);
    document().removeKey(kFloor.address, 0);
    QCOMPARE(rows->parameters().front().target.key, std::optional<size_t>(0));
    QCOMPARE(document().moveKey(kFloor.address, 0, 0.5, 310), QString());
    QCOMPARE(rows->nameOf(rows->parameters().front().target), QStringLiteral("Hot plate temperature, key at 0.5 s"));
    QCOMPARE(document().putKey(kFloor.address, 0.1, 350), QString());
    document().removeKey(kFloor.address, 1);
    QVERIFY(rows->parameters().empty());
  }

  void aSearchIsGivenUp_data() {
    QTest::addColumn<bool>("byKey");
    QTest::newRow("button") << false;
    QTest::newRow("Esc in the view") << true;
  }
  void aSearchIsGivenUp() {
    QFETCH(bool, byKey);
    chooseQuantity("Ice: Solid mass");
    panel()->parameters()->add(kFloor);
    wantedView()->setWanted({{20.0}, {10000.0}});  // runs of twenty seconds
    QSignalSpy ended(panel(), &FitPanel::ended);
    QTest::mouseClick(button("Find values"), Qt::LeftButton);
    QTest::qWait(200);
    QElapsedTimer clock;
    clock.start();
    if (byKey)
      QTest::keyClick(view(), Qt::Key_Escape);
    else
      QTest::mouseClick(button("Cancel"), Qt::LeftButton);
    QVERIFY2(clock.elapsed() < kAnswered, qPrintable(QString::number(clock.elapsed())));
    const auto labels = panel()->findChildren<QLabel*>();
    QVERIFY(std::any_of(labels.begin(), labels.end(),
                        [](const QLabel* label) { return label->text() == QStringLiteral("Giving up…"); }));
    QVERIFY(ended.wait(kLong));
    QVERIFY(button("Find values")->isVisible());
    QVERIFY(!button("Apply")->isEnabled());
  }

 private:
  FitPanel* panel() const { return m_window->findChild<FitPanel*>(); }
  WantedView* wantedView() const { return panel()->view(); }
  QPushButton* button(const char* text) const {
    for (QPushButton* each : panel()->findChildren<QPushButton*>()) {
      if (each->text() == QString::fromLatin1(text)) return each;
    }
    return nullptr;
  }
  void chooseQuantity(const char* name) {
    const auto& all = panel()->drawables();
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const FitPanel::Drawable& each) { return each.name == QString::fromLatin1(name); });
    QVERIFY2(found != all.end(), name);
    panel()->choose(static_cast<int>(found - all.begin()));
  }
  /// Between two places, as shares of the plot's width and height.
  void draw(const QPointF& from, const QPointF& to) {
    const QRectF plot = wantedView()->plotRect();
    const auto at = [&](double share) {
      const QPointF p = from + share * (to - from);
      return QPoint(qRound(plot.left() + p.x() * plot.width()), qRound(plot.top() + p.y() * plot.height()));
    };
    QTest::mousePress(wantedView(), Qt::LeftButton, {}, at(0));
    for (int k = 1; k <= 20; ++k) QTest::mouseMove(wantedView(), at(k / 20.0));
    QTest::mouseRelease(wantedView(), Qt::LeftButton, {}, at(1));
  }
};

QTEST_MAIN(TestDrawResult)
#include "tst_drawresult.moc"
