// SPDX-License-Identifier: Apache-2.0
#include "ui/window/exportactions.h"

#include "ui/session/recordedview.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/window/actions.h"
#include "ui/window/dialogrow.h"
#include "ui/window/exportform.h"
#include "ui/window/filmform.h"
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
  const RunWork& work = session.work();
  connect(&work, &RunWork::working, this, &ExportActions::onWorking);
  connect(&work, &RunWork::ended, this, [this] {
    m_tells = false;
    m_notices.bar().close(kTopic);
  });
  connect(&work, &RunWork::done, this, [this](const QString& what, const QString& text, MessageLevel level) {
    m_session.log().add(level, what, text);
    m_notices.bar().show(kTopic, level == MessageLevel::Info ? MessageLevel::Ok : level, what, text);
  });
  connect(&work, &RunWork::cancelled, this, [this](const QString& what, const QString& where) {
    const QString left =
        QFileInfo(where).isDir()
            ? QStringLiteral("what was written until then is whole, in %1").arg(QDir::toNativeSeparators(where))
            : QStringLiteral("nothing was written");
    const QString text = QStringLiteral("Given up: %1.").arg(left);
    m_session.log().add(MessageLevel::Info, what, text);
    m_notices.bar().show(kTopic, MessageLevel::Info, what, text);
  });
  connect(&work, &RunWork::failed, this, [this](const QString& what, const QString& problem) {
    const QString title = QStringLiteral("“%1” came to nothing.").arg(what);
    // What would help, the problem says itself: another place or a program, which differs.
    const QString text = sentence(problem) + QStringLiteral(" The scene and its run stay as they were.");
    m_session.log().add(MessageLevel::Error, what, title + QLatin1Char(' ') + text);
    m_notices.bar().show(kTopic, MessageLevel::Error, title, text);
  });
}

void ExportActions::addTo(QMenu* menu, const Viewport* view) {
  const auto add = [&](const QString& name, const QString& text, const QString& tip, std::function<QDialog*()> make) {
    m_actions.add(menu, name, text, {}, [this, name, make = std::move(make)] { open(name, make); });
    m_actions.find(name)->setToolTip(tip);
  };
  QMainWindow* window = &m_actions.window();
  add(QStringLiteral("file.film"), QStringLiteral("Export film or pictures…"),
      QStringLiteral("What was recorded of the run, in the view and the colours of now."), [this, window, view] {
        return new RunDialog(new FilmForm(m_session, view), QStringLiteral("Export a film"), window);
      });
  add(QStringLiteral("file.export"), QStringLiteral("Export particles or surfaces…"),
      QStringLiteral("What was recorded of the run, for ParaView, Blender and others, a file for each frame."),
      [this, window] { return new RunDialog(new ExportForm(m_session), QStringLiteral("Export the run"), window); });
}

void ExportActions::setEnabled(bool on) {
  for (const char* name : {"file.film", "file.export"}) m_actions.find(QString::fromLatin1(name))->setEnabled(on);
}

void ExportActions::open(const QString& name, const std::function<QDialog*()>& make) {
  bringUp(m_actions.window(), name, [&]() -> QDialog* {
    const bool any = m_session.isReady() && m_session.recorded().extent().frames > 0;
    const QString why = m_session.isOpening()       ? QStringLiteral("The project is still being opened.")
                        : m_session.work().isBusy() ? QStringLiteral("Other work is still going on.")
                        : any                       ? QString()
                                                    : QStringLiteral("Nothing has been recorded of a run.");
    m_notices.refuse(QStringLiteral("Nothing is exported."), why);
    return why.isEmpty() ? make() : nullptr;
  });
}

void ExportActions::onWorking(const QString& stage, double done, double left) {
  const QString text = m_session.work().isCancelled() ? QStringLiteral("Giving up…") : progressText(done, left);
  if (std::exchange(m_tells, true)) {
    m_notices.bar().setText(kTopic, text);
  } else {
    m_notices.bar().show(kTopic, MessageLevel::Info, stage, text,
                         {NoticeBar::cancelButton([this] { m_session.work().cancel(); })});
  }
}

}  // namespace ps
