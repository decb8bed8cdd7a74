#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/statics/grips.h"
#include "meshes/load_cases/body_extents.h"

namespace menger::fem {

/// The ends of a body: the faces that lie in the planes of its bounding box, by their mean positions over the reference area.
/// All members are collective and give the same on all ranks. Displacements are 3 per local node, ghosts up to date.
class BodyEnds {
 public:
  /// @param low, high corners of the bounding box in the reference configuration @param space must outlive this
  BodyEnds(const Space& space, const Point& low, const Point& high);

  /// Whether every plane of the box holds faces; where one does not (a curved body), nothing below may be asked (asserts).
  [[nodiscard]] bool are_faces() const { return are_faces_; }

  [[nodiscard]] const meshes::EndPoints& at_rest() const { return at_rest_; }
  [[nodiscard]] meshes::EndPoints deformed(std::span<const double> displacements_m) const;

  /// Growth of the distance between the ends along each axis.
  [[nodiscard]] Point extent_changes_m(std::span<const double> displacements_m) const;

  /// The same after the rotation of the body is taken out (see meshes::extents_without_rotation): independent of how the rigid
  /// motions of a free body are held.
  [[nodiscard]] Point extent_changes_without_rotation_m(std::span<const double> displacements_m) const;

 private:
  std::vector<std::array<FaceMean, 2>> ends_;  ///< low and high, by axis
  bool are_faces_ = true;
  meshes::EndPoints at_rest_{};
};

}  // namespace menger::fem
