// SPDX-License-Identifier: Apache-2.0
// What the sample project must show, from its own file and through the program that people run; only the particles are
// coarser (4 cm for 2 cm, 800 for 6000), so that the whole minute passes in seconds.
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

 private:
  nlohmann::json run(const QStringList& more);
  QList<double> column(const QString& title) const;

  QTemporaryDir m_folder;
  nlohmann::json m_start, m_end;  // reports before the first frame and after the last
  QStringList m_titles;
  QList<QList<double>> m_rows;  // of the probes' file: the start's, and one per frame
};

nlohmann::json TestSample::run(const QStringList& more) {
  const QString report = m_folder.filePath("report.json");
  QFile::remove(report);
  const QString sample = QStringLiteral(PS_SOURCE_DIR "/projects/ice-on-hot-plate.json");
  QProcess process;
  process.start(PS_BINARY_DIR "/bin/phasesketch-cli",
                QStringList{"simulate", sample, "--set", "solver/particle_spacing=0.04", "--threads", "1", "--quiet",
                            "--report", report} +
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
  m_start = run({"--frames", "0"});
  m_end = run({"--probes", probes});
  QVERIFY(m_start.is_object() && m_end.is_object());
  QFile file(probes);
  QVERIFY(file.open(QIODevice::ReadOnly | QIODevice::Text));
  m_titles = QString::fromUtf8(file.readLine()).trimmed().split(',');
  while (!file.atEnd()) {
    m_rows.emplaceBack();
    for (const QByteArray& cell : file.readLine().trimmed().split(',')) m_rows.back() << cell.toDouble();
    QCOMPARE(m_rows.back().size(), m_titles.size());
  }
  QCOMPARE(m_rows.size(), m_end["frames"].get<int>() + 1);
  QCOMPARE(m_end["frames"].get<int>(), 3600);  // the project's own 60 s
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

QTEST_APPLESS_MAIN(TestSample)
#include "tst_sample.moc"
