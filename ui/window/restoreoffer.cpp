// SPDX-License-Identifier: Apache-2.0
#include "ui/window/restoreoffer.h"

#include "ui/session/documentfiles.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/window/notices.h"

#include <QtCore/QFileInfo>

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

RestoreOffer::RestoreOffer(Session& session, Notices& notices, bool old, QObject* parent)
    : QObject(parent), m_session(session), m_notices(notices), m_old(old) {
  Autosave* autosave = session.autosave();
  if (!autosave) return;
  connect(autosave, &Autosave::failed, this, [this](const QString& problem, bool replaced) {
    if (replaced) {
      showReplaced(QStringLiteral("No copy could be kept: %1").arg(sentence(problem)));
    } else {
      m_notices.message(MessageLevel::Warning, QStringLiteral("Autosave"),
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

bool RestoreOffer::reopenLast() {
  if (!m_old || !m_session.autosave()) return false;
  for (const AutosavedSession& session : m_session.autosave()->leftBehind()) {
    if (session.end != SessionEnd::Closed) continue;
    if (!QFileInfo(session.copy.isEmpty() ? session.path : session.copy).isFile()) break;
    m_session.files().reopen(session);
    return true;
  }
  return false;
}

/// Copies of unsaved work that no window has open, newest first.
std::vector<AutosavedSession> RestoreOffer::unsavedWork() const {
  if (!m_session.autosave()) return {};
  std::vector<AutosavedSession> waiting = m_session.autosave()->leftBehind();
  waiting.erase(std::remove_if(waiting.begin(), waiting.end(),
                               [](const AutosavedSession& session) { return session.copy.isEmpty(); }),
                waiting.end());
  return waiting;
}

void RestoreOffer::offerAtStart() {
  if (!m_old || !m_session.autosave()) return;
  for (const AutosavedSession& session : m_session.autosave()->leftBehind()) {
    if (session.copy.isEmpty()) Autosave::discard(session);
  }
  offer();
}

void RestoreOffer::offer() {
  m_offered.clear();
  for (const AutosavedSession& session : unsavedWork()) m_offered << session.stem;
  offerNext();
}

void RestoreOffer::offerNext() {
  m_notices.bar().close(QStringLiteral("restore"));
  m_present = {};
  for (const AutosavedSession& session : unsavedWork()) {
    if (!m_offered.contains(session.stem)) continue;
    const auto decided = [this, stem = session.stem] {
      m_offered.removeAll(stem);
      offerNext();
    };
    m_present = {QStringLiteral("Unsaved work can be restored."),
                 whyLeftBehind(session),
                 {{QStringLiteral("Restore"),
                   [this, session, decided] {
                     m_session.files().reopen(session);
                     decided();
                   }},
                  {QStringLiteral("Keep for later"), decided},
                  {QStringLiteral("Discard"), [session, decided] {
                     Autosave::discard(session);
                     decided();
                   }}}};
    m_notices.bar().show(QStringLiteral("restore"), MessageLevel::Info, m_present.title, m_present.text,
                         m_present.buttons);
    break;
  }
  Q_EMIT offerChanged();
}

void RestoreOffer::showReplaced(const QString& text) {
  if (!m_replaced) return;
  NoticeBar& bar = m_notices.bar();
  const QString title = QStringLiteral("“%1” had unsaved changes.").arg(m_replaced->session.title);
  bar.show(QStringLiteral("replaced"), MessageLevel::Warning, title, text,
           {{QStringLiteral("Back to it"), [this] {
               m_notices.bar().close(QStringLiteral("replaced"));
               const auto work = std::move(m_replaced);
               if (work) m_session.files().bringBack(*work);
             }}});
  m_session.log().add(MessageLevel::Warning, m_replaced->session.title, title + QLatin1Char(' ') + text);
}

}  // namespace ps
