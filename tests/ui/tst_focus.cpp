// SPDX-License-Identifier: Apache-2.0
// Where keys go when what had them is gone, and the way through the window without a mouse.
#include "tests/ui/paintedtexts.h"
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/window/dock.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QRegularExpression>
#include <QtGui/QAction>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QTreeView>

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

  /// However the naming ends, and whatever the keys were on before.
  void aRenamedRowLeavesTheKeysInTheOutliner_data() {
    QTest::addColumn<int>("key");
    QTest::addColumn<bool>("byHand");  // Tab came before
    for (const bool byHand : {false, true}) {
      const QByteArray after = byHand ? ", after Tab" : "";
      QTest::newRow("Enter" + after) << static_cast<int>(Qt::Key_Return) << byHand;
      QTest::newRow("Escape" + after) << static_cast<int>(Qt::Key_Escape) << byHand;
      QTest::newRow("Tab" + after) << static_cast<int>(Qt::Key_Tab) << byHand;
    }
  }
  void aRenamedRowLeavesTheKeysInTheOutliner() {
    QFETCH(int, key);
    QFETCH(bool, byHand);
    QTest::failOnWarning(QRegularExpression(QStringLiteral("closeEditor|commitData")));
    m_window->layoutOfDocks().showPage(QStringLiteral("Outliner"));
    m_window->selection().select(OutlineKind::Body, document().project().bodies.front().id);
    auto* tree = m_window->outliner()->findChild<QTreeView*>();
    tree->setFocus();
    if (byHand) {
      QTest::keyClick(tree, Qt::Key_Backtab);
      tree->setFocus();
    }
    m_window->action(QStringLiteral("edit.rename"))->trigger();
    auto* name = tree->viewport()->findChild<QLineEdit*>();
    QVERIFY(name);
    QTRY_VERIFY(name->hasFocus());
    name->setText(QStringLiteral("named by %1").arg(QString::fromLatin1(QTest::currentDataTag())));
    QTest::keyClick(name, static_cast<Qt::Key>(key));
    QTRY_VERIFY(!tree->viewport()->findChild<QLineEdit*>());
    QTest::qWait(50);
    QVERIFY2(tree->hasFocus(),
             QApplication::focusWidget() ? QApplication::focusWidget()->metaObject()->className() : "none");
  }

  /// The box in which a name is typed ends before what stands beside the name, or covers all of that.
  void aRenamedRowKeepsItsCountInSight() {
    m_window->layoutOfDocks().showPage(QStringLiteral("Outliner"));
    m_window->selection().select(OutlineKind::Body, document().project().bodies.front().id);
    auto* tree = m_window->outliner()->findChild<QTreeView*>();
    const QRect row = tree->visualRect(tree->currentIndex());
    m_window->action(QStringLiteral("edit.rename"))->trigger();
    const auto* name = tree->viewport()->findChild<QLineEdit*>();
    QVERIFY(name && row.contains(name->geometry()));
    QVERIFY2(name->width() >= 50, qPrintable(QString::number(name->width())));
    for (const PaintedText& text : paintedBy(*tree->viewport())) {
      const QRect place = text.place.adjusted(2, 2, -2, -2).toRect(), box = name->geometry();
      if (!row.contains(place.center()) || text.at.x() < box.left() + 12) continue;  // of another row, or the name
      QVERIFY2(!box.intersects(place) || box.contains(place), qPrintable(text.text));
    }
    QTest::keyClick(const_cast<QLineEdit*>(name), Qt::Key_Escape);
    QTRY_VERIFY(!tree->viewport()->findChild<QLineEdit*>());
  }

  /// What is typed into a row is given up by one Esc, and the next one is the view's: it selects nothing.
  void escInARowLeavesTheKeysInTheView() {
    const Address address{Owner::Body, document().project().bodies.front().id, "temperature"};
    m_window->selection().select(OutlineKind::Body, address.id);
    m_window->revealParameter(address);
    ParameterRow* row = m_window->inspector().bodyPanel()->row(QString::fromStdString(address.text()));
    QVERIFY(row && row->isVisible());
    const double before = row->number();
    row->setFocus();
    row->startTyping();
    auto* field = row->findChild<QLineEdit*>(QStringLiteral("psRowEdit"));
    QVERIFY(field && field->hasFocus());
    QTest::keyClicks(field, QStringLiteral("7"));
    QTest::keyClick(field, Qt::Key_Escape);
    QTRY_VERIFY(view()->hasFocus());
    QVERIFY(!row->has(RowState::Editing));
    QCOMPARE(row->number(), before);
    QVERIFY(!m_window->selection().empty());
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY(m_window->selection().empty());
  }

  /// From elsewhere it leads to the view first, whose tool it ends before it selects nothing.
  void escGoesBackStepByStep() {
    m_window->layoutOfDocks().showPage(QStringLiteral("Outliner"));
    m_window->selection().select(OutlineKind::Body, document().project().bodies.front().id);
    m_window->tools().activate("move");
    auto* tree = m_window->outliner()->findChild<QTreeView*>();
    tree->setFocus();
    QTest::keyClick(tree, Qt::Key_Escape);
    QVERIFY(view()->hasFocus());
    QCOMPARE(m_window->tools().active(), std::string("move"));
    QTest::keyClick(view(), Qt::Key_Escape);
    QCOMPARE(m_window->tools().active(), std::string("select"));
    QVERIFY(!m_window->selection().empty());
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY(m_window->selection().empty());
  }

  /// Of a field that is no row's, such as a point's of a curve: what takes its text when it is left gets the old one.
  void escInAFieldGivesUpWhatWasTyped() {
    auto* field = new QLineEdit(QStringLiteral("20"), m_window.get());
    field->show();
    field->setFocus();
    QTest::keyClicks(field, QStringLiteral("97"));
    QVERIFY(field->isModified());
    QTest::keyClick(field, Qt::Key_Escape);
    QVERIFY(view()->hasFocus());
    QCOMPARE(field->text(), QStringLiteral("20"));
    QVERIFY(!field->isModified());
    delete field;
  }

  /// The brush that a click takes is for the view, and so are the keys that follow.
  void aBrushThatIsChosenLeavesTheKeysInTheView() {
    m_window->showWorkspace(MainWindow::kSketchTab);
    const auto leave = [this] {
      m_window->layoutOfDocks().dock(QStringLiteral("dock.inspector"))->firstStop()->setFocus();
      QVERIFY(!view()->hasFocus());
    };
    leave();
    m_window->action(QStringLiteral("sketch.shape.cube"))->trigger();
    QTRY_VERIFY(view()->hasFocus());
    leave();
    const auto buttons = m_window->findChildren<QAbstractButton*>();
    const auto sphere = std::find_if(buttons.begin(), buttons.end(), [](const QAbstractButton* button) {
      return button->property("shape").toString() == QStringLiteral("sphere");
    });
    QVERIFY(sphere != buttons.end());
    QTest::mouseClick(*sphere, Qt::LeftButton);
    QTRY_VERIFY(view()->hasFocus());
    m_window->showWorkspace(MainWindow::kSceneTab);
  }

  /// Of a panel that Sketch does not show: not to a field that is next in line.
  void aPanelThatGoesLeavesTheKeysInTheView() {
    m_window->showWorkspace(MainWindow::kSceneTab);
    auto* tree = m_window->findChild<Outliner*>()->findChild<QTreeView*>();
    tree->setFocus();
    QVERIFY(tree->hasFocus());
    m_window->action(QStringLiteral("sketch.brush"))->trigger();
    QVERIFY(!tree->isVisible() && view()->hasFocus());
    m_window->showWorkspace(MainWindow::kSceneTab);
  }

  /// The list that hangs open below a field, too.
  void returnChoosesFromAList() {
    m_window->showWorkspace(MainWindow::kFilmTab);
    const auto fields = m_window->layoutOfDocks().dock(QStringLiteral("dock.film"))->findChildren<QComboBox*>();
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [](const QComboBox* one) { return one->isVisible() && one->count() > 1; });
    QVERIFY(field != fields.end());
    (*field)->setCurrentIndex(0);
    (*field)->setFocus();
    (*field)->showPopup();
    QTRY_VERIFY((*field)->view()->isVisible());
    QTest::keyClick((*field)->view(), Qt::Key_Down);
    QTest::keyClick((*field)->view(), Qt::Key_Return);
    QTRY_VERIFY(!(*field)->view()->isVisible());
    QCOMPARE((*field)->currentIndex(), 1);
    m_window->showWorkspace(MainWindow::kSceneTab);
  }

  void partsOfTheWindowAreReachedInTurn_data() {
    QTest::addColumn<int>("workspace");
    QTest::newRow("Scene") << static_cast<int>(MainWindow::kSceneTab);
    QTest::newRow("Tune") << static_cast<int>(MainWindow::kTuneTab);
    QTest::newRow("Sketch") << static_cast<int>(MainWindow::kSketchTab);
    QTest::newRow("Film") << static_cast<int>(MainWindow::kFilmTab);
  }
  void partsOfTheWindowAreReachedInTurn() {
    QFETCH(int, workspace);
    m_window->showWorkspace(static_cast<MainWindow::WorkspaceTab>(workspace));
    view()->setFocus();
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
