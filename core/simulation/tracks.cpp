// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/tracks.h"

#include "core/plugin_host/registry.h"
#include "core/scene/track.h"
#include "core/simulation/declared.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

bool isGravity(const Address& address) { return address.owner == Owner::Scene && address.key == "gravity"; }

/// What a declaration says of keys, wherever its value stands.
std::string whyNoKeysOf(const api::ParameterDeclaration& declaration) {
  const std::string label = declaration.label;
  if (declaration.actsAt == api::ActsAt::NextReset)
    return label + " acts at the start; only what acts while the scene runs can have keys";
  if (declaration.actsAt == api::ActsAt::WithItsMatter)
    return label + " is where the body stands; keys of its velocity lead a body that is held in place";
  if (declaration.kind == api::ParameterKind::Choice)
    return label + " is a choice; only numbers and switches can have keys";
  return {};
}

std::string whyNoPoint(const std::string& label, const Response* response, size_t point) {
  if (!response || response->kind != Response::Kind::Curve) return label + " is no curve; it has no points";
  const size_t count = response->points.size();
  if (point < count) return {};
  return label + " has no point " + std::to_string(point) + "; it has " + std::to_string(count) + ", counted from 0";
}

}  // namespace

std::string whyNoKeys(const Project& project, const PluginRegistry* plugins, const TrackTarget& target,
                      bool whenFixed) {
  const Address& address = target.address;
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (!declaration || (address.owner != Owner::Probe && !hasOwner(project, address)))
    return "The scene has no parameter '" + address.text() + "'";
  const std::string label = declaration->label;
  if (address.owner == Owner::Probe) return label + " is of a probe, which changes nothing and has no keys";
  if (!adhesionPartner(address).empty() ||
      (address.owner == Owner::Scene && !pluginBehind(address.key, kHeatSourceKey).empty()))
    return label + " is part of what the scene is made of, which has no keys";
  if (const std::string why = whyNoKeysOf(*declaration); !why.empty()) return why;
  const Value value = valueAt(project, plugins, address);
  const auto* response = std::get_if<Response>(&value);
  if (target.point) return whyNoPoint(label, response, *target.point);
  if (response && response->kind != Response::Kind::Constant)
    return label + " is a curve; only a constant, or one of a curve's points, can have keys";
  if (declaration->actsAt != api::ActsAt::NextFrameIfFixed || whenFixed) return {};
  const auto body =
      std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& b) { return b.id == address.id; });
  if (body != project.bodies.end() && toggleOf(body->parameters, bodyParameters(), "fixed")) return {};
  return label + " acts at the start of a body that is not held in place; keys lead bodies that are";
}

std::string problemOfKey(const TrackKey& key, const api::ParameterDeclaration& declaration) {
  if (declaration.kind != api::ParameterKind::Toggle) return problemOf(Value(key.value), declaration);
  return key.value == 0 || key.value == 1 ? std::string()
                                          : "must be 0 for off or 1 for on, not " + numberText(key.value);
}

Value valueOfKey(double number, const api::ParameterDeclaration& declaration) {
  if (declaration.kind == api::ParameterKind::Toggle) return number > 0.5;
  double value = std::clamp(number, declaration.hardMinimum, declaration.hardMaximum);
  if (declaration.kind == api::ParameterKind::Integer) value = std::floor(value + 0.5);
  return declaration.kind == api::ParameterKind::Response ? Value(Response(value)) : Value(value);
}

Environment environmentAt(const Project& project, const PluginRegistry* plugins, double time) {
  Project around;  // without the bodies, which may be long lists
  around.environment = project.environment;
  around.solver.thermalModel = project.solver.thermalModel;
  for (const Track& track : project.tracks) {
    const std::optional<TrackTarget> target = TrackTarget::parse(track.parameter);
    if (target && (target->address.owner == Owner::Wall || target->address.owner == Owner::Environment))
      around.tracks.push_back(track);
  }
  if (around.tracks.empty() || !plugins) return around.environment;
  TrackOverlay overlay;
  Touched nothing;
  overlay.bind(
      around, *plugins, [](const std::string&) { return false; }, nothing);
  const double dt = numberOf(project.solver.parameters, solverParameters(), "dt");
  overlay.advance(around, time, keySlack(dt), nothing);
  overlay.lay(around);
  return around.environment;
}

void TrackOverlay::bind(const Project& project, const PluginRegistry& plugins, const IsFixed& isFixed,
                        Touched& dropped) {
  std::vector<Laid> before = std::exchange(m_tracks, {});
  for (size_t t = 0; t < project.tracks.size(); ++t) {
    const std::optional<TrackTarget> target = TrackTarget::parse(project.tracks[t].parameter);
    if (!target || !whyNoKeys(project, &plugins, *target, true).empty()) continue;
    const api::ParameterDeclaration* declaration = declarationOf(project, &plugins, target->address);
    if (declaration->actsAt == api::ActsAt::NextFrameIfFixed && !isFixed(target->address.id)) continue;
    const auto old = std::find_if(before.begin(), before.end(), [&](const Laid& l) {
      return l.target.address == target->address && l.target.point == target->point;
    });
    Laid laid{*target, declaration, t, std::nullopt};
    const Value value = valueAt(project, &plugins, target->address);
    if (target->point) laid.curve = std::get<Response>(value);
    laid.otherwise = target->point ? laid.curve.points[*target->point].y : responseOf(value).constant;
    if (old != before.end()) {
      laid.given = old->given;
      before.erase(old);
    }
    m_tracks.push_back(std::move(laid));
  }
  for (const Laid& gone : before) {
    if (gone.given) touch(gone.target.address, dropped);
  }
}

std::optional<double> TrackOverlay::wanted(const Project& project, const Laid& laid, double time, double slack) const {
  const std::optional<double> value = trackValue(project.tracks[laid.track].keys, time, slack);
  return value && value == laid.refused ? laid.given : value;
}

bool TrackOverlay::moves(const Project& project, double time, double slack) const {
  return std::any_of(m_tracks.begin(), m_tracks.end(),
                     [&](const Laid& laid) { return wanted(project, laid, time, slack) != laid.given; });
}

void TrackOverlay::advance(const Project& project, size_t track, double time, double slack, Touched& touched) {
  Laid& laid = m_tracks[track];
  const std::optional<double> value = wanted(project, laid, time, slack);
  if (value == laid.given) return;
  laid.given = value;
  laid.refused.reset();
  touch(laid.target.address, touched);
}

void TrackOverlay::advance(const Project& project, double time, double slack, Touched& touched) {
  for (size_t t = 0; t < m_tracks.size(); ++t) advance(project, t, time, slack, touched);
}

void TrackOverlay::refuse(const Project& project, size_t track, double time, double slack, const std::string& why) {
  Laid& laid = m_tracks[track];
  laid.refused = trackValue(project.tracks[laid.track].keys, time, slack);
  laid.given.reset();
  laid.why = why;
}

/// Of a point, the curve that holds otherwise, with this point elsewhere.
Value TrackOverlay::valueOf(const Project& project, const Laid& laid) {
  const Value value = valueOfKey(*laid.given, *laid.declaration);
  if (!laid.target.point) return value;
  const std::optional<Value> own = storedValue(project, laid.target.address);
  const auto* stored = own ? std::get_if<Response>(&*own) : nullptr;
  Response curve = stored ? *stored : laid.curve;
  if (*laid.target.point < curve.points.size()) curve.points[*laid.target.point].y = responseOf(value).constant;
  return curve;
}

void TrackOverlay::lay(Project& project) {
  for (Laid& laid : m_tracks) {
    if (!laid.given) continue;
    const Address& address = laid.target.address;
    const Value value = valueOf(project, laid);
    laid.own = storedValue(project, address);
    laid.gravity = project.environment.gravity;
    laid.isLaid = true;
    if (!setOutsideValue(project, address, value)) findSet(project, address)->values[address.key] = value;
  }
}

void TrackOverlay::restore(Project& project, const Laid& laid) {
  if (!laid.isLaid) return;
  const Address& address = laid.target.address;
  ParameterSet* set = findSet(project, address);
  if (isGravity(address)) {
    project.environment.gravity = laid.gravity;
  } else if (laid.own && outsideValue(project, address)) {
    setOutsideValue(project, address, *laid.own);
  } else if (set && laid.own) {
    set->values[address.key] = *laid.own;
  } else if (set) {
    set->values.erase(address.key);
  }
}

void TrackOverlay::lift(Project& project) {
  liftFrom(project);
  for (Laid& laid : m_tracks) laid.isLaid = false;
}

void TrackOverlay::liftFrom(Project& copy) const {
  // The last laid comes off first: several may be of one curve.
  for (auto laid = m_tracks.rbegin(); laid != m_tracks.rend(); ++laid) restore(copy, *laid);
}

std::vector<Limit> TrackOverlay::limits() const {
  std::vector<Limit> list;
  for (const Laid& laid : m_tracks) {
    if (!laid.refused) continue;
    Limit limit{laid.target.address.text(), *laid.refused, laid.otherwise, laid.declaration->unit};
    limit.why = laid.why;
    list.push_back(std::move(limit));
  }
  return list;
}

}  // namespace ps
