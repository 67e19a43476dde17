// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/stampform.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ps {
namespace {

using Corner = std::array<int, 3>;
constexpr size_t kMostFaces = 4000;

bool isBox(const CellSet& cells) {
  api::Cell low = cells.cells().front(), high = low;
  for (const api::Cell& cell : cells.cells()) {
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y), std::min(low.z, cell.z)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y), std::max(high.z, cell.z)};
  }
  const auto span = [](int32_t from, int32_t to) { return static_cast<size_t>(to) - static_cast<size_t>(from) + 1; };
  return cells.size() == span(low.x, high.x) * span(low.y, high.y) * span(low.z, high.z);
}

std::vector<StampForm::Face> facesOf(const CellSet& cells) {
  std::vector<StampForm::Face> faces;
  for (const api::Cell& cell : cells.cells()) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        const api::Cell beside{cell.x + (axis == 0 ? side : 0), cell.y + (axis == 1 ? side : 0),
                               cell.z + (axis == 2 ? side : 0)};
        if (!cells.contains(beside)) faces.push_back({{cell.x, cell.y, cell.z}, axis, side});
      }
    }
  }
  return faces;
}

/// The corner from which a face spreads along the two axes after its own.
Corner startOf(const StampForm::Face& face) {
  Corner at = face.cell;
  if (face.side > 0) ++at[static_cast<size_t>(face.axis)];
  return at;
}

Corner beyond(Corner corner, int axis) {
  ++corner[static_cast<size_t>(axis)];
  return corner;
}

std::vector<StampForm::Edge> edgesOf(const std::vector<StampForm::Face>& faces) {
  std::map<std::pair<Corner, int>, std::vector<size_t>> at;
  for (size_t i = 0; i < faces.size(); ++i) {
    const Corner start = startOf(faces[i]);
    const int u = (faces[i].axis + 1) % 3, v = (faces[i].axis + 2) % 3;
    at[{start, u}].push_back(i);
    at[{beyond(start, v), u}].push_back(i);
    at[{start, v}].push_back(i);
    at[{beyond(start, u), v}].push_back(i);
  }
  std::vector<StampForm::Edge> edges;
  edges.reserve(at.size());
  for (auto& [place, meeting] : at) edges.push_back({place.first, place.second, std::move(meeting)});
  return edges;
}

CellSet coarser(const CellSet& cells) {
  std::vector<api::Cell> out;
  for (const api::Cell& cell : cells.cells()) out.push_back({cell.x >> 1, cell.y >> 1, cell.z >> 1});
  return CellSet(out);
}

}  // namespace

Vector3 StampForm::corner(const std::array<int, 3>& cell) const {
  return first + spacing * Vector3(cell[0] - 0.5, cell[1] - 0.5, cell[2] - 0.5);
}

Vector3 StampForm::normal(const Face& face) const {
  Vector3 normal = Vector3::Zero();
  normal[face.axis] = face.side;
  return normal;
}

Vector3 StampForm::middle(const Face& face) const {
  return first + spacing * (Vector3(face.cell[0], face.cell[1], face.cell[2]) + 0.5 * normal(face));
}

std::array<Vector3, 4> StampForm::corners(const Face& face) const {
  const Corner start = startOf(face);
  const int u = (face.axis + 1) % 3, v = (face.axis + 2) % 3;
  std::array<Vector3, 4> around{corner(start), corner(beyond(start, u)), corner(beyond(beyond(start, u), v)),
                                corner(beyond(start, v))};
  if (face.side < 0) std::reverse(around.begin(), around.end());  // anticlockwise from outside, whichever way it faces
  return around;
}

bool StampForm::isSeen(const Face& face, const Vector3& eye) const {
  return (eye - middle(face)).dot(normal(face)) > 0;
}

std::vector<std::array<Vector3, 2>> StampForm::outline(const Vector3& eye) const {
  std::vector<char> seen;
  for (const Face& face : faces) seen.push_back(isSeen(face, eye));
  std::vector<std::array<Vector3, 2>> lines;
  for (const Edge& edge : edges) {
    const auto shown = [&](size_t face) { return seen[face] != 0; };
    const bool any = std::any_of(edge.faces.begin(), edge.faces.end(), shown);
    if (any && !std::all_of(edge.faces.begin(), edge.faces.end(), shown))
      lines.push_back({corner(edge.from), corner(beyond(edge.from, edge.axis))});
  }
  return lines;
}

std::optional<StampForm> stampForm(const CellSet& cells, double spacing, const Vector3& first) {
  if (cells.empty() || isBox(cells)) return std::nullopt;
  StampForm form;
  form.spacing = spacing;
  form.first = first;
  CellSet shown = cells;
  for (form.faces = facesOf(shown); form.faces.size() > kMostFaces; form.faces = facesOf(shown)) {
    shown = coarser(shown);
    form.first += Vector3::Constant(form.spacing / 2);  // middle of the eight of which it is the first
    form.spacing *= 2;
  }
  form.edges = edgesOf(form.faces);
  return form;
}

}  // namespace ps
