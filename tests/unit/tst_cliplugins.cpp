// SPDX-License-Identifier: Apache-2.0
// What the built program does with plugins that fail, crash or do not come back.
#include "tests/unit/clirun.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

class TestCliPlugins : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void pluginsThatFailAtTheEndAreTold();
  void pluginsThatCrashInAStepAreQuarantined();
  void pluginsThatDoNotComeBackAreNamed();
  void pluginsAreTried_data();
  void pluginsAreTried();
};

namespace {

const QStringList kFixtureScene =
    smallScene({"--frames", "2", "--set", "bodies/ice/constraints=[{\"plugin\": \"fixture.constraint\"}]"});

}  // namespace

void TestCliPlugins::pluginsThatFailAtTheEndAreTold() {
  for (const char* what : {"energy", "limits"}) {
    const QTemporaryDir folder;
    QVERIFY(place(folder, "constraint", QStringLiteral("throwing_") + what));
    const Ran ran = cli(kFixtureScene, folder.path());
    QCOMPARE(ran.code, 1);
    QVERIFY2(ran.err.contains(QByteArray("plugin_fault: plugin 'fixture.constraint': no ") + what),
             ran.err.constData());
  }
}

void TestCliPlugins::pluginsThatCrashInAStepAreQuarantined() {
  const QTemporaryDir folder;
  QVERIFY(place(folder, "constraint", "aborting_step"));
  qputenv("XDG_STATE_HOME", folder.filePath("state").toUtf8());
  QCOMPARE(cli(kFixtureScene, folder.path()).code, -1);
  const Ran list = cli({"plugins"}, folder.path());
  const Ran again = cli(kFixtureScene, folder.path());
  const Ran allowed = cli({"plugins", "--allow", "fixture.constraint"}, folder.path());
  const Ran after = cli({"plugins"}, folder.path());
  qunsetenv("XDG_STATE_HOME");
  QVERIFY2(list.out.contains("quarantined") && list.out.contains("it crashed the program, or did not come back"),
           list.out.constData());
  QVERIFY2(again.code >= 0, "it crashed once more");
  QCOMPARE(allowed.code, 0);
  QVERIFY2(!after.out.contains("quarantined"), after.out.constData());
}

void TestCliPlugins::pluginsThatDoNotComeBackAreNamed() {
  const QTemporaryDir folder;
  QVERIFY(place(folder, "constraint", "endless_step"));
  qputenv("XDG_STATE_HOME", folder.filePath("state").toUtf8());
  const Ran run = cli(kFixtureScene + QStringList{"--patience", "1"}, folder.path());
  const Ran list = cli({"plugins"}, folder.path());
  const Ran again = cli(kFixtureScene, folder.path());
  const Ran tried = cli({"plugins", "--check", folder.filePath("endless_step.so"), "--patience", "1.5"});
  qunsetenv("XDG_STATE_HOME");
  QCOMPARE(run.code, 3);
  QVERIFY2(run.err.contains("the plugin 'fixture.constraint' did not come back within 1 s"), run.err.constData());
  QVERIFY2(list.out.contains("quarantined"), list.out.constData());
  QVERIFY2(again.code == 0 && again.err.contains("fixture.constraint"), again.err.constData());
  QCOMPARE(tried.code, 3);
  QVERIFY2(tried.err.contains("endless_step.so: it did not come back within 1.5 s when it ran in a scene"),
           tried.err.constData());
}

void TestCliPlugins::pluginsAreTried_data() {
  QTest::addColumn<QString>("fixture");
  QTest::addColumn<QString>("name");
  QTest::addColumn<int>("code");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* fixture, const char* name, int code, const char* says) {
    QTest::newRow(name) << fixture << name << code << says;
  };
  row("constraint", "sound", 0, ": fine: constraint 'fixture.constraint' 1.2.3, Fixture");
  row("neighbour", "sound_neighbour", 0, ": fine: constraint 'fixture.neighbour'");
  row("source", "sound_source", 0, ": fine: heat_source 'fixture.source'");
  row("material", "sound_material", 0, ": fine: material 'fixture.material'");
  row("brush", "seeing_brush", 0, ": fine: brush 'fixture.brush'");
  row("constraint", "wide_constraint", 1, "2 to 4 particles, not 9");
  row("constraint", "nan_constraint", 1, "plugin 'fixture.constraint' moved it");
  row("constraint", "throwing_topology", 1, "no more bonds");
  row("constraint", "throwing_energy", 1, "no energy");
  row("constraint", "aborting_step", 1, "it crashed (Aborted) when it ran in a scene of ten frames");
  row("material", "aborting", 1, "it crashed (Aborted) when it was loaded");
  row("plain", "plain", 1, "it is not a plugin");
}
void TestCliPlugins::pluginsAreTried() {
  QFETCH(QString, fixture);
  QFETCH(QString, name);
  QFETCH(int, code);
  QFETCH(QString, says);
  const QTemporaryDir folder;
  QVERIFY(place(folder, fixture, name));
  const Ran ran = cli({"plugins", "--check", folder.filePath(name + ".so")});
  QVERIFY2(ran.code == code, (ran.out + ran.err).constData());
  const QByteArray told = code == 0 ? ran.out : ran.err;
  QVERIFY2(told.contains(says.toUtf8()) && told.contains((name + ".so").toUtf8()), told.constData());
  QVERIFY(!told.contains("/phasesketch-check-"));
}

QTEST_APPLESS_MAIN(TestCliPlugins)
#include "tst_cliplugins.moc"
