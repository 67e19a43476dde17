// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/headset.h"

#include "ui/vr/cardclock.h"
#include "ui/vr/depthlayer.h"
#include "ui/vr/detail.h"
#include "ui/vr/eyepicture.h"
#include "ui/vr/floor.h"
#include "ui/vr/hands.h"
#include "ui/vr/handtracking.h"
#include "ui/vr/mirror.h"
#include "ui/vr/refreshrate.h"
#include "ui/vr/suggestions.h"
#include "ui/vr/visibilitymask.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace ps::vr {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kPause{5};        // between looks at a headset that lies on the table
constexpr milliseconds kPatience{2000};  // for the runtime to let go, once it was asked
constexpr double kNanosecond = 1e-9;     // s

double secondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

const char* const kNoAnswer = "The headset's software did not answer; it was left all the same.";

Eye eyeOf(const XrView& view, double near, double far) {
  const HandPose pose = poseOf(view.pose);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = pose.orientation.normalized().toRotationMatrix();
  place.translation() = pose.position;
  const Matrix4 world = place.inverse().matrix();
  const XrFovf& fov = view.fov;
  return eyeThrough(world, std::tan(double(fov.angleLeft)), std::tan(double(fov.angleRight)),
                    std::tan(double(fov.angleDown)), std::tan(double(fov.angleUp)), near, far);
}

/// Extensions that are used where they are offered.
std::vector<std::string> wishes() {
  std::vector<std::string> names = extensionsOfControllers();
  names.insert(names.end(), {XR_MNDX_EGL_ENABLE_EXTENSION_NAME, Floor::kExtension, RefreshRate::kExtension,
                             DepthLayer::kExtension, VisibilityMask::kExtension, HandTracking::kExtension});
  return names;
}

/// Makes the context current for as long as it lives, and puts away what the stay has shared at its end.
class Current {
 public:
  explicit Current(const HeadsetSetup& setup) : m_setup(setup) { setup.makeCurrent(); }
  ~Current() {
    if (m_setup.mirror) m_setup.mirror->close();
    m_setup.release();
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  const HeadsetSetup& m_setup;
};

}  // namespace

/// What there is during a stay; made in this order, and put away in the other.
class Headset::Loop {
 public:
  Loop(Headset& told)
      : m_setup(told.m_setup),
        m_told(told),
        m_runtime(wishes()),
        m_session(m_runtime),
        m_rate(m_runtime, m_session.handle()),
        m_mask(m_runtime, m_session.handle()),
        m_hands(m_runtime, m_session),
        m_tracking(m_runtime, m_session),
        m_scene(m_setup.makeScene()) {
    const auto sizes = recommendedSizes(m_runtime);
    for (const size_t eye : {size_t{0}, size_t{1}}) m_pictures[eye].emplace(m_session, sizes[eye]);
    if (m_scene->hasDepth()) m_depth.emplace(m_runtime, m_session, sizes, m_setup.nearPlane, m_setup.farPlane);
  }

  Session& session() { return m_session; }
  void handleEvents() {
    m_session.handleEvents([this](const XrEventDataBuffer& event) {
      m_rate.notice(event);
      m_mask.notice(event);
    });
    m_told.m_hertz = m_rate.hertz();
    m_told.m_worn = m_session.focused() ? Worn::On : m_session.visible() ? Worn::BehindMenu : Worn::Off;
  }

  void frame() {
    const XrFrameState state = m_session.waitFrame();
    const steady_clock::time_point began = steady_clock::now();
    m_waited = 0;
    m_session.beginFrame();
    m_hands.sync();
    std::optional<std::array<XrView, 2>> views;
    if (state.shouldRender) views = m_session.locateEyes(state.predictedDisplayTime);
    if (!views) {
      m_session.endFrame(state.predictedDisplayTime, {});
      return;
    }
    m_clock.begin();
    prepare(state, *views);
    auto layer = structure<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
    std::array<XrCompositionLayerProjectionView, 2> shown;
    for (const size_t eye : {size_t{0}, size_t{1}}) shown[eye] = draw(eye, (*views)[eye]);
    m_clock.end();
    layer.space = m_session.floor();
    layer.viewCount = 2;
    layer.views = shown.data();
    const auto* header = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
    const double worked = secondsSince(began) - m_waited;
    m_session.endFrame(state.predictedDisplayTime, {&header, 1});
    if (m_setup.measured) m_setup.measured({worked, secondsSince(began), m_clock.took()});
    m_detail.note(std::max(worked, m_clock.took()), kNanosecond * double(state.predictedDisplayPeriod));
    m_told.m_detail = m_detail.scale();
  }

 private:
  void prepare(const XrFrameState& state, const std::array<XrView, 2>& views) {
    HeadsetFrame frame;
    const HandPose left = poseOf(views[0].pose), right = poseOf(views[1].pose);
    frame.head = {(left.position + right.position) / 2, left.orientation.slerp(0.5, right.orientation)};
    frame.time = kNanosecond * double(state.predictedDisplayTime);
    frame.period = kNanosecond * double(state.predictedDisplayPeriod);
    frame.focused = m_session.focused();
    for (const size_t hand : {kLeft, kRight}) frame.hands[hand] = input(hand, state.predictedDisplayTime);
    for (const size_t hand : {kLeft, kRight}) m_told.m_sees[hand] = frame.hands[hand].aim.has_value();
    const auto vibrations = m_scene->prepare(frame);
    for (const size_t hand : {kLeft, kRight})
      if (vibrations[hand]) m_hands.vibrate(hand, *vibrations[hand]);
  }

  HandInput input(size_t hand, XrTime time) const {
    HandInput input = m_hands.input(hand, time);
    const Hands::Holds holds = m_hands.holds(hand);
    if (holds == Hands::Holds::Controller || !m_session.focused()) return input;
    const auto seen = m_tracking.locate(hand, time);
    if (seen) useBareHand(input, hand, *seen, holds == Hands::Holds::BareHand);
    return input;
  }

  XrCompositionLayerProjectionView draw(size_t eye, const XrView& view) {
    EyePicture& picture = *m_pictures[eye];
    const steady_clock::time_point asked = steady_clock::now();
    RenderTarget target = picture.acquire(m_detail.scale());
    target.hidden = m_mask.hidden(eye);
    const bool hasDepth = m_depth && m_depth->isTaken();
    const RenderTarget depth = hasDepth ? m_depth->acquire(eye) : RenderTarget();
    m_waited += secondsSince(asked);
    const Eye seen = eyeOf(view, m_setup.nearPlane, m_setup.farPlane);
    m_scene->draw(eye, seen, target);
    if (hasDepth) {
      m_scene->drawDepth(eye, seen, depth);
      m_depth->release(eye);
    }
    if (eye == kLeft && m_setup.mirror) m_setup.mirror->offer(picture.texture(), target.size);
    picture.release();
    auto shown = structure<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
    shown.pose = view.pose;
    shown.fov = view.fov;
    shown.subImage = picture.shown();
    if (hasDepth) shown.next = m_depth->shown(eye);
    return shown;
  }

  const HeadsetSetup& m_setup;
  Headset& m_told;
  Runtime m_runtime;
  Session m_session;
  RefreshRate m_rate;
  VisibilityMask m_mask;
  Hands m_hands;
  HandTracking m_tracking;
  std::unique_ptr<HeadsetScene> m_scene;
  std::array<std::optional<EyePicture>, 2> m_pictures;
  std::optional<DepthLayer> m_depth;
  Detail m_detail;
  double m_waited = 0;  ///< s of this frame, for pictures that the runtime still had
  CardClock m_clock;
};

Headset::Headset(HeadsetSetup setup) : m_setup(std::move(setup)), m_thread([this] { run(); }) {}

Headset::~Headset() {
  leave();
  m_thread.join();
}

std::optional<Ending> Headset::ending() const {
  const std::lock_guard lock(m_mutex);
  return m_ending;
}

void Headset::run() {
  Ending ending;
  try {
    ending = stay();
  } catch (const std::exception& error) {
    ending = {true, error.what()};
  }
  const std::lock_guard lock(m_mutex);
  m_ending = std::move(ending);
}

Ending Headset::stay() {
  const Current current(m_setup);
  Loop loop(*this);
  Session& session = loop.session();
  std::optional<steady_clock::time_point> asked;
  for (;;) {
    loop.handleEvents();
    if (session.ending()) return *session.ending();
    if (m_leave && !session.running()) return {};
    if (m_leave && !asked) {
      asked = steady_clock::now();
      session.requestExit();
    } else if (asked && steady_clock::now() - *asked > kPatience) {
      return {true, kNoAnswer};
    }
    if (session.running()) {
      loop.frame();
      ++m_frames;
    } else {
      std::this_thread::sleep_for(kPause);
    }
  }
}

}  // namespace ps::vr
