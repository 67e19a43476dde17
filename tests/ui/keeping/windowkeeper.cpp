// SPDX-License-Identifier: Apache-2.0
// The editor's window on FOLDER/scene.json with copies in FOLDER/copies, while it runs and somebody edits and saves,
// until it is killed. Says what keeper says.
//   windowkeeper FOLDER loop
#include "core/plugin_host/pluginscan.h"
#include "tests/ui/keeping/edits.h"
#include "ui/document/document.h"
#include "ui/session/autosave.h"
#include "ui/session/documentfiles.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/window/mainwindow.h"

#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtWidgets/QApplication>

#include <clocale>
#include <deque>
#include <unistd.h>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};

/// Past all buffers: what was said stands when the program is killed.
void say(const QString& line) {
  const QByteArray bytes = line.toUtf8() + '\n';
  if (::write(STDOUT_FILENO, bytes.constData(), static_cast<size_t>(bytes.size())) < 0) ::_exit(4);
}

class WindowKeeper : public QObject {
 public:
  explicit WindowKeeper(MainWindow& window) : m_window(window) {
    DocumentFiles& files = session().files();
    connect(&window, &MainWindow::projectShown, this, [this] {
      m_edit = editOf(session().document().project());
      say(QStringLiteral("open"));
      turn();
    });
    connect(&files, &DocumentFiles::saved, this, [this] {
      say(QStringLiteral("saved %1").arg(m_saving.front()));
      m_saving.pop_front();
      if (m_saving.empty()) QTimer::singleShot(0, this, &WindowKeeper::turn);
    });
    const auto fail = [](const QString& problem) { say(QStringLiteral("failed: ") + problem); };
    connect(session().autosave(), &Autosave::failed, this, fail);
    connect(&files, &DocumentFiles::openFailed, this, [fail](const QString&, const QString& why) { fail(why); });
    connect(&files, &DocumentFiles::saveFailed, this, [fail](const QString&, const QString& why) { fail(why); });
    connect(&files, &DocumentFiles::saveRefused, this,
            [fail](const QString&, SaveRefusal, const QString& why) { fail(why); });
  }

 private:
  void turn() {
    edit();
    if (m_edit % 3 == 0) session().autosave()->saveNow();
    m_saving.push_back(m_edit);
    m_window.action(QStringLiteral("file.save"))->trigger();
    if (m_edit % 2 == 0) edit();  // before the save is heard of
  }
  void edit() { session().document().setParameter(kFloor, kelvinOf(++m_edit)); }
  Session& session() { return m_window.session(); }

  MainWindow& m_window;
  std::deque<int> m_saving;  ///< edits that were saved and not heard of
  int m_edit = 0;
};

}  // namespace

int main(int argc, char** argv) {
  servePluginScans(argc, argv);
  requestViewFormat();
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setApplicationName(QStringLiteral("phasesketch"));
  QApplication::setOrganizationName(QStringLiteral("phasesketch"));
  const QStringList arguments = QApplication::arguments();
  if (arguments.size() != 3) return 2;
  Theme::apply(application, true);
  MainWindow::Options options;
  options.project = arguments[1] + QStringLiteral("/scene.json");
  options.session.autosaveDirectory = arguments[1] + QStringLiteral("/copies");
  MainWindow window(options);
  const WindowKeeper keeper(window);
  window.show();
  window.start();
  return QApplication::exec();
}
