// SPDX-License-Identifier: Apache-2.0
// Graphs of a run of many frames: nobody waits while they are read again.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "tests/ui/samplewindow.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/session/historyreader.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

using namespace ps;

namespace {

constexpr int kFrames = 3000;

}  // namespace

class TestLongRun : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  /// The sample with a crumb of its ice.
  void initTestCase() {
    open();
    QVERIFY(m_window);
    session().pause();
    Project project = document().project();
    auto& box = std::get<BoxShape>(project.bodies.front().shape);
    box.size = Vector3(0.03, 0.03, 0.03);
    QTemporaryDir folder;
    const std::string path = folder.filePath(QStringLiteral("crumb.json")).toStdString();
    saveProject(project, path);
    QSignalSpy shown(m_window.get(), &MainWindow::projectShown);
    m_window->openFile(QString::fromStdString(path));
    QVERIFY(shown.wait(kLong));
    session().pause();
    while (session().newest()->stats.frame < kFrames) {
      session().engine()->stepOnce();
      onEngine<bool>(session(), [](Engine&) { return true; });
    }
  }

  void aCurveThatComesIsReadPieceByPiece() {
    GraphView* view = m_window->graphs()->valuesIn("K");
    const auto all = [this] { return session().engine()->history(0).size(); };
    QTRY_COMPARE_WITH_TIMEOUT(view->sampleCount(0), all(), kLong);
    QVERIFY(all() > 2 * HistoryReader::kMost);
    document().plot(document().graphs().front().id, "frame/density_error");
    const int fresh = view->seriesCount() - 1;
    QVERIFY(view->sampleCount(fresh) > 0 && view->sampleCount(fresh) <= HistoryReader::kMost);
    QCOMPARE(view->sampleCount(0), view->sampleCount(fresh));
    session().engine()->stepOnce();  // the run goes on meanwhile
    onEngine<bool>(session(), [](Engine&) { return true; });
    QTRY_COMPARE_WITH_TIMEOUT(view->sampleCount(fresh), all(), kLong);
    QCOMPARE(view->sampleCount(0), all());
    const double middle = session().engine()->history(kFrames / 2, 1).front().time;
    QVERIFY(std::isfinite(view->extent(fresh, middle - 1e-4, middle + 1e-4).first));
  }
};

QTEST_MAIN(TestLongRun)
#include "tst_longrun.moc"
