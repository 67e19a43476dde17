// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "springmodel.h"

namespace ps::constraint {

/// A sheet one particle thick. Its parameters are those of the sheet, not of the lattice: a square lattice of springs k
/// pulls with k times the strain per metre of width whatever its spacing, so k is the sheet's stiffness E h in N/m; two
/// diagonals of k_s to each square give the shear stiffness G h = k_s (and add k_s to E h). Its mass per area is
/// density times particle spacing, 1 kg/m² for 50 kg/m³ and 2 cm. It cannot do: bending moments for small angles (the
/// bend springs only answer to folds), other weaves, or folds finer than two spacings.
class ClothModel : public SpringModel {
 public:
  enum Parameter { kStretchStiffness, kShearStiffness, kBendStiffness, kDamping, kTearStrain, kTied, kParameterCount };

  ClothModel();
  const void* extension(const char* name) const noexcept override;

 protected:
  Springs springsOf(api::Span<const double> parameters, double spacing) const override;
  Asked askedOf(Kind kind, double spacing) const override;
};

}  // namespace ps::constraint
