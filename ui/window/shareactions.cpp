// SPDX-License-Identifier: Apache-2.0
#include "ui/window/shareactions.h"

#include "core/experiments/sharing.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/film/thumbnail.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtGui/QAction>
#include <QtGui/QImage>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <utility>

namespace ps {
namespace {

const QString kTopic = QStringLiteral("end");
const QString kCopy = QStringLiteral("Copy for sharing"), kCheck = QStringLiteral("End of the run");
constexpr const char* kProgram = "phasesketch " PS_VERSION;

/// "water", "water and wax", "water, wax and wood".
QString listText(const std::vector<std::string>& ids) {
  QString text;
  for (size_t k = 0; k < ids.size(); ++k) {
    const bool last = k + 1 == ids.size();
    text += (k == 0 ? QString()
             : last ? QStringLiteral(" and ")
                    : QStringLiteral(", ")) +
            QString::fromStdString(ids[k]);
  }
  return text;
}

/// Writes it with its end, and says what is to be known of it.
RunWork::Result write(SharedCopy copy, PluginRegistry& plugins, const QString& path) {
  // What is read back is what is run: a number may have lost its last bit on the way through the file.
  const Project written = parseProject(writeProject(copy.project), path.toStdString(), plugins).project;
  copy.project.end = runToEnd(written, plugins, lastFrameOf(written), kProgram);
  saveProject(copy.project, path.toStdString());
  const RunEnd& end = *copy.project.end;
  QString text = QStringLiteral(
                     "Written to %1. It says what its run comes to after %2 frames (%3): whoever opens it is "
                     "told whether their machine comes to the same.")
                     .arg(QDir::toNativeSeparators(path), QString::number(end.frame), QString::fromStdString(end.hash));
  if (!copy.written.empty())
    text += QStringLiteral(" These materials are written out in it: %1.").arg(listText(copy.written));
  if (copy.needed.empty()) return {text};
  return {
      text +
          QStringLiteral(" Others have to install what does not come with the program: %1.").arg(listText(copy.needed)),
      MessageLevel::Warning};
}

}  // namespace

ShareActions::ShareActions(Session& session, const Actions& actions, Notices& notices, QObject* parent)
    : QObject(parent), m_session(session), m_actions(actions), m_notices(notices) {
  connect(&session.files(), &DocumentFiles::opened, this, &ShareActions::onOpened);
}

void ShareActions::addTo(QMenu* menu, Viewport* view) {
  m_view = view;
  const auto add = [&](const char* name, const char* text, const char* tip, void (ShareActions::*act)()) {
    m_actions.add(menu, QString::fromLatin1(name), QString::fromUtf8(text), {}, [this, act] { (this->*act)(); });
    m_actions.find(QString::fromLatin1(name))->setToolTip(QString::fromUtf8(tip));
  };
  add("file.share", "Save a copy for sharing…",
      "One file with everything in it and what its run comes to, so that others see whether it does so with them.",
      &ShareActions::chooseCopy);
  add("file.checkEnd", "Check how the run ends",
      "Runs the copy as it was opened, in the background, and says whether it comes to the same here.",
      &ShareActions::check);
}

void ShareActions::setEnabled(bool on) {
  m_actions.find(QStringLiteral("file.share"))->setEnabled(on);
  m_actions.find(QStringLiteral("file.checkEnd"))->setEnabled(on && m_opened);
}

void ShareActions::chooseCopy() {
  const Document& document = m_session.document();
  const QString& own = document.path();
  const bool hasFile = !own.isEmpty() && !m_session.files().isSample(own);
  const QString name = hasFile ? QFileInfo(own).completeBaseName() : fileNameFor(document.title());
  const QString path = fileToWrite(&m_actions.window(), QStringLiteral("Save a copy for sharing"),
                                   folderBeside(m_session) + QLatin1Char('/') + name + QStringLiteral("-shared.json"),
                                   QStringLiteral("PhaseSketch projects (*.json)"));
  if (!path.isEmpty()) writeCopy(path);
}

void ShareActions::writeCopy(const QString& path) {
  const Document& document = m_session.document();
  QString why;
  if (m_session.work().isBusy()) why = QStringLiteral("Other work is still going on.");
  if (!document.path().isEmpty() && QFileInfo(path) == QFileInfo(document.path()))
    why = QStringLiteral("This is the file that is open: choose another name for the copy.");
  m_notices.refuse(QStringLiteral("No copy is written."), why);
  if (!why.isEmpty()) return;
  const bool hasPicture = !document.project().thumbnail.empty();
  const QImage shown = m_view && !hasPicture ? m_view->grabFramebuffer() : QImage();
  m_session.work().start(
      {kCopy, path, [path, shown, project = document.project(), plugins = m_session.registry()](const KeptRun&) {
         SharedCopy copy = copyForSharing(project, *plugins);
         if (copy.project.thumbnail.empty()) copy.project.thumbnail = thumbnailOf(shown);
         return write(std::move(copy), *plugins, path);
       }});
}

void ShareActions::onOpened() {
  const Project& project = m_session.document().project();
  m_opened = project.end ? std::make_shared<const Project>(project) : nullptr;
  m_notices.bar().close(kTopic);
  setEnabled(true);
  if (!m_opened) return;
  m_notices.bar().show(kTopic, MessageLevel::Info, QStringLiteral("This copy says how its run ends."),
                       QStringLiteral("At %1, as %2 ran it. Run it here, in the background, to see whether it comes to "
                                      "the same.")
                           .arg(clockText(project.end->time), QString::fromStdString(project.end->program)),
                       {{QStringLiteral("Check it"), [this] { check(); }}});
}

void ShareActions::check() {
  if (!m_opened) return;
  const QString why = m_session.work().isBusy() ? QStringLiteral("Other work is still going on.") : QString();
  m_notices.refuse(QStringLiteral("The end is not checked."), why);
  if (!why.isEmpty()) return;
  m_notices.bar().close(kTopic);
  m_session.work().start(
      {kCheck, {}, [project = m_opened, plugins = m_session.registry()](const KeptRun&) {
         const RunEnd& noted = *project->end;
         const std::string differs = differences(noted, runToEnd(*project, *plugins, noted.frame, kProgram));
         if (differs.empty())
           return RunWork::Result{
               QStringLiteral("Reproduced: after %1 frames the state is the same to the bit.").arg(noted.frame)};
         return RunWork::Result{QStringLiteral("Not reproduced: %1.").arg(QString::fromStdString(differs)),
                                MessageLevel::Warning};
       }});
}

}  // namespace ps
