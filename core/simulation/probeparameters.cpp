// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/probeparameters.h"

#include "core/scene/declare.h"
#include "core/scene/scenewall.h"

#include <algorithm>
#include <array>

namespace ps {
namespace {

using namespace declare;

constexpr Words kWhat{"Measures", "What is read off the matter that it sees, frame by frame.", "", ""};
constexpr double kFar = 1e4;  ///< m

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : "|") + name;
  return all;
}

template <class... Lists>
std::string choicesOf(const Lists&... lists) {
  std::vector<std::string> ids{kProbeAll};
  const auto add = [&](const auto& list) {
    for (const auto& item : list) ids.push_back(item.id);
  };
  (add(lists), ...);
  return joined(ids);
}

/// A member of a probe that is "" for all.
std::string Probe::*memberOf(const std::string& key) {
  if (key == "body") return &Probe::body;
  if (key == "wall") return &Probe::wall;
  if (key == "material") return &Probe::material;
  return key == "phase" ? &Probe::phase : nullptr;
}

/// A face of the box: "box_max_y" is the upper one along y.
struct Face {
  Vector3 Region::*corner;
  Vector3 Environment::*bound;
  size_t axis;
};
std::optional<Face> faceOf(const std::string& key) {
  if (key.size() != 9 || !key.starts_with("box_m") || key[8] < 'x' || key[8] > 'z') return std::nullopt;
  const auto axis = static_cast<size_t>(key[8] - 'x');
  if (key.substr(4, 3) == "min") return Face{&Region::minimum, &Environment::boundsMinimum, axis};
  if (key.substr(4, 3) == "max") return Face{&Region::maximum, &Environment::boundsMaximum, axis};
  return std::nullopt;
}

/// The force along the axis that a wall faces most; of one that faces all ways the upright one.
std::string forceOn(const SceneWall& wall) {
  if (faceOf(wall).isCurved()) return "force_y";
  Eigen::Index axis = 0;
  wall.normal.cwiseAbs().maxCoeff(&axis);
  return std::string("force_") + "xyz"[axis];
}

api::ParameterDeclaration face(const char* key, const char* label, const char* relation, double value, double low,
                               double high) {
  api::ParameterDeclaration d =
      actingWhen("in_box = on", number({key, label, "", "m"}, {value, low, high, -kFar, kFar},
                                       {"Box", "A face of the box in which it looks.", "", ""}));
  return relation ? related(relation, d) : d;
}

void addBox(std::vector<api::ParameterDeclaration>& list, const Environment& environment) {
  list.push_back(toggle({"in_box", "In a box only", "", ""}, false,
                        {"Box", "Sees what stands in a box rather than all matter.", "the mouth of a spout", ""}));
  list.push_back(actingWhen(
      "in_box = on", choice({"box_when", "Stands in it", "", ""}, "now|start", 0,
                            {"Box",
                             "now: what is in the box, frame by frame; start: what stood in it when the scene began, "
                             "wherever it has gone.",
                             "now for a gauge, start for a dyed drop", ""})));
  static constexpr struct {
    const char *low, *lowLabel, *high, *highLabel, *relation;
  } kAxes[] = {{"box_min_x", "From x", "box_max_x", "To x", "must be > box_min_x when in_box = on"},
               {"box_min_y", "From y", "box_max_y", "To y", "must be > box_min_y when in_box = on"},
               {"box_min_z", "From z", "box_max_z", "To z", "must be > box_min_z when in_box = on"}};
  for (size_t a = 0; a < 3; ++a) {
    const double low = environment.boundsMinimum[a], high = environment.boundsMaximum[a];
    list.push_back(face(kAxes[a].low, kAxes[a].lowLabel, nullptr, low, low, high));
    list.push_back(face(kAxes[a].high, kAxes[a].highLabel, kAxes[a].relation, high, low, high));
  }
}

}  // namespace

std::vector<api::ParameterDeclaration> probeParameters(const Project& project, const ParticleFields& fields) {
  std::vector<api::ParameterDeclaration> list{
      choice({"quantity", "Quantity", "", ""}, kept(joined(fields.quantityNames())), 0, kWhat),
      choice({"body", "Of", "", ""}, kept(choicesOf(project.bodies, project.emitters)), 0,
             {"Sees", "The body, or what a tap has poured, or all matter.", "", ""}),
      choice({"material", "Made of", "", ""}, kept(choicesOf(project.materials)), 0,
             {"Sees", "Only matter of this material.", "the water in a cup of tea", ""}),
      choice({"phase", "Phase", "", ""}, "*|solid|melting|liquid|boiling|gas", 0,
             {"Sees", "Only matter in this phase.", "the liquid in a melting block", ""}),
      toggle({"fixed", "Held matter too", "", ""}, false,
             {"Sees", "Sees what is held in place as well, as a probe of a fixed body always does.", "", ""}),
      choice({"wall", "Force on wall", "", ""}, kept(choicesOf(project.environment.walls)), 0,
             {"Sees", "The wall whose force or torque is measured in place of a body's.", "", ""}),
  };
  addBox(list, project.environment);
  return list;
}

std::optional<Value> probeValue(const Probe& probe, const std::string& key, const Environment& environment) {
  if (key == "quantity") return probe.quantity;
  if (const auto member = memberOf(key)) return (probe.*member).empty() ? std::string(kProbeAll) : probe.*member;
  if (key == "fixed") return probe.fixed;
  if (key == "in_box") return probe.region.has_value();
  if (key == "box_when") return probe.regionWhen;
  const std::optional<Face> face = faceOf(key);
  if (!face) return std::nullopt;
  return probe.region ? ((*probe.region).*(face->corner))[face->axis] : (environment.*(face->bound))[face->axis];
}

bool setProbeValue(Probe& probe, const std::string& key, const Value& value, const Environment& environment) {
  const std::optional<Value> before = probeValue(probe, key, environment);
  if (!before || before->index() != value.index()) return false;
  if (key == "quantity") {
    probe.quantity = std::get<std::string>(value);
  } else if (const auto member = memberOf(key)) {
    const auto& name = std::get<std::string>(value);
    probe.*member = name == kProbeAll ? std::string() : name;
  } else if (key == "fixed") {
    probe.fixed = std::get<bool>(value);
  } else if (key == "box_when") {
    probe.regionWhen = std::get<std::string>(value);
  } else if (key == "in_box") {
    const bool on = std::get<bool>(value);
    if (on && !probe.region) {
      probe.region = Region{environment.boundsMinimum, environment.boundsMaximum};
      probe.regionWhen = Probe::kNow;
    }
    if (!on) probe.region.reset();
  } else {
    const Face face = *faceOf(key);
    if (!probe.region) return false;
    ((*probe.region).*(face.corner))[face.axis] = std::get<double>(value);
  }
  return true;
}

void followChoice(Probe& probe, const std::string& key, const Project& project) {
  const std::vector<SceneWall>& walls = project.environment.walls;
  const bool force = isForce(probe.quantity);
  if (key == "body" && !probe.body.empty()) probe.wall.clear();
  if (key == "wall" && !probe.wall.empty()) {
    probe.body.clear();
    const auto wall = std::find_if(walls.begin(), walls.end(), [&](const SceneWall& w) { return w.id == probe.wall; });
    if (!force && wall != walls.end()) probe.quantity = forceOn(*wall);
  }
  if (key == "quantity" && !force) probe.wall.clear();
  if (key == "quantity" && force && probe.body.empty() && probe.wall.empty()) {
    if (!walls.empty())
      probe.wall = walls.front().id;
    else if (!project.bodies.empty())
      probe.body = project.bodies.front().id;
  }
  if ((key == "quantity" || key == "wall") && isForce(probe.quantity)) {  // is of a whole
    probe.material.clear();
    probe.phase.clear();
    probe.region.reset();
  }
}

std::vector<std::pair<std::string, std::string>> probeProblems(const Probe& probe, const ParticleFields& fields) {
  std::vector<std::pair<std::string, std::string>> problems;
  const std::string quoted = "'" + probe.quantity + "'", ofWhole = quoted + " is of a body or wall as a whole";
  if (isForce(probe.quantity)) {
    if (probe.body.empty() && probe.wall.empty())
      problems.emplace_back("quantity", quoted + " needs a body or a wall on which it acts");
    if (!probe.body.empty() && !probe.wall.empty())
      problems.emplace_back("wall", "the force on '" + probe.body + "' is measured; leave one of the two out");
    if (!probe.material.empty()) problems.emplace_back("material", ofWhole);
    if (!probe.phase.empty()) problems.emplace_back("phase", ofWhole);
    if (probe.region) problems.emplace_back("region", ofWhole);
  } else if (!probe.wall.empty()) {
    problems.emplace_back("wall", "is for force and torque alone; " + quoted + " is of matter");
  }
  const Quantity* quantity = fields.quantity(probe.quantity);
  if (probe.wave && quantity && !quantity->mean)
    problems.emplace_back(
        "wave", "needs a quantity that each particle has, as velocity_y; " + quoted + " is of all of them together");
  return problems;
}

}  // namespace ps
