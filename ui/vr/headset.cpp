// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/headset.h"

#include "ui/vr/cardclock.h"
#include "ui/vr/depthlayer.h"
#include "ui/vr/detail.h"
#include "ui/vr/eyepicture.h"
#include "ui/vr/floor.h"
#include "ui/vr/graphics.h"
#include "ui/vr/hands.h"
#include "ui/vr/handtracking.h"
#include "ui/vr/mirror.h"
#include "ui/vr/refreshrate.h"
#include "ui/vr/suggestions.h"
#include "ui/vr/visibilitymask.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <span>
#include <utility>

namespace ps::vr {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kPause{5};        // between looks at a headset that lies on the table
constexpr milliseconds kPatience{2000};  // for the runtime to let go, once it was asked
// For a call into the runtime to come back, of which xrWaitFrame() may take a second where a headset is not seen; and
// from when it was asked to leave until it is left in there.
constexpr milliseconds kHung{3000}, kGrace{1000};
constexpr double kNanosecond = 1e-9;             // s
constexpr double kPulled = 0.1, kGripped = 0.3;  // of a trigger's and a grip's way

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

/// What the thread and who has made it share. It outlives whoever lets go of it first.
struct Headset::Stay {
  explicit Stay(HeadsetSetup own) : setup(std::move(own)) {}
  void run();
  Ending last();
  /// Throws Error where it was abandoned in the runtime: then there is nobody to show anything to.
  void requireOwner() const;
  class Asking;
  /// A call into the runtime, which has the thread meanwhile. Throws what that does, and as requireOwner().
  void ask(const auto& call);
  /// With the mutex.
  bool hangs() const { return waits && steady_clock::now() - *waits > kHung; }
  bool overdue() const { return hangs() && asked && steady_clock::now() - *asked > kGrace; }

  const HeadsetSetup setup;
  const void* context = nullptr;  ///< that the stay draws with
  std::atomic<bool> leave = false;
  std::atomic<uint64_t> frames = 0;
  std::atomic<double> detail = 1, hertz = 0;
  std::atomic<int> coarser = 0;
  std::atomic<Worn> worn = Worn::Off;
  std::array<std::atomic<bool>, 2> sees{};

  mutable std::mutex mutex;  ///< of what follows
  std::condition_variable changed;
  std::optional<Ending> ending;
  std::optional<steady_clock::time_point> waits, asked;  ///< in the runtime, and to leave, since when
  bool abandoned = false;                                ///< nobody waits for the thread any more
};

/// While it lives the runtime has the thread, which it may keep for good.
class Headset::Stay::Asking {
 public:
  explicit Asking(Stay& stay) : m_stay(stay) { note(steady_clock::now()); }
  ~Asking() { note({}); }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

 private:
  void note(std::optional<steady_clock::time_point> since) {
    const std::lock_guard lock(m_stay.mutex);
    m_stay.waits = since;
  }
  Stay& m_stay;
};

void Headset::Stay::ask(const auto& call) {
  {
    const Asking asking(*this);
    call();
  }
  requireOwner();
  // Runtimes that draw with the program's own thread may leave a context of theirs, or none.
  if (context && currentContext() != context) setup.makeCurrent();
}

/// What there is during a stay; made in this order, and put away in the other.
class Headset::Loop {
 public:
  explicit Loop(Stay& told)
      : m_setup(told.setup),
        m_told(told),
        m_asking(std::in_place, told),
        m_runtime(wishes()),
        m_session(m_runtime),
        m_rate(m_runtime, m_session.handle()),
        m_mask(m_runtime, m_session.handle()),
        m_hands(m_runtime, m_session),
        m_tracking(m_runtime, m_session) {
    m_asking.reset();
  }
  ~Loop() { m_asking.emplace(m_told); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// Makes what shows something. Not in the constructor, so that ~Loop() watches the runtime where this fails, too.
  void begin() {
    m_told.requireOwner();
    m_scene = m_setup.makeScene();
    m_told.ask([&] {
      const auto sizes = recommendedSizes(m_runtime);
      for (const size_t eye : {size_t{0}, size_t{1}}) m_pictures[eye].emplace(m_session, sizes[eye]);
      if (m_scene->hasDepth()) m_depth.emplace(m_runtime, m_session, sizes, m_setup.nearPlane, m_setup.farPlane);
    });
  }

  Session& session() { return m_session; }
  void handleEvents() {
    m_told.ask([&] {
      m_session.handleEvents([this](const XrEventDataBuffer& event) {
        m_rate.notice(event);
        m_mask.notice(event);
      });
    });
    m_told.hertz = m_rate.hertz();
    m_told.worn = m_session.focused() ? Worn::On : m_session.visible() ? Worn::BehindMenu : Worn::Off;
  }

  void frame() {
    XrFrameState state;
    steady_clock::time_point began;
    m_waited = 0;
    std::optional<std::array<XrView, 2>> views;
    m_told.ask([&] {
      state = m_session.waitFrame();
      began = steady_clock::now();
      m_session.beginFrame();
      m_hands.sync();
      if (state.shouldRender) views = m_session.locateEyes(state.predictedDisplayTime);
    });
    if (!views) return submit(state.predictedDisplayTime, {});
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
    submit(state.predictedDisplayTime, {&header, 1});
    if (m_setup.measured) m_setup.measured({worked, secondsSince(began), m_clock.took()});
    m_detail.note(std::max(worked, m_clock.took()), kNanosecond * double(state.predictedDisplayPeriod));
    m_told.detail = m_detail.scale();
    m_told.coarser = m_detail.coarser();
  }

 private:
  void submit(XrTime time, std::span<const XrCompositionLayerBaseHeader* const> layers) {
    m_told.ask([&] { m_session.endFrame(time, layers); });
  }

  void prepare(const XrFrameState& state, const std::array<XrView, 2>& views) {
    HeadsetFrame frame;
    const HandPose left = poseOf(views[0].pose), right = poseOf(views[1].pose);
    frame.head = {(left.position + right.position) / 2, left.orientation.slerp(0.5, right.orientation)};
    frame.time = kNanosecond * double(state.predictedDisplayTime);
    frame.period = kNanosecond * double(state.predictedDisplayPeriod);
    frame.focused = m_session.focused();
    m_told.ask([&] {
      for (const size_t hand : {kLeft, kRight}) frame.hands[hand] = input(hand, state.predictedDisplayTime);
    });
    for (const size_t hand : {kLeft, kRight}) m_told.sees[hand] = frame.hands[hand].aim.has_value();
    frame.recentred = m_session.recentred(state.predictedDisplayTime);
    for (const size_t hand : {kLeft, kRight}) letGo(frame.hands[hand], m_waits[hand], frame.recentred);
    const auto vibrations = m_scene->prepare(frame);
    m_told.ask([&] {
      for (const size_t hand : {kLeft, kRight})
        if (vibrations[hand]) m_hands.vibrate(hand, *vibrations[hand]);
    });
  }

  HandInput input(size_t hand, XrTime time) const {
    HandInput input = m_hands.input(hand, time);
    const Hands::Holds holds = m_hands.holds(hand);
    if (holds == Hands::Holds::Controller || !m_session.focused()) return input;
    const auto seen = m_tracking.locate(hand, time);
    if (seen) useBareHand(input, hand, *seen, holds == Hands::Holds::BareHand);
    return input;
  }

  /// Once the room is another: what a hand draws, leads or carries would go across it, and what its trigger and grip
  /// are pressed for was meant elsewhere. It acts again when both were let go.
  static void letGo(HandInput& input, bool& waits, bool recentred) {
    waits = (waits || recentred) && (input.draw > kPulled || input.hold > kGripped);
    if (recentred) input.grip = input.aim = std::nullopt, input.joints.reset();
    if (waits || recentred) input.draw = input.hold = 0;
  }

  XrCompositionLayerProjectionView draw(size_t eye, const XrView& view) {
    EyePicture& picture = *m_pictures[eye];
    const steady_clock::time_point asked = steady_clock::now();
    const bool hasDepth = m_depth && m_depth->isTaken();
    m_told.ask([&] {
      picture.acquire();
      if (hasDepth) m_depth->acquire(eye);
    });
    m_waited += secondsSince(asked);
    RenderTarget target = picture.target(m_detail.scale());
    target.coarser = m_detail.coarser();
    target.hidden = m_mask.hidden(eye);
    const Eye seen = eyeOf(view, m_setup.nearPlane, m_setup.farPlane);
    m_scene->draw(eye, seen, target);
    if (hasDepth) m_scene->drawDepth(eye, seen, m_depth->target(eye));
    if (eye == kLeft && m_setup.mirror) m_setup.mirror->offer(picture.texture(), target.size);
    m_told.ask([&] {
      if (hasDepth) m_depth->release(eye);
      picture.release();
    });
    auto shown = structure<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
    shown.pose = view.pose;
    shown.fov = view.fov;
    shown.subImage = picture.shown();
    if (hasDepth) shown.next = m_depth->shown(eye);
    return shown;
  }

  const HeadsetSetup& m_setup;
  Stay& m_told;
  std::optional<Stay::Asking> m_asking;  ///< while what follows is made, and while it is put away
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
  std::array<bool, 2> m_waits{};  ///< hands, to let go of their triggers and grips
  double m_waited = 0;            ///< s of this frame, for pictures that the runtime still had
  CardClock m_clock;
};

Headset::Headset(HeadsetSetup setup)
    : m_stay(std::make_shared<Stay>(std::move(setup))), m_thread([stay = m_stay] { stay->run(); }) {}

Headset::~Headset() {
  leave();
  std::unique_lock lock(m_stay->mutex);
  while (!m_stay->ending && !m_stay->overdue()) m_stay->changed.wait_for(lock, kPause);
  m_stay->abandoned = !m_stay->ending;
  lock.unlock();
  m_stay->abandoned ? m_thread.detach() : m_thread.join();
}

void Headset::leave() {
  const std::lock_guard lock(m_stay->mutex);
  if (!m_stay->asked) m_stay->asked = steady_clock::now();
  m_stay->leave = true;
}

std::optional<Ending> Headset::ending() const {
  const std::lock_guard lock(m_stay->mutex);
  return !m_stay->ending && m_stay->overdue() ? Ending{true, kNoAnswer} : m_stay->ending;
}

bool Headset::answers() const {
  const std::lock_guard lock(m_stay->mutex);
  return !m_stay->hangs();
}

uint64_t Headset::frames() const { return m_stay->frames; }
double Headset::detail() const { return m_stay->detail; }
int Headset::coarser() const { return m_stay->coarser; }
double Headset::hertz() const { return m_stay->hertz; }
Headset::Worn Headset::worn() const { return m_stay->worn; }
bool Headset::sees(size_t hand) const { return m_stay->sees.at(hand); }

void Headset::Stay::run() {
  Ending how;
  try {
    how = last();
  } catch (const std::exception& error) {
    how = {true, error.what()};
  }
  const std::lock_guard lock(mutex);
  ending = std::move(how);
  changed.notify_all();
}

void Headset::Stay::requireOwner() const {
  const std::lock_guard lock(mutex);
  if (abandoned) throw Error(kNoAnswer);
}

Ending Headset::Stay::last() {
  const Current current(setup);
  context = currentContext();
  Loop loop(*this);
  loop.begin();
  Session& session = loop.session();
  std::optional<steady_clock::time_point> requested;
  for (;;) {
    loop.handleEvents();
    if (session.ending()) return *session.ending();
    if (leave && !session.running()) return {};
    if (leave && !requested) {
      requested = steady_clock::now();
      ask([&] { session.requestExit(); });
    } else if (requested && steady_clock::now() - *requested > kPatience) {
      return {true, kNoAnswer};
    }
    if (session.running()) {
      loop.frame();
      ++frames;
    } else {
      std::this_thread::sleep_for(kPause);
    }
  }
}

}  // namespace ps::vr
