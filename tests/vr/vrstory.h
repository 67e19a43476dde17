// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/ui/scenestory.h"
#include "tests/vr/vrwindow.h"
#include "ui/tools/tooltable.h"

#include <memory>
#include <string>

// What stories share that are told in the headset, each in one stay.
namespace ps {

inline const QString kHolds = QStringLiteral(R"(, "/input/squeeze/value": 1)");
inline const QString kHoldsNothing = QStringLiteral(R"(, "/input/squeeze/value": 0)");

/// `Story`: a SceneStory<VrWindowTest>, or one that is one too.
template <class Story>
class VrStory : public Story {
 protected:
  using Story::document;
  using Story::m_window;
  using Story::session;
  using Story::timeNow;
  using Story::view;

  /// What hands do next, from their own frame 0; the head stays.
  void next(const QString& keys, const QString& more = {}) { m_run->goOn(vrScript(more, keys)); }
  QString right(int frame, const Vector3& tip, const QString& inputs = {}, double roll = 0) {
    return tipKey(frame, "right", m_stand, tip, inputs, roll);
  }
  QString left(int frame, const Vector3& tip, const QString& inputs = {}) {
    return tipKey(frame, "left", m_stand, tip, inputs);
  }
  /// The left hand, which rests at a place, makes what is drawn real, and lets time pass.
  void makeRealAndPlay(const Vector3& rest, const QString& meanwhile) {
    next(left(0, rest) + meanwhile + left(10, rest, QStringLiteral(R"(, "/input/y/click": true)")) +
         left(20, rest, QStringLiteral(R"(, "/input/y/click": false, "/input/x/click": true)")) +
         left(30, rest, QStringLiteral(R"(, "/input/x/click": false)")));
    QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  }
  void brush(const char* shape, double radius, double temperature, bool held) {
    BrushSettings settings = m_window->tools().brush();
    settings.radius = radius;
    settings.temperature = temperature;
    settings.held = held;
    m_window->tools().setBrush(settings);
    m_window->tools().takeBrush(shape);
  }
  void passes(double seconds) {
    const double until = timeNow() + seconds;
    QTRY_VERIFY_WITH_TIMEOUT(timeNow() > until, kRun);
  }
  int steps() { return document().undoStack().index(); }
  /// Both eyes see what the view draws from there, at last. `name`: of the left one's picture.
  void leavesAsEyesSawIt(const QString& name) {
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    const size_t pictures = m_run->lines("picture").size();
    next(kHandsAway, QStringLiteral(R"(, "pictures": [20])"));
    QTRY_VERIFY_WITH_TIMEOUT(m_run->lines("picture").size() == pictures + 2, kLong);
    Story::leave();
    QVERIFY(m_run->lines("violation").empty());
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) eye(false).save(folder + QLatin1Char('/') + name);
    for (const bool isRight : {false, true}) Story::seesWhatTheViewDraws(eye(isRight), isRight, m_stand);
  }

  std::unique_ptr<ScriptedRun> m_run;
  vr::Stand m_stand;

 private:
  QImage eye(bool isRight) {
    const auto names = m_run->texts("picture");
    for (auto name = names.rbegin(); name != names.rend(); ++name)
      if (name->ends_with(isRight ? "-right.png" : "-left.png")) return QImage(QString::fromStdString(*name));
    return {};
  }
};

}  // namespace ps
