#include "fem/statics/body_ends.h"

#include <cassert>

namespace menger::fem {

BodyEnds::BodyEnds(const Space& space, const Point& low, const Point& high) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto end = [&](double position_m) { return FaceMean({.plane = AxisPlane{axis, position_m}}, space); };
    ends_.push_back({end(low[axis]), end(high[axis])});
    for (const FaceMean& faces : ends_.back()) are_faces_ = are_faces_ && faces.area_m2() > 0.0;
  }
  if (!are_faces_) return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2; ++side) at_rest_[axis][side] = ends_[axis][side].position_m();
}

meshes::EndPoints BodyEnds::deformed(std::span<const double> displacements_m) const {
  assert(are_faces_);
  meshes::EndPoints ends = at_rest_;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2; ++side)
      ends[axis][side] = sum(ends[axis][side], ends_[axis][side].displacement_m(displacements_m));
  return ends;
}

Point BodyEnds::extent_changes_m(std::span<const double> displacements_m) const {
  assert(are_faces_);
  Point changes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& [low, high] = ends_[axis];
    changes[axis] = high.displacement_m(displacements_m)[axis] - low.displacement_m(displacements_m)[axis];
  }
  return changes;
}

Point BodyEnds::extent_changes_without_rotation_m(std::span<const double> displacements_m) const {
  // The same function on both sides, so that the result at rest is exactly zero in spite of rounding.
  return difference(meshes::extents_without_rotation(at_rest_, deformed(displacements_m)),
                    meshes::extents_without_rotation(at_rest_, at_rest_));
}

}  // namespace menger::fem
