// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

namespace ps {

inline constexpr const char* kSolidKinds = "ellipsoid|block|cylinder|cone|capsule|torus|tube|bowl|mesh|sheet|rope";

/// What the parameters of a solid say, ready to be computed with. Its own axes are those along which its sizes are; its
/// middle is the origin of them.
class SolidForm {
 public:
  enum class Kind : uint8_t { Ellipsoid, Block, Cylinder, Cone, Capsule, Torus, Tube, Bowl, Mesh, Sheet, Rope };

  explicit SolidForm(const SolidShape& shape);

  Kind kind() const { return m_kind; }
  const Vector3& size() const { return m_size; }          ///< m, along its own axes
  const Vector3& middle() const { return m_middle; }      ///< m, in the scene
  double wall() const { return m_wall; }                  ///< m, thickness of that of a tube or bowl
  const Vector3& rotation() const { return m_rotation; }  ///< degrees about the scene's x, then y, then z
  bool isTurned() const { return m_rotation != Vector3::Zero(); }
  const Matrix3& axes() const { return m_axes; }  ///< its own, as columns
  Vector3 toScene(const Vector3& own) const { return m_middle + m_axes * own; }
  Vector3 toOwn(const Vector3& place) const { return m_axes.transpose() * (place - m_middle); }
  /// m, along the scene's axes, about its middle.
  Vector3 extent() const { return m_axes.cwiseAbs() * m_size; }
  /// Whether a place along its own axes, in m, lies in it. Not of a mesh: core/geometry knows that.
  bool holds(const Vector3& own) const;
  /// m, along its own axes, of what fills it evenly; of a mesh with holes as far as its triangles enclose something.
  Vector3 centroid() const;
  /// m3. Of a mesh: what its triangles enclose, at this size; of a sheet, a rope or the surface of a hollow mesh that
  /// is `layer` m thick.
  double volume(double layer = 0) const;
  /// Sheets and ropes.
  bool isThin() const { return m_kind == Kind::Sheet || m_kind == Kind::Rope; }
  /// A mesh that is its surface alone.
  bool isHollow() const { return m_isHollow; }
  bool isOneLayer() const { return isThin() || isHollow(); }  ///< one particle thick
  /// Of a rope, m along its own axes, two at least.
  const std::vector<Vector3>& points() const { return m_points; }
  /// Whether a particle of a sheet or rope is held where it starts, by its parameter `held`.
  bool isHeld(const Vector3& own, double spacing) const;

 private:
  Kind m_kind;
  Vector3 m_size, m_middle, m_rotation;
  double m_wall = 0;
  std::vector<Vector3> m_points;
  double m_thickness = 0;  ///< m, of a rope, for brushes
  int m_heldEnds = 0;
  bool m_isHollow = false;
  Matrix3 m_axes;
  std::shared_ptr<const SceneMesh> m_mesh;
};

/// Corners of the box around a mesh, m.
struct MeshBounds {
  Vector3 minimum, maximum;
};
MeshBounds boundsOf(const SceneMesh& mesh);
/// "" or what makes it no mesh: "point 3 is no place in space", "triangle 7 has a corner that does not exist".
std::string problemOf(const SceneMesh& mesh);
/// m3 that its triangles enclose, by the divergence theorem; below 0 where they are seen from inside. Of an open mesh
/// it depends on where the holes are.
double signedVolume(const SceneMesh& mesh);
/// m2 of all triangles, with each axis at `scale` times its length.
double areaOf(const SceneMesh& mesh, const Vector3& scale);

}  // namespace ps
