// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/matterbrush.h"

#include <string>
#include <utility>

namespace ps {
namespace {

class TouchList final : public api::TouchSink {
 public:
  void submit(const api::List<api::Touch>& touches) override {
    if (!touches.first && touches.count > 0) throw BrushFault("it submitted touches by a null pointer");
    if (touches.count > kMostTouches || m_touches.size() + touches.count > kMostTouches)
      throw BrushFault("it touches matter in more than " + std::to_string(kMostTouches) + " places at a time");
    for (size_t k = 0; k < touches.count; ++k) m_touches.push_back(touches.at(k));
  }
  std::vector<api::Touch> result() { return std::move(m_touches); }

 private:
  std::vector<api::Touch> m_touches;
};

}  // namespace

std::vector<api::Touch> touchesOf(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                                  std::span<const api::StrokeSample> samples) {
  const auto* matter = static_cast<const api::MatterBrush*>(brush.extension(api::kTouchesMatter));
  if (!matter) throw BrushFault("it does not say how it touches matter");
  TouchList list;
  BrushRoom room;
  const auto call = [&](const api::StrokeContext& context, const api::List<api::StrokeSample>& copies) {
    matter->touch(context, kind, copies, list);
  };
  askBrush(brush, setup, samples, call, room);
  return list.result();
}

}  // namespace ps
