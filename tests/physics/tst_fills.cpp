// SPDX-License-Identifier: Apache-2.0
// Solids as they are filled: their mass, and that nothing moves at the start which has no reason to.
#include "onehash.h"

#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"
#include "core/solver/truesurface.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

using nlohmann::json;

namespace {

constexpr double kSpacing = 0.01, kGravity = 9.81;
/// Of water at 20 °C and of ice at -10 °C as the installed material has them, within the rounding of its tables.
constexpr double kWater = 998.2, kIce = 918;

json solidOf(const char* kind, const char* fill) {
  return {{"kind", kind}, {"fill", fill}, {"size_x", 0.1}, {"size_y", 0.1}, {"size_z", 0.1}, {"position_y", 0.05}};
}

json bodyOf(const char* id, const json& solid, double temperature) {
  return {{"id", id}, {"material", "water"}, {"temperature", temperature}, {"shape", {{"solid", solid}}}};
}

/// Open, with a floor at its bottom.
json sceneOf(const json& bodies, double gravity) {
  json scene = json::parse(R"({
    "format": "phasesketch", "version": 1, "materials": [{"id": "water", "base": "water"}],
    "environment": {"bounds": {"minimum": [-1, -1, -1], "maximum": [1, 1, 1]},
                    "walls": [{"id": "floor", "point": [0, 0, 0], "normal": [0, 1, 0]}]},
    "solver": {"thermal": {"model": "enthalpy"}}, "duration": 10
  })");
  scene["bodies"] = bodies;
  scene["solver"]["particle_spacing"] = kSpacing;
  scene["environment"]["gravity"] = {0, -gravity, 0};
  return scene;
}

}  // namespace

class TestFills : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet({});
  }

  void massIsDensityTimesVolume_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("fill");
    QTest::addColumn<double>("temperature");  // K
    for (const char* fill : {"lattice", "relaxed"}) {
      for (const char* kind : {"ellipsoid", "cylinder", "cone", "capsule", "torus", "tube", "bowl", "block"})
        QTest::addRow("%s, %s", kind, fill) << QString(kind) << QString(fill) << 293.15;
      QTest::addRow("ice, %s", fill) << QString("ellipsoid") << QString(fill) << 263.15;
    }
  }
  void massIsDensityTimesVolume() {
    QFETCH(QString, kind);
    QFETCH(QString, fill);
    QFETCH(double, temperature);
    json solid = solidOf(kind.toLatin1(), fill.toLatin1());
    if (kind == "torus") solid["size_y"] = 0.03;
    const ps::Project project = load(sceneOf(json::array({bodyOf("solid", solid, temperature)}), 0));
    const ps::Engine engine(project, m_plugins);
    const double volume = ps::SolidForm(std::get<ps::SolidShape>(project.bodies[0].shape)).volume();
    const double share = massOf(engine) / ((temperature < 273 ? kIce : kWater) * volume);
    // 0.5 %: as near as anybody can weigh it.
    QVERIFY2(std::abs(share - 1) < 5e-3, qPrintable(QString::number(share, 'g', 8)));
  }

  /// Kinetic energy in the first second stays below 1e-4 of m g d, with d a spacing.
  /// Without weight but for ice on a floor, since what has to take up its own sags.
  void nothingMovesWithoutReason_data() {
    QTest::addColumn<QString>("fill");
    QTest::addColumn<QString>("what");
    for (const char* fill : {"lattice", "relaxed"}) {
      for (const char* what : {"drop", "ice", "ice on the floor"})
        QTest::newRow((std::string(what) + ", " + fill).c_str()) << QString(fill) << QString(what);
    }
  }
  void nothingMovesWithoutReason() {
    QFETCH(QString, fill);
    QFETCH(QString, what);
    const QByteArray name = fill.toLatin1();
    json solid = solidOf(what == "ice on the floor" ? "cylinder" : "ellipsoid", name);
    if (what != "ice on the floor") solid["position_y"] = 0.5;
    json body = bodyOf("solid", solid, what == "drop" ? 293.15 : 263.15);
    if (what != "drop") body["constraints"] = json::array({{{"plugin", what == "ice" ? "bonds" : "rigid"}}});
    QVERIFY(isStill(sceneOf(json::array({body}), what == "ice on the floor" ? kGravity : 0)));
  }

  /// Steps of two lattices interlock, and press the liquid out of a round mould; packed against the same surface they
  /// stand apart. What is left is that single particles of the two come as near as the distance that is kept between.
  void packedLiquidFitsItsMould() {
    const double lattice = mostKinetic(sceneOf(waterInTube("lattice"), 0)),
                 relaxed = mostKinetic(sceneOf(waterInTube("relaxed"), 0));
    QVERIFY2(relaxed < 0.05 * lattice, qPrintable(QString("%1, on lattices %2").arg(relaxed).arg(lattice)));
  }

  /// A packed tube whose wall is one spacing thick holds the water in it, which fills its width, all of it.
  void aWallOfOneSpacingHolds() {
    json scene = sceneOf(waterInTube("relaxed"), kGravity);
    json& tube = scene["bodies"][0]["shape"]["solid"];
    tube["wall"] = kSpacing;
    tube["size_y"] = 0.16, tube["position_y"] = 0.08;
    tube["size_x"] = tube["size_z"] = 0.12;
    const ps::Project project = load(scene);
    ps::Engine engine(project, m_plugins);
    const double water = ps::SolidForm(std::get<ps::SolidShape>(project.bodies[1].shape)).volume() * kWater;
    QVERIFY2(std::abs(massOf(engine) / water - 1) < 5e-3, qPrintable(QString::number(massOf(engine) / water)));
    for (int frame = 0; frame < 90; ++frame) engine.step();
    const ps::ParticleStore& store = engine.solver().particles();
    for (size_t i = 0; i < store.size(); ++i) {
      const ps::api::Float4& at = store.position()[i];
      if (store.velocity()[i].w > 0) QVERIFY2(std::hypot(at.x, at.z) < 0.05, qPrintable(QString::number(at.y)));
    }
  }

  /// A ball without friction in a round gutter is a pendulum: let go at 60 degrees, it comes as high on the other side.
  /// Over the steps of a lattice it does not. Both balls are packed: what differs is the gutter. A substep loses the
  /// square of the angle by which the way turns in it: 5 % in all with 32 of them, 8 % with 16, 20 % with 4.
  void aPackedGutterIsSmooth() {
    const double packed = regainedInGutter("automatic"), stepped = regainedInGutter("lattice");
    QVERIFY2(packed > 0.9 && packed < 1.02, qPrintable(QString::number(packed)));
    QVERIFY2(stepped < 0.5 * packed, qPrintable(QString::number(stepped)));
  }

  void aPackedGutterIsTheSameEverywhere_data() { onehash::addRows(); }
  void aPackedGutterIsTheSameEverywhere() {
    onehash::verify([this] {
      ps::Engine engine(load(gutterScene("relaxed")), m_plugins);
      for (int frame = 0; frame < 12; ++frame) engine.step();
      return engine.solver().stateHash();
    });
  }

  /// Once the gutter moves, its particles are all that is known of it.
  void whatMovesHasNoKnownSurface() {
    const auto known = [this](const json& velocity) {
      json scene = gutterScene("relaxed");
      scene["bodies"][0]["velocity"] = velocity;
      return knownOf(scene);
    };
    QVERIFY(known({0, 0, 0}) > 1000);
    QCOMPARE(known({1, 0, 0}), ptrdiff_t{0});
  }

  /// A box slides down a plank that is turned by 30 degrees, over 32 rows of its particles. These lie 5 % of a spacing
  /// too deep for its faces, since three layers of them are stretched to fill it: the box stays at the height of the
  /// face, to 2 %, and no row lifts it. Its way is a t^2/2 with a = g (sin - friction cos): to 1 % without friction, of
  /// which a third is what 320 substeps add to it; 10 % with it, which contacts share anew from row to row, as case m3
  /// allows on particles.
  void aTurnedPlankIsAPlane_data() {
    QTest::addColumn<double>("friction");
    QTest::addColumn<double>("tolerance");
    QTest::newRow("slick") << 0.0 << 0.01;
    QTest::newRow("rough") << 0.2 << 0.1;
  }
  void aTurnedPlankIsAPlane() {
    QFETCH(double, friction);
    QFETCH(double, tolerance);
    const double sine = 0.5, cosine = std::sqrt(0.75);
    const ps::Vector3 up(-sine, cosine, 0), down(-cosine, -sine, 0);
    ps::Engine engine(load(plankScene(friction)), m_plugins);
    const ps::Vector3 start = centreOf(engine);
    constexpr int kFrames = 20;
    for (int frame = 0; frame < kFrames; ++frame) {
      engine.step();
      const double lift = (centreOf(engine) - start).dot(up) / kSpacing;
      QVERIFY2(std::abs(lift) < 0.02, qPrintable(QString("%1 spacings in frame %2").arg(lift).arg(frame)));
    }
    const double time = kFrames / 60.0, wanted = kGravity * (sine - friction * cosine) * time * time / 2;
    const double way = (centreOf(engine) - start).dot(down);
    QVERIFY2(std::abs(way / wanted - 1) < tolerance, qPrintable(QString("%1 m of %2").arg(way).arg(wanted)));
  }

  /// Of a turned block the particles in one face alone: 58 rows of 8 on two faces, of 58 and of 8 in the middle layer
  /// of three on the others.
  void aTurnedBlockKnowsItsFaces() {
    json scene = plankScene(0);
    QCOMPARE(knownOf(scene), ptrdiff_t{2 * (58 * 8 + 58 + 8)});
    scene["bodies"][0]["velocity"] = {1, 0, 0};
    QCOMPARE(knownOf(scene), ptrdiff_t{0});
    scene["bodies"][0].erase("velocity");
    scene["bodies"][0]["shape"]["solid"]["size_y"] = kSpacing;  // one layer has no face of its own
    QCOMPARE(knownOf(scene), ptrdiff_t{0});
    scene = plankScene(0);
    scene["bodies"][0]["shape"]["solid"].erase("rotation_z");
    QCOMPARE(knownOf(scene), ptrdiff_t{0});
  }

  /// A rope held at both ends and a sheet held at one edge, both turned, hang on what holds them, in one piece.
  void sheetsAndRopesHang_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("plugin");
    QTest::newRow("sheet") << QString("sheet") << QString("cloth");
    QTest::newRow("rope") << QString("rope") << QString("rope");
  }
  void sheetsAndRopesHang() {
    QFETCH(QString, kind);
    QFETCH(QString, plugin);
    json solid = {{"kind", kind.toStdString()},
                  {"position_y", 0.5},
                  {"rotation_y", 30},
                  {"size_x", 0.1},
                  {"size_z", 0.2},
                  {"held", kind == "rope" ? "ends" : "start"}};
    if (kind == "rope") solid.update({{"point_1_y", 0.02}, {"point_2_y", -0.02}});
    json body = bodyOf("thin", solid, 263.15);
    body["constraints"] = json::array({{{"plugin", plugin.toStdString()}}});
    ps::Engine engine(load(sceneOf(json::array({body}), kGravity)), m_plugins);
    const ps::ParticleStore& store = engine.solver().particles();
    const auto lowest = [&] {
      double low = 1;
      for (size_t i = 0; i < store.size(); ++i) low = std::min(low, double{store.position()[i].y});
      return low;
    };
    const double before = lowest();
    for (int frame = 0; frame < 120; ++frame) engine.step();
    // The rope is taut: it sags by what it stretches; the sheet's free edge goes down by nearly its length.
    const double fell = before - lowest();
    QVERIFY2(kind == "rope" ? fell > 1e-4 && fell < 0.05 : fell > 0.1 && fell < 0.22,
             qPrintable(QString::number(fell)));
    for (const uint32_t piece : engine.solver().pieces()) QCOMPARE(piece, engine.solver().pieces().front());
  }

 private:
  ps::Project load(const json& scene) { return ps::parseProject(scene.dump(), "scene", m_plugins).project; }
  static json gutterScene(const char* fill) {
    constexpr double kLength = 0.09;  // m, of the pendulum
    json gutter = {{"kind", "tube"}, {"fill", fill}, {"size_x", 0.3},     {"size_y", 0.15},
                   {"size_z", 0.3},  {"wall", 0.03}, {"position_y", 0.5}, {"rotation_x", 90}};
    json ball = {{"kind", "ellipsoid"},
                 {"fill", "relaxed"},
                 {"size_x", 0.06},
                 {"size_y", 0.06},
                 {"size_z", 0.06},
                 {"position_x", kLength * std::sqrt(0.75)},
                 {"position_y", 0.5 - 0.5 * kLength}};
    json bodies = json::array({bodyOf("gutter", gutter, 293.15), bodyOf("ball", ball, 293.15)});
    bodies[0]["fixed"] = true;
    bodies[1]["constraints"] = json::array({{{"plugin", "rigid"}}});
    for (json& body : bodies) body["material"] = "slick";
    json scene = sceneOf(bodies, kGravity);
    scene["materials"].push_back(
        {{"id", "slick"}, {"base", "steel"}, {"properties", {{"friction_static", 0}, {"friction_kinetic", 0}}}});
    return scene;
  }
  /// A box on a plank, both turned by 30 degrees, face on face.
  static json plankScene(double friction) {
    constexpr double kThick = 0.033, kBox = 0.06, kUphill = 0.2, kMiddle = 0.5;  // m
    json plank = {{"kind", "block"}, {"size_x", 0.6},         {"size_y", kThick},
                  {"size_z", 0.1},   {"position_y", kMiddle}, {"rotation_z", 30}};
    const double above = (kThick + kBox) / 2, sine = 0.5, cosine = std::sqrt(0.75);
    json box = {{"kind", "block"},
                {"size_x", kBox},
                {"size_y", kBox},
                {"size_z", kBox},
                {"position_x", kUphill * cosine - above * sine},
                {"position_y", kMiddle + kUphill * sine + above * cosine},
                {"rotation_z", 30}};
    json bodies = json::array({bodyOf("plank", plank, 293.15), bodyOf("box", box, 293.15)});
    bodies[0]["fixed"] = true;
    bodies[1]["constraints"] = json::array({{{"plugin", "rigid"}}});
    for (json& body : bodies) body["material"] = "plain";
    json scene = sceneOf(bodies, kGravity);
    scene["materials"].push_back({{"id", "plain"},
                                  {"base", "steel"},
                                  {"properties", {{"friction_static", friction}, {"friction_kinetic", friction}}}});
    scene["solver"]["substeps"] = 16;
    return scene;
  }
  /// Particles that know where the surface of their shape is.
  ptrdiff_t knownOf(const json& scene) {
    const ps::Engine engine(load(scene), m_plugins);
    const ps::ParticleStore& store = engine.solver().particles();
    const auto* noted =
        static_cast<const ps::api::Float4*>(store.read(ps::field::kTrueSurface, ps::api::FieldType::Float4));
    return noted ? std::count_if(noted, noted + store.size(), [](const auto& at) { return at.w > 0; }) : 0;
  }
  /// m, of what moves, whose particles are equally heavy.
  static ps::Vector3 centreOf(const ps::Engine& engine) {
    const ps::ParticleStore& store = engine.solver().particles();
    ps::Vector3 sum;
    double count = 0;
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w > 0) sum += ps::vectorOf(store.position()[i]), ++count;
    }
    return sum / count;
  }
  /// Height that the ball regains on the other side, as a share of that from which it came.
  double regainedInGutter(const char* fill) {
    json scene = gutterScene(fill);
    scene["solver"]["substeps"] = 16;
    ps::Engine engine(load(scene), m_plugins);
    const double start = centreOf(engine)[1];
    double low = start, high = -1;
    for (int frame = 0; frame < 30; ++frame) {  // a period takes 0.65 s
      engine.step();
      const ps::Vector3 at = centreOf(engine);
      low = std::min(low, at[1]);
      if (at[0] < 0) high = std::max(high, at[1]);
    }
    return std::max(0.0, high - low) / (start - low);
  }
  static json waterInTube(const char* fill) {
    json tube = solidOf("tube", fill);
    tube["wall"] = 0.02;
    tube["size_x"] = tube["size_z"] = 0.14;
    json bodies = json::array({bodyOf("tube", tube, 293.15), bodyOf("water", solidOf("cylinder", fill), 293.15)});
    bodies[0]["fixed"] = true;
    return bodies;
  }
  /// Of the first second, of m g d.
  double mostKinetic(const json& scene) {
    ps::Engine engine(load(scene), m_plugins);
    const double mass = massOf(engine);
    double most = 0;
    for (int frame = 0; frame < 60; ++frame) {
      engine.step();
      most = std::max(most, kineticOf(engine));
    }
    return most / (mass * kGravity * kSpacing);
  }
  bool isStill(const json& scene) {
    const double share = mostKinetic(scene);
    if (!(share < 1e-4)) qWarning("%g of m g d", share);
    return share < 1e-4;
  }
  /// kg and J, of what moves.
  static double massOf(const ps::Engine& engine) {
    const ps::ParticleStore& store = engine.solver().particles();
    double sum = 0;
    for (size_t i = 0; i < store.size(); ++i) sum += store.velocity()[i].w > 0 ? double{store.mass()[i]} : 0;
    return sum;
  }
  static double kineticOf(const ps::Engine& engine) {
    const ps::ParticleStore& store = engine.solver().particles();
    double sum = 0;
    for (size_t i = 0; i < store.size(); ++i) {
      if (store.velocity()[i].w > 0)
        sum += 0.5 * double{store.mass()[i]} * ps::vectorOf(store.velocity()[i]).squaredNorm();
    }
    return sum;
  }

  ps::PluginRegistry m_plugins;
};

QTEST_GUILESS_MAIN(TestFills)
#include "tst_fills.moc"
