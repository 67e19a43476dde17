// SPDX-License-Identifier: Apache-2.0
// What is copied within a project and between two of them keeps what belongs to it: its keys over time, its group.
#include "core/io/projectio.h"
#include "core/math/responseedit.h"
#include "core/plugin_host/registry.h"
#include "core/scene/group.h"
#include "core/scene/pose.h"
#include "core/scene/track.h"
#include "tests/shared/scenes.h"
#include "ui/document/document.h"
#include "ui/session/excerpt.h"

#include <QtTest/QTest>

#include <memory>

using namespace ps;

namespace {

const SelectedItem kIce{OutlineKind::Body, "ice"}, kSecond{OutlineKind::Body, "second"},
    kThird{OutlineKind::Body, "third"}, kFloor{OutlineKind::Wall, "floor"};

std::vector<TrackKey> keysOf(const Document& document, const std::string& parameter) {
  const Track* track = findTrack(document.project().tracks, parameter);
  return track ? track->keys : std::vector<TrackKey>{};
}

}  // namespace

class TestExcerpts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }
  void init() {
    m_here = made();
    m_there = made();
  }

  /// To another project, as text: under new ids there, those of the scene itself stay behind.
  void tracksComeAlong() {
    QCOMPARE(m_here->putKey({Owner::Body, "ice", "heating_power"}, 1, 50), QString());
    QCOMPARE(m_here->putKey({Owner::Body, "ice", "heating_power"}, 2, 80), QString());
    QCOMPARE(m_here->putKey({Owner::Body, "second", "heating_power"}, 1, 20), QString());
    QCOMPARE(m_here->putKey({Owner::Wall, "floor", "temperature"}, 3, 300), QString());
    QCOMPARE(m_here->putKey({Owner::Environment, "", "ambient_temperature"}, 3, 300), QString());
    const std::string before = text(*m_there);
    const Placement come = carry(*m_here, {kIce, kFloor}, *m_there);
    const std::string ice = come.bodies.at(0).id, floor = come.walls.at(0).id;
    QVERIFY(ice != "ice" && floor != "floor");
    QCOMPARE(m_there->project().tracks.size(), size_t{2});
    QCOMPARE(keysOf(*m_there, "body/" + ice + "/heating_power"), keysOf(*m_here, "body/ice/heating_power"));
    QCOMPARE(keysOf(*m_there, "wall/" + floor + "/temperature"), keysOf(*m_here, "wall/floor/temperature"));
    const std::string after = text(*m_there);
    QCOMPARE(m_there->undoStack().count(), 1);
    m_there->undoStack().undo();
    QCOMPARE(text(*m_there), before);
    m_there->undoStack().redo();
    QCOMPARE(text(*m_there), after);
    // What was pasted is read again as it was saved.
    QCOMPARE(parseProject(after, "again", *m_plugins).project.tracks.size(), size_t{2});
  }

  /// A material that changes over time otherwise is another one; of its curves' points, each has its own keys.
  void tracksOfMaterialsComeWithThem() {
    for (Document* document : {m_here.get(), m_there.get()})
      QCOMPARE(
          document->setParameter({Owner::Material, "water", "viscosity"}, curveThrough({{280, 0.002}, {350, 0.001}})),
          QString());
    const Address point{Owner::Material, "water", "viscosity[1]"};
    QCOMPARE(m_here->putKey(point, 1, 0.0005), QString());
    const Placement changed = carry(*m_here, {kIce}, *m_there);
    const std::string water = changed.bodies.at(0).material;
    QVERIFY(water != "water");
    QCOMPARE(keysOf(*m_there, "material/" + water + "/viscosity[1]"), keysOf(*m_here, point.text()));
    // Once more: it is there by now, and here in any case.
    QCOMPARE(carry(*m_here, {kIce}, *m_there).bodies.at(0).material, water);
    QCOMPARE(carry(*m_here, {kIce}, *m_here).bodies.at(0).material, std::string("water"));
    QCOMPARE(m_here->project().tracks.size(), size_t{1});
  }

  /// A copy of a whole group is a group, with a name of its own.
  void aGroupIsCopiedWhole() {
    group({"body/ice", "body/second", "wall/floor"}, "Table");
    const Placement come = carry(*m_here, {kIce, kSecond, kFloor}, *m_here);
    const std::vector<SceneGroup> groups = livingGroups(m_here->project());
    QCOMPARE(groups.size(), size_t{2});
    QCOMPARE(groups[0].members.size(), size_t{3});
    QCOMPARE(groups[1].name, std::string("Table 2"));
    QCOMPARE(groups[1].members,
             (std::vector<std::string>{"body/" + come.bodies.at(0).id, "body/" + come.bodies.at(1).id,
                                       "wall/" + come.walls.at(0).id}));
    // In another project it comes under its name.
    carry(*m_here, {kIce, kSecond}, *m_there);
    QCOMPARE(livingGroups(m_there->project()).size(), size_t{1});
    QCOMPARE(m_there->project().groups[0].name, std::string("Table"));
    QCOMPARE(m_there->project().groups[0].members.size(), size_t{2});
  }

  /// A leg more of a table is one of its legs, also when it was cut out before.
  void aCopiedMemberStaysInItsGroup() {
    group({"body/ice", "body/second"}, "Table");
    const std::string before = text(*m_here);
    const Placement come = carry(*m_here, {kIce}, *m_here);
    QCOMPARE(livingGroups(m_here->project()).size(), size_t{1});
    QCOMPARE(livingGroups(m_here->project())[0].members.back(), "body/" + come.bodies.at(0).id);
    m_here->undoStack().undo();
    QCOMPARE(text(*m_here), before);
    const std::string clipboard = textOf(excerptOf(m_here->project(), {kIce}));
    QCOMPARE(m_here->removeBody("ice"), QString());
    paste(clipboard, *m_here);
    QCOMPARE(livingGroups(m_here->project()).size(), size_t{1});
    QCOMPARE(livingGroups(m_here->project())[0].members.size(), size_t{2});
    m_here->undoStack().undo();
    m_here->undoStack().undo();
    QCOMPARE(text(*m_here), before);
  }

  /// What is in no group is in none there; a group that was cut comes back under its name.
  void othersAreInNone() {
    group({"body/ice", "body/second"}, "Table");
    carry(*m_here, {kThird}, *m_here);
    QCOMPARE(livingGroups(m_here->project()).size(), size_t{1});
    QCOMPARE(livingGroups(m_here->project())[0].members.size(), size_t{2});
    const std::string clipboard = textOf(excerptOf(m_here->project(), {kIce, kSecond}));
    m_here->removeBody("ice");
    m_here->removeBody("second");
    paste(clipboard, *m_here);
    QCOMPARE(livingGroups(m_here->project()).size(), size_t{1});
    QCOMPARE(livingGroups(m_here->project())[0].name, std::string("Table"));
  }

 private:
  std::unique_ptr<Document> made() {
    auto document = std::make_unique<Document>();
    document->setPlugins(m_plugins.get());
    Project project = scenes::iceOnPlate(3, 370);
    project.bodies.push_back(scenes::block("second", 2, 0.03, {0, 0.5, 0}, 263.15));
    project.bodies.push_back(scenes::block("third", 2, 0.03, {0, 0.7, 0}, 263.15));
    document->open(project, {}, false, false);
    return document;
  }
  static std::string text(const Document& document) { return writeProject(document.project()); }
  void group(std::vector<std::string> members, const char* name) {
    m_here->renameGroup(m_here->addGroup(std::move(members)), QString::fromLatin1(name));
  }
  Placement paste(const std::string& clipboard, Document& to) {
    return to.insertThings(excerptIn(clipboard, *m_plugins), QStringLiteral("pasting"));
  }
  Placement carry(const Document& from, const std::vector<SelectedItem>& items, Document& to) {
    return paste(textOf(excerptOf(from.project(), items)), to);
  }

  std::unique_ptr<PluginRegistry> m_plugins;
  std::unique_ptr<Document> m_here, m_there;
};

QTEST_GUILESS_MAIN(TestExcerpts)
#include "tst_excerpts.moc"
