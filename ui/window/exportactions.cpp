// SPDX-License-Identifier: Apache-2.0
#include "ui/window/exportactions.h"

#include "ui/session/recordedview.h"
#include "ui/session/runexport.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/window/actions.h"
#include "ui/window/exportdialog.h"
#include "ui/window/filmdialog.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <utility>

namespace ps {
namespace {
const QString kTopic = QStringLiteral("export");
}  // namespace

ExportActions::ExportActions(Session& session, const Actions& actions, Notices& notices, QObject* parent)
    : QObject(parent), m_session(session), m_actions(actions), m_notices(notices) {
  const RunExport& exports = session.exports();
  connect(&exports, &RunExport::working, this, &ExportActions::onWorking);
  connect(&exports, &RunExport::ended, this, [this] {
    m_tells = false;
    m_notices.bar().close(kTopic);
  });
  connect(&exports, &RunExport::written, this, &ExportActions::onWritten);
  connect(&exports, &RunExport::cancelled, this, [this](const QString& what, const QString& where) {
    const QString left =
        QFileInfo::exists(where)
            ? QStringLiteral("what was written until then is whole, in %1").arg(QDir::toNativeSeparators(where))
            : QStringLiteral("nothing was written");
    m_notices.message(MessageLevel::Info, what, QStringLiteral("Given up: %1.").arg(left));
  });
  connect(&exports, &RunExport::failed, this, [this](const QString& what, const QString& problem) {
    m_session.log().add(MessageLevel::Error, what, sentence(problem));
    m_notices.bar().show(kTopic, MessageLevel::Error, QStringLiteral("The run was not exported."), sentence(problem));
  });
}

void ExportActions::addTo(QMenu* menu, const Viewport* view) {
  const auto add = [&](const QString& name, const QString& text, const QString& tip, std::function<QDialog*()> make) {
    m_actions.add(menu, name, text, {}, [this, make = std::move(make)] { open(make); });
    m_actions.find(name)->setToolTip(tip);
  };
  QMainWindow* window = &m_actions.window();
  add(QStringLiteral("file.film"), QStringLiteral("Export film or pictures…"),
      QStringLiteral("What was recorded of the run, in the view and the colours of now."),
      [this, window, view] { return new FilmDialog(m_session, view, window); });
  add(QStringLiteral("file.export"), QStringLiteral("Export particles or surfaces…"),
      QStringLiteral("What was recorded of the run, for ParaView, Blender and others, a file for each frame."),
      [this, window] { return new ExportDialog(m_session, window); });
}

void ExportActions::setEnabled(bool on) {
  for (const char* name : {"file.film", "file.export"}) m_actions.find(QString::fromLatin1(name))->setEnabled(on);
}

void ExportActions::open(const std::function<QDialog*()>& make) {
  const bool any = m_session.isReady() && m_session.recorded().extent().frames > 0;
  const QString why = m_session.exports().isBusy() ? QStringLiteral("Another export is being written.")
                      : any                        ? QString()
                                                   : QStringLiteral("Nothing has been recorded of a run.");
  m_notices.refuse(QStringLiteral("Nothing is exported."), why);
  if (why.isEmpty()) make()->open();
}

void ExportActions::onWorking(const QString& stage, double done, double left) {
  QString text = QStringLiteral("%1 %").arg(formatFixed(100 * done, 0));
  if (left >= 0) text += QStringLiteral(", %1 left").arg(spanText(left));
  if (std::exchange(m_tells, true)) {
    m_notices.bar().setText(kTopic, text);
  } else {
    m_notices.bar().show(kTopic, MessageLevel::Info, stage, text,
                         {{QStringLiteral("Cancel"), [this] { m_session.exports().cancel(); }}});
  }
}

void ExportActions::onWritten(const QString& what, const QString& where, qulonglong frames) {
  m_session.log().add(
      MessageLevel::Ok, what,
      QStringLiteral("%1 written to %2.")
          .arg(countText(frames, QStringLiteral("frame"), QStringLiteral("frames")), QDir::toNativeSeparators(where)));
}

}  // namespace ps
