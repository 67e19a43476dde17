// SPDX-License-Identifier: Apache-2.0
// Nothing is lost: what is opened first, what earlier sessions left behind, work that another project took the place
// of, and the close of the window.
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/document/documentfiles.h"
#include "ui/window/mainwindow.h"
#include "ui/window/noticebar.h"
#include "ui/window/wording.h"

#include <QtCore/QFileInfo>
#include <QtGui/QCloseEvent>

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

/// The newest unsaved work of other sessions is offered, one at a time; what they had saved needs no copy.
void MainWindow::offerRestore() {
  notice()->close(QStringLiteral("restore"));
  if (!m_options.restore || !m_session->autosave()) return;
  for (const AutosavedSession& session : m_session->autosave()->leftBehind()) {
    if (session.copy.isEmpty()) {
      Autosave::discard(session);
      continue;
    }
    notice()->show(QStringLiteral("restore"), MessageLevel::Info, QStringLiteral("Unsaved work can be restored."),
                   whyLeftBehind(session),
                   {{QStringLiteral("Restore"),
                     [this, session] {
                       notice()->close(QStringLiteral("restore"));
                       m_session->files().reopen(session);
                     }},
                    {QStringLiteral("Keep for later"), [this] { notice()->close(QStringLiteral("restore")); }},
                    {QStringLiteral("Discard"), [this, session] {
                       Autosave::discard(session);
                       offerRestore();
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
