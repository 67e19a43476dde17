// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/parametercourse.h"

#include "core/scene/track.h"
#include "core/simulation/declared.h"
#include "core/simulation/tracks.h"

#include <algorithm>
#include <limits>

namespace ps {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double numberOf(const Value& value) {
  if (const auto* toggle = std::get_if<bool>(&value)) return *toggle ? 1 : 0;
  const auto* number = std::get_if<double>(&value);
  return number ? *number : kNaN;
}

std::vector<TrackKey> keysOf(const std::vector<Track>& tracks, const Address& address) {
  const Track* track = findTrack(tracks, address.text());
  return track ? track->keys : std::vector<TrackKey>{};
}

}  // namespace

ParameterCourse::ParameterCourse(const RunEdits& run, const PluginRegistry* plugins, const Address& address) {
  if (!run.document) return;
  m_slack = keySlack(ps::numberOf(run.document->solver.parameters, solverParameters(), "dt"));
  take(0, *run.document, plugins, address);
  for (const auto& [frame, edit] : run.edits) {
    const auto set = [&, from = frame](const SetParameter& one) {
      if (one.address == address) pieceFrom(from).own = numberOf(one.value);
    };
    if (const auto* together = std::get_if<std::vector<SetParameter>>(&edit)) {
      for (const SetParameter& one : *together) set(one);
      continue;
    }
    const auto& command = std::get<Command>(edit);
    if (const auto* one = std::get_if<SetParameter>(&command)) set(*one);
    if (const auto* animated = std::get_if<SetTracks>(&command))
      pieceFrom(frame).keys = keysOf(animated->tracks, address);
    if (const auto* moved = std::get_if<MoveBody>(&command); moved && moved->body->id == address.id) {
      Project alone;
      alone.bodies.push_back(*moved->body);
      if (const ParameterSet* own = address.owner == Owner::Shape ? findSet(alone, address) : nullptr)
        pieceFrom(frame).own = numberOf(valueOf(*own, *findDeclaration(solidParameters(), address.key)));
    }
    if (const auto* whole = std::get_if<UpdateProject>(&command)) take(frame, *whole->project, plugins, address);
  }
}

void ParameterCourse::take(uint64_t frame, const Project& project, const PluginRegistry* plugins,
                           const Address& address) {
  Piece& piece = pieceFrom(frame);
  const bool known = hasOwner(project, address) && declarationOf(project, plugins, address);
  piece.own = known ? numberOf(valueAt(project, plugins, address)) : kNaN;
  const bool follows = known && whyNoKeys(project, plugins, TrackTarget{address}).empty();
  piece.keys = follows ? keysOf(project.tracks, address) : std::vector<TrackKey>{};
}

/// The last one, as it is or as a copy that holds from a frame on.
ParameterCourse::Piece& ParameterCourse::pieceFrom(uint64_t frame) {
  if (m_pieces.empty()) {
    m_pieces.push_back({frame, kNaN, {}});
  } else if (m_pieces.back().from < frame) {
    Piece next = m_pieces.back();
    next.from = frame;
    m_pieces.push_back(std::move(next));
  }
  return m_pieces.back();
}

double ParameterCourse::at(const FrameStats& stats) const {
  const auto after = std::upper_bound(m_pieces.begin(), m_pieces.end(), stats.frame,
                                      [](uint64_t frame, const Piece& piece) { return frame < piece.from; });
  if (after == m_pieces.begin()) return kNaN;
  const Piece& piece = *std::prev(after);
  return trackValue(piece.keys, stats.time, m_slack).value_or(piece.own);
}

}  // namespace ps
