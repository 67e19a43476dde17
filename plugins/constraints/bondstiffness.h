// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "bondmodel.h"

#include <algorithm>
#include <cstdint>

// What the stiffness of a bond follows from.
namespace ps::constraint {

/// The axial ones alone.
inline constexpr float kAxialRadius = 1.2f;
inline constexpr double kStiffnessOfModulus = 0.4;  // k/(E dx) of 18 neighbours; of 6 it is 1

/// Of temperatures, or places.
struct Range {
  double low = 1e30, high = -1e30;
  void include(double t) { low = std::min(low, t), high = std::max(high, t); }
  bool empty() const { return low > high; }
};

inline bool isSet(const api::ConstraintContext& context, BondModel::Parameter parameter) {
  return context.parameters[parameter] > 0.5;
}

/// k/(E dx) of the lattice that the body is made of.
inline double stiffnessOfModulus(const api::ConstraintContext& context) {
  return isSet(context, BondModel::kNeighbours) ? 1 : kStiffnessOfModulus;
}

/// k in N/m that the step resolves for a pair of inverse masses.
inline double stiffnessLimit(const api::ConstraintContext& context, double inverseMasses) {
  return context.parameters[BondModel::kStiffnessRatio] * 2 / (inverseMasses * context.dt * context.dt);
}

/// By which the bonds along the axes make up for those that are missing at a surface.
class Surface {
 public:
  Surface(const api::ConstraintContext& context, const api::ParticleView& p)
      : m_p(p),
        m_ties(static_cast<const uint8_t*>(p.fields->read(BondModel::kTiesField, api::FieldType::UInt8))),
        m_longest(kAxialRadius * static_cast<float>(context.spacing * context.parameters[BondModel::kRestRatio])),
        m_acts(m_ties && !isSet(context, BondModel::kNeighbours)) {}
  double factor(uint32_t i, uint32_t j, float restLength) const {
    if (!m_acts || restLength > m_longest) return 1;
    // What is fixed may end where it was cut off.
    const bool fixedI = m_p.velocity[i].w == 0, fixedJ = m_p.velocity[j].w == 0;
    return 1 + kPerMissing / 2 * (missing(fixedI ? j : i) + missing(fixedJ ? i : j));
  }

 private:
  static constexpr double kPerMissing = 3.0 / 32;
  static constexpr int kWhole = 18;
  int missing(uint32_t i) const { return m_ties[i] > 0 ? kWhole - std::min<int>(kWhole, m_ties[i]) : 0; }
  const api::ParticleView& m_p;
  const uint8_t* m_ties;
  float m_longest;
  bool m_acts;
};

}  // namespace ps::constraint
