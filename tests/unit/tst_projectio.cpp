// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/base/utf8.h"
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/io/schema.h"
#include "core/io/textfile.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

using namespace ps;
using nlohmann::json;

class TestProjectIo : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase();
  void savingTwiceGivesTheSameBytes_data();
  void savingTwiceGivesTheSameBytes();
  void savedSamplesStayAsTheyAre();
  void requiredKeysAreWrittenAtTheirDefaults();
  void everythingSurvives();
  void aViewWithoutACameraStaysWithoutOne();
  void aViewKeepsItsSection();
  void unknownKeysSurvive_data();
  void unknownKeysSurvive();
  void slipsAreNamed();
  void wrongValuesNameThePlace_data();
  void wrongValuesNameThePlace();
  void hostileTextIsRefused_data();
  void hostileTextIsRefused();
  void hostileFilesAreRefused();
  void missingPluginsAreWarningsUnlessRequired();
  void motionThatComesToNothingIsWarnedOf();
  void sketchedBodiesAreNotBornBelowOneKelvin();
  void lawsThatLeaveTheirRangeInTheSceneAreWarnedOf();
  void materialsAreCheckedAtTheScenesParameters();
  void tracksAreReadAndCheckedAgainstTheScene();
  void tracksOfWhatHasGoneAreNotSaved();
  void newerFilesOpenOnlyWhenTheySaySo();
  void editsFindTheirPlace_data();
  void editsFindTheirPlace();
  void editsAreUtf8();
  void publishedSchemaIsCurrent();
  void schemaNamesEveryDeclaredKey();
  void plainKeysAreNoParameters();
  void savingKeepsPermissionsAndLinks();
  void pipesAndDevicesAreWrittenNotReplaced();
  void placesThatCannotBeWrittenAreKnownBefore();
  void failedSaveKeepsTheOldFile();
  void aFileThatNamesNoThermalModelMeansTheStandardOne();
  void numbersAreShortest();

 private:
  LoadedProject parse(const std::string& text, const std::vector<std::string>& edits = {}) const {
    return parseProject(text, "scene.json", *m_plugins, edits);
  }
  QString problemOf(const std::string& text, const std::vector<std::string>& edits = {}) const;

  std::unique_ptr<PluginRegistry> m_plugins;
  std::string m_sample;
};

namespace {

/// Every kind of key once; values that are hard to write.
constexpr const char* kFull = R"({
  "format": "phasesketch", "version": 1, "title": "Tüte \"ü\"", "pluginsUsed": ["org.example.gone"],
  "materials": [
    {"id": "water", "base": "water", "properties": {"conductivity_solid": {"curve": [[200, 3.1], [220, 2.9, {"to_next": "step"}], [240, 2.8, {"to_next": "linear"}],
      [250, 2.6, {"slope_before": -0.02, "slope_after": -0.01}], [273.15, 2.2]]},
      "viscosity": {"law": "arrhenius", "coefficients": [0.001, 16000.5, 293.15]}, "density_solid": 916.7},
      "adheres_to": ["slime"]},
    {"id": "slime", "base": "org.example.gone", "tags": ["food", "kitchen"], "parameters": {"stickiness": [1, 2, {"deep": null}]}}],
  "bodies": [
    {"id": "a", "material": "water", "temperature": 263.15000000000003, "fixed": true, "velocity": [0, -1e-7, 0], "jitter": 0.2, "seed": 7,
     "spin": [0, 6.283185307179586, 0], "temperature_gradient": [-20.5, 0, 0],
     "velocity_wave": {"axis": "z", "wavelength": 0.8, "phase": 1.5, "velocity": [0, 0.1, 0]},
     "pins": [{"minimum": [-1, 0.12, -1], "maximum": [1, 0.2, 1]}],
     "shape": {"box": {"center": [0, 0.1, 0], "size": [0.1, 0.1, 0.1]}}, "visible": false, "locked": true},
    {"id": "b", "material": "slime", "constraints": [{"plugin": "org.example.gone", "parameters": {"k": 3}}],
     "shape": {"voxels": {"origin": [0, 0, 0.3333333333333333], "palette": [{"material": "slime", "temperature": 300}],
       "runs": [[0, 0, 0, 4, 0], [-2, 1, 0, 1, 0]],
       "strokes": [{"brush": "sphere", "radius": 0.02, "palette": 0, "erase": true,
                    "samples": [[0, 0, 0, 1, 0], [0.1, 0, 0, 0.5, 0.25]]}]}}}],
  "environment": {"gravity": [0, -1.62, 0], "periodic": [false, true, false], "bounds": {"minimum": [-1, -1, -1], "maximum": [1, 1, 1]},
    "walls": [{"id": "floor", "point": [0, 0, 0], "normal": [2, 0, 0], "heat": "fixed_temperature", "temperature": 400}]},
  "solver": {"substeps": 8, "kernel": "wendland_c2", "moment_correction": false,
             "thermal": {"model": "org.example.gone", "parameters": {"x": 1.5}}},
  "probes": [{"id": "p", "name": "Kern, innen", "quantity": "temperature", "body": "a", "phase": "solid",
              "region": {"minimum": [0, 0, 0], "maximum": [0.1, 0.1, 0.1]}, "wave": {"axis": "y", "wavelength": 2}, "material": "water"}],
  "graphs": [{"id": "g", "kind": "time", "series": ["probe/p", "frame/temperature"], "logarithmic": true, "difference": true},
             {"id": "h", "kind": "profile", "title": "Höhe", "field": "speed", "body": "a", "axis": "z", "below": true}],
  "tracks": [{"parameter": "wall/floor/temperature", "keys": [
       {"time": 0.1, "value": 400.00000000000006, "to_next": "smooth", "slope_after": 12.5},
       {"time": 3, "value": 300, "to_next": "step", "slope_before": -1}, {"time": 4, "value": 310, "to_next": "linear"}]},
     {"parameter": "body/a/spin_y", "keys": [{"time": 0, "value": -1e-7, "to_next": "linear"}]}],
  "markers": [{"time": 2.5, "name": "Hälfte"}, {"time": 0, "name": "Anfang"}],
  "duration": 12.5, "view": {"colour": "phase", "pinned": ["wall/floor/temperature"]}
})";

std::string textOf(const QString& s) { return s.toStdString(); }

}  // namespace

void TestProjectIo::initTestCase() {
  PluginRegistry::Options options;
  options.userDirectory = options.environment = false;
  m_plugins = std::make_unique<PluginRegistry>(options);
  m_sample = readFile(PS_SOURCE_DIR "/projects/ice-on-hot-plate.json", kMaximumProjectBytes);
  QVERIFY(m_plugins->has("water"));
}

QString TestProjectIo::problemOf(const std::string& text, const std::vector<std::string>& edits) const {
  try {
    parse(text, edits);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return (utf8Length(message) < message.size() ? "not UTF-8: " : "") + QString::fromStdString(message);
  }
  return QString();
}

void TestProjectIo::savingTwiceGivesTheSameBytes_data() {
  QTest::addColumn<QString>("text");
  QDirIterator files(PS_SOURCE_DIR "/projects", {"*.json"}, QDir::Files, QDirIterator::Subdirectories);
  while (files.hasNext()) {
    const QString file = files.next();
    QTest::newRow(qPrintable(QDir(PS_SOURCE_DIR).relativeFilePath(file)))
        << QString::fromStdString(readFile(textOf(file), kMaximumProjectBytes));
  }
  QTest::newRow("everything") << QString::fromUtf8(kFull);
  QTest::newRow("least") << R"({"format": "phasesketch", "version": 1, "materials": [], "bodies": []})";
}

void TestProjectIo::savingTwiceGivesTheSameBytes() {
  QFETCH(QString, text);
  const std::string once = writeProject(parse(textOf(text)).project);
  const std::string twice = writeProject(parse(once).project);
  QCOMPARE(QString::fromStdString(twice), QString::fromStdString(once));
}

/// A sample that the program has saved is saved again to the byte: files are compared and kept under version control.
void TestProjectIo::savedSamplesStayAsTheyAre() {
  for (const char* name : {"ice-on-hot-plate", "honey-coil"}) {
    const std::string path = PS_SOURCE_DIR "/projects/" + std::string(name) + ".json";
    const std::string text = readFile(path, kMaximumProjectBytes);
    QCOMPARE(QString::fromStdString(writeProject(parse(text).project)), QString::fromStdString(text));
  }
}

/// Whatever a field's value, what is required is written: a file that cannot be opened again is lost.
void TestProjectIo::requiredKeysAreWrittenAtTheirDefaults() {
  const Project still = parse(kFull, {"bodies/a/velocity_wave/velocity=[0, 0, 0]"}).project;
  QCOMPARE(parse(writeProject(still)).project.bodies[0].velocityWave, still.bodies[0].velocityWave);
}

void TestProjectIo::everythingSurvives() {
  // Every member of the original is in the saved file with the same value (whole numbers may lose their ".0").
  const json original = json::parse(kFull), saved = json::parse(writeProject(parse(kFull).project));
  for (const json& change : json::diff(original, saved)) {
    QVERIFY2(change["op"] == "add" || change["path"] == "/generator" || change["path"] == "/pluginsUsed",
             change.dump().c_str());
  }
  const Project project = parse(kFull).project;
  QCOMPARE(project.bodies.size(), size_t{2});
  QCOMPARE(project.materials[0].adheresTo, (std::optional<std::vector<std::string>>{{"slime"}}));
  QCOMPARE(project.materials[1].tags, (std::vector<std::string>{"food", "kitchen"}));
  QCOMPARE(std::get<VoxelShape>(project.bodies[1].shape).runs[1].x, -2);
  QCOMPARE(project.environment.periodic, (std::array<bool, 3>{false, true, false}));
  QCOMPARE(std::get<VoxelShape>(project.bodies[1].shape).spacing, 0.02);  // not said: the scene's
  const Project coarser = parse(writeProject(project), {"solver/particle_spacing=0.04"}).project;
  QCOMPARE(std::get<VoxelShape>(coarser.bodies[1].shape).spacing, 0.02);  // a sketch keeps its own
  QCOMPARE(std::get<double>(project.bodies[0].parameters.values.at("temperature")), 263.15000000000003);
  QCOMPARE(std::get<Response>(project.materials[0].properties.values.at("viscosity")).law, std::string("arrhenius"));
}

/// No camera means that the whole scene is shown: a default one would look from inside of whatever is larger.
void TestProjectIo::aViewWithoutACameraStaysWithoutOne() {
  const Project project = parse(kFull).project;
  QVERIFY(!project.view.camera);
  QVERIFY(!json::parse(writeProject(project))["view"].contains("distance"));
  const std::string bare = R"({"format": "phasesketch", "version": 1, "materials": [], "bodies": []})";
  QVERIFY(!json::parse(writeProject(parse(bare).project)).contains("view"));
  const Project placed = parse(kFull, {"view/distance=3"}).project;
  ViewCamera camera;
  camera.distance = 3;
  QVERIFY(placed.view.camera == camera);
  QVERIFY(parse(writeProject(placed)).project.view.camera == camera);
}

void TestProjectIo::aViewKeepsItsSection() {
  QVERIFY(!parse(kFull).project.view.section);
  QVERIFY(!json::parse(writeProject(parse(kFull).project))["view"].contains("section"));
  Project project = parse(kFull).project;
  project.view.section = ViewSection{"y", {0.1, -0.2, 0.3}, true};
  QVERIFY(parse(writeProject(project)).project.view.section == project.view.section);
  project.view = {};
  project.view.section = ViewSection{"view", {0, 0.1, 0}, false};  // all that there is to say of the view
  QVERIFY(parse(writeProject(project)).project.view.section == project.view.section);
}

void TestProjectIo::unknownKeysSurvive_data() {
  QTest::addColumn<QString>("pointer");
  for (const char* pointer : {"",
                              "/materials/0",
                              "/materials/0/properties",
                              "/materials/0/properties/conductivity_solid",
                              "/materials/1/parameters",
                              "/bodies/0",
                              "/bodies/0/shape",
                              "/bodies/0/shape/box",
                              "/bodies/1/shape/voxels",
                              "/bodies/1/shape/voxels/palette/0",
                              "/bodies/1/shape/voxels/strokes/0",
                              "/bodies/1/constraints/0",
                              "/bodies/1/constraints/0/parameters",
                              "/bodies/0/pins/0",
                              "/bodies/0/velocity_wave",
                              "/probes/0/region",
                              "/probes/0/wave",
                              "/environment",
                              "/environment/bounds",
                              "/environment/walls/0",
                              "/solver",
                              "/solver/thermal",
                              "/solver/thermal/parameters",
                              "/probes/0",
                              "/graphs/0",
                              "/tracks/0",
                              "/tracks/0/keys/1",
                              "/view"}) {
    QTest::newRow(*pointer ? pointer : "/") << pointer;
  }
}

void TestProjectIo::unknownKeysSurvive() {
  QFETCH(QString, pointer);
  const json::json_pointer place(textOf(pointer) + "/from~1the~0future");
  json document = json::parse(kFull);
  const json value = {{"a", 1.0}, {"b", {1, "two", nullptr, {{"c", 1e300}}}}};
  document[place] = value;
  const LoadedProject loaded = parse(document.dump());
  const std::string once = writeProject(loaded.project);
  QVERIFY(json::parse(once).contains(place));
  QCOMPARE(json::parse(once)[place].dump(), value.dump());
  QCOMPARE(writeProject(parse(once).project), once);
}

void TestProjectIo::slipsAreNamed() {
  const auto warningsOf = [&](const char* place, const json& value) {
    json document = json::parse(kFull);
    document[json::json_pointer(place)] = value;
    std::string all;
    for (const ProjectMessage& message : parse(document.dump()).warnings) all += message.text + "\n";
    return QString::fromStdString(all);
  };
  const auto pipe = [&](double radius) {
    const json wall = {
        {"id", "floor"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}, {"shape", "cylinder"}, {"radius", radius}};
    return warningsOf("/environment/walls/0", wall);
  };
  QVERIFY2(pipe(1e-4).contains(QStringLiteral("/environment/walls/0/radius: is less than a particle spacing")),
           qPrintable(pipe(1e-4)));
  QVERIFY(!pipe(10).contains(QStringLiteral("walls/0/radius")));
  const QString slip = warningsOf("/bodies/0/constrants", json::array());
  QVERIFY2(slip.contains(QStringLiteral("(did you mean 'constraints'?)")), qPrintable(slip));
  const QString plugin = warningsOf("/bodies/0/constraints", json::array({{{"plugin", "rigit"}}}));
  QVERIFY2(plugin.contains(QStringLiteral("(did you mean 'rigid'?)")), qPrintable(plugin));
  const QString model = warningsOf("/solver/thermal", {{"model", "enthalpy"}, {"parameters", {{"sped", 1}}}});
  QVERIFY2(model.contains(QStringLiteral("/solver/thermal/parameters/sped: is not known here")), qPrintable(model));
  const QString foreign = warningsOf("/bodies/0/somethingElse", 1);
  QVERIFY2(foreign.contains(QStringLiteral("not known here; it is kept")), qPrintable(foreign));
}

void TestProjectIo::wrongValuesNameThePlace_data() {
  QTest::addColumn<QString>("edit");
  QTest::addColumn<QString>("problem");
  const auto row = [](const char* name, const char* edit, const char* problem) {
    QTest::newRow(name) << edit << problem;
  };
  row("text for a number", "bodies/0/temperature=\"warm\"",
      "/bodies/0/temperature: must be a number, not the text 'warm'");
  row("number for a name", "bodies/0/material=3", "/bodies/0/material: must be a name, not the number 3");
  row("number for a choice", "environment/walls/0/heat=1",
      "/environment/walls/0/heat: must be a name, not the number 1");
  row("unknown choice", "environment/walls/0/heat=warm",
      "/environment/walls/0/heat: must be one of adiabatic, fixed_temperature, fixed_flux, convective, not the text "
      "'warm'");
  row("list for an object", "solver=[]", "/solver: must be an object in { }, not a list");
  row("object for a list", "bodies={}", "/bodies: must be a list, not an object");
  row("null", "duration=null", "/duration: must be a number, not null");
  row("negative density", "materials/0/properties/density_liquid=-5",
      "/materials/0/properties/density_liquid: must be at least ");
  row("negative density in a curve", "materials/0/properties/density_liquid={\"curve\": [[300, -5]]}",
      "/materials/0/properties/density_liquid/curve/0/1: must be at least ");
  row("negative density in a law",
      "materials/0/properties/density_liquid={\"law\": \"linear\", \"coefficients\": [-5, 0, 300]}",
      "/materials/0/properties/density_liquid: density_liquid: its law gives -5 kg/m³ at 20 °C; it must stay between ");
  row("curve without points", "materials/0/properties/density_liquid={\"curve\": []}",
      "/materials/0/properties/density_liquid/curve: must have at least 1 elements, not 0");
  row("curve that turns back", "materials/0/properties/density_liquid={\"curve\": [[300, 999], [280, 1000]]}",
      "/materials/0/properties/density_liquid: ");
  row("unknown way", "materials/0/properties/density_liquid={\"curve\": [[300, 999, {\"to_next\": \"jump\"}]]}",
      "/materials/0/properties/density_liquid/curve/0/2/to_next: must be one of step, linear, smooth, not the text");
  // A cubic that leaves 10 with -100 for its whole length is, at a third of it, 4/27 of that lower.
  row("slopes that lead below 0",
      "materials/0/properties/density_liquid={\"curve\": [[300, 10, {\"slope_after\": -10}], [310, 10]]}",
      "/materials/0/properties/density_liquid: at 30");
  row("curve and law",
      "materials/0/properties/density_liquid={\"curve\": [[300, 1]], \"law\": \"linear\", \"coefficients\": []}",
      "/materials/0/properties/density_liquid: must be either");
  row("coefficients missing", "materials/0/properties/viscosity={\"law\": \"linear\", \"coefficients\": [1]}",
      "/materials/0/properties/viscosity: ");
  row("huge temperature", "bodies/0/temperature=1e308", "/bodies/0/temperature: must be at most 10000 K, not 1e+308");
  row("half a substep", "solver/substeps=2.5", "/solver/substeps: must be a whole number, not the number 2.5");
  row("no such material", "bodies/0/material=lead", "/bodies/0/material: the scene has no material 'lead'");
  row("pin inside out", "bodies/0/pins=[{\"minimum\": [0, 1, 0], \"maximum\": [1, 0, 1]}]",
      "/bodies/0/pins/0/maximum/1: must not be below the minimum, 1 m");
  row("wave along nothing", "bodies/0/velocity_wave={\"axis\": \"w\", \"wavelength\": 1, \"velocity\": [0, 0, 0]}",
      "/bodies/0/velocity_wave/axis: must be one of x, y, z, not the text 'w'");
  row("wave of no length", "bodies/0/velocity_wave={\"axis\": \"x\", \"wavelength\": 0, \"velocity\": [0, 0, 0]}",
      "/bodies/0/velocity_wave/wavelength: must be at least ");
  row("two spins", "bodies/0/spin=[0, 1]", "/bodies/0/spin: must have 3 elements, not 2");
  row("too much disorder", "bodies/0/jitter=0.6", "/bodies/0/jitter: must be at most 0.5, not 0.6");
  row("region inside out", "probes/0/region={\"minimum\": [0, 0, 2], \"maximum\": [1, 1, 1]}",
      "/probes/0/region/maximum/2: must not be below the minimum, 2 m");
  row("wave in a sum",
      "probes/0={\"id\": \"p\", \"quantity\": \"mass\", \"wave\": {\"axis\": \"x\", \"wavelength\": 1}}",
      "/probes/0/wave: needs a quantity that each particle has, as velocity_y; 'mass' is of all of them together");
  row("force on nothing", "probes/0={\"id\": \"p\", \"quantity\": \"force_x\"}",
      "/probes/0/quantity: 'force_x' needs a body or a wall on which it acts");
  row("force on two", "probes/0={\"id\": \"p\", \"quantity\": \"force_x\", \"body\": \"ice\", \"wall\": \"floor\"}",
      "/probes/0/wall: the force on 'ice' is measured; leave one of the two out");
  row("force on a phase",
      "probes/0={\"id\": \"p\", \"quantity\": \"force_x\", \"wall\": \"floor\", \"phase\": \"solid\"}",
      "/probes/0/phase: 'force_x' is of a body or wall as a whole");
  row("mass of a wall", "probes/0={\"id\": \"p\", \"quantity\": \"mass\", \"wall\": \"floor\"}",
      "/probes/0/wall: is for force and torque alone; 'mass' is of matter");
  row("id taken", "environment/walls/1/id=floor", "/environment/walls/1/id: 'floor' is taken already");
  row("id with a slash", "bodies/0/id=a/b", "/bodies/0/id: must be a name of letters");
  row("two coordinates", "bodies/0/shape/box/center=[0, 1]", "/bodies/0/shape/box/center: must have 3 elements, not 2");
  row("unknown shape", "bodies/0/shape={\"mesh\": {}}",
      "/bodies/0/shape: must be an object with \"box\" or an object with");
  row("endless particles", "solver/particle_spacing=0.0005", "/bodies/0/shape/box/size: takes ");
  row("wall without direction", "environment/walls/0/normal=[0, 0, 0]",
      "/environment/walls/0/normal: must have a direction");
  row("inside out", "environment/bounds/maximum=[-9, 1, 1]",
      "/environment/bounds/maximum/0: must be above the minimum");
  row("one axis periodic", "environment/periodic=[true]", "/environment/periodic: must have 3 elements, not 1");
  row("a wall that leans along a periodic axis", "environment/periodic=[true, false, false]",
      "/environment/walls/1/normal/0: must be 0: the scene is periodic along x, and a wall that leans along it");
  const auto curved = [](const char* shape, const char* more) {
    return QStringLiteral(
               "environment={\"periodic\": [false, true, false], \"walls\": [{\"id\": \"round\", \"point\": [0, "
               "0, 0], \"shape\": \"%1\", %2}]}")
        .arg(QLatin1String(shape), QLatin1String(more))
        .toStdString();
  };
  row("a sphere in a periodic scene", curved("sphere", "\"normal\": [0, 1, 0]").c_str(),
      "/environment/walls/0/shape: cannot be sphere: the scene is periodic along y");
  row("a cylinder across a periodic axis", curved("cylinder", "\"normal\": [1, 1, 0]").c_str(),
      "/environment/walls/0/normal: must point along y: the scene is periodic along y");
  row("a shape of no wall", curved("cone", "\"normal\": [0, 1, 0]").c_str(),
      "/environment/walls/0/shape: must be one of plane, cylinder, sphere");
  row("a periodic box too small",
      "environment={\"periodic\": [false, true, false], \"bounds\": {\"minimum\": [0, 0, 0], \"maximum\": [1, 0.1, "
      "1]}}",
      "/environment/bounds/maximum/1: the scene repeats itself along y every 0.1 m; with this reach of its particles "
      "that must be 0.13");
  row("a gradient that leads below 1 K", "bodies/0/temperature_gradient=[0, -1e4, 0]",
      "/bodies/0/temperature_gradient: its temperature gradient would cool it to −");
  row("solidus above liquidus", "materials/0/properties={\"solidus\": 300, \"liquidus\": 280}",
      "/materials/0/properties");
  row("missing required plugin", "pluginsRequired=[\"org.example.gone\"]",
      "/pluginsRequired/0: the plugin 'org.example.gone' is not installed");
  row("constraint for a material", "materials/0/base=bonds",
      "/materials/0/base: 'bonds' is a constraint, not a material");
  row("material for a constraint", "bodies/0/constraints/0/plugin=water",
      "/bodies/0/constraints/0/plugin: 'water' is a material, not a constraint");
  row("thermal model of no plugin's name",
      "solver/thermal/model==", "/solver/thermal/model: must be a name of letters");
  row("material for a thermal model", "solver/thermal/model=water",
      "/solver/thermal/model: 'water' is a material, not a thermal model");
  row("thermal model for a brush",
      "bodies/0/shape={\"voxels\": {\"origin\": [0, 0, 0], \"runs\": [], \"palette\": [{\"material\": \"water\", "
      "\"temperature\": 300}], \"strokes\": [{\"brush\": \"enthalpy\", \"radius\": 1, \"palette\": 0, \"samples\": "
      "[]}]}}",
      "/bodies/0/shape/voxels/strokes/0/brush: 'enthalpy' is a thermal model, not a brush");
  row("two particles in one place",
      "bodies/0/shape={\"voxels\": {\"origin\": [0, 0, 0], \"palette\": [{\"material\": \"water\", \"temperature\": "
      "300}], "
      "\"runs\": [[0, 0, 0, 4, 0], [0, 1, 0, 4, 0], [4, 0, 0, 1, 0], [-2, 0, 0, 3, 0]]}}",
      "/bodies/0/shape/voxels/runs/3: covers the cell 0, 0, 0, which run 0 holds already");
  const auto tracks = [&](const char* name, const char* parameter, const char* keys, const char* problem) {
    const QString edit = QStringLiteral("tracks=[{\"parameter\": \"%1\", \"keys\": %2}]").arg(parameter, keys);
    QTest::newRow(name) << edit << problem;
  };
  tracks("track without a key", "scene/gravity", "[]", "/tracks/0/keys: must have a key at least");
  tracks("track of nothing", "wall/flor/temperature", R"([{"time": 0, "value": 300}])",
         "/tracks/0/parameter: the scene has no parameter 'wall/flor/temperature' (did you mean "
         "'wall/floor/temperature'?)");
  tracks("track of no key of a wall", "wall/floor/temprature", R"([{"time": 0, "value": 300}])",
         "/tracks/0/parameter: the scene has no parameter 'wall/floor/temprature' (did you mean "
         "'wall/floor/temperature'?)");
  tracks("track of what acts at the start", "solver/particle_spacing", R"([{"time": 0, "value": 0.02}])",
         "/tracks/0/parameter: Particle spacing acts at the start; only what acts while the scene runs can have keys");
  tracks("track of a choice", "wall/floor/heat", R"([{"time": 0, "value": 1}])",
         "/tracks/0/parameter: Heat is a choice; only numbers and switches can have keys");
  tracks(
      "track of a curve", "material/water/viscosity", R"([{"time": 0, "value": 1}])",
      "/tracks/0/parameter: Viscosity, liquid is a curve; only a constant, or one of a curve's points, can have keys");
  tracks("track of a point of no curve", "material/water/viscosity[0]", R"([{"time": 0, "value": 1}])",
         "/tracks/0/parameter: Viscosity, liquid is no curve; it has no points");
  tracks("track of half a point", "material/water/viscosity[0.5]", R"([{"time": 0, "value": 1}])",
         "/tracks/0/parameter: the scene has no parameter 'material/water/viscosity[0.5]'");
  tracks("keys out of order", "scene/gravity", R"([{"time": 2, "value": 3}, {"time": 1, "value": 4}])",
         "/tracks/0/keys/1/time: must come after the key before it, at 2 s: keys stand in order of time");
  tracks("two keys at a time", "scene/gravity", R"([{"time": 2, "value": 3}, {"time": 2, "value": 4}])",
         "/tracks/0/keys/1/time: is of the same time as the key before it, 2 s");
  tracks("key before the start", "scene/gravity", R"([{"time": -1, "value": 3}])",
         "/tracks/0/keys/0/time: must be at least 0 s, not −1");
  tracks("key without a value", "scene/gravity", R"([{"time": 1}])", "/tracks/0/keys/0/value: is missing");
  tracks("value out of range", "wall/floor/temperature", R"([{"time": 0, "value": 300}, {"time": 1, "value": 1e5}])",
         "/tracks/0/keys/1/value: must be at most 10000 K, not 100000");
  tracks("half a switch", "wall/floor/no_slip", R"([{"time": 0, "value": 0.5}])",
         "/tracks/0/keys/0/value: must be 0 for off or 1 for on, not 0.5");
  tracks("switch between on and off", "wall/floor/no_slip", R"([{"time": 0, "value": 0}, {"time": 1, "value": 1}])",
         "/tracks/0/keys/0/to_next: must be step: a switch has no values between on and off");
  tracks("half a step", "solver/substeps", R"([{"time": 0, "value": 2.5}])",
         "/tracks/0/keys/0/value: must be a whole number");
  tracks("no such way", "scene/gravity", R"([{"time": 0, "value": 1, "to_next": "bezier"}])",
         "/tracks/0/keys/0/to_next: must be one of step, linear, smooth, not the text 'bezier'");
  // Level but for one end, which leaves or is reached with 1e5 K/s: a third of the way from there, 4/27 of that away.
  tracks("slope that leads too high", "wall/floor/temperature",
         R"([{"time": 0, "value": 300, "to_next": "smooth", "slope_after": 1e5}, {"time": 1, "value": 300}])",
         "/tracks/0/keys/0/slope_after: leads at 0.33333");
  tracks("slope that comes from too low", "wall/floor/temperature",
         R"([{"time": 0, "value": 300, "to_next": "smooth"}, {"time": 1, "value": 300, "slope_before": 1e5}])",
         "/tracks/0/keys/1/slope_before: leads at 0.66666");
  tracks("slope without end", "wall/floor/temperature", R"([{"time": 0, "value": 300, "slope_after": 1e301}])",
         "/tracks/0/keys/0/slope_after: must be at most 1e+300, not 1e+301");
  row("two tracks of one parameter",
      R"(tracks=[{"parameter": "scene/gravity", "keys": [{"time": 0, "value": 1}]},
                 {"parameter": "scene/gravity", "keys": [{"time": 1, "value": 2}]}])",
      "/tracks/1/parameter: 'scene/gravity' has a track already; put all its keys into one");
  row("empty tag", R"(materials/0/tags=["food", ""])", "/materials/0/tags/1: must be a word of 1 to 24 letters");
  row("tag twice", R"(materials/0/tags=["food", "Food"])", "/materials/0/tags/1: stands here twice");
  row("no tag", R"(materials/0/tags=[7])", "/materials/0/tags/0: must be text, not the number 7");
  row("too new", "version=99999", "/version: needs project format 99999, this program reads up to 1");
  row("too new, as a fraction", "version=10.0", "/version: needs project format 10.0, this program reads up to 1");
  row("version in words", "version=\"one\"", "/version: must be a whole number, not the text 'one'");
  row("other format", "format=blender", "/format: must be \"phasesketch\"");
}

void TestProjectIo::wrongValuesNameThePlace() {
  QFETCH(QString, edit);
  QFETCH(QString, problem);
  const QString message = problemOf(m_sample, {textOf(edit)});
  QVERIFY2(message.startsWith("scene.json:" + problem), qPrintable(message));
  QVERIFY(!message.contains('\n'));
}

void TestProjectIo::hostileTextIsRefused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("problem");
  const auto row = [](const char* name, const QByteArray& text, const char* problem) {
    QTest::newRow(name) << text << problem;
  };
  row("empty", "", ":/: the file is empty");
  row("blank", " \n\t", ":/: the file is empty");
  row("truncated", QByteArray::fromStdString(m_sample).left(1000), "the file ends too early");
  row("cut in a word", "{\"format\": \"phas", "the file ends too early");
  row("no project", "[]", ":/: must be an object");
  row("bare", "{\"format\": \"phasesketch\"}", ":/version: is missing");
  row("nested", QByteArray(200000, '['), "brackets are nested deeper than 64 levels");
  row("nested objects", QByteArray("{\"a\":").repeated(200000), "brackets are nested deeper than 64 levels");
  row("twice", "{\"a\": {\"b\": 1, \"b\": 2}}", ":/a/b: the key 'b' stands here twice");
  row("twice, a long one", ("{\"" + QByteArray(5000, 'x') + "\": 1").repeated(2).replace("1{", "1, ") + "}",
      "xxx\u2026' stands here twice");
  row("NaN", "{\"a\": [1, NaN]}", ":/a/1: line 1, column 11: NaN and Infinity are not numbers");
  row("half a character", "{\"a\": \"\\ud800N\"}", "half a character: \\uD800 to \\uDFFF stand in pairs");
  row("minus infinity", "{\"a\": -Infinity}", ":/a: line 1, column");
  row("overflow", "{\"a\": 1e999}", ":/a: the number 1e999 is too large");
  row("overflow of many digits", "{\"a\": " + QByteArray(32000, '7') + "}", "777\u2026 is too large");
  row("UTF-16", QByteArray("\xff\xfe{\0", 4), ":/: is UTF-16 text; save it as UTF-8");
  row("binary",
      QByteArray("\x7f"
                 "ELF\0\0\1",
                 7),
      ":/: is not text");
  row("no UTF-8", "{\"a\": \"\xff\xff\"}", "not UTF-8 text");
  row("no UTF-8 outside of a text", "{\"a\": [1 \xff]}", "not valid JSON");
  row("within a character", "{\"a\": \u00e9}", "not valid JSON");
  row("a long name", "{\"a" + QByteArray("\u00e9").repeated(100) + "\": [1 2]}", "\u00e9\u2026/1: line 1, column");
  row("comma", "{\"a\": 1,\n \"b\": 2,}", ":/b: line 2, column 9: not valid JSON");
  row("no comma", "{\"a\": 1\n \"b\": 2}", ":/a: line 2, column 4: not valid JSON: a comma is missing before it");
  row("no comma in a list", "[1\n {}]", "a comma is missing before it");
  row("two documents", "{} {}", "not valid JSON");
}

void TestProjectIo::hostileTextIsRefused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, problem);
  const QString message = problemOf(text.toStdString());
  QVERIFY2(message.startsWith("scene.json:") && message.contains(problem), qPrintable(message));
  QVERIFY(!message.contains('\n') && message.size() < 400);
}

void TestProjectIo::hostileFilesAreRefused() {
  QTemporaryDir folder;
  const auto problem = [&](const QString& path) {
    try {
      loadProject(textOf(path), *m_plugins);
    } catch (const InputError& error) {
      return QString::fromStdString(error.what());
    }
    return QString();
  };
  QCOMPARE(problem(folder.path()), folder.path() + ": is a folder, not a file");
  QCOMPARE(problem(folder.filePath("none.json")), folder.filePath("none.json") + ": no such file");
  QVERIFY(problem("/dev/zero").contains("is not a regular file"));
  const QString pipe = folder.filePath("pipe");
  QCOMPARE(::mkfifo(qPrintable(pipe), 0600), 0);
  QVERIFY(problem(pipe).contains("is not a regular file"));
  QFile large(folder.filePath("large.json"));
  QVERIFY(large.open(QIODevice::WriteOnly) && large.resize(qint64(kMaximumProjectBytes) + 1));  // sparse: takes no room
  QVERIFY(problem(large.fileName()).contains("is larger than 512 MiB"));
}

void TestProjectIo::missingPluginsAreWarningsUnlessRequired() {
  const LoadedProject loaded = parse(kFull);
  QCOMPARE(loaded.warnings.size(), size_t{2});  // the other is of motionThatComesToNothingIsWarnedOf()
  QCOMPARE(
      QString::fromStdString(loaded.warnings[0].text),
      "scene.json:/materials/1/base: the plugin 'org.example.gone' is not installed; bodies made of it stand still");
  QVERIFY(!loaded.warnings[0].error);
  QVERIFY(problemOf(kFull, {"pluginsRequired=[\"org.example.gone\"]"}).contains("/pluginsRequired/0"));
}

void TestProjectIo::motionThatComesToNothingIsWarnedOf() {
  const auto warnings = [&](const std::vector<std::string>& edits) {
    QStringList texts;
    for (const ProjectMessage& warning : parse(kFull, edits).warnings) texts << QString::fromStdString(warning.text);
    return texts.join('\n');
  };
  QVERIFY(warnings({}).contains("scene.json:/bodies/0/velocity_wave: a fixed body keeps its shape"));
  QVERIFY(warnings({"bodies/0/motion_start=3", "bodies/0/motion_stop=2"})
              .contains("scene.json:/bodies/0/motion_stop: should be above “Sets off at” (3 s), not 2 s"));
  QVERIFY(warnings({"bodies/0/fixed=false", "bodies/0/motion_start=3"})
              .contains("/bodies/0/motion_start: does nothing as the scene is. Acts when “Held in place” is on."));
}

void TestProjectIo::sketchedBodiesAreNotBornBelowOneKelvin() {
  const QString problem = problemOf(kFull, {"bodies/1/temperature_gradient=[1e4, 0, 0]"});
  QVERIFY2(problem.contains("/bodies/1/temperature_gradient: its temperature gradient would cool it to −"),
           qPrintable(problem));
  QCOMPARE(problemOf(kFull, {"bodies/1/temperature_gradient=[100, 0, 0]"}), QString());
}

void TestProjectIo::lawsThatLeaveTheirRangeInTheSceneAreWarnedOf() {
  // 2.2 W/(m K) at 230 K, and below 0 from 120 K down: sound where matter is tried, from 137 K on.
  const std::string law =
      "materials/0/properties/conductivity_solid={\"law\": \"linear\", \"coefficients\": [2.2, 0.02, 230]}";
  const auto warnings = [&](const char* temperature) {
    QStringList texts;
    for (const ProjectMessage& warning : parse(kFull, {law, temperature}).warnings)
      texts << QString::fromStdString(warning.text);
    return texts.join('\n');
  };
  const QString cold = warnings("bodies/0/temperature=100");
  QVERIFY2(cold.contains("/materials/0/properties/conductivity_solid: its law gives −0.4 W/(m·K) at 100 K, which this "
                         "scene has; 0 is used there"),
           qPrintable(cold));
  QVERIFY(!warnings("bodies/0/temperature=250").contains("its law gives"));
}

void TestProjectIo::materialsAreCheckedAtTheScenesParameters() {
  // The fixture's law holds for every density that it declares, but throws beyond 1500 kg/m3.
  QTemporaryDir folder;
  QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_material.so", folder.filePath("material.so")));
  PluginRegistry::Options options;
  options.userDirectory = options.environment = false;
  options.extraPaths = {textOf(folder.path())};
  const PluginRegistry plugins(options);
  QVERIFY(plugins.material("fixture.material"));
  const auto problem = [&](const std::string& edit) {
    try {
      parseProject(m_sample, "scene.json", plugins, {"materials/0/base=fixture.material", edit});
    } catch (const InputError& error) {
      return QString::fromStdString(error.what());
    }
    return QString();
  };
  QCOMPARE(problem("materials/0/parameters={\"density\": 1400}"), QString());
  QCOMPARE(problem("materials/0/parameters={\"density\": 1600}"),
           "scene.json:/materials/0/parameters: The material 'fixture.material' failed: too dense");
}

void TestProjectIo::tracksAreReadAndCheckedAgainstTheScene() {
  const Project project = parse(kFull).project;
  QCOMPARE(project.tracks.size(), size_t{2});
  const std::vector<TrackKey>& keys = project.tracks[0].keys;
  QCOMPARE(keys.size(), size_t{3});
  QVERIFY(keys[0].toNext == ToNext::Smooth && keys[1].toNext == ToNext::Step && keys[2].toNext == ToNext::Linear);
  QCOMPARE(keys[0].slopeAfter, std::optional<double>(12.5));
  QVERIFY(!keys[0].slopeBefore);
  const auto warning = [&](const std::string& tracks) {
    const LoadedProject loaded = parse(m_sample, {"tracks=" + tracks});
    return loaded.warnings.empty() ? QString() : QString::fromStdString(loaded.warnings[0].text);
  };
  QVERIFY(warning(R"([{"parameter": "scene/gravity", "keys": [{"time": 0, "value": 1}]}])").isEmpty());
  const QString loose = warning(R"([{"parameter": "body/ice/velocity_x", "keys": [{"time": 0, "value": 1}]}])");
  QVERIFY2(loose.contains("/tracks/0/parameter: ") && loose.contains("not held in place"), qPrintable(loose));
  // Of a plugin that is not there, as its values are.
  QVERIFY(
      !parse(kFull, {R"(tracks=[{"parameter": "thermal/x", "keys": [{"time": 0, "value": 1}]}])"}).warnings.empty());
}

void TestProjectIo::tracksOfWhatHasGoneAreNotSaved() {
  Project project = parse(kFull).project;
  project.environment.walls.clear();
  const json saved = json::parse(writeProject(project));
  QCOMPARE(saved["tracks"].size(), size_t{1});
  project.tracks.pop_back();
  QVERIFY(!json::parse(writeProject(project)).contains("tracks"));
}

void TestProjectIo::newerFilesOpenOnlyWhenTheySaySo() {
  QVERIFY(problemOf(m_sample, {"version=2"}).contains("/version: needs project format 2"));
  QVERIFY(problemOf(m_sample, {"version=3", "minVersion=2"}).contains("/minVersion: needs project format 2"));
  const LoadedProject loaded = parse(m_sample, {"version=2", "minVersion=1"});
  QCOMPARE(loaded.project.version, 2);
  QCOMPARE(json::parse(writeProject(loaded.project))["minVersion"].get<int>(), 1);
}

void TestProjectIo::editsFindTheirPlace_data() {
  QTest::addColumn<QString>("edit");
  QTest::addColumn<QString>("problem");
  QTest::newRow("number") << "solver/thermal_time_scale=17"
                          << "";
  QTest::newRow("slash in front") << "/solver/thermal_time_scale=17"
                                  << "";
  QTest::newRow("wall by id") << "environment/walls/lid/temperature=280"
                              << "";
  QTest::newRow("new object") << "materials/water/parameters/unheard=1"
                              << "";
  QTest::newRow("no equals") << "solver/substeps"
                             << "--set solver/substeps: must be json/pointer=value";
  QTest::newRow("no such wall") << "environment/walls/attic/temperature=1"
                                << "the project has no 'attic' there";
  QTest::newRow("into a number") << "duration/x=1"
                                 << "the project has no 'x' there";
  QTest::newRow("too deep") << QStringLiteral("/x").repeated(60000) + "=1"
                            << "is nested deeper than 64 levels";
  QTest::newRow("too deep with its value")
      << QStringLiteral("/x").repeated(40) + "=" + QStringLiteral("[").repeated(40) + QStringLiteral("]").repeated(40)
      << "is nested deeper than 64 levels";
  QTest::newRow("broken JSON") << "solver={\"a\""
                               << "--set solver:/";
  QTest::newRow("cut in a character") << "duration/" + QStringLiteral("\u00e9").repeated(150) + "=1"
                                      << "\u2026: the project has no";
}

void TestProjectIo::editsFindTheirPlace() {
  QFETCH(QString, edit);
  QFETCH(QString, problem);
  const QString message = problemOf(m_sample, {textOf(edit)});
  QVERIFY2(problem.isEmpty() ? message.isEmpty() : message.contains(problem), qPrintable(message));
  if (edit.contains("thermal_time_scale")) {
    const Project project = parse(m_sample, {textOf(edit)}).project;
    QCOMPARE(numberOf(project.solver.parameters, solverParameters(), "thermal_time_scale"), 17.0);
  }
}

/// What a terminal of another encoding hands over.
void TestProjectIo::editsAreUtf8() {
  for (const char* edit : {"title=\xe9t\xe9", "\xe9=1", "\xe9"})
    QCOMPARE(problemOf(m_sample, {edit}),
             "--set " + QString::fromLatin1(edit).replace(QChar(0xe9), QChar(0xfffd)) + ": must be UTF-8 text");
}

void TestProjectIo::publishedSchemaIsCurrent() {
  const std::string published = readFile(PS_SOURCE_DIR "/resources/schema/project.schema.json", kMaximumProjectBytes);
  QVERIFY2(published == writeJson(projectSchema()),
           "run: phasesketch-cli schema > resources/schema/project.schema.json");
}

void TestProjectIo::schemaNamesEveryDeclaredKey() {
  const json& schema = projectSchema();
  const auto expect = [](const json& properties, api::ParameterList list) {
    for (size_t i = 0; i < list.count; ++i) QVERIFY2(properties.contains(list[i].key), list[i].key);
  };
  const json& properties = schema.at("properties");
  expect(properties["environment"]["properties"], environmentParameters());
  expect(properties["environment"]["properties"]["walls"]["items"]["properties"], wallParameters());
  expect(properties["emitters"]["items"]["properties"], emitterParameters());
  expect(properties["sinks"]["items"]["properties"], sinkParameters());
  expect(properties["solver"]["properties"], solverParameters());
  expect(schema["$defs"]["body"]["properties"], bodyParameters());
  expect(schema["$defs"]["material"]["properties"]["properties"]["properties"], propertyCatalogue());
}

void TestProjectIo::plainKeysAreNoParameters() {
  // Declared parameters stand beside an owner's plain keys, so they must not share a name.
  json keys = {{"friction", 1}};
  QVERIFY_THROWS_EXCEPTION(Error, addParameterSchemas(keys, wallParameters()));
}

void TestProjectIo::savingKeepsPermissionsAndLinks() {
  QTemporaryDir folder;
  const QString file = folder.filePath("real.json"), link = folder.filePath("link.json");
  const Project project = parse(m_sample).project;
  saveProject(project, textOf(file));
  QVERIFY(QFile::setPermissions(file, QFileDevice::ReadOwner | QFileDevice::WriteOwner | QFileDevice::ReadGroup));
  QVERIFY(QFile::link("real.json", link));
  struct stat before {
  }, after{};
  QCOMPARE(::stat(qPrintable(file), &before), 0);
  saveProject(project, textOf(link));
  QCOMPARE(::stat(qPrintable(file), &after), 0);
  QCOMPARE(after.st_mode, before.st_mode);
  QVERIFY(before.st_ino != after.st_ino);  // replaced as a whole, not written over
  QCOMPARE(::lstat(qPrintable(link), &after), 0);
  QVERIFY(S_ISLNK(after.st_mode));
  QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 2);  // no temporary file is left
  QCOMPARE(readFile(textOf(file), kMaximumProjectBytes), writeProject(project));
}

void TestProjectIo::pipesAndDevicesAreWrittenNotReplaced() {
  QTemporaryDir folder;
  const QString pipe = folder.filePath("pipe");
  QCOMPARE(::mkfifo(qPrintable(pipe), 0600), 0);
  QFile reader(pipe);
  const int fd = ::open(qPrintable(pipe), O_RDWR | O_CLOEXEC);  // both ends: nobody has to wait for the other
  QVERIFY(fd >= 0 && reader.open(fd, QIODevice::ReadOnly | QIODevice::Unbuffered, QFile::AutoCloseHandle));
  requireWritable(textOf(pipe));
  writeFileAtomically(textOf(pipe), "through");
  QCOMPARE(reader.read(7), QByteArray("through"));
  struct stat info {};
  QCOMPARE(::lstat(qPrintable(pipe), &info), 0);
  QVERIFY(S_ISFIFO(info.st_mode));
  QCOMPARE(QDir(folder.path()).entryList(QDir::Files | QDir::System).size(), 1);
  writeFileAtomically("/dev/null", "away");
  QCOMPARE(::lstat("/dev/null", &info), 0);
  QVERIFY(S_ISCHR(info.st_mode));
  QVERIFY_THROWS_EXCEPTION(Error, writeFileAtomically("/dev/full", "too much"));
}

void TestProjectIo::placesThatCannotBeWrittenAreKnownBefore() {
  QTemporaryDir folder;
  const std::string file = textOf(folder.filePath("report.json"));
  requireWritable(file);
  QVERIFY(QDir(folder.path()).isEmpty());  // nothing is left behind
  writeFileAtomically(file, "old");
  requireWritable(file);
  QCOMPARE(readFile(file, 100), std::string("old"));
  QVERIFY_THROWS_EXCEPTION(Error, requireWritable(textOf(folder.path())));
  QVERIFY_THROWS_EXCEPTION(Error, requireWritable(textOf(folder.filePath("none/report.json"))));
}

void TestProjectIo::failedSaveKeepsTheOldFile() {
  QTemporaryDir folder;
  const QString file = folder.filePath("scene.json");
  Project project = parse(m_sample).project;
  saveProject(project, textOf(file));
  const std::string before = readFile(textOf(file), kMaximumProjectBytes);
  QVERIFY_THROWS_EXCEPTION(Error, saveProject(project, textOf(folder.filePath("none/scene.json"))));
  QVERIFY_THROWS_EXCEPTION(Error, saveProject(project, textOf(folder.path())));
  project.bodies[0].velocity[1] = std::numeric_limits<double>::quiet_NaN();
  QVERIFY_THROWS_EXCEPTION(Error, saveProject(project, textOf(file)));
  project.bodies[0].velocity[1] = 0;
  // A limit on file sizes stands for a full disk: writing stops in the middle.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  QCOMPARE(::getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit tight{100, old.rlim_max};
  QCOMPARE(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  bool threw = false;
  try {
    saveProject(project, textOf(file));
  } catch (const Error&) {
    threw = true;
  }
  ::setrlimit(RLIMIT_FSIZE, &old);
  QVERIFY(threw);
  QCOMPARE(readFile(textOf(file), kMaximumProjectBytes), before);
  QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 1);
}

void TestProjectIo::aFileThatNamesNoThermalModelMeansTheStandardOne() {
  json document = json::parse(kFull);
  document["solver"].erase("thermal");
  QCOMPARE(parse(document.dump()).project.solver.thermalModel, m_plugins->standard(PluginKind::Thermal));
  document.erase("solver");
  QCOMPARE(parse(document.dump()).project.solver.thermalModel, m_plugins->standard(PluginKind::Thermal));
  document["solver"]["thermal"]["model"] = "";
  QCOMPARE(parse(document.dump()).project.solver.thermalModel, std::string());
}

void TestProjectIo::numbersAreShortest() {
  Project project = parse(m_sample).project;
  project.bodies[0].velocity = {0.1, -1e-7, 1.0 / 3};
  const std::string text = writeProject(project);
  QVERIFY(text.find("\"velocity\": [0.1, -1e-07, 0.3333333333333333]") != std::string::npos);
  QCOMPARE(parse(text).project.bodies[0].velocity[2], 1.0 / 3);
}

QTEST_APPLESS_MAIN(TestProjectIo)
#include "tst_projectio.moc"
