// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QLocale>
#include <QtCore/QProcess>
#include <QtCore/QString>
#include <QtCore/QTemporaryDir>

#include <clocale>

namespace ps {

/// While it lives, the C library and Qt write numbers as in Germany: "1,5". The C library's locale is made on the spot,
/// since hardly any machine has it; where that fails, problem() says why, and a test must skip with it.
class GermanNumbers {
 public:
  GermanNumbers() : m_problem(make()) {
    if (!m_problem.isEmpty()) return;
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8") || QString::fromUtf8(std::localeconv()->decimal_point) != ",")
      m_problem = QStringLiteral("the C library does not take the German locale that localedef made");
  }
  ~GermanNumbers() {
    std::setlocale(LC_NUMERIC, "C");
    QLocale::setDefault(QLocale::c());
  }
  GermanNumbers(const GermanNumbers&) = delete;
  GermanNumbers& operator=(const GermanNumbers&) = delete;
  const QString& problem() const { return m_problem; }  ///< "" when they are in force

 private:
  /// Once per program, in a folder that goes with it.
  static QString make() {
    static const QTemporaryDir directory;
    static const QString problem = [] {
      QProcess localedef;
      localedef.setProcessChannelMode(QProcess::MergedChannels);
      localedef.start(QStringLiteral("localedef"),
                      {QStringLiteral("-i"), QStringLiteral("de_DE"), QStringLiteral("-f"), QStringLiteral("UTF-8"),
                       directory.filePath(QStringLiteral("de_DE.UTF-8"))});
      const bool done = localedef.waitForFinished(60000) && localedef.exitStatus() == QProcess::NormalExit;
      if (!done || localedef.exitCode() != 0)
        return QStringLiteral("NO GERMAN LOCALE: localedef could not make it (package locales?): ") +
               (done ? QString::fromUtf8(localedef.readAll()).trimmed() : localedef.errorString());
      qputenv("LOCPATH", directory.path().toUtf8());
      return QString();
    }();
    return problem;
  }
  QString m_problem;
};

}  // namespace ps
