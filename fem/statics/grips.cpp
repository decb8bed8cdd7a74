#include "fem/statics/grips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "fem/space/face_area.h"

namespace menger::fem {

namespace {

constexpr double plane_tolerance = 1e-9;  ///< relative to the extent of a face

/// The displacement of the end of a bar that bends into an arc: (1 - cos a) / a and sin(a) / a - 1, without cancellation at small
/// angles.
Point arc(double length_m, double angle_rad) {
  if (std::abs(angle_rad) < 1e-4) {  // the next terms of the series are below rounding
    const double square = angle_rad * angle_rad;
    return {-length_m * square / 6.0, 0.0, -length_m * angle_rad * (0.5 - square / 24.0)};
  }
  const double half = std::sin(0.5 * angle_rad);
  return {length_m * (std::sin(angle_rad) / angle_rad - 1.0), 0.0, -length_m * 2.0 * half * half / angle_rad};
}

}  // namespace

PlateMotion motion_at(const PlateDrive& drive, double s) {
  if (drive.values.empty()) return {};
  const double clamped = std::clamp(s, 0.0, static_cast<double>(drive.values.size() - 1));
  const auto leg = std::min(static_cast<std::size_t>(clamped), drive.values.size() < 2 ? 0 : drive.values.size() - 2);
  const double part = clamped - static_cast<double>(leg);
  PlateMotion motion = drive.values[leg];
  if (part > 0.0) {
    const PlateMotion& next = drive.values[leg + 1];
    for (std::size_t i = 0; i < 3; ++i) {
      motion.displacement_m[i] = (1.0 - part) * motion.displacement_m[i] + part * next.displacement_m[i];
      motion.rotation_rad[i] = (1.0 - part) * motion.rotation_rad[i] + part * next.rotation_rad[i];
    }
  }
  if (drive.arc_length_m > 0.0)
    motion.displacement_m = sum(motion.displacement_m, arc(drive.arc_length_m, motion.rotation_rad[1]));
  return motion;
}

Point plate_displacement(const Plate& plate, const PlateMotion& motion, const Point& position) {
  const double angle = norm(motion.rotation_rad);
  if (angle == 0.0) return motion.displacement_m;
  const Eigen::Vector3d axis = Eigen::Vector3d(motion.rotation_rad.data()) / angle;
  const Point from_centre = difference(position, plate.centre);
  const Eigen::Vector3d lever(from_centre.data());
  // R X - X = sin(a) n x X + (1 - cos(a)) n x (n x X), exact also at small angles
  const Eigen::Vector3d turned = axis.cross(lever);
  const double half = std::sin(0.5 * angle);
  const Eigen::Vector3d change = std::sin(angle) * turned + 2.0 * half * half * axis.cross(turned);
  return sum(motion.displacement_m, {change[0], change[1], change[2]});
}

bool contains(const FaceSet& set, const Space& space, const SpaceFace& face) {
  if (set.label && *set.label != face.label) return false;
  if (!set.plane) return set.label.has_value();
  const auto coordinate = [&](std::size_t n) {
    return space.positions[static_cast<std::size_t>(face.nodes[n])][set.plane->axis];
  };
  const auto position = [&](std::size_t n) { return space.positions[static_cast<std::size_t>(face.nodes[n])]; };
  const double extent = norm(difference(position(0), position(space.nodes_per_face() - 1)));
  Point middle{};
  for (std::size_t n = 0; n < space.nodes_per_face(); ++n) {
    if (std::abs(coordinate(n) - set.plane->position_m) > plane_tolerance * extent) return false;
    middle = sum(middle, scaled(1.0 / static_cast<double>(space.nodes_per_face()), position(n)));
  }
  const double room = plane_tolerance * extent;
  const auto is_in = [&](const std::array<Point, 2>& box) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (middle[axis] < box[0][axis] - room || middle[axis] > box[1][axis] + room) return false;
    return true;
  };
  return set.boxes.empty() || std::any_of(set.boxes.begin(), set.boxes.end(), is_in);
}

std::vector<Index> owned_nodes_of(const FaceSet& set, const Space& space, const NodeExchange& exchange) {
  std::vector<double> marks(3 * space.positions.size(), 0.0);
  for (const SpaceFace& face : space.faces) {
    if (!contains(set, space, face)) continue;
    for (std::size_t n = 0; n < space.nodes_per_face(); ++n) marks[3 * static_cast<std::size_t>(face.nodes[n])] = 1.0;
  }
  exchange.add_from_ghosts(marks);
  std::vector<Index> nodes;
  for (Index node = 0; node < space.owned_count; ++node)
    if (marks[3 * static_cast<std::size_t>(node)] > 0.0) nodes.push_back(node);
  return nodes;
}

FaceMean::FaceMean(const FaceSet& set, const Space& space) : space_(space) {
  for (const SpaceFace& face : space.faces) {
    if (!contains(set, space, face)) continue;
    const std::vector<double> areas_m2 = nodal_areas_m2(space, face);
    for (std::size_t n = 0; n < areas_m2.size(); ++n) weights_.emplace_back(face.nodes[n], areas_m2[n]);
  }
  for (const auto& [node, weight] : weights_) area_m2_ += weight;
  MPI_Allreduce(MPI_IN_PLACE, &area_m2_, 1, MPI_DOUBLE, MPI_SUM, space.communicator);
}

Point FaceMean::displacement_m(std::span<const double> displacements) const {
  assert(area_m2_ > 0.0);
  Point mean{};
  for (const auto& [node, weight] : weights_) {
    const std::size_t first = 3 * static_cast<std::size_t>(node);
    mean = sum(mean, scaled(weight, {displacements[first], displacements[first + 1], displacements[first + 2]}));
  }
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), 3, MPI_DOUBLE, MPI_SUM, space_.communicator);
  return scaled(1.0 / area_m2_, mean);
}

Point FaceMean::position_m() const {
  std::vector<double> positions;
  positions.reserve(3 * space_.positions.size());
  for (const Point& position : space_.positions) positions.insert(positions.end(), position.begin(), position.end());
  return displacement_m(positions);
}

}  // namespace menger::fem
