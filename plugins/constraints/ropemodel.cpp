// SPDX-License-Identifier: Apache-2.0
#include "ropemodel.h"

#include <phasesketch/thin.h>

#include <string_view>

namespace ps::constraint {
namespace {

using api::atReset;
using api::ParameterKind;
using api::Scale;

constexpr const char* kSource = "springs along a line: Provot 1995; XPBD: Macklin et al. 2016";

constexpr api::ParameterDeclaration kParameters[] = {
    {"stretch_stiffness", "Stretch stiffness", "EA", "N", ParameterKind::Number, Scale::Logarithmic, 1000, 1, 1e6, 1e-3,
     1e12, "", 1, 0, "", "Structure", "Pull that would double the rope's length, if it went on as it begins.",
     "50 N a rubber band, 1000 N a climbing rope's elasticity scaled down, 100 kN a steel cable", kSource},
    {"bend_stiffness", "Bend stiffness", "k_b", "N/m", ParameterKind::Number, Scale::Logarithmic, 10, 0.1, 1e5, 0, 1e12,
     "", 1, 0, "", "Structure",
     "Stiffness of the springs that reach from each particle to the next but one. They answer to kinks, hardly to a "
     "gentle curve.",
     "1 N/m a string, 1000 N/m a wire", kSource},
    {"damping", "Inner friction", "τ", "s", ParameterKind::Number, Scale::Linear, 0.002, 0, 0.02, 0, 1, "ms", 1000, 0,
     "", "Structure", "How long a spring resists a change of its length. Swinging is not slowed.",
     "0 rings like a wire, 2 ms hemp", "Macklin et al. 2016, eq. 26"},
    {"tear_strain",
     "Tears at",
     "ε_t",
     "",
     ParameterKind::Number,
     Scale::Linear,
     0,
     0,
     1,
     0,
     100,
     "%",
     100,
     0,
     "",
     "Structure",
     "How far the rope stretches before it tears; 0 never tears.",
     "3 % hemp, 20 % nylon, 0 what must hold",
     "maximum strain of the stretch springs, once per frame",
     "never"},
    atReset({"tied_to_fixed", "Tied to fixed bodies", "", "", ParameterKind::Toggle, Scale::Linear, 0, 0, 1, 0, 1, "",
             1, 0, "", "Structure",
             "Ties the rope to the fixed bodies that it touches at the start: a bridge to its posts.",
             "on for bridges and swings", ""}),
};

}  // namespace

RopeModel::RopeModel()
    : SpringModel({"Rope",
                   "Makes a line one particle thick behave as a rope: springs against stretch and kinks, which may "
                   "tear (extended position-based dynamics, Macklin et al. 2016). Draw a thin line, or a box that is "
                   "one particle high and deep. Its mass per length is the material's density times the square of the "
                   "particle spacing. Heavy loads stretch it more than they should unless there are many substeps; it "
                   "does not resist twist. What melts leaves it for good, and is held by bonds when it freezes again.",
                   api::listOf(kParameters)}) {}

const void* RopeModel::extension(const char* name) const noexcept {
  static constexpr api::ThinMatter kThin{"hemp"};
  return std::string_view(name) == api::kHoldsLines ? &kThin : SpringModel::extension(name);
}

SpringModel::Springs RopeModel::springsOf(api::Span<const double> parameters, double spacing) const {
  Springs springs;
  springs.stiffness = {parameters[kStretchStiffness] / spacing, 0, parameters[kBendStiffness]};
  springs.damping = parameters[kDamping];
  springs.tearStrain = parameters[kTearStrain];
  springs.tiesToFixed = parameters[kTied] > 0.5;
  return springs;
}

SpringModel::Asked RopeModel::askedOf(Kind kind, double spacing) const {
  if (kind == kStretch) return {"rope.stretch_stiffness", "N", spacing};
  return {kind == kBend ? "rope.bend_stiffness" : nullptr, "N/m", 1};
}

}  // namespace ps::constraint
