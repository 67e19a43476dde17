// SPDX-License-Identifier: Apache-2.0
// Edits and saves FOLDER/scene.json as the editor does, with copies in FOLDER/copies, and says on standard output what
// it was told: "saved K", "kept K" (a copy), "failed: ...". K counts the edits, and is what the floor's temperature
// says.
//   keeper FOLDER once       three edits: kept, saved, kept; then it is gone as by a crash
//   keeper FOLDER loop       edits and saves until it is killed
//   keeper FOLDER settings   counts its runs in the settings: "saved K"
#include "core/plugin_host/pluginscan.h"
#include "tests/ui/desk.h"
#include "tests/ui/keeping/edits.h"
#include "ui/session/settingsformat.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEventLoop>
#include <QtCore/QFileInfo>
#include <QtCore/QSettings>
#include <QtCore/QTimer>

#include <deque>
#include <unistd.h>

using namespace ps;

namespace {

/// Past all buffers: what was said stands when the program is killed.
void say(const QString& line) {
  const QByteArray bytes = line.toUtf8() + '\n';
  if (::write(STDOUT_FILENO, bytes.constData(), static_cast<size_t>(bytes.size())) < 0) ::_exit(4);
}

class Keeper : public QObject {
 public:
  explicit Keeper(const QString& folder)
      : m_path(folder + QStringLiteral("/scene.json")), m_desk(m_plugins, folder + QStringLiteral("/copies")) {
    connect(&m_desk.files, &DocumentFiles::saved, this, [this] {
      say(QStringLiteral("saved %1").arg(m_saving.front()));
      m_saving.pop_front();
      m_waiting.quit();
    });
    connect(&m_desk.autosave, &Autosave::autosaved, this, [this] { m_waiting.exit(1); });
    connect(&m_desk.autosave, &Autosave::failed, this, [this](const QString& problem) { fail(problem); });
    connect(&m_desk.files, &DocumentFiles::openFailed, this, [this](const QString&, const QString& why) { fail(why); });
    connect(&m_desk.files, &DocumentFiles::saveFailed, this, [this](const QString&, const QString& why) { fail(why); });
    connect(&m_desk.files, &DocumentFiles::saveRefused, this,
            [this](const QString&, SaveRefusal, const QString& why) { fail(why); });
    connect(&m_desk.files, &DocumentFiles::opened, this, [this] { m_waiting.quit(); });
  }

  bool open() {
    m_desk.files.open(m_path);
    const bool good = m_waiting.exec() == 0;
    m_edit = editOf(m_desk.document.project());
    return good;
  }

  int once() {
    edit();
    const bool kept = keep();
    edit();
    const bool saved = save();
    edit();
    return kept & saved & keep() ? 0 : 1;
  }

  void loop() {
    m_desk.autosave.start();
    for (;;) {
      edit();
      if (m_edit % 3 == 0) m_desk.autosave.saveNow();
      m_saving.push_back(m_edit);
      m_desk.files.save(m_path);
      if (m_edit % 2 == 0) edit();  // before the save is heard of
      while (!m_saving.empty() && m_problems == 0) m_waiting.exec();
      if (m_problems > 0) return;
    }
  }

 private:
  void edit() { m_desk.document.setParameter(kFloor, kelvinOf(++m_edit)); }
  bool keep() {
    m_desk.autosave.saveNow();
    if (m_waiting.exec() != 1) return false;
    say(QStringLiteral("kept %1").arg(m_edit));
    return true;
  }
  bool save() {
    m_saving = {m_edit};
    m_desk.files.save(m_path);
    return m_waiting.exec() == 0;
  }
  void fail(const QString& problem) {
    say(QStringLiteral("failed: ") + problem);
    ++m_problems;
    m_waiting.exit(2);
  }

  QString m_path;
  PluginRegistry m_plugins;
  Desk m_desk;
  QEventLoop m_waiting;
  std::deque<int> m_saving;  ///< edits that were saved and not heard of
  int m_edit = 0, m_problems = 0;
};

int countRuns() {
  QCoreApplication::setOrganizationName(QStringLiteral("phasesketch"));
  QCoreApplication::setApplicationName(QStringLiteral("phasesketch"));
  keepSettingsWhole();
  QSettings settings;
  const int runs = settings.value(QStringLiteral("runs")).toInt() + 1;
  settings.setValue(QStringLiteral("runs"), runs);
  settings.sync();
  const bool good = settings.status() == QSettings::NoError;
  say(good ? QStringLiteral("saved %1").arg(runs) : QStringLiteral("failed: settings"));
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  servePluginScans(argc, argv);
  QCoreApplication application(argc, argv);
  const QStringList arguments = QCoreApplication::arguments();
  if (arguments.size() != 3) return 2;
  if (arguments[2] == QStringLiteral("settings")) return countRuns();
  Keeper keeper(arguments[1]);
  if (!keeper.open()) ::_exit(1);
  say(QStringLiteral("open"));
  if (arguments[2] == QStringLiteral("loop")) keeper.loop();
  ::_exit(keeper.once());
}
