// SPDX-License-Identifier: Apache-2.0
// Matter painted by hand in the window: the brush is taken by its key or its button, and undo gives the matter back.
#include "samplewindow.h"
#include "ui/tools/tooltable.h"
#include "ui/window/statusline.h"

#include <QtGui/QAction>
#include <QtWidgets/QAbstractButton>

#include <algorithm>

using namespace ps;

class TestPaintWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    document().addMaterial("iron");
    document().undoStack().clear();
  }
  void init() { beginInTheView(); }
  void cleanupTestCase() { m_window.reset(); }

  void itsKeyAndItsButtonTakeIt() {
    QTest::keyClick(view(), Qt::Key_P);
    QCOMPARE(m_window->tools().active(), std::string(kBrushTool));
    QVERIFY(m_window->tools().paints());
    QTest::keyClick(view(), Qt::Key_B);
    QVERIFY(!m_window->tools().paints());
    for (QAbstractButton* button : m_window->findChildren<QAbstractButton*>()) {
      if (button->property("shape").toString() != QLatin1String("paint")) continue;
      QVERIFY2(button->toolTip().contains(QStringLiteral("(P)")), qPrintable(button->toolTip()));
      button->click();
    }
    QVERIFY(m_window->tools().paints());
  }

  void aStrokePaintsTheIce() {
    BrushSettings brush = m_window->tools().brush();
    brush.material = "iron";
    m_window->tools().setBrush(brush);
    m_window->action(QStringLiteral("sketch.shape.paint"))->trigger();
    QCOMPARE(iron(), size_t{0});
    const std::set<uint32_t> before = idsNow(session());
    stroke(QPoint(view()->width() / 2 - 40, view()->height() / 2), {80, 0}, true);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("painting stroke"));
    const size_t painted = iron();
    QVERIFY(painted > 20);
    QCOMPARE(idsNow(session()), before);
    picture(QStringLiteral("painted.png"));
    // A block has become a sketch by that, which has other rows.
    QVERIFY(m_window->findChild<StatusLine*>()->state().note.contains(QStringLiteral("is a sketch now")));
    document().undoStack().undo();
    QCOMPARE(iron(), size_t{0});
    document().undoStack().redo();
    QCOMPARE(iron(), painted);
  }

 private:
  size_t iron() {
    return onEngine<size_t>(session(), [](Engine& engine) {
      const auto& materials = engine.project().materials;
      const auto index = static_cast<uint32_t>(
          std::find_if(materials.begin(), materials.end(), [](const auto& m) { return m.id == "iron"; }) -
          materials.begin());
      const uint32_t* first = engine.particles().material();
      return static_cast<size_t>(std::count(first, first + engine.particles().size(), index));
    });
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestPaintWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_paintwindow.moc"
