// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <array>
#include <memory>
#include <vector>

namespace ps {

class MeshNearest;
class MeshWinding;
class SolidForm;

/// Tells which places lie in a solid of any kind; of a hollow mesh, those within its surface, `layer` m thick, or where
/// that is 0 what it encloses.
class SolidInside {
 public:
  explicit SolidInside(const SolidShape& shape, double layer = 0);
  ~SolidInside();
  const SolidForm& form() const { return *m_form; }
  /// Of a place along the solid's own axes, m from its middle. May be called from any thread.
  bool holds(const Vector3& own) const;

 private:
  std::unique_ptr<const SolidForm> m_form;
  std::shared_ptr<const MeshWinding> m_winding;  ///< of a mesh
  std::unique_ptr<const MeshNearest> m_skin;     ///< of a hollow mesh
  double m_halfLayer;                            ///< m, of that
  Vector3 m_toMesh, m_meshMiddle;                ///< scale and shift from the solid's own axes to those of its mesh
};

/// Cells of a lattice along the solid's own axes whose centres lie in it.
struct SolidCells {
  Vector3 first;                          ///< m, along its own axes: centre of cell (0, 0, 0) of a cubic lattice
  std::vector<std::array<int, 3>> cells;  ///< in order of z, y, x
  Vector3 stretch{1, 1, 1};               ///< of the lattice about the solid's middle, with which cells have its volume
};

/// The lattice lies symmetrically in the solid: along each axis, cells or faces of cells lie in its middle, as makes
/// the number of cells come closest to its volume where it is small, else as suits its size. At least one cell. Tells
/// its steps to the thread's Progress.
SolidCells fillSolid(const SolidShape& shape, double spacing);

/// What a solid is filled with.
struct SolidMatter {
  std::vector<api::Double3> places;  ///< m, in the scene
  double volume = 0;                 ///< m3 of each: together that of the solid, but where `stretch` is at its end
  bool packed = false;
};
/// As its parameter `fill` says: on the lattice of fillSolid(), stretched, or packed (packSolid()) from there, as what
/// is `fixed` is unless it says otherwise. What was filled last is kept, wherever it stands. Tells its steps to the
/// thread's Progress.
SolidMatter solidMatter(const SolidShape& shape, double spacing, bool fixed);
/// The same solid, upright in the middle of the scene: what fills it hangs on nothing else.
SolidShape withoutPose(SolidShape shape);
/// Whether it is packed, as the solid of a body that is fixed or moves.
bool isPacked(const SolidShape& shape, bool fixed);
/// Places of the lattice, whatever `fill` says.
std::vector<api::Double3> latticePlaces(const SolidShape& shape, double spacing);

}  // namespace ps
