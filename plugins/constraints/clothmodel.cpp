// SPDX-License-Identifier: Apache-2.0
#include "clothmodel.h"

#include <phasesketch/thin.h>

#include <string_view>

namespace ps::constraint {
namespace {

using api::atReset;
using api::ParameterKind;
using api::Scale;

constexpr const char* kSource = "springs of a square lattice: Provot 1995; XPBD: Macklin et al. 2016";

constexpr api::ParameterDeclaration kParameters[] = {
    {"stretch_stiffness", "Stretch stiffness", "Eh", "N/m", ParameterKind::Number, Scale::Logarithmic, 2000, 10, 1e6,
     1e-3, 1e12, "", 1, 0, "", "Structure",
     "Pull on a strip one metre wide that would double its length, if it went on as it begins.",
     "100 N/m a rubber skin, 2000 N/m jersey, 100 kN/m canvas", kSource},
    {"shear_stiffness", "Shear stiffness", "Gh", "N/m", ParameterKind::Number, Scale::Logarithmic, 200, 1, 1e6, 0, 1e12,
     "", 1, 0, "", "Structure",
     "Resistance against pulling squares into diamonds. Low values let cloth drape over a ball without creases.",
     "50 N/m gauze, 500 N/m shirt", kSource},
    {"bend_stiffness", "Bend stiffness", "k_b", "N/m", ParameterKind::Number, Scale::Logarithmic, 20, 0.1, 1e5, 0, 1e12,
     "", 1, 0, "", "Structure",
     "Stiffness of the springs that reach from each particle to the next but one. They answer to folds, hardly to a "
     "gentle curve.",
     "1 N/m silk, 20 N/m shirt, 1000 N/m felt", kSource},
    {"damping", "Inner friction", "τ", "s", ParameterKind::Number, Scale::Linear, 0.002, 0, 0.02, 0, 1, "ms", 1000, 0,
     "", "Structure", "How long a spring resists a change of its length. Quiets flutter; falling is not slowed.",
     "0 flutters for long, 2 ms cotton, 10 ms wet", "Macklin et al. 2016, eq. 26"},
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
     "How far the threads stretch before they tear; 0 never tears.",
     "10 % paper, 25 % cotton, 0 what must hold",
     "maximum strain of the stretch springs, once per frame",
     "never"},
    atReset({"tied_to_fixed", "Sewn to fixed bodies", "", "", ParameterKind::Toggle, Scale::Linear, 0, 0, 1, 0, 1, "",
             1, 0, "", "Structure",
             "Ties the cloth to the fixed bodies that it touches at the start: a flag to its pole.",
             "on for flags, curtains and sails", ""}),
};

}  // namespace

ClothModel::ClothModel()
    : SpringModel({"Cloth",
                   "Makes a sheet one particle thick behave as cloth: springs against stretch, shear and folds, which "
                   "may tear (extended position-based dynamics, Macklin et al. 2016). Draw a thin sheet, or a box that "
                   "is one particle thick. Its mass per area is the material's density times the particle spacing: 50 "
                   "kg/m³ at 2 cm make 1 kg/m². Water runs through where the cloth is stretched to more than one "
                   "particle spacing per thread; folds finer than two spacings do not show. What melts leaves it for "
                   "good, and is held by bonds when it freezes again.",
                   api::listOf(kParameters)}) {}

const void* ClothModel::extension(const char* name) const noexcept {
  static constexpr api::ThinMatter kThin{"cotton"};
  return std::string_view(name) == api::kHoldsSheets ? &kThin : SpringModel::extension(name);
}

SpringModel::Springs ClothModel::springsOf(api::Span<const double> parameters, double) const {
  Springs springs;
  springs.stiffness = {parameters[kStretchStiffness], parameters[kShearStiffness], parameters[kBendStiffness]};
  springs.damping = parameters[kDamping];
  springs.tearStrain = parameters[kTearStrain];
  springs.tiesToFixed = parameters[kTied] > 0.5;
  return springs;
}

SpringModel::Asked ClothModel::askedOf(Kind kind, double) const {
  constexpr const char* kNames[] = {"cloth.stretch_stiffness", "cloth.shear_stiffness", "cloth.bend_stiffness"};
  return {kNames[kind], "N/m", 1};
}

}  // namespace ps::constraint
