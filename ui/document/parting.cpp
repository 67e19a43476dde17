// SPDX-License-Identifier: Apache-2.0
// The part of Document that parts bodies.
#include "ui/document/parting.h"

#include "core/plugin_host/registry.h"
#include "core/scene/group.h"
#include "core/scene/pose.h"
#include "core/scene/shownname.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/document/freename.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ps {
namespace {

/// One that was drawn with copies or stamps is any piece's: where these lie is for its brush to say.
bool mayHaveDrawn(const VoxelShape::Stroke& stroke, const VoxelShape& voxels, const VoxelCanvas& cells) {
  if (stroke.symmetry || stroke.stamp || stroke.samples.empty()) return true;
  const Vector3 reach = Vector3::Constant(stroke.radius + voxels.spacing);
  std::vector<Vector3> way;
  for (const auto& sample : stroke.samples) way.emplace_back(sample[0], sample[1], sample[2]);
  Vector3 low = way.front(), high = low;
  for (const Vector3& place : way) low = low.cwiseMin(place), high = high.cwiseMax(place);
  low -= reach, high += reach;
  // From place to place it is drawn straight.
  const auto isNear = [&](const Vector3& p) {
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
    for (size_t k = 0; k < way.size(); ++k) {
      const Vector3 arm = way[k > 0 ? k - 1 : 0] - way[k];
      const double length = arm.squaredNorm();
      const double along = length > 0 ? std::clamp((p - way[k]).dot(arm) / length, 0.0, 1.0) : 0;
      if (((p - (way[k] + along * arm)).cwiseAbs().array() <= reach.array()).all()) return true;
    }
    return false;
  };
  const SketchGrid drawn{voxels.origin, voxels.spacing};
  return std::any_of(cells.entries().begin(), cells.entries().end(),
                     [&](const VoxelCanvas::Entry& entry) { return isNear(drawn.centreOf(entry.cell)); });
}

void sharePower(Body& body, double share) {
  const auto power = body.parameters.values.find("heating_power");
  if (power == body.parameters.values.end()) return;
  if (auto* watts = std::get_if<double>(&power->second)) *watts *= share;
}

double sizeOf(const VoxelCanvas& canvas) { return static_cast<double>(canvas.size()); }

}  // namespace

Body pieceOf(const Body& body, const VoxelCanvas& cells,
             const std::function<bool(const VoxelShape::Stroke&)>& reachesFar) {
  Body piece = body;
  auto& voxels = std::get<VoxelShape>(piece.shape);
  sharePower(piece, sizeOf(cells) / sizeOf(VoxelCanvas(voxels.runs)));
  voxels.runs = cells.runs();
  std::erase_if(voxels.strokes, [&](const VoxelShape::Stroke& stroke) {
    return !reachesFar(stroke) && !mayHaveDrawn(stroke, voxels, cells);
  });
  return piece;
}

Body restOf(const Body& body, const std::vector<VoxelCanvas>& pieces) {
  Body rest = body;
  auto& voxels = std::get<VoxelShape>(rest.shape);
  VoxelCanvas left(voxels.runs);
  const double whole = sizeOf(left);
  for (const VoxelCanvas& piece : pieces) left.erase(piece.cells());
  sharePower(rest, sizeOf(left) / whole);
  voxels.runs = left.runs();
  return rest;
}

std::vector<std::string> Document::partBody(const std::string& id, const std::vector<CellIndices>& pieces) {
  const Body* whole = body(id);
  const auto* voxels = whole ? std::get_if<VoxelShape>(&whole->shape) : nullptr;
  if (!voxels) return {};
  auto parting = std::make_shared<Parting>();
  parting->body = id;
  parting->lattice = latticeOf(*voxels);
  std::vector<VoxelCanvas> parts;
  std::vector<SceneEdit> come;
  std::set<std::string> names;
  for (const Body& other : m_project.bodies) names.insert(other.name);
  const auto reachesFar = [this](const VoxelShape::Stroke& stroke) {
    const api::BrushPlugin* brush = m_plugins ? m_plugins->brush(stroke.brush) : nullptr;
    return !brush || brush->extension(api::kFillsHollows);
  };
  VoxelCanvas left(voxels->runs);
  for (const CellIndices& cells : pieces) {
    std::vector<api::Cell> list;
    for (const auto& c : cells) list.push_back({c[0], c[1], c[2]});
    VoxelCanvas own = left.erase(CellSet(list));
    if (own.empty() || left.empty()) {  // a body has cells, and one of them keeps its name
      left.restore(own);
      continue;
    }
    Body piece = pieceOf(*whole, own, reachesFar);
    piece.id = freeBodyId(id);
    piece.name = freeName(shownName(*whole), names);
    names.insert(piece.name);
    parts.push_back(std::move(own));
    parting->pieces.push_back({piece.id, cells});
    come.emplace_back(BodyEdit{piece.id, std::nullopt, std::move(piece), m_project.bodies.size() + come.size()});
  }
  std::vector<std::string> ids;
  for (const Parting::Piece& piece : parting->pieces) ids.push_back(piece.body);
  if (ids.empty()) return ids;
  const auto index = static_cast<size_t>(whole - m_project.bodies.data());
  parting->edits.emplace_back(BodyEdit{id, *whole, restOf(*whole, parts), index});
  std::move(come.begin(), come.end(), std::back_inserter(parting->edits));
  const QString title = QStringLiteral("separating the pieces of %1").arg(QString::fromStdString(shownName(*whole)));
  m_undo.beginMacro(title);
  m_undo.push(new PartingCommand(*this, std::move(parting), title));
  takeAlong(id, ids, title);
  m_undo.endMacro();
  return ids;
}

/// Groups and keys of a body are those of its pieces, too; but for those of a power, of which there is no more.
void Document::takeAlong(const std::string& id, const std::vector<std::string>& pieces, const QString& title) {
  std::vector<TrackEdit> tracks;
  for (const Track& track : m_project.tracks) {
    std::optional<Address> address = Address::parse(track.parameter);
    if (!address || address->owner != Owner::Body || address->id != id || address->key == "heating_power") continue;
    for (const std::string& piece : pieces) {
      address->id = piece;
      Track own = track;
      own.parameter = address->text();
      tracks.push_back({m_project.tracks.size() + tracks.size(), std::nullopt, std::move(own)});
    }
  }
  if (!tracks.empty()) m_undo.push(new TrackCommand(*this, std::move(tracks), ++m_gesture, title));
  SceneOrder after = order();
  bool grouped = false;
  for (SceneGroup& group : after.groups) {
    if (std::find(group.members.begin(), group.members.end(), memberOf(Owner::Body, id)) == group.members.end())
      continue;
    grouped = true;
    for (const std::string& piece : pieces) group.members.push_back(memberOf(Owner::Body, piece));
  }
  if (grouped) setOrder(std::move(after), title);
}

void Document::applyParting(const std::shared_ptr<const Parting>& parting, bool done) {
  applyBodies(parting->edits, done, nullptr);
  notify(BodyParted{parting, done});
}

PartingCommand::PartingCommand(Document& document, std::shared_ptr<const Parting> parting, const QString& text)
    : WeighedCommand(text), m_document(document), m_parting(std::move(parting)) {}
void PartingCommand::undo() { m_document.applyParting(m_parting, false); }
void PartingCommand::redo() { m_document.applyParting(m_parting, true); }

void PartingCommand::weigh(Weight& weight) const {
  weight.add(m_parting->body, m_parting->lattice, m_parting->edits);
  for (const Parting::Piece& piece : m_parting->pieces) weight.add(piece.body, piece.cells);
}

}  // namespace ps
