// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/meshnearest.h"
#include "core/scene/solidform.h"

namespace ps {

/// A point of the outline that a solid has about its y axis: where it crosses the x and the z axis, and its height; m.
struct SolidRim {
  double x, y, z;
};

/// Outside is to the left of a line from one to the next; closed where its ends do not lie on the axis. Caps and rims
/// are cut into `arc` pieces.
std::vector<SolidRim> outlineOf(const SolidForm& form, int arc);
/// A capsule or torus so low, or so thick, that nothing straight or hollow is left, and an ellipsoid itself.
bool isEllipsoid(const SolidForm& form);
/// Triangles of a mesh at another size, about the middle of its bounds.
std::vector<MeshNearest::Triangle> facetsOf(const SceneMesh& mesh, const Vector3& size);
/// The same of a solid that is round or oval about its y axis: `around` facets go round it.
std::vector<MeshNearest::Triangle> facetsAround(const SolidForm& form, int around, int arc);
/// The surface of any solid along its own axes, but for sheets and ropes; facets are as small as a distance of `error`
/// m from the surface asks. None of a mesh without triangles.
std::vector<MeshNearest::Triangle> facetsOf(const SolidShape& shape, double error);

}  // namespace ps
