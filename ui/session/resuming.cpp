// SPDX-License-Identifier: Apache-2.0
#include "ui/session/resuming.h"

#include "ui/session/documentfiles.h"
#include "ui/session/recordedview.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"

#include <utility>

namespace ps {

Resuming::Resuming(Session& session, Selection& selection) : m_session(session), m_selection(selection) {
  if (!session.autosave()) return;
  session.autosave()->setLook([this] { return present(); });
  connect(&session.files(), &DocumentFiles::reopened, this,
          [this](const AutosavedSession& left) { m_left = left.look; });
  connect(&session.files(), &DocumentFiles::opened, this, &Resuming::onOpened);
  connect(&session.recordings(), &RecordingFiles::cameBack, this, &Resuming::onRun);
}

Resuming::~Resuming() {
  if (m_session.autosave()) m_session.autosave()->setLook({});
}

void Resuming::setLook(std::function<void(LastLook&)> add, std::function<void(const LastLook&)> show) {
  m_add = std::move(add);
  m_show = std::move(show);
}

/// A record that plays comes back where it is, paused.
LastLook Resuming::present() const {
  const RecordedView& recorded = m_session.recorded();
  LastLook look{m_selection.items(), m_selection.material(), m_session.playing() && !recorded.isActive(), {}, false};
  if (m_add) m_add(look);
  if (recorded.isActive()) look.shownAt = m_session.now();
  if (m_waiting) look.playing = m_waiting->playing, look.shownAt = m_waiting->shownAt;  // its run has yet to come back
  return look;
}

void Resuming::onOpened() {
  m_waiting.reset();
  if (!m_left) return;
  const LastLook left = *std::exchange(m_left, std::nullopt);
  m_selection.restore(left.selected, left.material);
  if (m_show) m_show(left);
  if (left.hasRun) m_waiting = left;
}

void Resuming::onRun(bool whole) {
  if (!m_waiting) return;
  const LastLook left = *std::exchange(m_waiting, std::nullopt);
  if (whole && left.shownAt) m_session.recorded().showAt(*left.shownAt);
  if (left.playing) m_session.play();
}

}  // namespace ps
