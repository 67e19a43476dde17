// SPDX-License-Identifier: Apache-2.0
#include "ui/window/libraryactions.h"

#include "ui/library/mixdialog.h"
#include "ui/session/messagelog.h"
#include "ui/session/session.h"
#include "ui/window/actions.h"
#include "ui/window/dialogrow.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>
#include <QtWidgets/QStackedWidget>

namespace ps {

LibraryActions::LibraryActions(Session& session, Selection& selection, const Actions& actions, Notices& notices,
                               QStackedWidget& centre, QWidget& scene, const QString& presets, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_selection(selection),
      m_actions(actions),
      m_centre(centre),
      m_library(session, presets),
      m_page(new LibraryPage(m_library, session, selection)) {
  centre.addWidget(m_page);
  connect(m_page, &LibraryPage::closeRequested, this, [&centre, &scene] { centre.setCurrentWidget(&scene); });
  connect(m_page, &LibraryPage::carrying, this, [&centre, &scene] { centre.setCurrentWidget(&scene); });
  connect(m_page, &LibraryPage::broughtBack, this, [this] { m_centre.setCurrentWidget(m_page); });
  connect(m_page, &LibraryPage::importWanted, this, &LibraryActions::chooseImport);
  connect(m_page, &LibraryPage::mixWanted, this, &LibraryActions::openMix);
  connect(m_page, &LibraryPage::mixtureWanted, this, &LibraryActions::openMixture);
  connect(m_page, &LibraryPage::exportWanted, this, &LibraryActions::chooseExport);
  connect(&m_library, &MaterialLibrary::said, this, [&notices](bool failed, const QString& text) {
    notices.message(failed ? MessageLevel::Warning : MessageLevel::Ok, QStringLiteral("Materials"), text);
  });
  connect(&m_library, &MaterialLibrary::waitingChanged, this, [this, &notices] { offerWaiting(notices.bar()); });
}

void LibraryActions::addTo(QMenu* menu) {
  m_actions.add(menu, QStringLiteral("add.library"), QStringLiteral("Material from the library"), {}, [this] {
    // What was looked for last time would hide what is looked for now.
    const bool anew = m_centre.currentWidget() != m_page;
    m_centre.setCurrentWidget(m_page);
    m_page->beginSearch(anew);
  });
}

void LibraryActions::openMix(const QString& first, const QString& second) {
  QMainWindow& window = m_actions.window();
  QDialog* dialog = bringUp(window, QStringLiteral("psMix"),
                            [&] { return new MixDialog(m_library, m_session, m_selection, first, second, &window); });
  static_cast<MixDialog*>(dialog)->chooseParts(first, second);
}

void LibraryActions::openMixture(const std::string& material) {
  QMainWindow& window = m_actions.window();
  bringUp(window, QStringLiteral("psMixture ") + QString::fromStdString(material),
          [&] { return new MixDialog(m_library, m_session, m_selection, material, &window); });
}

/// The scene's own matter changes when somebody says so.
void LibraryActions::offerWaiting(NoticeBar& bar) {
  const QString topic = QStringLiteral("materials on disk");
  const QStringList labels = m_library.waiting();
  if (labels.isEmpty()) return bar.close(topic);
  bar.show(topic, MessageLevel::Info,
           labels.size() == 1 ? QStringLiteral("“%1” has changed on disk.").arg(labels.front())
                              : QStringLiteral("%1 materials have changed on disk.").arg(labels.size()),
           QStringLiteral("The scene goes on with the values that it began with, values of its own stay in any case."),
           {{QStringLiteral("Take the new ones, back to the start"), [this] { m_library.takeWaiting(); }}});
}

void LibraryActions::chooseImport() {
  const QString path = fileToRead(&m_actions.window(), QStringLiteral("Import the materials of a preset or a project"),
                                  m_library.folder(), QStringLiteral("Presets and projects (*.json);;All files (*)"));
  if (!path.isEmpty()) m_library.importFrom(path);
}

void LibraryActions::chooseExport(const LibraryEntry& entry) {
  const LibraryEntry kept = entry;  // the list may be read again meanwhile
  const QString path =
      fileToWrite(&m_actions.window(), QStringLiteral("Export the material"),
                  folderBeside(m_session) + QLatin1Char('/') + fileNameFor(kept.label) + QStringLiteral(".json"),
                  QStringLiteral("PhaseSketch projects (*.json)"));
  if (!path.isEmpty()) m_library.exportTo(kept, path);
}

}  // namespace ps
