// SPDX-License-Identifier: Apache-2.0
#include "ui/window/recordingactions.h"

#include "core/io/recording.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/window/actions.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <utility>
#include <vector>

namespace ps {
namespace {

const QString kFilter = QStringLiteral("Recordings (*%1);;All files (*)").arg(QLatin1String(kRecordingEnding));
const QString kWorking = QStringLiteral("recording");

}  // namespace

RecordingActions::RecordingActions(Session& session, const Actions& actions, Notices& notices, QObject* parent)
    : QObject(parent), m_session(session), m_actions(actions), m_notices(notices) {
  RecordingFiles& files = session.recordings();
  connect(&files, &RecordingFiles::working, this, &RecordingActions::onWorking);
  connect(&files, &RecordingFiles::givingUp, this, [this] {
    if (m_tells) m_notices.bar().setText(kWorking, QStringLiteral("Giving up…"));
  });
  connect(&files, &RecordingFiles::ended, this, [this] {
    m_tells = false;
    m_notices.bar().close(kWorking);
  });
  connect(&files, &RecordingFiles::saved, this, [this](const QString& path, qulonglong frames) {
    m_session.log().add(MessageLevel::Ok, nameOf(path),
                        QStringLiteral("The recording is saved to %1, %2.")
                            .arg(path, countText(frames, QStringLiteral("frame"), QStringLiteral("frames"))));
  });
  connect(&files, &RecordingFiles::saveFailed, this, [this](const QString& path, const QString& problem, bool kept) {
    const QString title = QStringLiteral("The recording is not saved.");
    const QString text =
        sentence(problem) + (kept ? QStringLiteral(" It is kept as long as the scene is open.") : QString());
    m_session.log().add(MessageLevel::Error, nameOf(path), title + QLatin1Char(' ') + text);
    std::vector<NoticeBar::Button> buttons;
    if (kept) buttons.push_back({QStringLiteral("Save elsewhere…"), [this] { chooseSave(); }});
    m_notices.bar().show(QStringLiteral("save"), MessageLevel::Error, title, text, std::move(buttons));
  });
  connect(&files, &RecordingFiles::opened, this, &RecordingActions::onOpened);
  connect(&files, &RecordingFiles::openFailed, this, [this](const QString& path, const QString& problem) {
    m_notices.message(MessageLevel::Warning, QStringLiteral("“%1” was not opened").arg(nameOf(path)),
                      sentence(problem));
  });
}

void RecordingActions::addTo(QMenu* menu) {
  const auto add = [&](const char* name, const QString& text, const char* tip, void (RecordingActions::*act)()) {
    m_actions.add(menu, QString::fromLatin1(name), text, {}, [this, act] { (this->*act)(); });
    m_actions.find(QString::fromLatin1(name))->setToolTip(QString::fromUtf8(tip));
  };
  add("file.openRecording", QStringLiteral("Open recording…"),
      "What was recorded of a run, at its end: it can be looked through, and gone on from at any time.",
      &RecordingActions::chooseOpen);
  add("file.saveRecording", QStringLiteral("Save recording…"),
      "All that is recorded of the run. Beside its project, it is opened with it.", &RecordingActions::chooseSave);
}

void RecordingActions::setEnabled(bool on) {
  for (const char* name : {"file.openRecording", "file.saveRecording"}) {
    if (QAction* action = m_actions.find(QString::fromLatin1(name))) action->setEnabled(on);
  }
}

void RecordingActions::chooseSave() {
  const Document& document = m_session.document();
  QString suggestion = RecordingFiles::beside(document.path());
  if (suggestion.isEmpty() || m_session.files().isSample(document.path())) {
    suggestion =
        folderBeside(m_session) + QLatin1Char('/') + fileNameFor(document.title()) + QLatin1String(kRecordingEnding);
  }
  const QString path = fileToWrite(&m_actions.window(), QStringLiteral("Save the recording"), suggestion, kFilter);
  if (!path.isEmpty()) m_session.recordings().save(path);
}

void RecordingActions::chooseOpen() {
  const QString path =
      fileToRead(&m_actions.window(), QStringLiteral("Open a recording"), folderBeside(m_session), kFilter);
  if (!path.isEmpty()) m_session.recordings().open(path);
}

void RecordingActions::onWorking(const QString& stage, double done, double left) {
  const QString text = progressText(done, left);
  if (std::exchange(m_tells, true)) {
    m_notices.bar().setText(kWorking, text);
  } else {
    m_notices.bar().show(kWorking, MessageLevel::Info, stage, text,
                         {NoticeBar::cancelButton([this] { m_session.recordings().cancel(); })});
  }
}

void RecordingActions::onOpened(const QString& path, double from, double to, const QString& remark) {
  const QString text = QStringLiteral("The recording from %1 to %2 is opened").arg(clockText(from), clockText(to));
  m_session.log().add(MessageLevel::Ok, nameOf(path), sentence(text));
  if (!remark.isEmpty()) m_notices.message(MessageLevel::Warning, text, sentence(remark));
}

}  // namespace ps
