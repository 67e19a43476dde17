// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

using namespace declare;

constexpr const char* kNoModel = "none";

constexpr api::ParameterDeclaration kGravity =
    number({"gravity", "Gravity", "g", "m/s²"}, {9.81, 0, 25, 0, 1000},
           {"Gravity", "How strongly everything is pulled down.",
            "floating 0, Moon 1.62, Mars 3.72, Earth 9.81, Jupiter 24.8", ""});

constexpr const char* kThermalModel = "thermal_model";

constexpr Words kVelocity{
    "Motion", "Speed along this axis: of a body that is held in place as long as it moves, of any other at the start.",
    "a paddle 0.2 m/s, a thrown ball 10 m/s", ""};
constexpr Words kSpin{"Motion",
                      "Turning about this axis through the body's centre, anticlockwise where the axis points at you: "
                      "of a body that is held in place as long as it moves, of any other at the start.",
                      "a stirrer 180°/s, a turntable 200°/s, one turn a second 360°/s", ""};
constexpr Display kDegrees{"°/s", 180 / std::numbers::pi, 0};

constexpr api::ParameterDeclaration ofMotion(Names names, Range range, Words words, Display display = kAsStored) {
  api::ParameterDeclaration d = number(names, range, words, display);
  d.actsAt = api::ActsAt::NextFrameIfFixed;
  return d;
}

constexpr api::ParameterDeclaration kMotion[] = {
    ofMotion({"velocity_x", "Velocity along x", "v_x", "m/s"}, {0, -5, 5, -1e4, 1e4}, kVelocity),
    ofMotion({"velocity_y", "Velocity along y", "v_y", "m/s"}, {0, -5, 5, -1e4, 1e4}, kVelocity),
    ofMotion({"velocity_z", "Velocity along z", "v_z", "m/s"}, {0, -5, 5, -1e4, 1e4}, kVelocity),
    ofMotion({"spin_x", "Spin about x", "ω_x", "rad/s"}, {0, -20, 20, -1e4, 1e4}, kSpin, kDegrees),
    ofMotion({"spin_y", "Spin about y", "ω_y", "rad/s"}, {0, -20, 20, -1e4, 1e4}, kSpin, kDegrees),
    ofMotion({"spin_z", "Spin about z", "ω_z", "rad/s"}, {0, -20, 20, -1e4, 1e4}, kSpin, kDegrees),
};

struct Component {
  Vector3 Body::*vector;
  size_t axis;
};

std::optional<Component> componentOf(const std::string& key) {
  for (size_t i = 0; i < std::size(kMotion); ++i) {
    if (key == kMotion[i].key) return Component{i < 3 ? &Body::velocity : &Body::spin, i % 3};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Value> outsideValue(const Project& project, const Address& address) {
  if (address.owner == Owner::Body) {
    const auto body =
        std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& b) { return b.id == address.id; });
    const std::optional<Component> component = componentOf(address.key);
    if (body == project.bodies.end() || !component) return std::nullopt;
    return ((*body).*(component->vector))[component->axis];
  }
  if (address.owner != Owner::Scene) return std::nullopt;
  if (address.key == kGravity.key) return project.environment.gravity.norm();
  if (const std::string source = pluginBehind(address.key, kHeatSourceKey); !source.empty()) {
    const auto& used = project.solver.heatSources;
    return std::any_of(used.begin(), used.end(), [&](const UsedHeatSource& s) { return s.plugin == source; });
  }
  if (address.key != kThermalModel) return std::nullopt;
  return project.solver.thermalModel.empty() ? std::string(kNoModel) : project.solver.thermalModel;
}

std::optional<Value> storedValue(const Project& project, const Address& address) {
  if (std::optional<Value> outside = outsideValue(project, address)) return outside;
  const ParameterSet* set = findSet(project, address);
  if (!set) return std::nullopt;
  const auto found = set->values.find(address.key);
  return found == set->values.end() ? std::nullopt : std::optional(found->second);
}

bool setOutsideValue(Project& project, const Address& address, const Value& value) {
  const std::optional<Value> before = outsideValue(project, address);
  if (!before || before->index() != value.index()) return false;
  if (address.owner == Owner::Body) {
    const auto body =
        std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& b) { return b.id == address.id; });
    const Component component = *componentOf(address.key);
    ((*body).*(component.vector))[component.axis] = std::get<double>(value);
  } else if (const std::string source = pluginBehind(address.key, kHeatSourceKey); !source.empty()) {
    std::erase_if(project.solver.heatSources, [&](const UsedHeatSource& s) { return s.plugin == source; });
    if (std::get<bool>(value)) project.solver.heatSources.push_back({source, {}, {}});
  } else if (address.key == kThermalModel) {
    const auto& model = std::get<std::string>(value);
    project.solver.thermalModel = model == kNoModel ? std::string() : model;
  } else {
    Vector3& gravity = project.environment.gravity;
    const double strength = std::get<double>(value), old = std::get<double>(*before);
    gravity = old > 0 ? Vector3(gravity * (strength / old)) : Vector3(0, -strength, 0);
  }
  return true;
}

const api::ParameterDeclaration* sceneWideDeclaration(std::string_view key) {
  static const std::vector<api::ParameterDeclaration> scene = sceneParameters({}, {});
  const std::optional<Address> address = Address::parse(key);
  if (!address) return nullptr;
  switch (address->owner) {
    case Owner::Environment:
      return findDeclaration(environmentParameters(), address->key);
    case Owner::Solver:
      return findDeclaration(solverParameters(), address->key);
    case Owner::Scene:
      return findDeclaration(api::listOf(scene.data(), scene.size()), address->key);
    default:
      return nullptr;
  }
}

std::optional<Value> sceneWideValue(const Project& project, std::string_view key) {
  const api::ParameterDeclaration* declaration = sceneWideDeclaration(key);
  if (!declaration) return std::nullopt;
  const Address address = *Address::parse(key);
  const ParameterSet* set = findSet(project, address);
  return set ? valueOf(*set, *declaration) : outsideValue(project, address);
}

api::ParameterList bodyMotionParameters() { return api::listOf(kMotion); }

std::vector<api::ParameterDeclaration> sceneParameters(const std::vector<std::string>& models,
                                                       const std::string& standard) {
  std::string choices;
  for (const std::string& id : models) choices += id + "|";
  choices += kNoModel;
  const auto first = std::find(models.begin(), models.end(), standard);
  return {kGravity,
          choice({kThermalModel, "Thermal model", "", ""}, kept(choices), static_cast<int>(first - models.begin()),
                 {"Heat", "How matter keeps its heat. Matter starts with the new model from its temperature and phase.",
                  "enthalpy for everything; the thesis's bookkeeping for comparison", ""})};
}

}  // namespace ps
