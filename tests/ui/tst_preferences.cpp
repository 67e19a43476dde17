// SPDX-License-Identifier: Apache-2.0
// The dialog of preferences: each choice acts at once, and stands there the next time.
#include "core/simulation/runrecord.h"
#include "tests/ui/samplewindow.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/panels/inspector.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/preferences.h"

#include <QtCore/QDir>
#include <QtCore/QSettings>
#include <QtCore/QStorageInfo>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPlainTextEdit>
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

  /// In rows, graphs, legend and outliner, and typed values; the document stays in kelvin.
  void temperaturesAreShownAsPreferred() {
    const Address floor{Owner::Wall, "floor", "temperature"};
    QVERIFY(m_window->revealParameter(floor));
    const auto row = [this, &floor] {
      return m_window->inspector().panelFor(floor)->row(QString::fromStdString(floor.text()));
    };
    QCOMPARE(row()->valueText(), QStringLiteral("146.9 °C"));
    openDialog();
    pick("Temperatures", "Degrees Fahrenheit, °F");
    QCOMPARE(row()->valueText(), QStringLiteral("296.3 °F"));
    QVERIFY(row()->enter(QStringLiteral("212")));
    QVERIFY(std::abs(std::get<double>(document().value(floor)) - 373.15) < 1e-9);
    QVERIFY(row()->enter(QStringLiteral("100 °C")));
    QCOMPARE(row()->valueText(), QStringLiteral("212.0 °F"));
    QVERIFY(m_window->graphs()->valuesIn("K"));
    QCOMPARE(m_window->graphs()->valuesIn("K")->axes().front().unit, QStringLiteral("°F"));
    picture(QStringLiteral("tst_preferences_fahrenheit.png"));
    pick("Temperatures", "Kelvin, K");
    QCOMPARE(row()->valueText(), QStringLiteral("373.2 K"));
    QCOMPARE(temperatureText(300, 1), QStringLiteral("300.0 K"));
    QCOMPARE(preferences::temperatures(), TemperatureUnit::Kelvin);
    pick("Temperatures", "Degrees Celsius, °C");
    QCOMPARE(row()->valueText(), QStringLiteral("100.0 °C"));
    while (document().undoStack().canUndo()) document().undoStack().undo();
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

  /// What the project says of itself: typed, taken when the field is left, one step each, and undone.
  void theProjectIsDescribed() {
    m_window->action(QStringLiteral("edit.project"))->trigger();
    auto* about = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
    QVERIFY(about && QTest::qWaitForWindowExposed(about));
    auto* title = about->findChild<QLineEdit*>();
    auto* text = about->findChild<QPlainTextEdit*>();
    const ProjectAbout before = document().about();
    QCOMPARE(title->text().toStdString(), before.title);
    QCOMPARE(text->toPlainText().toStdString(), before.description);
    title->setText(QStringLiteral("Puddle"));
    QTest::keyClick(title, Qt::Key_Tab);
    QCOMPARE(document().about().title, std::string("Puddle"));
    QVERIFY(m_window->windowTitle().contains(QStringLiteral("Puddle")));
    text->setPlainText(QStringLiteral("It melts.\nTry it."));
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) about->grab().save(folder + QStringLiteral("/tst_project_properties.png"));
    about->close();
    QCOMPARE(document().about().description, std::string("It melts.\nTry it."));
    QCOMPARE(document().undoStack().count(), 2);
    document().undoStack().undo();
    QCOMPARE(document().about().description, before.description);
    document().undoStack().undo();
    QVERIFY(document().about() == before);
    QVERIFY(m_window->windowTitle().contains(QString::fromStdString(before.title)));
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
    const int index = box->findText(QString::fromUtf8(text));
    QVERIFY2(index >= 0, text);
    box->setCurrentIndex(index);
    Q_EMIT box->activated(index);
  }
};

QTEST_MAIN(TestPreferences)
#include "tst_preferences.moc"
