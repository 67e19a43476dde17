// SPDX-License-Identifier: Apache-2.0
// Where keys go when what had them is gone, and the way through the window without a mouse.
#include "tests/ui/samplewindow.h"
#include "ui/window/dock.h"
#include "ui/window/windowlayout.h"

#include <QtGui/QAction>
#include <QtWidgets/QTabBar>

#include <algorithm>

using namespace ps;

class TestFocus : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { beginInTheView(); }
  void cleanupTestCase() { m_window.reset(); }

  void whatIsAddedLeavesTheKeysInTheView() {
    Dock* inspector = m_window->layoutOfDocks().dock(QStringLiteral("dock.inspector"));
    m_window->layoutOfDocks().showPage(QStringLiteral("Material"));
    inspector->firstStop()->setFocus();
    QVERIFY(inspector->isAncestorOf(QApplication::focusWidget()));
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Up);
    m_window->layoutOfDocks().showPage(QStringLiteral("Body"));
    QTRY_COMPARE(QApplication::focusWidget(), static_cast<QWidget*>(view()));
  }

  /// By Tab and by a click tabs get the keys all the same.
  void aClickOnTabsLeavesTheKeysThere() {
    Dock* inspector = m_window->layoutOfDocks().dock(QStringLiteral("dock.inspector"));
    auto* tabs = inspector->findChild<QTabBar*>();
    m_window->layoutOfDocks().showPage(QStringLiteral("Material"));
    inspector->firstStop()->setFocus();
    QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(2).center());
    QTest::qWait(50);
    QCOMPARE(QApplication::focusWidget(), tabs);
  }

  void partsOfTheWindowAreReachedInTurn() {
    std::vector<QWidget*> parts;
    for (int k = 0; k < 12; ++k) {
      m_window->action(QStringLiteral("window.nextPart"))->trigger();
      QWidget* focus = QApplication::focusWidget();
      QVERIFY(focus);
      if (focus == view()) break;
      QWidget* part = focus;
      while (part && !qobject_cast<Dock*>(part)) part = part->parentWidget();
      QVERIFY(part && part->isVisible());
      QVERIFY(std::find(parts.begin(), parts.end(), part) == parts.end());
      parts.push_back(part);
    }
    QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(view()));
    for (const Dock* dock : m_window->layoutOfDocks().docks())
      QCOMPARE(std::find(parts.begin(), parts.end(), dock) != parts.end(), dock->isVisible());
    m_window->action(QStringLiteral("window.previousPart"))->trigger();
    QVERIFY(parts.back()->isAncestorOf(QApplication::focusWidget()));
    m_window->action(QStringLiteral("window.nextPart"))->trigger();
    QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(view()));
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestFocus test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_focus.moc"
