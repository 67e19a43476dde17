// SPDX-License-Identifier: Apache-2.0
#include "ui/window/fileactions.h"

#include "core/io/outputfile.h"
#include "core/io/recording.h"
#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/graphs/graphexport.h"
#include "ui/graphs/graphspanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/scenelink.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/session/worker.h"
#include "ui/theme/plaintext.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/exportactions.h"
#include "ui/window/fileguard.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"
#include "ui/window/recordingactions.h"
#include "ui/window/restoreoffer.h"
#include "ui/window/shareactions.h"

#include <QtCore/QBuffer>
#include <QtCore/QFileInfo>
#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <utility>

namespace ps {
namespace {

const QString kFilter = QStringLiteral("PhaseSketch projects (*.json);;All files (*)");
const QString kOpenFilter = QStringLiteral("Projects and recordings (*.json *.psrec);;All files (*)");

constexpr std::pair<const char*, const char*> kTips[] = {
    {"file.new", "An empty tray to draw in. Unsaved work can be brought back."},
    {"file.open", "A project runs at once, or stands at the state that it holds. Unsaved work can be brought back."},
    {"file.restore", "Work that no file holds, of this session and of those before."},
    {"file.save", "The scene as it begins, with its view. What matter does meanwhile is not part of it."},
    {"file.saveAs", "In another file, which is the one that is saved from then on."},
    {"file.saveState",
     "Keeps matter as it stands in the project, which then opens there. Home still leads back to the start."},
    {"file.removeState", "The project opens at its start again; the scene goes on as it stands."},
    {"file.picture", "What the view shows now, as PNG."},
    {"file.csv", "Mean temperature, masses by phase and all probes, one row per frame since the start."},
    {"file.quit", "Unsaved work comes back at the next start."},
};

}  // namespace

FileActions::~FileActions() = default;

FileActions::FileActions(Session& session, const Actions& actions, Notices& notices, RestoreOffer& restore,
                         const Options& options, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_actions(actions),
      m_notices(notices),
      m_restore(restore),
      m_options(options),
      m_guard(std::make_unique<FileGuard>(session, actions, notices, restore)),
      m_recordings(std::make_unique<RecordingActions>(session, actions, notices)),
      m_exports(std::make_unique<ExportActions>(session, actions, notices)),
      m_sharing(std::make_unique<ShareActions>(session, actions, notices)) {
  DocumentFiles& files = session.files();
  files.setSamples(options.samples.isEmpty() ? options.sample : options.samples);
  connect(&files, &DocumentFiles::opened, this, &FileActions::onOpened);
  connect(&files, &DocumentFiles::openFailed, this, &FileActions::onOpenFailed);
  connect(&files, &DocumentFiles::saveFailed, this, &FileActions::onSaveFailed);
  connect(&files, &DocumentFiles::saved, this, &FileActions::onSaved);
  connect(&files, &DocumentFiles::stateLeftOut, this, &FileActions::onStateLeftOut);
  connect(&session, &Session::stateKept, this, [this] {
    if (!m_stateTo.isEmpty()) saveTo(std::exchange(m_stateTo, {}));
  });
  connect(&session, &Session::stateNotKept, this, [this](const QString& problem) {
    m_notices.message(MessageLevel::Warning, QStringLiteral("The present state was not kept"), sentence(problem));
    m_stateTo.clear();
  });
  connect(&session.document(), &Document::changed, this, &FileActions::updateStateActions);
  connect(&session, &Session::ready, this, [this] {
    setEnabled(true);
    openFirst();
  });
}

void FileActions::makeMenu(QMenu* menu, Viewport* view) {
  m_view = view;
  m_actions.add(menu, QStringLiteral("file.new"), QStringLiteral("New scene"), {QKeySequence(QStringLiteral("Ctrl+N"))},
                [this] { m_session.files().newProject(); });
  m_actions.add(menu, QStringLiteral("file.open"), QStringLiteral("Open…"), {QKeySequence(QStringLiteral("Ctrl+O"))},
                [this] { chooseOpen(); });
  m_recent = menu->addMenu(QStringLiteral("Open recent"));
  connect(m_recent, &QMenu::aboutToShow, this, &FileActions::fillRecent);
  m_samples = menu->addMenu(QStringLiteral("New from sample"));
  m_guard->addVersionsMenu(menu);
  m_actions.add(menu, QStringLiteral("file.restore"), QStringLiteral("Restore unsaved work…"), {},
                [this] { m_restore.offer(); });
  connect(menu, &QMenu::aboutToShow, this, &FileActions::updateRestore);
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("file.save"), QStringLiteral("Save"), {QKeySequence(QStringLiteral("Ctrl+S"))},
                [this] { save(); });
  m_actions.add(menu, QStringLiteral("file.saveAs"), QStringLiteral("Save as…"),
                {QKeySequence(QStringLiteral("Ctrl+Shift+S"))}, [this] { chooseSave(); });
  m_actions.add(menu, QStringLiteral("file.saveState"), QStringLiteral("Save with the present state"),
                {QKeySequence(QStringLiteral("Ctrl+Alt+S"))}, [this] { saveWithState(); });
  m_actions.add(menu, QStringLiteral("file.removeState"), QStringLiteral("Remove the saved state"), {},
                [this] { m_session.document().removeState(); });
  m_sharing->addTo(menu, view);
  menu->addSeparator();
  m_recordings->addTo(menu);
  m_exports->addTo(menu, view);
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("file.picture"), QStringLiteral("Save picture of the scene…"), {},
                [this] { exportPicture(); });
  m_actions.add(menu, QStringLiteral("file.csv"), QStringLiteral("Export all frames as CSV…"), {},
                [this] { exportCsv(); });
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("file.quit"), QStringLiteral("Quit"), {QKeySequence(QStringLiteral("Ctrl+Q"))},
                [this] { m_actions.window().close(); });
  for (const char* name : {"file.new", "file.open", "file.restore"}) {
    if (QAction* replacing = m_actions.find(QString::fromLatin1(name))) replacing->setProperty(kReplaces, true);
  }
  explain(menu);
  setEnabled(false);
  updateStateActions();
}

/// Without a tip of its own an entry would repeat its text.
void FileActions::explain(QMenu* menu) const {
  for (const auto& [name, tip] : kTips) {
    if (QAction* action = m_actions.find(QString::fromLatin1(name))) action->setToolTip(QString::fromUtf8(tip));
  }
  m_recent->menuAction()->setToolTip(QStringLiteral("Projects that were opened or saved last."));
  m_samples->menuAction()->setToolTip(QStringLiteral("A sample stays as it is: saving it asks for another name."));
  m_samples->setToolTipsVisible(true);
  menu->setToolTipsVisible(true);
}

void FileActions::setEnabled(bool on) {
  for (const char* name : {"file.new", "file.open", "file.save", "file.saveAs", "file.saveState"}) {
    if (QAction* needed = m_actions.find(QString::fromLatin1(name))) needed->setEnabled(on);
  }
  m_recent->setEnabled(on);
  m_samples->setEnabled(on);
  m_recordings->setEnabled(on);
  m_exports->setEnabled(on);
  m_sharing->setEnabled(on);
}

void FileActions::updateStateActions() {
  for (const char* name : {"file.removeState", "simulation.state"}) {
    if (QAction* action = m_actions.find(QString::fromLatin1(name)))
      action->setEnabled(m_session.document().project().state != nullptr);
  }
}

void FileActions::updateRestore() {
  m_actions.find(QStringLiteral("file.restore"))->setEnabled(m_restore.anyUnsaved());
}

void FileActions::fillRecent() {
  m_recent->clear();
  const QStringList recent = DocumentFiles::recent();
  for (const QString& path : recent) {
    const QString text = QFileInfo(path).completeBaseName() + QStringLiteral("  ·  ") + QFileInfo(path).path();
    m_recent->addAction(asButtonText(text), this, [this, path] { open(path); });
  }
  if (recent.isEmpty()) m_recent->addAction(QStringLiteral("No recent files"))->setEnabled(false);
}

void FileActions::openFirst() {
  if (!m_options.project.isEmpty()) {
    if (isRecording(m_options.project.toStdString())) m_session.files().newProject();  // until it is read
    open(m_options.project);
  } else if (m_restore.reopenLast()) {
    return;
  } else if (m_options.sample.isEmpty()) {
    m_session.files().newProject();
  } else {
    m_session.files().open(m_options.sample);
  }
}

void FileActions::open(const QString& path) {
  if (m_session.isReady() && isRecording(path.toStdString())) {
    m_session.recordings().open(path);
  } else if (m_session.isReady()) {
    m_session.files().open(path);
  } else {
    m_options.project = path;
  }
}

void FileActions::saveTo(const QString& path) { m_session.files().save(path); }

void FileActions::chooseOpen() {
  const QString path = fileToRead(&m_actions.window(), QStringLiteral("Open a project"), folderToOpen(), kOpenFilter);
  if (!path.isEmpty()) open(path);
}

/// Where the open project lies, or else the folder that was chosen for projects, or that of the one before it that is
/// no sample.
QString FileActions::folderToOpen() const {
  const bool chosen = !preferences::folder(preferences::Folder::Projects).isEmpty();
  for (const QString& path :
       QStringList(m_session.document().path()) + (chosen ? QStringList() : DocumentFiles::recent())) {
    if (!path.isEmpty() && !m_session.files().isSample(path)) return QFileInfo(path).path();
  }
  return preferences::projectFolder();
}

QString FileActions::besideProject(const QString& name) const {
  return folderBeside(m_session) + QLatin1Char('/') + name;
}

void FileActions::save() {
  const QString& path = m_session.document().path();
  if (path.isEmpty() || m_session.files().isSample(path)) {
    chooseSave();
  } else {
    saveTo(path);
  }
}

void FileActions::saveWithState() {
  const QString& path = m_session.document().path();
  m_stateTo = path.isEmpty() || m_session.files().isSample(path) ? chooseFile() : path;
  if (!m_stateTo.isEmpty()) m_session.keepState();
}

void FileActions::chooseSave() {
  if (const QString path = chooseFile(); !path.isEmpty()) saveTo(path);
}

QString FileActions::chooseFile() {
  const Document& document = m_session.document();
  QString suggestion = document.path();
  if (suggestion.isEmpty() || m_session.files().isSample(suggestion)) {
    suggestion = besideProject(fileNameFor(document.title()) + QStringLiteral(".json"));
  }
  return fileToWrite(&m_actions.window(), QStringLiteral("Save the project"), suggestion, kFilter);
}

void FileActions::onOpened(const QString& path, const QStringList& warnings, double seconds) {
  m_stateTo.clear();
  for (const char* topic : {"open", "save", "state", "stroke", "refused"})
    m_notices.bar().close(QString::fromLatin1(topic));
  for (const QString& warning : warnings) m_session.log().add(MessageLevel::Warning, nameOf(path), warning);
  m_session.log().add(MessageLevel::Ok, nameOf(path), QStringLiteral("Opened in %1 s.").arg(seconds, 0, 'f', 2));
  if (!warnings.isEmpty()) {
    m_notices.bar().show(QStringLiteral("open"), MessageLevel::Warning,
                         QStringLiteral("Opened, with %1.")
                             .arg(warnings.size() == 1 ? QStringLiteral("one remark")
                                                       : QStringLiteral("%1 remarks").arg(warnings.size())),
                         warnings.front());
  }
  if (std::exchange(m_first, false)) m_restore.offerAtStart();
}

void FileActions::onOpenFailed(const QString& path, const QString& problem) {
  const bool first = std::exchange(m_first, false);
  if (problem.isEmpty()) return onOpeningGivenUp(path, first);
  if (first && m_options.exitOnBadProject) {
    Q_EMIT startFailed(problem);
    return;
  }
  const QString title = QStringLiteral("“%1” was not opened.").arg(nameOf(path));
  const QString text = sentence(problem) + (first ? QString() : QStringLiteral(" The present scene is unchanged."));
  m_session.log().add(MessageLevel::Error, nameOf(path), title + QLatin1Char(' ') + text);
  std::vector<NoticeBar::Button> buttons{{QStringLiteral("Open another…"), [this] { chooseOpen(); }}};
  if (DocumentFiles::lacksRequired(problem))
    buttons.insert(buttons.begin(), {QStringLiteral("Open anyway"), [this] { m_session.files().openAnyway(); }});
  if (first) {
    m_session.files().newProject();  // the window must not stay empty
    m_restore.offerAtStart();
    if (!m_options.sample.isEmpty() && !m_session.files().isSample(path))
      buttons.push_back({QStringLiteral("Open the sample"), [this] { open(m_options.sample); }});
  }
  m_notices.bar().show(QStringLiteral("open"), MessageLevel::Error, title, text, std::move(buttons));
}

/// Nothing went wrong, and what is open is what there was to say.
void FileActions::onOpeningGivenUp(const QString& path, bool first) {
  if (first) {
    m_session.files().newProject();  // the window must not stay empty
    m_restore.offerAtStart();
  }
  const QString title = QStringLiteral("Opening “%1” was given up.").arg(nameOf(path));
  const QString text = first ? QStringLiteral("A new scene is open instead.")
                             : QStringLiteral("“%1” is still open, as it was.").arg(m_session.document().title());
  m_session.log().add(MessageLevel::Info, nameOf(path), title + QLatin1Char(' ') + text);
  m_notices.bar().show(QStringLiteral("open"), MessageLevel::Info, title, text);
}

void FileActions::onSaved(const QString& path, bool present) {
  const auto& state = m_session.document().project().state;
  const bool leftOut = std::exchange(m_leftOut, false);
  const QString opens = present && state && !leftOut
                            ? QStringLiteral(" It opens at %1, its saved state.").arg(clockText(state->time))
                            : QString();
  m_session.log().add(MessageLevel::Ok, nameOf(path), QStringLiteral("Saved to %1.").arg(path) + opens);
  if (!present) return;
  m_notices.bar().close(QStringLiteral("save"));
  if (leftOut) return;
  m_notices.bar().close(QStringLiteral("state"));
  const size_t strokes = m_session.link() ? m_session.link()->strokesOfTheRun() : 0;
  if (strokes == 0) return;
  m_notices.bar().show(
      QStringLiteral("state"), MessageLevel::Info,
      QStringLiteral("Saved without %1 made after 0 s.")
          .arg(strokes == 1 ? QStringLiteral("one stroke") : QStringLiteral("%1 strokes").arg(strokes)),
      state ? QStringLiteral("The project opens at a state from before they were made.")
            : QStringLiteral("A project begins at its start. What was erased or painted while it ran, or drawn where "
                             "something stands at the start, is in its present state alone."),
      {{QStringLiteral("Save with the present state"), [this] { saveWithState(); }}});
}

void FileActions::onStateLeftOut(const QString& path, const QString& why, bool present) {
  m_leftOut = true;
  const QString title = QStringLiteral("Saved without the state that was kept.");
  const QString text = why.left(1).toUpper() + why.mid(1) + QStringLiteral(". The project opens at its start.");
  m_session.log().add(MessageLevel::Warning, nameOf(path), title + QLatin1Char(' ') + text);
  if (!present) return;
  m_notices.bar().show(QStringLiteral("state"), MessageLevel::Warning, title, text,
                       {{QStringLiteral("Save with the present state"), [this] { saveWithState(); }}});
}

void FileActions::onSaveFailed(const QString& path, const QString& problem, bool present) {
  m_session.log().add(MessageLevel::Error, nameOf(path),
                      QStringLiteral("Not saved: %1 Save elsewhere.").arg(sentence(problem)));
  if (!present) {
    m_restore.showReplaced(QStringLiteral("“%1” was not saved: %2").arg(nameOf(path), sentence(problem)));
    return;
  }
  showNotSaved(problem, QStringLiteral("Your work is kept in memory."));
}

void FileActions::showNotSaved(const QString& problem, const QString& more) {
  m_notices.bar().show(QStringLiteral("save"), MessageLevel::Error, QStringLiteral("Not saved."),
                       sentence(problem) + QLatin1Char(' ') + more,
                       {{QStringLiteral("Save elsewhere…"), [this] { chooseSave(); }}});
}

void FileActions::writeFile(const QString& path, std::function<QByteArray()> content, const QString& what) {
  m_session.worker().run([this, path, content = std::move(content), what] {
    QString problem;
    try {
      const QByteArray bytes = content();
      writeFileAtomically(path.toStdString(), {bytes.constData(), static_cast<size_t>(bytes.size())});
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(&m_session, [this, path, what, problem] {
      if (problem.isEmpty()) {
        const QString text = QStringLiteral("Written to %1.").arg(path);
        m_session.log().add(MessageLevel::Ok, what, text);
        m_notices.bar().show(QStringLiteral("written"), MessageLevel::Ok, what, text);
      } else {
        m_notices.message(MessageLevel::Error, what,
                          QStringLiteral("Not written: %1 Choose another place.").arg(sentence(problem)));
      }
    });
  });
}

void FileActions::exportCsv() {
  if (!m_session.engine()) return;
  const QString path = fileToWrite(&m_actions.window(), QStringLiteral("Export all frames"),
                                   besideProject(QStringLiteral("frames.csv")), QStringLiteral("CSV (*.csv)"));
  if (path.isEmpty()) return;
  writeFile(
      path,
      [history = m_session.engine()->history(0), probes = m_session.document().project().probes,
       fields = m_session.fields()] { return historyCsv(history, probes, fields); },
      QStringLiteral("Frames as CSV"));
}

void FileActions::exportGraph(const GraphsPanel& graphs, const std::string& id, const QString& ending) {
  const QString path =
      fileToWrite(&m_actions.window(), QStringLiteral("Export the graph"), besideProject(graphs.fileName(id, ending)),
                  QStringLiteral("%1 (*.%2)").arg(ending.toUpper(), ending));
  if (path.isEmpty()) return;
  writeFile(
      path, [bytes = graphs.exported(id, ending)] { return bytes; }, QStringLiteral("Graph"));
}

void FileActions::exportPicture() {
  if (!m_view) return;
  const QString path = fileToWrite(&m_actions.window(), QStringLiteral("Save a picture of the scene"),
                                   besideProject(QStringLiteral("scene.png")), QStringLiteral("PNG (*.png)"));
  if (path.isEmpty()) return;
  writeFile(
      path,
      [image = m_view->grabFramebuffer()] {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        image.save(&buffer, "PNG");
        return bytes;
      },
      QStringLiteral("Picture"));
}

}  // namespace ps
