// SPDX-License-Identifier: Apache-2.0
#include "core/matter/heatingcurve.h"
#include "core/matter/material.h"
#include "core/matter/phasebands.h"
#include "core/matter/phasediagram.h"
#include "core/matter/phaselines.h"
#include "enthalpymodel.h"

#include <QSet>
#include <QTest>

#include <cmath>

using ps::BakedMaterial;
using ps::Material;
using ps::PhaseDiagram;

namespace {
/// Constants of the reference cases, not those of the installed material.
PhaseDiagram water() {
  PhaseDiagram d;
  d.meltingPoint0 = 273.15;
  d.boilingPoint0 = 373.124;
  d.latentHeatVaporization = 2257e3;
  d.latentHeatSublimation = 2834e3;
  d.molarMass = 0.01801528;
  d.tripleTemperature = 273.16;
  d.triplePressure = 611.657;
  d.criticalTemperature = 647.096;
  return d;
}
PhaseDiagram carbonDioxide() {
  PhaseDiagram d;
  d.meltingPoint0 = 216.592;
  d.boilingPoint0 = 194.686;
  d.latentHeatVaporization = 348e3;
  d.latentHeatSublimation = 571e3;
  d.molarMass = 0.04401;
  d.tripleTemperature = 216.592;
  d.triplePressure = 517950;
  d.criticalTemperature = 304.13;
  return d;
}
Material waterMaterial() {
  Material m{"water", "Water", {}, {}};
  m.properties = {{"melting_temperature", 273.15},
                  {"boiling_temperature", 373.124},
                  {"latent_heat_fusion", 334e3},
                  {"latent_heat_vaporization", 2257e3},
                  {"latent_heat_sublimation", 2834e3},
                  {"molar_mass", 0.01801528},
                  {"triple_temperature", 273.16},
                  {"triple_pressure", 611.657},
                  {"critical_temperature", 647.096},
                  {"heat_capacity_solid", 2100.0},
                  {"heat_capacity_liquid", 4186.0},
                  {"heat_capacity_gas", 2010.0},
                  {"conductivity_solid", 2.2},
                  {"conductivity_liquid", 0.6},
                  {"conductivity_gas", 0.025},
                  {"density_solid", 917.0},
                  {"density_liquid", 998.0}};
  return m;
}
Material with(Material material, const char* key, ps::Response value) {
  material.properties[key] = std::move(value);
  return material;
}
ps::Response law(const char* name, const std::vector<double>& coefficients) {
  ps::Response response;
  response.kind = ps::Response::Kind::Law;
  response.law = name;
  response.coefficients = coefficients;
  return response;
}
}  // namespace

class TestMatter : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// Every corner, and every middle between two, is a state of the enthalpy method.
  void theHeatingCurveIsThatOfTheEnthalpyMethod() {
    Material range = waterMaterial(), never = waterMaterial();
    range.properties["solidus"] = 270;
    range.properties["liquidus"] = 280;
    never.properties["boiling_temperature"] = 0;
    for (const Material& material : {waterMaterial(), range, never}) {
      for (const double pressure : {101325.0, 20000.0, 200.0}) {  // at 200 Pa ice sublimes
        const BakedMaterial baked(material, pressure);
        const std::vector<ps::HeatingCorner> corners = ps::heatingCurve(baked.caloric(), 200, 500);
        QVERIFY(corners.size() >= 4 && corners.front().temperature == 200 && corners.back().temperature == 500);
        for (size_t k = 0; k + 1 < corners.size(); ++k) {
          QVERIFY(corners[k].enthalpy < corners[k + 1].enthalpy);
          for (const double share : {0.01, 0.5, 0.99}) {
            const double h = std::lerp(corners[k].enthalpy, corners[k + 1].enthalpy, share);
            const double kelvin = std::lerp(corners[k].temperature, corners[k + 1].temperature, share);
            const ps::thermal::ThermalState state = ps::thermal::stateAt(baked.caloric(), h);
            QVERIFY(std::abs(state.temperature - kelvin) < 1e-6);
            QCOMPARE(corners[k].phase == ps::api::Phase::Gas, state.gas == 1);
            QCOMPARE(corners[k].phase == ps::api::Phase::Liquid, state.liquid == 1);
          }
        }
      }
    }
  }

  void catalogueIsFitToBeRead() {
    const auto list = ps::propertyCatalogue();
    QSet<QString> keys;
    for (size_t i = 0; i < list.count; ++i) {
      const auto& d = list[i];
      const QByteArray key = d.key;
      QVERIFY2(!keys.contains(key), key);
      keys.insert(key);
      QCOMPARE(ps::propertyIndex(d.key), static_cast<int>(i));
      QVERIFY2(QByteArray(d.label).size() > 2 && d.help[0] && d.example[0] && d.group[0], key);
      QVERIFY2(QByteArray(d.help).endsWith('.'), key);
      QVERIFY2(d.hardMinimum <= d.minimum && d.minimum < d.maximum && d.maximum <= d.hardMaximum, key);
      QVERIFY2(d.defaultValue >= d.minimum && d.defaultValue <= d.maximum, key);
      QVERIFY2(d.displayScale != 0, key);
    }
    QCOMPARE(ps::propertyIndex("colour"), -1);
  }

  void boilingPointsFollowPressure_data() {
    QTest::addColumn<double>("pressure");
    QTest::addColumn<double>("model");
    QTest::addColumn<double>("iapws");
    QTest::newRow("2 kPa") << 2e3 << 290.50411 << 290.6457;
    QTest::newRow("10 kPa") << 1e4 << 318.66872 << 318.9556;
    QTest::newRow("50 kPa") << 5e4 << 354.24825 << 354.4663;
    QTest::newRow("1 atm") << 101325.0 << 373.124 << 373.1243;
    QTest::newRow("200 kPa") << 2e5 << 393.80406 << 393.3606;
  }
  void boilingPointsFollowPressure() {
    QFETCH(double, pressure);
    QFETCH(double, model);
    QFETCH(double, iapws);
    const double t = water().boilingPoint(pressure);
    QVERIFY2(std::abs(t - model) < 0.01, qPrintable(QString::number(t, 'f', 5)));
    QVERIFY(std::abs(t - iapws) < 0.5);
  }

  void sublimationPointsFollowPressure_data() {
    QTest::addColumn<bool>("dryIce");
    QTest::addColumn<double>("pressure");
    QTest::addColumn<double>("kelvin");
    QTest::addColumn<double>("tolerance");
    const double ice[][2] = {{600, 272.9264}, {300, 264.7694}, {100, 252.7944}, {50, 245.7809}, {10, 230.9061}};
    for (const auto& row : ice) QTest::addRow("ice %g Pa", row[0]) << false << row[0] << row[1] << 0.01;
    const double co2[][2] = {{1e4, 170.2466}, {5e4, 186.5194}, {101325, 194.686}, {3e5, 208.7309}};
    for (const auto& row : co2) QTest::addRow("dry ice %g Pa", row[0]) << true << row[0] << row[1] << 0.05;
  }
  void sublimationPointsFollowPressure() {
    QFETCH(bool, dryIce);
    QFETCH(double, pressure);
    QFETCH(double, kelvin);
    QFETCH(double, tolerance);
    const PhaseDiagram d = dryIce ? carbonDioxide() : water();
    QVERIFY(d.sublimes(pressure));
    QVERIFY2(std::abs(d.sublimationPoint(pressure) - kelvin) < tolerance,
             qPrintable(QString::number(d.sublimationPoint(pressure), 'f', 4)));
  }

  void phaseDiagramEdges() {
    QVERIFY(!water().sublimes(1000));
    QVERIFY(!carbonDioxide().sublimes(6e5));
    QVERIFY(std::abs(carbonDioxide().boilingPoint(517950) - 216.592) < 1e-3);
    // The boiling line meets the triple point, and ends at the critical one.
    QVERIFY(std::abs(water().boilingPoint(611.657) - 273.16) < 1e-3);
    QCOMPARE(water().boilingPoint(1e9), 647.096);
    double before = 0;
    for (double p = 1; p < 1e9; p *= 1.2) {
      const double t = water().boilingPoint(p);
      QVERIFY(t >= before && t > 0);
      before = t;
    }
    PhaseDiagram glass;
    QVERIFY(std::isinf(glass.boilingPoint(1e5)));
    QVERIFY(!glass.sublimes(1));
    PhaseDiagram wax{331, 640, 250e3};
    QCOMPARE(wax.boilingPoint(1e3), 640.0);  // no molar mass: pressure does not matter
  }

  /// As they are drawn: three lines from the triple point, of which the boiling one ends at the critical point.
  void linesOfADiagramMeet() {
    const ps::PhaseLines lines = ps::phaseLines(water(), 10, 1e8);
    QVERIFY(lines.triple && lines.critical);
    for (const ps::PhasePoint& end : {lines.melting.front(), lines.boiling.front(), lines.sublimation.back()}) {
      QCOMPARE(end.pressure, 611.657);
      QVERIFY(std::abs(end.temperature - 273.16) < 0.02);  // the melting line is straight, from 273.15 K at 101325 Pa
    }
    QCOMPARE(lines.sublimation.front().pressure, 10.0);
    QCOMPARE(lines.melting.back().pressure, 1e8);
    QCOMPARE(lines.boiling.back().pressure, lines.critical->pressure);
    QVERIFY(std::abs(lines.boiling.back().temperature - 647.096) < 1e-3);
    QVERIFY(std::abs(water().boilingPoint(0.999 * lines.critical->pressure) - 647.096) < 0.2);
    QVERIFY(ps::phaseLines(water(), 1000, 1e5).sublimation.empty());
    PhaseDiagram glass;
    glass.meltingPoint0 = 1400;
    const ps::PhaseLines glassy = ps::phaseLines(glass, 10, 1e8);
    QVERIFY(!glassy.triple && !glassy.critical && glassy.boiling.empty() && !glassy.melting.empty());
  }

  void bandsFollowPressure() {
    using enum ps::api::Phase;
    const auto phases = [](double pressure) {
      std::vector<ps::api::Phase> found;
      for (const ps::PhaseBand& band : ps::bandsOf(waterMaterial(), pressure)) found.push_back(band.phase);
      return found;
    };
    QCOMPARE(phases(101325), (std::vector{Solid, Liquid, Gas}));
    QCOMPARE(phases(100), (std::vector{Solid, Gas}));
    QCOMPARE(ps::bandsOf(waterMaterial(), 100).front().to, water().sublimationPoint(100));
    QCOMPARE(ps::bandsOf(waterMaterial(), 1e6)[1].to, water().boilingPoint(1e6));
  }

  void phasesAreClassified_data() {
    QTest::addColumn<double>("kelvin");
    QTest::addColumn<double>("pressure");
    QTest::addColumn<QString>("phase");
    const struct {
      double t, p;
      const char* phase;
    } rows[] = {{263.15, 101325, "solid"}, {298.15, 101325, "liquid"}, {400, 101325, "gas"},
                {263.15, 100, "gas"},      {250, 100, "solid"},        {298.15, 1000, "gas"},
                {298.15, 5000, "liquid"},  {365, 70100, "gas"},        {360, 70100, "liquid"}};
    for (const auto& row : rows) QTest::addRow("%g K %g Pa", row.t, row.p) << row.t << row.p << row.phase;
  }
  void phasesAreClassified() {
    QFETCH(double, kelvin);
    QFETCH(double, pressure);
    QFETCH(QString, phase);
    const BakedMaterial baked(waterMaterial(), pressure);
    const double h = ps::thermal::enthalpyAt(baked.caloric(), kelvin, phase == "solid" ? 1 : 0,
                                             phase == "liquid" ? 1 : 0, phase == "gas" ? 1 : 0);
    const ps::thermal::ThermalState state = ps::thermal::stateAt(baked.caloric(), h);
    QCOMPARE(state.solid, phase == "solid" ? 1.0 : 0.0);
    QCOMPARE(state.liquid, phase == "liquid" ? 1.0 : 0.0);
    QCOMPARE(state.gas, phase == "gas" ? 1.0 : 0.0);
    QVERIFY(std::abs(state.temperature - kelvin) < 1e-9);
  }

  void temperatureRisesWithEnthalpy_data() {
    QTest::addColumn<Material>("material");
    QTest::addColumn<double>("pressure");
    Material butter =
        with(with(with(waterMaterial(), "solidus", 260.0), "liquidus", 290.0), "boiling_temperature", 500.0);
    butter.properties["triple_temperature"] = 0.0;
    Material glass = with(with(waterMaterial(), "melting_temperature", 0.0), "boiling_temperature", 0.0);
    QTest::newRow("water") << waterMaterial() << 101325.0;
    QTest::newRow("water, low pressure") << waterMaterial() << 50.0;
    QTest::newRow("butter") << butter << 101325.0;
    QTest::newRow("glass") << glass << 101325.0;
  }
  void temperatureRisesWithEnthalpy() {
    QFETCH(Material, material);
    QFETCH(double, pressure);
    const BakedMaterial baked(material, pressure);
    double before = 0;
    for (double h = -3e5; h < 4e6; h += 1234.5) {
      const auto s = ps::thermal::stateAt(baked.caloric(), h);
      QVERIFY(s.temperature >= before - 1e-9);
      QVERIFY(s.solid >= 0 && s.liquid >= 0 && s.gas >= 0);
      QVERIFY(std::abs(s.solid + s.liquid + s.gas - 1) < 1e-12);
      before = s.temperature;
    }
  }

  void kirchhoffPotentialIsTheIntegralOfConductivity() {
    const BakedMaterial baked(waterMaterial(), 101325);
    QVERIFY(std::abs(baked.kirchhoff(273.15)) < 1e-12);
    QVERIFY(std::abs(baked.kirchhoff(263.15) + 22) < 1e-9);
    QVERIFY(std::abs(baked.kirchhoff(293.15) - 12) < 1e-9);
    const double boiling = 0.6 * (373.124 - 273.15);
    QVERIFY(std::abs(baked.kirchhoff(383.124) - boiling - 0.25) < 1e-6);
    // Dry ice has no liquid in between.
    const BakedMaterial thin(waterMaterial(), 50);
    QVERIFY(std::abs(thin.kirchhoff(thin.caloric().meltingPoint + 10) - 0.25) < 1e-9);
  }

  void densityFollowsPhaseAndTemperature() {
    const BakedMaterial baked(with(waterMaterial(), "expansion_volumetric", 2.07e-4), 101325);
    QVERIFY(std::abs(baked.restDensity(260, 1, 0, 0) - 917) < 1e-6);
    QVERIFY(std::abs(baked.restDensity(293.15, 0, 1, 0) - 998) < 0.01);  // where the constant holds
    QVERIFY(std::abs(baked.restDensity(353.15, 0, 1, 0) - 998 / (1 + 2.07e-4 * 60)) < 0.01);
    const double half = baked.restDensity(273.15, 0.5, 0.5, 0);
    QVERIFY(half > 917 && half < baked.restDensity(273.15, 0, 1, 0));
    // A parcel of vapour takes gas_volume_factor (2.5) times the room of its liquid, and conducts as the liquid's
    // volume.
    const double boiling = baked.restDensity(373.124, 0, 1, 0);
    QVERIFY(std::abs(baked.restDensity(400, 0, 0, 1) * 2.5 / boiling - 1) < 1e-9);
    QVERIFY(std::abs(baked.condensedDensity(400, 0) / boiling - 1) < 1e-9);
    ps::Response densities;
    densities.kind = ps::Response::Kind::Curve;
    densities.points = {{273.15, 999.84}, {277.13, 999.97}, {293.15, 998.2}, {373.15, 958.4}};
    const BakedMaterial real(with(waterMaterial(), "density_liquid", densities), 101325);
    QVERIFY(real.restDensity(277.13, 0, 1, 0) > real.restDensity(273.15, 0, 1, 0));
  }

  void bakedLawsSayWhereTheyWereHeld() {
    Material material = waterMaterial();
    QVERIFY(BakedMaterial(material, 101325).heldRanges().empty());
    material.properties["conductivity_solid"] = law("linear", {2.2, 0.02, 230});
    material.properties["conductivity_liquid"] = law("linear", {0.6, -0.001, 293});
    material.properties["viscosity"] = law("vogel", {-1.6, 4000, 520});  // endless when cold, as a glass is
    const BakedMaterial baked(material, 101325);
    const auto held = baked.heldRanges();
    QCOMPARE(held.size(), size_t{2});
    QCOMPARE(held[0].property, ps::propertyIndex("conductivity_solid"));
    QCOMPARE(held[0].from, 0.0);
    QVERIFY(held[0].to > 116 && held[0].to <= 120);  // samples are 1.5 K apart
    QCOMPARE(held[0].used, 0.0);
    QCOMPARE(held[0].farther(50, 100), 50.0);
    QVERIFY(held[1].from >= 893 && held[1].from < 897 && std::isinf(held[1].to));
    QCOMPARE(held[1].farther(950, 1000), 1000.0);
  }

  void bakedLawsKeepTheirRange_data() {
    QTest::addColumn<QString>("key");
    QTest::addColumn<ps::Response>("response");
    QTest::addColumn<double>("kelvin");
    QTest::addColumn<double>("value");
    const auto row = [](const char* key, const ps::Response& response, double kelvin, double value) {
      QTest::addRow("%s at %g K", key, kelvin) << key << response << kelvin << value;
    };
    const ps::Response falling = law("linear", {0.6, -0.01, 293});
    row("conductivity_liquid", falling, 293, 0.6);
    row("conductivity_liquid", falling, 360, 0);
    row("conductivity_solid", falling, 360, 0);
    row("conductivity_gas", falling, 360, 0);
    row("density_liquid", law("linear", {-5, 0, 300}), 300, 0.1);
    row("density_solid", law("vogel", {5, 200, 140}), 260, 3e4);
    row("density_liquid", law("arrhenius", {1000, 0, 1e-310}), 300, 0.1);  // no number
    row("youngs_modulus", law("exponential", {1e8, 293.15, 2}), 100, 1e13);
    row("viscosity", law("vogel", {-1.6, 4000, 520}), 400, 1e15);
  }
  void bakedLawsKeepTheirRange() {
    QFETCH(QString, key);
    QFETCH(ps::Response, response);
    QFETCH(double, kelvin);
    QFETCH(double, value);
    const QByteArray name = key.toUtf8();
    const BakedMaterial baked(with(waterMaterial(), name, response), 101325);
    const double found = baked.property(name, kelvin);
    // A straight line is met by its table but for rounding; bounds are met exactly.
    QVERIFY2(std::abs(found - value) <= 1e-12 * std::abs(value), qPrintable(QString::number(found, 'g', 17)));
  }
  void bakedPotentialNeverFalls() {
    // Where a law for the conductivity turns negative, warmer matter must not have the lower potential: heat would run
    // uphill.
    const BakedMaterial baked(with(waterMaterial(), "conductivity_liquid", law("linear", {0.6, -0.01, 293})), 101325);
    for (double kelvin = 200; kelvin < 500; kelvin += 1)
      QVERIFY(baked.kirchhoff(kelvin + 1) >= baked.kirchhoff(kelvin));
  }

  void propertiesAreReadByKey() {
    const BakedMaterial baked(waterMaterial(), 101325);
    QCOMPARE(baked.property("conductivity_solid", 250), 2.2);
    QCOMPARE(baked.property("melting_temperature", 0), 273.15);
    QCOMPARE(baked.property("gas_volume_factor", 0), 2.5);  // from the catalogue
    QVERIFY(std::isnan(baked.property("colour", 0)));
  }

  void problemsNameTheirKey_data() {
    QTest::addColumn<Material>("material");
    QTest::addColumn<QString>("key");
    Material range = with(waterMaterial(), "solidus", 300.0);
    QTest::newRow("sound") << waterMaterial() << "";
    QTest::newRow("defaults") << Material{"x", "X", {}, {}} << "";
    QTest::newRow("solidus") << with(range, "liquidus", 290.0) << "solidus";
    QTest::newRow("outside") << with(range, "liquidus", 310.0) << "melting_temperature";
    QTest::newRow("boils first") << with(waterMaterial(), "boiling_temperature", 200.0) << "boiling_temperature";
    QTest::newRow("critical") << with(waterMaterial(), "critical_temperature", 300.0) << "critical_temperature";
    QTest::newRow("latent") << with(waterMaterial(), "latent_heat_vaporization", 1e4) << "latent_heat_vaporization";
    QTest::newRow("flicker") << with(with(waterMaterial(), "melt_break_fraction", 0.3), "freeze_bond_fraction", 0.6)
                             << "melt_break_fraction";
    QTest::newRow("unknown") << with(waterMaterial(), "colour", 1.0) << "colour";
    QTest::newRow("nan") << with(waterMaterial(), "solidus", std::nan("")) << "solidus";
    QTest::newRow("bad law") << with(waterMaterial(), "viscosity", law("vogle", {})) << "viscosity";
    const auto row = [](const char* name, const char* property, const ps::Response& response, bool sound = false) {
      QTest::newRow(name) << with(waterMaterial(), property, response) << (sound ? "" : property);
    };
    row("negative at 20 °C", "density_liquid", law("linear", {-5, 0, 300}));
    row("negative where it boils", "conductivity_liquid", law("linear", {0.6, -0.01, 293}));
    row("negative where it melts", "conductivity_solid", law("linear", {1, 0.1, 293}));
    row("negative as vapour", "conductivity_gas", law("linear", {0.02, -0.01, 293}));
    row("endless", "density_liquid", law("vogel", {5, 200, 140}));
    row("no number", "density_liquid", law("arrhenius", {1000, 0, 1e-310}));  // 0 times infinity
    row("negative viscosity", "viscosity", law("linear", {1e-3, -1e-4, 300}));
    // Where its phase does not exist a law may go where it likes, and a viscosity may grow without end.
    row("solid, where it is liquid", "youngs_modulus", law("linear", {1e9, -1e8, 273}), true);
    row("vapour, where it is liquid", "conductivity_gas", law("linear", {0.02, 1e-3, 360}), true);
    row("stiff liquid", "viscosity", law("vogel", {-5, 1000, 272}), true);
    QTest::newRow("glass") << with(with(Material{"glass", "Glass", {}, {}}, "melting_temperature", 0.0), "viscosity",
                                   law("vogel", {-1.6, 4000, 520}))
                           << "";
  }
  void problemsNameTheirKey() {
    QFETCH(Material, material);
    QFETCH(QString, key);
    const QString problem = QString::fromStdString(ps::problemOf(material));
    if (key.isEmpty())
      QCOMPARE(problem, QString());
    else
      QVERIFY2(problem.startsWith(key + ":"), qPrintable(problem));
  }
};

QTEST_APPLESS_MAIN(TestMatter)
#include "tst_matter.moc"
