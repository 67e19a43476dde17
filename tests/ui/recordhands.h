// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/runrecord.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/timeline/transport.h"

#include <QtWidgets/QPushButton>

// What a hand does to the record of a run: dragged over, gone on from.
namespace ps::hands {

inline uint64_t hashNow(Session& session) {
  return onEngine<uint64_t>(session, [](Engine& engine) { return engine.stateHash(); });
}

/// One that is kept, and what it is to the bit: where the machine is busy, frames that come faster than they are packed
/// are left out.
inline uint64_t stepKept(Session& session) {
  session.engine()->stepOnce();
  const uint64_t now = hashNow(session);
  session.engine()->recording().settle();
  return now;
}

/// From the left over the bar to a frame.
inline void scrubTo(Transport& transport, uint64_t frame) {
  const QPoint to = transport.placeOf(static_cast<double>(frame) / 60), from = transport.placeOf(0);
  QTest::mousePress(&transport, Qt::LeftButton, {}, from);
  for (int k = 1; k <= 5; ++k) QTest::mouseMove(&transport, from + (to - from) * k / 5);
  QTest::mouseRelease(&transport, Qt::LeftButton, {}, to);
}

/// The run goes on from a frame, and stands at `until` or beyond.
inline void branchAt(MainWindow& window, uint64_t frame, uint64_t until) {
  Session& session = window.session();
  const size_t runs = session.recorded().earlier().size();
  scrubTo(*window.transport(), frame);
  QTRY_COMPARE_WITH_TIMEOUT(session.snapshot()->stats.frame, frame, kLong);
  const double speed = session.recorded().speed();
  session.setSpeed(0.02);  // one frame before it is paused again, not as many as come without being kept
  QTest::mouseClick(window.transport()->continueButton(), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(session.recorded().earlier().size(), runs + 1, kLong);
  QTRY_VERIFY_WITH_TIMEOUT(!session.recorded().isActive(), kLong);  // the window has heard of it
  session.pause();
  session.setSpeed(speed);
  hashNow(session);  // the frame that it was at is done
  while (session.newest()->stats.frame < until) {
    stepKept(session);
  }
  session.engine()->recording().settle();
}

}  // namespace ps::hands
