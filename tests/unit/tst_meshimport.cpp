// SPDX-License-Identifier: Apache-2.0
// Meshes from files, by the process that reads them: good ones, and whatever else a file may hold.
#include "core/io/meshimport.h"

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/scene/solidform.h"
#include "tests/unit/clirun.h"

#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include <random>
#include <thread>
#include <vector>

using namespace ps;

namespace {

const QString kRabbit = PS_SOURCE_DIR "/resources/models/rabbit.obj";

/// A cube of edge 2 in units of the file.
const QByteArray kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

/// A part, and its mirror image beside it, of one buffer.
const QByteArray kMirrored = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1], "translation": [-1, 0, 0]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [3, 2, 1]},
    {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
  "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,DATA"}]})";

}  // namespace

class TstMeshImport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void unitsAreGivenOrMetres() {
    const std::string cube = file("cube.obj", kCube);
    for (const auto& [unit, metres] : {std::pair("mm", 0.002), std::pair("in", 0.0508)}) {
      const ImportedMesh imported = importMesh(cube, metresPer(unit));
      QVERIFY(imported.facts.closed() && !imported.unitIsOfFile);
      QVERIFY(std::abs(imported.facts.volume / std::pow(metres, 3) - 1) < 1e-6);
    }
    const ImportedMesh imported = importMesh(cube);
    QVERIFY(std::abs(imported.facts.volume / 8 - 1) < 1e-6);
    QCOMPARE(imported.mesh->id, std::string("cube"));
    const Body body = bodyOf(imported);
    const SolidForm form(std::get<SolidShape>(body.shape));
    QVERIFY((form.middle() - Vector3(0, 1, 0)).norm() < 1e-6);
    QVERIFY((form.size() - Vector3(2, 2, 2)).norm() < 1e-6);
  }

  /// Of a part that its node mirrors the outside stays outside.
  void mirroredPartsAreWhole() {
    QByteArray data;
    for (const float x : {0.f, 0.f, 0.f, 3.f, 0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 1.f})
      data.append(reinterpret_cast<const char*>(&x), sizeof x);
    for (const uint16_t k : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3})
      data.append(reinterpret_cast<const char*>(&k), sizeof k);
    QByteArray text = kMirrored;
    text.replace("DATA", data.toBase64());
    const ImportedMesh imported = importMesh(file("two.gltf", text));
    QVERIFY(imported.facts.closed());
    QVERIFY2(std::abs(imported.facts.volume - 2) < 1e-6, qPrintable(QString::number(imported.facts.volume)));
  }

  void theCommandFillsAMesh() {
    const QString project = m_folder.filePath("rabbit.json"), report = m_folder.filePath("report.json");
    const Ran ran =
        cli({"import", kRabbit, "--out", project, "--spacing", "0.02", "--material", "water", "--report", report});
    QVERIFY2(ran.code == 0, ran.err);
    QFile reportFile(report);
    QVERIFY(reportFile.open(QIODevice::ReadOnly));
    const QJsonObject told = QJsonDocument::fromJson(reportFile.readAll()).object();
    QVERIFY(told["closed"].toBool());
    QVERIFY(told["triangles"].toInt() > 1000);
    const double share = told["particle_volume"].toDouble() / told["mesh_volume"].toDouble();
    QVERIFY2(std::abs(share - 1) < 0.01, qPrintable(QString::number(share)));
    const Ran simulated = cli({"simulate", project, "--frames", "2"});
    QVERIFY2(simulated.code == 0, simulated.err);
  }

  void theCommandMakesAWallOfAMesh() {
    const QString project = m_folder.filePath("wall.json");
    const Ran ran = cli({"import", kRabbit, "--out", project, "--spacing", "0.02", "--wall"});
    QVERIFY2(ran.code == 0 && ran.out.contains("a wall of "), ran.err);
    QFile file(project);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QJsonObject wall = QJsonDocument::fromJson(file.readAll()).object()["bodies"][0].toObject();
    QVERIFY(wall["fixed"].toBool());
    QCOMPARE(wall["heat"].toString(), QStringLiteral("adiabatic"));
    QCOMPARE(wall["shape"]["solid"]["inside"].toString(), QStringLiteral("hollow"));
    const Ran simulated = cli({"simulate", project, "--frames", "2"});
    QVERIFY2(simulated.code == 0, simulated.err);
  }

  void theCommandReducesAMesh() {
    const QString project = m_folder.filePath("few.json"), report = m_folder.filePath("few-report.json");
    const auto told = [&](const QStringList& more) {
      const Ran ran =
          cli(QStringList{"import", kRabbit, "--out", project, "--spacing", "0.02", "--report", report} + more);
      QFile file(report);
      return ran.code == 0 && file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object()
                                                             : QJsonObject();
    };
    const QJsonObject whole = told({}), few = told({"--reduce", "800"});
    QVERIFY(few["triangles"].toInt() < whole["triangles"].toInt() / 2);
    QCOMPARE(few["triangles_read"].toInt(), whole["triangles"].toInt());
    QVERIFY(std::abs(few["mesh_volume"].toDouble() / whole["mesh_volume"].toDouble() - 1) <= 0.005);
    QFile file(project);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QJsonArray meshes = QJsonDocument::fromJson(file.readAll()).object()["meshes"].toArray();
    QVERIFY(meshes.at(0).toObject()["origin"].toString().contains("triangles kept"));
    QCOMPARE(cli({"import", kRabbit, "--out", project, "--reduce", "0"}).code, 2);
  }

  void filesThatAreNoMeshesAreRefused_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QByteArray>("bytes");
    QTest::newRow("nothing") << "a.stl" << QByteArray();
    QTest::newRow("words") << "a.obj" << QByteArray("once upon a time\n");
    QTest::newRow("no triangle") << "a.obj" << QByteArray("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    QTest::newRow("no numbers") << "a.obj" << QByteArray("v 1 nan 0\nf 1 2 3\nf 9999999 1 1\n");
    QTest::newRow("not finite") << "a.obj" << QByteArray("v 0 0 0\nv inf 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
    QTest::newRow("flat") << "a.obj" << QByteArray("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    QTest::newRow("too large") << "a.obj" << QByteArray(kCube).replace("1", "100000");
    QTest::newRow("unknown") << "a.xyz" << QByteArray("1 2 3\n");
    QTest::newRow("a count of four thousand million") << "a.stl" << QByteArray(80, ' ') + QByteArray(4, '\xff');
    QTest::newRow("another file's buffer") << "a.gltf" << QByteArray(R"({"asset":{"version":"2.0"},
        "buffers":[{"uri":"/etc/passwd","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]})");
  }
  void filesThatAreNoMeshesAreRefused() {
    QFETCH(QString, name);
    QFETCH(QByteArray, bytes);
    const Ran ran = cli({"import", QString::fromStdString(file(name, bytes)), "--out", m_folder.filePath("p.json")});
    QCOMPARE(ran.code, 2);
    QVERIFY2(ran.err.contains(name.toLatin1() + ": ") && ran.err.count('\n') == 1, ran.err);
  }

  /// Good files with bytes changed and cut off: each ends in a sentence or a mesh, whatever its reader does.
  void damagedFilesDoNoHarm() {
    QFile rabbit(kRabbit);
    QVERIFY(rabbit.open(QIODevice::ReadOnly));
    const QByteArray whole = rabbit.readAll().left(20000);
    std::mt19937 random(7);
    for (int k = 0; k < 40; ++k) {
      QByteArray bytes = whole.left(static_cast<qsizetype>(random() % 20000));
      for (int change = 0; change < 20 && !bytes.isEmpty(); ++change)
        bytes[static_cast<qsizetype>(random() % static_cast<size_t>(bytes.size()))] = static_cast<char>(random());
      const char* endings[] = {"obj", "stl", "ply", "3ds", "fbx"};
      const std::string path = file(QString("d.%1").arg(endings[k % 5]), bytes);
      try {
        QVERIFY(!importMesh(path).mesh->triangles.empty());
      } catch (const InputError& error) {
        QVERIFY(std::string(error.what()).starts_with(path + ": "));
      }
    }
  }

  /// By the process that reads, and by what follows here.
  void howFarItIsIsTold() {
    struct Told : Progress {
      std::vector<std::string> stages;
      double last = 0, read = 0;  ///< share that is told last, and while the process reads
      bool falls = false;
      void advanced(size_t) override {
        const State now = state();
        if (stages.empty() || stages.back() != now.stage) stages.push_back(now.stage);
        if (stages.size() == 1) read = now.done;
        falls = falls || now.done < last;
        last = now.done;
      }
    } told;
    told.expect(1);
    const ProgressScope scope(&told);
    QVERIFY(importMesh(kRabbit.toStdString()).facts.closed());
    QVERIFY(told.stages == (std::vector<std::string>{"Reading", "Mending", "Reducing"}));
    QVERIFY2(told.read > 0.3, qPrintable(QString::number(told.read)));
    QVERIFY(!told.falls);
    QVERIFY(std::abs(told.last - 1) < 1e-9);
  }

  void readingCanBeCancelled() {
    Progress progress;
    progress.cancel();
    const ProgressScope scope(&progress);
    QElapsedTimer clock;
    clock.start();
    QVERIFY_THROWS_EXCEPTION(Cancelled, importMesh(kRabbit.toStdString()));
    QVERIFY(clock.elapsed() < 5000);
  }

 private:
  std::string file(const QString& name, const QByteArray& bytes) {
    const QString path = m_folder.filePath(name);
    QFile out(path);
    if (!out.open(QIODevice::WriteOnly | QIODevice::Truncate) || out.write(bytes) != bytes.size()) return {};
    return path.toStdString();
  }
  QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(TstMeshImport)
#include "tst_meshimport.moc"
