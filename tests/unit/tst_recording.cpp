// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/particlefield.h"
#include "tests/shared/scenes.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <cstring>

using namespace ps;

class TestRecording : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void framesReadBack();
  void cutOffRecordingsKeepTheirFrames();
  void damagedFramesAreRefused();
  void framesThatCannotBeDrawnAreRefused();
  void everyBitOfTheHeaderIsGuarded();
  void projectsThatNoHeaderHoldsAreRefused();
  void whatOnlyPeopleSeeMakesNoOtherScene();
  void brokenHeadersAreRefused_data();
  void brokenHeadersAreRefused();
};

namespace {

constexpr size_t kParticles = 37, kFrames = 3;

const PluginRegistry& plugins() {
  static const PluginRegistry all;
  return all;
}

Snapshot snapshotOf(size_t frame) {
  Snapshot s;
  s.stats.frame = frame;
  s.stats.time = 0.1 * static_cast<double>(frame);
  s.stats.thermalTime = 600 * s.stats.time;
  s.revision = 7;
  s.spacing = 0.02;
  static const auto kBodies = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"ice", "lamp"});
  s.bodyIds = kBodies;
  s.materialIds = {"water", "wax"};
  s.limits = {{.what = "water.youngs_modulus", .asked = 2, .delivered = 1, .unit = "Pa", .kelvin = {{270, 300}}}};
  s.stats.heat.walls = 12.5;
  s.materialLook = {{0.1f, 0.2f, 0.3f, 0.4f}, {1, 0, 1, 0}};
  for (size_t i = 0; i < kParticles; ++i) {
    const float x = static_cast<float>(i) + 0.01f * static_cast<float>(frame);
    s.position.push_back({x, -x, 1 / (x + 1), 0.01f});
    s.temperature.push_back(263.15f + x);
    s.speed.push_back(x * x);
    s.densityError.push_back(0.001f * x);
    s.gasFraction.push_back(x / kParticles);
    s.phase.push_back(static_cast<api::Phase>(i % 5));
    s.motion.push_back(static_cast<api::Motion>(i % 4));
    s.id.push_back(static_cast<uint32_t>(i * 3));
    s.body.push_back(static_cast<uint32_t>(i % 2));
    s.material.push_back(static_cast<uint32_t>(i % 2));
  }
  const ParticleField field{
      .name = "org.example.rust.depth", .label = "Depth of rust", .unit = "m", .minimum = 0, .maximum = 1e-3};
  FieldValues rust{std::make_shared<const ParticleField>(field), {}};
  for (size_t i = 0; i < kParticles; ++i) rust.values.push_back(1e-5f * static_cast<float>(i + frame));
  s.fields.push_back(std::move(rust));
  return s;
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

QByteArray recorded(const QString& path) {
  RecordingWriter writer(path.toStdString(), scenes::iceOnPlate(2, 400));
  for (size_t frame = 0; frame < kFrames; ++frame) writer.add(snapshotOf(frame));
  writer.finish();
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

}  // namespace

void TestRecording::framesReadBack() {
  QTemporaryDir folder;
  const QString path = folder.filePath("run.psrec");
  QVERIFY(!recorded(path).isEmpty());
  QVERIFY(!QFile::exists(path + ".part"));
  QVERIFY(isRecording(path.toStdString()) && !isRecording(folder.path().toStdString()));
  RecordingReader reader(path.toStdString(), plugins());
  QCOMPARE(reader.frameCount(), kFrames);
  QVERIFY(reader.damage().empty());
  QVERIFY(reader.projectText().find("Ice on a plate") != std::string::npos);
  for (size_t frame : {size_t{2}, size_t{0}, size_t{1}}) {
    const SnapshotPtr got = reader.frame(frame);
    const Snapshot expected = snapshotOf(frame);
    QCOMPARE(got->stats.frame, expected.stats.frame);
    QCOMPARE(got->stats.time, expected.stats.time);
    QCOMPARE(got->stats.heat.walls, expected.stats.heat.walls);
    QVERIFY(*got->bodyIds == *expected.bodyIds && got->materialIds == expected.materialIds);
    QCOMPARE(got->limits.size(), size_t{1});
    QVERIFY(got->limits[0].what == expected.limits[0].what && got->limits[0].kelvin == expected.limits[0].kelvin);
    for (size_t i = 0; i < kParticles; ++i) {  // to half a step: see FramePacker
      QVERIFY(std::abs(got->position[i].x - expected.position[i].x) < 1e-3F);
      QVERIFY(std::abs(got->temperature[i] - expected.temperature[i]) < 0.0251F);
      QVERIFY(std::abs(got->speed[i] - expected.speed[i]) <= std::sqrt(expected.speed[i] * 0.0315F) + 0.01F);
      QVERIFY(std::abs(got->gasFraction[i] - expected.gasFraction[i]) < 5e-3F);
    }
    QVERIFY(sameBytes(got->phase, expected.phase) && sameBytes(got->motion, expected.motion));
    QVERIFY(sameBytes(got->id, expected.id) && sameBytes(got->body, expected.body));
    QVERIFY(sameBytes(got->material, expected.material));
    QVERIFY(sameBytes(got->materialLook, expected.materialLook));
    QCOMPARE(got->fields.size(), size_t{1});
    const ParticleField& rust = *got->fields[0].field;
    QVERIFY(rust.name == "org.example.rust.depth" && rust.label == "Depth of rust" && rust.unit == "m");
    QVERIFY(rust.minimum == 0 && rust.maximum == 1e-3);
    QVERIFY(std::abs(ShownField(*got, rust.name)[5] - expected.fields[0].values[5]) < 5e-8F);
  }
}

void TestRecording::cutOffRecordingsKeepTheirFrames() {
  QTemporaryDir folder;
  const QString path = folder.filePath("run.psrec"), cut = folder.filePath("cut.psrec");
  const QByteArray bytes = recorded(path);
  for (const qsizetype lost : {1, 20, 200}) {
    write(cut, bytes.left(bytes.size() - lost));
    RecordingReader reader(cut.toStdString(), plugins());
    QCOMPARE(reader.frameCount(), kFrames - 1);
    QVERIFY(reader.damage().find("is cut off or damaged after frame 2") != std::string::npos);
    QCOMPARE(reader.frame(1)->position.size(), kParticles);
  }
}

void TestRecording::damagedFramesAreRefused() {
  QTemporaryDir folder;
  const QString path = folder.filePath("run.psrec"), bad = folder.filePath("bad.psrec");
  QByteArray bytes = recorded(path);
  const qsizetype at = bytes.lastIndexOf("PSBLOCK.") - 5;  // of the last frame's particles, which stand before it
  bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
  write(bad, bytes);
  RecordingReader reader(bad.toStdString(), plugins());
  QCOMPARE(reader.frameCount(), kFrames);
  QVERIFY(reader.frame(0));
  try {
    reader.frame(2);
    QFAIL("a damaged frame was read");
  } catch (const InputError& error) {
    QVERIFY2(QString(error.what()).contains("frame 2: the bytes are not what was written"), error.what());
  }
}

/// Packed and signed by whoever likes to.
void TestRecording::framesThatCannotBeDrawnAreRefused() {
  QTemporaryDir folder;
  const std::string path = folder.filePath("run.psrec").toStdString();
  for (const api::Float4& bad : {api::Float4{1e20F, 0, 0, 1}, {0, -1e30F, 0, 1}, {0, 0, 0, 1e20F}, {0, 0, 0, -1}}) {
    Snapshot s = snapshotOf(0);
    s.position[7] = bad;
    RecordingWriter writer(path, scenes::iceOnPlate(2, 400));
    writer.add(s);
    writer.finish();
    RecordingReader reader(path, plugins());
    QVERIFY_EXCEPTION_THROWN(reader.frame(0), InputError);
  }
}

/// In the mark, the length, the project and the checksum: what is wrong, of which file, and what to do.
void TestRecording::everyBitOfTheHeaderIsGuarded() {
  QTemporaryDir folder;
  const QString path = folder.filePath("run.psrec");
  const QByteArray bytes = recorded(path);
  const qsizetype header = bytes.indexOf("PSBLOCK.");
  QVERIFY(header > 1000);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadWrite | QIODevice::Unbuffered));
  const auto put = [&](qsizetype at, char byte) { return file.seek(at) && file.write(&byte, 1) == 1; };
  const auto complaint = [&]() -> QString {
    try {
      RecordingReader reader(path.toStdString(), plugins());
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  };
  for (qsizetype at = 0; at < header; ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      QVERIFY(put(at, static_cast<char>(bytes[at] ^ (1 << bit))));
      const QString said = complaint();
      const bool mark = at < 8;
      const QString expected = path + (mark ? ": is no recording; " : ": its header is damaged or cut off; ");
      QVERIFY2(said.startsWith(expected), qPrintable(QString("byte %1, bit %2: %3").arg(at).arg(bit).arg(said)));
    }
    QVERIFY(put(at, bytes[at]));
  }
  QCOMPARE(complaint(), QString());
}

void TestRecording::projectsThatNoHeaderHoldsAreRefused() {
  QTemporaryDir folder;
  const QString path = folder.filePath("run.psrec");
  Project project = scenes::iceOnPlate(2, 400);
  project.description.assign(size_t{65} << 20, 'x');
  QVERIFY_THROWS_EXCEPTION(InputError, RecordingWriter(path.toStdString(), project));
  QVERIFY(QDir(folder.path()).isEmpty());
}

void TestRecording::whatOnlyPeopleSeeMakesNoOtherScene() {
  const Project project = scenes::iceOnPlate(2, 400);
  Project other = project;
  other.description = "another";
  other.markers.emplace_back();
  QVERIFY(sameScene(project, other));
  other.duration = 7;
  QVERIFY(!sameScene(project, other));
}

void TestRecording::brokenHeadersAreRefused_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("problem");
  const auto file = [](const char* header, uint32_t length) {
    QByteArray bytes("PSRECORD");
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    return bytes + header;
  };
  const auto whole = [&](const char* header) { return file(header, static_cast<uint32_t>(std::strlen(header))); };
  QTest::newRow("empty") << QByteArray() << "is no recording; simulate";
  QTest::newRow("text") << QByteArray("{\"format\": \"phasesketch\"}") << "is no recording";
  QTest::newRow("mark alone") << QByteArray("PSRECORD") << "header is damaged or cut off";
  QTest::newRow("endless header") << file("{}", 0xffffffffu) << "header is damaged or cut off; take";
  QTest::newRow("no JSON") << whole("{\"form") << "header is damaged or cut off";
  QTest::newRow("list") << whole("[1]") << "its header is no recording's; simulate";
  QTest::newRow("no project") << whole("{\"format\": \"phasesketch-recording\", \"version\": 1}")
                              << "its header is no recording's; simulate";
  QTest::newRow("newer") << whole("{\"format\": \"phasesketch-recording\", \"version\": 9, \"project\": {}}")
                         << "newer version";
  QTest::newRow("older") << whole("{\"format\": \"phasesketch-recording\", \"version\": 1, \"project\": {}}")
                         << "older version (recording format 1)";
  const char* third = "{\"format\": \"phasesketch-recording\", \"version\": 3, \"project\": {}}";
  QTest::newRow("older, without frames") << whole(third) << "older version (recording format 3)";
  QTest::newRow("older, with frames") << whole(third) + "PSFRAME."
                                      << "older version (recording format 3)";
  const char* present = "{\"format\": \"phasesketch-recording\", \"version\": 6, \"project\": {}}";
  QTest::newRow("no checksum") << whole(present) << "header is damaged or cut off";
  QTest::newRow("half a checksum") << whole(present) + "1234"
                                   << "header is damaged or cut off";
  QTest::newRow("no checksum, but frames") << whole(present) + "PSBLOCK."
                                           << "header is damaged or cut off";
}

void TestRecording::brokenHeadersAreRefused() {
  QFETCH(QByteArray, bytes);
  QFETCH(QString, problem);
  QTemporaryDir folder;
  const QString path = folder.filePath("bad.psrec");
  write(path, bytes);
  try {
    RecordingReader reader(path.toStdString(), plugins());
    QFAIL("a broken recording was opened");
  } catch (const InputError& error) {
    QVERIFY2(QString(error.what()).contains(problem), error.what());
  }
}

QTEST_APPLESS_MAIN(TestRecording)
#include "tst_recording.moc"
