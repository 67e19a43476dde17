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

double timeToSet(Session& session, double seconds, Qt::KeyboardModifiers modifiers) {
  constexpr double kTenths = 10;  // of a second
  if (modifiers & Qt::ShiftModifier) return seconds;
  if (!(modifiers & Qt::ControlModifier)) {
    // Of a short axis a tenth of a second would be far from where one points.
    const double end = timeAxisEnd(session, session.document().project().duration);
    const double steps = std::max(kTenths, std::pow(10, std::ceil(std::log10(kTenths / end))));
    seconds = std::round(seconds * steps) / steps;
  }
  const double frame = 2 * session.document().keySlack();
  return frame > 0 ? std::round(seconds / frame) * frame : seconds;
}

}  // namespace ps
