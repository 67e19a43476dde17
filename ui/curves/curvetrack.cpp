// SPDX-License-Identifier: Apache-2.0
// Keys of a parameter as the curve that is edited, over time; and what is marked on any curve.
#include "core/scene/track.h"
#include "core/simulation/graphsource.h"
#include "ui/curves/curvetarget.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

const api::ParameterDeclaration& timeDeclaration() {
  static const api::ParameterDeclaration declaration{
      "time", "Time", "t", "s", api::ParameterKind::Number, api::Scale::Linear, 0, 0, 1e9, 0, 1e9, "", 1, 0, "",
      "",     "",     "",  ""};
  return declaration;
}

}  // namespace

Response curveOf(const std::vector<TrackKey>& keys) {
  std::vector<CurvePoint> points;
  for (const TrackKey& key : keys) points.push_back({key.time, key.value, key.toNext, key.slopeBefore, key.slopeAfter});
  return curveThrough(std::move(points));
}

const api::ParameterDeclaration& CurveTarget::axis() const {
  return m_track ? timeDeclaration() : temperatureDeclaration();
}

double CurveTarget::snapped(double x) const {
  const double frame = 2 * document().keySlack();
  return m_track && frame > 0 ? std::round(x / frame) * frame : x;
}

void CurveTarget::chooseTrack(const Address& address) {
  if (!document().track(address) || !document().keyDeclaration(address)) return;
  m_track = address;
  onTarget();
}

/// What a file says of a key beyond the curve goes on with the key, moved or not.
QString CurveTarget::setTrack(const Response& curve) {
  const std::vector<TrackKey>& old = document().track(*m_track)->keys;
  const bool toggle = declaration().kind == api::ParameterKind::Toggle;
  std::vector<TrackKey> keys;
  for (size_t k = 0; k < curve.points.size(); ++k) {
    const CurvePoint& p = curve.points[k];
    TrackKey key{std::round(p.x * 1e6) / 1e6, p.y, p.toNext, p.slopeBefore, p.slopeAfter};
    if (toggle) key.value = p.y > 0.5 ? 1 : 0, key.toNext = ToNext::Step;
    const auto same = old.size() == curve.points.size()
                          ? old.begin() + static_cast<std::ptrdiff_t>(k)
                          : std::find_if(old.begin(), old.end(), [&](const TrackKey& o) { return o.time == key.time; });
    if (same != old.end()) key.unknown = same->unknown;
    keys.push_back(std::move(key));
  }
  return document().setKeys({{*m_track, std::move(keys)}}, QStringLiteral("keys of %1").arg(title()));
}

std::optional<CurveMark> CurveTarget::mark(const MaterialNow& now) const {
  if (m_track) {
    const Track* keys = document().track(*m_track);
    const double time = m_session.now();
    if (!keys || time < keys->keys.front().time) return std::nullopt;  // its own value holds
    return CurveMark{QStringLiteral("Now"), time};
  }
  if (now.marked) return CurveMark{QStringLiteral("Selected particle, now"), *now.marked};
  const SnapshotPtr snapshot = m_session.snapshot();
  if (!m_selection.empty() && m_selection.kind() == OutlineKind::Probe && snapshot) {
    const GraphSource probe(probeSource(m_selection.id()), document().project(), m_session.fields());
    const double kelvin = probe && probe.unit() == temperatureDeclaration().unit ? probe(snapshot->stats) : 0;
    if (kelvin > 0) return CurveMark{QString::fromStdString(probe.label()) + QStringLiteral(", now"), kelvin};
  }
  if (now.count == 0) return std::nullopt;
  return CurveMark{QStringLiteral("Mean of its particles, now"), now.mean};
}

}  // namespace ps
