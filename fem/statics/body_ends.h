#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/statics/grips.h"
#include "meshes/load_cases/body_extents.h"

namespace menger::fem {

/// The ends of a body, as mean positions of the faces that lie in the planes of its bounding box. The means are weighted by the
/// reference area. All members are collective and return the same on all ranks. Displacements are 3 per local node, ghosts up to
/// date.
class BodyEnds {
 public:
  /// @param low, high corners of the bounding box in the reference configuration @param space must outlive this
  BodyEnds(const Space& space, const Point& low, const Point& high);

  /// Whether every plane of the box contains faces. If one does not (a curved body), no member below may be called (asserts).
  [[nodiscard]] bool are_faces() const { return are_faces_; }

  [[nodiscard]] const meshes::EndPoints& at_rest() const { return at_rest_; }
  [[nodiscard]] meshes::EndPoints deformed(std::span<const double> displacements_m) const;

  /// The increase of the distance between the two ends along each axis.
  [[nodiscard]] Point extent_changes_m(std::span<const double> displacements_m) const;

  /// The increase of the distances after the rotation of the body is removed (see meshes::extents_without_rotation). It does not
  /// depend on how the rigid motions of a free body are held.
  [[nodiscard]] Point extent_changes_without_rotation_m(std::span<const double> displacements_m) const;

 private:
  std::vector<std::array<FaceMean, 2>> ends_;  ///< low and high, by axis
  bool are_faces_ = true;
  meshes::EndPoints at_rest_{};
};

}  // namespace menger::fem
