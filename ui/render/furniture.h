// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/instances.h"
#include "ui/render/section.h"

#include <array>
#include <utility>
#include <vector>

namespace ps::render {

/// End of a thin line. `other` is its far end; `ribbon`: side as seen from this end, opacity, side.
struct EdgeVertex {
  std::array<float, 3> position, other;
  std::array<float, 4> ribbon;
};

/// A thin line, which matter in front of it hides.
void addEdge(std::vector<EdgeVertex>& out, const Vector3& a, const Vector3& b, double opacity);

/// A convex polygon in space, counter-clockwise as seen from where its normal points.
struct Face {
  std::vector<Vector3> corners;
  std::vector<bool> walled;  ///< the edge from corner i to i + 1 lies on another wall (else on the bounds)
};

/// The part of a wall that faces the scene: its plane within the bounds and the other planes. Empty where nothing is
/// left, and of curved walls.
Face wallFace(const Environment& environment, size_t wall);
/// What is shown of that: sides end at a lid, or fade out somewhat above the floor.
Face seenFace(const Environment& environment, size_t wall);
/// What a section leaves of that. A floor stays whole as long as any of it is left: it is what things stand on.
Face leftOf(const Environment& environment, size_t wall, const std::optional<Section>& section);
/// The edges of a side that are drawn, m, as far as something is to be seen of them: not along the floor, whose rim is
/// there, and not where they have faded out. Nothing of other walls.
std::vector<std::pair<Vector3, Vector3>> paneLines(const Environment& environment, size_t wall,
                                                   const std::optional<Section>& section);
/// The lines by which a curved wall is seen, m: rings and straight lines of a cylinder from floor to lid, or where
/// panes fade; three great circles of a sphere, as far as planes do not hide them, or `whole`. Nothing of a plane.
std::vector<std::pair<Vector3, Vector3>> roundLines(const Environment& environment, size_t wall, bool whole = false);
/// How much of its normal a wall has upwards or downwards at least to be drawn as a plate: 45 degrees.
inline constexpr double kLevel = 0.7;

/// What stands around the particles, as triangles. Built anew when the environment changes.
struct Furniture {
  std::vector<MeshVertex> opaque, clear;  ///< triangles
  std::vector<EdgeVertex> edges;          ///< triangles
  Extent opaqueExtent;
  bool hasFloor = false;
  float floor = 0, ground = 0;                ///< heights, m
  std::array<float, 2> centre{}, half{1, 1};  ///< of the floor in x and z, m
  float size = 1;                             ///< of the scene, m
  float floorHeat = 0;                        ///< 0..1: how much the floor glows
  float lidHeight = 0;
  bool hasLid = false;
};
/// Of corners of triangles.
Extent extentOf(const std::vector<MeshVertex>& mesh);
/// Whether two environments look the same.
bool sameFurniture(const Environment& a, const Environment& b);

/// Floors (normal up) are metal slabs, lids (normal down) frosted plates, sides a low rim and the edges of glass panes,
/// curved walls glass between thin lines.
Furniture buildFurniture(const Environment& environment, bool dark, const std::optional<Section>& section = {});

/// How much a floor glows, 0 below hand warmth to 1 far above boiling water; 0 for walls that are not held at a
/// temperature. A sign, not physics: metal glows by itself above 800 K only.
double glowOf(const SceneWall& wall);

// Solids made of outlines, in prism.cpp.

/// The outline moved outwards by `distance` in its plane, corners mitred.
std::vector<Vector3> offsetOutline(const std::vector<Vector3>& outline, const Vector3& normal, double distance);
/// A slab under (against the normal of) an outline, with rounded corners and edges.
struct SlabShape {
  double margin, corner, bevel, thickness;  ///< m
};
void addSlab(std::vector<MeshVertex>& out, const std::vector<Vector3>& outline, const Vector3& normal,
             const SlabShape& shape, const std::array<float, 4>& top, const std::array<float, 4>& side);
/// A frame that stands on the walled edges of a floor.
void addRim(std::vector<MeshVertex>& out, const Face& floor, const Vector3& normal, double width, double height,
            const std::array<float, 4>& material);

}  // namespace ps::render
