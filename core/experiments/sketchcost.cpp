// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/sketchcost.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/scene/coat.h"
#include "core/scene/pose.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/simulation/hand.h"
#include "core/simulation/standing.h"
#include "core/sketch/cellset.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>

namespace ps {
namespace {

constexpr int kRadius = 4;                             // cells
constexpr size_t kPlaces = 4;                          // of a hand in a frame
constexpr long kWay = 24;                              // samples, after which a stroke begins anew
constexpr double kSampleLimit = 2, kContactLimit = 1;  // ms

/// Cells of the ball about one that is not in the ball about the one before it along x; all of the first.
std::vector<std::array<int, 3>> ballAt(const api::Cell& middle, bool isFirst) {
  const auto holds = [](int x, int y, int z) { return x * x + y * y + z * z <= kRadius * kRadius; };
  std::vector<std::array<int, 3>> cells;
  for (int z = -kRadius; z <= kRadius; ++z)
    for (int y = -kRadius; y <= kRadius; ++y)
      for (int x = -kRadius; x <= kRadius; ++x)
        if (holds(x, y, z) && (isFirst || !holds(x + 1, y, z)))
          cells.push_back({middle.x + x, middle.y + y, middle.z + z});
  return cells;
}

class Measure {
 public:
  Measure(const Project& project, PluginRegistry& plugins, long samples)
      : m_samples(samples), m_engine(project, plugins) {
    for (int frame = 0; frame < 5; ++frame) m_engine.step();
    m_cost.particles = m_engine.particles().size();
    if (m_cost.particles == 0) throw InputError("The scene has no particles to sketch among");
    m_spacing = m_engine.snapshot()->spacing;
    for (size_t i = 0; i < m_cost.particles; ++i) {
      const Vector3 place = vectorOf(m_engine.particles().position()[i]);
      m_low = i == 0 ? place : Vector3(m_low.cwiseMin(place));
      m_high = i == 0 ? place : Vector3(m_high.cwiseMax(place));
    }
  }

  /// Held in place, where a hand is to find it again.
  void draw(const std::string& what, const Vector3& from, double temperature, const std::string& constraint,
            bool held = false) {
    Body body;
    body.id = body.name = what;
    body.material = "water";
    body.parameters.values["temperature"] = temperature;
    body.parameters.values["held"] = held;
    if (!constraint.empty()) body.constraints.push_back({constraint, {}, {}});
    VoxelShape shape = lattice();
    shape.palette.push_back({"water", temperature, {}});
    body.shape = shape;
    const auto made = std::make_shared<const Body>(body);
    stroke("draws " + what, from, [&](auto cells) { return AddCells{made, std::move(cells), 0, ++m_key}; });
    m_drawn = made;
  }
  /// With the body that was drawn last, wherever it is by now: each stroke finds out anew how it stands.
  void goOn() {
    Body loose = *m_drawn;
    loose.parameters.values["held"] = false;
    m_drawn = std::make_shared<const Body>(std::move(loose));
    m_engine.apply(SetParameter{{Owner::Body, m_drawn->id, "held"}, false});
    for (int frame = 0; frame < 10; ++frame) m_engine.step();
    EditTimes times{"draws on a body that has moved", kSampleLimit, {}};
    RigidMove stands;
    api::Cell middle{};
    for (long k = 0; k < m_samples; ++k) {
      times.milliseconds.push_back(millisecondsOf([&] {
        if (k % kWay == 0) stands = frameOf(*m_drawn, middle);
        const api::Cell at{middle.x + static_cast<int>(k % kWay), middle.y, middle.z};
        m_engine.apply(AddCells{m_drawn, ballAt(at, k % kWay == 0), 0, ++m_key, stands});
      }));
      m_engine.step();
    }
    m_cost.edits.push_back(std::move(times));
  }
  void erase() {
    stroke("erases", inside(), [&](auto cells) { return TakeCells{lattice(), std::move(cells), {}, ++m_key}; });
  }
  void paint(const std::string& what, const std::string& coat) {
    stroke(what, inside(), [&](auto cells) { return PaintCells{lattice(), std::move(cells), coat, {}, ++m_key}; });
  }
  void touch(const std::string& what, const api::Touch& touch, const Vector3& from) {
    EditTimes times{what, kContactLimit, {}};
    Hand hand;
    size_t ties = 0;
    for (long k = 0; k < m_samples; ++k) {
      std::vector<api::Touch> path(kPlaces, touch);
      for (size_t place = 0; place < kPlaces; ++place) {
        const auto gone = static_cast<double>(static_cast<size_t>(k % kWay) * kPlaces + place) / kPlaces;
        path[place].centre = double3Of(from + Vector3(gone * m_spacing, 0, 0));
        path[place].radius = kRadius * m_spacing;
      }
      const bool holds = touch.kind == api::TouchKind::Hold;
      const std::vector<api::Touch> still{path.back()};
      times.milliseconds.push_back(millisecondsOf([&] {
        hand.move({holds ? std::vector<api::Touch>{} : path, kPlaces, still, {}, 1});
        ties += hand.act(m_engine).ties.size();
      }));
      m_engine.step();
    }
    const bool tied = touch.kind == api::TouchKind::Cut || touch.kind == api::TouchKind::Weld;
    if (tied && ties == 0) throw InputError("The hand that " + what + " found no ties to measure it by");
    m_cost.edits.push_back(std::move(times));
  }
  Vector3 inside() const {
    return {m_low.x() + 8 * m_spacing, (m_low.y() + m_high.y()) / 2, (m_low.z() + m_high.z()) / 2};
  }
  /// Over the matter, in the place of the n-th stroke: where one still is, the next one would draw nothing.
  Vector3 above(int strokes) const {
    return inside() + Vector3(0, m_high.y() - inside().y() + strokes * (2 * kRadius + 2) * m_spacing, 0);
  }
  SketchCost result() { return std::move(m_cost); }

 private:
  /// Of a body by the matter about its middle, and the cell above it there.
  RigidMove frameOf(const Body& body, api::Cell& above) const {
    const SnapshotPtr now = m_engine.snapshot();
    const auto index =
        static_cast<uint32_t>(std::find(now->bodyIds->begin(), now->bodyIds->end(), body.id) - now->bodyIds->begin());
    Vector3 sum = Vector3::Zero();
    double count = 0;
    for (size_t i = 0; i < now->body.size(); ++i) {
      if (now->body[i] == index) sum += vectorOf(now->position[i]), ++count;
    }
    const auto stands = standingNear(*now, index, {}, sum / std::max(count, 1.0), 2 * kRadius * m_spacing);
    if (!stands) throw InputError("The body '" + body.id + "' has moved, and nothing of it is as it was drawn");
    SketchGrid grid = gridOf(std::get<VoxelShape>(body.shape));
    grid.pose = *stands;
    above = grid.cellAt(sum / count);
    above.y += 2 * kRadius;
    return *stands;
  }
  template <class Work>
  static double millisecondsOf(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  VoxelShape lattice() const {
    VoxelShape shape;
    shape.spacing = m_spacing;
    shape.origin = Vector3::Constant(m_spacing / 2);
    return shape;
  }
  /// Each stroke begins beside the one before it.
  void stroke(const std::string& what, const Vector3& from, const std::function<Command(CellIndices)>& command) {
    EditTimes times{what, kSampleLimit, {}};
    for (long k = 0; k < m_samples; ++k) {
      const Vector3 aside(0, 0, static_cast<double>(k / kWay % 3) * (2 * kRadius + 1) * m_spacing);
      const Vector3 place = from + aside + Vector3(static_cast<double>(k % kWay) * m_spacing, 0, 0);
      const Command edit = command(ballAt(gridOf(lattice()).cellAt(place), k % kWay == 0));
      times.milliseconds.push_back(millisecondsOf([&] { m_engine.apply(edit); }));
      m_engine.step();
    }
    m_cost.edits.push_back(std::move(times));
  }

  const long m_samples;
  Engine m_engine;
  SketchCost m_cost;
  double m_spacing = 0;                     ///< m
  Vector3 m_low{0, 0, 0}, m_high{0, 0, 0};  ///< m, of the matter
  MatterKey m_key = 1;
  std::shared_ptr<const Body> m_drawn;
};

api::Touch touchOf(api::TouchKind kind) {
  api::Touch touch;
  touch.kind = kind;
  touch.falloff = 0.5;
  touch.power = 1000;
  touch.limit = 350;
  touch.force = 50;
  touch.velocity = {1, 0, 0};
  if (kind == api::TouchKind::Cut) touch.normal = {0, 1, 0};
  return touch;
}

}  // namespace

SketchCost measureSketch(const Project& project, PluginRegistry& plugins, long samples) {
  Project scene = project;
  if (scene.solver.thermalModel.empty()) scene.solver.thermalModel = plugins.standard(PluginKind::Thermal);
  const std::string frozen = frozenStructure(plugins);
  if (scene.solver.thermalModel.empty() || frozen.empty())
    throw InputError("A thermal model and a structure that holds frozen matter are needed to measure what hands cost");
  SceneMaterial other = scene.materials.front();
  other.id = "other";
  scene.materials.push_back(other);
  Measure measure(scene, plugins, samples);
  const Vector3 ice = measure.above(2);
  measure.draw("liquid", measure.above(1), 293, {});
  measure.draw("ice", ice, 263, frozen, true);
  measure.touch("cuts", touchOf(api::TouchKind::Cut), ice);
  measure.touch("welds", touchOf(api::TouchKind::Weld), ice);
  measure.erase();
  measure.paint("paints", other.id);
  measure.paint("tints", colourCoat({1, 0, 0}));
  using enum api::TouchKind;
  measure.touch("heats", touchOf(Heat), measure.inside());
  measure.touch("pushes", touchOf(Push), measure.inside());
  measure.touch("holds", touchOf(Hold), measure.inside());
  measure.goOn();
  return measure.result();
}

}  // namespace ps
