// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/ui/samplewindow.h"
#include "tests/vr/scriptedrun.h"
#include "ui/vr/stand.h"
#include "ui/window/statusline.h"
#include "ui/window/vrmode.h"

#include <QtGui/QAction>

#include <string>

// The real window on the first sample, whose headset a script wears.
namespace ps {

inline constexpr int kSide = 256;  ///< pixels of an eye

/// Looks down by 29 degrees.
inline vr::HandPose scriptHead() { return {{0.1, 1.5, 0.2}, Quaternion(0.9682458, -0.25, 0, 0).normalized()}; }

/// Of the script's head: half of 63 mm beside it, through a window of 90 degrees.
inline Eye scriptEye(bool right) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = scriptHead().orientation.toRotationMatrix();
  place.translation() = scriptHead().position + scriptHead().orientation * Vector3(right ? 0.0315 : -0.0315, 0, 0);
  return eyeThrough(place.inverse().matrix(), -1, 1, -1, 1, 0.03, 100);
}

/// Keys of a script: neither hand is there.
const QString kHandsAway = QStringLiteral(R"(, {"frame": 1, "left": {"active": false}, "right": {"active": false}})");

/// Frames as long as a headset's, so that the window has its share of the machine. `keys`: further ones, `more`: other
/// keys of the script, each with a comma before it.
inline std::string vrScript(const QString& more = {}, const QString& keys = {}) {
  return QStringLiteral(R"({"real_time": true, "period": 0.02, "refresh_rates": [50],
                            "view": {"width": %1, "height": %1},
                            "profile": "/interaction_profiles/oculus/touch_controller",
                            "keys": [{"frame": 0, "head": [0.1, 1.5, 0.2, -0.25, 0, 0, 0.9682458]}%2]%3})")
      .arg(QString::number(kSide), keys, more)
      .toStdString();
}

class VrWindowTest : public SampleWindowTest {
 protected:
  VrMode& vr() { return m_window->vr(); }
  QAction* action() { return m_window->action(QStringLiteral("simulation.vr")); }
  QString status() { return m_window->statusLine()->parts().join(QLatin1Char('|')); }
  /// How the scene stands in the script's room.
  vr::Stand stand() { return vr::standBefore(scriptHead(), boxOf(*view()->snapshot(), view()->scene().environment)); }
  void enter() {
    action()->trigger();
    QVERIFY(action()->isChecked() && vr().active());
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 4 || !vr().active(), kLong);
    QVERIFY(vr().active());
  }
  void leave() {
    action()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!vr().active(), kLong);
    QVERIFY(!action()->isChecked());
  }
  void leaveAtLast() {
    if (!m_window) return;
    if (vr().active()) vr().leave();
    QTRY_VERIFY_WITH_TIMEOUT(!vr().active(), kLong);
    m_window->statusLine()->say({});
  }
};

}  // namespace ps
