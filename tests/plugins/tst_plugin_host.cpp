// SPDX-License-Identifier: Apache-2.0
// Broken plugins are fixtures: each must give exactly one line that names the file and the fault, and leave the rest
// alone.
#include "core/base/callee.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/matter/material.h"
#include "core/plugin_host/crashwatch.h"
#include "core/plugin_host/hostservices.h"
#include "core/plugin_host/materialjson.h"
#include "core/plugin_host/pluginmetadata.h"
#include "core/plugin_host/pluginpaths.h"
#include "core/plugin_host/pluginscan.h"
#include "core/plugin_host/quarantine.h"
#include "core/plugin_host/registry.h"
#include "core/sketch/matterbrush.h"
#include "core/sketch/stroke.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdio>

using namespace ps;

namespace {

QString fixture(const QString& name) { return qEnvironmentVariable("PS_FIXTURE_DIR") + "/" + name + ".so"; }

QByteArray contents(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

bool write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
}

/// Only these directories count.
PluginRegistry::Options only(const std::vector<std::string>& paths) {
  PluginRegistry::Options options;
  options.extraPaths = paths;
  options.builtIn = options.userDirectory = options.environment = false;
  return options;
}

std::vector<PluginInfo> withState(const PluginRegistry& registry, PluginInfo::State state) {
  std::vector<PluginInfo> result;
  for (const PluginInfo& info : registry.plugins())
    if (info.state == state) result.push_back(info);
  return result;
}

bool isOneLine(const std::string& text) { return !text.empty() && text.find('\n') == std::string::npos; }

/// The metadata of a plugin lie in the file as CBOR: a text shorter than 24 bytes is one byte 0x60 + length and itself.
/// Texts are exchanged for others of the same length, so that nothing else moves.
QByteArray cborText(const QByteArray& text) { return QByteArray(1, static_cast<char>(0x60 + text.size())) + text; }

QByteArray damaged(QByteArray bytes, const QByteArray& from, const QByteArray& to) {
  if (bytes.count(from) != 1 || from.size() != to.size()) return {};
  return bytes.replace(from, to);
}

constexpr const char* kSoundJson = R"({"format": "phasesketch-material", "version": 1, "id": "soap", "label": "Soap",
  "licence": "CC0-1.0", "properties": {"density_solid": 1050}})";

}  // namespace

class TestPluginHost : public QObject {
  Q_OBJECT

 private:
  QString directory(const char* name) {
    const QString path = m_scratch.filePath(name);
    QDir().mkpath(path);
    return path;
  }
  /// A fresh directory with one sound plugin of each kind but materials.
  QString withSoundPlugins(const QString& name) {
    const QString path = directory(qPrintable(name));
    for (const char* kind : {"constraint", "thermal", "brush"})
      QFile::copy(fixture(QString("fixture_") + kind), path + "/" + kind + ".so");
    return path;
  }
  /// Runs this program as a child that loads a directory; its standard output, or "crashed". "--load" tries plugins in
  /// a process of their own first, "--load-untried" does not.
  QString loadInChild(const QString& path, const QString& how = QStringLiteral("--load")) {
    QProcess child;
    child.start(QCoreApplication::applicationFilePath(), {how, path});
    if (!child.waitForFinished(60000)) return "hung";
    if (child.exitStatus() == QProcess::CrashExit) return "crashed";
    return QString::fromUtf8(child.readAllStandardOutput());
  }

  QTemporaryDir m_scratch;

 private Q_SLOTS:
  void initTestCase() {
    QVERIFY(m_scratch.isValid());
    QVERIFY2(QFile::exists(fixture("fixture_material")), "PS_FIXTURE_DIR must name the fixtures");
    qputenv("XDG_STATE_HOME", m_scratch.filePath("state").toUtf8());
    qunsetenv("PHASESKETCH_PLUGIN_PATH");
  }

  /// Whoever runs a part of a plugin's loop is known to run that plugin's code.
  void threadsAreSharedUnderThePluginsName() {
    const HostServices host("fixture.threads", std::make_shared<InstalledMaterials>());
    QVERIFY(host.extension("no such service") == nullptr && host.extension(nullptr) == nullptr);
    const auto* threads = static_cast<const api::Threads*>(host.extension(api::kThreads));
    QVERIFY(threads);
    setThreadCount(4);
    const CalleeScope callee("fixture.threads");
    std::vector<int> visits(10001, 0);
    std::atomic<int> strangers{0}, chunks{0};
    const auto visit = [&](size_t first, size_t last) {
      if (!t_callee || std::string(t_callee) != "fixture.threads") ++strangers;
      for (size_t i = first; i < last; ++i) ++visits[i];
      ++chunks;
    };
    api::shareAmong(threads, visits.size(), 100, 1e6, visit);
    QVERIFY(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
    QCOMPARE(chunks.load(), 101);
    api::shareAmong(nullptr, visits.size(), 100, 1e6, visit);
    QCOMPARE(chunks.load(), 202);
    QCOMPARE(strangers.load(), 0);
    const auto failing = [](size_t first, size_t) {
      if (first == 500) throw std::runtime_error("chunk five");
    };
    QVERIFY_THROWS_EXCEPTION(std::runtime_error, api::shareAmong(threads, visits.size(), 100, 1e6, failing));
    setThreadCount(0);
  }

  /// Registries share a plugin's object: another one may not touch it while the scene of the first runs.
  void aPluginIsAttachedOnceForAllRegistries() {
    static class Counted final : public api::Described<api::Plugin> {
     public:
      Counted() : Described({"Counted", "Counts how often it is attached.", {}}) {}
      void attach(api::Host& host) override {
        if (++times == 1) throw std::runtime_error("not yet");
        m_host = &host;
      }
      double density() const { return m_host->property("lead", "density", 300); }
      int times = 0;

     private:
      api::Host* m_host = nullptr;
    } plugin;
    Material lead;
    lead.properties["density"] = Response(11340.0);
    const auto none = std::make_shared<InstalledMaterials>(), later = std::make_shared<InstalledMaterials>();
    later->byId["lead"] = &lead;
    QVERIFY_THROWS_EXCEPTION(std::runtime_error, attach(plugin, "counted", none));
    attach(plugin, "counted", none);
    QVERIFY(std::isnan(plugin.density()));
    attach(plugin, "counted", later);
    QCOMPARE(plugin.times, 2);
    QCOMPARE(plugin.density(), 11340.0);
  }

  void soundPluginsOfEachKindAreLoaded() {
    const QString path = withSoundPlugins("sound");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/material.so"));
    QVERIFY(write(path + "/soap.json", kSoundJson));
    QVERIFY(write(path + "/notes.txt", "not looked at"));
    const PluginRegistry registry(only({path.toStdString()}));
    for (const PluginInfo& info : registry.plugins()) QCOMPARE(info.problem, std::string());
    QCOMPARE(registry.plugins().size(), size_t(5));
    QVERIFY(registry.brush("fixture.brush") && registry.constraint("fixture.constraint"));
    QVERIFY(registry.thermal("fixture.thermal") && registry.materialPlugin("fixture.material"));
    QCOMPARE(registry.material("fixture.material")->adheresTo, std::vector<std::string>{"water"});
    QVERIFY(registry.material("soap") && !registry.materialPlugin("soap"));
    QVERIFY(!registry.brush("fixture.thermal") && !registry.material("fixture.brush") && !registry.has("nobody"));
    QCOMPARE(registry.ids(PluginKind::Material), (std::vector<std::string>{"fixture.material", "soap"}));
    const PluginInfo& info = registry.plugins().front();
    QCOMPARE(info.id, std::string("fixture.brush"));
    QCOMPARE(info.label, std::string("Fixture"));
    QCOMPARE(info.version, std::string("1.2.3"));
    QCOMPARE(info.licence, std::string("MIT"));
  }

  /// Structs of an older SDK end earlier, those of a newer one later: both load, with what this program knows.
  void structsMayGrow_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("leastWord");
    QTest::newRow("older") << "fixture_older"
                           << "";
    QTest::newRow("newer") << "fixture_newer"
                           << "never";
  }
  void structsMayGrow() {
    QFETCH(QString, file);
    QFETCH(QString, leastWord);
    const QString path = directory(qPrintable(file));
    QVERIFY(QFile::copy(fixture(file), path + "/grown.so"));
    const PluginRegistry registry(only({path.toStdString()}));
    QCOMPARE(registry.plugins().at(0).problem, std::string());
    const api::ParameterList parameters = registry.parameters("fixture.grown");
    QCOMPARE(parameters.count, size_t(3));
    for (size_t i = 0; i < 3; ++i) {
      QCOMPARE(QString(parameters[i].key), QStringList({"one", "two", "three"})[static_cast<qsizetype>(i)]);
      QCOMPARE(parameters[i].defaultValue, static_cast<double>(i + 1));
      QCOMPARE(QString(parameters[i].leastWord), leastWord);
    }
    const auto form = registry.constraintForm("fixture.grown");
    QVERIFY(form && std::holds_alternative<const api::StructuralPlugin*>(*form));
    struct {
      api::StructuralTraits traits;
      uint64_t behind[4] = {1, 2, 3, 4};
    } out;
    QVERIFY(std::get<const api::StructuralPlugin*>(*form)->traits(&out.traits));
    QCOMPARE(out.traits.arity, 3u);
    QCOMPARE(out.traits.values.count, size_t(2));
    QCOMPARE(out.traits.fields.count, size_t(0));  // unsaid by the older one
    for (uint64_t k = 0; k < 4; ++k) QCOMPARE(out.behind[k], k + 1);
  }

  void stampsAreCheckedBeforeLoading_data() {
    QTest::addColumn<QByteArray>("stamp");
    QTest::addColumn<QString>("expected");
    QTest::newRow("other layout") << QByteArray("phasesketch-sdk:0.9:9")
                                  << "built with the plugin headers 0.9:9, which do not fit this program's, 0.9:3";
    QTest::newRow("other major") << QByteArray("phasesketch-sdk:1.9:1") << "built with the plugin headers 1.9:1";
    QTest::newRow("older than it says") << QByteArray("phasesketch-sdk:0.8:3") << "ask for a later version";
    QTest::newRow("none") << QByteArray("no stamp is to be had") << "carries no stamp";
  }
  void stampsAreCheckedBeforeLoading() {
    QFETCH(QByteArray, stamp);
    QFETCH(QString, expected);
    const QString path = withSoundPlugins(QString("stamp ") + QTest::currentDataTag());
    const QByteArray sound("phasesketch-sdk:0.9:3");
    QByteArray bytes = contents(fixture("fixture_material"));
    QVERIFY(bytes.contains(sound) && stamp.size() == sound.size());  // one for each source
    bytes.replace(sound, stamp);
    QVERIFY(write(path + "/aborting.so", bytes));  // its code would abort if it ran
    expectOneRefusal(path, "aborting.so", expected);
  }

  void damagedMetadataAreRefused_data() {
    QTest::addColumn<QByteArray>("from");
    QTest::addColumn<QByteArray>("to");
    QTest::addColumn<QString>("expected");
    const QByteArray api = cborText("api"), licence = cborText("licence"), kind = cborText("kind");
    QTest::newRow("other major version") << api + cborText("0.9") << api + cborText("2.0")
                                         << "version 2.0 of the plugin interface";
    QTest::newRow("later minor version") << api + cborText("0.9") << api + cborText("1.9") << "update PhaseSketch";
    QTest::newRow("no version") << api + cborText("0.9") << api + cborText("one") << "must be two numbers";
    QTest::newRow("missing key") << licence << cborText("license") << "lack the key \"licence\"";
    QTest::newRow("missing id") << cborText("id") << cborText("ID") << "lack the key \"id\"";
    QTest::newRow("bad id") << cborText("fixture.material") << cborText("Fixture Material") << "must be lower-case";
    QTest::newRow("id that leads elsewhere")
        << cborText("fixture.material") << cborText("../../etc/passwd") << "must be lower-case";
    QTest::newRow("bad version") << cborText("1.2.3") << cborText("1..23") << "must be numbers joined by dots";
    QTest::newRow("other kind") << kind + cborText("material") << kind + cborText("rustlike") << "kind \"rustlike\"";
    QTest::newRow("later interface") << QByteArray("org.phasesketch.Material/0.9")
                                     << QByteArray("org.phasesketch.Material/2.0")
                                     << "this program has org.phasesketch.Material/0.9";
    QTest::newRow("another program's") << QByteArray("org.phasesketch.Material/0.9")
                                       << QByteArray("org.elsewhere.gui.Style/1.23") << "another program";
  }
  void damagedMetadataAreRefused() {
    QFETCH(QByteArray, from);
    QFETCH(QByteArray, to);
    QFETCH(QString, expected);
    QByteArray bytes = contents(fixture("fixture_material"));
    // The IID stands in the metadata and in the interface's own name: only the first place counts for the loader.
    if (from.startsWith("org.")) {
      const qsizetype at = bytes.indexOf(from);
      QVERIFY(at > 0 && from.size() == to.size());
      for (qsizetype i = at; i >= 0; i = bytes.indexOf(from, i + 1)) bytes.replace(i, from.size(), to);
    } else {
      bytes = damaged(bytes, from, to);
    }
    QVERIFY2(!bytes.isEmpty(), "the metadata do not hold the text to damage");
    const QString path = withSoundPlugins(QString("metadata ") + QTest::currentDataTag());
    QVERIFY(write(path + "/damaged.so", bytes));
    expectOneRefusal(path, "damaged.so", expected);
  }

  void capabilitiesAreCheckedBeforeLoading_data() {
    QTest::addColumn<QByteArray>("list");
    QTest::addColumn<QString>("expected");
    // As the metadata hold it, in CBOR: 0x81 begins a list of one.
    QTest::newRow("unknown") << "\x81" + cborText("reads_minds1")
                             << "it needs 'reads_minds1', which this version does not offer; update PhaseSketch";
    QTest::newRow("no list") << cborText("opens_energy1") << "need a list of lower_snake_case names";
    QTest::newRow("no name") << "\x81" + cborText("opens energy") << "need a list of lower_snake_case names";
  }
  void capabilitiesAreCheckedBeforeLoading() {
    QFETCH(QByteArray, list);
    QFETCH(QString, expected);
    const QString path = withSoundPlugins(QString("capabilities ") + QTest::currentDataTag());
    {
      const PluginRegistry registry(only({path.toStdString()}));
      const auto& found = registry.plugins();
      const auto thermal = std::find_if(found.begin(), found.end(), [](auto& p) { return p.id == "fixture.thermal"; });
      QVERIFY(thermal != found.end() && thermal->state == PluginInfo::State::Loaded);
      QCOMPARE(thermal->capabilities, std::vector<std::string>{"opens_energy"});
    }
    const QByteArray bytes = damaged(contents(fixture("fixture_thermal")), "\x81" + cborText("opens_energy"), list);
    QVERIFY2(!bytes.isEmpty(), "the metadata do not hold the text to damage");
    QFile::remove(path + "/thermal.so");
    QVERIFY(write(path + "/damaged.so", bytes));  // under a new name: Qt remembers what it has read
    expectOneRefusal(path, "damaged.so", expected, 2);
  }

  void filesThatAreNoPluginsAreRefused_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("text") << QByteArray("this is not a plugin\n");
    QTest::newRow("random bytes") << QByteArray(5000, '\xA7');
    QTest::newRow("head of a library") << contents(fixture("fixture_brush")).left(300);
    QTest::newRow("first page of a library") << contents(fixture("fixture_brush")).left(4096);
    QTest::newRow("library without metadata") << contents(fixture("fixture_plain"));
  }
  void filesThatAreNoPluginsAreRefused() {
    QFETCH(QByteArray, bytes);
    const QString path = withSoundPlugins(QString("garbage ") + QTest::currentDataTag());
    QVERIFY(write(path + "/garbage.so", bytes));
    expectOneRefusal(path, "garbage.so", "is not a plugin");
  }

  void unresolvedSymbolIsRefused() {
    const QString path = withSoundPlugins("unresolved");
    QFile::remove(path + "/brush.so");
    QVERIFY(QFile::copy(fixture("fixture_unresolved"), path + "/unresolved.so"));
    const PluginRegistry registry(only({path.toStdString()}));
    const auto refused = withState(registry, PluginInfo::State::Refused);
    QCOMPARE(refused.size(), size_t(1));
    QVERIFY2(refused[0].problem.find("could not be loaded") != std::string::npos, refused[0].problem.c_str());
    QVERIFY(isOneLine(refused[0].problem));
  }

  void faultyCodeIsRefused_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const char* expected) { QTest::newRow(name) << "material" << expected; };
    row("throwing_constructor", "no more of this");
    row("throwing_number", "no std::exception");
    row("throwing_label", "label failed");
    row("null_label", "label is empty");
    row("throwing_parameters", "parameters failed");
    row("null_list", "null pointer");
    row("small_stride", "stride of 8 bytes");
    row("null_key", "parameter 1: its key is a null pointer");
    row("null_help", "parameter 1: its help is a null pointer");
    row("latin_label", "parameter 1: its label is not UTF-8 text");
    row("throwing_latin",
        "gr\xEF\xBF\xBD\xEF\xBF\xBD"
        "er");
    row("bad_key", "lower_snake_case");
    row("nan_default", "its default is not a finite number");
    row("min_above_max", "its minimum 3000 is above its maximum 2000");
    row("default_outside", "outside its hard limits");
    row("duplicate_parameter", "is declared twice");
    row("empty_choice", "empty choice");
    row("unknown_kind", "kind is unknown");
    row("unknown_condition", "its enabledWhen: there is no parameter 'rust'");
    row("garbled_condition", "\"density is large\" has no comparison in 'is'");
    row("unknown_relation", "its relations: there is no parameter 'rust'");
    row("garbled_relation", "needs \"must be\" or \"should be\"");
    row("body_only", "its actsAt must be NextFrame or NextReset");
    row("throwing_properties", "properties failed");
    row("null_property", "property 1: its key is a null pointer");
    row("unknown_property", "(did you mean 'density_solid'?)");
    row("duplicate_property", "is given twice");
    row("negative_density", "must be at least 0.1 kg/m³, not -3");
    row("infinite_property", "not a finite number");
    row("bad_grade", "its grade must be");
    row("unknown_law", "unknown law 'vogle'");
    row("throwing_law", "law failed");
    row("forgetful_law", "its law for 'density_liquid'");
    QTest::newRow("wide_constraint") << "constraint"
                                     << "2 to 4 particles, not 9";
    QTest::newRow("silent_constraint") << "constraint"
                                       << "its traits() says nothing";
    QTest::newRow("duplicate_field") << "thermal"
                                     << "field 'fixture.thermal.heat': is declared twice";
    QTest::newRow("foreign_field")
        << "thermal"
        << "must begin with the plugin's id and a dot, \"fixture.thermal.specific_enthalpy\"";
    const auto field = [](const char* name, const char* expected) { QTest::newRow(name) << "source" << expected; };
    field("long_label", "field 'fixture.source.mark': its label is longer than 40 letters");
    field("turned_scale", "its scale must go from a finite minimum up to a finite maximum");
    field("shown_vector", "a Float4 is no number to be shown");
    field("spaced_field", "small letters, digits, '_', '-' and '.' alone");
  }
  void faultyCodeIsRefused() {
    QFETCH(QString, kind);
    QFETCH(QString, expected);
    const QString name = QString(QTest::currentDataTag()) + ".so";
    const QString path = withSoundPlugins(QString("faulty ") + QTest::currentDataTag());
    QFile::remove(path + "/" + kind + ".so");
    QVERIFY(QFile::copy(fixture("fixture_" + kind), path + "/" + name));
    expectOneRefusal(path, name, expected, kind == "constraint" || kind == "thermal" ? 2 : 3);  // in whose place it is
  }

  void numberFormatSurvivesAPlugin() {
    const QString path = directory("locale");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/changing_locale.so"));
    // The plugin sets the user's format. German would show it best but need not be installed: C.UTF-8 always is, and
    // has a name of its own.
    qputenv("LC_ALL", "C.UTF-8");
    QCOMPARE(QByteArray(std::setlocale(LC_NUMERIC, "")), QByteArray("C.UTF-8"));
    std::setlocale(LC_NUMERIC, "C");
    const PluginRegistry registry(only({path.toStdString()}));
    QVERIFY(registry.has("fixture.material"));
    QCOMPARE(QByteArray(std::setlocale(LC_NUMERIC, nullptr)), QByteArray("C"));
  }

  void laterDirectoryReplacesEarlier() {
    const QString first = directory("first"), second = directory("second");
    QVERIFY(QFile::copy(fixture("fixture_material"), first + "/a.so"));
    const QByteArray newer = damaged(contents(fixture("fixture_material")), cborText("1.2.3"), cborText("4.5.6"));
    QVERIFY(write(second + "/b.so", newer));
    const PluginRegistry registry(only({first.toStdString(), second.toStdString()}));
    QCOMPARE(registry.plugins().size(), size_t(1));
    const PluginInfo& info = registry.plugins()[0];
    QCOMPARE(info.version, std::string("4.5.6"));
    QCOMPARE(info.note, "replaces version 1.2.3 in " + QFileInfo(first + "/a.so").canonicalFilePath().toStdString());
  }

  void brokenReplacementLeavesTheEarlierInPlace() {
    const QString first = directory("good first"), second = directory("broken second");
    QVERIFY(QFile::copy(fixture("fixture_material"), first + "/a.so"));
    QVERIFY(QFile::copy(fixture("fixture_material"), second + "/throwing_constructor.so"));
    const PluginRegistry registry(only({first.toStdString(), second.toStdString()}));
    QVERIFY(registry.material("fixture.material"));
    const auto refused = withState(registry, PluginInfo::State::Refused);
    QCOMPARE(refused.size(), size_t(1));
    QVERIFY2(refused[0].problem.find("takes its place") != std::string::npos, refused[0].problem.c_str());
  }

  void twoOfOneIdInOneFolderGiveOneLine() {
    const QString path = withSoundPlugins("twins");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/m1.so"));
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/m2.so"));
    expectOneRefusal(path, "m2.so", "is taken by", 4);
  }

  void missingFolderThatWasAskedForIsTold() {
    const QString missing = m_scratch.filePath("nowhere");
    const PluginRegistry registry(only({missing.toStdString()}));
    QCOMPARE(registry.plugins().size(), size_t(1));
    QCOMPARE(registry.plugins()[0].problem,
             missing.toStdString() + ": there is no such folder; correct the given paths");
  }

  void environmentAndUserDirectoryAreSearched() {
    const QString data = directory("data"), env = directory("env");
    QDir().mkpath(data + "/phasesketch/plugins");
    QVERIFY(write(data + "/phasesketch/plugins/soap.json", kSoundJson));
    QVERIFY(write(env + "/soap.json", QByteArray(kSoundJson).replace("1050", "1060")));
    QVERIFY(write(env + "/candle.json", QByteArray(kSoundJson).replace("\"soap\"", "\"candle\"")));
    qputenv("XDG_DATA_HOME", data.toUtf8());
    qputenv("PHASESKETCH_PLUGIN_PATH", (env + ":").toUtf8());
    PluginRegistry::Options options;
    options.builtIn = false;
    const PluginRegistry registry(options);
    qunsetenv("PHASESKETCH_PLUGIN_PATH");
    QCOMPARE(registry.ids(PluginKind::Material), (std::vector<std::string>{"candle", "soap"}));
    QCOMPARE(registry.material("soap")->properties.at("density_solid").constant, 1060.0);
  }

  /// Who names the program's own folder once more does not make strangers of its plugins.
  void ownFolderNamedAgainStaysOwn() {
    qputenv("PHASESKETCH_PLUGIN_PATH", PS_BINARY_DIR "/lib/phasesketch/plugins");
    PluginRegistry::Options options;
    options.userDirectory = false;
    const PluginRegistry registry(options);
    qunsetenv("PHASESKETCH_PLUGIN_PATH");
    const auto& all = registry.plugins();
    const auto bonds = std::find_if(all.begin(), all.end(), [](const PluginInfo& p) { return p.id == "bonds"; });
    QVERIFY(bonds != all.end());
    QVERIFY2(bonds->state == PluginInfo::State::Loaded, bonds->problem.c_str());
    QVERIFY(bonds->own);
  }

  void standardComesWithTheProgram() {
    const QString path = withSoundPlugins("standard");
    PluginRegistry alone(only({path.toStdString()}));
    QCOMPARE(alone.standard(PluginKind::Brush), std::string("fixture.brush"));
    QCOMPARE(alone.standard(PluginKind::Thermal), std::string());  // installed, but it does not offer itself
    alone.fault("fixture.brush", "failed");
    QCOMPARE(alone.standard(PluginKind::Brush), std::string("fixture.brush"));
    PluginRegistry::Options options = only({path.toStdString()});
    options.builtIn = true;
    const PluginRegistry both(options);
    QVERIFY(both.has("fixture.brush"));
    QCOMPARE(both.standard(PluginKind::Brush), std::string("sphere"));  // though "fixture.brush" comes first by id
    QCOMPARE(both.standard(PluginKind::Thermal), std::string("enthalpy"));
    QCOMPARE(both.standard(PluginKind::Material), std::string("water"));
    QVERIFY(both.brush("cube")->extension(api::kBoxStamp) && !both.brush("sphere")->extension(api::kBoxStamp));
  }

  void faultTakesAPluginOutOfService() {
    const QString path = withSoundPlugins("running");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/material.so"));
    PluginRegistry registry(only({path.toStdString()}));
    const std::vector<PluginInfo>& before = registry.plugins();
    const size_t count = before.size();
    registry.fault("fixture.brush", "threw\nin stroke()");
    registry.fault("nobody", "is not there");
    QVERIFY(!registry.has("fixture.brush") && registry.has("fixture.thermal"));
    QCOMPARE(withState(registry, PluginInfo::State::Refused).size(), size_t(1));
    QVERIFY(isOneLine(withState(registry, PluginInfo::State::Refused)[0].problem));
    QVERIFY(withState(registry, PluginInfo::State::Refused)[0].problem.find("threw in stroke()") != std::string::npos);
    QCOMPARE(before.size(), count);  // a reference that somebody still reads stays good
    // A law that fails later: an error that names it, and the plugin is out of service.
    QVERIFY_EXCEPTION_THROWN(registry.evaluated("fixture.material", {1800, 1000}), Error);
    QVERIFY(!registry.has("fixture.material"));
  }

  void lawsAreEvaluatedForOwnParameters() {
    const QString path = directory("laws");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/material.so"));
    const PluginRegistry registry(only({path.toStdString()}));
    // The law is linear below 300 K and level above; samples every kelvin and monotone interpolation give it back to
    // rounding of 12 digits.
    const Material atDefaults = registry.evaluated("fixture.material", {});
    QVERIFY(std::abs(atDefaults.properties.at("density_liquid").at(250.5) - (1000 - 25.05)) < 1e-9);
    const Material denser = registry.evaluated("fixture.material", {1400, 1000});
    QVERIFY(std::abs(denser.properties.at("density_liquid").at(250.5) - (1400 - 25.05)) < 1e-9);
    QCOMPARE(denser.properties.at("density_liquid").at(2000), 1370.0);
    QCOMPARE(denser.properties.at("density_solid").constant, 1100.0);
    QVERIFY_EXCEPTION_THROWN(registry.evaluated("nobody", {}), Error);
  }

  /// What takes its process down takes one down that tries it, and the program goes on without it.
  void pluginsAreTriedInAProcessOfTheirOwn_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("why");
    QTest::newRow("it aborts") << "aborting"
                               << "it crashed (Aborted) while it was loaded";
    QTest::newRow("it exits") << "exiting"
                              << "it ended the program while it was loaded";
    QTest::newRow("it hangs") << "endless"
                              << "it did not come back within 1 s when it was loaded";
  }
  void pluginsAreTriedInAProcessOfTheirOwn() {
    QFETCH(QString, file);
    QFETCH(QString, why);
    const QString path = directory(qPrintable("tried_" + file));
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/" + file + ".so"));
    PluginRegistry::Options options = only({path.toStdString()});
    options.patience = 1;
    PluginRegistry registry(options);
    QCOMPARE(withState(registry, PluginInfo::State::Quarantined).size(), size_t(1));
    const std::string problem = registry.plugins().front().problem;
    QVERIFY2(problem.find(why.toStdString()) != std::string::npos, problem.c_str());
    QVERIFY(problem.find("phasesketch-cli plugins --allow fixture.material") != std::string::npos);
    // Tried again, it fails again; mended without another build, it is loaded at the next start.
    QVERIFY(!registry.tryAgain("fixture.brush").known);
    PluginRegistry::SecondTry again = registry.tryAgain("fixture.material");
    QVERIFY2(again.known && again.problem == problem, again.problem.c_str());
    QCOMPARE(registry.plugins().front().state, PluginInfo::State::Quarantined);
    qputenv("PS_LET_GO", "1");
    again = registry.tryAgain("fixture.material");
    QVERIFY2(again.known && again.problem.empty(), again.problem.c_str());
    QCOMPARE(registry.plugins().front().state, PluginInfo::State::Refused);
    QVERIFY(!registry.tryAgain("fixture.material").known);
    const QString next = loadInChild(path);
    qunsetenv("PS_LET_GO");
    QVERIFY2(next.contains("fixture.material loaded"), qPrintable(next));
  }

  /// Once tried it is loaded as it is; what ends the program then is looked at again.
  void aSoundPluginIsTriedOnce() {
    const QString path = directory("sound_once");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/aborting.so"));
    qputenv("PS_LET_GO", "1");
    QVERIFY(loadInChild(path).contains("fixture.material loaded"));
    qunsetenv("PS_LET_GO");
    QCOMPARE(loadInChild(path), QString("crashed"));
    const QString second = loadInChild(path);
    QVERIFY2(second.contains("fixture.material quarantined") && second.contains("it crashed (Aborted)"),
             qPrintable(second));
  }

  /// A kill leaves the same traces as a crash, but is none: only twice in a row counts, and only where nothing can be
  /// tried.
  void killsAccuseNobody_data() {
    QTest::addColumn<QString>("how");
    QTest::addColumn<bool>("twice");
    QTest::newRow("tried, once") << "--load" << false;
    QTest::newRow("untried, once") << "--load-untried" << false;
    QTest::newRow("untried, twice") << "--load-untried" << true;
  }
  void killsAccuseNobody() {
    QFETCH(QString, how);
    QFETCH(bool, twice);
    const QString path = withSoundPlugins(QStringLiteral("killed%1%2").arg(how).arg(twice));
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/killed.so"));
    const auto killed = [&] {
      qputenv("PS_KILLED", "1");
      const QString text = loadInChild(path, how);
      qunsetenv("PS_KILLED");
      return text == "crashed";
    };
    for (int k = 0; k < 3; ++k) {
      QVERIFY(killed());
      if (twice) QVERIFY(killed());
      const QString after = loadInChild(path, how);
      QVERIFY2(after.contains("quarantined") == twice, qPrintable(after));
      if (twice) return;
      QVERIFY2(after.contains("fixture.material loaded"), qPrintable(after));
    }
  }

  void crashingPluginIsNotLoadedThrice() {
    const QString path = withSoundPlugins("crashing");
    QVERIFY(QFile::copy(fixture("fixture_material"), path + "/aborting.so"));
    for (int k = 0; k < 2; ++k) QCOMPARE(loadInChild(path, "--load-untried"), QString("crashed"));
    const QString third = loadInChild(path, "--load-untried");
    QVERIFY2(third.contains("fixture.material quarantined"), qPrintable(third));
    QVERIFY2(third.contains("phasesketch-cli plugins --allow fixture.material"), qPrintable(third));
    QCOMPARE(third.count(" loaded \n"), 3);
    // Another build of the file gets its chance by itself.
    QFile::remove(path + "/aborting.so");
    QVERIFY(write(path + "/aborting.so", damaged(contents(fixture("fixture_material")), cborText("fixture.material"),
                                                 cborText("fixture.renamed_"))));
    QVERIFY(!loadInChild(path, "--load-untried").contains("quarantined"));
  }

  void onlyLocksOfDeadProcessesCount() {
    const std::string state = m_scratch.filePath("locks").toStdString();
    const std::string plugin = fixture("fixture_brush").toStdString();
    {
      const LoadingLock mine(state, "alive", plugin);
      for (const bool last : {false, true}) {
        const pid_t child = fork();
        if (child == 0) {
          new LoadingLock(state, "dead", plugin);  // NOLINT: it must not be destroyed
          _exit(0);
        }
        int status = 0;
        QCOMPARE(waitpid(child, &status, 0), child);
        QVERIFY(
            write(QString::fromStdString(state) + "/17-0.draft", {}));  // of one that was killed before its lock stood
        Quarantine quarantine(state);
        QVERIFY(quarantine.why("alive", plugin).empty());
        QCOMPARE(quarantine.why("dead", plugin).empty(), !last);
        QVERIFY(quarantine.why("dead", "/another/file.so").empty());
      }
    }
    QCOMPARE(QDir(QString::fromStdString(state)).entryList({"*.loading", "*.draft"}).size(), 0);
    Quarantine again(state);
    QVERIFY(!again.why("dead", plugin).empty() && again.allow("dead") && again.why("dead", plugin).empty());
    QVERIFY(Quarantine(state).why("dead", plugin).empty());
  }

  /// A record of what came with the program is not believed at the next start, and its crash leaves none; a copy of it
  /// in another folder is somebody else's, and gives way to it.
  void whatCameWithTheProgramIsTriedAgain() {
    PluginRegistry::Options options;
    const PluginRegistry before(options);
    const PluginInfo* first = before.info("bonds");
    QVERIFY(first && first->own);
    const std::string path = first->path;
    Quarantine(stateDirectory()).accuse("bonds", path, "it crashed");
    QVERIFY(!Quarantine(stateDirectory()).why("bonds", path).empty());
    QVERIFY(PluginRegistry(options).has("bonds"));
    QVERIFY(Quarantine(stateDirectory()).why("bonds", path).empty());
    QVERIFY(!putInQuarantine("bonds"));
    QVERIFY(Quarantine(stateDirectory()).why("bonds", path).empty());
    const QString folder = directory("copy_of_own");
    QVERIFY(QFile::copy(QString::fromStdString(path), folder + "/bonds.so"));
    options.extraPaths = {folder.toStdString()};
    {
      const PluginRegistry copied(options);
      QVERIFY(copied.info("bonds") && copied.info("bonds")->path != path);
      QVERIFY(putInQuarantine("bonds"));
    }
    const PluginRegistry after(options);
    QVERIFY(after.info("bonds") && after.info("bonds")->path == path);
    QCOMPARE(withState(after, PluginInfo::State::Quarantined).size(), size_t(1));
  }

  /// What crashes when the program is ending has lost what it needs.
  void aCrashAtTheEndAccusesNobody_data() {
    QTest::addColumn<QString>("how");
    QTest::addColumn<bool>("accused");
    QTest::newRow("while it runs") << "--crash" << true;
    QTest::newRow("at its end") << "--crash-at-end" << false;
  }
  void aCrashAtTheEndAccusesNobody() {
    QFETCH(QString, how);
    QFETCH(bool, accused);
    const QString path = withSoundPlugins(QStringLiteral("at_end") + how);
    QCOMPARE(loadInChild(path, how), QString("crashed"));
    QCOMPARE(loadInChild(path).contains("fixture.brush quarantined"), accused);
  }

  void concurrentStartsDoNotQuarantineAnything() {
    const QString path = withSoundPlugins("concurrent");
    std::vector<std::unique_ptr<QProcess>> children;
    for (int i = 0; i < 6; ++i) {
      children.push_back(std::make_unique<QProcess>());
      children.back()->start(QCoreApplication::applicationFilePath(), {"--load", path});
    }
    for (auto& child : children) {
      QVERIFY(child->waitForFinished(60000));
      QCOMPARE(child->readAllStandardOutput().count(" loaded"), 3);
    }
  }

  void brokenMaterialFilesNameTheirPlace_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("expected");
    const auto replaced = [](const char* from, const char* to) { return QByteArray(kSoundJson).replace(from, to); };
    QTest::newRow("empty") << QByteArray() << ":/: the file is empty";
    QTest::newRow("cut off") << QByteArray(kSoundJson).left(60) << "the file ends too early";
    QTest::newRow("NaN") << replaced("1050", "NaN") << "NaN and Infinity are not numbers in JSON";
    QTest::newRow("too large a number") << replaced("1050", "1e999") << "the number 1e999 is too large";
    QTest::newRow("a list") << QByteArray("[1, 2]") << ":/: must be an object, not a list";
    QTest::newRow("200,000 brackets") << QByteArray(200000, '[') << "nested deeper than 64 levels";
    QTest::newRow("duplicate key") << replaced("\"label\"", "\"id\"") << "the key 'id' stands here twice";
    QTest::newRow("duplicate property") << replaced("1050", "1, \"density_solid\": 2")
                                        << "/properties/density_solid: the key";
    QTest::newRow("no format") << replaced("\"format\"", "\"form\"") << ":/format: is missing";
    QTest::newRow("other format") << replaced("phasesketch-material", "gltf") << ":/format: must be";
    QTest::newRow("later version") << replaced("\"version\": 1", "\"version\": 2") << ":/version: is newer";
    QTest::newRow("version as text") << replaced("\"version\": 1", "\"version\": \"1\"")
                                     << ":/version: must be a whole number";
    QTest::newRow("number for a name") << replaced("\"Soap\"", "7") << ":/label: must be a text, not the number 7";
    QTest::newRow("bad id") << replaced("\"soap\"", "\"So ap\"") << ":/id: must be lower-case";
    QTest::newRow("no licence") << replaced("\"licence\"", "\"author\"") << ":/licence: is missing";
    QTest::newRow("unknown key") << replaced("\"licence\"", "\"colour\": 1, \"licence\"") << ":/colour: is not a key";
    QTest::newRow("no id of a material") << replaced("\"licence\"", "\"adheres_to\": [\"Old wood\"], \"licence\"")
                                         << ":/adheres_to/0: must be lower-case";
    QTest::newRow("no list of materials") << replaced("\"licence\"", "\"adheres_to\": \"wood\", \"licence\"")
                                          << ":/adheres_to: must be a list, not the text 'wood'";
    const auto tagged = [](const char* tags) {
      return QByteArray(kSoundJson).replace("\"licence\"", QByteArray("\"tags\": ") + tags + ", \"licence\"");
    };
    QTest::newRow("no list of tags") << tagged("\"food\"") << ":/tags: must be a list, not the text 'food'";
    QTest::newRow("number for a tag") << tagged("[\"food\", 7]") << ":/tags/1: must be a text, not the number 7";
    QTest::newRow("empty tag") << tagged("[\"\"]") << ":/tags/0: must be a word of 1 to 24 letters";
    QTest::newRow("long tag") << tagged("[\"a-word-that-nobody-reads-x\"]") << ":/tags/0: must be a word of 1 to 24";
    QTest::newRow("two tags in one") << tagged("[\"food, kitchen\"]") << ":/tags/0: must be a word without commas";
    QTest::newRow("tag twice") << tagged("[\"food\", \"cold\", \"Food\"]") << ":/tags/2: stands here twice";
    QTest::newRow("too many tags")
        << tagged("[\"a\",\"b\",\"c\",\"d\",\"e\",\"f\",\"g\",\"h\",\"i\",\"j\",\"k\",\"l\",\"m\"]")
        << ":/tags/12: is one more than the 12";
    QTest::newRow("unknown property")
        << replaced("density_solid", "densty_solid")
        << ":/properties/densty_solid: is not a property that PhaseSketch knows (did you mean 'density_solid'?)";
    QTest::newRow("word for a number") << replaced("1050", "\"heavy\"")
                                       << "/density_solid: must be a number, not the text 'heavy'";
    QTest::newRow("negative density") << replaced("1050", "{\"value\": -1050}")
                                      << "/density_solid/value: must be at least 0.1 kg/m³, not -1050";
    QTest::newRow("no value") << replaced("1050", "{\"grade\": \"A\"}") << "/density_solid: needs one of";
    QTest::newRow("two values") << replaced("1050", "{\"value\": 1, \"points\": []}") << "/density_solid: needs one of";
    QTest::newRow("bad grade") << replaced("1050", "{\"value\": 1050, \"grade\": \"D\"}")
                               << "/density_solid/grade: must be";
    QTest::newRow("descending points") << replaced("1050", "{\"points\": [[300, 1000], [200, 900]]}")
                                       << "/density_solid/points: points must ascend";
    QTest::newRow("half a point") << replaced("1050", "{\"points\": [[300, 1000], [400]]}")
                                  << "/density_solid/points/1: must be [temperature";
    QTest::newRow("unknown way") << replaced("1050", "{\"points\": [[300, 9, {\"to_next\": \"jump\"}], [400, 9]]}")
                                 << "/density_solid/points/0/2/to_next: must be \"step\"";
    QTest::newRow("slip in a way") << replaced("1050", "{\"points\": [[300, 9, {\"next\": \"step\"}], [400, 9]]}")
                                   << "/density_solid/points/0/2/next: is not a key";
    QTest::newRow("slopes that lead below 0")
        << replaced("1050", "{\"points\": [[300, 9, {\"slope_after\": -9}], [310, 9]]}")
        << "K, where the slopes of its points lead, must be at least 0.1 kg/m³";
    QTest::newRow("Celsius") << replaced("1050", "{\"points\": [[-10, 917], [0, 917]]}")
                             << "temperatures are in kelvin";
    QTest::newRow("unknown law") << replaced("1050", "{\"law\": \"magic\", \"coefficients\": [1]}")
                                 << "/density_solid/law: unknown law";
    QTest::newRow("law without coefficients")
        << replaced("1050", "{\"law\": \"vogel\"}") << "/density_solid/coefficients: is missing";
    QTest::newRow("law that goes negative")
        << replaced("1050", "{\"law\": \"linear\", \"coefficients\": [1050, 100, 293.15]}")
        << ":/properties: density_solid: its law gives";
    QTest::newRow("curve where a number belongs")
        << replaced("\"density_solid\": 1050", "\"latent_heat_fusion\": {\"points\": [[1, 2]]}")
        << "must be a single number";
    QTest::newRow("solidus above liquidus")
        << replaced("1050", "1050, \"solidus\": 300, \"liquidus\": 280, \"melting_temperature\": 290")
        << ":/properties: solidus";
  }
  void brokenMaterialFilesNameTheirPlace() {
    QFETCH(QByteArray, text);
    QFETCH(QString, expected);
    const QString path = withSoundPlugins(QString("json ") + QString(QTest::currentDataTag()).replace('/', '_'));
    QVERIFY(write(path + "/broken.json", text));
    expectOneRefusal(path, "broken.json", expected);
  }

  /// What was given stays as it was; what is broken, gone or another one changes nothing.
  void materialFilesAreReadAgain() {
    const QString path = directory("again"), file = path + "/soap.json";
    QVERIFY(write(file, kSoundJson));
    QVERIFY(write(path + "/candle.json", QByteArray(kSoundJson).replace("\"soap\"", "\"candle\"")));
    PluginRegistry registry(only({path.toStdString()}));
    QVERIFY(registry.changedMaterials().empty());
    const Material* before = registry.material("soap");
    QVERIFY(write(file, QByteArray(kSoundJson).replace("1050", "1060").replace("Soap", "Hard soap")));
    const auto readings = registry.changedMaterials();
    QCOMPARE(readings.size(), size_t(1));
    QCOMPARE(readings[0].info.problem, std::string());
    QCOMPARE(registry.material("soap"), before);
    registry.offer(readings[0]);
    QCOMPARE(registry.material("soap")->properties.at("density_solid").constant, 1060.0);
    QCOMPARE(registry.evaluated("soap", {}).properties.at("density_solid").constant, 1060.0);
    QCOMPARE(before->properties.at("density_solid").constant, 1050.0);
    QCOMPARE(registry.plugins()[1].label, std::string("Hard soap"));
    QCOMPARE(registry.plugins()[0].label, std::string("Soap"));
    QVERIFY(registry.plugins()[1].state == PluginInfo::State::Loaded && registry.changedMaterials().empty());
    QVERIFY(write(file, QByteArray(kSoundJson)
                            .replace("1050", "1060")
                            .replace("Soap", "Hard soap")
                            .replace("\"licence\"", "\"tags\": [\"bath\"], \"licence\"")));
    const auto tagged = registry.changedMaterials();
    QCOMPARE(tagged.size(), size_t(1));
    registry.offer(tagged[0]);
    QCOMPARE(registry.plugins()[1].tags, std::vector<std::string>{"bath"});
    QVERIFY(registry.changedMaterials().empty());
    for (const auto& [from, to, says] : {std::tuple("1050", "-3", ":/properties/density_solid"),
                                         std::tuple("\"soap\"", "\"soap.other\"", ":/id: was \"soap\"")}) {
      QVERIFY(write(file, QByteArray(kSoundJson).replace(from, to)));
      const auto broken = registry.changedMaterials();
      QCOMPARE(broken.size(), size_t(1));
      QCOMPARE(broken[0].info.id, std::string("soap"));
      QVERIFY2(broken[0].info.problem.starts_with(file.toStdString() + says), broken[0].info.problem.c_str());
    }
    QVERIFY(QFile::remove(file));
    QVERIFY(registry.changedMaterials().empty());
    QCOMPARE(registry.material("soap")->properties.at("density_solid").constant, 1060.0);
  }

  void materialFileKeepsSourcesAndForms() {
    PluginInfo info;
    const Material m = parseMaterialJson(R"({"format": "phasesketch-material", "version": 1, "id": "a.b", "label": "AB",
      "licence": "MIT", "data_version": "2.1", "help": "h", "adheres_to": ["water", "wax"], "tags": ["food", "käse"], "properties": {
      "density_solid": {"points": [[200, 900], [300, 890]], "source": "Kell", "grade": "A"}, "sinters": true,
      "density_liquid": {"points": [[200, 900, {"to_next": "step"}], [300, 890, {"to_next": "linear", "slope_before": 0.1}],
        [400, 800]]},
      "viscosity": {"law": "vogel", "coefficients": [-4.6, 247.8, 140]}}})",
                                         "ab.json", info);
    QCOMPARE(info.version, std::string("2.1"));
    QCOMPARE(m.provenance.at("density_solid").source, std::string("Kell"));
    QCOMPARE(m.provenance.at("density_solid").grade, 'A');
    QCOMPARE(m.provenance.at("viscosity").grade, 'C');
    QCOMPARE(m.properties.at("density_solid").at(250), 895.0);
    QCOMPARE(m.properties.at("density_liquid").at(299), 900.0);
    QCOMPARE(m.properties.at("density_liquid").at(350), 845.0);
    QCOMPARE(m.properties.at("density_liquid").points[1].slopeBefore, std::optional(0.1));
    QCOMPARE(m.properties.at("sinters").constant, 1.0);
    QCOMPARE(m.adheresTo, (std::vector<std::string>{"water", "wax"}));
    QCOMPARE(info.tags, (std::vector<std::string>{"food", "käse"}));
    QVERIFY(m.properties.at("viscosity").kind == Response::Kind::Law);
  }

  void ownMaterialsHoldWhatTheHandbooksSay() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    for (const char* id : {"water", "wax",     "iron",    "tin",   "chocolate", "butter", "honey",     "glass",
                           "lava",  "cotton",  "hemp",    "jelly", "rubber",    "wood",   "aluminium", "bronze",
                           "co2",   "ethanol", "gallium", "lead",  "nitrogen",  "steel"})
      QVERIFY2(registry.material(id), id);
    const Material& water = *registry.material("water");
    const Response& density = water.properties.at("density_liquid");
    // Kell's own table: 999.840, 999.972 (maximum), 998.204, 958.364 kg/m3; the curve through samples a kelvin apart
    // adds less than 0.005.
    QVERIFY(std::abs(density.at(273.15) - 999.840) < 0.005);
    QVERIFY(std::abs(density.at(277.13) - 999.972) < 0.005);
    QVERIFY(std::abs(density.at(293.15) - 998.204) < 0.005);
    QVERIFY(std::abs(density.at(373.15) - 958.364) < 0.005);
    QVERIFY(density.at(277.13) > density.at(274.15) && density.at(277.13) > density.at(280.15));
    // The fit with its own factor, not the logarithm rounded to 7 digits; and about 1.002 mPa s at 20 °C.
    const double fit = 2.414e-5 * std::pow(10, 247.8 / (293.15 - 140));
    QVERIFY(std::abs(water.properties.at("viscosity").at(293.15) / fit - 1) < 1e-6 && std::abs(fit - 1.002e-3) < 1e-6);
    QCOMPARE(water.properties.at("triple_pressure").constant, 611.657);
    QCOMPARE(water.provenance.at("latent_heat_vaporization").grade, 'A');
    const Material plain = registry.evaluated("water", {0});
    QVERIFY(plain.properties.at("density_liquid") == Response(998.2));
    const Material& wax = *registry.material("wax");
    QVERIFY(wax.properties.at("solidus").constant < wax.properties.at("liquidus").constant);
    // Dry ice has no liquid at 1 atm, and no other has its triple point above that.
    const BakedMaterial dryIce(*registry.material("co2"), 101325);
    QVERIFY(dryIce.caloric().sublimes && std::abs(dryIce.caloric().meltingPoint - 194.686) < 1e-3);
    QVERIFY(!BakedMaterial(*registry.material("co2"), 6e5).caloric().sublimes);
    for (const char* id : {"aluminium", "ethanol", "gallium", "lead", "nitrogen", "steel", "tin", "iron", "water"}) {
      const BakedMaterial baked(*registry.material(id), 101325);
      QVERIFY2(!baked.caloric().sublimes && baked.caloric().melts, id);
      // Only water and gallium float on their melt.
      const bool floats =
          baked.condensedDensity(baked.caloric().solidus, 1) < baked.condensedDensity(baked.caloric().liquidus, 0);
      QVERIFY2(floats == (std::string_view(id) == "water" || std::string_view(id) == "gallium"), id);
    }
    // Saturation at other pressures: ethanol 326.0 K at 33.7 kPa (its Antoine equation), nitrogen 83.6 K at 200 kPa
    // (NIST); the lines through boiling and triple point are within 1 % of the way to absolute zero.
    const auto boils = [&](const char* id, double pressure) {
      return phaseDiagramOf(*registry.material(id)).boilingPoint(pressure);
    };
    QVERIFY2(std::abs(boils("ethanol", 33.7e3) - 326) < 3, qPrintable(QString::number(boils("ethanol", 33.7e3))));
    QVERIFY2(std::abs(boils("nitrogen", 2e5) - 83.6) < 0.8, qPrintable(QString::number(boils("nitrogen", 2e5))));
    for (const char* id : {"water", "wax", "iron", "tin", "honey", "glass", "lava", "wood", "chocolate", "aluminium",
                           "co2", "ethanol", "gallium", "lead", "nitrogen", "steel"})
      for (const auto& [key, ignored] : registry.material(id)->properties)
        QVERIFY2(key.starts_with("color_") || key == "clearness" ||
                     !registry.material(id)->provenance.at(key).source.empty(),
                 key.c_str());
  }

  void ownBrushesDrawTheSameInPieces_data() {
    QTest::addColumn<QString>("brush");
    for (const char* brush : {"sphere", "cube", "particle", "line", "plane", "disc", "tube", "ribbon", "spray"})
      QTest::newRow(brush) << brush;
  }
  /// However the hand's way comes cut into calls, and again in the mirror.
  void ownBrushesDrawTheSameInPieces() {
    QFETCH(QString, brush);
    const PluginRegistry registry{PluginRegistry::Options{}};
    const api::BrushPlugin* plugin = registry.brush(brush.toStdString());
    QVERIFY(plugin);
    StrokeSetup setup;
    setup.grid = {{0.01, 0.01, 0.01}, 0.02};
    setup.radius = 0.063;
    const api::ParameterList list = registry.parameters(brush.toStdString());
    for (size_t k = 0; k < list.count; ++k) setup.parameters.push_back(list[k].defaultValue);
    std::vector<api::StrokeSample> raw;
    for (int k = 0; k <= 40; ++k)  // a bend, and a corner at its end
      raw.push_back({{0.6 + 0.3 * std::cos(0.05 * k), 0.3, 0.3 * std::sin(0.05 * k)}, 1, 0.01 * k, {}});
    raw.push_back({{0.9, 0.5, 0.2}, 0.6, 0.5, {}});
    const std::vector<api::StrokeSample> dense = resampleStroke(raw, setup.grid.spacing);
    const CellSet whole = applyBrush(*plugin, setup, api::EditKind::Add, dense).added;
    QVERIFY(whole.size() > (brush == "particle" ? size_t{20} : size_t{40}));
    CellSet pieces;
    for (size_t k = 0; k < dense.size(); ++k) {
      const size_t first = k > 0 ? k - 1 : 0;
      applyBrush(*plugin, setup, api::EditKind::Add, {dense.data() + first, k + 1 - first}, pieces);
    }
    // Of a tube and a ribbon only the very first point does not know its direction.
    QVERIFY(pieces == whole);
    setup.symmetry = VoxelShape::Symmetry{"x", 1, Vector3(0, 0, 0)};
    const CellSet both = applyBrush(*plugin, setup, api::EditKind::Add, dense).added;
    size_t mirrored = 0;
    for (const api::Cell& cell : whole.cells()) mirrored += both.contains({-1 - cell.x, cell.y, cell.z}) ? 1 : 0;
    // Cells whose centres or faces lie on a rim may fall to the other side.
    if (brush != "spray")
      QVERIFY2(mirrored >= 0.97 * static_cast<double>(whole.size()), qPrintable(QString::number(mirrored)));
    QVERIFY(both.size() > whole.size());
  }

  void ownBrushesTouchMatter_data() {
    QTest::addColumn<QString>("brush");
    QTest::addColumn<QString>("key");
    QTest::addColumn<int>("kind");
    for (const auto& [brush, key, kind] : {std::tuple{"heat", "H", api::TouchKind::Heat},
                                           {"cool", "C", api::TouchKind::Heat},
                                           {"grab", "G", api::TouchKind::Hold},
                                           {"push", "", api::TouchKind::Push},
                                           {"stir", "", api::TouchKind::Push}})
      QTest::newRow(brush) << brush << key << static_cast<int>(kind);
  }
  /// One ball for each place of the hand, in the mirror too, as strong as the pen is pressed; none of them draws.
  void ownBrushesTouchMatter() {
    QFETCH(QString, brush);
    QFETCH(QString, key);
    QFETCH(int, kind);
    const PluginRegistry registry{PluginRegistry::Options{}};
    const std::string id = brush.toStdString();
    QVERIFY(registry.needs(id, api::kTouchesMatter) && !registry.needs("sphere", api::kTouchesMatter));
    QCOMPARE(QString::fromStdString(registry.info(id)->key), key);
    StrokeSetup setup;
    setup.radius = 0.07;
    setup.up = {0, 2, 0};
    setup.symmetry = VoxelShape::Symmetry{"x", 1, Vector3(0, 0, 0)};
    std::vector<api::StrokeSample> hand{{{1, 2, 3}, 0.5, 0, {}}, {{1.02, 2, 3}, 1, 0.1, {1, 0, 0}}};
    for (api::StrokeSample& sample : hand) sample.velocity = {200, 0, 10};
    const auto touched = [&](api::EditKind edit) { return touchesOf(*registry.brush(id), setup, edit, hand); };
    const std::vector<api::Touch> touches = touched(api::EditKind::Add), opposite = touched(api::EditKind::Remove);
    QCOMPARE(touches.size(), size_t{4});
    const auto strength = [](const api::Touch& touch) {
      return touch.kind == api::TouchKind::Heat ? touch.power : touch.force;
    };
    for (size_t k = 0; k < 4; ++k) {
      QCOMPARE(static_cast<int>(touches[k].kind), kind);
      QCOMPARE(touches[k].radius, 0.07);
      QCOMPARE(touches[k].centre.x, (k < 2 ? 1 : -1) * hand[k % 2].position.x);
      QCOMPARE(strength(touches[k]), strength(touches[1]) * hand[k % 2].pressure);
      QVERIFY(vectorOf(touches[k].velocity).norm() <= 100);
      QCOMPARE(touches[k].velocity.x > 0, brush == "push" && k < 2);
      QCOMPARE(touches[k].velocity.x < 0, brush == "push" && k >= 2);
      if (brush == "heat" || brush == "cool") QCOMPARE(opposite[k].power, -touches[k].power);
      if (brush == "push") QCOMPARE(opposite[k].velocity.x, -touches[k].velocity.x);
      if (brush == "stir") QCOMPARE(opposite[k].spin.y, -touches[k].spin.y);
    }
    QCOMPARE(strength(touches[0]) > 0, brush != "cool");
    QVERIFY(applyBrush(*registry.brush(id), setup, api::EditKind::Add, hand).empty());
    QVERIFY_EXCEPTION_THROWN(touchesOf(*registry.brush("sphere"), setup, api::EditKind::Add, hand), BrushFault);
  }

  /// A blade across the way of the hand, upright on what it goes along, in the mirror too; a hand that has not moved
  /// has none. A weld is a ball everywhere, and each is the opposite of the other.
  void ownBrushesCutAndWeld() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    StrokeSetup setup;
    setup.radius = 0.07;
    setup.up = {0, 2, 0};
    setup.symmetry = VoxelShape::Symmetry{"x", 1, Vector3(0, 0, 0)};
    const std::vector<api::StrokeSample> hand{{{1, 2, 3}, 1, 0, {}}, {{1.01, 2, 3.01}, 1, 0.1, {0.6, 0, 0.8}}};
    const auto touched = [&](const char* brush, api::EditKind edit) {
      return touchesOf(*registry.brush(brush), setup, edit, hand);
    };
    for (const std::vector<api::Touch>& blades :
         {touched("cut", api::EditKind::Add), touched("weld", api::EditKind::Remove)}) {
      QCOMPARE(blades.size(), size_t{2});
      for (size_t k = 0; k < 2; ++k) {
        QVERIFY(blades[k].kind == api::TouchKind::Cut && blades[k].radius == 0.07);
        const Vector3 normal = vectorOf(blades[k].normal), way(k == 0 ? 0.6 : -0.6, 0, 0.8);
        QVERIFY(std::abs(normal.norm() - 1) < 1e-12 && std::abs(normal.dot(way)) < 1e-12 && normal.y() == 0);
      }
    }
    for (const std::vector<api::Touch>& balls :
         {touched("weld", api::EditKind::Add), touched("cut", api::EditKind::Remove)}) {
      QCOMPARE(balls.size(), size_t{4});
      for (const api::Touch& ball : balls) {
        QVERIFY(ball.kind == api::TouchKind::Weld && ball.radius == 0.07);
        QCOMPARE(vectorOf(ball.normal).norm(), 0.0);
      }
    }
    setup.parameters = {1};
    const std::vector<api::Touch> whole = touched("cut", api::EditKind::Add);
    QCOMPARE(whole.size(), size_t{4});
    QVERIFY(whole[0].kind == api::TouchKind::Cut && vectorOf(whole[0].normal).norm() == 0);
  }

  void keysOfBrushesAreLetters_data() {
    QTest::addColumn<QJsonValue>("key");
    QTest::addColumn<bool>("sound");
    QTest::newRow("a letter") << QJsonValue("H") << true;
    QTest::newRow("a small one") << QJsonValue("h") << false;
    QTest::newRow("two") << QJsonValue("HC") << false;
    QTest::newRow("a digit") << QJsonValue("1") << false;
    QTest::newRow("a number") << QJsonValue(1) << false;
    QTest::newRow("nothing") << QJsonValue("") << false;
  }
  void keysOfBrushesAreLetters() {
    QFETCH(QJsonValue, key);
    QFETCH(bool, sound);
    const QJsonObject own{{"id", "b"},          {"kind", "brush"},  {"api", "0.9"},
                          {"version", "1.0.0"}, {"licence", "MIT"}, {"key", key}};
    PluginInfo info;
    const std::string problem = checkMetadata(QJsonObject{{"IID", PHASESKETCH_BRUSH_IID}, {"MetaData", own}}, info);
    QCOMPARE(problem.empty(), sound);
    if (!sound) QVERIFY(problem.find("one letter of A to Z") != std::string::npos);
  }

  /// A straight tube of radius 5 with a wall of 2: hollow, open, and as long as the stroke.
  void aTubeIsHollowAndTight() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    StrokeSetup setup;
    setup.grid = {{0.5, 0.5, 0.5}, 1.0};
    setup.radius = 5;
    setup.parameters = {0.5, 2};
    const std::vector<api::StrokeSample> raw{{{0.5, 0.5, 0.5}, 1, 0, {}}, {{20.5, 0.5, 0.5}, 1, 1, {}}};
    const CellSet cells =
        applyBrush(*registry.brush("tube"), setup, api::EditKind::Add, resampleStroke(raw, 1.0)).added;
    size_t ring = 0;
    for (int y = -6; y <= 6; ++y)
      for (int z = -6; z <= 6; ++z) ring += std::hypot(y, z) <= 5 && std::hypot(y, z) >= 3 ? 1 : 0;
    QCOMPARE(cells.size(), 21 * ring);  // centres 0 .. 20
    for (int x = 0; x <= 20; ++x)
      for (int y = -2; y <= 2; ++y) QVERIFY(!cells.contains({x, y, 0}));
  }

  /// On a plane that lies between two layers of cells, as the levels of the guides do, a sheet is the layer above,
  /// whichever side one looks at it from, and nothing besides; a row is a thread of it.
  void sheetsOnFacesOfCellsLieAboveThem() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    for (const char* brush : {"plane", "disc", "line"}) {
      for (const double up : {1.0, -1.0}) {
        for (const int level : {0, 3, 37}) {
          StrokeSetup setup;
          setup.grid = {{0.01, 0.01, 0.01}, 0.02};
          setup.radius = 0.1;
          setup.up = {0, up, 0};
          const double y = 0.02 * level;
          const std::vector<api::StrokeSample> raw{{{0.0, y, 0.0}, 1, 0, {}}, {{0.3, y, 0.05}, 1, 1, {}}};
          const CellSet cells =
              applyBrush(*registry.brush(brush), setup, api::EditKind::Add, resampleStroke(raw, 0.02)).added;
          QVERIFY(cells.size() > 20);
          for (const api::Cell& cell : cells.cells())
            QVERIFY2(cell.y == level, qPrintable(QStringLiteral("%1 %2 %3").arg(brush).arg(cell.y).arg(level)));
        }
      }
    }
  }

  /// A tube whose wall fills it is a strand without a pinhole, askew too; one thinner than a cell is a thread.
  void thinAndSolidTubesHaveNoHoles() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    StrokeSetup setup;
    setup.grid = {{0.5, 0.5, 0.5}, 1.0};
    setup.parameters = {0.5, 8};
    const std::vector<api::StrokeSample> askew{{{0.5, 0.5, 0.5}, 1, 0, {}}, {{40.5, 20.5, 30.5}, 1, 1, {}}};
    const auto drawn = [&](double radius, const std::vector<api::StrokeSample>& raw) {
      setup.radius = radius;
      return applyBrush(*registry.brush("tube"), setup, api::EditKind::Add, resampleStroke(raw, 1.0)).added;
    };
    const CellSet strand = drawn(4, askew);
    for (int k = 0; k <= 1000; ++k) {
      const double t = 0.001 * k;
      const api::Cell cell = setup.grid.cellAt({0.5 + 40 * t, 0.5 + 20 * t, 0.5 + 30 * t});
      QVERIFY(strand.contains(cell));
    }
    const CellSet thread = drawn(0.25, {{{0.5, 0.1, 0.1}, 1, 0, {}}, {{12.5, 0.1, 0.1}, 1, 1, {}}});  // off all centres
    for (int x = 0; x <= 12; ++x) QVERIFY(thread.contains({x, 0, 0}));
  }

  /// Where the hand nearly turns back, the fan of a ribbon is filled as well.
  void aRibbonHasNoHolesAtASharpBend() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    StrokeSetup setup;
    setup.grid = {{0.5, 0.5, 0.5}, 1.0};
    setup.radius = 20;
    setup.parameters = {0.5};
    const double bend = 160 * M_PI / 180;
    const std::vector<api::StrokeSample> raw{{{-30, 0.5, 0}, 1, 0, {}},
                                             {{0, 0.5, 0}, 1, 1, {}},
                                             {{30 * std::cos(bend), 0.5, 30 * std::sin(bend)}, 1, 2, {}}};
    const CellSet cells =
        applyBrush(*registry.brush("ribbon"), setup, api::EditKind::Add, resampleStroke(raw, 1.0)).added;
    for (int x = 1; x <= 20; ++x)  // what lies ahead of the bend is the fan's alone
      for (int z = -20; z <= 20; ++z)
        if (std::hypot(x + 0.5, z + 0.5) < 19 && std::atan2(std::abs(z + 0.5), x + 0.5) < 1.2)
          QVERIFY2(cells.contains({x, 0, z}) || cells.contains({x, 0, -1 - z}),
                   qPrintable(QStringLiteral("%1 %2").arg(x).arg(z)));
  }

  /// A ribbon is one cell thick and without a hole: of each column across the sheet it has a cell.
  void aRibbonHasNoHoles() {
    const PluginRegistry registry{PluginRegistry::Options{}};
    StrokeSetup setup;
    setup.grid = {{0.5, 0.5, 0.5}, 1.0};
    setup.radius = 4;
    setup.parameters = {0.5};
    std::vector<api::StrokeSample> raw;
    for (int k = 0; k <= 60; ++k)  // half a circle of radius 20, seen at 60 places only
      raw.push_back({{20 * std::cos(k * M_PI / 60), 0.5, 20 * std::sin(k * M_PI / 60)}, 1, 0.01 * k, {}});
    const CellSet cells =
        applyBrush(*registry.brush("ribbon"), setup, api::EditKind::Add, resampleStroke(raw, 1.0)).added;
    for (int x = -26; x <= 26; ++x)
      for (int z = 2; z <= 26; ++z) {
        const double r = std::hypot(x + 0.5, z + 0.5);
        if (r > 16.8 && r < 23.2)
          QVERIFY2(cells.contains({x, 0, z}), qPrintable(QStringLiteral("%1 %2").arg(x).arg(z)));
        if (r < 15 || r > 25) QVERIFY(!cells.contains({x, 0, z}));
      }
    for (const api::Cell& cell : cells.cells()) QCOMPARE(cell.y, 0);
  }

  void ownBrushesStampWhatTheySay_data() {
    QTest::addColumn<QString>("brush");
    QTest::addColumn<double>("radius");    // in spacings
    QTest::addColumn<double>("rotation");  // rad, cube
    QTest::addColumn<double>("pressure");
    QTest::addColumn<int>("least");
    QTest::addColumn<int>("most");
    // A cube of n spacings holds n^3 cells, wherever it lies.
    QTest::newRow("cube of 4") << "cube" << 2.0 << 0.0 << 1.0 << 64 << 64;
    QTest::newRow("cube of 5") << "cube" << 2.5 << 0.0 << 1.0 << 125 << 125;
    // Turned by 45 degrees, its layers hold the cells of a diamond of area 10 x 10: 100 within the rim's 40 / 2.
    QTest::newRow("turned cube") << "cube" << 5.0 << 0.78539816339744831 << 1.0 << 800 << 1200;
    // A ball of radius 6: 4/3 pi 6^3 = 904.8 cells, within 3 % for a lattice of that size.
    QTest::newRow("ball") << "sphere" << 6.0 << 0.0 << 1.0 << 878 << 932;
    // Half as large at no pressure: radius 3, 113 cells, +-15 %.
    QTest::newRow("light touch") << "sphere" << 6.0 << 0.0 << 0.0 << 96 << 130;
    QTest::newRow("smaller than a cell") << "sphere" << 0.1 << 0.0 << 1.0 << 1 << 1;
    QTest::newRow("small cube") << "cube" << 0.1 << 0.0 << 1.0 << 1 << 1;
    QTest::newRow("particle") << "particle" << 6.0 << 0.0 << 1.0 << 1 << 1;
    // A row, a sheet and a disc are one cell thick: n, n^2, and pi r^2 cells within the rim's.
    QTest::newRow("line of 6") << "line" << 3.0 << 0.0 << 1.0 << 6 << 6;
    QTest::newRow("plane of 6") << "plane" << 3.0 << 0.0 << 1.0 << 36 << 36;
    QTest::newRow("disc") << "disc" << 6.0 << 0.0 << 1.0 << 100 << 126;
  }
  void ownBrushesStampWhatTheySay() {
    QFETCH(QString, brush);
    QFETCH(double, radius);
    QFETCH(double, rotation);
    QFETCH(double, pressure);
    QFETCH(int, least);
    QFETCH(int, most);
    const PluginRegistry registry{PluginRegistry::Options{}};
    const api::BrushPlugin* plugin = registry.brush(brush.toStdString());
    QVERIFY(plugin);
    StrokeSetup setup;
    setup.grid = {{0.013, -0.4, 1.0}, 0.02};
    setup.radius = radius * setup.grid.spacing;
    if (brush == "cube" || brush == "line" || brush == "plane") setup.parameters = {rotation};
    if (brush == "sphere") setup.parameters = {0.5};
    const api::StrokeSample sample{{0.1234, 0.2345, -0.3456}, pressure, 0, {}};
    const StrokeEdits edits = applyBrush(*plugin, setup, api::EditKind::Add, {&sample, 1});
    QVERIFY2(int(edits.added.size()) >= least && int(edits.added.size()) <= most,
             qPrintable(QString::number(edits.added.size())));
    QVERIFY(edits.added.contains(setup.grid.cellAt({0.1234, 0.2345, -0.3456})));
    QVERIFY(edits.removed.empty());
    QCOMPARE(applyBrush(*plugin, setup, api::EditKind::Remove, {&sample, 1}).removed.size(), edits.added.size());
  }

 private:
  void expectOneRefusal(const QString& path, const QString& file, const QString& expected, int loaded = 3) {
    const PluginRegistry registry(only({path.toStdString()}));
    const auto refused = withState(registry, PluginInfo::State::Refused);
    QCOMPARE(refused.size(), size_t(1));
    const QString problem = QString::fromStdString(refused[0].problem);
    if (qEnvironmentVariableIsSet("PS_SHOW_PROBLEMS")) qInfo("%s", qPrintable(problem));
    QVERIFY2(problem.contains(expected), qPrintable(problem));
    QVERIFY2(isOneLine(refused[0].problem), qPrintable(problem));
    QVERIFY2(problem.startsWith(QFileInfo(path + "/" + file).canonicalFilePath()), qPrintable(problem));
    QCOMPARE(int(withState(registry, PluginInfo::State::Loaded).size()), loaded);
  }
};

namespace {

/// The child's work: load, say what became of each plugin.
int loadAndTell(const char* path, bool scans) {
  PluginRegistry::Options options = only({path});
  options.scans = scans;
  const PluginRegistry registry(options);
  for (const PluginInfo& info : registry.plugins())
    std::printf("%s %s %s\n", info.id.c_str(), pluginStateName(info.state), info.problem.c_str());
  return 0;
}

/// As a plugin that runs wild in a step.
int crash(const char* path, bool ending) {
  const PluginRegistry registry(only({path}));
  const CalleeScope callee("fixture.brush");
  if (ending) accuseNobody();
  return std::raise(SIGSEGV);
}

}  // namespace

int main(int argc, char** argv) {
  servePluginScans(argc, argv);
  if (argc == 3 && std::string_view(argv[1]) == "--load") return loadAndTell(argv[2], true);
  if (argc == 3 && std::string_view(argv[1]) == "--load-untried") return loadAndTell(argv[2], false);
  if (argc == 3 && std::string_view(argv[1]) == "--crash") return crash(argv[2], false);
  if (argc == 3 && std::string_view(argv[1]) == "--crash-at-end") return crash(argv[2], true);
  QCoreApplication app(argc, argv);
  TestPluginHost test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_plugin_host.moc"
