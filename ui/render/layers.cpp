// SPDX-License-Identifier: Apache-2.0
#include "ui/render/layers.h"

#include <algorithm>

namespace ps::render {

Layers::Background& Layers::backgroundOf(const PicturePlace& place) {
  const auto found =
      std::find_if(backgrounds.begin(), backgrounds.end(), [&](const Background& b) { return b.place == place; });
  if (found != backgrounds.end()) {
    backgrounds.splice(backgrounds.begin(), backgrounds, found);
  } else if (backgrounds.size() < kBackgrounds) {
    backgrounds.emplace_front();
  } else {
    backgrounds.splice(backgrounds.begin(), backgrounds, std::prev(backgrounds.end()));
  }
  Background& first = backgrounds.front();
  if (first.place != place) first.uniforms = {};
  first.place = place;
  return first;
}

Layers& LayerPool::at(int width, int height) {
  ++m_draws;
  const auto bySize = [&](const Layers& l) { return l.width == width && l.height == height; };
  auto found = std::find_if(m_layers.begin(), m_layers.end(), bySize);
  std::erase_if(m_layers, [&](const Layers& l) { return !bySize(l) && l.used + kIdle < m_draws; });
  if (found == m_layers.end()) {
    if (m_layers.size() == kSizes)
      m_layers.erase(std::min_element(m_layers.begin(), m_layers.end(),
                                      [](const Layers& a, const Layers& b) { return a.used < b.used; }));
    found = m_layers.emplace(m_layers.end());
    found->width = width;
    found->height = height;
    for (Texture* texture : {&found->surface, &found->normal, &found->distance, &found->picture})
      texture->resize(width, height);
  }
  found->used = m_draws;
  return *found;
}

const Layers* LayerPool::find(int width, int height) const {
  const auto found = std::find_if(m_layers.begin(), m_layers.end(),
                                  [&](const Layers& l) { return l.width == width && l.height == height; });
  return found == m_layers.end() ? nullptr : &*found;
}

void LayerPool::drop(const Layers& layers) {
  m_layers.remove_if([&](const Layers& l) { return &l == &layers; });
}

}  // namespace ps::render
