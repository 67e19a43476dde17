// SPDX-License-Identifier: Apache-2.0
// What strokes become: chosen in the brush before, or as the material is; by tools without a widget.
#include "core/io/projectio.h"
#include "core/simulation/declared.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/document/declared.h"
#include "ui/tools/favouritebrush.h"
#include "ui/tools/heldplaces.h"

#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <algorithm>
#include <limits>
#include <set>

using namespace ps;

class TestBecoming : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    Project project = scenes::iceOnPlate(2, 300, 100);
    project.environment = scenes::tray(0.9, 1.2);
    project.bodies.clear();
    project.probes.clear();
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
    for (const char* material : {"wood", "rubber", "cotton", "hemp"}) m_document->addMaterial(material);
  }
  void cleanup() { close(); }

  void matterIsDrawnAsItIs_data() {
    QTest::addColumn<QString>("material");
    QTest::addColumn<double>("temperature");  // K
    QTest::addColumn<QString>("becoming");
    QTest::newRow("wood stands") << "wood" << 293.15 << "rigid";
    QTest::newRow("wood that soon chars is there to fall apart") << "wood" << 550.0 << "bonded";
    QTest::newRow("charred") << "wood" << 650.0 << "loose";
    QTest::newRow("rubber bends") << "rubber" << 293.15 << "bonded";
    QTest::newRow("hemp is for ropes") << "hemp" << 293.15 << "bonded";
    QTest::newRow("ice melts and breaks") << "water" << 263.15 << "bonded";
    QTest::newRow("water flows") << "water" << 293.15 << "loose";
  }
  void matterIsDrawnAsItIs() {
    QFETCH(QString, material);
    QFETCH(double, temperature);
    QFETCH(QString, becoming);
    const std::string found = ownBecoming(m_document->project(), *m_plugins, material.toStdString(), temperature);
    QCOMPARE(QString::fromStdString(found), becoming);
  }

  /// A hollow strand of wood, upright, in two strokes: a second of the scene later it is as high as it was.
  void aWoodenCupStands() {
    draw(kBecomesOfItself, "wood");
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    draw(kBecomesOfItself, "wood");
    QCOMPARE(m_document->project().bodies.size(), size_t{1});  // it went on with it
    const double before = height();
    QVERIFY2(before > 0.2, qPrintable(QString::number(before)));
    m_engine->play();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.time > 1; }, 120000));
    m_engine->pause();
    const double after = height();
    QVERIFY2(std::abs(after / before - 1) < 0.02,  // by its lean, where the hand's places are not the lattice's
             qPrintable(QStringLiteral("%1 m, was %2 m").arg(after).arg(before)));
  }

  void whatIsChosenIsWhatItBecomes_data() {
    QTest::addColumn<QString>("becomes");
    QTest::addColumn<QString>("structure");
    QTest::addColumn<QString>("phase");
    QTest::addColumn<bool>("fixed");
    QTest::newRow("rigid") << "rigid"
                           << "rigid"
                           << "automatic" << false;
    QTest::newRow("bonded") << "bonded"
                            << "bonds"
                            << "automatic" << false;
    QTest::newRow("soft") << "soft"
                          << "clusters"
                          << "automatic" << false;
    QTest::newRow("cloth") << "cloth"
                           << "cloth"
                           << "automatic" << false;
    QTest::newRow("rope") << "rope"
                          << "rope"
                          << "automatic" << false;
    QTest::newRow("loose") << "loose"
                           << "none"
                           << "automatic" << false;
    QTest::newRow("liquid") << "liquid"
                            << "none"
                            << "liquid" << false;
    QTest::newRow("gas") << "gas"
                         << "none"
                         << "gas" << false;
    QTest::newRow("fixed") << "fixed"
                           << "none"
                           << "automatic" << true;
  }
  /// In the document and in its file; a second stroke there goes on with it, one of another kind does not; undo takes
  /// each away in one step.
  void whatIsChosenIsWhatItBecomes() {
    QFETCH(QString, becomes);
    QFETCH(QString, structure);
    QFETCH(QString, phase);
    QFETCH(bool, fixed);
    const std::string wanted = becomes.toStdString();
    const char* material = wanted == "gas" ? "water" : "rubber";  // rubber never boils
    draw(wanted, material);
    const auto bodies = [this]() -> const std::vector<Body>& { return m_document->project().bodies; };
    QCOMPARE(bodies().size(), size_t{1});
    const std::string text = writeProject(m_document->project());
    const Project read = parseProject(text, "what was written", *m_plugins).project;
    for (const Body& body : {bodies().front(), read.bodies.front()}) {
      QCOMPARE(QString::fromStdString(structureOf(body, m_plugins.get())), structure);
      QCOMPARE(QString::fromStdString(choiceOf(body.parameters, bodyParameters(), "phase")), phase);
      QCOMPARE(toggleOf(body.parameters, bodyParameters(), "fixed"), fixed);
    }
    draw(wanted, material);
    QCOMPARE(bodies().size(), size_t{1});
    draw(wanted == "soft" ? "rigid" : "soft", material, 0.02);
    QCOMPARE(bodies().size(), size_t{2});
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QCOMPARE(writeProject(m_document->project()), text);
    m_document->undoStack().undo();
    QVERIFY(bodies().empty());
  }

  /// Where no plugin can, nothing is drawn, and the sentence says what to do.
  void whatNobodyMakesIsRefused() {
    PluginRegistry less;
    less.fault("cloth", "it failed");
    const Project& project = m_document->project();
    const auto why = [&](const PluginRegistry& plugins, const char* material, const char* becoming) {
      return whyNotBecome(project, plugins, material, becoming);
    };
    QVERIFY(why(less, "wood", "cloth").contains(QStringLiteral("Choose another row under “Becomes”")));
    QCOMPARE(why(less, "wood", "liquid"), QString());
    QCOMPARE(why(*m_plugins, "wood", "cloth"), QString());
    QVERIFY(why(*m_plugins, "wood", "gas").contains(QStringLiteral("never boils")));
    QCOMPARE(why(*m_plugins, "water", "gas"), QString());
  }

  /// Matter that has melted, or has no melting point, flows whatever is to hold it together: it is said, until
  /// something else is drawn.
  void whatFlowsIsSaid() {
    m_document->addMaterial("glass");
    const auto drawAt = [this](const char* material, double temperature, double x) {
      take("sphere", 0.05);
      BrushSettings brush = m_tools->brush();
      brush.becomes = "rigid", brush.material = material, brush.temperature = temperature;
      brush.drawOn = DrawOn::AcrossZ;
      m_tools->setBrush(brush);
      m_tools->tool().press(at({x, 0.2, 0}));
      m_tools->tool().release(at({x, 0.2, 0}));
    };
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    drawAt("water", 293.15, -0.3);
    QCOMPARE(refused.count(), 1);
    QVERIFY2(refused[0][1].toString().contains(QStringLiteral("solid below 0 °C")),
             qPrintable(refused[0][1].toString()));
    drawAt("water", 263.15, 0);
    QCOMPARE(refused.count(), 2);
    QCOMPARE(refused[1][1].toString(), QString());
    drawAt("glass", 293.15, 0.3);
    QCOMPARE(refused.count(), 3);
    QVERIFY2(refused[2][1].toString().contains(QStringLiteral("no melting point")),
             qPrintable(refused[2][1].toString()));
    QCOMPARE(m_document->project().bodies.size(), size_t{3});
    // As it is said: after a moment the ice alone is solid.
    m_engine->play();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.time > 0.1; }, 120000));
    m_engine->pause();
    const SnapshotPtr now = m_engine->snapshot();
    std::set<std::string> solid, liquid;
    for (size_t i = 0; i < now->motion.size(); ++i) {
      const std::string& id = (*now->bodyIds)[now->body[i]];
      (now->motion[i] == api::Motion::Solid ? solid : liquid).insert(id);
    }
    const std::vector<Body>& bodies = m_document->project().bodies;
    QVERIFY(liquid.contains(bodies[0].id) && !solid.contains(bodies[0].id));
    QVERIFY(solid.contains(bodies[1].id) && !liquid.contains(bodies[1].id));
    QVERIFY(liquid.contains(bodies[2].id) && !solid.contains(bodies[2].id));
  }

  /// Those of a sheet's edge, where a mark shows them, while it is selected alone; its row says which edge that is.
  void whatIsHeldIsShown() {
    Body sheet;
    sheet.id = "flag", sheet.material = "cotton";
    SolidShape shape;
    shape.parameters.values = {{"kind", std::string("sheet")},
                               {"size_x", 0.3},
                               {"size_z", 0.3},
                               {"position_y", 0.6},
                               {"held", std::string("start")}};
    sheet.shape = shape;
    sheet.constraints.push_back({"cloth", {}, {}});
    m_document->addBody(sheet);
    tests::onEngine<int>(*m_engine, [](Engine&) { return 0; });
    const auto marks = [this] {
      const SnapshotPtr now = tests::onEngine<SnapshotPtr>(*m_engine, [](Engine& engine) { return engine.snapshot(); });
      return heldPlaces(m_document->project(), *m_selection, *now);
    };
    m_selection->clear();
    QVERIFY(marks().empty());
    m_selection->selectBody("flag");
    const std::vector<Vector3> held = marks();
    QVERIFY(held.size() >= 8 && held.size() <= 14);  // one row, or two where the lattice has one at its very end
    for (const Vector3& place : held) QVERIFY2(place.z() < -0.1, qPrintable(QString::number(place.z())));
    const Address row{Owner::Shape, "flag", "held"};
    const auto label = [&] {
      return choiceLabels(m_document->project(), m_plugins.get(), row, *m_document->declaration(row)).at(1);
    };
    QCOMPARE(label(), QStringLiteral("Edge at −z"));
    QCOMPARE(m_document->setParameter({Owner::Shape, "flag", "rotation_x"}, 90.0), QString());
    QCOMPARE(label(), QStringLiteral("Top edge, +y"));
    QCOMPARE(m_document->setParameter({Owner::Body, "flag", "fixed"}, true), QString());
    QVERIFY(marks().empty());  // all of it is held
  }

  void favouritesKeepIt() {
    BrushSettings brush = m_tools->brush();
    brush.shape = "sphere";
    brush.becomes = "soft";
    FavouriteBrush kept = favouriteOf(brush, *m_plugins, m_document->project());
    kept.name = QStringLiteral("cushion");
    const std::vector<FavouriteBrush> read = favouritesOf(textOf({kept}), *m_plugins);
    QCOMPARE(read.size(), size_t{1});
    QCOMPARE(read[0].brush.becomes, std::string("soft"));
  }

 private:
  void draw(const std::string& becomes, const char* material, double wider = 0) {
    take("tube", 0.12 + wider);
    BrushSettings brush = m_tools->brush();
    brush.becomes = becomes;
    brush.material = material;
    brush.drawOn = DrawOn::AcrossZ;
    m_tools->setBrush(brush);
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    m_tools->tool().press(at({0, 0.02, 0}));
    for (int k = 1; k <= 6; ++k) m_tools->tool().drag(at({0, 0.02 + 0.05 * k, 0}));
    m_tools->tool().release(at({0, 0.32, 0}));
    const bool isDrawn = refused.isEmpty() || refused[0][0] == QStringLiteral("What is drawn flows.");
    QVERIFY2(isDrawn, qPrintable(refused.value(0).value(1).toString()));
    tests::onEngine<int>(*m_engine, [](Engine&) { return 0; });  // what was asked has been done
    QCoreApplication::processEvents();
  }
  /// m, of all matter that is there.
  double height() {
    return tests::onEngine<double>(*m_engine, [](Engine& engine) {
      float low = std::numeric_limits<float>::max(), high = -low;
      for (const api::Float4& place : engine.snapshot()->position)
        low = std::min(low, place.y), high = std::max(high, place.y);
      return double{high} - low;
    });
  }
};

QTEST_GUILESS_MAIN(TestBecoming)
#include "tst_becoming.moc"
