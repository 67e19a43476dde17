// SPDX-License-Identifier: Apache-2.0
// A project for others: it brings its own materials along, and comes to the same elsewhere, or says what differs.
#include "clirun.h"
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/experiments/sharing.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "tests/shared/scenes.h"

#include <QTest>

using namespace ps;

class TestSharing : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aCopyComesToTheSame();
  void ownMaterialsAreWrittenOut();
  void whatDiffersIsSaid();
  void whatPeopleLookAtChangesNoScene();
  void itCanBeGivenUp();
  void theCommandLineSharesAndChecks();

 private:
  PluginRegistry m_plugins;
};

namespace {
constexpr uint64_t kFrames = 20;
}  // namespace

void TestSharing::aCopyComesToTheSame() {
  SharedCopy copy = copyForSharing(scenes::iceOnPlate(4, 400), m_plugins);
  QVERIFY(copy.written.empty() && copy.needed.empty());
  copy.project.end = runToEnd(copy.project, m_plugins, kFrames, "phasesketch 1");
  copy.project.thumbnail = "iVBORw0KGgo=";
  QCOMPARE(copy.project.end->frame, kFrames);
  QCOMPARE(copy.project.end->particles, uint64_t{64});
  const LoadedProject read = parseProject(writeProject(copy.project), "copy.json", m_plugins);
  QVERIFY(read.warnings.empty());
  QCOMPARE(read.project.thumbnail, copy.project.thumbnail);
  QVERIFY(read.project.end);
  QCOMPARE(differences(*read.project.end, runToEnd(read.project, m_plugins, kFrames, "phasesketch 1")), std::string());
  const Project again = copyForSharing(read.project, m_plugins).project;
  QCOMPARE(again.end.has_value(), false);
  QCOMPARE(again.thumbnail, copy.project.thumbnail);  // the picture that it has is its own
}

/// A material that this machine alone has: the copy opens without it, and runs to the same bits.
void TestSharing::ownMaterialsAreWrittenOut() {
  QTemporaryDir folder;
  QFile wax(PS_SOURCE_DIR "/plugins/materials/wax.json");
  QVERIFY(wax.open(QIODevice::ReadOnly));
  QByteArray own = wax.readAll();
  const qsizetype id = own.indexOf("\"wax\"");
  QVERIFY(id > 0);
  own.replace(id, 5, "\"candlewax\"");
  QFile file(folder.filePath("candlewax.json"));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(own) == own.size());
  file.close();
  PluginRegistry::Options options;
  options.extraPaths = {folder.path().toStdString()};
  PluginRegistry here(options);
  QVERIFY(here.has("candlewax"));

  Project project = scenes::iceOnPlate(4, 400);
  project.materials.front().base = "candlewax";
  project.materials.front().label = {};
  project.materials.front().properties.values["latent_heat_fusion"] = 150e3;
  const RunEnd end = runToEnd(project, here, kFrames, "");
  const SharedCopy copy = copyForSharing(project, here);
  QCOMPARE(copy.written, std::vector<std::string>{"water"});
  QVERIFY(copy.needed.empty());
  const LoadedProject read = parseProject(writeProject(copy.project), "copy.json", m_plugins);
  for (const ProjectMessage& warning : read.warnings)  // of what acts once heat radiates
    QVERIFY2(warning.text.find("does nothing as the scene is") != std::string::npos, warning.text.c_str());
  const RunEnd elsewhere = runToEnd(read.project, m_plugins, kFrames, "");
  QCOMPARE(elsewhere.hash, end.hash);
  QCOMPARE(elsewhere.temperature, end.temperature);

  // The copy says something of matter: with another latent heat it would not come to this.
  Project other = read.project;
  other.materials.front().properties.values["latent_heat_fusion"] = 90e3;
  other.materials.front().properties.values["heat_capacity_solid"] = 900.0;
  QVERIFY(runToEnd(other, m_plugins, kFrames, "").hash != end.hash);
}

void TestSharing::whatDiffersIsSaid() {
  const Project project = scenes::iceOnPlate(4, 400);
  const RunEnd noted = runToEnd(project, m_plugins, kFrames, "phasesketch 1");
  const auto told = [&](const RunEnd& found) { return QString::fromStdString(differences(noted, found)); };
  const RunEnd other = runToEnd(scenes::iceOnPlate(4, 450), m_plugins, kFrames, "phasesketch 2");
  QVERIFY2(told(other).startsWith("the project has been changed since its end was noted; it was run by phasesketch 1; "
                                  "mean temperature "),
           qPrintable(told(other)));
  QVERIFY(told(other).contains(" K instead of ") &&
          told(other).endsWith(" instead of " + QString::fromStdString(noted.hash) + ")"));
  RunEnd close = noted;
  close.hash = "0123456789abcdef";
  QVERIFY2(told(close).startsWith("particles, heat and motion are the same to six digits, and the state differs in "
                                  "digits beyond (state hash 0123"),
           qPrintable(told(close)));
  RunEnd fewer = close;
  fewer.particles = 63;
  QVERIFY2(told(fewer).startsWith("particles: 63 instead of 64 (state hash "), qPrintable(told(fewer)));
  RunEnd later = noted;
  later.frame = kFrames + 1;
  QVERIFY(told(later).startsWith("it begins after the frame of its end, 20"));
}

void TestSharing::whatPeopleLookAtChangesNoScene() {
  const Project project = scenes::iceOnPlate(4, 400);
  Project seen = project;
  seen.title = "Another";
  seen.markers.push_back({1, "now"});
  seen.view.colour = "speed";
  seen.thumbnail = "abcd";
  seen.end = RunEnd{};
  QCOMPARE(sceneHash(seen), sceneHash(project));
  Project changed = project;
  changed.environment.gravity = {0, -1.62, 0};
  QVERIFY(sceneHash(changed) != sceneHash(project));
  changed = project;
  changed.solver.parameters.values["iterations"] = 7.0;
  QVERIFY(sceneHash(changed) != sceneHash(project));
}

void TestSharing::itCanBeGivenUp() {
  Progress progress;
  const ProgressScope scope(&progress);
  progress.cancel();
  QVERIFY_EXCEPTION_THROWN(runToEnd(scenes::iceOnPlate(4, 400), m_plugins, kFrames, ""), Cancelled);
}

void TestSharing::theCommandLineSharesAndChecks() {
  QTemporaryDir folder;
  const QString copy = folder.filePath("copy.json");
  QStringList share = smallScene({"--frames", "5", "--out", copy});
  share[0] = QStringLiteral("share");
  Ran ran = cli(share);
  QVERIFY2(ran.code == 0, ran.err.constData());
  QVERIFY2(ran.out.contains(": its run ends at frame 5, state hash "), ran.out.constData());
  ran = cli({"share", "--check", copy, "--threads", "2"});
  QVERIFY2(ran.code == 0, ran.err.constData());
  QVERIFY2(ran.out.contains("copy.json: reproduced: after 5 frames the state is the same, hash "), ran.out.constData());
  ran = cli({"share", "--check", copy, "--set", "environment/gravity=[0, -1, 0]"});
  QCOMPARE(ran.code, 1);
  QVERIFY2(ran.err.contains("not reproduced: the project has been changed since"), ran.err.constData());
  ran = cli({"share", "--check", kSample});
  QCOMPARE(ran.code, 2);
  QVERIFY2(ran.err.contains("/end: is missing"), ran.err.constData());
  QCOMPARE(cli({"share", kSample}).code, 2);
}

QTEST_GUILESS_MAIN(TestSharing)
#include "tst_sharing.moc"
