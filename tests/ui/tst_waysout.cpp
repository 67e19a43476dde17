// SPDX-License-Identifier: Apache-2.0
// What messages name, and the ways out that they offer: plugins that are missing, notes of the step, files' names.
#include "core/io/projectio.h"
#include "core/plugin_host/pluginscan.h"
#include "core/plugin_host/registry.h"
#include "tests/shared/scenes.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/missingplugins.h"
#include "ui/panels/inspector.h"
#include "ui/panels/messagespage.h"
#include "ui/panels/outliner.h"
#include "ui/panels/pluginpage.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/documentfiles.h"
#include "ui/session/fileproblem.h"
#include "ui/session/messagelog.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/window/dock.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"
#include "ui/window/waysout.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QFile>
#include <QtCore/QMap>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>
#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <clocale>
#include <nlohmann/json.hpp>

using namespace ps;

namespace {

constexpr const char* kGone = "org.example.bingham";

/// Water, a block of a material that is not installed, and one that is held together by what is not.
Project sceneOfMissing() {
  Project project = scenes::iceOnPlate(4, 280);
  SceneMaterial paste;
  paste.id = "paste";
  paste.base = kGone;
  paste.label = "Bingham paste";
  paste.properties.values["density_solid"] = 1234.0;
  paste.parameters.values["yield"] = 5.0;
  project.materials.push_back(paste);
  Body block = project.bodies.front();
  block.id = "block";
  block.name = "Block";
  block.material = "paste";
  block.constraints.clear();
  std::get<BoxShape>(block.shape).center[1] += 0.2;
  Body net = block;
  net.id = "net";
  net.name = "Net";
  net.material = project.bodies.front().material;
  net.constraints.push_back(BodyConstraint{"org.example.net", {}, {}});
  std::get<BoxShape>(net.shape).center[1] += 0.2;
  project.bodies.push_back(block);
  project.bodies.push_back(net);
  return project;
}

/// Wood that bonds hold beside water, which comes first.
Project woodBesideWater() {
  Project project = scenes::iceOnPlate(4, 280);
  SceneMaterial wood;
  wood.id = wood.base = "wood";
  wood.label = "Wood";
  project.materials.push_back(wood);
  Body block = project.bodies.front();
  block.id = "block";
  block.name = "Block";
  block.material = "wood";
  block.constraints = {BodyConstraint{"bonds", {}, {}}};
  std::get<BoxShape>(block.shape).center[1] += 0.2;
  project.bodies.push_back(block);
  return project;
}

constexpr const char* kBroken =
    "{\n"
    "  \"materials\": [\n"
    "    {\"id\": \"w\", \"base\": \"water\"},\n"
    "    {\"id\": \"wood\", \"label\": \"Wood\", \"tags\": [\"a, ]}\", \"\\\"{\"],\n"
    "     \"properties\": {\n"
    "       \"density_solid\": -5\n"
    "     }}],\n"
    "  \"bodies\": [],\n"
    "  \"environment\": {\"walls\": [{\"id\": \"p\", \"name\": \"Hot plate\", \"temperature\": 5}]},\n"
    "  \"solver\": {\"substeps\": 0}\n"
    "}";

QString joined(const MessageLog& log) { return log.allText(); }

}  // namespace

class TestWaysOut : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void cleanupTestCase() { m_window.reset(); }

  void whatIsMissingIsSaidWithItsNames() {
    const std::vector<MissingPlugin> all = missingPlugins(sceneOfMissing(), *session().plugins());
    QCOMPARE(all.size(), size_t{2});
    QCOMPARE(all[0].material, std::string("paste"));
    QCOMPARE(all[0].rows, (std::vector<Address>{{Owner::Body, "block", "material"}}));
    QCOMPARE(all[1].rows, (std::vector<Address>{{Owner::Body, "net", "structure"}}));
    QCOMPARE(missingText(all[0], sceneOfMissing(), *session().plugins()),
             QStringLiteral("The material “Bingham paste” needs the plugin “org.example.bingham”, which is not "
                            "installed. “Block” stands still meanwhile. All values are kept."));
    QCOMPARE(missingText(all[1], sceneOfMissing(), *session().plugins()),
             QStringLiteral("What holds “Net” together needs the plugin “org.example.net”, which is not installed. "
                            "“Net” stands still meanwhile. All values are kept."));
  }

  /// Over the view, in the messages, in the material's header and under the rows that chose it.
  void aMissingPluginOffersWaysOut() {
    openProject(sceneOfMissing());
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("Bingham paste")));
    QVERIFY(noticeButton(*m_window, QStringLiteral("Find plugin…")));
    QVERIFY(noticeButton(*m_window, QStringLiteral("Use another material…")));
    const std::vector<Message>& log = session().log().messages();
    const auto said = std::find_if(log.begin(), log.end(), [](const Message& m) {
      return m.text.contains(QStringLiteral("Bingham paste")) && m.links.size() == 2;
    });
    QVERIFY(said != log.end());
    QVERIFY2(!joined(session().log()).contains(QStringLiteral(":/materials/")), "the same, said by its path");
    Inspector& inspector = m_window->inspector();
    m_window->selection().selectBody("block");
    ParameterRow* row = inspector.bodyPanel()->row(QStringLiteral("body/block/material"));
    QVERIFY(row);
    QVERIFY(labelOf(*row).contains(QStringLiteral("plugin:org.example.bingham")));
    QVERIFY(labelOf(*inspector.materialPanel()).contains(QStringLiteral("material:paste")));
    m_window->selection().selectBody("net");
    row = inspector.bodyPanel()->row(QStringLiteral("body/net/structure"));
    QVERIFY(row && labelOf(*row).contains(QStringLiteral("plugin:org.example.net")));
    inspector.setMaterial("water");
    QVERIFY(!labelOf(*inspector.materialPanel()).contains(QStringLiteral("material:paste")));
  }

  /// What was said of one project is not taken for what is said of the next, and leads nowhere there.
  void messagesOfAnotherProjectSaySo() {
    openProject(sceneOfMissing());
    m_window->layoutOfDocks().showPage(QStringLiteral("Messages"));
    auto* list = m_window->findChild<MessagesPage*>()->findChild<QTreeView*>();
    QString about = QStringLiteral("Bingham paste");
    const auto shown = [&] {
      QStringList texts;
      for (int row = 0; row < list->model()->rowCount(); ++row) {
        const QString text = list->model()->index(row, 2).data().toString();
        if (text.contains(about)) texts << text;
      }
      return texts;
    };
    QVERIFY(!shown().isEmpty());
    session().log().add(MessageLevel::Warning, QStringLiteral("VR"), QStringLiteral("No headset is worn."));
    for (const QString& text : shown()) QVERIFY(!text.startsWith(QStringLiteral("Of the project before: ")));
    QTest::qWait(1100);  // what is said within a second is of the opening
    session().files().newProject();
    QTRY_VERIFY_WITH_TIMEOUT(shown().front().startsWith(QStringLiteral("Of the project before: ")), kLong);
    for (const QString& text : shown()) QVERIFY(text.startsWith(QStringLiteral("Of the project before: ")));
    about = QStringLiteral("No headset is worn");  // of the program, whatever is open
    QCOMPARE(shown(), QStringList{QStringLiteral("No headset is worn.")});
    m_window->layoutOfDocks().showPage(QStringLiteral("Graphs"));
  }

  /// What lacks its plugin stands still, marked in the outliner, with all that the project says of it.
  void theRestRunsBesideWhatIsMissing() {
    openProject(sceneOfMissing());
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->bodyIds && session().newest()->bodyIds->size() == 3, kLong);
    const std::string kept = writeProject(document().project());
    const Mean ice = meanOf("ice"), block = meanOf("block"), net = meanOf("net");
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > 10, kLong);
    session().pause();
    idsNow(session());  // no frame comes any more
    QVERIFY2(meanOf("ice").kelvin > ice.kelvin,
             qPrintable(QStringLiteral("%1 K after %2").arg(meanOf("ice").kelvin - ice.kelvin).arg(ice.kelvin)));
    QVERIFY(session().newest()->stats.heat.walls > 0);
    QCOMPARE(meanOf("block").place, block.place);
    QCOMPARE(meanOf("net").place, net.place);
    QMap<QString, bool> marked;
    const QAbstractItemModel* rows = m_window->outliner()->view()->model();
    const QModelIndex scene = rows->index(0, 0);
    for (int row = 0; row < rows->rowCount(scene); ++row) {
      const QModelIndex index = rows->index(row, 0, scene);
      if (index.data(outline::kKind).toInt() == static_cast<int>(OutlineKind::Body))
        marked[index.data(outline::kId).toString()] = index.data(outline::kPlaceholder).toBool();
    }
    QCOMPARE(marked, (QMap<QString, bool>{{"block", true}, {"ice", false}, {"net", true}}));
    QCOMPARE(writeProject(document().project()), kept);
  }

  /// What plugins that are not here were given stands in rows that nobody can edit, and goes into the file as it was.
  void whatIsKeptForThemIsShown() {
    nlohmann::json file = nlohmann::json::parse(writeProject(sceneOfMissing()));
    const nlohmann::json law = {{"points", {{1, 2}, {3, 4}}}};
    auto& net = file["bodies"].back();
    net["constraints"][0]["parameters"] = {{"tear_strain", 0.25}, {"sticky", true}, {"weave", "plain"}, {"law", law}};
    net["constraints"].push_back({{"plugin", "org.example.other"}});
    file["solver"]["thermal"]["sources"] = {{{"plugin", "org.example.lamp"}, {"parameters", {{"power", 40}}}}};
    const Project project = parseProject(file.dump(), "kept.json", *session().plugins()).project;
    openProject(project);
    const std::string before = writeProject(document().project());
    m_window->selection().selectBody("net");
    const auto rowOf = [&](ParameterPanel* panel, const char* key) { return panel->row(QString::fromLatin1(key)); };
    ParameterPanel* body = m_window->inspector().bodyPanel();
    const auto shows = [&](const char* key, const QString& text) {
      const ParameterRow* row = rowOf(body, key);
      return row && row->valueText() == text && row->has(RowState::Disabled) &&
             row->model().disabledReason.contains(QStringLiteral("Values are kept"));
    };
    QVERIFY(shows("constraint/net/org.example.net/tear_strain", QStringLiteral("0.250")));
    QVERIFY(shows("constraint/net/org.example.net/weave", QStringLiteral("plain")));
    QVERIFY(shows("constraint/net/org.example.net/law", QString::fromStdString(law.dump())));
    QVERIFY(rowOf(body, "constraint/net/org.example.net/sticky")->model().value == Value(true));
    QVERIFY(rowOf(body, "constraint/net/org.example.other/values"));
    ParameterRow* other = rowOf(body, "body/net/uses.org.example.other");
    QVERIFY(other && labelOf(*other).contains(QStringLiteral("plugin:org.example.other")));
    const auto panels = m_window->findChildren<ParameterPanel*>();
    QVERIFY(std::any_of(panels.begin(), panels.end(), [&](ParameterPanel* panel) {
      return rowOf(panel, "heat_source/org.example.lamp/power") != nullptr;
    }));
    m_window->inspector().setMaterial("paste");
    QVERIFY(rowOf(m_window->inspector().materialPanel(), "material/paste/yield"));
    QTest::qWait(100);
    picture(QStringLiteral("kept-rows.png"));
    // Its menu offers what acts alone.
    QStringList offered;
    ParameterRow* sticky = rowOf(body, "constraint/net/org.example.net/sticky");
    QTimer::singleShot(0, sticky, [&offered] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      if (!menu) {  // else it would wait for good
        for (QWidget* shown : QApplication::topLevelWidgets())
          if (qobject_cast<QMenu*>(shown)) shown->close();
      }
      QVERIFY(menu);
      for (const QAction* action : menu->actions()) {
        if (!action->isSeparator() && action->isEnabled()) offered << action->text();
      }
      QTest::keyClick(menu, Qt::Key_Escape);
    });
    QContextMenuEvent ask(QContextMenuEvent::Keyboard, QPoint(20, 10), sticky->mapToGlobal(QPoint(20, 10)));
    QApplication::sendEvent(sticky, &ask);
    QCOMPARE(offered, (QStringList{QStringLiteral("Copy value"), QStringLiteral("Explain")}));
    // A click and a key change nothing.
    ParameterRow* tear = rowOf(body, "constraint/net/org.example.net/tear_strain");
    QTest::mouseDClick(tear, Qt::LeftButton, {}, tear->rect().center());
    QTest::keyClick(tear, Qt::Key_Up);
    QCOMPARE(document().undoStack().count(), 0);
    QCOMPARE(writeProject(document().project()), before);
    const nlohmann::json saved = nlohmann::json::parse(before);
    QVERIFY(saved["bodies"].back()["constraints"][0] == net["constraints"][0]);
  }

  /// What the row "Held together by" does not show is not what it replaces.
  void anotherStructureKeepsASecondMissingOne() {
    Project project = sceneOfMissing();
    BodyConstraint other{"org.example.other", {}, {}};
    other.parameters.values["weave"] = 2.0;
    project.bodies.back().constraints.push_back(other);
    openProject(project);
    const std::string before = writeProject(document().project());
    const Address structure{Owner::Body, "net", kStructureKey};
    QCOMPARE(document().value(structure), Value(std::string("org.example.net")));
    QCOMPARE(document().setParameter(structure, std::string("bonds")), QString());
    const std::vector<BodyConstraint>& now = document().body("net")->constraints;
    QCOMPARE(now.size(), size_t{2});
    QCOMPARE(now[0].plugin, std::string("bonds"));
    QCOMPARE(now[1].plugin, std::string("org.example.other"));
    const nlohmann::json saved = nlohmann::json::parse(writeProject(document().project()));
    QCOMPARE(saved["bodies"].back()["constraints"][1]["parameters"]["weave"].get<double>(), 2.0);
    QCOMPARE(document().value(structure), Value(std::string("bonds")));
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  void theLinkOfAMessageLeadsToThePlugin() {
    openProject(sceneOfMissing());
    m_window->action(QStringLiteral("help.messages"))->trigger();
    auto* page = m_window->findChild<MessagesPage*>();
    QLabel* found = nullptr;
    for (QLabel* label : page->findChildren<QLabel*>()) {
      if (label->text().contains(QStringLiteral("plugin:org.example.bingham"))) found = label;
    }
    QVERIFY(found);
    Q_EMIT found->linkActivated(QStringLiteral("plugin:org.example.bingham"));
    QTRY_VERIFY(m_window->showsPlugins());
    const QStringList lines = m_window->pluginPage()->lines();
    QVERIFY(lines.front().startsWith(QStringLiteral("org.example.bingham\tMaterial\t")));
    QVERIFY(lines.front().contains(QStringLiteral("Missing")));
    QTest::keyClick(m_window.get(), Qt::Key_Escape);
  }

  /// One step; undo brings back what the file said, to the byte.
  void anotherMaterialIsOneStep() {
    openProject(sceneOfMissing());
    const std::string before = writeProject(document().project());
    QMenu* menu = m_window->waysOut().materialsFor("paste");
    QVERIFY(menu);
    const QList<QAction*> choices = menu->actions();
    const auto honey = std::find_if(choices.begin(), choices.end(),
                                    [](const QAction* a) { return a->text() == QStringLiteral("Honey"); });
    QVERIFY(honey != choices.end());
    const int64_t steps = document().undoStack().count();
    (*honey)->trigger();
    delete menu;
    QCOMPARE(document().undoStack().count(), steps + 1);
    const SceneMaterial& other = document().project().materials.back();
    QCOMPARE(other.id, std::string("paste"));
    QCOMPARE(other.base, std::string("honey"));
    QVERIFY(other.properties.values.empty() && other.parameters.values.empty());
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("What was of “org.example.bingham” is of “Honey” now")));
    ParameterRow* row = m_window->inspector().bodyPanel()->row(QStringLiteral("body/block/material"));
    QVERIFY(!row || !labelOf(*row).contains(QStringLiteral("plugin:")));
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("The material “Bingham paste” needs")));  // again
    document().undoStack().redo();
    QVERIFY(!m_window->notice()->text().contains(QStringLiteral("Bingham paste")));
    document().undoStack().undo();
  }

  /// Paused at its start the scene is made anew by itself, and the block falls.
  void anotherMaterialIsMadeAtTheStart() {
    openProject(sceneOfMissing());
    session().pause();
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().appliesAtOnce(), kLong);
    QCOMPARE(motionOf("block"), api::Motion::Static);
    m_window->waysOut().useOther("paste", "honey");
    QTRY_VERIFY_WITH_TIMEOUT(motionOf("block") != api::Motion::Static, kLong);
  }

  void aMissingPluginIsInstalledFromAFolder() {
    const QTemporaryDir home, folder;
    const QByteArray data = qgetenv("XDG_DATA_HOME");
    qputenv("XDG_DATA_HOME", home.path().toUtf8());
    QFile source(QStringLiteral(PS_SOURCE_DIR "/plugins/materials/honey.json"));
    QVERIFY(source.open(QIODevice::ReadOnly));
    QByteArray text = source.readAll();
    text.replace("\"id\": \"honey\"", "\"id\": \"org.example.bingham\"");
    QFile plugin(folder.filePath(QStringLiteral("bingham.json")));
    QVERIFY(plugin.open(QIODevice::WriteOnly) && plugin.write(text) == text.size());
    plugin.close();
    openProject(sceneOfMissing());
    m_window->waysOut().installFrom(folder.path(), "org.example.other");
    QTRY_VERIFY(
        m_window->notice()->text().contains(QStringLiteral("has no plugin “org.example.other”, only "
                                                           "org.example.bingham")));
    m_window->waysOut().installFrom(folder.path(), kGone);
    QTRY_VERIFY(m_window->notice()->text().contains(QStringLiteral("is installed")));
    const PluginRegistry later;
    qputenv("XDG_DATA_HOME", data);
    if (data.isEmpty()) qunsetenv("XDG_DATA_HOME");
    QVERIFY(later.material(kGone));
    QVERIFY(missingPlugins(document().project(), later).size() == 1);
  }

  /// By kind and name first, then by its place in the file.
  void whatIsWrongInAFileNamesTheThing() {
    const QString path = QStringLiteral("/data/pond.json");
    const auto said = [&](const char* pointer) {
      return FileProblems(path, kBroken).said(path.toStdString() + ":" + pointer + ": must be more");
    };
    QCOMPARE(said("/materials/1/properties/density_solid"),
             QStringLiteral("The material “Wood”, Density, solid: must be more (pond.json, line 6: "
                            "/materials/1/properties/density_solid)"));
    QCOMPARE(said("/environment/walls/0/temperature"),
             QStringLiteral("The wall “Hot plate”, Temperature: must be more (pond.json, line 9: "
                            "/environment/walls/0/temperature)"));
    QCOMPARE(said("/bodies/3"), QStringLiteral("The body number 4: must be more (pond.json, line 8: /bodies/3)"));
    QCOMPARE(said("/solver/substeps"),
             QStringLiteral("The solver, Substeps: must be more (pond.json, line 10: /solver/substeps)"));
    QCOMPARE(FileProblems(path, "").said("nowhere.json: no such file"), QStringLiteral("nowhere.json: no such file"));
    QCOMPARE(FileProblems(path, "{,").said("/data/pond.json:/: line 3, column 5: a comma is missing"),
             QStringLiteral("pond.json: line 3, column 5: a comma is missing"));
  }

  /// Names whose it is, and leads there from wherever one is.
  void theStatusLinesNoteLeadsToWhatItNames() {
    openProject(woodBesideWater());
    StatusLine* line = m_window->statusLine();
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(
        line->parts().join(QLatin1Char(' ')).contains(QStringLiteral("note on Wood: Young's modulus")), 4 * kLong);
    session().pause();
    for (const auto tab : {MainWindow::kSceneTab, MainWindow::kTuneTab, MainWindow::kSketchTab}) {
      m_window->showWorkspace(tab);
      m_window->selection().setMaterial("water");
      // Other workspaces lay the line out anew, as soon as it is painted there.
      QTRY_VERIFY(line->noteRect().isValid() && line->parts().join(QLatin1Char(' ')).contains(QStringLiteral("Wood")));
      line->repaint();
      QTest::mouseClick(line, Qt::LeftButton, {}, line->noteRect().center().toPoint());
      QCOMPARE(m_window->selection().material(), std::string("wood"));
      ParameterPanel* panel = m_window->inspector().materialPanel();
      ParameterRow* row = panel->row(QStringLiteral("material/wood/youngs_modulus"));
      QVERIFY(row && row->isVisible());
      QTest::qWait(50);
      for (const ParameterRow* other : panel->rows()) {  // the note under the row has its place
        if (other != row && other->isVisible()) QVERIFY(!other->geometry().intersects(row->geometry()));
      }
      QVERIFY(row->height() > 40);
    }
  }

  /// What the document has lost since the snapshot leads to the messages, not to another one's row.
  void aNoteOnWhatIsGoneChangesNothing() {
    openProject(woodBesideWater());
    m_window->selection().setMaterial("wood");
    QVERIFY(!m_window->revealParameter({Owner::Material, "gone", "youngs_modulus"}));
    QCOMPARE(m_window->selection().material(), std::string("wood"));
  }

  /// The solver's steps are made finer by one step of undo, and once.
  void squeezedLiquidOffersFinerSteps() {
    openProject(scenes::iceOnPlate(4, 280));
    session().pause();
    idsNow(session());  // no frame comes any more, nor what it would say
    const Address substeps{Owner::Solver, "", "substeps"}, iterations{Owner::Solver, "", "iterations"};
    const auto number = [&](const Address& address) { return std::get<double>(document().value(address)); };
    QCOMPARE(document().setParameter(iterations, 2.0), QString());
    const int before = document().undoStack().count();
    EngineEvent squeezed;
    squeezed.flags = static_cast<StepFlags>(StepFlag::Diverged);
    squeezed.message = "'Ice': density error 155 % where it is worst, 69 % in the mean of all liquid";
    Q_EMIT session().happened(squeezed);
    const auto says = [&](const char* text) { return m_window->notice()->text().contains(QString::fromUtf8(text)); };
    QVERIFY2(says("'Ice': density error 155 %") && says("Raise the substeps"), qPrintable(m_window->notice()->text()));
    QPushButton* use = noticeButton(*m_window, QStringLiteral("Use 16 substeps and 4 iterations"));
    QVERIFY(use);
    use->click();
    QCOMPARE(document().undoStack().count(), before + 1);
    QCOMPARE(number(substeps), 16.0);
    QCOMPARE(number(iterations), 4.0);
    QVERIFY2(says("Steps are finer"), qPrintable(m_window->notice()->text()));
    QVERIFY(noticeButton(*m_window, QStringLiteral("Back to the start")));
    document().undoStack().undo();
    QCOMPARE(number(substeps), 4.0);
    QCOMPARE(number(iterations), 2.0);
    document().undoStack().undo();
  }

  /// The substeps of a new scene are for coarse particles.
  void aFineSpacingOffersMoreSubsteps() {
    openProject(scenes::iceOnPlate(2, 280));
    session().pause();
    ParameterPanel* panel = m_window->inspector().solverPanel();
    const auto note = [&] { return labelOf(*panel->row(QStringLiteral("solver/particle_spacing"))); };
    QVERIFY2(!note().contains(QStringLiteral("substeps")), qPrintable(note()));
    QCOMPARE(document().setParameter({Owner::Solver, "", "particle_spacing"}, 0.005), QString());
    QVERIFY2(note().contains(QStringLiteral("solver/substeps=8")), qPrintable(note()));
    Q_EMIT panel->linkActivated(QString(), QStringLiteral("solver/substeps=8"));
    QCOMPARE(std::get<double>(document().value({Owner::Solver, "", "substeps"})), 8.0);
    QVERIFY2(!note().contains(QStringLiteral("substeps")), qPrintable(note()));
    for (int step = 0; step < 2; ++step) document().undoStack().undo();
    QVERIFY(!document().isDirty());
  }

  /// A scene without a title of its own is called as its file is.
  void aSavedSceneIsCalledAsItsFile() {
    const QTemporaryDir folder;
    m_window->action(QStringLiteral("file.new"))->trigger();
    QCOMPARE(m_window->windowTitle(), QStringLiteral("New scene[*] – PhaseSketch"));
    const QString path = folder.filePath(QStringLiteral("pond.json"));
    m_window->saveTo(path);
    QTRY_COMPARE(m_window->windowTitle(), QStringLiteral("pond.json[*] – PhaseSketch"));
    QCOMPARE(document().title(), QStringLiteral("pond"));
    QCOMPARE(document().project().title, std::string());
    QFile written(path);
    QVERIFY(written.open(QIODevice::ReadOnly) && !written.readAll().contains("\"title\""));
  }

 private:
  /// All that notes of a widget say, with their links.
  static QString labelOf(const QWidget& widget) {
    QString text;
    const QRegularExpression notes(QStringLiteral("^ps(Limit|HeaderNote)$"));
    for (const QLabel* label : widget.findChildren<QLabel*>(notes)) {
      if (qobject_cast<const ParameterRow*>(label->parentWidget()) && !qobject_cast<const ParameterRow*>(&widget))
        continue;
      text += label->text();
    }
    return text;
  }

  void openProject(const Project& project) {
    const QString path = m_folder.filePath(QStringLiteral("scene.json"));
    saveProject(project, path.toStdString());
    QSignalSpy opened(&session().files(), &DocumentFiles::opened), shown(m_window.get(), &MainWindow::projectShown);
    m_window->openFile(path);
    QVERIFY(opened.wait(kLong));
  }

  struct Mean {
    Vector3 place{0, 0, 0};  ///< m
    double kelvin = 0;
  };
  /// Of a body's particles, as the engine has published them last.
  Mean meanOf(const std::string& body) {
    const SnapshotPtr now = session().newest();
    Mean mean;
    double count = 0;
    for (size_t i = 0; i < now->id.size(); ++i) {
      if ((*now->bodyIds)[now->body[i]] != body) continue;
      const api::Float4& at = now->position[i];
      mean.place += Vector3(at.x, at.y, at.z);
      mean.kelvin += static_cast<double>(now->temperature[i]);
      ++count;
    }
    return {mean.place / count, mean.kelvin / count};
  }
  api::Motion motionOf(const std::string& body) {
    return onEngine<api::Motion>(session(), [body](Engine& engine) {
      const ParticleStore& store = engine.solver().particles();
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] == body) return store.motion()[i];
      }
      return api::Motion::Static;
    });
  }

  QTemporaryDir m_folder;
};

int main(int argc, char** argv) {
  servePluginScans(argc, argv);
  requestViewFormat();
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  TestWaysOut test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_waysout.moc"
