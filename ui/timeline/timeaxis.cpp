// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/timeaxis.h"

#include "ui/document/document.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"

#include <algorithm>

namespace ps {

double timeAxisEnd(Session& session, double duration) {
  const Project& project = session.document().project();
  double last = std::max(duration, session.recorded().extent().to);
  for (const Track& track : project.tracks) last = std::max(last, track.keys.back().time);
  for (const Marker& marker : project.markers) last = std::max(last, marker.time);
  return last > 0 ? last : 1;
}

}  // namespace ps
