// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/brushsettings.h"

#include "ui/theme/numbers.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr double kStep = 1.122018454301963;  // twenty steps per factor of ten
}

ParameterSet BrushSettings::shapeParameters() const {
  const auto found = parameters.find(shape);
  return found == parameters.end() ? ParameterSet{} : found->second;
}

double largerBrush(double radius) { return std::min(kBrushMaximum, radius * kStep); }
double smallerBrush(double radius) { return std::max(kBrushMinimum, radius / kStep); }

QString lengthText(double metres) {
  if (std::abs(metres) < 1) return formatQuantity(metres * 1000, QStringLiteral("mm"), 3);
  return formatQuantity(metres, QStringLiteral("m"), 3);
}

}  // namespace ps
