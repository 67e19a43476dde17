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
  using Window::document;
  using Window::session;
  using SceneStory<Window>::meanOf;
  using SceneStory<Window>::placesOf;
  using SceneStory<Window>::row;

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
  /// By the keys of its row. It acts at once at 0 s: what was drawn before is made anew.
  void makeRigid(const std::string& id) {
    ParameterRow* holds = row(Owner::Body, id, kStructureKey);
    QVERIFY(holds);
    holds->setFocus();
    const auto structure = [&] {
      const auto& constraints = document().body(id)->constraints;
      return constraints.empty() ? std::string() : constraints.front().plugin;
    };
    for (int k = 0; k < 9 && structure() != "rigid"; ++k) QTest::keyClick(holds, Qt::Key_Up);
    for (int k = 0; k < 9 && structure() != "rigid"; ++k) QTest::keyClick(holds, Qt::Key_Down);
    QCOMPARE(structure(), std::string("rigid"));
    QTRY_VERIFY_WITH_TIMEOUT(!session().appliesAtOnce() || !placesOf(id).empty(), kLong);
  }

  std::string m_cup, m_water, m_ice;
  size_t m_iceCount = 0;
};

}  // namespace ps
