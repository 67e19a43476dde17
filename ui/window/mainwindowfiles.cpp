// SPDX-License-Identifier: Apache-2.0
// Opening, saving, exporting, and what is said about it. No failure here touches the present scene.
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/document/documentfiles.h"
#include "ui/document/worker.h"
#include "ui/viewport/viewport.h"
#include "ui/window/graphspanel.h"
#include "ui/window/mainwindow.h"
#include "ui/window/noticebar.h"
#include "ui/window/screenshot.h"

#include <QtCore/QBuffer>
#include <QtCore/QFileInfo>
#include <QtCore/QMimeData>
#include <QtCore/QSaveFile>
#include <QtGui/QDropEvent>
#include <QtWidgets/QFileDialog>

namespace ps {
namespace {

const QString kFilter = QStringLiteral("PhaseSketch projects (*.json);;All files (*)");

QString sentence(const QString& text) { return text.endsWith(QLatin1Char('.')) ? text : text + QLatin1Char('.'); }
QString nameOf(const QString& path) {
  return path.isEmpty() ? QStringLiteral("New scene") : QFileInfo(path).fileName();
}

}  // namespace

void MainWindow::openFirst() {
  if (!m_options.project.isEmpty()) {
    m_session->files().open(m_options.project);
    return;
  }
  if (m_options.restore && m_session->autosave()) {
    for (const AutosavedSession& session : Autosave::leftBehind(m_session->autosaveDirectory())) {
      if (!session.closed) continue;
      const QString path = session.copy.isEmpty() ? session.path : session.copy;
      if (!QFileInfo(path).isFile()) continue;
      if (session.copy.isEmpty()) {
        m_session->files().open(path);
      } else {
        m_session->files().openCopy(session.copy, session.path);
      }
      return;
    }
  }
  if (m_options.sample.isEmpty()) {
    m_session->files().newProject();
  } else {
    m_session->files().open(m_options.sample);
  }
}

/// Copies of sessions that ended in order are taken over by now; of those that did not, the newest is offered.
void MainWindow::offerRestore() {
  if (!m_options.restore || !m_session->autosave()) return;
  m_session->autosave()->saveNow();
  m_session->worker().wait();  // the copy just opened is kept anew before the old one goes
  for (const AutosavedSession& session : Autosave::leftBehind(m_session->autosaveDirectory())) {
    if (session.closed || session.copy.isEmpty()) {
      Autosave::discard(session);
      continue;
    }
    notice()->show(QStringLiteral("restore"), MessageLevel::Info, QStringLiteral("Your last session can be restored."),
                   QStringLiteral("“%1” was open when PhaseSketch ended unexpectedly. The copy is of %2.")
                       .arg(session.title, session.time.toString(QStringLiteral("d MMMM, HH:mm"))),
                   {{QStringLiteral("Restore"),
                     [this, session] {
                       notice()->close(QStringLiteral("restore"));
                       connect(
                           &m_session->files(), &DocumentFiles::opened, this,
                           [this, session] {
                             if (m_session->autosave()) m_session->autosave()->saveNow();
                             m_session->worker().run([session] { Autosave::discard(session); });
                           },
                           Qt::SingleShotConnection);
                       m_session->files().openCopy(session.copy, session.path);
                     }},
                    {QStringLiteral("Keep for later"), [this] { notice()->close(QStringLiteral("restore")); }},
                    {QStringLiteral("Discard"), [this, session] {
                       Autosave::discard(session);
                       notice()->close(QStringLiteral("restore"));
                     }}});
    return;
  }
}

void MainWindow::openFile(const QString& path) { m_session->files().open(path); }
void MainWindow::saveTo(const QString& path) { m_session->files().save(path); }

void MainWindow::chooseOpen() {
  const QString path = QFileDialog::getOpenFileName(this, QStringLiteral("Open a project"),
                                                    QFileInfo(m_session->document().path()).path(), kFilter);
  if (!path.isEmpty()) openFile(path);
}

void MainWindow::save() {
  const QString& path = m_session->document().path();
  if (path.isEmpty()) {
    chooseSave();
  } else {
    saveTo(path);
  }
}

void MainWindow::chooseSave() {
  QString path =
      QFileDialog::getSaveFileName(this, QStringLiteral("Save the project"), m_session->document().path(), kFilter);
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".json");
  saveTo(path);
}

void MainWindow::onOpened(const QString& path, const QStringList& warnings, double seconds) {
  for (const char* topic : {"open", "save", "stroke"}) notice()->close(QString::fromLatin1(topic));
  m_fileText.clear();
  for (const QString& warning : warnings) m_session->log().add(MessageLevel::Warning, nameOf(path), warning);
  m_session->log().add(MessageLevel::Ok, nameOf(path), QStringLiteral("Opened in %1 s.").arg(seconds, 0, 'f', 2));
  if (!warnings.isEmpty()) {
    notice()->show(QStringLiteral("open"), MessageLevel::Warning,
                   QStringLiteral("Opened, with %1.")
                       .arg(warnings.size() == 1 ? QStringLiteral("one remark")
                                                 : QStringLiteral("%1 remarks").arg(warnings.size())),
                   warnings.front());
  }
  if (m_first) {
    m_first = false;
    offerRestore();
  }
  updateTitle();
}

void MainWindow::onOpenFailed(const QString& path, const QString& problem) {
  if (m_first && m_options.exitOnBadProject) {
    Q_EMIT startFailed(problem);
    return;
  }
  m_session->log().add(MessageLevel::Error, nameOf(path), problem);
  const bool nothing = m_session->document().project().bodies.empty();
  notice()->show(QStringLiteral("open"), MessageLevel::Error, QStringLiteral("“%1” was not opened.").arg(nameOf(path)),
                 sentence(problem) + (nothing ? QString() : QStringLiteral(" The present scene is unchanged.")),
                 {{QStringLiteral("Open another…"), [this] { chooseOpen(); }}});
  if (m_first) {
    m_first = false;
    const QString shown = notice()->text();
    if (!m_options.sample.isEmpty() &&
        QFileInfo(path).absoluteFilePath() != QFileInfo(m_options.sample).absoluteFilePath()) {
      // The window must not stay empty; the notice stays.
      m_session->files().newProject();
      notice()->show(QStringLiteral("open"), MessageLevel::Error,
                     QStringLiteral("“%1” was not opened.").arg(nameOf(path)), problem,
                     {{QStringLiteral("Open another…"), [this] { chooseOpen(); }},
                      {QStringLiteral("Open the sample"), [this] { openFile(m_options.sample); }}});
    }
  }
}

void MainWindow::onSaveFailed(const QString& path, const QString& problem) {
  m_session->log().add(MessageLevel::Error, nameOf(path), problem);
  notice()->show(QStringLiteral("save"), MessageLevel::Error, QStringLiteral("Not saved."),
                 sentence(problem) + QStringLiteral(" Your work is kept in memory."),
                 {{QStringLiteral("Save elsewhere…"), [this] { chooseSave(); }}});
}

void MainWindow::writeFile(const QString& path, std::function<QByteArray()> content, const QString& what) {
  m_session->worker().run([this, path, content = std::move(content), what] {
    QSaveFile file(path);
    const bool good = file.open(QIODevice::WriteOnly) && file.write(content()) >= 0 && file.commit();
    const QString problem = good ? QString() : file.errorString();
    QMetaObject::invokeMethod(m_session.get(), [this, path, what, problem] {
      if (problem.isEmpty()) {
        m_session->log().add(MessageLevel::Ok, what, QStringLiteral("Written to %1.").arg(path));
      } else {
        showMessage(MessageLevel::Error, what, QStringLiteral("%1 was not written: %2").arg(path, problem));
      }
    });
  });
}

void MainWindow::exportCsv() {
  if (!m_session->engine()) return;
  const QString path = QFileDialog::getSaveFileName(this, QStringLiteral("Export all frames"),
                                                    QStringLiteral("frames.csv"), QStringLiteral("CSV (*.csv)"));
  if (path.isEmpty()) return;
  writeFile(
      path,
      [history = m_session->engine()->history(0), probes = m_session->document().project().probes] {
        return historyCsv(history, probes);
      },
      QStringLiteral("Frames as CSV"));
}

void MainWindow::exportPicture() {
  Viewport* view = viewport();
  if (!view) return;
  const QString path = QFileDialog::getSaveFileName(this, QStringLiteral("Save a picture of the scene"),
                                                    QStringLiteral("scene.png"), QStringLiteral("PNG (*.png)"));
  if (path.isEmpty()) return;
  writeFile(
      path,
      [image = view->grabFramebuffer()] {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        image.save(&buffer, "PNG");
        return bytes;
      },
      QStringLiteral("Picture"));
}

void MainWindow::updateTitle() {
  const Document& document = m_session->document();
  setWindowTitle(document.title() +
                 (document.isDirty() ? QStringLiteral(" • PhaseSketch") : QStringLiteral(" – PhaseSketch")));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  const QList<QUrl> urls = event->mimeData()->urls();
  if (urls.size() == 1 && urls.front().isLocalFile()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  openFile(event->mimeData()->urls().front().toLocalFile());
}

}  // namespace ps
