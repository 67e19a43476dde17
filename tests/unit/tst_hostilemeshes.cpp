// SPDX-License-Identifier: Apache-2.0
// Files that mean harm, or were cut off, in every format that the import dialog names: each ends in a mesh or in one
// sentence, in bounded time and memory, whatever its reader does. They are made here from one small mesh, by a fixed
// generator. And meshes that other people made, where Debian's packages of them are installed.
#include "core/base/error.h"
#include "core/io/meshimport.h"
#include "tests/unit/clirun.h"

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <sys/resource.h>

#include <QDirIterator>
#include <QElapsedTimer>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

using namespace ps;

namespace {

constexpr double kPatience = 10;       ///< s, for one file
constexpr long kMostChild = 4L << 20;  ///< KiB: what the reader allows itself
constexpr long kMostSelf = 1L << 20;   ///< KiB, of this process
constexpr int kDeep = 200'000;         ///< levels of what nests

/// Two joined cubes of 12 triangles: small, closed, with texts and numbers of every kind around it.
const QByteArray kObj =
    "o cube\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "vn 0 0 1\nvt 0 0\nf 4 3 2\nf 4 2 1\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 3 4 8\nf 3 8 7\nf 2 3 7\nf 2 7 6\n"
    "f 4 1 5\nf 4 5 8\n";
const QByteArray kOff = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const QByteArray kBlend = QByteArray("BLENDER-v279REND") + QByteArray(64, '\0') + "DNA1" + QByteArray(200, '\x01');

struct Seed {
  QByteArray ending, bytes;
};

struct Hostile {
  QByteArray name, bytes;
};

/// The cube in a format that assimp writes too; empty where it does not.
QByteArray exported(const char* format) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(kObj.data(), static_cast<size_t>(kObj.size()), 0, "obj");
  QTemporaryDir folder;
  QFile written(folder.filePath("cube")), beside(folder.filePath("cube.bin"));
  Assimp::Exporter exporter;
  if (!scene || exporter.Export(scene, format, written.fileName().toStdString()) != aiReturn_SUCCESS) return {};
  QByteArray bytes = written.open(QIODevice::ReadOnly) ? written.readAll() : QByteArray();
  if (beside.open(QIODevice::ReadOnly))  // what lies in a second file goes into the text
    bytes.replace("cube.bin", "data:application/octet-stream;base64," + beside.readAll().toBase64());
  return bytes;
}

std::vector<Seed> seeds() {
  std::vector<Seed> all{{"obj", kObj}, {"off", kOff}, {"blend", kBlend}};
  const std::pair<const char*, const char*> formats[] = {
      {"stl", "stl"}, {"stlb", "stl"}, {"ply", "ply"}, {"plyb", "ply"},    {"gltf2", "gltf"}, {"glb2", "glb"},
      {"fbx", "fbx"}, {"fbxa", "fbx"}, {"3mf", "3mf"}, {"collada", "dae"}, {"3ds", "3ds"},    {"x3d", "x3d"}};
  for (const auto& [format, ending] : formats) {
    if (const QByteArray bytes = exported(format); !bytes.isEmpty()) all.push_back({ending, bytes});
  }
  return all;
}

/// What a generator makes of a good file: cut, with bits turned, with counts that cannot be, with a head of another.
std::vector<QByteArray> damaged(const QByteArray& good, std::mt19937& random) {
  const auto at = [&](const QByteArray& bytes) {
    return static_cast<qsizetype>(random() % static_cast<size_t>(std::max<qsizetype>(1, bytes.size())));
  };
  std::vector<QByteArray> all;
  for (const int eighths : {1, 3, 4, 7}) all.push_back(good.left(good.size() * eighths / 8));
  for (const int flips : {1, 8, 64}) {
    QByteArray bytes = good;
    for (int k = 0; k < flips; ++k) bytes[at(bytes)] = static_cast<char>(bytes[at(bytes)] ^ (1 << random() % 8));
    all.push_back(bytes);
  }
  for (const char* count : {"\xff\xff\xff\xff", "\xff\xff\xff\x7f", "\x00\x00\x00\x80"}) {
    QByteArray bytes = good;
    for (int k = 0; k < 4; ++k) bytes.replace(std::min(at(bytes), bytes.size() - 4), 4, QByteArray(count, 4));
    all.push_back(bytes);
  }
  QByteArray large = good, negative = good;
  for (int k = 0; k < 6; ++k) {  // a number in a text becomes one that nothing holds
    qsizetype from = at(large);
    while (from < large.size() && !std::isdigit(static_cast<unsigned char>(large[from]))) ++from;
    if (from < large.size()) large.insert(from, "99999999999");
    from = at(negative);
    while (from < negative.size() && !std::isdigit(static_cast<unsigned char>(negative[from]))) ++from;
    if (from < negative.size()) negative.insert(from, "-1e39");
  }
  all.push_back(large);
  all.push_back(negative);
  all.push_back("PK\x03\x04" + good.mid(4));
  return all;
}

QByteArray repeated(const QByteArray& open, int times, const QByteArray& middle, const QByteArray& close) {
  return open.repeated(times) + middle + close.repeated(times);
}

/// What is written to break readers: nests deeply, refers to itself, grows, or reaches out.
std::vector<Hostile> crafted() {
  const QByteArray node = "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":";
  QByteArray entities = "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY a0 \"aaaaaaaaaa\">";
  for (int k = 1; k < 12; ++k)
    entities +=
        "<!ENTITY a" + QByteArray::number(k) + " \"" + ("&a" + QByteArray::number(k - 1) + ";").repeated(10) + "\">";
  entities += "]><COLLADA version=\"1.4.1\">&a11;</COLLADA>";
  return {
      {"deep.gltf", node + repeated("[", kDeep, "", "]") + "}"},
      {"itself.gltf", node + "[{\"children\":[0]}]}"},
      {"ring.gltf", node + "[{\"children\":[1]},{\"children\":[0]}]}"},
      {"far.gltf", node + "[{\"mesh\":4000000000}]}"},
      {"buffer.gltf", node +
                          "[{\"mesh\":0}],\"buffers\":[{\"byteLength\":9000000000000}],\"bufferViews\":[{\"buffer\":0,"
                          "\"byteLength\":9000000000000}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
                          "\"count\":700000000000,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
                          "\"POSITION\":0}}]}]}"},
      {"device.gltf", node + "[{\"mesh\":0}],\"buffers\":[{\"uri\":\"/dev/zero\",\"byteLength\":36}]}"},
      {"deep.dae", "<COLLADA version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"a\">" +
                       repeated("<node>", kDeep, "", "</node>") + "</visual_scene></library_visual_scenes></COLLADA>"},
      {"entities.dae", entities},
      {"deep.x3d", "<X3D><Scene>" + repeated("<Group>", kDeep, "", "</Group>") + "</Scene></X3D>"},
      {"deep.fbx", "; FBX 7.3.0 project file\nFBXHeaderExtension: {\n" + repeated("A: {\n", kDeep, "", "}\n") + "}\n"},
      {"library.obj", "mtllib /dev/zero\nmtllib ../../../../etc/passwd\n" + kObj},
      {"long.obj", "v " + QByteArray(4'000'000, '1') + " 0 0\n" + kObj},
      {"corners.obj", kObj + "f" + QByteArray(" 1").repeated(500'000) + "\n"},
      {"negative.obj", kObj + "f -1 -2 -2147483648\nf 0 0 0\nf 2147483647 4294967296 18446744073709551616\n"},
      {"count.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float "
       "y\nproperty float z\nelement face 4000000000\nproperty list uchar int vertex_indices\nend_header\n"},
      {"list.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint float x\nend_header\n" +
                       QByteArray(4, '\xff')},
      {"count.off", "OFF\n4000000000 4000000000 0\n"},
      {"count.stl", QByteArray(80, ' ') + QByteArray(4, '\xff') + QByteArray(500, '\x01')},
      {"solid.stl", "solid a\n" + QByteArray("facet normal 0 0 1\nouter loop\nvertex 1e999 nan inf\n").repeated(2000)},
      {"length.glb", QByteArray("glTF\x02\x00\x00\x00\xff\xff\xff\xff\xff\xff\xff\x7fJSON", 20)},
      {"chunk.3ds", QByteArray("MM\xff\xff\xff\x7f", 6) + QByteArray("==\x06\x00\x00\x00", 6).repeated(5000)},
  };
}

/// Of a file in this folder: what reading it comes to. Anything but a mesh or its sentence throws on.
QString outcome(const std::string& path) {
  try {
    const ImportedMesh imported = importMesh(path, std::nullopt, kPatience);
    return imported.mesh->triangles.empty() ? QStringLiteral("a mesh of nothing") : QString();
  } catch (const InputError& error) {
    const QString said = QString::fromUtf8(error.what());
    const bool sentence =
        said.startsWith(QString::fromStdString(path) + ": ") && !said.contains('\n') && said.size() < 500;
    return sentence ? QString() : said;
  }
}

}  // namespace

class TstHostileMeshes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void hostileFilesEndInASentence() {
    std::mt19937 random(20);
    std::vector<Hostile> files = crafted();
    for (const Seed& seed : seeds()) {
      for (const QByteArray& bytes : damaged(seed.bytes, random))
        files.push_back({"d" + QByteArray::number(files.size()) + "." + seed.ending, bytes});
    }
    QVERIFY2(files.size() >= 200, qPrintable(QString::number(files.size())));
    for (const Hostile& hostile : files) {
      const std::string path = file(hostile.name, hostile.bytes);
      QElapsedTimer clock;
      clock.start();
      const QString wrong = outcome(path);
      QVERIFY2(wrong.isEmpty(), qPrintable(QString::fromUtf8(hostile.name) + ": " + wrong));
      // What took all the time that a file may, and its process's end.
      QVERIFY2(clock.elapsed() < 1000 * (kPatience + 5), hostile.name.constData());
    }
    const auto most = [](int who) {
      rusage used{};
      ::getrusage(who, &used);
      return used.ru_maxrss;
    };
    qInfo("%zu files; the reader took %ld MiB at most, this process %ld MiB", files.size(), most(RUSAGE_CHILDREN) >> 10,
          most(RUSAGE_SELF) >> 10);
    QVERIFY(most(RUSAGE_CHILDREN) < kMostChild);
    QVERIFY(most(RUSAGE_SELF) < kMostSelf);
  }

  /// Files whole as they were made are meshes: what is refused above is so for its damage.
  void goodFilesAreMeshes() {
    int good = 0;
    for (const Seed& seed : seeds()) {
      // That one was never whole, and what assimp 5.2 writes of the binary kind it does not read.
      if (seed.ending == "blend" || seed.bytes.startsWith("Kaydara FBX Binary")) continue;
      const std::string path = file("good" + QByteArray::number(good) + "." + seed.ending, seed.bytes);
      try {
        if (importMesh(path).facts.closed()) ++good;
      } catch (const InputError& error) {
        QFAIL(error.what());
      }
    }
    QVERIFY2(good >= 13, qPrintable(QString::number(good)));
  }

  /// Closed meshes are filled to 1 % of what they enclose, all of them run.
  void meshesOfOthersAreFilledAndRun_data() {
    QTest::addColumn<QString>("path");
    int rows = 0;
    const QString models = "/usr/share/assimp/models/";
    QStringList paths;
    for (const QString& folder :
         {QString("/usr/share/glmark2/models"), models + "OBJ", models + "STL", models + "PLY", models + "OFF"}) {
      for (const QString& name : QDir(folder).entryList(QDir::Files, QDir::Name)) {
        static const QStringList kEndings{"obj", "stl", "ply", "off", "3ds"};
        if (kEndings.contains(QFileInfo(name).suffix().toLower())) paths << folder + "/" + name;
      }
    }
    for (const char* one :
         {"3MF/box.3mf", "Collada/duck.dae", "Collada/cube_tristrips.dae", "FBX/box.fbx", "FBX/spider.fbx",
          "FBX/cubes_with_mirroring_and_pivot.fbx", "FBX/close_to_identity_transforms.fbx",
          "glTF/BoxTextured-glTF/BoxTextured.gltf", "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"})
      paths << models + one;
    for (const QString& path : paths) {
      if (!QFileInfo::exists(path)) continue;
      QTest::newRow(qPrintable(QFileInfo(path).fileName())) << path;
      ++rows;
    }
    if (rows == 0) QTest::newRow("not installed") << QString();
  }
  void meshesOfOthersAreFilledAndRun() {
    QFETCH(QString, path);
    if (path.isEmpty()) QSKIP("meshes of others: apt install assimp-testmodels glmark2-data");
    ++m_tried;
    const QString project = m_folder.filePath("p.json"), report = m_folder.filePath("r.json");
    const Ran ran = cli({"import", path, "--out", project, "--material", "water", "--report", report});
    if (ran.code == 2) {  // points, lines, or flat: a sentence
      QVERIFY2(ran.err.startsWith("phasesketch-cli: ") || ran.err.contains(path.toUtf8() + ": "), ran.err);
      QCOMPARE(ran.err.count('\n'), 1);
      qInfo("refused: %s", ran.err.trimmed().constData());
      return;
    }
    QVERIFY2(ran.code == 0, ran.err);
    QFile file(report);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QJsonObject told = QJsonDocument::fromJson(file.readAll()).object();
    const double share = told["particle_volume"].toDouble() / told["mesh_volume"].toDouble();
    qInfo("%d triangles, %s, %d particles, volume %.4f of the mesh's", told["triangles"].toInt(),
          told["closed"].toBool() ? "closed" : "open", told["particles"].toInt(), share);
    if (told["closed"].toBool()) QVERIFY(std::abs(share - 1) < 0.01);
    const Ran simulated = cli({"simulate", project, "--frames", "2"});
    QVERIFY2(simulated.code == 0, simulated.err);
    ++m_ran;
    if (!told["closed"].toBool()) ++m_openOnes;
  }

  /// Behind them: what is left of both packages when none is found, or all are refused, is no proof.
  void theyWereTenAndOneOfThemOpen() {
    const bool installed =
        QFileInfo::exists("/usr/share/assimp/models") && QFileInfo::exists("/usr/share/glmark2/models");
    if (!installed || m_tried == 0) QSKIP("meshes of others: apt install assimp-testmodels glmark2-data");
    qInfo("%d meshes of others, %d of them ran, %d of these open", m_tried, m_ran, m_openOnes);
    QVERIFY2(m_ran >= 10, qPrintable(QString::number(m_ran)));
    QVERIFY2(m_openOnes >= 1, qPrintable(QString::number(m_openOnes)));
  }

 private:
  std::string file(const QByteArray& name, const QByteArray& bytes) {
    QFile out(m_folder.filePath(QString::fromUtf8(name)));
    if (!out.open(QIODevice::WriteOnly | QIODevice::Truncate) || out.write(bytes) != bytes.size()) return {};
    return out.fileName().toStdString();
  }
  QTemporaryDir m_folder;
  int m_tried = 0, m_ran = 0, m_openOnes = 0;  ///< meshes of others
};

QTEST_GUILESS_MAIN(TstHostileMeshes)
#include "tst_hostilemeshes.moc"
