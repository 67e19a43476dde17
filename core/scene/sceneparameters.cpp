// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using namespace declare;

constexpr const char* kNoModel = "none";

constexpr api::ParameterDeclaration kGravity =
    number({"gravity", "Gravity", "g", "m/s²"}, {9.81, 0, 25, 0, 1000},
           {"Gravity", "How strongly everything is pulled down.",
            "floating 0, Moon 1.62, Mars 3.72, Earth 9.81, Jupiter 24.8", ""});

double length(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

std::optional<Value> sceneValue(const Project& project, const std::string& key) {
  if (key == kGravity.key) return length(project.environment.gravity);
  if (key != "thermal_model") return std::nullopt;
  return project.solver.thermalModel.empty() ? std::string(kNoModel) : project.solver.thermalModel;
}

bool setSceneValue(Project& project, const std::string& key, const Value& value) {
  if (const auto* strength = std::get_if<double>(&value); strength && key == kGravity.key) {
    Vec3& gravity = project.environment.gravity;
    const double before = length(gravity);
    for (double& component : gravity) component = before > 0 ? component * (*strength / before) : 0;
    if (!(before > 0)) gravity[1] = -*strength;
    return true;
  }
  if (const auto* model = std::get_if<std::string>(&value); model && key == "thermal_model") {
    project.solver.thermalModel = *model == kNoModel ? std::string() : *model;
    return true;
  }
  return false;
}

std::vector<api::ParameterDeclaration> sceneParameters(const std::vector<std::string>& models) {
  std::string choices;
  for (const std::string& id : models) choices += id + "|";
  choices += kNoModel;
  const auto standard = std::find(models.begin(), models.end(), SolverOptions{}.thermalModel);
  return {kGravity,
          choice({"thermal_model", "Thermal model", "", ""}, kept(choices), static_cast<int>(standard - models.begin()),
                 {"Heat", "How matter keeps its heat. Matter starts with the new model from its temperature and phase.",
                  "enthalpy for everything; the thesis's bookkeeping for comparison", ""})};
}

}  // namespace ps
