// SPDX-License-Identifier: Apache-2.0
// Mixtures of two materials: each rule against numbers worked out by hand, the ends, what must add up, and how the
// record of what one was made of is kept.
#include "core/base/error.h"
#include "core/io/mixing.h"
#include "core/io/projectio.h"
#include "core/matter/mixture.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "tests/unit/clirun.h"

#include <QTest>

#include <cmath>

using namespace ps;

namespace {

constexpr double kRoom = 293.15, kGas = 8.314462618;

Response law(const char* name, const std::vector<double>& coefficients) {
  Response response;
  response.kind = Response::Kind::Law;
  response.law = name;
  response.coefficients = coefficients;
  return response;
}

/// Two made-up liquids with round numbers.
Material thin() {
  Material m{"thin", "Thin", {}, {}};
  m.properties = {{"density_solid", 900.0},
                  {"density_liquid", 800.0},
                  {"expansion_volumetric", 1e-3},
                  {"heat_capacity_solid", 1800.0},
                  {"heat_capacity_liquid", 2400.0},
                  {"heat_capacity_gas", 1500.0},
                  {"conductivity_solid", 0.4},
                  {"conductivity_liquid", 0.2},
                  {"viscosity", 1e-3},
                  {"youngs_modulus", 1e6},
                  {"melting_temperature", 250.0},
                  {"latent_heat_fusion", 1.2e5},
                  {"boiling_temperature", 350.0},
                  {"latent_heat_vaporization", 8e5},
                  {"molar_mass", 0.046},
                  {"color_red", 1.0},
                  {"sinters", 1.0}};
  return m;
}
Material thick() {
  Material m{"thick", "Thick", {}, {}};
  m.properties = {{"density_solid", 1200.0},
                  {"density_liquid", 1000.0},
                  {"expansion_volumetric", 2e-4},
                  {"heat_capacity_solid", 2100.0},
                  {"heat_capacity_liquid", 4200.0},
                  {"heat_capacity_gas", 2000.0},
                  {"conductivity_solid", 2.0},
                  {"conductivity_liquid", 0.6},
                  {"viscosity", 1e-1},
                  {"youngs_modulus", 4e6},
                  {"melting_temperature", 270.0},
                  {"latent_heat_fusion", 3.3e5},
                  {"boiling_temperature", 370.0},
                  {"latent_heat_vaporization", 2.2e6},
                  {"molar_mass", 0.018},
                  {"color_red", 0.0},
                  {"sinters", 0.0}};
  return m;
}
Material with(Material material, const char* key, Response value) {
  material.properties[key] = std::move(value);
  return material;
}
double at(const Material& material, const char* key, double kelvin = kRoom) { return valueOf(material, key, kelvin); }

/// J/kg, from the solid at one temperature to the liquid at another.
double melted(const Material& m, double from, double to) {
  const double point = at(m, "melting_temperature");
  return at(m, "heat_capacity_solid") * (point - from) + at(m, "latent_heat_fusion") +
         at(m, "heat_capacity_liquid") * (to - point);
}
/// J/kg, from the liquid at one temperature to the vapour at another.
double boiled(const Material& m, double from, double to) {
  const double point = at(m, "boiling_temperature");
  return at(m, "heat_capacity_liquid") * (point - from) + at(m, "latent_heat_vaporization") +
         at(m, "heat_capacity_gas") * (to - point);
}

bool within(double value, double expected, double share) {
  if (std::abs(value - expected) <= share * std::abs(expected)) return true;
  qWarning("%.10g, expected %.10g", value, expected);
  return false;
}

}  // namespace

class TestMixing : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyPropertyHasARule() {
    const api::ParameterList catalogue = propertyCatalogue();
    for (size_t k = 0; k < catalogue.count; ++k) QVERIFY2(!mixtureRule(catalogue[k].key).empty(), catalogue[k].key);
    QVERIFY(mixtureRule("taste").empty());
  }

  void rules_data() {
    QTest::addColumn<QString>("key");
    QTest::addColumn<double>("expected");
    // Half and half by mass. Shares of Thick: 0.446 of the liquid's volume (800/1800), 3/7 of the solid's (900/2100),
    // 46/64 of the moles.
    const double liquid = 800.0 / 1800, solid = 900.0 / 2100, moles = 46.0 / 64;
    QTest::newRow("density") << "density_liquid" << 1 / (0.5 / 800 + 0.5 / 1000);
    QTest::newRow("expansion") << "expansion_volumetric" << (1 - liquid) * 1e-3 + liquid * 2e-4;
    QTest::newRow("heat capacity") << "heat_capacity_liquid" << 3300.0;
    QTest::newRow("conductivity") << "conductivity_solid" << 0.4 * std::pow(5.0, solid);
    QTest::newRow("viscosity") << "viscosity" << 1e-3 * std::pow(100.0, moles);
    QTest::newRow("stiffness") << "youngs_modulus"
                               << 0.5 * ((1 - solid) * 1e6 + solid * 4e6 + 1 / ((1 - solid) / 1e6 + solid / 4e6));
    QTest::newRow("molar mass") << "molar_mass" << 1 / (0.5 / 0.046 + 0.5 / 0.018);
    QTest::newRow("colour") << "color_red" << 1.055 * std::pow(1 - solid, 1 / 2.4) - 0.055;
    QTest::newRow("toggle") << "sinters" << 0.0;
  }
  void rules() {
    QFETCH(QString, key);
    QFETCH(double, expected);
    const Material out = mixed(thin(), thick(), 0.5);
    QVERIFY(within(at(out, key.toUtf8().constData()), expected, 1e-12));
    QVERIFY(problemOf(out).empty());
  }

  void theEndsAreTheParts() {
    const Material first = with(thin(), "viscosity", law("arrhenius", {1e-3, 14000, 298.15})), second = thick();
    QVERIFY(mixed(first, second, 0).properties == first.properties);
    QVERIFY(mixed(first, second, 1).properties == second.properties);
    const Material near = mixed(first, second, 1e-7), far = mixed(first, second, 1 - 1e-7);
    for (const auto& [key, value] : first.properties) {
      if (key == "sinters") continue;  // both or none
      QVERIFY2(std::abs(valueOf(near, key, kRoom) - value.at(kRoom)) <= 1e-3 * (1e-2 + std::abs(value.at(kRoom))),
               key.c_str());
      QVERIFY2(std::abs(valueOf(far, key, kRoom) - at(second, key.c_str())) <=
                   1e-3 * (1e-2 + std::abs(at(second, key.c_str()))),
               key.c_str());
    }
  }

  void heatAddsUp_data() {
    QTest::addColumn<double>("share");
    for (const double share : {0.001, 0.2, 0.5, 0.9}) QTest::addRow("%g", share) << share;
  }
  /// To rounding: the latent heats are carried to the mixture's own points.
  void heatAddsUp() {
    QFETCH(double, share);
    const Material one = thin(), other = thick(), out = mixed(one, other, share);
    QVERIFY(
        within(melted(out, 200, 300), (1 - share) * melted(one, 200, 300) + share * melted(other, 200, 300), 1e-12));
    QVERIFY(
        within(boiled(out, 300, 400), (1 - share) * boiled(one, 300, 400) + share * boiled(other, 300, 400), 1e-12));
  }

  /// One kilogram takes the room of its parts, at any temperature at which both are liquid: constants are those of
  /// 20 °C, where all begin to count their expansion.
  void volumesAddUp() {
    const Material one = thin(), other = thick(), out = mixed(one, other, 0.3);
    const BakedMaterial baked[] = {BakedMaterial(one, 101325), BakedMaterial(other, 101325),
                                   BakedMaterial(out, 101325)};
    for (const double t : {280.0, 293.15, 330.0}) {
      const double volume = 0.7 / baked[0].restDensity(t, 0, 1, 0) + 0.3 / baked[1].restDensity(t, 0, 1, 0);
      QVERIFY(within(1 / baked[2].restDensity(t, 0, 1, 0), volume, 1e-6));  // tables are lines between 1.5 K
    }
  }

  /// Silicon and germanium dissolve in each other, solid and liquid. At a temperature between their melting points the
  /// lens gives both compositions outright: x_l = (1 - e^λb)/(e^λa - e^λb), x_s = x_l e^λa.
  void theLensOfIdealSolutions() {
    Material germanium{"ge", "Germanium", {}, {}}, silicon{"si", "Silicon", {}, {}};
    germanium.properties = {
        {"melting_temperature", 1211.4}, {"molar_mass", 0.07263}, {"latent_heat_fusion", 36940 / 0.07263}};
    silicon.properties = {
        {"melting_temperature", 1687.0}, {"molar_mass", 0.028085}, {"latent_heat_fusion", 50210 / 0.028085}};
    const double t = 1450, a = std::exp(36940 / kGas * (1 / t - 1 / 1211.4)),
                 b = std::exp(50210 / kGas * (1 / t - 1 / 1687.0));
    const double liquid = (1 - b) / (a - b), solid = liquid * a;  // moles of germanium
    const auto mass = [](double moles) { return (1 - moles) * 0.028085 / ((1 - moles) * 0.028085 + moles * 0.07263); };
    QVERIFY(within(at(mixed(germanium, silicon, mass(liquid)), "liquidus"), t, 1e-9));
    QVERIFY(within(at(mixed(germanium, silicon, mass(solid)), "solidus"), t, 1e-9));
    const Material out = mixed(germanium, silicon, 0.3);
    QVERIFY(at(out, "solidus") < at(out, "melting_temperature") &&
            at(out, "melting_temperature") < at(out, "liquidus"));
    QVERIFY(problemOf(out).empty());
  }

  /// At its boiling point the pressures of the parts, each of which boils there at its own, add up to 1 atm.
  void vapoursAddUpToTheAirsPressure() {
    const double share = 0.4, t = at(mixed(thin(), thick(), share), "boiling_temperature");
    double total = 0, moles = share / 0.018 / (share / 0.018 + (1 - share) / 0.046);
    for (const auto& [part, fraction] : {std::pair(thin(), 1 - moles), std::pair(thick(), moles)}) {
      const PhaseDiagram diagram = phaseDiagramOf(part);
      double low = 1e3, high = 1e6;
      for (int i = 0; i < 100; ++i)
        (diagram.boilingPoint(std::sqrt(low * high)) < t ? low : high) = std::sqrt(low * high);
      total += fraction * low;
    }
    QVERIFY(within(total, 101325, 1e-5));
  }

  /// Brine-like: what never boils raises the boiling point, as Raoult's law says, and at last ends it.
  void onePartNeverBoils() {
    const Material salt = with(with(thin(), "boiling_temperature", 0), "molar_mass", 0.0584);
    const double share = 0.9, t = at(mixed(salt, thick(), share), "boiling_temperature");
    const double moles = share / 0.018 / (share / 0.018 + 0.1 / 0.0584), latent = 2.2e6 * 0.018;
    QVERIFY(within(t, 1 / (1 / 370.0 + kGas * std::log(moles) / latent), 1e-9));
    QCOMPARE(at(mixed(salt, thick(), 0.002), "boiling_temperature"), 0.0);
    QVERIFY(whyNoMixture(salt, thick(), share).empty());
  }

  /// A law and a constant make a curve that keeps to the rule, and a curve's points are points of the mixture's.
  void responsesOfDifferentKinds() {
    const Response viscosity = law("arrhenius", {1e-3, 14000, 298.15});
    Response density;
    density.kind = Response::Kind::Curve;
    density.points = {{260, 1000}, {277, 1001}, {360, 960}};
    const Material one = with(thin(), "viscosity", viscosity), other = with(thick(), "density_liquid", density);
    const Material out = mixed(one, other, 0.5);
    const double moles = 46.0 / 64;
    for (double t = 250; t < 400; t += 7) {
      QVERIFY(within(at(out, "viscosity", t), std::pow(viscosity.at(t), 1 - moles) * std::pow(0.1, moles), 0.02));
      QVERIFY(within(at(out, "density_liquid", t), 2 / (1 / 800.0 + 1 / density.at(t)), 0.01));
    }
    for (const CurvePoint& point : density.points)
      QVERIFY(within(at(out, "density_liquid", point.x), 2 / (1 / 800.0 + 1 / point.y), 1e-12));
    QVERIFY(problemOf(out).empty());
    Material none = thin();
    none.properties.erase("viscosity");  // the usual value stands in
    QVERIFY(
        within(at(mixed(none, thick(), 0.5), "viscosity"), std::pow(1e-3, 1 - moles) * std::pow(0.1, moles), 1e-12));
  }

  void refusals_data() {
    QTest::addColumn<QString>("first");
    QTest::addColumn<QString>("second");
    QTest::addColumn<QString>("says");
    QTest::newRow("sublimes") << "co2"
                              << "water"
                              << "turns from solid to gas";
    QTest::newRow("boils first") << "iron"
                                 << "water"
                                 << "boils before";
    QTest::newRow("fine") << "tin"
                          << "lead"
                          << "";
    QTest::newRow("never melts, liquid") << "honey"
                                         << "water"
                                         << "";
  }
  void refusals() {
    QFETCH(QString, first);
    QFETCH(QString, second);
    QFETCH(QString, says);
    const Material &one = *m_plugins.material(first.toStdString()), &other = *m_plugins.material(second.toStdString());
    const QString why = QString::fromStdString(whyNoMixture(one, other, 0.5));
    QVERIFY2(says.isEmpty() ? why.isEmpty() : why.contains(says), qPrintable(why));
    QCOMPARE(QString::fromStdString(whyNoMixture(other, one, 0.5)).isEmpty(), says.isEmpty());
    Material stone{"stone", "Stone", {}, {}};
    stone.properties["melting_temperature"] = 0.0;
    QVERIFY(QString::fromStdString(whyNoMixture(stone, other, 0.5)).contains(QStringLiteral("Stone stays solid")));
    QVERIFY(!whyNoMixture(one, other, 1.5).empty());
  }

  /// All pairs of what is installed either mix at any share or say why not.
  void everyInstalledPair() {
    for (const std::string& one : m_plugins.ids(PluginKind::Material)) {
      for (const std::string& other : m_plugins.ids(PluginKind::Material)) {
        for (const double share : {0.01, 0.5, 0.99}) {
          const Mixture mixture{share, partOf(*m_plugins.material(one)), partOf(*m_plugins.material(other)), {}};
          if (!whyNot(mixture).empty()) continue;
          Project project;
          project.materials.push_back(mixedMaterial(mixture, m_plugins));
          project.materials.back().id = "mixture";
          const Material compiled = compileMaterials(project, m_plugins).front();
          const Material made = materialOf(mixture);
          for (const auto& [key, value] : made.properties)
            QVERIFY2(valueOf(compiled, key, 350) == value.at(350), (one + " " + other + " " + key).c_str());
        }
      }
    }
  }

  /// What it was made of goes to the file and back with it, and the share can be changed afterwards.
  void theRecordIsKept() {
    SceneMaterial solder =
        mixedMaterial({0.37, partOf(*m_plugins.material("tin")), partOf(*m_plugins.material("lead")), {}}, m_plugins);
    solder.id = "solder";
    Project project;
    project.materials.push_back(solder);
    const LoadedProject read = parseProject(writeProject(project), "solder.json", m_plugins);
    QVERIFY2(read.warnings.empty(), read.warnings.empty() ? "" : read.warnings.front().text.c_str());
    SceneMaterial back = read.project.materials.front();
    const auto mixture = back.mixture;
    QVERIFY(mixture && mixture->share == 0.37);
    QCOMPARE(mixtureText(*mixture), std::string("63\u202f% Tin and 37\u202f% Lead by mass"));
    QVERIFY(back.properties == solder.properties);
    back.properties.values["restitution"] = 0.77;  // by hand
    const SceneMaterial changed = withShare(back, 0.6, m_plugins);
    QVERIFY(changed.properties.values.at("restitution") == Value(0.77));
    QVERIFY(changed.label.starts_with("40\u202f%") && changed.mixture->share == 0.6);
    QVERIFY(changed.properties.values.at("density_solid") != back.properties.values.at("density_solid"));
    const SceneMaterial again = withShare(changed, 0.37, m_plugins);
    QVERIFY(again.properties == back.properties && again.label == back.label);
    SceneMaterial plain;
    plain.id = plain.base = "water";
    QVERIFY(!plain.mixture);
    QVERIFY_EXCEPTION_THROWN((void)withShare(plain, 0.5, m_plugins), InputError);
    QVERIFY_EXCEPTION_THROWN((void)withShare(back, 2, m_plugins), InputError);
  }

  void theCommandLineMixes() {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("solder.json"));
    const Ran ran = cli({"mix", "tin", "lead", "--share", "0.37", "--name", "Solder", "--id", "solder", "--out", path});
    QVERIFY2(ran.code == 0 && ran.out.contains("density_solid") && ran.out.contains("volumes add up"), ran.err);
    const Project project = loadProject(path.toStdString(), m_plugins).project;
    QCOMPARE(project.materials.front().label, std::string("Solder"));
    QCOMPARE(project.materials.front().mixture->share, 0.37);
    QCOMPARE(cli({"mix", path, "gallium", "--quiet"}).code, 0);
    QCOMPARE(cli({"mix", path + "#solder", "gallium", "--quiet"}).code, 0);
    for (const QStringList& wrong : {QStringList{"mix", "tin"},
                                     {"mix", "tin", "unobtainium"},
                                     {"mix", "iron", "water"},
                                     {"mix", "tin", "lead", "--share", "1.2"},
                                     {"mix", path + "#tin", "lead"},
                                     {"mix", "tin", "lead", "--id", "a/b", "--out", path}})
      QVERIFY2(cli(wrong).code == 2, qPrintable(wrong.join(u' ')));
  }

  void aBrokenRecordIsRefused() {
    const std::string text =
        R"({"format": "phasesketch", "version": 1, "bodies": [], "materials": [{"id": "m", "base": "water",
      "mixture": {"share": 2, "first": {}, "second": {}}}]})";
    try {
      (void)parseProject(text, "broken.json", m_plugins);
      QFAIL("it was read");
    } catch (const InputError& error) {
      QVERIFY2(QString::fromUtf8(error.what()).contains(QStringLiteral("/materials/0/mixture/share")), error.what());
    }
  }

 private:
  PluginRegistry m_plugins;
};

QTEST_APPLESS_MAIN(TestMixing)
#include "tst_mixing.moc"
