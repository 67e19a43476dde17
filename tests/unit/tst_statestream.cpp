// SPDX-License-Identifier: Apache-2.0
// The stream of state: what is written comes back, its hash is that of its bytes, and no bytes whatever do harm.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/particles/neighbours.h"

#include <QTest>

#include <cstring>
#include <numeric>

using ps::InputError;
using ps::StateBuffer;
using ps::StateReader;
using ps::StateType;
using ps::StateWriter;

namespace {

using Bytes = std::vector<std::byte>;

Bytes bytesOf(const StateBuffer& buffer) { return {buffer.bytes().begin(), buffer.bytes().end()}; }

const std::vector<std::string> kTexts = {"", "ice", "a name with \n and ü"};
const std::vector<uint8_t> kOdd = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};

void writeSample(ps::StateSink& sink) {
  StateWriter writer(sink);
  writer.value("room/one", uint64_t{7});
  writer.array("room/odd", kOdd);
  writer.texts("room/texts", kTexts);
  writer.open({"room", "pieces"}, StateType::Float32, 3);
  for (const float f : {1.5f, -0.0f, 3.0f}) writer.put(f);
  writer.close();
  writer.array("room/none", std::vector<double>{});
  writer.value("room/later", 2.5, 3);
  writer.finish();
}

Bytes sample() {
  StateBuffer buffer;
  writeSample(buffer);
  return bytesOf(buffer);
}

/// "" when it can be read, else what the error says.
QString problemOf(const Bytes& bytes) {
  try {
    const StateReader reader(bytes);
    reader.value<uint64_t>("room/one");
    reader.array<uint8_t>("room/odd", kOdd.size(), 1);
    reader.texts("room/texts");
    reader.array<float>("room/pieces");
  } catch (const InputError& problem) {
    return QString::fromUtf8(problem.what());
  }
  return {};
}

/// Some particles with a field of somebody's own, in disorder.
void fill(ps::ParticleStore& store) {
  store.declare("org.example.rust", ps::api::FieldType::Float64, "m", "depth");
  store.add(40);
  auto* rust = static_cast<double*>(store.find("org.example.rust", ps::api::FieldType::Float64));
  for (size_t i = 0; i < store.size(); ++i) {
    const float k = static_cast<float>(i);
    store.position()[i] = {0.013f * k, 0.001f * static_cast<float>((i * 7) % 5), 0, 1e-6f};
    rust[i] = 0.1 * k;
  }
  const std::vector<uint32_t> gone = {3, 4, 20};
  store.remove(gone);
  std::vector<uint32_t> order(store.size());
  std::iota(order.rbegin(), order.rend(), 0u);
  store.permute(order);
}

Bytes saved(const ps::ParticleStore& store) {
  StateBuffer buffer;
  saveTo(buffer, store);
  return bytesOf(buffer);
}

}  // namespace

class TestStateStream : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsWrittenComesBack() {
    const Bytes bytes = sample();
    const StateReader reader(bytes);
    QCOMPARE(reader.blocks().size(), size_t{6});
    QCOMPARE(reader.value<uint64_t>("room/one"), uint64_t{7});
    QVERIFY(reader.array<uint8_t>("room/odd") == kOdd);
    QVERIFY(reader.texts({"room", "texts"}) == kTexts);
    QVERIFY((reader.array<float>("room/pieces") == std::vector<float>{1.5f, -0.0f, 3.0f}));
    QVERIFY(reader.array<double>("room/none").empty());
    QCOMPARE(reader.value<double>("room/later", 3), 2.5);
    QVERIFY(reader.has("room/later") && !reader.has("room/earlier"));
  }

  void theHashIsThatOfTheBytes() {
    ps::StateHash hash;
    writeSample(hash);
    const Bytes bytes = sample();
    ps::Hash whole;
    whole.add(bytes.data(), bytes.size());
    QCOMPARE(hash.value(), whole.value());
  }

  void aBlockKeepsItsWord() {
    StateBuffer buffer;
    StateWriter writer(buffer);
    writer.open("short", StateType::UInt32, 2);
    writer.put(uint32_t{1});
    QVERIFY_THROWS_EXCEPTION(ps::Error, writer.close());
    writer.put(uint32_t{2});
    QVERIFY_THROWS_EXCEPTION(ps::Error, writer.put(uint32_t{3}));
  }

  void wrongRequestsAreRefusedByName_data() {
    QTest::addColumn<QString>("message");
    QTest::newRow("missing") << "state block 'room/gone': is missing";
    QTest::newRow("type") << "state block 'room/one': has elements of type uint64, not float64";
    QTest::newRow("version") << "state block 'room/later': is of version 3, and this program reads up to 1";
    QTest::newRow("count") << "state block 'room/odd': has 11 elements, not 12";
    QTest::newRow("runs") << "state block 'room/pieces': has 3 elements, too few";
    QTest::newRow("left over") << "state block 'room/pieces': has 3 elements where 2 are told";
  }
  void wrongRequestsAreRefusedByName() {
    QFETCH(QString, message);
    const QString row = QTest::currentDataTag();
    const Bytes bytes = sample();
    const StateReader reader(bytes);
    QString told;
    try {
      if (row == "missing") reader.value<double>("room/gone");
      if (row == "type") reader.value<double>("room/one");
      if (row == "version") reader.value<double>("room/later");
      if (row == "count") reader.array<uint8_t>("room/odd", 12, 1);
      ps::StateRuns<float> runs(reader, "room/pieces");
      runs.next(2);
      if (row == "runs") runs.next(2);
      runs.done();
    } catch (const InputError& problem) {
      told = QString::fromUtf8(problem.what());
    }
    QCOMPARE(told, message);
  }

  /// Whatever is cut off or overwritten is told, or changes a value and nothing else.
  void damageIsToldOrHarmless() {
    const Bytes whole = sample();
    QCOMPARE(problemOf(whole), QString());
    for (size_t length = 0; length < whole.size(); ++length) {
      const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
      QVERIFY2(!problemOf(cut).isEmpty(), qPrintable(QString("cut at %1").arg(length)));
    }
    Bytes longer = whole;
    longer.resize(whole.size() + 8);
    QCOMPARE(problemOf(longer), QString("the state goes on behind its end"));
    for (size_t at = 0; at < whole.size(); ++at) {
      for (const int value : {0x00, 0x01, 0x7f, 0xff}) {
        Bytes damaged = whole;
        damaged[at] = static_cast<std::byte>(value);
        problemOf(damaged);
      }
    }
    Bytes newer = whole;
    newer[8] = std::byte{2};
    QCOMPARE(problemOf(newer), QString("the state is of format 2, and this program reads format 1"));
    Bytes other = whole;
    other[0] = std::byte{'{'};
    QCOMPARE(problemOf(other), QString("this is no saved state"));
  }

  void aStoreComesBackAsItWas() {
    ps::ParticleStore store, other;
    fill(store);
    other.declare("later", ps::api::FieldType::Float32);
    other.add(3);
    const Bytes bytes = saved(store);
    other.restore(StateReader(bytes));
    QCOMPARE(other.size(), size_t{37});
    for (const uint32_t id : {0u, 19u, 39u}) QCOMPARE(other.indexOf(id), store.indexOf(id));
    QCOMPARE(other.indexOf(20), other.size());
    const auto* rust = static_cast<double*>(other.find("org.example.rust", ps::api::FieldType::Float64));
    QVERIFY(rust && rust[other.indexOf(30)] == 0.1 * 30);
    QCOMPARE(other.position()[other.size()].x, store.position()[store.size()].x);  // the dummy is far away
    ps::ParticleStore same;
    same.restore(StateReader(bytes));
    QVERIFY(saved(same) == bytes);
    QCOMPARE(other.add(1), size_t{37});  // the next number is a fresh one
    QCOMPARE(other.id()[37], 40u);
    QCOMPARE(static_cast<float*>(other.find("later", ps::api::FieldType::Float32))[37], 0.0f);
  }

  /// No damage of a store's bytes does harm: it is told, or it is matter elsewhere.
  void aDamagedStoreIsToldOrHarmless() {
    ps::ParticleStore store;
    fill(store);
    const Bytes whole = saved(store);
    int told = 0;
    for (size_t at = 0; at < whole.size(); ++at) {
      Bytes damaged = whole;
      damaged[at] = std::byte{0xee};
      try {
        ps::ParticleStore other;
        other.restore(StateReader(damaged));
        QVERIFY(other.size() == store.size());
      } catch (const InputError&) {
        ++told;
      }
    }
    QVERIFY(told > 100);
  }

  void fieldsOfEarlierVersionsAreLeftOut() {
    ps::ParticleStore former, store;
    former.declare("lambda", ps::api::FieldType::Float32, "J", "of an earlier version");
    former.declare("charge", ps::api::FieldType::Float32, "C", "of a plugin");
    former.add(5);
    StateBuffer buffer;
    StateWriter writer(buffer);
    former.save(writer);
    writer.finish();
    store.restore(StateReader(buffer.bytes()));
    QCOMPARE(store.size(), size_t{5});
    QVERIFY(store.find("lambda", ps::api::FieldType::Float32) == nullptr);
    QVERIFY(store.find("charge", ps::api::FieldType::Float32) != nullptr);
  }

  /// More than is copied at once.
  void buffersGrowAndAreMoved() {
    std::vector<uint64_t> numbers(200000);
    for (size_t k = 0; k < numbers.size(); ++k) numbers[k] = 0x9e3779b97f4a7c15u * (k + 1);
    const auto holds = [&](const StateBuffer& buffer, size_t times) {
      const size_t bytes = numbers.size() * sizeof(uint64_t);
      bool same = buffer.bytes().size() == times * bytes;
      for (size_t k = 0; same && k < times; ++k)
        same = std::memcmp(buffer.bytes().data() + k * bytes, numbers.data(), bytes) == 0;
      return same;
    };
    StateBuffer first, second;
    for (int k = 0; k < 3; ++k) first.add(numbers.data(), numbers.size() * sizeof(uint64_t));
    second.add(numbers.data(), numbers.size() * sizeof(uint64_t));
    QVERIFY(holds(first, 3) && holds(second, 1));
    second = std::move(first);
    QVERIFY(holds(second, 3));
    first = StateBuffer();
    first.add(numbers.data(), numbers.size() * sizeof(uint64_t));
    QVERIFY(holds(first, 1));
  }

  /// Lists made from some moved places follow from those, not from where particles are by now.
  void listsAreMadeAgain() {
    ps::ParticleStore store;
    fill(store);
    ps::Neighbours neighbours, again;
    for (ps::Neighbours* n : {&neighbours, &again}) n->configure(0.04, 0.01);
    neighbours.sortAndBuild(store);
    for (size_t i = 0; i < store.size(); ++i) store.position()[i].x += i % 2 == 0 ? 0.004f : -0.004f;
    neighbours.build(store);
    for (size_t i = 0; i < store.size(); ++i) store.position()[i].x -= i % 2 == 0 ? 0.004f : -0.004f;
    StateBuffer buffer;
    StateWriter writer(buffer);
    neighbours.save(writer, true);
    writer.finish();
    again.restore(StateReader(buffer.bytes()), store);
    const ps::api::NeighbourView a = neighbours.view(), b = again.view();
    for (size_t i = 0; i < store.size(); ++i)
      QVERIFY(std::equal(a.index + a.begin[i], a.index + a.end[i], b.index + b.begin[i], b.index + b.end[i]));
  }
};

QTEST_APPLESS_MAIN(TestStateStream)
#include "tst_statestream.moc"
