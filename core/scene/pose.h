// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/scene/project.h"

#include <optional>
#include <string>

namespace ps {

/// A box that a shape fits in, along the scene's axes.
struct BodyBounds {
  Vector3 minimum, maximum;  ///< m
  Vector3 middle() const { return 0.5 * (minimum + maximum); }
  Vector3 size() const { return maximum - minimum; }
};
/// Of a solid's whole extent, of a sketch's cells; a sketch without cells is a point.
BodyBounds boundsOf(const Body& body);
/// The box around a box that is taken along.
BodyBounds carriedBounds(const BodyBounds& box, const RigidMove& move);
/// Where a body is, m: the middle of its form, which it turns about and is scaled from.
Vector3 pivotOf(const Body& body);
/// Of the matter that fills it evenly, m. Of a mesh with holes: of what its triangles enclose, as far as they do.
Vector3 centroidOf(const Body& body);

/// Where a sketch has been taken since it was drawn, from where its cells and strokes are.
RigidMove poseOf(const VoxelShape& voxels);
/// A sketch's lattice, without anything on it.
VoxelShape latticeOf(const VoxelShape& voxels);
/// Takes a lattice along.
void carryLattice(VoxelShape& lattice, const RigidMove& move);

/// The nearest move that a body's form can make: sketches that were never turned go by whole cells, so that more can be
/// drawn beside them on the same lattice.
RigidMove possibleMove(const Body& body, const RigidMove& wanted);
/// The body at another pose, with its pins and what varies along it; the move is one that it can make. Pins become the
/// boxes around what they were, a block of whole layers that is turned the solid block of its place and size.
Body moved(Body body, const RigidMove& move);
/// The body with its sizes along its own axes (of a solid) or the scene's times these factors, about its pivot, which
/// goes by `shift` m. A sketch stays in proportion, by the factor that changes most: its cells become larger or smaller
/// with its strokes, and are filled with particles of the scene's spacing. What brushes have of their own but a size
/// stays as it is.
Body scaled(Body body, const Vector3& factors, const Vector3& shift = Vector3::Zero());
/// The body with the sizes of another one of its kind, where it stands.
Body sizedAs(Body body, const Body& other);
/// How what was made of one body comes to stand where the other would be made; nothing where the shapes differ in more
/// than their pose, or not at all. A block of whole layers and a solid one of its size do not.
std::optional<RigidMove> moveBetween(const Body& before, const Body& after);

}  // namespace ps
