// SPDX-License-Identifier: Apache-2.0
// What declarations say of other parameters and of time, held against what a running engine does: every declared
// parameter of every owner, our plugins' among them.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/simulation/rules.h"
#include "core/solver/solver.h"
#include "tests/shared/menagerie.h"

#include <QTest>

#include <map>
#include <random>
#include <set>

using namespace ps;

class TestDeclarations : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void rulesAreSound();
  void conditionsHoldAndFail_data() { addresses(true); }
  void conditionsHoldAndFail();
  void valuesActWhenTheySay_data() { addresses(false); }
  void valuesActWhenTheySay();
  void idleValuesDoNothing_data() { addresses(true); }
  void idleValuesDoNothing();
  void relationsRefuse_data();
  void relationsRefuse();

 private:
  void addresses(bool conditional);
  const api::ParameterDeclaration& declared(const Project& project, const Address& address) {
    return *declarationOf(project, &m_plugins, address);
  }
  /// A scene in which the condition of an address holds, or does not.
  Project scene(const Address& address, bool enabled);
  Value another(const Project& project, const Address& address);
  const std::array<uint64_t, 2>& untouched(const Project& project);
  double number(const Project& project, Address address, const std::string& key) {
    address.key = key;
    const Value value = valueAt(project, &m_plugins, address);
    return responseOf(value).at(293.15);
  }
  bool breaks(const Relation& relation, const Project& project, const Address& address);
  /// What a file of the project is refused for; "" where it opens.
  std::string refusal(const Project& project);

  PluginRegistry m_plugins;
  std::map<std::string, std::array<uint64_t, 2>> m_untouched;
};

namespace {

constexpr int kBefore = 3, kAfter = 4;  // frames
constexpr int kFiles = 30;              // broken projects of one relation, but a material's, that are written and read

/// What acts, but on no particle: on how it is drawn, or on plugins that ask for it and are not ours.
bool movesNothing(const Address& address) {
  return address.owner == Owner::Material &&
         (address.key.starts_with("color_") || address.key == "clearness" || address.key == "poisson_ratio");
}

/// Values that reach the engine as other commands than SetParameter.
bool isOtherCommand(const Address& address) {
  if (address.owner == Owner::Scene) return !pluginBehind(address.key, kHeatSourceKey).empty();
  return !adhesionPartner(address).empty() || address.key == kBodyMaterialKey || address.key == kStructureKey ||
         !pluginBehind(address.key, kNeighbourKey).empty();
}

void play(Engine& engine, int frames) {
  for (int i = 0; i < frames; ++i) engine.step();
}

struct Setting {
  const char* address;
  Value value;
};
/// What must be otherwise than in the menagerie for a value to show, and a value that shows it.
struct Setup {
  const char* address;
  std::vector<Setting> settings;
  std::optional<Value> value;
};
const Setup kSetups[] = {
    {"constraint/ice/bonds/bond_max",
     {{"body/ice/temperature", 273.15},
      {"body/ice/phase", std::string("liquid")},
      {"body/ice/heating_power", -1000.0},
      {"wall/floor/heat", std::string("adiabatic")}},
     1.0},
    {"constraint/ice/bonds/spring_stiffness", {}, 100.0},
    {"constraint/ice/bonds/stiffness_law", {{"material/water/youngs_modulus", Response(1e5)}}, {}},
    {"constraint/ice/bonds/stiffness_softening",
     {{"material/water/youngs_modulus", Response(1e5)}, {"constraint/ice/bonds/reference_temperature", 250.0}},
     {}},
    {"body/paddle/motion_stop", {}, 0.05},
    {"constraint/jelly/clusters/spacing", {}, 1.0},
    {"constraint/stone/rigid/least_members",
     {{"body/stone/temperature", 273.14},
      {"body/stone/heating_power", 250.0},
      {"wall/floor/heat", std::string("adiabatic")}},
     {}},
    {"constraint/flag/cloth/tear_strain", {}, 1e-4},
    {"constraint/line/rope/stretch_stiffness", {{"constraint/line/rope/tied_to_fixed", true}}, 1.0},
    {"constraint/line/rope/tear_strain", {{"constraint/line/rope/tied_to_fixed", true}}, 1e-6},
    {"material/water/melting_slope", {{"environment/ambient_pressure", 5e4}}, {}},
    {"material/water/triple_temperature", {{"environment/ambient_pressure", 5e4}}, {}},
    {"material/water/latent_heat_sublimation", {{"environment/ambient_pressure", 100.0}}, {}},
    {"material/water/critical_temperature",
     {{"environment/ambient_pressure", 1e8}, {"body/steam/temperature", 800.0}},
     {}},
    {"material/water/youngs_modulus", {}, Response(1e5)},
    {"material/water/sinters",
     {{"material/water/sinters", false},
      {"body/ice/temperature", 250.0},
      {"wall/floor/heat", std::string("adiabatic")}},
     true},
    {"thermal/diffusivity", {{"scene/thermal_model", std::string("thesis_diffusion")}}, {}},
    {"sink/drain/rotation_x", {}, 45.0},
    {"sink/drain/rotation_y", {}, 45.0},
    {"sink/drain/rotation_z", {}, 45.0},
    {"emitter/tap/stop", {}, 0.01},
    {"emitter/tap/most", {}, 10.0},
    {"solver/viscosity_max",
     {{"material/butter/viscosity", Response(50.0)},
      {"body/butter/temperature", 300.0},
      {"wall/floor/heat", std::string("adiabatic")}},
     1e-3},
    {"solver/viscosity_iterations", {}, 1.0},
};
const Setup* setupOf(const Address& address) {
  const std::string text = address.text();
  const auto* const found =
      std::find_if(std::begin(kSetups), std::end(kSetups), [&](const Setup& s) { return s.address == text; });
  return found == std::end(kSetups) ? nullptr : found;
}

/// The menagerie as an address needs it.
Project prepared(const Address& address) {
  Project project = scenes::menagerie();
  const Setup* setup = setupOf(address);
  for (const auto& [text, value] : setup ? setup->settings : std::vector<Setting>{}) {
    const Address other = *Address::parse(text);
    if (!setOutsideValue(project, other, value)) findSet(project, other)->values[other.key] = value;
  }
  return project;
}

/// Of every field of every particle. What an engine hashes has settings in it, of constraints and clocks.
uint64_t matterHash(const Engine& engine) { return savedHash(engine.solver().particles()); }

/// Two hashes: after kBefore and kAfter frames, and after as many again from a reset.
std::array<uint64_t, 2> hashes(Engine& engine) {
  play(engine, kAfter);
  std::array<uint64_t, 2> found{matterHash(engine), 0};
  engine.apply(Reset{});
  play(engine, kBefore + kAfter);
  found[1] = matterHash(engine);
  return found;
}

Address parsed(const QString& text) { return *Address::parse(text.toStdString()); }

std::vector<Address> keysOf(const Relation& relation, const Address& address) {
  std::vector<Clause> clauses{relation.clause};
  std::set<std::string> keys{relation.plus};
  for (const Clause& clause : relation.when.clauses) clauses.push_back(clause);
  for (const Clause& clause : relation.unless ? relation.unless->clauses : std::vector<Clause>{})
    clauses.push_back(clause);
  for (const Clause& clause : clauses) {
    keys.insert(clause.key);
    if (const auto* other = std::get_if<std::string>(&clause.to)) keys.insert(*other);
  }
  keys.erase("");
  std::vector<Address> addresses;
  for (const std::string& key : keys) addresses.push_back({address.owner, address.id, key, address.plugin});
  return addresses;
}

/// One in ten is the least that is allowed, which often means none.
Value draw(const api::ParameterDeclaration& d, std::mt19937& random) {
  if (d.kind == api::ParameterKind::Toggle) return random() % 2 == 0;
  const double share = static_cast<double>(random() % 1000) / 1000;
  const double number = random() % 10 == 0 ? d.hardMinimum : d.minimum + share * (d.maximum - d.minimum);
  return conformed(number, d);
}

/// Worked out from the words of the declaration, in plain arithmetic.
bool meets(double left, Comparison comparison, double right) {
  const int order = left < right ? -1 : left > right;
  switch (comparison) {
    case Comparison::Below:
      return order < 0;
    case Comparison::AtMost:
      return order <= 0;
    case Comparison::AtLeast:
      return order >= 0;
    case Comparison::Above:
      return order > 0;
    case Comparison::Equal:
      return order == 0;
    case Comparison::NotEqual:
      break;
  }
  return order != 0;
}

/// The value a clause asks for, or one that it does not.
Value meeting(const Clause& clause, const api::ParameterDeclaration& d, bool met) {
  const bool positive = met == (clause.comparison != Comparison::NotEqual);
  if (const auto* names = std::get_if<std::vector<std::string>>(&clause.to)) {
    if (d.kind == api::ParameterKind::Toggle) return (names->front() == "on") == positive;
    if (d.kind == api::ParameterKind::Response && positive) return Response(1000.0);
    if (d.kind == api::ParameterKind::Response) {
      Response curve;
      curve.kind = Response::Kind::Curve;
      curve.points = {{100, 1100}, {1000, 900}};
      return curve;
    }
    for (const std::string& choice : choicesOf(d)) {
      const bool among = std::find(names->begin(), names->end(), choice) != names->end();
      if (among == positive) return choice;
    }
  }
  return met ? d.maximum : std::get<double>(clause.to);
}

}  // namespace

/// One row per declaration; of bodies one that is held in place and one that is not.
void TestDeclarations::addresses(bool conditional) {
  QTest::addColumn<QString>("text");
  const Project project = scenes::menagerie();
  std::set<std::string> seen;
  for (const Address& address : allAddresses(project, &m_plugins)) {
    const api::ParameterDeclaration& d = declared(project, address);
    const bool fixed = address.id == "paddle", twice = d.actsAt == api::ActsAt::NextFrameIfFixed;
    if (isOtherCommand(address) || (conditional && !d.enabledWhen)) continue;
    if (address.owner == Owner::Body && address.key.starts_with("motion_") && !fixed) continue;
    if (address.key == "across_materials" && address.id != "strip") continue;  // is of several
    const std::string place = std::string(ownerName(address.owner)) + address.plugin + (twice && fixed ? "fixed" : "");
    if (seen.insert(place + "/" + address.key).second)
      QTest::newRow(address.text().c_str()) << QString::fromStdString(address.text());
  }
  if (!conditional) QTest::newRow("another model") << QStringLiteral("thermal/diffusivity");
}

Project TestDeclarations::scene(const Address& address, bool enabled) {
  Project project = prepared(address);
  const api::ParameterDeclaration& d = declared(project, address);
  for (const Clause& clause : parseCondition(d.enabledWhen).clauses) {
    const bool wide = clause.key.find('/') != std::string::npos;
    const Address other =
        wide ? *Address::parse(clause.key) : Address{address.owner, address.id, clause.key, address.plugin};
    const Condition one{{clause}};
    const ValueOfKey value = [&](std::string_view) { return valueAt(project, &m_plugins, other); };
    if (holds(one, value) == enabled) continue;
    Value wanted = meeting(clause, declared(project, other), enabled);
    if (clause.key == "scene/thermal_model") wanted = std::string(enabled ? scenes::kThermalModel : "none");
    if (!setOutsideValue(project, other, wanted)) findSet(project, other)->values[other.key] = wanted;
    if (!enabled) break;
  }
  return project;
}

/// One that is allowed and far from the present one.
Value TestDeclarations::another(const Project& project, const Address& address) {
  const api::ParameterDeclaration& d = declared(project, address);
  const Value now = valueAt(project, &m_plugins, address);
  if (const Setup* setup = setupOf(address); setup && setup->value) return *setup->value;
  if (const bool* on = std::get_if<bool>(&now)) return !*on;
  if (const auto* name = std::get_if<std::string>(&now)) {
    std::vector<std::string> choices = choicesOf(d);
    std::erase_if(choices, [&](const std::string& choice) { return choice == *name || choice == "none"; });
    return choices.empty() ? "none" : choices.back();
  }
  const double number = responseOf(now).at(293.15);
  for (const double to : {d.maximum, d.minimum, 0.5 * (number + d.maximum), 1.1 * number, 0.9 * number}) {
    const double wanted = d.kind == api::ParameterKind::Integer ? std::round(to) : to;
    const Value value = conformed(wanted, d);
    if (std::abs(wanted - number) > 1e-9 * std::abs(number) && problemWith(project, &m_plugins, address, value).empty())
      return value;
  }
  return now;
}

const std::array<uint64_t, 2>& TestDeclarations::untouched(const Project& project) {
  const auto [found, fresh] = m_untouched.try_emplace(writeProject(project));
  if (!fresh) return found->second;
  Engine engine(project, m_plugins);
  play(engine, kBefore);
  return found->second = hashes(engine);
}

bool TestDeclarations::breaks(const Relation& relation, const Project& project, const Address& address) {
  const auto met = [&](const Clause& clause, double plus) {
    const double left = number(project, address, clause.key) + plus;
    if (const auto* names = std::get_if<std::vector<std::string>>(&clause.to))
      return (left != 0) == (*names == std::vector<std::string>{"on"});
    const auto* key = std::get_if<std::string>(&clause.to);
    return meets(left, clause.comparison, key ? number(project, address, *key) : std::get<double>(clause.to));
  };
  const auto all = [&](const Condition& condition) {
    for (const Clause& clause : condition.clauses)
      if (!met(clause, 0)) return false;
    return true;
  };
  if (!all(relation.when) || (relation.unless && all(*relation.unless))) return false;
  return !met(relation.clause, relation.plus.empty() ? 0 : number(project, address, relation.plus));
}

std::string TestDeclarations::refusal(const Project& project) {
  try {
    parseProject(writeProject(project), "scene.json", m_plugins);
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

void TestDeclarations::rulesAreSound() {
  const auto check = [](api::ParameterList list) {
    for (size_t i = 0; i < list.count; ++i) {
      const std::string problem = problemOfRules(list[i], [&](std::string_view key) {
        return key.find('/') == std::string_view::npos ? findDeclaration(list, key) : sceneWideDeclaration(key);
      });
      QVERIFY2(problem.empty(), (list[i].key + (": " + problem)).c_str());
    }
  };
  for (const api::ParameterList& list : {propertyCatalogue(), environmentParameters(), solverParameters(),
                                         wallParameters(), bodyParameters(), emitterParameters(), sinkParameters()})
    check(list);
  for (const PluginInfo& plugin : m_plugins.plugins()) check(m_plugins.parameters(plugin.id));
}

void TestDeclarations::conditionsHoldAndFail() {
  QFETCH(QString, text);
  const Address address = parsed(text);
  QCOMPARE(idleReason(scene(address, true), &m_plugins, address), std::string());
  const std::string reason = idleReason(scene(address, false), &m_plugins, address);
  QVERIFY2(reason.starts_with("Acts when “") && reason.ends_with("."), reason.c_str());
}

void TestDeclarations::valuesActWhenTheySay() {
  QFETCH(QString, text);
  const Address address = parsed(text);
  Project project = scene(address, true);
  const Value value = another(project, address);
  QVERIFY(value != valueAt(project, &m_plugins, address));
  const api::ActsAt when = declared(project, address).actsAt;
  const bool now = when == api::ActsAt::NextFrame || when == api::ActsAt::WithItsMatter ||
                   (when == api::ActsAt::NextFrameIfFixed && address.id == "paddle");
  Engine engine(project, m_plugins);
  play(engine, kBefore);
  QCOMPARE(engine.setParameter(address, value), now);
  const std::array<uint64_t, 2> with = hashes(engine), without = untouched(project);
  if (!setOutsideValue(project, address, value)) findSet(project, address)->values[address.key] = value;
  Engine born(project, m_plugins);
  play(born, kBefore + kAfter);
  QCOMPARE(with[1], matterHash(born));  // a reset makes what a scene with the value from the start would have made
  if (movesNothing(address)) return;
  QCOMPARE(with[0] != without[0], now);
  QVERIFY(with[1] != without[1]);
}

void TestDeclarations::idleValuesDoNothing() {
  QFETCH(QString, text);
  const Address address = parsed(text);
  const Project project = scene(address, false);
  const Value value = another(project, address);
  QVERIFY(value != valueAt(project, &m_plugins, address));
  Engine engine(project, m_plugins);
  play(engine, kBefore);
  engine.setParameter(address, value);
  QCOMPARE(hashes(engine), untouched(project));
}

void TestDeclarations::relationsRefuse_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<int>("index");
  const Project project = scenes::menagerie();
  for (const Address& address : allAddresses(project, &m_plugins)) {
    if (address.owner == Owner::Material && address.id != project.materials.front().id) continue;  // all alike
    const std::vector<Relation> relations = parseRelations(declared(project, address));
    for (size_t i = 0; i < relations.size(); ++i)
      QTest::addRow("%s %d", address.text().c_str(), static_cast<int>(i))
          << QString::fromStdString(address.text()) << static_cast<int>(i);
  }
}

/// Random values of all that a relation speaks of: what breaks it is refused by the panels and in a file, with the key,
/// or is let in and advised against.
void TestDeclarations::relationsRefuse() {
  QFETCH(QString, text);
  QFETCH(int, index);
  const Address address = parsed(text);
  const Relation relation = parseRelations(declared(scenes::menagerie(), address)).at(static_cast<size_t>(index));
  std::mt19937 random(1);
  std::array<int, 2> seen{};
  int letIn = 0;
  for (int k = 0; k < 300; ++k) {
    Project project = scenes::menagerie();
    for (const Address& other : keysOf(relation, address)) {
      const Value drawn = draw(declared(project, other), random);
      findSet(project, other)->values[other.key] = drawn;
    }
    const bool broken = breaks(relation, project, address);
    ++seen[broken];
    QCOMPARE(!adviceOf(project, &m_plugins, address).empty(), broken && !relation.must);
    if (!broken) continue;
    const Value own = valueAt(project, &m_plugins, address);
    const bool material = address.owner == Owner::Material;
    const std::string file = material || seen[1] <= kFiles ? refusal(project) : std::string();
    // A material that came with contradicting values is mended value by value: let in where it was wrong before and
    // another of its values is to blame now.
    Project before = project;
    findSet(before, address)->values.erase(address.key);
    const bool another =
        material && file.find("/properties/" + address.key + ": ") == std::string::npos && !refusal(before).empty();
    QCOMPARE(problemWith(before, &m_plugins, address, own).empty(), !relation.must || another);
    letIn += relation.must && another ? 1 : 0;
    if (material || seen[1] <= kFiles) QVERIFY2(relation.must ? !file.empty() : file.empty(), file.c_str());
  }
  QVERIFY2(letIn <= seen[1] / 4, qPrintable(QString::number(letIn)));
  QVERIFY2(seen[0] > 10 && seen[1] > 10, qPrintable(QString("held %1, broken %2").arg(seen[0]).arg(seen[1])));
}

QTEST_GUILESS_MAIN(TestDeclarations)
#include "tst_declarations.moc"
