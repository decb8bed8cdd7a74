#include "voxel/statics/body_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "meshes/load_cases/body_feet.h"
#include "meshes/load_cases/body_top.h"
#include "voxel/model/wall_squares.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {
namespace {

using meshes::Side;

Side side_of(std::size_t axis, bool is_max) { return static_cast<Side>(2 * axis + (is_max ? 1 : 0)); }

double coordinate(const Vector3<double>& v, std::size_t axis) { return std::array{v.x, v.y, v.z}[axis]; }

std::array<double, 3> place(const Vector3<double>& v) { return {v.x, v.y, v.z}; }

/// The cells of the body, in the order of its voxels.
std::vector<std::array<int, 3>> cells_of(const StaticBody& body) {
  std::vector<std::array<int, 3>> cells;
  cells.reserve(body.lattice.cells.size());
  for (const auto& [x, y, z] : body.lattice.cells) cells.push_back({x, y, z});
  return cells;
}

}  // namespace

BodyShape::BodyShape(const StaticBody& body, const DrivenSizes& sizes, const std::vector<Pose>& poses)
    : body_(&body), sizes_(&sizes), poses_(&poses) {}

BodyShape::BodyShape(const Equilibrium& equilibrium)
    : BodyShape(equilibrium.balance().body(), equilibrium.balance().sizes(), equilibrium.state().poses) {}

double BodyShape::rest_length(std::size_t beam) const { return body_->rest_length(*sizes_, body_->beams[beam]); }

double BodyShape::axial_strain(std::size_t beam) const {
  const StaticBeam& ends = body_->beams[beam];
  const Vector3<double> separation = (*poses_)[ends.upper].position - (*poses_)[ends.lower].position;
  return std::sqrt(dot(separation, separation)) / rest_length(beam) - 1.0;
}

double BodyShape::half_length(std::size_t voxel, Side side) const {
  const auto& beams = body_->beam_at[voxel];
  if (const auto beam = beams[static_cast<std::size_t>(side)]) {
    const StaticBeam& ends = body_->beams[*beam];
    const bool whole = body_->is_voxel(ends.lower) && body_->is_voxel(ends.upper);
    return (whole ? 0.5 : 1.0) * rest_length(*beam) * (1.0 + axial_strain(*beam));
  }
  const std::size_t axis = meshes::axis_of(side);
  double across = 0.0;
  for (std::size_t other = 0; other < 6; ++other) {
    if (other / 2 != axis && beams[other]) across += 0.5 * axial_strain(*beams[other]);
  }
  return body_->half_length(*sizes_, voxel, static_cast<std::size_t>(side)) * (1.0 - body_->parameters.lateral_coupling * across);
}

double BodyShape::bulge(std::size_t voxel, Side side) const {
  const auto at = static_cast<std::size_t>(side);
  if (!body_->voxels.walled[voxel][at] || body_->beam_at[voxel][at]) return 0.0;
  return body_->bulge(*sizes_, voxel, meshes::axis_of(side));
}

Vector3<double> BodyShape::face(std::size_t voxel, Side side, double bulge_factor) const {
  const double distance = half_length(voxel, side) + bulge_factor * bulge(voxel, side);
  const double away = meshes::is_max(side) ? distance : -distance;
  std::array<double, 3> normal{};
  normal[meshes::axis_of(side)] = away;
  const Pose& pose = (*poses_)[voxel];
  return pose.position + rotate(matrix(pose.orientation), Vector3<double>{normal[0], normal[1], normal[2]});
}

Vector3<double> BodyShape::mean_of_faces(Side side) const {
  const std::vector<std::size_t> voxels = body_->end_voxels(side);
  Vector3<double> sum{0.0, 0.0, 0.0};
  for (const std::size_t voxel : voxels) sum = sum + face(voxel, side);
  return (1.0 / static_cast<double>(voxels.size())) * sum;
}

bool BodyShape::ends_at_wall(std::size_t voxel, const std::array<int, 2>& towards) const {
  for (std::size_t axis = 0; axis < towards.size(); ++axis) {
    const auto side = static_cast<std::size_t>(side_of(axis, towards.at(axis) > 0));
    if (towards.at(axis) != 0 && body_->voxels.walled[voxel][side]) return true;
  }
  return false;
}

Vector3<double> BodyShape::rim_of_top(std::size_t voxel, const std::array<int, 2>& towards) const {
  const auto out = [&](std::size_t axis) { return towards.at(axis) * half_length(voxel, side_of(axis, towards.at(axis) > 0)); };
  const Pose& pose = (*poses_)[voxel];
  return pose.position + rotate(matrix(pose.orientation), Vector3<double>{out(0), out(1), half_length(voxel, Side::z_max)});
}

double BodyShape::bulge_factor_of_top(std::size_t voxel, const std::array<int, 2>& towards) const {
  const std::size_t law_class = body_->voxels.bulge_class[voxel][2];
  const double crown = body_->parameters.bulge_peak_ratio_of(law_class);
  if (wall_class_of(law_class) != walls::corner) return crown;
  // The crown of a square lies at its middle, at the inner corner of this face. Under pressure the wall is about a parabola
  // between the walls beside it.
  const double edge_m = body_->edge_m;
  const double wall_m = std::min(body_->parameters.wall_thickness_m, 0.5 * edge_m);
  const double share =
      (0.5 * edge_m - wall_m) / (2.0 * (edge_m - wall_m));  // of the span between them, at the middle of the face
  const double halfway = 4.0 * share * (1.0 - share);
  for (const int inner_x : {-1, 1}) {
    for (const int inner_y : {-1, 1}) {
      const auto beside = static_cast<std::size_t>(side_of(0, inner_x > 0));
      const auto behind = static_cast<std::size_t>(side_of(1, inner_y > 0));
      if (!plate_beside(body_->lattice, body_->voxels, voxel, static_cast<std::size_t>(Side::z_max), beside, behind)) continue;
      if (towards[0] == -inner_x || towards[1] == -inner_y) return 1.0;  // where an arm leaves the square: about the mean
      return crown * (towards[0] == 0 ? halfway : 1.0) * (towards[1] == 0 ? halfway : 1.0);
    }
  }
  return crown;
}

Vector3<double> BodyShape::middle_of_top() const {
  const meshes::BodyTop top = meshes::top_of(cells_of(*body_));
  bool is_rim = false;
  for (std::size_t n = 0; n < top.cells.size(); ++n) is_rim = is_rim || ends_at_wall(top.cells[n], top.towards[n]);
  Vector3<double> sum{0.0, 0.0, 0.0};
  for (std::size_t n = 0; n < top.cells.size(); ++n) {
    const std::size_t voxel = top.cells[n];
    if (is_rim && !top.is_open) {
      sum = sum + rim_of_top(voxel, top.towards[n]);
    } else {
      sum = sum + face(voxel, Side::z_max, top.is_open ? 0.0 : bulge_factor_of_top(voxel, top.towards[n]));
    }
  }
  return (1.0 / static_cast<double>(top.cells.size())) * sum;
}

double BodyShape::extent(std::size_t axis) const {
  return coordinate(mean_of_faces(side_of(axis, true)) - mean_of_faces(side_of(axis, false)), axis);
}

double BodyShape::top_height() const { return middle_of_top().z - mean_of_faces(Side::z_min).z; }

BodyShape::Ends BodyShape::ends() const {
  Ends ends;
  for (const Side side : meshes::all_sides) {
    const std::size_t axis = meshes::axis_of(side);
    const std::size_t end = meshes::is_max(side) ? 1 : 0;
    ends.deformed[axis][end] = place(mean_of_faces(side));
    const std::vector<std::size_t> voxels = body_->end_voxels(side);
    Vector3<double> sum{0.0, 0.0, 0.0};
    for (const std::size_t voxel : voxels) sum = sum + body_->rest[voxel].position;
    ends.at_rest[axis][end] = place((1.0 / static_cast<double>(voxels.size())) * sum);
    ends.at_rest[axis][end][axis] = meshes::is_max(side) ? body_->box_m[axis] : 0.0;
  }
  return ends;
}

BodyShape::FreeSize BodyShape::free_size() const {
  const auto [at_rest, deformed] = ends();
  const auto rotation = meshes::rotation_of_body(at_rest, deformed);
  const Vector3<double> top = middle_of_top() - mean_of_faces(Side::z_min);
  // the last row of the transpose
  const double height = rotation[0][2] * top.x + rotation[1][2] * top.y + rotation[2][2] * top.z;
  return {.extents = meshes::extents_without_rotation(at_rest, deformed), .top_height = height};
}

std::vector<double> BodyShape::feet_outwards() const {
  std::vector<std::array<double, 3>> at_rest;
  std::vector<std::array<double, 3>> deformed;
  for (const std::vector<std::size_t>& foot : meshes::feet_of(cells_of(*body_))) {
    Vector3<double> before{0.0, 0.0, 0.0};
    Vector3<double> after{0.0, 0.0, 0.0};
    for (const std::size_t voxel : foot) {
      before = before + body_->rest[voxel].position;
      after = after + face(voxel, Side::z_min);
    }
    const double share = 1.0 / static_cast<double>(foot.size());
    at_rest.push_back(place(share * before));
    deformed.push_back(place(share * after));
  }
  const auto [ends_at_rest, ends_deformed] = ends();
  return meshes::feet_outwards_m(at_rest, deformed, ends_at_rest, ends_deformed);
}

/// The thickness of a wall that lies on the voxel's side of its face.
double BodyShape::wall_within(std::size_t voxel, Side side) const {
  const bool is_shared = body_->voxels.shared[voxel][static_cast<std::size_t>(side)];
  return (is_shared ? 0.5 : 1.0) * body_->parameters.wall_thickness_m;
}

double BodyShape::clearance(std::size_t voxel, std::size_t axis) const {
  const Side low = side_of(axis, false);
  const Side high = side_of(axis, true);
  const auto above = static_cast<std::size_t>(high);
  double depth = bulge(voxel, low) - wall_within(voxel, low);
  for (std::size_t at = voxel;;) {
    depth += half_length(at, low) + half_length(at, high);
    if (body_->voxels.walled[at][above]) return depth + bulge(at, high) - wall_within(at, high);
    at = body_->beams[*body_->beam_at[at][above]].upper;
  }
}

std::optional<BodyShape::WallContact> BodyShape::wall_contact() const {
  for (std::size_t voxel = 0; voxel < body_->voxel_count(); ++voxel) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool begins = body_->voxels.walled[voxel][2 * axis];
      if (begins && clearance(voxel, axis) <= 0.0) return WallContact{voxel, axis};
    }
  }
  return std::nullopt;
}

double BodyShape::tip_height() const { return mean_of_faces(Side::x_max).z; }

double BodyShape::voxel_volume(std::size_t voxel) const {
  std::array<double, 3> length{};
  std::array<double, 3> bulges{};
  for (const Side side : meshes::all_sides) {
    const std::size_t axis = meshes::axis_of(side);
    length[axis] += half_length(voxel, side);
    bulges[axis] += body_->parameters.volume_ratio_of(body_->voxels.bulge_class[voxel][axis]) * bulge(voxel, side);
  }
  return length[0] * length[1] * length[2] + bulges[0] * length[1] * length[2] + length[0] * bulges[1] * length[2] +
         length[0] * length[1] * bulges[2];
}

double BodyShape::chamber_volume_change() const {
  const double at_rest = body_->edge_m * body_->edge_m * body_->edge_m;
  double chambers = 0.0;
  double growth = 0.0;
  for (std::size_t voxel = 0; voxel < body_->voxel_count(); ++voxel) {
    chambers += at_rest - body_->voxels.wall_volume_m3[voxel];
    growth += voxel_volume(voxel) - at_rest;
  }
  return growth / chambers;
}

}  // namespace menger::voxel
