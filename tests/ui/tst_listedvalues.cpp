// SPDX-License-Identifier: Apache-2.0
// Rows whose values are no parameters: what a body is made of and held together by, whom a material holds on to, which
// plugins heat the scene or act between neighbours. Each is an edit of the document, which a running engine is told of
// as a whole; tst_declarations has those that reach it as values.
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "tests/shared/menagerie.h"
#include "ui/document/document.h"

#include <QTemporaryDir>
#include <QTest>

#include <set>

using namespace ps;

namespace {

constexpr int kBefore = 3, kAfter = 4;  // frames

std::unique_ptr<PluginRegistry> registry(const QString& folder) {
  PluginRegistry::Options options;
  options.userDirectory = options.environment = false;
  options.extraPaths = {folder.toStdString()};
  return std::make_unique<PluginRegistry>(options);
}

bool isListed(const Address& address) {
  return !adhesionPartner(address).empty() || !pluginBehind(address.key, kHeatSourceKey).empty() ||
         !pluginBehind(address.key, kNeighbourKey).empty() ||
         (address.owner == Owner::Body && (address.key == kBodyMaterialKey || address.key == kStructureKey));
}

Value another(const Value& now, const api::ParameterDeclaration& declaration) {
  if (const bool* on = std::get_if<bool>(&now)) return !*on;
  for (const std::string& choice : choicesOf(declaration)) {
    if (Value(choice) != now) return choice;
  }
  return now;
}

uint64_t hashAfter(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) engine.step();
  return savedHash(engine.particles());
}

}  // namespace

class TestListedValues : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    for (const char* name : {"fixture_source.so", "fixture_neighbour.so"})
      QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/" + name, m_fixtures.filePath(name)));
    m_plugins = registry(m_fixtures.path());
  }

  void eachActsAsItSays_data() {
    QTest::addColumn<QString>("text");
    std::set<std::string> seen;
    const Project project = scenes::menagerie();
    for (const Address& address : allAddresses(project, m_plugins.get())) {
      const std::string kind = adhesionPartner(address).empty() ? address.key : kAdheresKey;
      if (isListed(address) && seen.insert(kind).second)
        QTest::newRow(address.text().c_str()) << QString::fromStdString(address.text());
    }
    QVERIFY2(seen.size() >= 5, qPrintable(QString::number(seen.size())));
  }
  void eachActsAsItSays() {
    QFETCH(QString, text);
    const Address address = *Address::parse(text.toStdString());
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(scenes::menagerie(), {});
    const api::ParameterDeclaration& declaration = *document.declaration(address);
    const Value before = document.value(address), value = another(before, declaration);
    QVERIFY(value != before);
    Engine engine(document.project(), *m_plugins), untouched(document.project(), *m_plugins);
    hashAfter(engine, kBefore);
    const uint64_t begun = hashAfter(untouched, kBefore);
    const std::string whole = writeProject(document.project());

    QCOMPARE(document.setParameter(address, value), QString());
    QVERIFY(document.value(address) == value);
    const Project saved = parseProject(writeProject(document.project()), "scene.json", *m_plugins).project;
    QVERIFY(valueAt(saved, m_plugins.get(), address) == value);
    engine.update(document.project());
    const uint64_t goesOn = hashAfter(engine, kAfter), without = hashAfter(untouched, kAfter);
    // Two materials that never meet, and a fixture that does nothing, do not.
    const bool shows = adhesionPartner(address).empty() && pluginBehind(address.key, kNeighbourKey).empty();
    if (declaration.actsAt == api::ActsAt::NextReset) QCOMPARE(goesOn, without);
    if (declaration.actsAt == api::ActsAt::NextFrame && shows) QVERIFY(goesOn != without);
    Engine born(document.project(), *m_plugins);
    engine.apply(Reset{});
    const uint64_t bornSo = hashAfter(born, kBefore);
    QCOMPARE(hashAfter(engine, kBefore), bornSo);
    if (shows) QVERIFY(bornSo != begun);

    document.undoStack().undo();
    QVERIFY(document.value(address) == before);
    QCOMPARE(writeProject(document.project()), whole);
    document.undoStack().redo();
    QVERIFY(document.value(address) == value);
  }

 private:
  QTemporaryDir m_fixtures;
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_GUILESS_MAIN(TestListedValues)
#include "tst_listedvalues.moc"
