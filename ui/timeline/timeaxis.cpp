// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/timeaxis.h"

#include "ui/document/document.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"

#include <algorithm>
#include <cmath>

namespace ps {

double timeAxisEnd(Session& session, double duration) {
  const Project& project = session.document().project();
  double last = std::max(duration, session.recorded().extent().to);
  for (const Track& track : project.tracks) last = std::max(last, track.keys.back().time);
  for (const Marker& marker : project.markers) last = std::max(last, marker.time);
  return last > 0 ? last : 1;
}

double timeToSet(double seconds, double frame, Qt::KeyboardModifiers modifiers) {
  constexpr double kTenths = 10;  // of a second
  if (modifiers & Qt::ShiftModifier) return seconds;
  if (!(modifiers & Qt::ControlModifier)) seconds = std::round(seconds * kTenths) / kTenths;
  return frame > 0 ? std::round(seconds / frame) * frame : seconds;
}

}  // namespace ps
