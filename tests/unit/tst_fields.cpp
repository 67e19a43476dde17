// SPDX-License-Identifier: Apache-2.0
// What one row of a table of fields brings: reading, writing, the schema and what visitors see.
#include "core/io/fieldkinds.h"

#include <QTest>

using namespace ps;
using fields::Json;

namespace {

/// A type of its own, so that the mechanism is tested and not what projects hold.
struct Part {
  std::string id;
  Unknown unknown{};
};
struct Thing {
  double size = 2;
  std::string material;
  Vector3 point{0, 0, 0};
  std::vector<Part> parts;
  std::optional<Part> lid;
  Unknown unknown{};
};

const fields::FieldTable<Part>& partFields() {
  static const fields::FieldTable<Part> table{.help = "a part",
                                              .rows = {fields::field("id", &Part::id, fields::Id{}, "").required()},
                                              .unknown = &Part::unknown};
  return table;
}

const fields::FieldTable<Thing>& thingFields() {
  using namespace fields;
  static const FieldTable<Thing> table{.help = "a thing",
                                       .rows = {field("size", &Thing::size, Number{1, 10, "m"}, "edge"),
                                                field("material", &Thing::material, MaterialId{}, "").required(),
                                                field("point", &Thing::point, Vector{"m"}, "").always(),
                                                field("parts", &Thing::parts, List{Object{partFields()}}, ""),
                                                field("lid", &Thing::lid, Optional{Object{partFields()}}, "")},
                                       .unknown = &Thing::unknown};
  return table;
}

class Seen : public FieldVisitor {
 public:
  void material(const std::string& id, const std::string& pointer) override { all.push_back(pointer + "=" + id); }
  void repeatedId(const std::string& id, const std::string& pointer) override { all.push_back(pointer + "=" + id); }
  std::vector<std::string> all;
};

}  // namespace

class TestFields : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    PluginRegistry::Options options;
    options.builtIn = options.userDirectory = options.environment = false;
    m_plugins = std::make_unique<PluginRegistry>(options);
  }

  void defaultsAreLeftOutUnlessRequired() {
    QCOMPARE(thingFields().write(Thing()).dump(), std::string(R"({"material":"","point":[0,0,0]})"));
    Thing changed;
    changed.size = 3;
    changed.parts = {{"a"}};
    changed.lid = Part{"b"};
    QCOMPARE(thingFields().write(changed).dump(),
             std::string(R"({"lid":{"id":"b"},"material":"","parts":[{"id":"a"}],"point":[0,0,0],"size":3})"));
  }

  void whatIsReadIsWrittenAgain() {
    const std::string text = R"({"later":[1],"lid":{"id":"b","x":1},"material":"m","own":{"y":2},)"
                             R"("parts":[{"id":"a"},{"id":"c","z":null}],"point":[1,2,3],"size":2.5})";
    Json document = Json::parse(text);
    Thing thing;
    thingFields().read(thing, document, *m_plugins);
    QVERIFY(document.empty());
    QCOMPARE(thing.size, 2.5);
    QCOMPARE(thing.parts.at(1).id, std::string("c"));
    QCOMPARE(thing.point[2], 3.0);
    QCOMPARE(thingFields().write(thing).dump(), text);
  }

  void theSchemaSaysWhatTheRowSays() {
    const Json schema = thingFields().schema();
    QCOMPARE(schema.at("required").dump(), std::string(R"(["material"])"));
    QCOMPARE(
        schema.at("properties").at("size").dump(),
        std::string(R"({"default":2,"description":"edge","maximum":10,"minimum":1,"type":"number","x-unit":"m"})"));
    QVERIFY(!schema.at("properties").at("material").contains("default"));
    QVERIFY(schema.at("properties").contains("lid"));
  }

  void visitorsSeeWhatAValueStandsFor() {
    Thing thing;
    thing.material = "water";
    thing.parts = {{"a"}, {"b"}, {"a"}};
    Seen seen;
    thingFields().visit(thing, "/things/0", seen);
    QCOMPARE(seen.all, (std::vector<std::string>{"/things/0/material=water", "/things/0/parts/2/id=a"}));
  }

 private:
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_GUILESS_MAIN(TestFields)
#include "tst_fields.moc"
