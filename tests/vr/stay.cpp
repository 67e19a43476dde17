// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/stay.h"

#include <QDir>
#include <QTest>

namespace ps {

Stay stayInHeadset(HeadlessContext& context, const StayPlan& plan) {
  return stayInHeadset([&] { context.makeCurrent(); }, [&] { context.release(); }, plan);
}

Stay stayInHeadset(const std::function<void()>& makeCurrent, const std::function<void()>& release,
                   const StayPlan& plan) {
  constexpr int kPatience = 20'000;  // ms
  Stay stay;
  std::atomic<vr::Headset*> headset = nullptr;
  vr::HeadsetSetup setup;
  setup.makeCurrent = makeCurrent;
  setup.release = release;
  const PaintedScene::Before before = [&](size_t frame) {
    if (frame + 1 >= plan.leaveAfter && headset) headset.load()->leave();
    return plan.before(frame);
  };
  setup.makeScene = [&] { return std::make_unique<PaintedScene>(stay.record, before); };
  {
    vr::Headset own(setup);
    headset = &own;
    (void)QTest::qWaitFor([&] { return own.ending().has_value(); }, kPatience);
    stay.ending = own.ending();
    stay.frames = own.frames();
    stay.hertz = own.hertz();
  }
  return stay;
}

std::map<std::string, size_t> glObjects() {
  std::map<std::string, size_t> count;
  for (GLuint name = 1; name < 2000; ++name) {
    count["textures"] += size_t(glIsTexture(name));
    count["framebuffers"] += size_t(glIsFramebuffer(name));
    count["buffers"] += size_t(glIsBuffer(name));
    count["renderbuffers"] += size_t(glIsRenderbuffer(name));
    count["vertex arrays"] += size_t(glIsVertexArray(name));
    count["queries"] += size_t(glIsQuery(name));
    count["programs"] += size_t(glIsProgram(name));
    count["shaders"] += size_t(glIsShader(name));
  }
  return count;
}

size_t countGlObjects() {
  size_t all = 0;
  for (const auto& [kind, count] : glObjects()) all += count;
  return all;
}

size_t countThreads() {
  return static_cast<size_t>(QDir("/proc/self/task").entryList(QDir::Dirs | QDir::NoDotAndDotDot).size());
}

}  // namespace ps
