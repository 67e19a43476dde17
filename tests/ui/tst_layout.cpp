// SPDX-License-Identifier: Apache-2.0
// Where docks stand: as the layout table has it for the window's width, or as somebody arranged them, also after a
// restart in which the window gets its size late.
#include "core/io/projectio.h"
#include "samplewindow.h"
#include "tests/shared/scenes.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/session/preferences.h"
#include "ui/window/dock.h"

#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QTabBar>

using namespace ps;

class TestLayout : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    QSettings().clear();
    preferences::setWelcomeAtStart(false);
    preferences::setTourDone();
    m_directory = std::make_unique<QTemporaryDir>();
    m_path = m_directory->filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(4, 370), m_path.toStdString());
  }
  void cleanup() { m_window.reset(); }
  void cleanupTestCase() { QSettings().clear(); }

  void aSmallWindowHasOneDockOfBoth() {
    open({1280, 800});
    QVERIFY(!dock("dock.materials")->isVisible());
    auto* tabs = dock("dock.outliner")->findChild<QTabBar*>();
    QCOMPARE(tabs->count(), 2);
    QVERIFY(m_window->findChild<Outliner*>()->isVisible());
    tabs->setCurrentIndex(1);
    QVERIFY(materials()->isVisible());
    QVERIFY(!m_window->findChild<Outliner*>()->isVisible());
  }

  void aLargeOneHasOneAboveTheOther() {
    open({1600, 1000});
    QVERIFY(m_window->findChild<Outliner*>()->isVisible() && materials()->isVisible());
    QVERIFY(dock("dock.materials")->y() > dock("dock.outliner")->geometry().bottom());
  }

  void aLayoutOfNobodyFollowsTheWindow() {
    open({1600, 1000});
    resize({1280, 800});
    QVERIFY(!dock("dock.materials")->isVisible());
    resize({1600, 1000});
    QTRY_VERIFY(dock("dock.materials")->isVisible() && materials()->isVisible());
    QTRY_COMPARE(dock("dock.outliner")->width(), 236);
  }

  void whatSomebodyArrangedStays() {
    open({1600, 1000});
    dragBetweenLeftDocks(-60);
    resize({1280, 800});
    QVERIFY(dock("dock.materials")->isVisible() && materials()->isVisible());
    m_window->action(QStringLiteral("view.layout"))->trigger();
    QVERIFY(!dock("dock.materials")->isVisible());
  }

  /// As a window does that was closed maximised: its first size is the one that it had before.
  void aWindowThatGetsItsSizeLateHasItsDocksAsLeft_data() {
    QTest::addColumn<bool>("arranged");
    QTest::newRow("by somebody") << true;
    QTest::newRow("by nobody") << false;
  }
  void aWindowThatGetsItsSizeLateHasItsDocksAsLeft() {
    QFETCH(bool, arranged);
    open({1600, 1000});
    if (arranged) dragBetweenLeftDocks(-90);
    const int left = dock("dock.materials")->height();
    for (int restart = 0; restart < 3; ++restart) {
      QVERIFY(m_window->close());
      m_window.reset();
      open({900, 480}, true);
      resize({1600, 1000});
      QTRY_COMPARE(dock("dock.materials")->height(), left);
    }
  }

  void pagesOfOneDockComeBackAsThat() {
    open({1280, 800});
    QVERIFY(m_window->close());
    m_window.reset();
    open({1280, 800}, true);
    QVERIFY(!dock("dock.materials")->isVisible());
    QCOMPARE(dock("dock.outliner")->findChild<QTabBar*>()->count(), 2);
  }

 private:
  void open(const QSize& size, bool again = false) {
    Theme::apply(*qApp, true);
    MainWindow::Options options;
    options.project = again ? QString() : m_path;  // else what was open last
    options.sample = m_path;
    options.session.autosaveDirectory = m_directory->filePath(QStringLiteral("copies"));
    m_window = shownWindow(options, size);
    QVERIFY(m_window);
    m_window->session().pause();
    QTest::qWait(50);
  }
  void resize(const QSize& size) {
    m_window->resize(size);
    QTRY_COMPARE(m_window->size(), size);
    QTest::qWait(50);
  }
  void dragBetweenLeftDocks(int by) {
    const QRect above = dock("dock.outliner")->geometry();
    const QPoint separator(above.center().x(), (above.bottom() + dock("dock.materials")->y()) / 2);
    const int before = above.height();
    QTest::mouseMove(m_window.get(), separator);
    QTest::mousePress(m_window.get(), Qt::LeftButton, {}, separator);
    QTest::mouseMove(m_window.get(), separator + QPoint(0, by));
    QTest::qWait(50);  // docks follow when events are done
    QTest::mouseRelease(m_window.get(), Qt::LeftButton, {}, separator + QPoint(0, by));
    QTRY_COMPARE(dock("dock.outliner")->height(), before + by);
  }
  Dock* dock(const char* name) { return m_window->findChild<Dock*>(QString::fromLatin1(name)); }
  MaterialsPanel* materials() { return m_window->findChild<MaterialsPanel*>(); }
  std::unique_ptr<QTemporaryDir> m_directory;
  QString m_path;
  std::unique_ptr<MainWindow> m_window;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestLayout test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_layout.moc"
