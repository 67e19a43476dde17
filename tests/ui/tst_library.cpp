// SPDX-License-Identifier: Apache-2.0
// The library of materials: search, phases at a glance, two side by side, presets that are kept, read again and passed
// on.
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"
#include "tests/ui/samplewindow.h"
#include "ui/library/librarypage.h"
#include "ui/library/materialcard.h"
#include "ui/session/selection.h"
#include "ui/session/worker.h"
#include "ui/theme/units.h"
#include "ui/window/libraryactions.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTreeWidget>

using namespace ps;

namespace {

const Address kStiffness{Owner::Material, "water", "youngs_modulus"};

}  // namespace

class TestLibrary : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    Theme::apply(*qApp, true);
    MainWindow::Options options;
    options.project = options.sample = kSample;
    options.restore = false;
    options.session.autosave = false;
    options.presets = m_folder.filePath(QStringLiteral("presets"));
    m_window = shownWindow(options, {1600, 1000});
    QVERIFY(m_window);
    QTRY_VERIFY_WITH_TIMEOUT(!library().entries().empty(), kLong);
    m_window->action(QStringLiteral("add.library"))->trigger();
    QVERIFY(page()->isVisible());
  }
  void init() {
    search(QString());
    page()->setTag({});
  }

  void everyInstalledMaterialHasACard() {
    QCOMPARE(library().entries().size(), session().plugins()->ids(PluginKind::Material).size());
    QCOMPARE(static_cast<size_t>(page()->shown().size()), library().entries().size());
    for (const LibraryEntry& entry : library().entries()) {
      QVERIFY2(!entry.bands.empty() && entry.bands.front().from == 0, qPrintable(entry.label));
      QVERIFY2(!std::isfinite(entry.bands.back().to), qPrintable(entry.label));
      for (size_t i = 1; i < entry.bands.size(); ++i) QCOMPARE(entry.bands[i].from, entry.bands[i - 1].to);
      QVERIFY2(!entry.tags.isEmpty(), qPrintable(entry.label));
    }
  }

  void phasesAtAGlance() {
    QCOMPARE(transitionsText(*entry(QStringLiteral("Water"))), QStringLiteral("melts at 0 °C, boils at 100 °C"));
    QVERIFY(transitionsText(*entryOf("co2")).startsWith(QStringLiteral("turns to gas at ")));
    QVERIFY(entryOf("iron")->tags.contains(QStringLiteral("Metals")));
    QVERIFY(entryOf("nitrogen")->tags.contains(QStringLiteral("Gases")));
    QCOMPARE(transitionsText(*entryOf("honey")), QStringLiteral("never freezes"));
    QVERIFY(entryOf("honey")->tags.contains(QStringLiteral("Liquids")));
    QVERIFY(entryOf("ethanol")->tags.contains(QStringLiteral("Liquids")));
  }

  void searchAndTagsChoose() {
    search(QStringLiteral("candle"));  // in what is said of wax
    QCOMPARE(page()->shown(), QStringList{entryOf("wax")->label});
    search(QString());
    page()->setTag(QStringLiteral("Metals"));
    QVERIFY(page()->shown().contains(entryOf("iron")->label) && !page()->shown().contains(QStringLiteral("Water")));
  }

  void twoAreComparedSideBySide() {
    page()->choose(QStringLiteral("Water"));
    QCOMPARE(page()->table()->columnCount(), 2);
    page()->choose(entryOf("honey")->label, true);
    QCOMPARE(page()->compared().size(), 2);
    QCOMPARE(page()->table()->columnCount(), 3);
    const auto rows = page()->table()->findItems(QStringLiteral("Viscosity"), Qt::MatchStartsWith);
    QVERIFY(!rows.isEmpty() && rows.front()->text(1) != rows.front()->text(2));
    pictureOf("library_dark");
    m_window->setDark(false);
    pictureOf("library_light");
    m_window->setDark(true);
  }

  void oneComesIntoTheScene() {
    page()->choose(entryOf("wax")->label);
    button(QStringLiteral("Add to the scene"))->click();
    QCOMPARE(document().project().materials.back().base, std::string("wax"));
    QCOMPARE(selection().material(), std::string("wax"));
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), size_t{1});
  }

  /// The scene's water with another stiffness becomes a preset, comes back into the scene as a second water, and is
  /// read again when its file changes.
  void theScenesOwnBecomesAPreset() {
    selection().pickMaterial("water");
    QCOMPARE(document().setParameter(kStiffness, Response(2e6)), QString());
    name()->setText(QStringLiteral("Soft ice"));
    button(QStringLiteral("Save as preset"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(entry(QStringLiteral("Soft ice")), kLong);
    const LibraryEntry soft = *entry(QStringLiteral("Soft ice"));
    QCOMPARE(valueOf(soft.values, "youngs_modulus", 263), 2e6);
    QVERIFY(soft.tags.contains(QStringLiteral("Presets")));
    page()->choose(QStringLiteral("Soft ice"));
    button(QStringLiteral("Add to the scene"))->click();
    const SceneMaterial added = document().project().materials.back();
    QCOMPARE(added.id, std::string("water-2"));
    QCOMPARE(added.label, std::string("Soft ice"));
    QCOMPARE(std::get<Response>(document().value({Owner::Material, "water-2", "youngs_modulus"})).at(263), 2e6);
    document().undoStack().undo();
    document().undoStack().undo();
    // Another program writes the file.
    std::string text = readFile(soft.file.toStdString(), 1 << 20);
    const size_t at = text.find("2000000");
    QVERIFY(at != std::string::npos);
    writeFileAtomically(soft.file.toStdString(), text.replace(at, 7, "3000000"));
    QTRY_COMPARE_WITH_TIMEOUT(valueOf(entry(QStringLiteral("Soft ice"))->values, "youngs_modulus", 263), 3e6, kLong);
    QCOMPARE(page()->compared(), QStringList{QStringLiteral("Soft ice")});  // what was chosen stays so
  }

  void oneFileIsPassedOn() {
    const QString path = m_folder.filePath(QStringLiteral("passed.json"));
    library().exportTo(*entry(QStringLiteral("Soft ice")), path);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), kLong);
    library().removePreset(*entry(QStringLiteral("Soft ice")));
    QTRY_VERIFY_WITH_TIMEOUT(!entry(QStringLiteral("Soft ice")), kLong);
    library().importFrom(path);
    QTRY_VERIFY_WITH_TIMEOUT(entry(QStringLiteral("Soft ice")), kLong);
    QCOMPARE(valueOf(entry(QStringLiteral("Soft ice"))->values, "youngs_modulus", 263), 3e6);
  }

  /// Said, and nothing else is lost.
  void aBrokenFileIsSaid() {
    QSignalSpy said(&library(), &MaterialLibrary::said);
    const size_t before = library().entries().size();
    writeFileAtomically((library().folder() + QStringLiteral("/broken.json")).toStdString(), "{\"format\": 1}");
    QTRY_VERIFY_WITH_TIMEOUT(!said.isEmpty(), kLong);
    QVERIFY(said.front()[0].toBool() && said.front()[1].toString().contains(QStringLiteral("broken.json")));
    QCOMPARE(library().entries().size(), before);
    QVERIFY(QFile::remove(library().folder() + QStringLiteral("/broken.json")));
    QTest::keyClick(m_window.get(), Qt::Key_Escape);
    QVERIFY(!page()->isVisible());
  }

 private:
  MaterialLibrary& library() { return m_window->library().library(); }
  LibraryPage* page() { return m_window->library().page(); }
  Selection& selection() { return m_window->selection(); }
  const LibraryEntry* entry(const QString& label) {
    for (const LibraryEntry& each : library().entries())
      if (each.label == label) return &each;
    return nullptr;
  }
  const LibraryEntry* entryOf(const std::string& base) {
    for (const LibraryEntry& each : library().entries())
      if (each.material.base == base && each.file.isEmpty()) return &each;
    return nullptr;
  }
  QLineEdit* field(const QString& name) {
    for (QLineEdit* each : page()->findChildren<QLineEdit*>())
      if (each->accessibleName() == name) return each;
    return nullptr;
  }
  QLineEdit* name() { return field(QStringLiteral("Name of the preset")); }
  void search(const QString& text) { field(QStringLiteral("Search materials"))->setText(text); }
  QPushButton* button(const QString& text) {
    for (QPushButton* each : page()->findChildren<QPushButton*>())
      if (each->text() == text) return each;
    return nullptr;
  }
  void pictureOf(const char* name) {
    QTest::qWait(100);
    picture(QStringLiteral("tst_") + QString::fromLatin1(name) + QStringLiteral(".png"));
  }
  QTemporaryDir m_folder;
};

QTEST_MAIN(TestLibrary)
#include "tst_library.moc"
