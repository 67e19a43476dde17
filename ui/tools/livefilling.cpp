// SPDX-License-Identifier: Apache-2.0
// The part of LiveStroke that lets hollows run full.
#include "core/simulation/lattice.h"
#include "ui/session/scenelink.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/strokethread.h"
#include "ui/tools/toolbox.h"

#include <chrono>
#include <optional>
#include <utility>

namespace ps {

/// Of hidden bodies too. Matter that comes into a place later keeps it as well: the engine fills what is free by then.
/// Looked at when first asked, by the stroke's thread.
std::function<bool(const Vector3&)> LiveStroke::freePlaces() const {
  const auto occupied = std::make_shared<std::optional<OccupiedPlaces>>();
  return [occupied, scene = m_box.link()->scene(), clearance = 0.9 * m_setup.grid.spacing](const Vector3& place) {
    if (!*occupied) {
      occupied->emplace(clearance, scene ? scene->position.size() : 0);
      for (size_t i = 0; scene && i < scene->position.size(); ++i) {
        const api::Float4& p = scene->position[i];
        (*occupied)->add({p.x, p.y, p.z});
      }
    }
    return (*occupied)->isFree(double3Of(place));
  };
}

bool LiveStroke::end() {
  constexpr std::chrono::milliseconds kPatience{250};  // for which nothing needs to be shown
  if (!m_record || m_kind != api::EditKind::Fill) return true;
  m_thread->lift();
  m_ends = !m_thread->isIdle(kPatience);
  if (m_ends) tellOfEnd();
  return !m_ends;
}

void LiveStroke::tellOfEnd() {
  m_box.work(QStringLiteral("filling, of the most that may run full"), static_cast<int>(99 * m_thread->filled()));
}

void LiveStroke::stopEnding() {
  if (std::exchange(m_ends, false)) m_box.work({}, -1);
}

}  // namespace ps
