// SPDX-License-Identifier: Apache-2.0
// What the samples with machines must show, from their own files and through the program that people run; and that
// every sample opens without a complaint.
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace {
const QString kProjects = QStringLiteral(PS_SOURCE_DIR "/projects/");
}

class TestMachines : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everySampleOpensWithoutComplaint() {
    const QStringList files = QDir(kProjects).entryList({"*.json"});
    QVERIFY(files.size() >= 11);
    QStringList arguments{"validate"};
    for (const QString& file : files) arguments << kProjects + file;
    QProcess process;
    process.start(PS_BINARY_DIR "/bin/phasesketch-cli", arguments);
    QVERIFY(process.waitForFinished(-1));
    const QByteArray complaints = process.readAllStandardError();
    QVERIFY2(process.exitCode() == 0 && complaints.isEmpty(), complaints.constData());
  }

  void gearsInWater() {
    QVERIFY(run("gears-in-water.json", 8));
    // The drive turns at -2.8 rad/s from the first second on; a gear as large that lies on it turns the other way at as
    // much, less what it hops over teeth, up to half of it. The mean over the last five seconds.
    const double spin = mean(column("Iron gear.spin_z[rad/s]"), 3 * 60);
    QVERIFY2(spin > 1.4 && spin < 3.5, qPrintable(QString::number(spin)));
    // It stays between its guides, above the drive; stone stays on the ground and wood on the water, 0.3 m deep.
    const QList<double> iron = column("Iron gear.height[m]");
    QVERIFY2(least(iron) > 0.38 && most(iron) < 0.6, qPrintable(QString("%1 %2").arg(least(iron)).arg(most(iron))));
    QVERIFY(most(column("Stone gear.height[m]")) < 0.25);
    QVERIFY(least(column("Wooden gear.height[m]")) > 0.27);
  }

  void pailAndPulley() {
    QVERIFY(run("pail-and-pulley.json", 11));
    const QList<double> pail = column("Pail.height[m]"), stone = column("Stone.height[m]"),
                        water = column("Water.mass[kg]"), lowest = column("Lowest water.position_y_min[m]");
    // Empty, the pail (1.35 kg) is held up by the stone (2.25 kg) on the floor; full (and 2.6 kg) it lifts the stone.
    QVERIFY2(pail.at(60) > 0.3 && stone.at(60) < 0.06, qPrintable(QString::number(pail.at(60))));
    QVERIFY2(pail.last() < 0.1 && stone.last() > 0.3, qPrintable(QString::number(pail.last())));
    // It begins to sink when the load outweighs the stone, and friction with it: between 0.9 kg and the tap's 2.6 kg.
    const auto sank = std::find_if(pail.begin() + 60, pail.end(), [&](double y) { return y < pail.at(60) - 0.05; });
    const double load = water.at(sank - pail.begin());
    QVERIFY2(load > 0.9 && load < 2.6, qPrintable(QString::number(load)));
    // The floor of the pail lies 0.08 m below its middle, and no water below that, until it has sunk.
    for (qsizetype i = 90; i < sank - pail.begin(); ++i)
      QVERIFY2(lowest.at(i) > pail.at(i) - 0.08, qPrintable(QString("%1 at %2").arg(lowest.at(i)).arg(i)));
    // The rope stays on the pulley, whose groove is 0.85 m high.
    QVERIFY(least(column("Top of the rope.height_max[m]")) > 0.85);
  }

 private:
  /// False when the run failed or raised a flag.
  bool run(const QString& project, int seconds) {
    const QString report = m_folder.filePath("report.json"), probes = m_folder.filePath("probes.csv");
    QProcess process;
    process.start(PS_BINARY_DIR "/bin/phasesketch-cli",
                  {"simulate", kProjects + project, "--seconds", QString::number(seconds), "--threads", "2", "--quiet",
                   "--report", report, "--probes", probes});
    if (!process.waitForFinished(-1) || process.exitCode() != 0) {
      qWarning("%s", process.readAllStandardError().constData());
      return false;
    }
    m_rows.clear();
    QFile table(probes), file(report);
    if (!table.open(QIODevice::ReadOnly | QIODevice::Text) || !file.open(QIODevice::ReadOnly)) return false;
    m_titles = QString::fromUtf8(table.readLine()).trimmed().split(',');
    while (!table.atEnd()) {
      m_rows.emplaceBack();
      for (const QByteArray& cell : table.readLine().trimmed().split(',')) m_rows.back() << cell.toDouble();
    }
    const nlohmann::json flags = nlohmann::json::parse(file.readAll().toStdString())["flags"];
    if (flags != nlohmann::json::array()) qWarning("%s", flags.dump().c_str());
    return flags == nlohmann::json::array() && m_rows.size() == 60 * seconds + 1;
  }
  QList<double> column(const QString& title) const {
    const qsizetype index = m_titles.indexOf(title);
    QList<double> values;
    for (const QList<double>& row : m_rows) values << (index < 0 ? qQNaN() : row.at(index));
    return values;
  }
  static double mean(const QList<double>& values, qsizetype from) {
    return std::accumulate(values.begin() + from, values.end(), 0.0) / static_cast<double>(values.size() - from);
  }
  static double least(const QList<double>& values) { return *std::min_element(values.begin(), values.end()); }
  static double most(const QList<double>& values) { return *std::max_element(values.begin(), values.end()); }

  QTemporaryDir m_folder;
  QStringList m_titles;
  QList<QList<double>> m_rows;  // the start's and one per frame
};

QTEST_APPLESS_MAIN(TestMachines)
#include "tst_machines.moc"
