// SPDX-License-Identifier: Apache-2.0
// The dialog of preferences: each choice acts at once, and stands there the next time.
#include "core/simulation/runrecord.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/preferences.h"

#include <QtCore/QDir>
#include <QtCore/QSettings>
#include <QtCore/QStorageInfo>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>

using namespace ps;

class TestPreferences : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QSettings().clear();
    open();
    QVERIFY(m_window);
  }
  void cleanup() { delete dialog(); }
  void cleanupTestCase() { QSettings().clear(); }

  void everyChoiceActsAndStays() {
    openDialog();
    pick("Theme", "Light");
    QVERIFY(!Theme::current().dark());
    pick("Theme", "Dark");
    QVERIFY(Theme::current().dark());
    pick("Copy it", "Every minute");
    QCOMPARE(preferences::autosaveInterval(), 60);
    pick("In memory, at most", "512 MiB");
    QCOMPARE(preferences::recordBudget().memory, size_t{512} << 20);
    pick("On the disk, at most", "Nothing");
    QCOMPARE(preferences::recordBudget().disk, size_t{0});
    delete dialog();
    openDialog();
    QCOMPARE(field<QComboBox>("Copy it")->currentText(), QStringLiteral("Every minute"));
    QCOMPARE(field<QComboBox>("In memory, at most")->currentText(), QStringLiteral("512 MiB"));
    QCOMPARE(field<QComboBox>("On the disk, at most")->currentText(), QStringLiteral("Nothing"));
  }

  /// A value that is none of those offered is shown, and stays.
  void otherValuesAreShown() {
    preferences::setAutosaveInterval(45);
    QSettings().setValue(QStringLiteral("recording/disk"), QStringLiteral("much"));
    openDialog();
    QCOMPARE(field<QComboBox>("Copy it")->currentText(), QStringLiteral("Every 45 s"));
    QCOMPARE(preferences::recordDisk(), 8192);
    preferences::setRecordDisk(1 << 24);  // more than there is
    const QStorageInfo disk(QDir::tempPath());
    preferences::setRecordFolder(QDir::tempPath() + QStringLiteral("/not/there/yet"));
    QVERIFY(preferences::recordBudget().disk <= static_cast<size_t>(disk.bytesTotal()));
    QVERIFY(preferences::recordBudget().disk > 0);
    preferences::setRecordFolder({});
    preferences::setRecordDisk(8192);
  }

  /// The memory is soon full; what is on the disk is counted, and forgotten by the button.
  void theDiskIsFilledAndEmptied() {
    session().engine()->setRecordBudget({size_t{3} << 20, size_t{1} << 30, preferences::recordFolder().toStdString()});
    session().play();
    const auto disk = [this] { return session().engine()->recording().cost().disk; };
    QTRY_VERIFY_WITH_TIMEOUT(disk() > size_t{1} << 20, kLong);
    session().pause();
    session().engine()->recording().settle();
    QVERIFY(session().engine()->recording().cost().bytes <= size_t{3} << 20);
    openDialog();
    QVERIFY(QDir(preferences::recordFolder()).isEmpty());
    QVERIFY2(field<QLabel>("Used now")->text().endsWith(QStringLiteral(" of the disk")),
             qPrintable(field<QLabel>("Used now")->text()));
    picture(QStringLiteral("tst_preferences_window.png"));
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) dialog()->grab().save(folder + QStringLiteral("/tst_preferences_dark.png"));
    pick("Theme", "Light");
    if (!folder.isEmpty()) dialog()->grab().save(folder + QStringLiteral("/tst_preferences_light.png"));
    pick("Theme", "Dark");
    const size_t before = disk();
    for (auto* button : dialog()->findChildren<QPushButton*>()) {
      if (button->text() == QStringLiteral("Empty the disk")) QTest::mouseClick(button, Qt::LeftButton);
    }
    session().engine()->recording().settle();
    QVERIFY(disk() < before / 2);
    QVERIFY(session().engine()->recording().extent().frames > 1);
  }

  /// From field to field by Tab, to the next choice by an arrow.
  void theKeyboardReachesAll() {
    openDialog();
    QSet<QWidget*> reached;
    for (int k = 0; k < 12; ++k) {
      QTest::keyClick(dialog()->focusWidget() ? dialog()->focusWidget() : dialog(), Qt::Key_Tab);
      reached << dialog()->focusWidget();
    }
    for (const char* label : {"Theme", "Copy it", "In memory, at most", "On the disk, at most"})
      QVERIFY2(reached.contains(field<QComboBox>(label)), label);
    QVERIFY(reached.contains(field<QPushButton>("Folder")));
    QTest::keyClick(dialog(), Qt::Key_Escape);
    QTRY_VERIFY(!dialog() || !dialog()->isVisible());
  }

 private:
  QDialog* dialog() { return m_window->findChild<QDialog*>(QStringLiteral("psPreferences")); }
  void openDialog() {
    m_window->action(QStringLiteral("edit.preferences"))->trigger();
    QVERIFY(dialog() && QTest::qWaitForWindowExposed(dialog()));
  }
  template <class Field>
  Field* field(const char* label) {
    for (Field* one : dialog()->findChildren<Field*>()) {
      if (one->accessibleName() == QLatin1String(label)) return one;
    }
    return nullptr;
  }
  void pick(const char* label, const char* text) {
    auto* box = field<QComboBox>(label);
    const int index = box->findText(QLatin1String(text));
    QVERIFY2(index >= 0, text);
    box->setCurrentIndex(index);
    Q_EMIT box->activated(index);
  }
};

QTEST_MAIN(TestPreferences)
#include "tst_preferences.moc"
