// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/ui/samplewindow.h"
#include "tests/vr/scriptedrun.h"
#include "ui/vr/stand.h"
#include "ui/window/statusline.h"
#include "ui/window/vrmode.h"

#include <QtGui/QAction>
#include <QtGui/QImage>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

inline constexpr const char* kTouch = "/interaction_profiles/oculus/touch_controller";

/// Keys of a script: from a frame on neither hand is there.
inline QString awayFrom(int frame) {
  return QStringLiteral(R"(, {"frame": %1, "left": {"active": false}, "right": {"active": false}})").arg(frame);
}
inline const QString kHandsAway = awayFrom(1);

inline const QString kPulled = QStringLiteral(R"(, "/input/trigger/value": 1)");
inline const QString kLetGo = QStringLiteral(R"(, "/input/trigger/value": 0)");
inline const QString kHolds = QStringLiteral(R"(, "/input/squeeze/value": 1)");
inline const QString kHoldsNothing = QStringLiteral(R"(, "/input/squeeze/value": 0)");
/// Of a button of the controller, down or let go.
inline QString clicked(const char* part, bool down = true) {
  return QStringLiteral(R"(, "/input/%1/click": %2)").arg(QLatin1String(part), QLatin1String(down ? "true" : "false"));
}
inline const QString kPulledHeld = kPulled + kHolds;
inline const QString kLetGoHeld = kLetGo + kHoldsNothing;

/// A key of the script: a hand whose tip is at a place in the scene, level and looking away from its wearer, with more
/// of its inputs. `roll`: rad to the left, about the way it points, by which it is turned.
inline QString tipKey(int frame, const char* hand, const vr::Stand& stand, const Vector3& tip, const QString& inputs,
                      double roll = 0) {
  const Vector3 at = stand.toRoom(tip) + Vector3(0, 0, vr::kTip);
  return QStringLiteral(
             R"(, {"frame": %1, "%2": {"grip": [%3, %4, %5, 0, 0, %6, %7], "aim": [%3, %4, %5, 0, 0, %6, %7]%8}})")
      .arg(QString::number(frame), QString::fromLatin1(hand), QString::number(at.x()), QString::number(at.y()),
           QString::number(at.z()), QString::number(std::sin(roll / 2)), QString::number(std::cos(roll / 2)), inputs);
}

/// Frames as long as a headset's, so that the window has its share of the machine. `keys`: further ones, `more`: other
/// keys of the script, each with a comma before it.
inline std::string vrScript(const QString& more = {}, const QString& keys = {}) {
  return QStringLiteral(R"({"real_time": true, "period": 0.02, "refresh_rates": [50],
                            "view": {"width": %1, "height": %1},
                            "profile": "%4",
                            "keys": [{"frame": 0, "head": [0.1, 1.5, 0.2, -0.25, 0, 0, 0.9682458]}%2]%3})")
      .arg(QString::number(kSide), keys, more, QString::fromLatin1(kTouch))
      .toStdString();
}

/// Such a script with other controllers.
inline std::string withProfile(const std::string& script, const QString& profile) {
  return QString::fromStdString(script).replace(QString::fromLatin1(kTouch), profile).toStdString();
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
  /// The picture of one of the script's eyes, whose hands are away, is what the view would draw from there. It may be
  /// smaller than was asked for, and coarser, where the headset was late.
  void seesWhatTheViewDraws(const QImage& eye, bool right, const vr::Stand& stand) {
    const QImage picture = eye.convertToFormat(QImage::Format_RGBA8888);
    const int side = picture.width();
    QVERIFY(side > 0 && picture.height() == side);
    view()->doneCurrent();
    HeadlessContext context;
    Renderer renderer;
    renderer.prepare(*view()->snapshot(), nullptr, 1, view()->scene(), view()->look());
    const double each = 4.0 * side * side;
    double difference = 256 * each, contrast = 0;
    const int finest = side == kSide ? 0 : 1;  // vr::Detail takes a step of what is soft before any pixels
    for (const int coarser : {finest, finest + 1}) {
      const auto wanted = renderImage(renderer, stand.toScene(scriptEye(right)), {side, side, false}, coarser);
      const QImage drawn(wanted.data(), side, side, 4 * side, QImage::Format_RGBA8888);
      double all = 0;
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < 4 * side; ++x) all += std::abs(picture.constScanLine(y)[x] - drawn.constScanLine(y)[x]);
      difference = std::min(difference, all);
    }
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < 4 * side; ++x)
        contrast += std::abs(picture.constScanLine(y)[x] - picture.constScanLine(0)[x % 4]);
    // A smaller picture is made of fewer and larger steps of light, and has more edge for its area.
    QVERIFY2(difference / each < (side == kSide ? 1 : 1.5), qPrintable(QString::number(difference / each)));
    QVERIFY2(contrast / each > 10, qPrintable(QString::number(contrast / each)));
  }
  void leaveAtLast() {
    if (!m_window) return;
    if (vr().active()) vr().leave();
    QTRY_VERIFY_WITH_TIMEOUT(!vr().active(), kLong);
    m_window->statusLine()->say({});
  }
};

}  // namespace ps
