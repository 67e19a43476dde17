// SPDX-License-Identifier: Apache-2.0
// What a frame in a headset costs while the solver runs: both eyes, hands, panels, for the scripted runtime, without a
// display.
//
//   headset [PARTICLES [PIXELS [SECONDS]]]     80000 of water, 2000 along a side of an eye, 10 s of each kind
//
// The whole frame is from when xrWaitFrame() returns to when xrEndFrame() does; of it, what the scene prepares and what
// it hands to the graphics card; and what that takes, which it is asked for some frames later.
//
// At last what the card takes for each pass of a frame, both eyes together: there it is waited for, so that the frames
// themselves take longer than those before.
#include <epoxy/gl.h>

#include "core/experiments/benchscenes.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/enginethread.h"
#include "ui/vr/livescene.h"
#include "ui/vr/mirror.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace ps;

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

enum Part : size_t { kPreparing, kEyes, kDepths };

/// ms, of every frame.
struct Costs {
  std::vector<double> whole, prepare, draw, card;
  std::array<std::vector<double>, 3> parts;   ///< the card's, by Part
  std::vector<std::vector<PassTime>> passes;  ///< the card's too, where each is waited for
};

/// What the graphics card takes for parts of a frame, by the times at which it begins and ends them; asked for some
/// frames later, so that nobody waits.
class CardParts {
 public:
  explicit CardParts(Costs& costs) : m_costs(costs) {
    for (auto& frame : m_frames) glGenQueries(static_cast<GLsizei>(frame.stamps.size()), frame.stamps.data());
  }
  ~CardParts() {
    for (auto& frame : m_frames) glDeleteQueries(static_cast<GLsizei>(frame.stamps.size()), frame.stamps.data());
  }
  CardParts(const CardParts&) = delete;
  CardParts& operator=(const CardParts&) = delete;

  void nextFrame() {
    m_frame = (m_frame + 1) % m_frames.size();
    Frame& frame = m_frames[m_frame];
    std::array<double, 3> parts{};
    for (size_t i = 0; i < frame.used; ++i) parts[frame.part[i]] += span(frame.stamps[2 * i], frame.stamps[2 * i + 1]);
    for (size_t k = 0; k < parts.size() && frame.used > 0; ++k) m_costs.parts[k].push_back(parts[k]);
    frame.used = 0;
  }
  template <class Work>
  void time(Part part, const Work& work) {
    Frame& frame = m_frames[m_frame];
    frame.part[frame.used] = part;
    glQueryCounter(frame.stamps[2 * frame.used], GL_TIMESTAMP);
    work();
    glQueryCounter(frame.stamps[2 * frame.used++ + 1], GL_TIMESTAMP);
  }

 private:
  static constexpr size_t kSpans = 5;  // of a frame: once to prepare, twice for each eye
  struct Frame {
    std::array<GLuint, 2 * kSpans> stamps{};
    std::array<Part, kSpans> part{};
    size_t used = 0;
  };
  static double span(GLuint from, GLuint to) {
    GLuint64 first = 0, last = 0;
    glGetQueryObjectui64v(from, GL_QUERY_RESULT, &first);
    glGetQueryObjectui64v(to, GL_QUERY_RESULT, &last);
    return 1e-6 * static_cast<double>(last - first);
  }

  Costs& m_costs;
  std::array<Frame, 4> m_frames;
  size_t m_frame = 0;
};

/// The editor's scene, with a watch.
class WatchedScene : public vr::HeadsetScene {
 public:
  WatchedScene(std::shared_ptr<vr::HeadsetLink> link, bool depth, bool passes, Costs& costs)
      : m_scene(std::move(link)), m_depth(depth), m_costs(costs), m_card(costs) {
    if (passes) m_scene.timePasses(&m_passes);
  }
  std::array<std::optional<vr::Vibration>, 2> prepare(const vr::HeadsetFrame& frame) override {
    m_card.nextFrame();
    if (!m_passes.empty()) m_costs.passes.push_back(std::exchange(m_passes, {}));
    const Clock::time_point start = Clock::now();
    std::array<std::optional<vr::Vibration>, 2> felt;
    m_card.time(kPreparing, [&] { felt = m_scene.prepare(frame); });
    m_costs.prepare.push_back(millisecondsSince(start));
    m_costs.draw.push_back(0);
    return felt;
  }
  void draw(size_t eye, const Eye& view, const RenderTarget& target) override {
    const Clock::time_point start = Clock::now();
    m_card.time(kEyes, [&] { m_scene.draw(eye, view, target); });
    m_costs.draw.back() += millisecondsSince(start);
  }
  bool hasDepth() const override { return m_depth; }
  void drawDepth(size_t eye, const Eye& view, const RenderTarget& target) override {
    const Clock::time_point start = Clock::now();
    m_card.time(kDepths, [&] { m_scene.drawDepth(eye, view, target); });
    m_costs.draw.back() += millisecondsSince(start);
  }

 private:
  vr::LiveScene m_scene;
  bool m_depth;
  Costs& m_costs;
  CardParts m_card;
  std::vector<PassTime> m_passes;  ///< of the frame that goes on
};

struct Kind {
  const char* name;
  bool depth, mask, mirror, runs, panels = true, hands = true, passes = false;
};

/// A panel with something on it, as large as the interface's.
vr::PanelView panel(double width, double height) {
  auto image = std::make_shared<PanelImage>();
  image->width = static_cast<int>(width * 2400);
  image->height = static_cast<int>(height * 2400);
  image->pixels.assign(static_cast<size_t>(image->width * image->height) * 4, 120);
  vr::PanelView view;
  view.image = std::move(image);
  view.width = width;
  view.height = height;
  return view;
}

/// Walks about the scene, with both hands before it.
void writeScript(const std::filesystem::path& file, int pixels, const Kind& kind) {
  std::ofstream out(file);
  out << R"({"real_time": true, "refresh_rates": [90], "profile": "/interaction_profiles/oculus/touch_controller",
    "view": {"width": )"
      << pixels << R"(, "height": )" << pixels << R"(}, "hidden_corners": )" << (kind.mask ? 0.3 : 0)
      << R"(, "keys": [)";
  const char* active = kind.hands ? "true" : "false";
  for (int second = 0; second < 60; ++second)
    out << (second ? "," : "") << R"({"frame": )" << 90 * second << R"(, "head": [)" << 0.3 * (second % 2)
        << R"(, 1.5, 0.2, -0.25, 0, 0, 0.9682458], "right": {"grip": [0.2, )" << 1.1 + 0.1 * (second % 2)
        << R"(, -0.3], "active": )" << active
        << R"(}, "left": {"grip": [-0.2, 1.2, -0.3, 0, 0.5, 0, 0.8660254], "active": )" << active << "}}";
  out << "]}";
}

/// Who looks on, by a context and a thread of its own.
class Onlooker {
 public:
  Onlooker(const HeadlessContext& shared, std::shared_ptr<vr::Mirror> mirror)
      : m_context(&shared), m_mirror(std::move(mirror)) {
    m_context.release();
    m_thread = std::thread([this] { look(); });
  }
  ~Onlooker() {
    m_ends = true;
    m_thread.join();
  }
  Onlooker(const Onlooker&) = delete;
  Onlooker& operator=(const Onlooker&) = delete;

 private:
  void look() {
    constexpr PictureSize kWindow{1600, 900, false};
    m_context.makeCurrent();
    GLuint framebuffer = 0, picture = 0;
    glGenFramebuffers(1, &framebuffer);
    glGenTextures(1, &picture);
    glBindTexture(GL_TEXTURE_2D, picture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, kWindow.width, kWindow.height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
    while (!m_ends) {
      m_mirror->want();
      m_mirror->draw(framebuffer, kWindow, false);
      glFinish();
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &picture);
    m_context.release();
  }

  HeadlessContext m_context;
  std::shared_ptr<vr::Mirror> m_mirror;
  std::atomic<bool> m_ends = false;
  std::thread m_thread;
};

/// A scene that runs, and what of it the headset is shown.
class Editor {
 public:
  explicit Editor(int particles) : m_project(tank(particles)), m_engine(m_plugins, [this] { published(); }) {
    m_palette = panel(0.30, 0.27);
    m_board = panel(0.50, 0.40);
    m_engine.open(m_project, true);
  }
  std::shared_ptr<vr::HeadsetLink> link() const { return m_link; }
  bool ready() const { return m_link->shown() != nullptr; }
  void play(bool runs) { runs ? m_engine.play() : m_engine.pause(); }
  void showPanels(bool shown) {
    m_showsPanels = shown;
    auto view = std::make_shared<vr::HeadsetView>(*m_link->shown());
    setPanels(*view);
    m_link->show(view);
  }
  double speed() const { return m_engine.realTimeFactor(); }
  double frame() const { return m_engine.snapshot() ? m_engine.snapshot()->stats.totalMilliseconds : 0; }
  size_t particles() const { return m_engine.snapshot()->position.size(); }

 private:
  void published() {
    const SnapshotPtr matter = m_engine.snapshot();
    if (!matter || matter->position.empty()) return;
    auto view = std::make_shared<vr::HeadsetView>();
    view->matter = matter;
    view->goesOn = m_engine.previousSnapshot() != nullptr;
    view->scene.environment = m_project.environment;
    view->picture = ++m_picture;
    view->project = 1;
    view->box = boxOf(*matter, view->scene.environment);
    view->brushes[vr::kRight] = {{0.05, 0.05, 0.05}, false, {0.3f, 0.6f, 1}};
    setPanels(*view);
    m_link->show(view);
    (void)m_link->takeHands();
  }

  void setPanels(vr::HeadsetView& view) const {
    view.panels[vr::kPalette] = m_showsPanels ? m_palette : vr::PanelView{};
    view.panels[vr::kBoard] = m_showsPanels ? m_board : vr::PanelView{};
    view.brought[0] = 1;
  }

  PluginRegistry m_plugins;
  Project m_project;
  vr::PanelView m_palette, m_board;
  std::shared_ptr<vr::HeadsetLink> m_link = std::make_shared<vr::HeadsetLink>();
  std::atomic<uint64_t> m_picture = 0;
  std::atomic<bool> m_showsPanels = true;
  EngineThread m_engine;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

Costs stay(const HeadlessContext& shared, Editor& editor, const Kind& kind, double seconds) {
  Costs costs;
  HeadlessContext own(&shared);
  own.release();
  editor.play(kind.runs);
  vr::HeadsetSetup setup;
  setup.makeCurrent = [&] { own.makeCurrent(); };
  setup.release = [&] { own.release(); };
  setup.makeScene = [&] { return std::make_unique<WatchedScene>(editor.link(), kind.depth, kind.passes, costs); };
  setup.mirror = std::make_shared<vr::Mirror>();
  setup.measured = [&](const vr::FrameCost& cost) {
    costs.whole.push_back(1e3 * cost.whole);
    costs.card.push_back(1e3 * cost.card);
  };
  std::optional<Onlooker> onlooker;
  if (kind.mirror) onlooker.emplace(shared, setup.mirror);
  {
    vr::Headset headset(setup);
    const Clock::time_point start = Clock::now();
    while (!headset.ending() && millisecondsSince(start) < 1e3 * seconds)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (headset.detail() < 1) std::printf("pictures at %.0f %%\n", 100 * headset.detail());
    if (headset.ending()) std::fprintf(stderr, "%s\n", headset.ending()->sentence.c_str());
  }
  return costs;
}

constexpr size_t kFirst = 60;  // frames, in which programs and pictures are made

/// What the card takes for each pass of a frame, ms; 0 in frames that had it not.
void printPasses(const std::vector<std::vector<PassTime>>& frames) {
  std::vector<std::pair<std::string, std::vector<double>>> passes;
  for (size_t frame = std::min(kFirst, frames.size()); frame < frames.size(); ++frame)
    for (const PassTime& time : frames[frame]) {
      const auto is = [&](const auto& pass) { return pass.first == time.pass; };
      auto found = std::find_if(passes.begin(), passes.end(), is);
      if (found == passes.end()) {
        passes.emplace_back(time.pass, std::vector<double>(frames.size() - kFirst));
        found = std::prev(passes.end());
      }
      found->second[frame - kFirst] = time.milliseconds;
    }
  for (const auto& [name, times] : passes)
    std::printf("  %-24s  %7.3f %7.3f %7.3f\n", name.c_str(), quantile(times, 0.5), quantile(times, 0.95),
                quantile(times, 0.99));
}

void print(const Kind& kind, Costs costs, const Editor& editor) {
  const auto late = [](const std::vector<double>& times) {
    return std::count_if(times.begin(), times.end(), [](double ms) { return ms > 1000.0 / 90; });
  };
  for (auto* times : {&costs.whole, &costs.prepare, &costs.draw, &costs.card})
    times->erase(times->begin(), times->begin() + static_cast<ptrdiff_t>(std::min(kFirst, times->size())));
  std::printf("%-24s %6zu %5td", kind.name, costs.whole.size(), late(costs.whole));
  for (const auto* times : {&costs.whole, &costs.prepare, &costs.draw, &costs.card})
    std::printf("  %6.2f %6.2f %6.2f", quantile(*times, 0.5), quantile(*times, 0.95), quantile(*times, 0.99));
  for (auto& part : costs.parts) std::printf(" %6.2f", quantile(part, 0.5));
  std::printf("  %6.2f ms, x %.2f\n", editor.frame(), editor.speed());
  printPasses(costs.passes);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  const int particles = count > 1 ? std::atoi(words[1]) : 80000, pixels = count > 2 ? std::atoi(words[2]) : 2000;
  const double seconds = count > 3 ? std::atof(words[3]) : 10;
  if (particles < 100 || pixels < 16 || seconds <= 0) {
    std::fprintf(stderr, "headset [PARTICLES [PIXELS [SECONDS]]]\n");
    return 2;
  }
  try {
    const auto script = std::filesystem::temp_directory_path() / "phasesketch-bench-headset.json";
    setenv("XR_RUNTIME_JSON", PS_BINARY_DIR "/tests/vr/runtime/runtime.json", 0);
    setenv("PS_XR_SCRIPT", script.c_str(), 1);
    HeadlessContext context;
    Editor editor(particles);
    while (!editor.ready()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::printf("%s\n%zu particles, 2 x %d x %d pixels; ms: median, 95 %%, 99 %%\n", context.description().c_str(),
                editor.particles(), pixels, pixels);
    std::printf("%-24s %6s %5s  %-20s  %-20s  %-20s  %-20s %-20s  %s\n", "", "frames", "late", "whole frame", "prepare",
                "draw", "card", "prepare, eyes, depth", "the solver's frame");
    for (const Kind& kind :
         {Kind{"all", true, true, true, true}, Kind{"without depths", false, true, true, true},
          Kind{"without a mirror", true, true, false, true}, Kind{"without a mask", true, false, true, true},
          Kind{"paused", true, true, true, false}, Kind{"paused, no mask", true, false, true, false},
          Kind{"paused, no panels", true, true, true, false, false},
          Kind{"paused, no hands", true, true, true, false, false, false},
          Kind{"all, pass by pass", true, true, true, true, true, true, true}}) {
      editor.showPanels(kind.panels);
      writeScript(script, pixels, kind);
      print(kind, stay(context, editor, kind, seconds), editor);
    }
    std::filesystem::remove(script);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
