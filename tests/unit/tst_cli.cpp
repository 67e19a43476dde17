// SPDX-License-Identifier: Apache-2.0
#include "core/base/jsontext.h"
#include "tests/unit/clirun.h"

#include <QDir>
#include <QFile>
#include <QImage>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <map>
#include <set>

// Drives the built program, as a shell would.
class TestCli : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void exitCodesAndOneLine_data();
  void exitCodesAndOneLine();
  void sketchesAreDrawnAgain();
  void tablesKeepTheirColumns();
  void simulateWritesTheReportsKeys();
  void reportsHoldWarningsAndWhoseLimitsTheyAre();
  void aRunOfOneFrameSaysNothingOfRest();
  void whatWasPouredIsSummedUp();
  void probesHaveOneRowPerFrame();
  void sameProjectGivesTheSameHash();
  void simulateGoesByTracks();
  void runsGoOnFromAState();
  void statesThatDoNotFitAreTold();
  void pluginsAreListed();
  void schemaIsPrinted();
  void benchWritesItsKeys();
  void recordingsAreDrawn();
  void fieldsOfPlugins();
  void filmsEndWhereTheRunBreaks();
  void reportsThatCannotBeWrittenStopTheRunBefore();
};

namespace {

nlohmann::json jsonFile(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  return nlohmann::json::parse(file.readAll().toStdString(), nullptr, false);
}

std::set<std::string> keysOf(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

using Keys = std::set<std::string>;

}  // namespace

void TestCli::exitCodesAndOneLine_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<int>("code");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const QStringList& arguments, int code, const char* says) {
    QTest::newRow(name) << arguments << code << says;
  };
  row("help", {"--help"}, 0, "");
  row("simulate help", {"simulate", "--help"}, 0, "");
  row("no command", {}, 2,
      "which command? simulate, render, export, bench, validate, cases, fit, import, mix, redraw, share, soak, "
      "plugins, "
      "schema;");
  row("unknown command", {"simmulate"}, 2, "unknown command 'simmulate'");
  row("unknown option", {"simulate", kSample, "--fast"}, 2, "unknown option --fast");
  row("missing value", {"simulate", kSample, "--seconds"}, 2, "--seconds needs a value");
  row("no number", {"simulate", kSample, "--seconds", "soon"}, 2, "--seconds must be a number");
  row("negative", {"simulate", kSample, "--frames", "-3"}, 2, "--frames must be a whole number");
  row("both lengths", {"simulate", kSample, "--frames", "1", "--seconds", "1"}, 2, "not both");
  row("unknown isa", {"simulate", kSample, "--isa", "MMX"}, 2, "MMX");
  row("no project", {"simulate"}, 2, "which project?");
  row("missing file", {"simulate", "nowhere.json"}, 2, "nowhere.json: no such file");
  row("folder", {"validate", "/"}, 2, "/: is a folder");
  row("bad edit", {"simulate", kSample, "--set", "solver/substeps=none"}, 2, "/solver/substeps: must be");
  row("bad track",
      {"simulate", kSample, "--frames", "1", "--set",
       R"(tracks=[{"parameter": "wall/flor/temperature", "keys": [{"time": 0, "value": 300}]}])"},
      2, "/tracks/0/parameter: the scene has no parameter 'wall/flor/temperature' (did you mean");
  row("bad key",
      {"simulate", kSample, "--set", R"(tracks=[{"parameter": "scene/gravity", "keys": [{"time": 0, "value": -1}]}])"},
      2, "/tracks/0/keys/0/value: must be at least 0 m/s²");
  row("sample is fine", {"validate", kSample}, 0, "");
  row("one of two", {"validate", kSample, "nowhere.json"}, 2, "nowhere.json: no such file");
  row("redraw where", {"redraw", kSample}, 2, "which project? give --out");
  row("redraw onto itself", {"redraw", kSample, "--out", kSample}, 2, "is the file that is read as well");
  row("no way to write", {"simulate", kSample, "--frames", "0", "--report", "/nowhere/r.json"}, 1, "not saved");
  row("render where", {"render", kSample}, 2, "--out is missing");
  row("render size", {"render", kSample, "--out", "x", "--size", "big"}, 2, "--size must be");
  row("unknown scene", {"bench", "no-such-scene"}, 2, "no-such-scene: neither a file");
  row("bad threads", {"bench", "tank", "--threads", "1,two"}, 2, "--threads must be whole numbers");
  row("nothing to compare", {"bench", "tank", "--compare", kSample}, 2, "is no file that bench wrote");
  row("no table of cases", {"cases", kSample}, 2, "ice-on-hot-plate.json: has no cases");
  row("nothing to allow", {"plugins", "--allow", "no-such-plugin"}, 2, "no plugin 'no-such-plugin'");
}

/// As they were, with half the spacing with about eight times the cells; a stroke leaves free what others hold and what
/// lies outside.
void TestCli::sketchesAreDrawnAgain() {
  const QTemporaryDir folder;
  const QString sketched = PS_SOURCE_DIR "/projects/sketched/leaking-container.json", out = folder.filePath("out.json");
  const auto cellsOf = [](const nlohmann::json& project, const char* body) {
    int cells = 0;
    for (const nlohmann::json& b : project.value("bodies", nlohmann::json::array())) {
      if (b.value("id", "") != body) continue;
      for (const nlohmann::json& run : b["shape"]["voxels"]["runs"]) cells += run[3].get<int>();
    }
    return cells;
  };
  Ran ran = cli({"redraw", sketched, "--out", out});
  QVERIFY2(ran.code == 0, ran.err.constData());
  nlohmann::json before = jsonFile(sketched), project = jsonFile(out);
  QVERIFY(project["bodies"] == before["bodies"]);
  ran = cli({"redraw", sketched, "--out", out, "--spacing", "0.01"});
  QVERIFY2(ran.code == 0, ran.err.constData());
  const double finer = cellsOf(jsonFile(out), "stand"), coarse = cellsOf(before, "stand");
  QVERIFY2(finer > 6 * coarse && finer < 10 * coarse, qPrintable(QString("%1 of %2").arg(finer).arg(coarse)));
  // A block in the middle of the water, which no stroke made, and a lid of the scene at half its height.
  nlohmann::json block = {{"id", "block"}, {"name", "Block"}, {"material", before["bodies"][0]["material"]}};
  block["shape"] = {{"box", {{"center", {0.0, 0.4, 0.0}}, {"size", {0.08, 0.08, 0.08}}}}};
  block["temperature"] = 293.15;
  project = before;
  project["bodies"].insert(project["bodies"].begin(), block);
  project["environment"]["bounds"]["maximum"][1] = 0.5;
  const QString changed = folder.filePath("changed.json");
  QFile file(changed);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(project.dump()));
  file.close();
  ran = cli({"redraw", changed, "--out", out});
  QVERIFY2(ran.code == 0, ran.err.constData());
  const nlohmann::json again = jsonFile(out);
  const int water = cellsOf(before, "water"), left = cellsOf(again, "water"), layers = 16, lost = 6;
  QCOMPARE(left, water * (layers - lost) / layers - 4 * 4 * 4);
}

void TestCli::exitCodesAndOneLine() {
  QFETCH(QStringList, arguments);
  QFETCH(int, code);
  QFETCH(QString, says);
  const Ran ran = cli(arguments);
  QCOMPARE(ran.code, code);
  if (code == 0) {
    QVERIFY2(ran.err.isEmpty(), ran.err.constData());
    QVERIFY(!ran.out.isEmpty());
  } else {
    QVERIFY2(QString::fromUtf8(ran.err).contains(says), ran.err.constData());
    QCOMPARE(ran.err.count('\n'), 1);
  }
}

/// Scripts read these tables.
void TestCli::tablesKeepTheirColumns() {
  const QString table = PS_SOURCE_DIR "/tests/cases/cases.json";
  const Ran cases = cli({"cases", table, "--only", "i2_sublimation_water"});
  QVERIFY2(cases.code == 0, cases.err.constData());
  const QList<QByteArray> rows = cases.out.split('\n');
  QCOMPARE(rows[0],
           QByteArray("case                          what                                          expected    "
                      " got          tolerance         ok"));
  QVERIFY2(rows[1].startsWith("i2_sublimation_water          sublimation point at 600 Pa, K                "),
           rows[1].constData());
  QVERIFY2(rows[1].endsWith("  yes"), rows[1].constData());
  const Ran soaked = cli({"soak", kSample, "--seconds", "0.05", "--only", "solver/substeps", "--threads", "1"});
  QVERIFY2(soaked.code == 0, soaked.err.constData());
  const QString line = QStringLiteral(R"(ice-on-hot-plate      %1 +[0-9.e+-]+ m/s +[0-9.]+ ms  fine)");
  const QStringList runs = QString::fromUtf8(soaked.out).split('\n', Qt::SkipEmptyParts);
  QCOMPARE(runs.size(), 3);
  const QStringList changes{"as it is", "solver/substeps = 1", "solver/substeps = 16"};
  for (int i = 0; i < 3; ++i) {
    QVERIFY2(QRegularExpression(QRegularExpression::anchoredPattern(line.arg(changes[i]))).match(runs[i]).hasMatch(),
             qPrintable(runs[i]));
    QCOMPARE(runs[i].indexOf(QStringLiteral(" m/s")), 84);
  }
}

void TestCli::simulateWritesTheReportsKeys() {
  QTemporaryDir folder;
  const Ran ran = cli(smallScene({"--frames", "30", "--report", folder.filePath("r.json")}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  const nlohmann::json r = jsonFile(folder.filePath("r.json"));
  QCOMPARE(keysOf(r), (Keys{"program",    "project",    "warnings",    "particles", "frames",       "substeps",
                            "iterations", "dt",         "simulated_s", "wall_s",    "threads",      "backend",
                            "isa",        "state_hash", "flags",       "limits",    "ms_per_frame", "density_error",
                            "energy",     "flow",       "momentum",    "phases",    "rest",         "temperature"}));
  QVERIFY(r["warnings"].empty());
  QCOMPARE(keysOf(r["ms_per_frame"]),
           (Keys{"total", "neighbours", "density", "structure", "contact", "viscosity", "heat", "phase"}));
  for (const auto& stage : r["ms_per_frame"]) QCOMPARE(keysOf(stage), (Keys{"mean", "median", "p95"}));
  QCOMPARE(keysOf(r["density_error"]), (Keys{"mean", "max"}));
  QCOMPARE(keysOf(r["energy"]), (Keys{"start", "end", "walls", "air", "radiation", "heaters", "sources", "air_warming",
                                      "exchanged", "drift", "elastic", "mechanical"}));
  const nlohmann::json& mechanical = r["energy"]["mechanical"];
  QCOMPARE(keysOf(mechanical), (Keys{"start", "end", "kinetic", "weight", "given"}));
  QCOMPARE(keysOf(mechanical["given"]), (Keys{"between_frames", "surroundings", "structure", "pressure", "contact",
                                              "viscosity", "impact", "scheme"}));
  double given = 0;
  for (const auto& part : mechanical["given"]) given += part.get<double>();
  const double start = mechanical["start"], end = mechanical["end"];
  QVERIFY(end != start);
  QVERIFY(std::abs(given - (end - start)) < 1e-9 * std::abs(start));
  QCOMPARE(keysOf(r["momentum"]), (Keys{"start", "end", "external", "angular"}));
  QCOMPARE(keysOf(r["momentum"]["angular"]), (Keys{"start", "end", "external"}));
  QCOMPARE(keysOf(r["rest"]), (Keys{"from_s", "kinetic_energy", "speed_rms", "moved"}));
  QVERIFY(std::abs(r["rest"]["from_s"].get<double>() - 0.25) < 1e-9);
  QVERIFY(r["rest"]["moved"]["solid_particle"].get<double>() > 0);  // it still falls, or slides where it landed
  QCOMPARE(keysOf(r["phases"]), (Keys{"solid", "melting", "liquid", "boiling", "gas"}));
  QCOMPARE(keysOf(r["temperature"]), (Keys{"min", "mean", "max"}));
  QCOMPARE(r["frames"].get<int>(), 30);
  QCOMPARE(r["particles"].get<int>(), 125);
  QVERIFY(r["backend"] == "cpu");
  QVERIFY(r["flags"].is_array() && r["flags"].empty());
  size_t count = 0;
  for (const auto& phase : r["phases"]) count += phase["count"].get<size_t>();
  QCOMPARE(count, size_t{125});
  QVERIFY(std::abs(r["simulated_s"].get<double>() - 0.5) < 1e-9);  // 30 frames of 1/60 s, rounding of the sum
}

void TestCli::reportsHoldWarningsAndWhoseLimitsTheyAre() {
  QTemporaryDir folder;
  nlohmann::json project = jsonFile(kSample);
  project["enviro"] = 1;
  project["title"] = "Slip";
  project["bodies"][0]["shape"]["box"]["size"] = {0.1, 0.1, 0.1};
  project["bodies"][0]["constraints"] = {{{"plugin", "cloth"}, {"parameters", {{"stretch_stiffness", 1e9}}}}};
  const QString path = folder.filePath("slip.json");
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(project.dump()));
  file.close();
  const Ran valid = cli({"validate", path});
  QCOMPARE(valid.code, 0);
  QVERIFY2(valid.out.contains("can be opened, with 1 warning"), valid.out.constData());
  const Ran ran =
      cli({"simulate", path, "--frames", "1", "--threads", "1", "--quiet", "--report", folder.filePath("r.json")});
  QVERIFY2(ran.code == 0, ran.err.constData());
  const nlohmann::json r = jsonFile(folder.filePath("r.json"));
  QCOMPARE(r["project"]["title"].get<std::string>(), std::string("Slip"));
  QCOMPARE(r["project"]["file"].get<std::string>(), path.toStdString());
  QCOMPARE(r["warnings"].size(), size_t{1});
  QVERIFY(r["warnings"][0].get<std::string>().find("/enviro: is not known here") != std::string::npos);
  QCOMPARE(r["limits"][0]["what"].get<std::string>(), std::string("cloth.stretch_stiffness"));
  QVERIFY(r["limits"][0]["body"] == project["bodies"][0]["id"]);
}

void TestCli::aRunOfOneFrameSaysNothingOfRest() {
  QTemporaryDir folder;
  const Ran ran = cli(smallScene({"--frames", "1", "--report", folder.filePath("r.json")}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  const nlohmann::json r = jsonFile(folder.filePath("r.json"));
  QVERIFY(r.contains("rest") && r["rest"].is_null());
}

void TestCli::whatWasPouredIsSummedUp() {
  const QString tap =
      "emitters=[{\"id\": \"tap\", \"material\": \"water\", \"point\": [0.15, 0.3, 0.15], \"direction\": "
      "[0, -1, 0], \"diameter\": 0.04, \"speed\": 1}]";
  const Ran ran = cli(smallScene({"--frames", "20", "--set", tap}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  const QRegularExpression line("^poured by emitters: [0-9.]+ kg, [0-9]+ particles$",
                                QRegularExpression::MultilineOption);
  QVERIFY2(line.match(ran.out).hasMatch() && !ran.out.contains("drained"), ran.out.constData());
  QVERIFY(!cli(smallScene({"--frames", "1"})).out.contains("poured"));
}

void TestCli::probesHaveOneRowPerFrame() {
  QTemporaryDir folder;
  const Ran ran = cli(smallScene({"--seconds", "0.2", "--probes", folder.filePath("p.csv"), "--quiet"}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  QVERIFY(ran.out.isEmpty());
  QFile file(folder.filePath("p.csv"));
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QList<QByteArray> lines = file.readAll().trimmed().split('\n');
  QCOMPARE(lines.size(), 14);  // a header, the start and 12 frames
  QVERIFY2(lines[1].startsWith("0,0,"), lines[1].constData());
  QVERIFY2(lines[0].startsWith("time_s,thermal_time_s,"), lines[0].constData());
  QVERIFY2(lines[0].endsWith(
               ",solid.mass[kg],melting.mass[kg],liquid.mass[kg],boiling.mass[kg],gas.mass[kg],all.temperature[K]"),
           lines[0].constData());
  QVERIFY2(lines[0].contains(",heat.energy[J],heat.walls[J],"), lines[0].constData());
  for (const QByteArray& line : lines) QCOMPARE(line.count(','), lines[0].count(','));
}

void TestCli::sameProjectGivesTheSameHash() {
  QTemporaryDir folder;
  QStringList hashes;
  for (const QString& threads : {QString("1"), QString("2")}) {
    const QString report = folder.filePath(threads + ".json");
    const Ran ran = cli({"simulate", kSample, "--frames", "3", "--threads", threads, "--report", report, "--quiet"});
    QVERIFY2(ran.code == 0, ran.err.constData());
    hashes << QString::fromStdString(jsonFile(report).value("state_hash", std::string()));
  }
  QCOMPARE(hashes[0].size(), 16);
  QCOMPARE(hashes[0], hashes[1]);
}

void TestCli::simulateGoesByTracks() {
  QTemporaryDir folder;
  const QString report = folder.filePath("r.json");
  const auto hash = [&](const QStringList& edits) {
    if (cli(smallScene(QStringList{"--frames", "12", "--report", report, "--quiet"} + edits)).code != 0)
      return QString();
    return QString::fromStdString(jsonFile(report).value("state_hash", std::string()));
  };
  const QString tracks = R"(tracks=[{"parameter": "scene/gravity", "keys": [{"time": 0.1, "value": %1}]}])";
  const QString plain = hash({});
  QCOMPARE(hash({"--set", tracks.arg(9.81)}), plain);
  QVERIFY(hash({"--set", tracks.arg(3)}) != plain);
}

/// By a file of its own and by the project, in a new process: to the hash of the run that was not interrupted.
void TestCli::runsGoOnFromAState() {
  QTemporaryDir folder;
  const QString state = folder.filePath("a.state"), kept = folder.filePath("kept.json"), r = folder.filePath("r.json");
  QVERIFY(cli(smallScene({"--frames", "12", "--report", r, "--quiet"})).code == 0);
  const std::string whole = jsonFile(r).value("state_hash", std::string());
  Ran ran = cli(smallScene({"--frames", "7", "--save-state", state, "--save-project", kept, "--quiet"}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  ran = cli(smallScene({"--frames", "5", "--from", state, "--report", r, "--quiet"}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  QCOMPARE(jsonFile(r).value("state_hash", std::string()), whole);

  ran = cli({"simulate", kept, "--frames", "5", "--threads", "2", "--report", r});
  QVERIFY2(ran.code == 0 && ran.err.isEmpty(), ran.err.constData());
  QVERIFY2(ran.out.startsWith("begun at 0.116667 s, from the state of frame 7\n5 frames, "), ran.out.constData());
  nlohmann::json report = jsonFile(r);
  QCOMPARE(report.value("state_hash", std::string()), whole);
  QCOMPARE(report["project"]["begun"]["frame"].get<int>(), 7);
  QVERIFY(std::abs(report["simulated_s"].get<double>() - 5 / 60.0) < 1e-9);
  // Without a number of frames it goes on to the end of the scene.
  QVERIFY(cli({"simulate", kept, "--set", "duration=0.2", "--report", r, "--quiet"}).code == 0);
  QCOMPARE(jsonFile(r).value("state_hash", std::string()), whole);
  QVERIFY(cli({"simulate", kept, "--at-start", "--frames", "12", "--report", r, "--quiet"}).code == 0);
  report = jsonFile(r);
  QCOMPARE(report.value("state_hash", std::string()), whole);
  QCOMPARE(report["project"]["begun"]["frame"].get<int>(), 0);

  QCOMPARE(cli({"validate", kept}).out, (kept + ": fine\n").toUtf8());
  ran = cli({"render", kept, "--frames", "2", "--every", "2", "--out", folder.filePath("p"), "--size", "64x48"});
  QVERIFY2(ran.code == 0, ran.err.constData());
  QCOMPARE(QDir(folder.filePath("p")).entryList(QDir::Files, QDir::Name),
           (QStringList{"frame-000007.png", "frame-000009.png"}));
  // One file holds the end.
  const QString end = folder.filePath("end.jpg");
  ran = cli({"render", kept, "--frames", "2", "--out", end, "--size", "64x48"});
  QVERIFY2(ran.code == 0 && ran.out.contains("1 picture in"), ran.err.constData());
  QFile picture(end);
  QVERIFY(picture.open(QIODevice::ReadOnly));
  QCOMPARE(picture.read(3), QByteArray("\xff\xd8\xff"));
}

void TestCli::statesThatDoNotFitAreTold() {
  QTemporaryDir folder;
  const QString kept = folder.filePath("kept.json"), r = folder.filePath("r.json"), odd = folder.filePath("odd.json");
  QVERIFY(cli(smallScene({"--frames", "2", "--save-project", kept, "--quiet"})).code == 0);
  Ran ran =
      cli({"simulate", kept, "--frames", "1", "--set", "bodies/ice/shape/box/size=[0.14, 0.1, 0.1]", "--report", r});
  QCOMPARE(ran.code, 0);
  const QString says =
      "/state: the state is of another scene: the body 'Ice block' has another shape by now; the scene opens at its "
      "start";
  QCOMPARE(QString::fromUtf8(ran.err), "warning: " + kept + ":" + says + "\n");
  QCOMPARE(jsonFile(r)["warnings"][0].get<std::string>(), (kept + ":" + says).toStdString());
  QCOMPARE(jsonFile(r)["frames"].get<int>(), 1);

  const auto validated = [&](const auto& spoil) {
    nlohmann::json project = jsonFile(kept);
    spoil(project["state"]);
    QFile file(odd);
    if (file.open(QIODevice::WriteOnly)) file.write(QByteArray::fromStdString(project.dump()));
    file.close();
    return cli({"validate", odd});
  };
  ran = validated([](nlohmann::json& state) { state["bodies"][0]["id"] = "snow"; });
  QCOMPARE(ran.code, 0);
  QVERIFY2(ran.err.contains("/state: the state is of another scene: the body 'Ice block' came later"),
           ran.err.constData());
  ran = validated([](nlohmann::json& state) { state["blocks"][0]["data"] = "AAAA"; });
  QCOMPARE(ran.code, 2);
  QVERIFY2(ran.err.startsWith((odd + ":/state/blocks/0/data: the block 'clock/frames' is no zstd frame").toUtf8()),
           ran.err.constData());
}

void TestCli::pluginsAreListed() {
  const Ran ran = cli({"plugins", "--json"});
  QCOMPARE(ran.code, 0);
  const auto list = nlohmann::json::parse(ran.out.toStdString(), nullptr, false);
  QVERIFY(!list.is_discarded());
  bool water = false;
  for (const auto& plugin : list["plugins"]) {
    water = water || (plugin["id"] == "water" && plugin["state"] == "loaded" && plugin["kind"] == "material");
  }
  QVERIFY(water);
  const std::map<std::string, std::string> capable = {
      {"thesis_latent", R"(["opens_energy"])"}, {"thesis_diffusion", R"(["pair_rates"])"},
      {"heat", R"(["touches_matter"])"},        {"cool", R"(["touches_matter"])"},
      {"grab", R"(["touches_matter"])"},        {"push", R"(["touches_matter"])"},
      {"stir", R"(["touches_matter"])"},        {"cut", R"(["touches_matter"])"},
      {"weld", R"(["touches_matter"])"},        {"paint", R"(["paints_matter"])"},
      {"smooth", R"(["smooths_matter"])"},      {"fill", R"(["fills_hollows"])"},
      {"stamp", R"(["stamps_shape"])"},         {"tint", R"(["colours_matter"])"}};
  for (const auto& plugin : list["plugins"]) {
    const auto found = capable.find(plugin["id"].get<std::string>());
    QCOMPARE(plugin["capabilities"].dump(), found == capable.end() ? "[]" : found->second);
  }
  QVERIFY(list["properties"].size() > 20);
  QVERIFY(QString(cli({"plugins"}).out).contains("water"));
}

void TestCli::schemaIsPrinted() {
  const Ran ran = cli({"schema"});
  QCOMPARE(ran.code, 0);
  QCOMPARE(nlohmann::json::parse(ran.out.toStdString(), nullptr, false).value("title", ""),
           std::string("PhaseSketch project"));
}

void TestCli::benchWritesItsKeys() {
  QTemporaryDir folder;
  const QStringList measured{"bench", "tank",      "--particles", "500",    "--frames",
                             "5",     "--threads", "1,2",         "--json", folder.filePath("b.json")};
  Ran ran = cli(measured);
  QVERIFY2(ran.code == 0, ran.err.constData());
  const nlohmann::json b = jsonFile(folder.filePath("b.json"));
  QCOMPARE(keysOf(b), (Keys{"machine", "calibration", "scenes"}));
  QCOMPARE(keysOf(b["calibration"]), (Keys{"triad_GB_per_s", "density_ns_per_pair"}));
  QVERIFY(b["calibration"]["triad_GB_per_s"].get<double>() > 0);
  QCOMPARE(b["scenes"].size(), size_t{2});
  QCOMPARE(b["scenes"][1]["threads"].get<int>(), 2);
  const nlohmann::json& scene = b["scenes"][0];
  QCOMPARE(keysOf(scene), (Keys{"name", "particles", "threads", "iterations", "ms", "stages",
                                "ns_per_particle_iteration", "serial_share", "ns_per_pair", "bytes_per_particle",
                                "memory_per_particle", "density_error", "state"}));
  QCOMPARE(keysOf(scene["state"]),
           (Keys{"bytes_per_particle", "save_ms", "restore_ms", "rollback_ms", "rollback_share"}));
  QCOMPARE(keysOf(scene["ms"]), (Keys{"median", "p95"}));
  QCOMPARE(keysOf(scene["stages"]["density"]), (Keys{"median", "p95", "ns_per_particle_iteration", "serial_share"}));
  for (const nlohmann::json& share : {scene["serial_share"], scene["stages"]["density"]["serial_share"]})
    QVERIFY2(share.get<double>() > 0 && share.get<double>() < 1, share.dump().c_str());
  ran =
      cli(measured.mid(0, 8) + QStringList{"--compare", folder.filePath("b.json"), "--json", folder.filePath("c.json"),
                                           "--table", folder.filePath("t.csv"), "--plot", folder.filePath("p.svg")});
  QVERIFY2(ran.code == 0, ran.err.constData());
  QCOMPARE(ran.out.count(" of before:"), 2);
  QCOMPARE(jsonFile(folder.filePath("c.json"))["compared"].size(), size_t{2});
  QVERIFY(QFileInfo(folder.filePath("t.csv")).size() > 0 && QFileInfo(folder.filePath("p.svg")).size() > 0);
  // Of few samples too, between which nothing has fallen far.
  ran = cli({"bench", "sketch", "--particles", "4000", "--frames", "8", "--json", folder.filePath("s.json")});
  QVERIFY2(ran.code == 0, ran.err.constData());
  const nlohmann::json sketch = jsonFile(folder.filePath("s.json"))["scenes"][0];
  QCOMPARE(keysOf(sketch), (Keys{"name", "particles", "threads", "ms", "edits"}));
  QCOMPARE(keysOf(sketch["edits"]), (Keys{"draws liquid", "draws ice", "draws on a body that has moved", "cuts",
                                          "welds", "erases", "paints", "tints", "heats", "pushes", "holds"}));
  for (const nlohmann::json& edit : sketch["edits"]) QCOMPARE(keysOf(edit), (Keys{"median", "p95", "limit"}));
}

void TestCli::recordingsAreDrawn() {
  QTemporaryDir folder;
  const QString recording = folder.filePath("run.psrec"), out = folder.filePath("pictures");
  Ran ran = cli(smallScene({"--frames", "4", "--record", recording, "--quiet"}));
  QVERIFY2(ran.code == 0, ran.err.constData());
  ran = cli({"render", recording, "--out", out, "--size", "160x120", "--every", "2"});
  QVERIFY2(ran.code == 0, ran.err.constData());
  const QStringList pictures = QDir(out).entryList(QDir::Files, QDir::Name);
  QCOMPARE(pictures, (QStringList{"frame-000000.png", "frame-000002.png", "frame-000004.png"}));
  const QImage picture(QDir(out).filePath(pictures[2]));
  QCOMPARE(picture.size(), QSize(160, 120));
  std::set<QRgb> colours;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) colours.insert(picture.pixel(x, y));
  }
  QVERIFY(colours.size() > 100);  // an empty or broken picture has a few
  ran = cli({"render", recording, "--out", out, "--size", "160x120", "--every", "9"});
  QVERIFY2(ran.out.startsWith("1 picture in "), ran.out.constData());
  const auto cut = [&](const QString& section) {
    ran = cli({"render", recording, "--out", folder.filePath("cut.png"), "--size", "160x120", "--section", section});
    return ran.code == 0 ? QImage(folder.filePath("cut.png")) : QImage();
  };
  const QImage whole = cut("none");
  QVERIFY2(!whole.isNull(), ran.err.constData());
  QVERIFY(cut("x=9") == whole);  // all of it lies before that
  const QImage left = cut("x=0"), right = cut("-x=0");
  QVERIFY2(!right.isNull(), ran.err.constData());
  QVERIFY(!left.isNull() && left != whole && right != whole && left != right);
  for (const char* wrong : {"w=1", "x", "x=", "x=1m", "=1", "y=1e9", ""}) {
    QVERIFY2(cut(wrong).isNull() && ran.code == 2 && ran.err.contains("--section must be none"), wrong);
  }
  const auto coloured = [&](const QString& colour) {
    return cli({"render", recording, "--out", out, "--size", "160x120", "--every", "4", "--colour", colour});
  };
  QCOMPARE(coloured("pressure").code, 0);
  const qint64 size = QFileInfo(recording).size();
  ran = cli(smallScene({"--frames", "4", "--record", recording, "--quiet", "--fields", "density,solid_fraction"}));
  QVERIFY2(ran.code == 0 && QFileInfo(recording).size() < size, ran.err.constData());
  QCOMPARE(coloured("solid_fraction").code, 0);
  QCOMPARE(coloured("speed").code, 0);
  QVERIFY(coloured("pressure").err.contains("has no such field; record it with --fields pressure"));
  ran = cli(smallScene({"--frames", "4", "--record", recording, "--fields", "presure"}));
  QVERIFY2(ran.code == 2 && ran.err.contains("did you mean 'pressure'?"), ran.err.constData());
  QCOMPARE(cli(smallScene({"--frames", "4", "--fields", "none"})).code, 2);
}

/// A plugin's field is listed, drawn, probed and recorded like ours; drawn from the recording without the plugin too.
void TestCli::fieldsOfPlugins() {
  const QTemporaryDir folder, plugins;
  QVERIFY(place(plugins, "source", "showing_source"));
  const QString probes = folder.filePath("probes.csv"), recording = folder.filePath("run.psrec"),
                mark = "fixture.source.mark";
  Ran ran = cli({"plugins", "--fields"}, plugins.path());
  QVERIFY2(ran.out.contains("specific_enthalpy") && ran.out.contains(mark.toUtf8()), ran.out.constData());
  QVERIFY2(!ran.out.contains("fixture.source.own"), ran.out.constData());
  const nlohmann::json listed =
      nlohmann::json::parse(cli({"plugins", "--json"}, plugins.path()).out.toStdString())["fields"];
  QVERIFY(std::any_of(listed.begin(), listed.end(), [](const nlohmann::json& f) { return f["unit"] == "J/kg"; }));
  const QStringList source{"--set", "solver/thermal/sources=[{\"plugin\": \"fixture.source\"}]", "--set",
                           "probes=[{\"id\": \"m\", \"quantity\": \"" + mark + "_max\"}]"};
  ran =
      cli(smallScene({"--frames", "2", "--record", recording, "--probes", probes, "--quiet"}) + source, plugins.path());
  QVERIFY2(ran.code == 0, ran.err.constData());
  QFile table(probes);
  QVERIFY(table.open(QIODevice::ReadOnly));
  const QByteArrayList rows = table.readAll().trimmed().split('\n');
  QVERIFY2(rows.front().split(',')[2] == "m." + mark.toUtf8() + "_max[J/kg]", rows.front().constData());
  QVERIFY2(rows.back().split(',')[2].toDouble() >= 1e5, rows.back().constData());
  const auto drawn = [&](const QString& colour, const QString& path) {
    const QString out = folder.filePath(colour);
    ran = cli({"render", recording, "--out", out, "--size", "160x120", "--colour", colour}, path);
    return QImage(out + "/frame-000002.png");
  };
  const QImage marks = drawn(mark, {}), matter = drawn("material", {});
  QVERIFY2(ran.code == 0 && !marks.isNull(), ran.err.constData());
  QVERIFY(marks != matter);
  drawn("fixture.source.marc", plugins.path());
  QCOMPARE(ran.code, 2);
  QVERIFY2(ran.err.contains("did you mean 'fixture.source.mark'?"), ran.err.constData());
}

void TestCli::filmsEndWhereTheRunBreaks() {
  // A constraint that answers NaN: the solver says so and stands still from then on.
  QTemporaryDir folder;
  QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_constraint.so",
                      folder.filePath("nan_constraint.so")));
  const QString out = folder.filePath("pictures");
  QStringList arguments =
      smallScene({"--frames", "4", "--out", out, "--size", "160x120", "--every", "1", "--set",
                  "bodies/ice/constraints=[{\"plugin\": \"fixture.constraint\"}]", "--set", "bodies/ice/phase=liquid"});
  arguments[0] = "render";
  const Ran ran = cli(arguments, folder.path());
  QCOMPARE(ran.code, 1);
  QVERIFY2(ran.err.contains("the run set flags: not_finite"), ran.err.constData());
  QCOMPARE(QDir(out).entryList(QDir::Files), QStringList{"frame-000000.png"});
}

void TestCli::reportsThatCannotBeWrittenStopTheRunBefore() {
  QTemporaryDir folder;
  const QString probes = folder.filePath("p.csv");
  const Ran ran = cli(smallScene({"--frames", "1", "--probes", probes, "--report", folder.filePath("none/r.json")}));
  QCOMPARE(ran.code, 1);
  QVERIFY2(ran.err.contains("none/r.json: not saved: the folder does not exist"), ran.err.constData());
  QVERIFY(!QFile::exists(probes));  // it would be there, had the run begun
}

QTEST_APPLESS_MAIN(TestCli)
#include "tst_cli.moc"
