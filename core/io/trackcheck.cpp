// SPDX-License-Identifier: Apache-2.0
#include "core/io/trackcheck.h"

#include "core/base/nearest.h"
#include "core/plugin_host/registry.h"
#include "core/scene/track.h"
#include "core/simulation/declared.h"
#include "core/simulation/rules.h"
#include "core/simulation/tracks.h"

#include <cmath>
#include <optional>

namespace ps {
namespace {

using Weight = TrackFinding::Weight;

std::string keyPointer(size_t key) { return "/keys/" + std::to_string(key); }

TrackFinding unknownParameter(const Project& project, const std::string& text, const PluginRegistry& plugins) {
  std::vector<std::string> known;
  for (const Address& address : allAddresses(project, &plugins)) known.push_back(address.text());
  return {Weight::Mended, "/parameter", "the scene has no parameter '" + text + "'" + didYouMean(text, known)};
}

/// Of keys as values of what they are keys of.
std::vector<TrackFinding> valueFindings(const Project& project, const Track& track, const TrackTarget& target,
                                        const PluginRegistry& plugins) {
  const Address& address = target.address;
  const api::ParameterDeclaration& declaration = *declarationOf(project, &plugins, address);
  for (size_t k = 0; k < track.keys.size(); ++k) {
    const std::string problem = problemOfKey(track.keys[k], declaration);
    if (!problem.empty()) return {{Weight::Mended, keyPointer(k) + "/value", problem}};
    const bool between = k + 1 < track.keys.size() && track.keys[k].toNext != ToNext::Step;
    if (between && declaration.kind == api::ParameterKind::Toggle)
      return {{Weight::Mended, keyPointer(k) + "/to_next", "must be step: a switch has no values between on and off"}};
  }
  for (const CurvePoint& turn : turnsOf(track.keys)) {
    const std::string problem =
        rangeProblem(turn.y, declaration.hardMinimum, declaration.hardMaximum, declaration.unit);
    const size_t k = keyBehind(track.keys, turn.x, 0);
    // Of two the steeper one.
    const double after = track.keys[k].slopeAfter.value_or(0), before = track.keys.at(k + 1).slopeBefore.value_or(0);
    const std::string place =
        std::abs(after) >= std::abs(before) ? keyPointer(k) + "/slope_after" : keyPointer(k + 1) + "/slope_before";
    if (!problem.empty())
      return {{Weight::Mended, place, "leads at " + numberText(turn.x) + " s to a value that " + problem}};
  }
  for (size_t k = 0; k < track.keys.size() && !target.point; ++k) {
    const std::string broken =
        problemOfRelations(project, &plugins, address, valueOfKey(track.keys[k].value, declaration));
    if (!broken.empty()) return {{Weight::Told, keyPointer(k) + "/value", broken}};
  }
  return {};
}

}  // namespace

std::vector<TrackFinding> findingsOf(const Project& project, const Track& track, const PluginRegistry& plugins) {
  if (track.keys.empty()) return {{Weight::Refused, "/keys", "must have a key at least, or leave the track out"}};
  if (const std::optional<KeyProblem> problem = problemOfKeys(track.keys))
    return {{Weight::Refused, keyPointer(problem->key) + "/time", problem->what}};
  const std::optional<TrackTarget> target = TrackTarget::parse(track.parameter);
  if (!target || !hasOwner(project, target->address)) return {unknownParameter(project, track.parameter, plugins)};
  if (declarationsOf(project, &plugins, target->address).count == 0)
    return {{Weight::Told, "/parameter", "its plugin is not there; the track is kept and does nothing"}};
  if (!declarationOf(project, &plugins, target->address)) return {unknownParameter(project, track.parameter, plugins)};
  if (const std::string why = whyNoKeys(project, &plugins, *target, true); !why.empty())
    return {{Weight::Mended, "/parameter", why}};
  if (const std::string why = whyNoKeys(project, &plugins, *target); !why.empty())
    return {{Weight::Told, "/parameter", why + "; the track does nothing"}};
  return valueFindings(project, track, *target, plugins);
}

}  // namespace ps
