// SPDX-License-Identifier: Apache-2.0
// A brush that did not come with the program, by hand: chosen from the menu, seen under its label, drawn and erased
// with.
#include "samplewindow.h"
#include "ui/panels/brushpanel.h"
#include "ui/rows/parameterrow.h"

#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>

using namespace ps;

class TestForeignBrush : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    const QString file = QStringLiteral("fixture_brush.so");
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QLatin1Char('/') + file, m_folder.filePath(file)));
    m_window = sampleWindow({1280, 800}, {m_folder.path().toStdString()});
    QVERIFY(m_window);
  }
  void init() { backToTheStart(); }
  void cleanupTestCase() { m_window.reset(); }

  void itsEntryChoosesItByItsLabel() {
    QAction* entry = m_window->action(QStringLiteral("sketch.shape.fixture.brush"));
    QVERIFY(entry && entry->isEnabled());
    QCOMPARE(entry->text(), QStringLiteral("Brush shape: Fixture"));
    entry->trigger();
    QCOMPARE(m_window->tools().brush().shape, std::string("fixture.brush"));
    const auto* row = m_window->findChild<BrushPanel*>()->row(QStringLiteral("shape"));
    QVERIFY(row);
    QCOMPARE(row->valueText(), QStringLiteral("Fixture"));
  }

  /// What erases is told so: a stroke of which the brush names nothing to take away would be none.
  void itDrawsAndErases() {
    m_window->action(QStringLiteral("sketch.shape.fixture.brush"))->trigger();
    const std::set<uint32_t> before = idsNow(session());
    const QPoint from(view()->width() / 2 - 60, view()->height() / 2);
    stroke(from, {72, 0}, true);
    const std::set<uint32_t> drawn = idsNow(session());
    QVERIFY(drawn.size() > before.size());
    document().undoStack().undo();
    QCOMPARE(idsNow(session()), before);
    document().undoStack().redo();
    m_window->tools().activate("erase");
    stroke(from, {72, 0}, true);
    const std::set<uint32_t> left = idsNow(session());
    QVERIFY(left.size() < drawn.size());
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("erasing stroke"));
  }

 private:
  QTemporaryDir m_folder;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestForeignBrush test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_foreignbrush.moc"
