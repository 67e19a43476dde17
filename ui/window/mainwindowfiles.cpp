// SPDX-License-Identifier: Apache-2.0
// Opening, saving, exporting, and what is said about it. No failure here touches the present scene.
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/graphs/graphspanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/wording.h"
#include "ui/session/worker.h"
#include "ui/viewport/viewport.h"
#include "ui/window/mainwindow.h"
#include "ui/window/noticebar.h"
#include "ui/window/screenshot.h"

#include <QtCore/QBuffer>
#include <QtCore/QFileInfo>
#include <QtCore/QMimeData>
#include <QtCore/QRegularExpression>
#include <QtCore/QSaveFile>
#include <QtCore/QStandardPaths>
#include <QtGui/QDropEvent>
#include <QtWidgets/QFileDialog>

#include <utility>

namespace ps {
namespace {

const QString kFilter = QStringLiteral("PhaseSketch projects (*.json);;All files (*)");

QString nameOf(const QString& path) {
  return path.isEmpty() ? QStringLiteral("New scene") : QFileInfo(path).fileName();
}

/// A title as a file's name: without what some file system refuses.
QString fileNameFor(QString title) {
  return title.replace(QRegularExpression(QStringLiteral("[/\\\\:*?\"<>|]")), QStringLiteral("-"));
}

/// Asks for a file to write; "" when given up. The ending of `suggestion` completes a name without one before the
/// question whether an existing file may be replaced, so that it is about the right file.
QString fileToWrite(QWidget* parent, const QString& title, const QString& suggestion, const QString& filter) {
  QFileDialog dialog(parent, title, QFileInfo(suggestion).path(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(QFileInfo(suggestion).suffix());
  dialog.selectFile(QFileInfo(suggestion).fileName());
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().constFirst() : QString();
}

}  // namespace

/// Before plugins are there, it becomes the project to begin with.
void MainWindow::openFile(const QString& path) {
  if (m_session->isReady()) {
    m_session->files().open(path);
  } else {
    m_options.project = path;
  }
}

void MainWindow::saveTo(const QString& path) { m_session->files().save(path); }

void MainWindow::chooseOpen() {
  const QString path = QFileDialog::getOpenFileName(this, QStringLiteral("Open a project"),
                                                    QFileInfo(m_session->document().path()).path(), kFilter);
  if (!path.isEmpty()) openFile(path);
}

/// The sample that comes with the program stays as it is: it is saved under another name.
bool MainWindow::isSample(const QString& path) const {
  return !m_options.sample.isEmpty() &&
         QFileInfo(path).canonicalFilePath() == QFileInfo(m_options.sample).canonicalFilePath();
}

void MainWindow::save() {
  const QString& path = m_session->document().path();
  if (path.isEmpty() || isSample(path)) {
    chooseSave();
  } else {
    saveTo(path);
  }
}

void MainWindow::chooseSave() {
  const Document& document = m_session->document();
  QString suggestion = document.path();
  if (suggestion.isEmpty() || isSample(suggestion)) {
    suggestion = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + QLatin1Char('/') +
                 fileNameFor(document.title()) + QStringLiteral(".json");
  }
  const QString path = fileToWrite(this, QStringLiteral("Save the project"), suggestion, kFilter);
  if (!path.isEmpty()) saveTo(path);
}

void MainWindow::onOpened(const QString& path, const QStringList& warnings, double seconds) {
  for (const char* topic : {"open", "save", "stroke", "refused"}) notice()->close(QString::fromLatin1(topic));
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
  if (std::exchange(m_first, false)) offerAtStart();
  updateTitle();
}

void MainWindow::onOpenFailed(const QString& path, const QString& problem) {
  const bool first = std::exchange(m_first, false);
  if (first && m_options.exitOnBadProject) {
    Q_EMIT startFailed(problem);
    return;
  }
  m_session->log().add(MessageLevel::Error, nameOf(path), problem);
  std::vector<NoticeBar::Button> buttons{{QStringLiteral("Open another…"), [this] { chooseOpen(); }}};
  if (first) {
    m_session->files().newProject();  // the window must not stay empty
    offerAtStart();
    if (!m_options.sample.isEmpty() && !isSample(path))
      buttons.push_back({QStringLiteral("Open the sample"), [this] { openFile(m_options.sample); }});
  }
  notice()->show(QStringLiteral("open"), MessageLevel::Error, QStringLiteral("“%1” was not opened.").arg(nameOf(path)),
                 sentence(problem) + (first ? QString() : QStringLiteral(" The present scene is unchanged.")),
                 std::move(buttons));
}

void MainWindow::onSaved(const QString& path, bool present) {
  m_session->log().add(MessageLevel::Ok, nameOf(path), QStringLiteral("Saved to %1.").arg(path));
  if (!present) return;
  notice()->close(QStringLiteral("save"));
  m_fileText = QStringLiteral("Saved ") + QTime::currentTime().toString(QStringLiteral("HH:mm"));
  updateTitle();
  refreshStatus();
}

void MainWindow::onSaveFailed(const QString& path, const QString& problem, bool present) {
  m_session->log().add(MessageLevel::Error, nameOf(path), problem);
  if (!present) {
    showReplaced(QStringLiteral("“%1” was not saved: %2").arg(nameOf(path), sentence(problem)));
    return;
  }
  showNotSaved(problem, QStringLiteral("Your work is kept in memory."));
}

void MainWindow::showNotSaved(const QString& problem, const QString& more) {
  notice()->show(QStringLiteral("save"), MessageLevel::Error, QStringLiteral("Not saved."),
                 sentence(problem) + QLatin1Char(' ') + more,
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
  const QString path = fileToWrite(this, QStringLiteral("Export all frames"), QStringLiteral("frames.csv"),
                                   QStringLiteral("CSV (*.csv)"));
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
  const QString path = fileToWrite(this, QStringLiteral("Save a picture of the scene"), QStringLiteral("scene.png"),
                                   QStringLiteral("PNG (*.png)"));
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
  const QString file = document.path().isEmpty() ? QStringLiteral("Untitled") : QFileInfo(document.path()).fileName();
  const auto literal = [](QString text) {  // Qt's mark for unsaved changes must not come from a name
    return text.replace(QStringLiteral("[*]"), QStringLiteral("[*][*]"));
  };
  QString title = literal(file) + QStringLiteral("[*]");
  const QString own = QString::fromStdString(document.project().title);
  if (!own.isEmpty()) title += QStringLiteral(" – ") + literal(own);
  setWindowTitle(title + QStringLiteral(" – PhaseSketch"));
  setWindowModified(document.isDirty());
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
