// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/livescene.h"

#include <algorithm>

namespace ps::vr {
namespace {

constexpr double kLongest = 0.2;  // s: after a longer wait nobody expects that it is made up for

/// Whether one lies so shortly before the other that matter is seen to move from there.
bool leadsTo(const SnapshotPtr& before, const SnapshotPtr& now) {
  return before && now && before->revision == now->revision && before->stats.time < now->stats.time;
}

}  // namespace

std::array<std::optional<Vibration>, 2> LiveScene::prepare(const HeadsetFrame& frame) {
  take(m_link->shown(), frame);
  static const Snapshot kEmpty;
  const double now = share(frame);
  if (m_prepared != m_view || m_share != now) {
    const HeadsetView& view = *m_view;
    m_renderer.prepare(view.matter ? *view.matter : kEmpty, m_before.get(), now, view.scene, view.look);
    m_prepared = m_view;
    m_share = now;
  }
  return {};
}

void LiveScene::take(std::shared_ptr<const HeadsetView> view, const HeadsetFrame& frame) {
  if (!view || view == m_view) return;
  if (view->matter != m_view->matter) {
    const bool moves = view->goesOn && leadsTo(m_view->matter, view->matter);
    m_before = moves ? m_view->matter : nullptr;
    m_lasts = moves ? std::min(frame.time - m_came, kLongest) : 0;
    m_came = frame.time;
  }
  if (view->project != m_view->project) m_stand = standBefore(frame.head, view->box);
  m_view = std::move(view);
}

double LiveScene::share(const HeadsetFrame& frame) const {
  if (!m_before || m_lasts <= 0) return 1;
  return std::clamp((frame.time + frame.period - m_came) / m_lasts, 0.0, 1.0);
}

void LiveScene::draw(size_t, const Eye& view, const RenderTarget& target) {
  m_renderer.draw(m_stand.toScene(view), target);
}

}  // namespace ps::vr
