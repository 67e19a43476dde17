// SPDX-License-Identifier: Apache-2.0
// What is exported reads back with somebody else's reader where the machine has one (assimp, Qt's XML), else byte by
// byte as the format's description says.
#include "clirun.h"
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/export/exportformat.h"
#include "core/export/particlecolumns.h"
#include "core/export/recordedframes.h"
#include "core/export/scenesurface.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/runrecord.h"
#include "tests/shared/scenes.h"

#include <QDir>
#include <QTest>
#include <QXmlStreamReader>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <sys/resource.h>

using namespace ps;

namespace {

constexpr int kSide = 6;

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

template <class T>
std::vector<T> numbersOf(const QString& base64) {
  const auto decoded =
      QByteArray::fromBase64Encoding(base64.trimmed().toLatin1(), QByteArray::AbortOnBase64DecodingErrors);
  const QByteArray& bytes = decoded.decoded;
  if (!decoded || static_cast<size_t>(bytes.size()) < sizeof(uint64_t)) return {};
  uint64_t count = 0;
  std::memcpy(&count, bytes.constData(), sizeof count);
  if (count + sizeof count != static_cast<uint64_t>(bytes.size())) return {};
  std::vector<T> values(count / sizeof(T));
  std::memcpy(values.data(), bytes.constData() + sizeof count, count);
  return values;
}

/// Its arrays by name, and the numbers that the piece states. `within`: the element that an array stands in.
struct Vtp {
  std::map<QString, QString> arrays, types, within;
  std::map<QString, int> components;
  QXmlStreamAttributes head;
  int points = 0, cells = 0;
  QString problem;
};

Vtp readVtp(const QByteArray& bytes) {
  Vtp vtp;
  QXmlStreamReader xml(bytes);
  QStringList open;
  while (!xml.atEnd()) {
    const auto token = xml.readNext();
    if (token == QXmlStreamReader::EndElement) open.removeLast();
    if (token != QXmlStreamReader::StartElement) continue;
    const QXmlStreamAttributes attributes = xml.attributes();
    if (open.isEmpty()) vtp.head = attributes;
    if (xml.name() == QStringLiteral("Piece")) {
      vtp.points = attributes.value("NumberOfPoints").toInt();
      vtp.cells = attributes.value("NumberOfVerts").toInt();
    } else if (xml.name().endsWith(QStringLiteral("Array"))) {
      const QString name = attributes.value("Name").toString();
      vtp.types[name] = attributes.value("type").toString();
      vtp.components[name] = attributes.value("NumberOfComponents").toInt();
      vtp.within[name] = open.join('/');
      vtp.arrays[name] = xml.readElementText();
      continue;  // which ends with the element
    }
    open << xml.name().toString();
  }
  vtp.problem = xml.errorString();
  return vtp;
}

/// Counts the questions whether to go on, and cancels at the `last`.
class Asked final : public Progress {
 public:
  explicit Asked(uint64_t last) : m_last(last) {}
  std::atomic<uint64_t> count{0};

 private:
  void advanced(size_t) override {
    if (++count == m_last) cancel();
  }
  uint64_t m_last;
};

ByteColour grey(float kelvin) { return {static_cast<uint8_t>(kelvin / 2), 10, 20}; }

}  // namespace

class TestExport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { QVERIFY(m_folder.isValid()); }
  void vtpReadsBack();
  void vtpKeepsToItsFormat();
  void plyReadsBack();
  void otherProgramsReadThePoints();
  void csvReadsBack();
  void surfacesReadBack_data();
  void surfacesReadBack();
  void everyFormatWritesAnEmptyFrame();
  void namesOfOthersBreakNothing();
  void onlyTheChosenFieldsAreWritten();
  void aFrameIsGivenUpWhileItIsWritten_data() { formats(); }
  void aFrameIsGivenUpWhileItIsWritten();
  void framesOfARunAreFound();
  void theCommandLineExports_data() { formats(); }
  void theCommandLineExports();
  void theCommandLineSaysWhatIsWrong_data();
  void theCommandLineSaysWhatIsWrong();
  void aFullDiskIsSaid();

 private:
  static void formats() {
    QTest::addColumn<QString>("format");
    for (const ExportFormat& format : exportFormats()) QTest::newRow(format.key) << QString::fromLatin1(format.key);
  }
  /// Writes one frame and returns the path of its file.
  QString exported(const char* key, const Snapshot& snapshot, std::vector<std::string> fields = {}) {
    const ExportFormat& format = exportFormat(key);
    const auto exporter =
        makeExporter(format, {m_folder.filePath(QString::fromLatin1(key)).toStdString(), std::move(fields), grey});
    exporter->add(snapshot);
    exporter->finish();
    return m_folder.filePath(QStringLiteral("%1/%2-%3.%4")
                                 .arg(key, format.first)
                                 .arg(static_cast<qulonglong>(snapshot.stats.frame), 6, 10, QLatin1Char('0'))
                                 .arg(format.ending));
  }
  QTemporaryDir m_folder;
  PluginRegistry m_plugins;
  SnapshotPtr m_snapshot;
  std::vector<uint32_t> m_order;  ///< of its particles, by id
};

/// Ice that has begun to melt, in the solver's order.
void TestExport::initTestCase() {
  Engine engine(scenes::iceOnPlate(kSide, 400), m_plugins);
  engine.show(engine.fields().names());
  for (int frame = 0; frame < 7; ++frame) engine.step();
  m_snapshot = engine.snapshot();
  m_order.resize(m_snapshot->id.size());
  for (uint32_t i = 0; i < m_order.size(); ++i) m_order[i] = i;
  std::sort(m_order.begin(), m_order.end(), [&](auto a, auto b) { return m_snapshot->id[a] < m_snapshot->id[b]; });
  QVERIFY(m_order.size() >= kSide * kSide * kSide);
}

void TestExport::vtpReadsBack() {
  const Vtp vtp = readVtp(bytesOf(exported("vtp", *m_snapshot)));
  QCOMPARE(vtp.problem, QString());
  const size_t count = m_order.size();
  QCOMPARE(static_cast<size_t>(vtp.points), count);
  QCOMPARE(vtp.cells, 1);
  const auto places = numbersOf<float>(vtp.arrays.at("Points"));
  const auto temperatures = numbersOf<float>(vtp.arrays.at("temperature"));
  const auto pressures = numbersOf<float>(vtp.arrays.at("pressure"));
  const auto ids = numbersOf<uint32_t>(vtp.arrays.at("id")), phases = numbersOf<uint32_t>(vtp.arrays.at("phase"));
  QCOMPARE(places.size(), 3 * count);
  QCOMPARE(pressures.size(), count);
  for (size_t k = 0; k < count; ++k) {
    const uint32_t i = m_order[k];
    QCOMPARE(places[3 * k + 1], m_snapshot->position[i].y);
    QCOMPARE(temperatures[k], m_snapshot->temperature[i]);
    QCOMPARE(ids[k], m_snapshot->id[i]);
    QCOMPARE(phases[k], static_cast<uint32_t>(m_snapshot->phase[i]));
  }
  QCOMPARE(vtp.types.at("id"), QStringLiteral("UInt32"));
  QCOMPARE(numbersOf<int64_t>(vtp.arrays.at("offsets")), std::vector<int64_t>{static_cast<int64_t>(count)});
  QCOMPARE(numbersOf<int64_t>(vtp.arrays.at("connectivity")).back(), static_cast<int64_t>(count - 1));
  QCOMPARE(vtp.arrays.at("TimeValue").toDouble(), m_snapshot->stats.time);
  QVERIFY(vtp.arrays.at("body_names").startsWith("105 99 101 0 "));  // "ice"
  QXmlStreamReader series(bytesOf(m_folder.filePath("vtp/particles.pvd")));
  QStringList frames;
  while (!series.atEnd()) {
    if (series.readNext() == QXmlStreamReader::StartElement && series.name() == QStringLiteral("DataSet"))
      frames << series.attributes().value("timestep").toString() + ' ' + series.attributes().value("file").toString();
  }
  QCOMPARE(series.errorString(), QString());
  QCOMPARE(frames.size(), 1);
  QCOMPARE(frames[0].section(' ', 0, 0).toDouble(), m_snapshot->stats.time);
  QCOMPARE(frames[0].section(' ', 1), QStringLiteral("particles-000007.vtp"));
}

/// As the description of VTK's XML formats says: what the root declares, where arrays stand, and how many numbers each
/// has, of the type that it names.
void TestExport::vtpKeepsToItsFormat() {
  const Vtp vtp = readVtp(bytesOf(exported("vtp", *m_snapshot)));
  QCOMPARE(vtp.problem, QString());
  QCOMPARE(vtp.head.value("type").toString(), QStringLiteral("PolyData"));
  QCOMPARE(vtp.head.value("byte_order").toString(), QStringLiteral("LittleEndian"));
  QCOMPARE(vtp.head.value("header_type").toString(), QStringLiteral("UInt64"));  // before each array
  const QString piece = QStringLiteral("VTKFile/PolyData/Piece/");
  QCOMPARE(vtp.within.at("Points"), piece + "Points");
  QCOMPARE(vtp.components.at("Points"), 3);
  QCOMPARE(vtp.types.at("Points"), QStringLiteral("Float32"));
  for (const char* name : {"connectivity", "offsets"}) QCOMPARE(vtp.within.at(name), piece + "Verts");
  QCOMPARE(vtp.within.at("TimeValue"), QStringLiteral("VTKFile/PolyData/FieldData"));
  size_t ofPoints = 0;
  for (const auto& [name, where] : vtp.within) {
    if (where != piece + "PointData") continue;
    ++ofPoints;
    QCOMPARE(vtp.components.at(name), 1);
    const bool whole = vtp.types.at(name) == QStringLiteral("UInt32");
    QVERIFY2(whole || vtp.types.at(name) == QStringLiteral("Float32"), qPrintable(name));
    const size_t count =
        whole ? numbersOf<uint32_t>(vtp.arrays.at(name)).size() : numbersOf<float>(vtp.arrays.at(name)).size();
    QVERIFY2(count == m_order.size(), qPrintable(name));
  }
  QCOMPARE(ofPoints, exportableFields(*m_snapshot).size());
}

/// By assimp: a cloud of points in their order, to the bit.
void TestExport::otherProgramsReadThePoints() {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(exported("ply", *m_snapshot).toStdString(), 0);
  QVERIFY2(scene, importer.GetErrorString());
  QCOMPARE(scene->mNumMeshes, 1U);
  const aiMesh& cloud = *scene->mMeshes[0];
  QCOMPARE(cloud.mPrimitiveTypes, static_cast<unsigned>(aiPrimitiveType_POINT));
  QCOMPARE(static_cast<size_t>(cloud.mNumVertices), m_order.size());
  for (unsigned k = 0; k < cloud.mNumVertices; ++k) {
    const api::Float4& p = m_snapshot->position[m_order[k]];
    QCOMPARE(cloud.mVertices[k], aiVector3D(p.x, p.y, p.z));
  }
}

void TestExport::plyReadsBack() {
  const QByteArray bytes = bytesOf(exported("ply", *m_snapshot));
  const QByteArray end = "end_header\n";
  const auto head = bytes.left(bytes.indexOf(end)).split('\n');
  QCOMPARE(head[0], QByteArray("ply"));
  QVERIFY(head.contains("format binary_little_endian 1.0"));
  QVERIFY(head.contains("element vertex " + QByteArray::number(static_cast<qulonglong>(m_order.size()))));
  QVERIFY(head.contains("comment body 0 ice"));
  std::map<QByteArray, qsizetype> offsets;
  qsizetype stride = 0;
  for (const QByteArray& line : head) {
    if (!line.startsWith("property ")) continue;
    QVERIFY2(line.startsWith("property float ") || line.startsWith("property uint "), line.constData());
    offsets[line.split(' ').last()] = stride;
    stride += 4;
  }
  const QByteArray rows = bytes.mid(bytes.indexOf(end) + end.size());
  QCOMPARE(rows.size(), stride * static_cast<qsizetype>(m_order.size()));
  for (size_t k = 0; k < m_order.size(); ++k) {
    const auto read = [&]<class T>(const char* name, T) {
      T value;
      std::memcpy(&value, rows.constData() + static_cast<qsizetype>(k) * stride + offsets.at(name), sizeof value);
      return value;
    };
    QCOMPARE(read("z", 0.F), m_snapshot->position[m_order[k]].z);
    QCOMPARE(read("temperature", 0.F), m_snapshot->temperature[m_order[k]]);
    QCOMPARE(read("id", 0U), m_snapshot->id[m_order[k]]);
  }
}

void TestExport::csvReadsBack() {
  const QList<QByteArray> rows = bytesOf(exported("csv", *m_snapshot)).trimmed().split('\n');
  QCOMPARE(static_cast<size_t>(rows.size()), m_order.size() + 1);
  const QList<QByteArray> titles = rows[0].trimmed().split(',');
  QVERIFY(titles.contains("temperature[K]") && titles.contains("density[kg/m³]"));
  for (size_t k = 0; k < m_order.size(); ++k) {
    const QList<QByteArray> cells = rows[static_cast<qsizetype>(k) + 1].trimmed().split(',');
    QCOMPARE(cells.size(), titles.size());
    const auto cell = [&](const char* title) { return cells[titles.indexOf(title)]; };
    QCOMPARE(cell("temperature[K]").toFloat(), m_snapshot->temperature[m_order[k]]);
    QCOMPARE(cell("x[m]").toFloat(), m_snapshot->position[m_order[k]].x);
    QCOMPARE(cell("time[s]").toDouble(), m_snapshot->stats.time);
    QCOMPARE(cell("body"), QByteArray("ice"));
    QVERIFY(cell("phase") == "solid" || cell("phase") == "melting" || cell("phase") == "liquid");
  }
}

void TestExport::surfacesReadBack_data() {
  QTest::addColumn<QString>("format");
  QTest::newRow("obj") << "obj";
  QTest::newRow("ply") << "surface-ply";
}

/// By assimp: a closed body where the matter is, with its colours.
void TestExport::surfacesReadBack() {
  QFETCH(const QString, format);
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(exported(qPrintable(format), *m_snapshot).toStdString(), aiProcess_ValidateDataStructure);
  QVERIFY2(scene, importer.GetErrorString());
  QCOMPARE(scene->mNumMeshes, 1U);
  const aiMesh& mesh = *scene->mMeshes[0];
  QVERIFY(mesh.mNumFaces > 500 && mesh.HasVertexColors(0) && mesh.HasNormals());
  float low[3] = {1e9F, 1e9F, 1e9F}, high[3] = {-1e9F, -1e9F, -1e9F};
  for (const api::Float4& p : m_snapshot->position) {
    const float at[3] = {p.x, p.y, p.z};
    for (size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], at[a] - p.w), high[a] = std::max(high[a], at[a] + p.w);
  }
  const auto slack = static_cast<float>(0.5 * m_snapshot->spacing);
  double six = 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    QCOMPARE(face.mNumIndices, 3U);
    six += static_cast<double>(mesh.mVertices[face.mIndices[0]] *
                               (mesh.mVertices[face.mIndices[1]] ^ mesh.mVertices[face.mIndices[2]]));
  }
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    for (unsigned a = 0; a < 3; ++a) {
      QVERIFY(mesh.mVertices[v][a] > low[a] - slack && mesh.mVertices[v][a] < high[a] + slack);
    }
    // grey() of the coldest and the hottest, in shares of one
    QVERIFY(mesh.mColors[0][v].r > 0.4F && mesh.mColors[0][v].r < 0.9F);
    QVERIFY(std::abs(mesh.mColors[0][v].g - 10.F / 255) < 1e-3F);
  }
  const double own = static_cast<double>(m_order.size()) * std::pow(m_snapshot->spacing, 3);
  QVERIFY2(six / 6 > 0.8 * own && six / 6 < 1.1 * own, qPrintable(QString::number(six / 6 / own)));
  if (format == QStringLiteral("obj"))
    QVERIFY(bytesOf(m_folder.filePath("obj/surface.mtl")).startsWith("newmtl water\nKd "));
}

void TestExport::everyFormatWritesAnEmptyFrame() {
  Snapshot empty;
  empty.spacing = 0.02;
  for (const ExportFormat& format : exportFormats()) {
    const QByteArray bytes = bytesOf(exported(format.key, empty));
    QVERIFY2(!bytes.isEmpty(), format.key);
    if (format.key == QStringLiteral("vtp")) {
      const Vtp vtp = readVtp(bytes);
      QCOMPARE(vtp.problem, QString());
      QCOMPARE(vtp.points + vtp.cells, 0);
    }
  }
}

void TestExport::namesOfOthersBreakNothing() {
  Snapshot odd = *m_snapshot;
  odd.stats.frame = 8;
  odd.bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"a \"<b>\",\n& c"});
  odd.materialIds.front() = "two words\n";
  const Vtp vtp = readVtp(bytesOf(exported("vtp", odd)));
  QCOMPARE(vtp.problem, QString());
  const QByteArray ply = bytesOf(exported("ply", odd)), obj = bytesOf(exported("obj", odd));
  QVERIFY(ply.contains("\ncomment material 0 two_words_\n"));
  QVERIFY(obj.contains("\no two_words_\nusemtl two_words_\n"));
  QVERIFY(bytesOf(exported("csv", odd)).contains(",\"a \"\"<b>\"\",\n& c\","));
}

void TestExport::onlyTheChosenFieldsAreWritten() {
  const Vtp vtp = readVtp(bytesOf(exported("vtp", *m_snapshot, {"speed", "id"})));
  QVERIFY(vtp.arrays.contains("speed") && vtp.arrays.contains("id") && !vtp.arrays.contains("temperature"));
  QVERIFY_EXCEPTION_THROWN(requireFields({"speed", "colour"}, *m_snapshot), InputError);
  for (const std::string& name : exportableFields(*m_snapshot)) requireFields({name}, *m_snapshot);
}

/// Not only between frames, and between the columns of a table or the blocks of a surface: of a large one the rows
/// alone take longer than whoever gives it up should wait. Counted are questions, not time. What is given up leaves no
/// file.
void TestExport::aFrameIsGivenUpWhileItIsWritten() {
  QFETCH(const QString, format);
  constexpr int kLarge = 26;
  Engine engine(scenes::iceOnPlate(kLarge, 300), m_plugins);
  Snapshot large = *engine.snapshot();
  QVERIFY(large.id.size() > kProgressSlice);
  const auto asked = [](uint64_t last, const auto& act) {
    Asked progress(last);
    const ProgressScope scope(&progress);
    act();
    return progress.count.load();
  };
  const bool surface = QByteArray(exportFormat(format.toStdString()).first).startsWith("surface");
  const uint64_t making = asked(~uint64_t{0}, [&] { surface ? void(surfacesOf(large)) : void(tableOf(large, {})); });
  large.stats.frame = 20;
  const uint64_t whole = asked(~uint64_t{0}, [&] { exported(qPrintable(format), large); });
  QVERIFY2(whole >= making + 2, qPrintable(QStringLiteral("%1 of %2").arg(making).arg(whole)));
  large.stats.frame = 21;
  QVERIFY_EXCEPTION_THROWN(asked(whole, [&] { exported(qPrintable(format), large); }), Cancelled);
  QVERIFY(QDir(m_folder.filePath(format)).entryList({"*000021*"}, QDir::Files).isEmpty());
}

/// Of those that are kept: the one before stands for one that is not, and once.
void TestExport::framesOfARunAreFound() {
  KeptRun run;
  FramePacker packer(std::make_shared<KeptBytes>());
  for (const uint64_t number : {2U, 3U, 4U, 8U, 9U}) {
    Snapshot frame = *m_snapshot;
    frame.stats.frame = number;
    run.addFrame(std::make_shared<const PackedFrame>(packer.pack(frame).frame));
  }
  using Numbers = std::vector<uint64_t>;
  QCOMPARE(keptIn(run, {2, 9, 1}), (Numbers{2, 3, 4, 8, 9}));
  QCOMPARE(keptIn(run, {0, 100, 2}), (Numbers{2, 4, 8}));
  QCOMPARE(keptIn(run, {5, 8, 1}), (Numbers{4, 8}));
  QCOMPARE(keptIn(run, {10, 9, 1}), Numbers());
  QCOMPARE(keptIn(KeptRun(), {0, 9, 1}), Numbers());
  const std::vector<RangeFrame> film = framesIn(run, {4, 9, 2});
  QCOMPARE(film.size(), size_t{3});
  QCOMPARE(film[1].wanted, uint64_t{6});
  QCOMPARE(film[1].kept, uint64_t{4});

  // Given up after the second: both are whole, and listed.
  Progress progress;
  const ProgressScope scope(&progress);
  struct Counting final : FrameExporter {
    Progress* cancelled = nullptr;
    int seen = 0;
    bool finished = false;
    void add(const Snapshot&) override {
      if (++seen == 2) cancelled->cancel();
    }
    void finish() override { finished = true; }
  } exporter;
  exporter.cancelled = &progress;
  QVERIFY_EXCEPTION_THROWN(exportFrames(run, {2, 9, 1}, exporter), Cancelled);
  QCOMPARE(exporter.seen, 2);
  QVERIFY(exporter.finished);
}

/// A project and the recording of the same run give the same files, to what a recording keeps.
void TestExport::theCommandLineExports() {
  QFETCH(const QString, format);
  const QString recording = m_folder.filePath("run.psrec");
  const QStringList scene = smallScene({"--frames", "6", "--record", recording, "--quiet"});
  if (!QFile::exists(recording)) QCOMPARE(cli(scene).code, 0);
  const QString project = m_folder.filePath("p-" + format), recorded = m_folder.filePath("r-" + format);
  QStringList run = smallScene({"--frames", "6", "--every", "3", "--format", format, "--out", project});
  run[0] = QStringLiteral("export");
  Ran ran = cli(run);
  QVERIFY2(ran.code == 0, ran.err.constData());
  QVERIFY2(ran.out.startsWith("3 " + QByteArray(exportFormat(format.toStdString()).ending) + " files in "),
           ran.out.constData());
  ran = cli({"export", recording, "--format", format, "--out", recorded, "--every", "3"});
  QVERIFY2(ran.code == 0, ran.err.constData());
  const QStringList files = QDir(project).entryList(QDir::Files, QDir::Name);
  QCOMPARE(QDir(recorded).entryList(QDir::Files, QDir::Name), files);
  QVERIFY(files.size() >= 3 && files.filter("000000.").size() == 1 && files.filter("000006.").size() == 1);
}

void TestExport::theCommandLineSaysWhatIsWrong_data() {
  QTest::addColumn<QStringList>("options");
  QTest::addColumn<QString>("problem");
  QTest::newRow("no format") << QStringList{"--out", "x"} << "--format must be one of vtp, ply, csv, obj, surface-ply";
  QTest::newRow("another") << QStringList{"--format", "abc", "--out", "x"} << "surface-ply, not 'abc'";
  QTest::newRow("no folder") << QStringList{"--format", "csv"} << "--out is missing: a folder";
  QTest::newRow("no field") << QStringList{"--format", "csv", "--out", "x", "--fields", "speed,sped", "--frames", "0"}
                            << "not 'sped'";
  QTest::newRow("a file") << QStringList{"--format", "csv", "--out", kSample, "--frames", "0"}
                          << "ice-on-hot-plate.json: is not a folder and cannot be made; choose another";
}

void TestExport::theCommandLineSaysWhatIsWrong() {
  QFETCH(const QStringList, options);
  QFETCH(const QString, problem);
  const Ran ran = cli(QStringList{"export", kSample} + options);
  QVERIFY(ran.code == 1 || ran.code == 2);
  QVERIFY2(QString::fromUtf8(ran.err).contains(problem), ran.err.constData());
  QCOMPARE(ran.err.count('\n'), 1);
}

/// Nothing half written stays.
void TestExport::aFullDiskIsSaid() {
  const QString out = m_folder.filePath("full");
  QProcess process;
  process.setChildProcessModifier([] {  // a limit on the size of files stands for the full disk
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tight{4000, 4000};
    ::setrlimit(RLIMIT_FSIZE, &tight);
  });
  process.start(kProgram, {"export", kSample, "--frames", "0", "--format", "csv", "--out", out});
  const Ran ran = ended(process);
  QCOMPARE(ran.code, 1);
  QVERIFY2(ran.err.contains("particles-000000.csv: not saved: "), ran.err.constData());
  QVERIFY(QDir(out).entryList(QDir::Files).isEmpty());
}

QTEST_GUILESS_MAIN(TestExport)
#include "tst_export.moc"
