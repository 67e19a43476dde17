// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/ui/scenestory.h"

#include <algorithm>
#include <cmath>
#include <string>

// What the stories of the cup share.
namespace ps {

inline constexpr double kCupRadius = 0.1, kCupHeight = 0.16;  // m

template <class Window>
class CupStory : public SceneStory<Window> {
 protected:
  using SceneStory<Window>::meanOf;
  using SceneStory<Window>::placesOf;

  /// How much of a body is within the cup's wall and above its bottom.
  size_t inCup(const std::string& id) {
    const Vector3 cup = meanOf(m_cup);
    size_t count = 0;
    for (const Vector3& p : placesOf(id)) {
      const double across = std::hypot(p.x() - cup.x(), p.z() - cup.z());
      count += across < kCupRadius && std::abs(p.y() - cup.y()) < kCupHeight ? 1 : 0;
    }
    return count;
  }
  std::string m_cup, m_water, m_ice;
  size_t m_iceCount = 0;
};

}  // namespace ps
