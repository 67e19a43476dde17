// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/coarsebrush.h"

#include "core/parameters/parameterset.h"
#include "core/plugin_host/registry.h"
#include "ui/theme/numbers.h"
#include "ui/tools/brushsettings.h"

#include <phasesketch/brush.h>

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

constexpr double kFew = 3;             // particles across, below which a shape is hardly one
constexpr double kSlack = 1e-6;        // of three that are meant to be three
constexpr const char* kWall = "wall";  // by which a brush says of how many particles its walls are

/// Others are as wide as what is there, or as what they stamp.
bool drawsAsWideAsItIs(const std::string& brush, const PluginRegistry& plugins) {
  const char* const others[] = {api::kTouchesMatter, api::kPaintsMatter, api::kColoursMatter,
                                api::kSmoothsMatter, api::kFillsHollows, api::kStampsShape};
  return plugins.brush(brush) && std::none_of(std::begin(others), std::end(others),
                                              [&](const char* what) { return plugins.needs(brush, what); });
}

}  // namespace

std::vector<Coarseness> coarsenessOf(const BrushSettings& brush, const PluginRegistry& plugins, double spacing) {
  std::vector<Coarseness> list;
  if (!(spacing > 0) || !drawsAsWideAsItIs(brush.shape, plugins)) return list;
  const double across = 2 * brush.radius / spacing;
  if (across < kFew - kSlack) {
    list.push_back(
        {QStringLiteral("radius"), false,
         QStringLiteral("The brush is %1 particles wide, which stand %2 apart: small shapes come out coarse.")
             .arg(formatFixed(across, 1), lengthText(spacing))});
  }
  const api::ParameterList own = plugins.parameters(brush.shape);
  const api::ParameterDeclaration* wall = findDeclaration(own, kWall);
  const bool counts = wall && wall->kind == api::ParameterKind::Integer;
  if (counts && numberOf(brush.shapeParameters(), own, kWall) < 2) {
    list.push_back({QString::fromLatin1(kWall), true,
                    QStringLiteral("The wall is one particle thick, which stand %1 apart: it may leak or break.")
                        .arg(lengthText(spacing))});
  }
  return list;
}

}  // namespace ps
