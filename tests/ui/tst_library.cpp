// SPDX-License-Identifier: Apache-2.0
// The library of materials: search, phases at a glance, two side by side, presets that are kept, read again and passed
// on.
#include "core/io/mixing.h"
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/presets.h"
#include "ui/library/librarypage.h"
#include "ui/library/materialcard.h"
#include "ui/library/mixdialog.h"
#include "ui/library/mixpreview.h"
#include "ui/library/phaseview.h"
#include "ui/rows/filterfield.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/selection.h"
#include "ui/session/swatches.h"
#include "ui/session/worker.h"
#include "ui/theme/legend.h"
#include "ui/theme/units.h"
#include "ui/window/libraryactions.h"
#include "ui/window/noticebar.h"

#include <QtCore/QDir>
#include <QtCore/QMimeData>
#include <QtCore/QPointer>
#include <QtCore/QTemporaryDir>
#include <QtCore/QUrl>
#include <QtGui/QAction>
#include <QtGui/QDropEvent>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTreeWidget>

using namespace ps;

namespace {

constexpr int kSwatch = 44;                        // px, on a card
constexpr double kTile = 34, kHeader = 440.0 / 9;  // px, in the dock of materials, in the head of the inspector
const Address kStiffness{Owner::Material, "water", "youngs_modulus"};
constexpr const char* kSoap = R"({"format": "phasesketch-material", "version": 1, "id": "soap", "label": "Soap",
  "licence": "CC0-1.0", "properties": {"density_solid": 1050, "melting_temperature": 330, "youngs_modulus": 1e6}})";

}  // namespace

class TestLibrary : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    Theme::apply(*qApp, true);
    QDir(QFileInfo(swatchPath({}, kSwatch)).path()).removeRecursively();
    MainWindow::Options options;
    options.project = options.sample = kSample;
    options.restore = false;
    options.session.autosave = false;
    options.presets = m_folder.filePath(QStringLiteral("presets"));
    options.session.pluginPaths = {m_folder.path().toStdString()};
    writeSoap(1050);
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

  /// What was looked for the last time would hide what is looked for now; while the library is open the words stay.
  void theSearchBeginsAnewWhereTheLibraryIsOpened() {
    const qsizetype all = page()->shown().size();
    search(QStringLiteral("iron"));
    QVERIFY(page()->shown().size() < all);
    m_window->action(QStringLiteral("add.library"))->trigger();
    QVERIFY(page()->shown().size() < all);
    button(QStringLiteral("Back to the scene"))->click();
    QVERIFY(!page()->isVisible());
    m_window->action(QStringLiteral("add.library"))->trigger();
    QVERIFY(page()->isVisible());
    QCOMPARE(field(QStringLiteral("Search materials"))->text(), QString());
    QCOMPARE(page()->shown().size(), all);
  }

  /// Keys go to the search where the library is opened, also when it stands there already; what is left of the cards is
  /// chosen, and Enter adds it.
  void whatIsFoundIsAddedByEnter() {
    QAction* open = m_window->action(QStringLiteral("add.library"));
    open->trigger();
    QLineEdit* words = field(QStringLiteral("Search materials"));
    button(QStringLiteral("Add to the scene"))->setFocus();
    open->trigger();
    QCOMPARE(QApplication::focusWidget(), words);
    QTest::keyClicks(words, QStringLiteral("hemp"));
    QCOMPARE(page()->shown(), QStringList{QStringLiteral("Hemp")});
    QCOMPARE(page()->compared(), QStringList{QStringLiteral("Hemp")});
    const int steps = document().undoStack().index();
    QTest::keyClick(words, Qt::Key_Return);
    QCOMPARE(document().undoStack().index(), steps + 1);
    QCOMPARE(m_window->selection().material(), std::string("hemp"));
    search(QStringLiteral("no such matter"));
    QTest::keyClick(words, Qt::Key_Return);
    QCOMPARE(document().undoStack().index(), steps + 1);
    document().undoStack().undo();
    search({});
  }

  void phasesAtAGlance() {
    QCOMPARE(transitionsText(*entry(QStringLiteral("Water"))), QStringLiteral("melts at 0 °C, boils at 100 °C"));
    QVERIFY(transitionsText(*entryOf("co2")).startsWith(QStringLiteral("turns to gas at ")));
    QCOMPARE(transitionsText(*entryOf("wood")), QStringLiteral("decomposes at 327 °C"));
    QVERIFY(entryOf("iron")->tags.contains(QStringLiteral("Metals")));
    QVERIFY(entryOf("nitrogen")->tags.contains(QStringLiteral("Gases")));
    QCOMPARE(transitionsText(*entryOf("honey")), QStringLiteral("never freezes"));
    QVERIFY(entryOf("honey")->tags.contains(QStringLiteral("Liquids")));
    QVERIFY(entryOf("ethanol")->tags.contains(QStringLiteral("Liquids")));
  }

  /// What shows of them asks for its pictures.
  void cardsShowTheMatter() {
    const int side = qRound(kSwatch * page()->devicePixelRatioF());
    const QString path = swatchPath(swatchOf(library().entries().front()), side);
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo::exists(path), kLong);
    QSignalSpy arrived(&session().swatches(), &Swatches::arrived);
    while (arrived.wait(1000)) continue;
    pictureOf("library_swatches");
  }

  /// So do the dock and the inspector, with the values that the scene has given it.
  void docksShowTheMatter() {
    m_window->layoutOfDocks().showPage(QStringLiteral("Materials"));
    m_window->layoutOfDocks().showPage(QStringLiteral("Material"));
    selection().pickMaterial("water");
    const auto isDrawn = [&](double side) {
      const Swatch water = swatchOf(document().project(), session().plugins(), "water");
      return QFileInfo::exists(swatchPath(water, qRound(side * page()->devicePixelRatioF())));
    };
    QTRY_VERIFY_WITH_TIMEOUT(isDrawn(kTile) && isDrawn(kHeader), kLong);
    QCOMPARE(document().setParameter({Owner::Material, "water", "color_red"}, 0.13), QString());
    QTRY_VERIFY_WITH_TIMEOUT(isDrawn(kTile) && isDrawn(kHeader), kLong);
    document().undoStack().undo();
  }

  /// Each phase has its region, and what is seen is said as well.
  void phasesOverPressure() {
    auto* view = page()->findChild<PhaseView*>();
    page()->choose(QStringLiteral("Water"));
    QVERIFY(view && view->isVisible());
    const QString water = view->accessibleDescription();
    QVERIFY2(water.startsWith(
                 QStringLiteral("Water at 1 atm melts at 0 °C, boils at 100 °C; triple point at 0.0 °C and 612 Pa")) &&
                 water.endsWith(QStringLiteral("; critical point at 373.9 °C")),
             qPrintable(water));
    const auto pixels = [view](api::Phase phase) {
      const QImage image = view->grab().toImage();
      const QColor colour = colourMap(QStringLiteral("phase")).stops[static_cast<size_t>(phase)].second;
      int count = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y) == colour;
      }
      return count;
    };
    constexpr int kMany = 500;
    for (const api::Phase phase : {api::Phase::Solid, api::Phase::Liquid, api::Phase::Gas})
      QVERIFY2(pixels(phase) > kMany, qPrintable(QString::number(pixels(phase))));
    const QString honey = entryOf("honey")->label;
    page()->choose(honey, true);
    const QStringList both = view->accessibleDescription().split(QLatin1Char('\n'));
    QCOMPARE(both.size(), 2);
    QVERIFY(both.contains(water) && both.contains(honey + QStringLiteral(" at 1 atm never freezes")));
    page()->choose(honey);
    QVERIFY(pixels(api::Phase::Liquid) > kMany);
    QCOMPARE(pixels(api::Phase::Solid) + pixels(api::Phase::Gas), 0);
  }

  void searchAndTagsChoose() {
    search(QStringLiteral("candle"));  // in what is said of wax
    QCOMPARE(page()->shown(), QStringList{entryOf("wax")->label});
    search(QString());
    page()->setTag(QStringLiteral("Metals"));
    QVERIFY(page()->shown().contains(entryOf("iron")->label) && !page()->shown().contains(QStringLiteral("Water")));
    search(QStringLiteral("honey"));  // which the tag hides: it says so, and one click brings all back
    auto* nothing = page()->findChild<NothingFound*>();
    QVERIFY(page()->shown().isEmpty() && nothing && nothing->isVisibleTo(page()));
    QVERIFY2(nothing->text().startsWith(QStringLiteral("Nothing called “honey” among “Metals”.")),
             qPrintable(nothing->text()));
    Q_EMIT nothing->linkActivated(QStringLiteral("clear"));
    QCOMPARE(page()->shown().size(), static_cast<qsizetype>(library().entries().size()));
    QVERIFY(button(QStringLiteral("All %1").arg(library().entries().size()))->isChecked());
    QVERIFY(!button(QStringLiteral("Metals"))->isChecked() && !nothing->isVisibleTo(page()));
  }

  /// Words of files, of plugins as well.
  void tagsOfFilesChoose() {
    QVERIFY(entryOf("water")->tags.contains(QStringLiteral("Kitchen")));
    QVERIFY(button(QStringLiteral("Food")));
    page()->setTag(QStringLiteral("Food"));
    QVERIFY(page()->shown().contains(entryOf("honey")->label) && !page()->shown().contains(entryOf("iron")->label));
    page()->setTag({});
    search(QStringLiteral("geology"));
    QCOMPARE(page()->shown(), QStringList{entryOf("lava")->label});
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

  /// A card on the outliner's row of a body: the material comes into the scene and the body is of it, in one step.
  void aCardIsDroppedOnARow() {
    const auto items = page()->cards()->findItems(entryOf("wax")->label, Qt::MatchExactly);
    QVERIFY(!items.isEmpty());
    const auto data = hands::dragged(page()->cards()->model()->index(page()->cards()->row(items.front()), 0));
    const std::string body = document().project().bodies.front().id;
    const QModelIndex row = hands::outlined(*m_window, OutlineKind::Body, body);
    QVERIFY(data && row.isValid() && row.flags().testFlag(Qt::ItemIsDropEnabled));
    auto* model = const_cast<QAbstractItemModel*>(row.model());
    QVERIFY(!model->canDropMimeData(data.get(), Qt::CopyAction, -1, -1, row.parent()));
    QVERIFY(model->canDropMimeData(data.get(), Qt::CopyAction, -1, -1, row));
    const std::string before = document().body(body)->material;
    const int steps = document().undoStack().index();
    model->dropMimeData(data.get(), Qt::CopyAction, -1, -1, row);
    QCOMPARE(document().body(body)->material, std::string("wax"));
    QCOMPARE(document().undoStack().index(), steps + 1);
    document().undoStack().undo();
    QCOMPARE(document().body(body)->material, before);
    QCOMPARE(document().project().materials.size(), size_t{1});
  }

  /// In the view the body under the pointer is the one, and marked meanwhile; beside bodies and on locked ones nothing
  /// is taken. Files are the window's, there too.
  void aMaterialIsDroppedInTheView() {
    session().pause();
    QTest::keyClick(m_window.get(), Qt::Key_Escape);
    QTRY_VERIFY_WITH_TIMEOUT(view()->isVisible() && view()->snapshot() && !view()->snapshot()->position.empty(), kLong);
    view()->frameAll();
    const auto [on, beside, body] = aimed();
    QVERIFY(!body.empty() && !beside.isNull());
    QMimeData data;
    data.setData(QLatin1String(kInstalledMime), "wax");
    QVERIFY(enters(on, data));
    QCOMPARE(target(on, data), std::pair(true, body));
    pictureOf("material_dragged");
    QVERIFY(view()->dropNote().isEmpty());
    QCOMPARE(target(beside, data), std::pair(false, std::string()));
    QCOMPARE(view()->dropNote(), QStringLiteral("Drop it on a body."));
    const int steps = document().undoStack().index();
    drop(beside, data);
    QCOMPARE(document().project().materials.size(), size_t{1});
    QVERIFY(enters(on, data));
    document().setLocked({{Owner::Body, body, ""}}, true);
    QCOMPARE(target(on, data), std::pair(false, std::string()));
    QVERIFY2(view()->dropNote().contains(QStringLiteral("is locked. Unlock it")), qPrintable(view()->dropNote()));
    pictureOf("material_refused");
    drop(on, data);
    QVERIFY(view()->dropNote().isEmpty());
    QCOMPARE(document().project().materials.size(), size_t{1});
    document().undoStack().undo();
    QVERIFY(enters(on, data));
    drop(on, data);
    QCOMPARE(document().body(body)->material, std::string("wax"));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY(view()->dropTarget().empty());
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), size_t{1});
    QMimeData file, text;
    file.setUrls({QUrl::fromLocalFile(kSample)});
    text.setText(QStringLiteral("wax"));
    QVERIFY(enters(on, file));
    QVERIFY(!enters(on, text));
    m_window->action(QStringLiteral("add.library"))->trigger();
  }

  /// All that are selected take it in one step, but for locked ones; what is not selected takes it alone.
  void severalBodiesTakeOneMaterial() {
    const std::string first = document().project().bodies.front().id;
    const int steps = document().undoStack().index();
    std::vector<std::string> ids{first};
    for (const double x : {0.2, 0.4, 0.6}) {
      Body body = *document().body(first);
      std::get<BoxShape>(body.shape).center.x() = x;
      ids.push_back(document().addBody(std::move(body)));
    }
    document().setLocked({{Owner::Body, ids[2], ""}}, true);
    selection().selectAll({{OutlineKind::Body, ids[0]}, {OutlineKind::Body, ids[1]}, {OutlineKind::Body, ids[2]}});
    QCOMPARE(takersOf(document(), selection(), ids[0]), (std::vector<std::string>{ids[0], ids[1]}));
    QCOMPARE(takersOf(document(), selection(), ids[3]), std::vector<std::string>{ids[3]});
    QVERIFY(takersOf(document(), selection(), ids[2]).empty());
    QMimeData data, same;
    data.setData(QLatin1String(kInstalledMime), "wax");
    same.setData(QLatin1String(kMaterialMime), "wax");
    const int before = document().undoStack().index();
    QVERIFY(giveMaterial(document(), takersOf(document(), selection(), ids[1]), data));
    QCOMPARE(document().undoStack().index(), before + 1);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("material of 2 bodies"));
    const auto of = [&](size_t k) { return document().body(ids[k])->material; };
    QVERIFY(of(0) == "wax" && of(1) == "wax" && of(2) != "wax" && of(3) != "wax");
    // What they are already is no step.
    QVERIFY(giveMaterial(document(), {ids[0], ids[1]}, data) && giveMaterial(document(), {ids[0]}, same));
    QCOMPARE(document().undoStack().index(), before + 1);
    document().undoStack().undo();
    QVERIFY(of(0) == of(3) && of(1) == of(3));
    QCOMPARE(document().project().materials.size(), size_t{1});
    while (document().undoStack().index() > steps) document().undoStack().undo();
  }

  /// A preset is carried whole, with its values.
  void aPresetIsDroppedInTheView() {
    SceneMaterial preset;
    preset.id = preset.base = "wax";
    preset.label = "Stiff wax";
    preset.properties.values["youngs_modulus"] = Response(3e6);
    QMimeData data, broken;
    carryPreset(data, preset);
    broken.setData(QLatin1String(kPresetMime), "{");
    const std::string body = document().project().bodies.front().id;
    QVERIFY(carriesMaterial(data) && !giveMaterial(document(), {"nobody"}, data));
    QVERIFY(carriesMaterial(broken) && !giveMaterial(document(), {body}, broken));
    QVERIFY(giveMaterial(document(), {body}, data));
    const Address stiffness{Owner::Material, document().body(body)->material, "youngs_modulus"};
    QCOMPARE(std::get<Response>(document().value(stiffness)).at(300), 3e6);
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), size_t{1});
  }

  /// The view comes in the page's place while a card is dragged, and the page comes back where nothing took it.
  /// It is written beside one: what asks for that one must not get it.
  void aMixtureIsNoInstalledOne() {
    Project project;
    SceneMaterial material;
    material.id = "alloy";
    material.base = "water";
    material.mixture = std::make_shared<const Mixture>();
    project.materials.push_back(material);
    QVERIFY(!installedIn(project, "water"));
    material.id = "water";
    material.mixture.reset();
    project.materials.push_back(material);
    QCOMPARE(installedIn(project, "water")->id, std::string("water"));
  }

  void thePageMakesRoomForADrag() {
    QVERIFY(page()->isVisible());
    Q_EMIT page()->carrying();
    QVERIFY(!page()->isVisible() && view()->isVisible());
    Q_EMIT page()->broughtBack();
    QVERIFY(page()->isVisible());
  }

  /// Of a material that the scene is not made of: at once, and said; a broken file once, and what was read stays.
  void anInstalledFileIsReadAgain() {
    QSignalSpy said(&library(), &MaterialLibrary::said);
    QCOMPARE(valueOf(entryOf("soap")->values, "density_solid", 290), 1050.0);
    writeSoap(1060);
    QTRY_COMPARE_WITH_TIMEOUT(valueOf(entryOf("soap")->values, "density_solid", 290), 1060.0, kLong);
    QCOMPARE(session().plugins()->material("soap")->properties.at("density_solid").constant, 1060.0);
    QVERIFY(library().waiting().isEmpty() && !document().isDirty());
    QCOMPARE(said.size(), 1);
    QVERIFY(!said[0][0].toBool() && said[0][1].toString().startsWith(QStringLiteral("“Soap” was read again from /")));
    QVERIFY(session().log().messages().back().text == said[0][1].toString());
    said.clear();
    writeSoap(-1);
    QTRY_VERIFY_WITH_TIMEOUT(!said.isEmpty(), kLong);
    const QString problem = said[0][1].toString();
    QVERIFY2(said[0][0].toBool() && problem.contains(QStringLiteral("soap.json:/properties/density_solid")) &&
                 problem.endsWith(QStringLiteral("; what was read before stays")),
             qPrintable(problem));
    QCOMPARE(valueOf(entryOf("soap")->values, "density_solid", 290), 1060.0);
    QSignalSpy changed(&library(), &MaterialLibrary::changed);
    library().read();
    QTRY_VERIFY_WITH_TIMEOUT(!changed.isEmpty(), kLong);
    QCOMPARE(said.size(), 1);
    writeSoap(1060);
    QTRY_VERIFY_WITH_TIMEOUT(changed.size() > 1, kLong);
  }

  /// A scene goes on with what its run is made of, until somebody takes the new values; its own stay in any case.
  void aSceneIsNotChangedSilently() {
    const std::string body = document().project().bodies.front().id;
    const int steps = document().undoStack().index();
    document().setBodyMaterial(body, document().addMaterial("soap"));
    QCOMPARE(document().setParameter({Owner::Material, "soap", "youngs_modulus"}, Response(2e6)), QString());
    QTRY_COMPARE_WITH_TIMEOUT(inEngine("density_solid"), 1060.0, kLong);
    writeSoap(1070);
    QTRY_COMPARE_WITH_TIMEOUT(library().waiting(), QStringList{QStringLiteral("Soap")}, kLong);
    QCOMPARE(valueOf(entryOf("soap")->values, "density_solid", 290), 1070.0);
    QCOMPARE(inEngine("density_solid"), 1060.0);
    QCOMPARE(document().setParameter({Owner::Material, "soap", "youngs_modulus"}, Response(3e6)), QString());
    QTRY_COMPARE_WITH_TIMEOUT(inEngine("youngs_modulus"), 3e6, kLong);
    QCOMPARE(inEngine("density_solid"), 1060.0);
    auto* bar = m_window->findChild<NoticeBar*>();
    QVERIFY(bar && bar->text().contains(QStringLiteral("goes on with the values that it began with")));
    pictureOf("material_changed_on_disk");
    const uint64_t revision = session().newest()->revision;
    for (QPushButton* each : bar->findChildren<QPushButton*>())
      if (each->text() == QStringLiteral("Take the new ones, back to the start")) each->click();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->revision != revision, kLong);
    QCOMPARE(inEngine("density_solid"), 1070.0);
    QCOMPARE(inEngine("youngs_modulus"), 3e6);
    QVERIFY(library().waiting().isEmpty());
    QVERIFY(!bar->isVisible() || !bar->text().contains(QStringLiteral("goes on with")));
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > 0, kLong);
    while (document().undoStack().index() > steps) document().undoStack().undo();
    // Frames of the run were made of it, and can be looked at and made again.
    writeSoap(1080);
    QTRY_COMPARE_WITH_TIMEOUT(library().waiting(), QStringList{QStringLiteral("Soap")}, kLong);
    const uint64_t soapy = session().newest()->revision;
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->revision != soapy, kLong);
    library().read();
    QTRY_VERIFY_WITH_TIMEOUT(library().waiting().isEmpty(), kLong);
    QCOMPARE(session().plugins()->material("soap")->properties.at("density_solid").constant, 1080.0);
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
    QVERIFY(session().log().messages().back().text.startsWith(QStringLiteral("“Soft ice” was read again from ")));
    // Broken, it stays as it was.
    QSignalSpy said(&library(), &MaterialLibrary::said);
    writeFileAtomically(soft.file.toStdString(), std::string(text).replace(at, 7, "\"soft\""));
    QTRY_VERIFY_WITH_TIMEOUT(!said.isEmpty(), kLong);
    const QString problem = said[0][1].toString();
    QVERIFY2(said[0][0].toBool() && problem.startsWith(soft.file + QStringLiteral(":/materials/0/")) &&
                 problem.endsWith(QStringLiteral("; what was read before stays")),
             qPrintable(problem));
    QCOMPARE(valueOf(entry(QStringLiteral("Soft ice"))->values, "youngs_modulus", 263), 3e6);
    said.clear();
    writeFileAtomically(soft.file.toStdString(), text);
    QSignalSpy changed(&library(), &MaterialLibrary::changed);
    QTRY_VERIFY_WITH_TIMEOUT(!changed.isEmpty(), kLong);
    QVERIFY(said.isEmpty());
  }

  /// At first those of what it is of; they are written to its file, where nothing else changes.
  void aPresetHasTagsOfItsOwn() {
    page()->choose(QStringLiteral("Soft ice"));
    QLineEdit* words = field(QStringLiteral("Tags"));
    QVERIFY(words && words->isVisibleTo(page()));
    QCOMPARE(words->text(), QStringLiteral("cold, ice, kitchen"));
    const auto type = [words](const char* text) {
      words->setFocus();
      words->selectAll();
      QTest::keyClicks(words, QString::fromLatin1(text));
      QTest::keyClick(words, Qt::Key_Return);
    };
    type("Glacier,  kitchen,");
    QTRY_VERIFY_WITH_TIMEOUT(entry(QStringLiteral("Soft ice"))->tags.contains(QStringLiteral("Glacier")), kLong);
    QCOMPARE(entry(QStringLiteral("Soft ice"))->material.tags, (std::vector<std::string>{"Glacier", "kitchen"}));
    QCOMPARE(valueOf(entry(QStringLiteral("Soft ice"))->values, "youngs_modulus", 263), 3e6);
    QCOMPARE(words->text(), QStringLiteral("Glacier, kitchen"));
    search(QStringLiteral("glacier"));
    QCOMPARE(page()->shown(), QStringList{QStringLiteral("Soft ice")});
    QSignalSpy said(&library(), &MaterialLibrary::said);
    type("ice, Ice");
    QCOMPARE(said.size(), 1);
    QVERIFY(said[0][0].toBool());
    QCOMPARE(said[0][1].toString(), QStringLiteral("The tag “Ice” stands here twice."));
    QVERIFY(entry(QStringLiteral("Soft ice"))->tags.contains(QStringLiteral("Glacier")));
    page()->choose(QStringLiteral("Water"));
    QVERIFY(!words->isVisibleTo(page()));
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

  /// Two chosen cards become a material of the scene, whose share can be changed, each in one step; it is kept as a
  /// preset with what it is made of. What makes no mixture is said.
  void twoAreMixed() {
    page()->choose(entryOf("tin")->label);
    page()->choose(entryOf("lead")->label, true);
    const size_t before = document().project().materials.size();
    MixDialog* dialog = opened(QStringLiteral("Mix…"));
    QVERIFY(dialog && dialog->chooseParts(entryOf("tin")->key(), entryOf("lead")->key()));
    QVERIFY(dialog->share()->enterNumber(0.37));
    QCOMPARE(dialog->problem(), QString());
    const auto rows = dialog->table()->findItems(QStringLiteral("Density, solid"), Qt::MatchExactly);
    QVERIFY(rows.size() == 1 && rows.front()->text(4).startsWith(QStringLiteral("volumes add up")));
    QVERIFY(!dialog->preview()->curve(MixPreview::Mixed).empty());
    for (const auto which : {MixPreview::First, MixPreview::Second, MixPreview::Mixed})
      QVERIFY(dialog->preview()->swatch(which));
    QCOMPARE(*dialog->preview()->swatch(MixPreview::First), swatchOf(entryOf("tin")->values));
    QTest::qWait(50);
    dialog->grab().save(QStringLiteral("mix_dialog.png"));
    press(*dialog, QStringLiteral("Add to the scene"));
    QCOMPARE(document().project().materials.size(), before + 1);
    const std::string id = selection().material();
    const Address density{Owner::Material, id, "density_solid"};
    const double first = std::get<Response>(document().value(density)).at(290);
    QVERIFY(std::abs(first - 1 / (0.63 / 7287 + 0.37 / 11340)) < 1e-6 * first);
    MixDialog* again = opened(QStringLiteral("Change the mixture…"));
    QVERIFY(again && again->share()->enterNumber(0.6));
    press(*again, QStringLiteral("Change"));
    QVERIFY(std::get<Response>(document().value(density)).at(290) > first);
    QCOMPARE(document().project().materials.back().mixture->share, 0.6);
    name()->setText(QStringLiteral("Solder"));
    button(QStringLiteral("Save as preset"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(entry(QStringLiteral("Solder")), kLong);
    QVERIFY(entry(QStringLiteral("Solder"))->about.startsWith(QStringLiteral("A mixture of 40")));
    QVERIFY(entry(QStringLiteral("Solder"))->material.mixture);
    document().undoStack().undo();
    QCOMPARE(std::get<Response>(document().value(density)).at(290), first);
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), before);
    library().removePreset(*entry(QStringLiteral("Solder")));
    QTRY_VERIFY_WITH_TIMEOUT(!entry(QStringLiteral("Solder")), kLong);
    MixDialog* never = opened(QStringLiteral("Mix…"));
    QVERIFY(never && never->chooseParts(entryOf("iron")->key(), entryOf("water")->key()));
    QVERIFY2(never->problem().contains(QStringLiteral("boils before")), qPrintable(never->problem()));
    QVERIFY(never->preview()->curve(MixPreview::Mixed).empty());
    press(*never, QStringLiteral("Cancel"));
  }

  /// A form that is open before the library has come has its materials then. Of two with one label each stays itself.
  void aMixFollowsTheLibrary() {
    Session::Options options;
    options.autosave = false;
    Session early(options);
    MaterialLibrary empty(early, m_folder.filePath(QStringLiteral("presets")));
    Selection none(early.document());
    MixDialog waits(empty, early, none, QString(), QString());
    QSignalSpy filled(waits.table()->model(), &QAbstractItemModel::modelReset);
    Q_EMIT empty.changed();
    QTest::qWait(300);  // it reads 0.2 s later
    QVERIFY(filled.isEmpty());
    early.start();
    QTRY_VERIFY_WITH_TIMEOUT(!filled.isEmpty(), kLong);
    QCOMPARE(waits.findChildren<QComboBox*>().back()->currentIndex(), 1);

    SceneMaterial other = entryOf("tin")->material;
    other.properties.values["density_solid"] = 6000.0;
    library().savePreset(other, entryOf("tin")->label);
    const auto preset = [&]() -> const LibraryEntry* {
      for (const LibraryEntry& each : library().entries())
        if (each.label == entryOf("tin")->label && !each.file.isEmpty()) return &each;
      return nullptr;
    };
    QTRY_VERIFY_WITH_TIMEOUT(preset(), kLong);
    MixDialog* mix = opened(QStringLiteral("Mix…"));
    QVERIFY(mix && mix->chooseParts(preset()->key(), entryOf("lead")->key()));
    const auto density = [&] {
      const auto rows = mix->table()->findItems(QStringLiteral("Density, solid"), Qt::MatchExactly);
      return rows.isEmpty() ? mix->problem() : rows.front()->text(1);
    };
    const QString chosen = density();
    QSignalSpy again(mix->table()->model(), &QAbstractItemModel::modelReset);
    QSignalSpy known(&library(), &MaterialLibrary::changed);
    library().read();
    QTRY_VERIFY_WITH_TIMEOUT(!known.isEmpty(), kLong);
    QTest::qWait(300);         // it reads 0.2 s later
    QVERIFY(again.isEmpty());  // all is as it was
    const QString more = QStringLiteral("Another tin");
    library().savePreset(other, more);
    QTRY_VERIFY_WITH_TIMEOUT(!again.isEmpty(), kLong);
    QCOMPARE(density(), chosen);
    QVERIFY(mix->chooseParts(entryOf("tin")->key(), entryOf("lead")->key()));
    QVERIFY(density() != chosen);
    press(*mix, QStringLiteral("Cancel"));
    library().removePreset(*preset());
    library().removePreset(*entry(more));
    QTRY_VERIFY_WITH_TIMEOUT(!preset() && !entry(more), kLong);
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

  /// The window stays in use: the form's parts follow the scene, a second asking brings the same one forward, and it
  /// goes with the material or the project that it was about.
  void aMixStandsBesideTheScene() {
    page()->choose(entryOf("tin")->label);
    const QPointer<MixDialog> mix = opened(QStringLiteral("Mix…"));
    QVERIFY(mix && !mix->isModal());
    QVERIFY(opened(QStringLiteral("Mix…")) == mix);
    const QString own = QStringLiteral("scene:water");
    QVERIFY(mix->chooseParts(own, entryOf("ethanol")->key()) && mix->problem().isEmpty());
    const auto density = [&] {
      const auto rows = mix->table()->findItems(QStringLiteral("Density, liquid"), Qt::MatchExactly);
      return rows.isEmpty() ? mix->problem() : rows.front()->text(1);
    };
    const QString before = density();
    const Address liquid{Owner::Material, "water", "density_liquid"};
    QCOMPARE(document().setParameter(liquid, Response(700)), QString());
    QTRY_VERIFY(density() != before);
    document().undoStack().undo();
    QTRY_COMPARE(density(), before);
    QSignalSpy filled(mix->table()->model(), &QAbstractItemModel::modelReset);
    const std::string colour = document().project().view.colour;
    document().setColour("pressure");  // which no material has to do with
    document().setColour(colour);
    QTest::qWait(300);  // what it follows, it follows 0.2 s later
    QVERIFY(filled.isEmpty());
    QVERIFY(mix->chooseParts(entryOf("tin")->key(), entryOf("lead")->key()));
    press(*mix, QStringLiteral("Add to the scene"));
    QTRY_VERIFY(!mix);
    const QPointer<MixDialog> change = opened(QStringLiteral("Change the mixture…"));
    QVERIFY(change && change->windowTitle().contains(entryOf("lead")->label));
    document().undoStack().undo();  // there is no such mixture any more
    QTRY_VERIFY(!change);
    const QPointer<MixDialog> last = opened(QStringLiteral("Mix…"));
    QVERIFY(last);
    m_window->openFile(kSample);
    QTRY_VERIFY_WITH_TIMEOUT(!last, kLong);
  }

 private:
  /// What a button of the page opens; nullptr: nothing.
  MixDialog* opened(const QString& text) {
    button(text)->click();
    const auto all = m_window->findChildren<MixDialog*>();
    return all.isEmpty() ? nullptr : all.back();
  }
  static void press(MixDialog& dialog, const QString& text) {
    for (QPushButton* each : dialog.findChildren<QPushButton*>()) {
      if (each->text() == text) return each->click();
    }
    QFAIL(qPrintable(text));
  }
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
  void writeSoap(double density) {
    std::string text = kSoap;
    writeFileAtomically(m_folder.filePath(QStringLiteral("soap.json")).toStdString(),
                        text.replace(text.find("1050"), 4, std::to_string(static_cast<int>(density))));
  }
  /// What the run's table of soap has at 290 K.
  double inEngine(const char* key) {
    return onEngine<double>(session(), [key](Engine& engine) {
      for (const BakedMaterial& table : engine.solver().materials())
        if (std::string(table.id()) == "soap") return table.property(key, 290);
      return 0.0;
    });
  }
  struct Aimed {
    QPointF on, beside;
    std::string body;
  };
  /// A place of the view over a body, and one over nothing.
  Aimed aimed() {
    Aimed found;
    std::vector<QPointF> over;
    const QSize size = view()->size();
    const Snapshot& scene = *view()->snapshot();
    for (int y = 5; y < size.height(); y += 10) {
      for (int x = 5; x < size.width(); x += 10) {
        const auto hit =
            pickParticle(scene, rayThrough(view()->navigator().camera(), size.width(), size.height(), x, y));
        if (!hit) found.beside = QPointF(x, y);
        if (!hit || (!found.body.empty() && (*scene.bodyIds)[scene.body[*hit]] != found.body)) continue;
        over.emplace_back(x, y);
        found.body = (*scene.bodyIds)[scene.body[*hit]];
      }
    }
    if (!over.empty()) found.on = over[over.size() / 2];  // well within: at its edge it may move away
    return found;
  }
  bool enters(const QPointF& at, const QMimeData& data) {
    QDragEnterEvent enter(at.toPoint(), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    enter.ignore();
    QApplication::sendEvent(view(), &enter);
    return enter.isAccepted();
  }
  std::pair<bool, std::string> target(const QPointF& at, const QMimeData& data) {
    QDragMoveEvent move(at.toPoint(), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(view(), &move);
    return {move.isAccepted(), view()->dropTarget()};
  }
  void drop(const QPointF& at, const QMimeData& data) {
    QDropEvent drop(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(view(), &drop);
  }
  void pictureOf(const char* name) {
    QTest::qWait(100);
    picture(QStringLiteral("tst_") + QString::fromLatin1(name) + QStringLiteral(".png"));
  }
  QTemporaryDir m_folder;
};

QTEST_MAIN(TestLibrary)
#include "tst_library.moc"
