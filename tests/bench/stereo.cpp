// SPDX-License-Identifier: Apache-2.0
// What a second eye costs: milliseconds to prepare matter and to draw it for one eye and for two, without a display.
//
//   stereo [PARTICLES [WIDTH HEIGHT [FRAMES [drawn|computed]]]]
//
// Without them 100000 particles, 1280 x 720 pixels, 60 frames, and pixels worked out as suits the card.
//
// Below each: what the card took for each pass of a frame, both eyes together.
// With as many particles of another run as a ghost over it, too.
// Each stage is waited for, so that it has its own time; the head moves from frame to frame, so that nothing of one
// serves the next.
#include <epoxy/gl.h>

#include "tests/ui/renderscenes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace ps;
using namespace ps::testing;

namespace {

/// A pool twice as wide as high, or a block, or both with vapour over them, in a tray of 0.8 m.
Snapshot matter(size_t particles, const char* kind) {
  Snapshot s;
  s.materialLook = {{0.75f, 0.87f, 0.98f, 1}};
  const bool mixed = kind[0] == 'm', pool = kind[0] == 'l';
  const double spacing = std::cbrt(0.7 * 0.7 * 0.35 / static_cast<double>(particles));
  const int wide = static_cast<int>(0.7 / spacing);
  for (size_t i = 0; i < particles; ++i) {
    const auto n = static_cast<int>(i);
    const Vector3 p{(n % wide + 0.5) * spacing - 0.35, (n / (wide * wide) + 0.5) * spacing,
                    (n / wide % wide + 0.5) * spacing - 0.35};
    const api::Motion motion = pool || (mixed && p.x() < 0)          ? api::Motion::Liquid
                               : mixed && p.y() > 0.32 && n % 7 == 0 ? api::Motion::Gas
                                                                     : api::Motion::Solid;
    addParticle(s, p, 0.62 * spacing, static_cast<uint32_t>(i), motion, 270 + 100 * p.y());
  }
  return s;
}

double median(std::vector<double>& times) {
  std::nth_element(times.begin(), times.begin() + static_cast<ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

/// What passes between laps, ms: on the processor with the wait for the card, and what the card itself took.
class Clock {
 public:
  Clock() {
    glGenQueries(1, &m_query);
    glBeginQuery(GL_TIME_ELAPSED, m_query);
  }
  ~Clock() {
    glEndQuery(GL_TIME_ELAPSED);
    glDeleteQueries(1, &m_query);
  }
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  double lap() {
    glEndQuery(GL_TIME_ELAPSED);
    glFinish();
    const auto now = std::chrono::steady_clock::now();
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(m_query, GL_QUERY_RESULT, &nanoseconds);
    card += static_cast<double>(nanoseconds) * 1e-6;
    const double ms = std::chrono::duration<double, std::milli>(now - m_last).count();
    glBeginQuery(GL_TIME_ELAPSED, m_query);
    m_last = std::chrono::steady_clock::now();
    return ms;
  }
  double card = 0;  ///< of all laps

 private:
  GLuint m_query = 0;
  std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

/// What the card takes for each pass of a frame with both eyes, ms.
void printPasses(const std::vector<PassTime>& times, int frames) {
  for (const PassTime& time : times)
    if (time.milliseconds / frames > 0.005)
      std::printf("  %-20s %8.3f\n", time.pass.c_str(), time.milliseconds / frames);
}

void measure(const char* kind, bool ghost, size_t particles, const PictureSize& size, int frames, PixelWork work) {
  Snapshot before = matter(particles, kind), now = before;
  for (api::Float4& p : now.position) p.y += 0.002f;
  Look look;
  if (ghost) {
    auto other = std::make_shared<Snapshot>(now);
    for (api::Float4& p : other->position) p.y += 0.05f;
    look.ghost = Ghost{other, {1, 0, 1}, {1, 1, 1}, 1.5f};
  }
  const RenderScene scene = tray();
  GLuint framebuffer = 0, picture = 0;
  glGenFramebuffers(1, &framebuffer);
  glGenTextures(1, &picture);
  glBindTexture(GL_TEXTURE_2D, picture);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, 2 * size.width, size.height);  // as headsets have it
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
  Renderer renderer(work);
  Camera camera{{0, 0.2, 0}, 1.6, 35, 25, 35};
  std::vector<double> prepare, first, second, card;
  for (int frame = -5; frame < frames; ++frame) {
    camera.azimuth += 0.3;
    std::array<Eye, 2> eyes{eyeOf(camera, size.width, size.height), eyeOf(camera, size.width, size.height)};
    for (const size_t i : {0u, 1u}) {
      eyes[i].view(0, 3) += i ? -0.032 : 0.032;
      eyes[i].projection(0, 2) = i ? 0.08 : -0.08;  // windows of a headset reach farther out than in
    }
    Clock clock;
    renderer.prepare(now, &before, 0.5, scene, look);
    const double prepared = clock.lap();
    renderer.draw(eyes[0], {framebuffer, 0, 0, size, picture});
    const double one = clock.lap();
    renderer.draw(eyes[1], {framebuffer, size.width, 0, size, picture});
    const double two = clock.lap();
    if (frame < 0) continue;
    prepare.push_back(prepared);
    first.push_back(one);
    second.push_back(two);
    card.push_back(clock.card);
  }
  // Once more, since asking for the time of each pass takes some itself.
  std::vector<PassTime> times;
  renderer.timePasses(&times);
  const std::array<Eye, 2> eyes{eyeOf(camera, size.width, size.height), eyeOf(camera, size.width, size.height)};
  for (int frame = 0; frame < frames; ++frame) {
    renderer.prepare(now, &before, 0.5, scene, look);
    for (const int i : {0, 1})
      renderer.draw(eyes[static_cast<size_t>(i)], {framebuffer, i * size.width, 0, size, picture});
  }
  const double a = median(prepare), b = median(first), c = median(second);
  std::printf("%-7s %-5s %8zu %5dx%-5d %8.2f %8.2f %8.2f %8.1f %% %8.2f\n", kind, ghost ? "yes" : "no", particles,
              size.width, size.height, a, b, c, 100 * c / (a + b), median(card));
  printPasses(times, frames);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &picture);
}

}  // namespace

int main(int count, char** words) {
  const auto number = [&](int i, int otherwise) { return count > i ? std::atoi(words[i]) : otherwise; };
  const int particles = number(1, 100000), frames = number(4, 60);
  const PictureSize size{number(2, 1280), number(3, 720), false};
  if (particles < 1 || size.width < 1 || size.height < 1 || frames < 1) {
    std::fprintf(stderr, "stereo [PARTICLES [WIDTH HEIGHT [FRAMES [drawn|computed]]]]\n");
    return 2;
  }
  const std::string how = count > 5 ? words[5] : "";
  const PixelWork work = how == "drawn"      ? PixelWork::Drawn
                         : how == "computed" ? PixelWork::Computed
                                             : PixelWork::AsSuitsTheCard;
  try {
    HeadlessContext context;
    std::printf("%s\n", context.description().c_str());
    std::printf("%-7s %-5s %8s %11s %8s %8s %8s %10s %8s\n", "matter", "ghost", "particles", "an eye", "prepare",
                "first", "second", "of a view", "card");
    for (const char* kind : {"solid", "liquid", "mixed"}) {
      for (const bool ghost : {false, true}) measure(kind, ghost, static_cast<size_t>(particles), size, frames, work);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
