// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QFileInfo>
#include <QtCore/QLocale>
#include <QtCore/QProcess>
#include <QtCore/QString>
#include <QtCore/QTemporaryDir>

#include <clocale>

namespace ps {

/// The languages in which typed numbers are tested: one with a comma, one with a point.
inline constexpr const char* kNumberLocales[] = {"de_DE", "en_US"};

/// While it lives, the C library and Qt write numbers as there: "1,5" in de_DE. The C library's locale is made on the
/// spot, since hardly any machine has it; where that fails, problem() says why, and a test must fail with it.
class LocalNumbers {
 public:
  explicit LocalNumbers(const QString& name) : m_problem(make(name)) {
    if (!m_problem.isEmpty()) return;
    const QLocale there(name);
    QLocale::setDefault(there);
    const bool taken = std::setlocale(LC_NUMERIC, (name + QStringLiteral(".UTF-8")).toUtf8().constData());
    if (!taken || QString::fromUtf8(std::localeconv()->decimal_point) != there.decimalPoint())
      m_problem = QStringLiteral("the C library does not take the locale %1 that localedef made").arg(name);
  }
  ~LocalNumbers() {
    std::setlocale(LC_NUMERIC, "C");
    QLocale::setDefault(QLocale::c());
  }
  LocalNumbers(const LocalNumbers&) = delete;
  LocalNumbers& operator=(const LocalNumbers&) = delete;
  const QString& problem() const { return m_problem; }  ///< "" when they are in force

 private:
  /// Once per program, in a folder that goes with it.
  static QString make(const QString& name) {
    static const QTemporaryDir directory;
    const QString made = directory.filePath(name + QStringLiteral(".UTF-8"));
    if (!QFileInfo::exists(made)) {
      QProcess localedef;
      localedef.setProcessChannelMode(QProcess::MergedChannels);
      localedef.start(QStringLiteral("localedef"),
                      {QStringLiteral("-i"), name, QStringLiteral("-f"), QStringLiteral("UTF-8"), made});
      const bool done = localedef.waitForFinished(60000) && localedef.exitStatus() == QProcess::NormalExit;
      if (!done || localedef.exitCode() != 0)
        return QStringLiteral("NO LOCALE %1: localedef could not make it (package locales?): ").arg(name) +
               (done ? QString::fromUtf8(localedef.readAll()).trimmed() : localedef.errorString());
    }
    qputenv("LOCPATH", directory.path().toUtf8());
    return {};
  }
  QString m_problem;
};

}  // namespace ps
