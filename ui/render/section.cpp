// SPDX-License-Identifier: Apache-2.0
#include "ui/render/section.h"

namespace ps {

Vector3 openSide(const ViewSection& section, const Vector3& forward) {
  const Vector3 side = section.across == "x"   ? Vector3(Vector3::UnitX())
                       : section.across == "y" ? Vector3(Vector3::UnitY())
                       : section.across == "z" ? Vector3(Vector3::UnitZ())
                                               : Vector3(-forward);
  return section.flipped ? Vector3(-side) : side;
}

Section sectionFor(const ViewSection& section, const Vector3& forward) {
  const Vector3 kept = -openSide(section, forward);
  return {{kept, kept.dot(section.through)}};
}

LineList leftOf(const LineList& lines, const std::optional<Section>& section) {
  if (!section) return lines;
  LineList left;
  for (const auto& [from, to] : lines) {
    const double a = section->plane.heightOf(from), b = section->plane.heightOf(to);
    if ((a < 0 && b <= 0) || (a <= 0 && b < 0)) continue;
    const Vector3 on = a * b < 0 ? Vector3(from + a / (a - b) * (to - from)) : from;
    left.emplace_back(a < 0 ? on : from, b < 0 ? on : to);
  }
  return left;
}

}  // namespace ps
