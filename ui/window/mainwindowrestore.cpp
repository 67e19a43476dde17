// SPDX-License-Identifier: Apache-2.0
// Nothing is lost: what is opened first, what earlier sessions left behind, work that another project took the place
// of, and the close of the window.
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/wording.h"
#include "ui/window/mainwindow.h"
#include "ui/window/noticebar.h"

#include <QtCore/QFileInfo>
#include <QtGui/QCloseEvent>

#include <algorithm>

namespace ps {
namespace {

QString whyLeftBehind(const AutosavedSession& session) {
  const QString time = session.time.toString(QStringLiteral("d MMMM, HH:mm"));
  switch (session.end) {
    case SessionEnd::Replaced:
      return QStringLiteral("“%1” had unsaved changes when another project took its place on %2.")
          .arg(session.title, time);
    case SessionEnd::Closed:
      return QStringLiteral("“%1” was closed with unsaved changes on %2.").arg(session.title, time);
    case SessionEnd::None:
      break;
  }
  return QStringLiteral("“%1” was open when PhaseSketch ended unexpectedly. The copy is of %2.")
      .arg(session.title, time);
}

}  // namespace

void MainWindow::openFirst() {
  DocumentFiles& files = m_session->files();
  if (!m_options.project.isEmpty()) {
    files.open(m_options.project);
    return;
  }
  if (m_options.restore && m_session->autosave()) {
    for (const AutosavedSession& session : m_session->autosave()->leftBehind()) {
      if (session.end != SessionEnd::Closed) continue;
      if (!QFileInfo(session.copy.isEmpty() ? session.path : session.copy).isFile()) break;
      files.reopen(session);
      return;
    }
  }
  if (m_options.sample.isEmpty()) {
    files.newProject();
  } else {
    files.open(m_options.sample);
  }
}

/// Copies of unsaved work that no window has open, newest first.
std::vector<AutosavedSession> MainWindow::unsavedWork() const {
  if (!m_session->autosave()) return {};
  std::vector<AutosavedSession> waiting = m_session->autosave()->leftBehind();
  waiting.erase(std::remove_if(waiting.begin(), waiting.end(),
                               [](const AutosavedSession& session) { return session.copy.isEmpty(); }),
                waiting.end());
  return waiting;
}

/// Once the first project is there. What earlier sessions had saved needs no note any more.
void MainWindow::offerAtStart() {
  if (!m_options.restore || !m_session->autosave()) return;
  for (const AutosavedSession& session : m_session->autosave()->leftBehind()) {
    if (session.copy.isEmpty()) Autosave::discard(session);
  }
  offerRestore();
}

/// Offers all unsaved work that waits, one after another.
void MainWindow::offerRestore() {
  m_offered.clear();
  for (const AutosavedSession& session : unsavedWork()) m_offered << session.stem;
  offerNext();
}

void MainWindow::offerNext() {
  notice()->close(QStringLiteral("restore"));
  for (const AutosavedSession& session : unsavedWork()) {
    if (!m_offered.contains(session.stem)) continue;
    const auto decided = [this, stem = session.stem] {
      m_offered.removeAll(stem);
      offerNext();
    };
    notice()->show(QStringLiteral("restore"), MessageLevel::Info, QStringLiteral("Unsaved work can be restored."),
                   whyLeftBehind(session),
                   {{QStringLiteral("Restore"),
                     [this, session, decided] {
                       m_session->files().reopen(session);
                       decided();
                     }},
                    {QStringLiteral("Keep for later"), decided},
                    {QStringLiteral("Discard"), [session, decided] {
                       Autosave::discard(session);
                       decided();
                     }}});
    return;
  }
}

void MainWindow::connectAutosave() {
  Autosave* autosave = m_session->autosave();
  if (!autosave) return;
  connect(autosave, &Autosave::autosaved, this, [this](const QDateTime& time) {
    m_fileText = QStringLiteral("Autosaved ") + time.toString(QStringLiteral("HH:mm"));
    refreshStatus();
  });
  connect(autosave, &Autosave::failed, this, [this](const QString& problem, bool replaced) {
    if (replaced) {
      showReplaced(QStringLiteral("No copy could be kept: %1").arg(sentence(problem)));
    } else {
      showMessage(MessageLevel::Warning, QStringLiteral("Autosave"),
                  QStringLiteral("No copy was kept: %1 Save to a file.").arg(sentence(problem)));
    }
  });
  connect(autosave, &Autosave::workReplaced, this, [this](const std::shared_ptr<const ReplacedWork>& work) {
    m_replaced = work;
    // After what is said about the project that takes its place.
    QMetaObject::invokeMethod(
        this, [this] { showReplaced(QStringLiteral("A copy is kept.")); }, Qt::QueuedConnection);
  });
}

/// The way back to work whose place another project took. It is in memory: it leads there even where no copy could be
/// written.
void MainWindow::showReplaced(const QString& text) {
  if (!m_replaced) return;
  const QString title = QStringLiteral("“%1” had unsaved changes.").arg(m_replaced->session.title);
  notice()->show(QStringLiteral("replaced"), MessageLevel::Warning, title, text,
                 {{QStringLiteral("Back to it"), [this] {
                     notice()->close(QStringLiteral("replaced"));
                     const auto work = std::move(m_replaced);
                     if (work) m_session->files().bringBack(*work);
                   }}});
  m_session->log().add(MessageLevel::Warning, m_replaced->session.title, title + QLatin1Char(' ') + text);
}

/// Closing asks nothing: unsaved work is kept as a copy. Only when there can be no copy does the window stay, once.
void MainWindow::closeEvent(QCloseEvent* event) {
  saveWindow();
  const QString problem = m_session->close();
  const Document& document = m_session->document();
  if (!problem.isEmpty() && document.isDirty() && m_warnedAt != document.changeCount()) {
    m_warnedAt = document.changeCount();
    event->ignore();
    m_session->log().add(MessageLevel::Error, document.title(), problem);
    showNotSaved(problem, QStringLiteral("Your work is kept in memory; closing once more gives it up."));
    return;
  }
  QMainWindow::closeEvent(event);
}

}  // namespace ps
