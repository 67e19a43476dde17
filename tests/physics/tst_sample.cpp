// SPDX-License-Identifier: Apache-2.0
// What sample projects must show, from their own files and through the program that people run; only the particles are
// coarser (of ice on a hot plate 4 cm for 2 cm, 800 for 6000), so that the whole minute passes in seconds.
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

class TestSample : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase();
  void startsAllSolid();
  void meltsThroughAPlateau();
  void endsWithLiquidAndGas();
  void keepsEveryParticleAndItsMass();
  void keepsItsEnergy();
  void keepsItsDensity();
  void setsNoFlags();
  void thawAndFrostGoesByItsKeys();

 private:
  nlohmann::json run(const QString& sample, const char* spacing, const QStringList& more);
  void readProbes(const QString& path);
  QList<double> column(const QString& title) const;

  QTemporaryDir m_folder;
  nlohmann::json m_start, m_end;  // reports before the first frame and after the last
  QStringList m_titles;
  QList<QList<double>> m_rows;  // of the probes' file: the start's, and one per frame
};

nlohmann::json TestSample::run(const QString& name, const char* spacing, const QStringList& more) {
  const QString report = m_folder.filePath("report.json");
  QFile::remove(report);
  const QString sample = QStringLiteral(PS_SOURCE_DIR "/projects/%1.json").arg(name);
  QProcess process;
  process.start(
      PS_BINARY_DIR "/bin/phasesketch-cli",
      QStringList{"simulate", sample, "--set", QStringLiteral("solver/particle_spacing=%1").arg(QLatin1String(spacing)),
                  "--threads", "1", "--quiet", "--report", report} +
          more);
  if (!process.waitForFinished(-1) || process.exitCode() != 0) {
    qWarning("%s", process.readAllStandardError().constData());
    return nullptr;
  }
  QFile file(report);
  if (!file.open(QIODevice::ReadOnly)) return nullptr;
  return nlohmann::json::parse(file.readAll().toStdString(), nullptr, false);
}

QList<double> TestSample::column(const QString& title) const {
  QList<double> values;
  const qsizetype index = m_titles.indexOf(title);
  if (index < 0) return values;
  for (const QList<double>& row : m_rows) values << row.at(index);
  return values;
}

void TestSample::initTestCase() {
  const QString probes = m_folder.filePath("probes.csv");
  const QString sample = QStringLiteral("ice-on-hot-plate");
  m_start = run(sample, "0.04", {"--frames", "0"});
  m_end = run(sample, "0.04", {"--probes", probes});
  QVERIFY(m_start.is_object() && m_end.is_object());
  readProbes(probes);
  QCOMPARE(m_rows.size(), m_end["frames"].get<int>() + 1);
  QCOMPARE(m_end["frames"].get<int>(), 3600);  // the project's own 60 s
}

void TestSample::readProbes(const QString& path) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly | QIODevice::Text));
  m_rows.clear();
  m_titles = QString::fromUtf8(file.readLine()).trimmed().split(',');
  while (!file.atEnd()) {
    m_rows.emplaceBack();
    for (const QByteArray& cell : file.readLine().trimmed().split(',')) m_rows.back() << cell.toDouble();
    QCOMPARE(m_rows.back().size(), m_titles.size());
  }
}

void TestSample::startsAllSolid() {
  QCOMPARE(m_start["particles"].get<int>(), 800);
  QCOMPARE(m_start["phases"]["solid"]["count"].get<int>(), 800);
  QCOMPARE(m_start["temperature"]["max"].get<double>(), 263.15);
}

void TestSample::meltsThroughAPlateau() {
  const QList<double> core = column("Ice core.temperature_min[K]"), solid = column("solid.mass[kg]"),
                      melting = column("melting.mass[kg]");
  QVERIFY(!core.isEmpty() && !solid.isEmpty() && !melting.isEmpty());
  QVERIFY(core.first() < 264 && core.last() > 300);
  // The last of the ice waits at the melting point until it has its latent heat: for 10 s here, half of that is asked.
  const auto onPlateau = std::count_if(core.begin(), core.end(), [](double t) { return std::abs(t - 273.15) < 0.01; });
  QVERIFY2(onPlateau > 300, qPrintable(QString::number(onPlateau)));
  for (qsizetype i = 0; i < core.size(); ++i)
    if (std::abs(core[i] - 273.15) < 0.01) QVERIFY2(solid[i] + melting[i] > 0, qPrintable(QString::number(i)));
  QCOMPARE(solid.last() + melting.last(), 0.0);
}

void TestSample::endsWithLiquidAndGas() {
  QVERIFY(m_end["phases"]["liquid"]["count"].get<int>() > 0);
  QVERIFY(m_end["phases"]["gas"]["count"].get<int>() > 0);
}

void TestSample::keepsEveryParticleAndItsMass() {
  int count = 0;
  for (const auto& phase : m_end["phases"]) count += phase["count"].get<int>();
  QCOMPARE(count, 800);
  QCOMPARE(m_end["particles"].get<int>(), 800);
  const double mass = m_start["phases"]["solid"]["mass"].get<double>();
  // Cubes of 4 cm of ice at -10 °C, 918 kg/m3; half a percent for the fit of its density.
  QVERIFY2(std::abs(mass / (800 * 0.04 * 0.04 * 0.04 * 918) - 1) < 0.005, qPrintable(QString::number(mass)));
  QList<double> sums(m_rows.size(), 0.0);
  for (const char* phase : {"solid", "melting", "liquid", "boiling", "gas"}) {
    const QList<double> masses = column(QString(phase) + ".mass[kg]");
    QCOMPARE(masses.size(), sums.size());
    std::transform(sums.begin(), sums.end(), masses.begin(), sums.begin(), std::plus<>());
  }
  // Masses never change; only the order of the sum does.
  for (const double sum : sums) QVERIFY2(std::abs(sum / mass - 1) < 1e-12, qPrintable(QString::number(sum, 'g', 17)));
}

void TestSample::keepsItsEnergy() {
  const double exchanged = m_end["energy"]["exchanged"].get<double>(), drift = m_end["energy"]["drift"].get<double>();
  QVERIFY(exchanged > 1e7);  // the block takes 334 kJ/kg to melt alone
  QVERIFY2(std::abs(drift) < 1e-4 * exchanged, qPrintable(QString::number(drift / exchanged)));
}

void TestSample::keepsItsDensity() {
  const double error = m_end["density_error"]["mean"].get<double>();
  QVERIFY2(error > 0 && error < 0.02, qPrintable(QString::number(error)));
}

void TestSample::setsNoFlags() { QVERIFY2(m_end["flags"] == nlohmann::json::array(), m_end["flags"].dump().c_str()); }

/// All has melted before its floor cools, at 20 s, all is frozen before it warms again, at 42 s, and little of it at
/// the end. Of the last sample's rows.
void TestSample::thawAndFrostGoesByItsKeys() {
  const QString probes = m_folder.filePath("thaw.csv");
  const nlohmann::json report = run(QStringLiteral("thaw-and-frost"), "0.025", {"--probes", probes});
  QVERIFY(report.is_object() && report["flags"].empty());
  readProbes(probes);
  const QList<double> solid = column("Ice.solid_mass[kg]"), liquid = column("Water.liquid_mass[kg]");
  QCOMPARE(solid.size(), 3601);
  const double all = solid[0];
  QVERIFY(all > 1);
  QCOMPARE(liquid[0], 0.0);
  QCOMPARE(solid[20 * 60], 0.0);
  QVERIFY(std::abs(liquid[20 * 60] - all) < 1e-9 * all);
  QVERIFY(std::abs(solid[42 * 60] - all) < 1e-9 * all);
  QVERIFY(liquid[60 * 60] > 0.9 * all);
}

QTEST_APPLESS_MAIN(TestSample)
#include "tst_sample.moc"
