// SPDX-License-Identifier: Apache-2.0
// Installs this build to a scratch prefix outside the build tree, builds the example plugins there by
// find_package(PhaseSketch) from copies of their sources, and loads them with the installed programs.
#include "core/base/jsontext.h"

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPluginLoader>
#include <QProcess>
#include <QRegularExpression>
#include <QSet>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <cmath>

#include <phasesketch/qtentry.h>

namespace {

constexpr int kLongest = 300'000;  // ms; a busy machine builds the four in half a minute

struct Outcome {
  int code = -1;  // -1: did not start or end
  QByteArray output, errors;
  QByteArray text() const { return output + errors; }
};

Outcome runProgram(const QString& program, const QStringList& arguments, const QString& pluginPath = {}) {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  if (!pluginPath.isEmpty()) environment.insert("PHASESKETCH_PLUGIN_PATH", pluginPath);
  process.setProcessEnvironment(environment);
  process.start(program, arguments);
  if (!process.waitForStarted() || !process.waitForFinished(kLongest))
    return {-1, process.readAllStandardOutput(), process.errorString().toUtf8()};
  const int code = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1;
  return {code, process.readAllStandardOutput(), process.readAllStandardError()};
}

bool copyFolder(const QString& from, const QString& to) {
  QDirIterator it(from, QDir::Files, QDirIterator::Subdirectories);
  while (it.hasNext()) {
    const QString path = it.next(), target = to + '/' + QDir(from).relativeFilePath(path);
    if (!QDir().mkpath(QFileInfo(target).path()) || !QFile::copy(path, target)) return false;
  }
  return true;
}

// The entry of a plugin in `phasesketch-cli plugins --json`, empty when it is not listed.
QJsonObject entryOf(const QByteArray& list, const QString& id) {
  const QJsonArray plugins = QJsonDocument::fromJson(list).object()["plugins"].toArray();
  for (qsizetype i = 0; i < plugins.size(); ++i)
    if (plugins.at(i)["id"].toString() == id) return plugins.at(i).toObject();
  return {};
}

}  // namespace

class InstallationTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase();
  void installedFilesAreThere_data();
  void installedFilesAreThere();
  void filesAreKnownByWhatTheyBeginWith();
  void ownPluginsLoadFromTheInstallation();
  void examplesBuildOutsideTheTree();
  void commandLineLoadsTheExamples_data();
  void commandLineLoadsTheExamples();
  void readmesNameWhatIsInstalled();
  void checkSaysThatExamplesAreFine();
  void examplesRunInAScene();
  void cohesionKeepsMomentum();
  void editorListsTheExamples();
  void editorRunsAScene();
  void examplesInstallBesideTheProgram();

 private:
  QString prefix() const { return m_dir.path() + "/prefix"; }
  QString program(const char* name) const { return prefix() + "/bin/" + name; }
  QString examplesBuild() const { return m_dir.path() + "/build"; }
  QString pluginDirectory() const { return examplesBuild() + "/phasesketch-plugins"; }

  QTemporaryDir m_dir;
};

void InstallationTest::initTestCase() {
  QVERIFY(m_dir.isValid());
  const Outcome installed = runProgram(PS_CMAKE, {"--install", PS_BINARY_DIR, "--prefix", prefix()});
  QVERIFY2(installed.code == 0, installed.text());
}

void InstallationTest::installedFilesAreThere_data() {
  QTest::addColumn<QString>("path");
  for (const char* path :
       {"bin/phasesketch", "bin/phasesketch-cli", "include/phasesketch/qtentry.h", "lib/phasesketch/plugins/water.so",
        "share/phasesketch/plugins/wax.json", "share/phasesketch/projects/ice-on-hot-plate.json",
        "share/phasesketch/examples/README.md", "share/phasesketch/plugins/README.md", "include/phasesketch/stamp.h",
        "lib/cmake/PhaseSketch/PhaseSketchConfigVersion.cmake", "share/doc/phasesketch/LICENSE",
        "share/doc/phasesketch/copyright", "share/applications/phasesketch.desktop",
        "share/icons/hicolor/scalable/apps/phasesketch.svg", "share/mime/packages/phasesketch.xml",
        "share/metainfo/org.phasesketch.phasesketch.metainfo.xml", "share/man/man1/phasesketch-cli.1.gz"})
    QTest::newRow(path) << path;
}

void InstallationTest::installedFilesAreThere() {
  QFETCH(QString, path);
  QVERIFY(QFileInfo(prefix() + '/' + path).isFile());
}

/// As the desktop tells them by shared-mime-info: projects from other JSON files, recordings.
void InstallationTest::filesAreKnownByWhatTheyBeginWith() {
  QFile file(prefix() + "/share/mime/packages/phasesketch.xml");
  QVERIFY(file.open(QIODevice::ReadOnly));
  QXmlStreamReader xml(&file);
  QList<QByteArray> begins;
  QStringList types;
  while (!xml.atEnd()) {
    if (xml.readNext() != QXmlStreamReader::StartElement) continue;
    if (xml.name() == QStringLiteral("match")) begins << xml.attributes().value("value").toUtf8().replace("\\n", "\n");
    if (xml.name() == QStringLiteral("mime-type")) types << xml.attributes().value("type").toString();
  }
  QCOMPARE(xml.errorString(), QString());
  QCOMPARE(begins.size(), 2);
  const QString project = m_dir.filePath("p.json"), recording = m_dir.filePath("r.psrec");
  const QString sample = prefix() + "/share/phasesketch/projects/ice-on-hot-plate.json";
  const Outcome ran = runProgram(program("phasesketch-cli"), {"simulate", sample, "--frames", "1", "--quiet",
                                                              "--save-project", project, "--record", recording});
  QVERIFY2(ran.code == 0, ran.text());
  for (const auto& [path, begin] : {std::pair{sample, begins[0]}, {project, begins[0]}, {recording, begins[1]}}) {
    QFile written(path);
    QVERIFY(written.open(QIODevice::ReadOnly));
    QCOMPARE(written.read(begin.size()), begin);
  }
  QFile desktop(prefix() + "/share/applications/phasesketch.desktop");
  QVERIFY(desktop.open(QIODevice::ReadOnly));
  const QList<QByteArray> lines = desktop.readAll().split('\n');
  QVERIFY(lines.contains("Exec=phasesketch %f") && lines.contains("Icon=phasesketch"));
  QVERIFY(lines.contains("MimeType=" + types.join(';').toUtf8() + ';'));
}

void InstallationTest::ownPluginsLoadFromTheInstallation() {
  const Outcome list = runProgram(program("phasesketch-cli"), {"plugins", "--json"});
  QVERIFY2(list.code == 0, list.text());
  for (const char* id :
       {"water", "wax", "bonds", "enthalpy", "thesis_latent", "sphere", "cube", "tube", "spray", "heat", "grab"}) {
    const QJsonObject entry = entryOf(list.output, id);
    QVERIFY2(entry["state"] == "loaded", id + (": " + QJsonDocument(entry).toJson()));
    const QString home = QFileInfo(prefix()).canonicalFilePath();
    QVERIFY2(entry["path"].toString().startsWith(home), qPrintable(entry["path"].toString()));
  }
}

void InstallationTest::examplesBuildOutsideTheTree() {
  const QString source = m_dir.path() + "/examples";
  QVERIFY(copyFolder(prefix() + "/share/phasesketch/examples", source));
  const Outcome configured = runProgram(
      PS_CMAKE, {"-S", source, "-B", examplesBuild(), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 "-DCMAKE_PREFIX_PATH=" + prefix(), QStringLiteral("-DCMAKE_CXX_COMPILER=") + PS_CXX_COMPILER,
                 QStringLiteral("-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")});
  QVERIFY2(configured.code == 0, configured.text());
  const Outcome built = runProgram(PS_CMAKE, {"--build", examplesBuild(), "-j", "2"});
  QVERIFY2(built.code == 0, built.text());
}

void InstallationTest::commandLineLoadsTheExamples_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<QString>("kind");
  QTest::newRow("material") << "org.example.honey"
                            << "material";
  QTest::newRow("neighbours") << "org.example.cohesion"
                              << "constraint";
  QTest::newRow("structure") << "org.example.tether"
                             << "constraint";
  QTest::newRow("groups") << "org.example.clump"
                          << "constraint";
  QTest::newRow("heat source") << "org.example.lamp"
                               << "heat_source";
  QTest::newRow("thermal") << "org.example.sensible"
                           << "thermal";
  QTest::newRow("brush") << "org.example.ring"
                         << "brush";
}

void InstallationTest::commandLineLoadsTheExamples() {
  QFETCH(QString, id);
  QFETCH(QString, kind);
  const Outcome without = runProgram(program("phasesketch-cli"), {"plugins", "--json"});
  QVERIFY2(entryOf(without.output, id).isEmpty(), "is there before it was built");
  const Outcome list = runProgram(program("phasesketch-cli"), {"plugins", "--json"}, pluginDirectory());
  QVERIFY2(list.code == 0, list.text());
  const QJsonObject entry = entryOf(list.output, id);
  QVERIFY2(entry["state"] == "loaded", QJsonDocument(entry).toJson());
  QCOMPARE(entry["kind"].toString(), kind);
  QCOMPARE(entry["licence"].toString(), QStringLiteral("MIT"));
}

void InstallationTest::readmesNameWhatIsInstalled() {
  // Every path in code quotes that looks like one of ours must be there.
  const QString examples = prefix() + "/share/phasesketch/examples";
  QFile file(examples + "/README.md");
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QString text = QString::fromUtf8(file.readAll());
  QRegularExpressionMatchIterator it =
      QRegularExpression("^\\| `([a-z]+)` \\|", QRegularExpression::MultilineOption).globalMatch(text);
  int folders = 0;
  for (; it.hasNext(); ++folders) {
    const QString name = it.next().captured(1);
    QVERIFY2(QFileInfo(examples + "/" + name + "/" + name + ".cpp").isFile(), qPrintable(name));
  }
  QCOMPARE(folders, QDir(examples).entryList(QDir::Dirs | QDir::NoDotAndDotDot).size());
  QVERIFY(text.contains("share/phasesketch/plugins"));
  QFile materials(prefix() + "/share/phasesketch/plugins/README.md");
  QVERIFY(materials.open(QIODevice::ReadOnly));
  const QString other = QString::fromUtf8(materials.readAll());
  // Files and folders in code quotes; those of a user's own end otherwise.
  int files = 0;
  QRegularExpressionMatchIterator named = QRegularExpression("`([a-z]+)(\\.json|/)`").globalMatch(text + other);
  for (; named.hasNext(); ++files) {
    const QString name = named.next().captured(0).remove('`');
    if (name == "mymaterial.json") continue;
    QVERIFY2(QFileInfo(prefix() + "/share/phasesketch/plugins/" + name).exists() ||
                 QFileInfo(examples + "/" + name).exists(),
             qPrintable(name));
  }
  QVERIFY(files >= 2);
  QVERIFY2(other.contains(QString("more than %1 levels of brackets").arg(ps::kMaximumDepth)), "another limit");
}

void InstallationTest::checkSaysThatExamplesAreFine() {
  for (const char* name : {"honey", "tether", "clump", "cohesion", "sensible", "lamp", "ring", "whisk", "moss"}) {
    const QString path = pluginDirectory() + "/" + name + ".so";
    const Outcome outcome = runProgram(program("phasesketch-cli"), {"plugins", "--check", path});
    QVERIFY2(outcome.code == 0 && outcome.output.startsWith((path + ": fine: ").toUtf8()), outcome.text());
  }
}

void InstallationTest::examplesRunInAScene() {
  QFile file(m_dir.filePath("honey.json"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(R"({
    "format": "phasesketch", "version": 1,
    "pluginsRequired": ["org.example.cohesion", "org.example.clump", "org.example.honey", "org.example.sensible",
                        "org.example.lamp"],
    "materials": [{"id": "honey", "base": "org.example.honey", "parameters": {"moisture": 0.2}}],
    "bodies": [{"id": "drop", "material": "honey", "temperature": 310,
                "shape": {"box": {"center": [0, 0.2, 0], "size": [0.16, 0.16, 0.16]}},
                "constraints": [{"plugin": "org.example.cohesion"}, {"plugin": "org.example.clump"}]}],
    "environment": {"bounds": {"minimum": [-0.5, 0, -0.5], "maximum": [0.5, 1, 0.5]},
                    "walls": [{"id": "floor", "point": [0, 0, 0], "normal": [0, 1, 0]}]},
    "solver": {"particle_spacing": 0.016, "thermal": {"model": "org.example.sensible",
               "sources": [{"plugin": "org.example.lamp", "parameters": {"intensity": 2000}}]}}
  })");
  file.close();
  const QString report = m_dir.filePath("report.json");
  const QStringList arguments{"simulate", file.fileName(), "--frames", "20", "--report", report};
  const Outcome missing = runProgram(program("phasesketch-cli"), arguments);
  QVERIFY2(missing.code == 2, "a scene whose plugins are missing must be refused: " + missing.text());
  const Outcome done = runProgram(program("phasesketch-cli"), arguments, pluginDirectory());
  QVERIFY2(done.code == 0, done.text());
  QVERIFY2(done.errors.isEmpty(), done.errors);  // no warning: every key is known
  QFile written(report);
  QVERIFY(written.open(QIODevice::ReadOnly));
  const QJsonObject result = QJsonDocument::fromJson(written.readAll()).object();
  QCOMPARE(result["particles"].toInt(), 1000);  // 10 along each edge of 16 cm
  // A third of a second of air at 20 °C takes 0.1 K at most.
  QVERIFY2(std::abs(result["temperature"]["mean"].toDouble() - 310) < 0.1, done.text());
  QCOMPARE(result["frames"].toInt(), 20);
  QVERIFY2(result["flags"].toArray().isEmpty(), done.text());
  QCOMPARE(result["phases"]["liquid"]["count"].toInt(), 1000);  // the model has no latent heat, and honey never freezes
}

void InstallationTest::cohesionKeepsMomentum() {
  // Water beside mercury: the pulls must be equal and opposite though the masses are not.
  using namespace ps::api;
  QPluginLoader loader(pluginDirectory() + "/cohesion.so");
  const auto* cohesion = qobject_cast<NeighbourPlugin*>(loader.instance());
  QVERIFY2(cohesion, qPrintable(loader.errorString()));
  Float4 position[] = {{0, 0, 0, 0}, {0.02f, 0.01f, 0, 0}, {0.01f, 0.02f, 0.01f, 0}};
  Float4 velocity[3]{};
  const float mass[] = {0.008f, 0.108f, 0.008f};
  const Motion motion[] = {Motion::Liquid, Motion::Liquid, Motion::Liquid};
  const uint32_t body[] = {0, 0, 0}, members[] = {0, 1, 2};
  const uint32_t index[] = {1, 2, 0, 2, 0, 1}, begin[] = {0, 2, 4}, last[] = {2, 4, 6};
  ParticleView particles{};
  particles.count = 3;
  particles.position = position;
  particles.velocity = velocity;
  particles.mass = mass;
  particles.motion = motion;
  particles.body = body;
  NeighbourView neighbours{};
  neighbours.begin = begin;
  neighbours.last = last;
  neighbours.index = index;
  ConstraintContext context{};
  context.dt = 1.0 / 60;
  context.supportRadius = 0.04;
  Float4 correction[3]{};
  cohesion->gather(context, particles, neighbours, {members, 3}, correction);
  double sum[3]{}, size = 0;
  for (int i = 0; i < 3; ++i) {
    const double m = double{mass[i]};
    sum[0] += m * double{correction[i].x};
    sum[1] += m * double{correction[i].y};
    sum[2] += m * double{correction[i].z};
    size += m * std::abs(double{correction[i].x});
  }
  QVERIFY(size > 0);
  for (const double s : sum) QVERIFY(std::abs(s) < 1e-6 * size);  // corrections are float: 6e-8 of each
}

void InstallationTest::editorListsTheExamples() {
  const Outcome list = runProgram(program("phasesketch"), {"--list-plugins"}, pluginDirectory());
  QVERIFY2(list.code == 0, list.text());
  for (const char* id :
       {"org.example.honey", "org.example.tether", "org.example.clump", "org.example.cohesion", "org.example.sensible",
        "org.example.lamp", "org.example.ring", "org.example.whisk", "org.example.moss"}) {
    bool loaded = false;
    for (const QByteArray& line : list.output.split('\n'))
      loaded = loaded || (line.startsWith(id) && line.contains("loaded"));
    QVERIFY2(loaded, id + (" is not loaded:\n" + list.text()));
  }
}

void InstallationTest::editorRunsAScene() {
  const QString picture = m_dir.filePath("editor.png");
  const Outcome drawn =
      runProgram(program("phasesketch"),
                 {"--screenshot", picture, "--after", "0.2", "--size", "1280x800", m_dir.filePath("honey.json")},
                 pluginDirectory());
  QVERIFY2(drawn.code == 0, drawn.text());
  const QImage image(picture);
  QCOMPARE(image.size(), QSize(1280, 800));
  // A window with panels and a scene has some hundred colours; a blank one has one.
  QSet<QRgb> colours;
  for (int y = 0; y < image.height(); y += 4)
    for (int x = 0; x < image.width(); x += 4) colours.insert(image.pixel(x, y));
  QVERIFY2(colours.size() > 100, qPrintable(QString::number(colours.size())));
}

void InstallationTest::examplesInstallBesideTheProgram() {
  const Outcome installed = runProgram(PS_CMAKE, {"--install", examplesBuild(), "--prefix", prefix()});
  QVERIFY2(installed.code == 0, installed.text());
  const Outcome list = runProgram(program("phasesketch-cli"), {"plugins", "--json"});
  QVERIFY2(entryOf(list.output, "org.example.honey")["state"] == "loaded", list.text());
}

QTEST_GUILESS_MAIN(InstallationTest)
#include "tst_installation.moc"
