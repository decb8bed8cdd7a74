#include "voxel/statics/force_balance.h"

#include <algorithm>
#include <cmath>

#include "voxel/engine/rest_lengths.h"
#include "voxel/statics/static_coupling.h"

namespace menger::voxel {
namespace {

using Eigen::Matrix3d;

std::vector<std::optional<std::size_t>> free_positions(const StaticBody& body, const Supports& supports) {
  std::vector<std::optional<std::size_t>> positions(body.rest.size());
  std::vector<bool> fixed(body.voxel_count(), false);
  for (const std::size_t voxel : supports.fixed_voxels) fixed.at(voxel) = true;
  std::size_t next = 0;
  for (std::size_t voxel = 0; voxel < fixed.size(); ++voxel) {
    if (!fixed[voxel]) positions[voxel] = next++;
  }
  return positions;
}

NodeLoad joined(const Vector3<double>& force, const Vector3<double>& moment) {
  NodeLoad load;
  load << force.x, force.y, force.z, moment.x, moment.y, moment.z;
  return load;
}

}  // namespace

ForceBalance::ForceBalance(const StaticBody& body, const Supports& supports)
    : body_(&body),
      force_scale_(*std::max_element(body.parameters.axial_Pa.begin(), body.parameters.axial_Pa.end()) * body.edge_m *
                   body.edge_m),
      free_(free_positions(body, supports)),
      coupled_(body.parameters.lateral_coupling > 0.0 ? coupled_beams(body) : std::vector<std::array<std::size_t, 2>>{}) {
  for (std::size_t node = 0; node < free_.size(); ++node) {
    if (free_[node]) free_nodes_.push_back(node);
  }
  for (std::size_t voxel = 0; supports.ground && voxel < body.voxel_count(); ++voxel)
    feet_.push_back(wall_feet(body.lattice, body.voxels, voxel));
}

void ForceBalance::lay_down_stiffness() {
  stiffness_.emplace(free_nodes_.size(), pattern());
  for (std::size_t i = 0; i < body_->beams.size(); ++i) beam_places_.push_back(places_of(i, i));
  for (const auto& [first, second] : coupled_) coupled_places_.push_back(places_of(first, second));
}

std::vector<std::array<std::size_t, 2>> ForceBalance::pattern() const {
  std::vector<std::array<std::size_t, 2>> blocks;
  const auto add = [&](const StaticBeam& rows, const StaticBeam& columns) {
    for (const std::size_t row : {rows.lower, rows.upper}) {
      for (const std::size_t column : {columns.lower, columns.upper}) {
        if (free_[row] && free_[column]) blocks.push_back({*free_[row], *free_[column]});
      }
    }
  };
  for (const StaticBeam& beam : body_->beams) add(beam, beam);
  for (const auto& [first, second] : coupled_) add(body_->beams[first], body_->beams[second]);
  return blocks;
}

ForceBalance::BlockPlaces ForceBalance::places_of(std::size_t row_beam, std::size_t column_beam) const {
  const StaticBeam& rows = body_->beams[row_beam];
  const StaticBeam& columns = body_->beams[column_beam];
  BlockPlaces places;
  std::size_t next = 0;
  for (const std::size_t row : {rows.lower, rows.upper}) {
    for (const std::size_t column : {columns.lower, columns.upper}) {
      if (free_[row] && free_[column]) places[next] = stiffness_->place(*free_[row], *free_[column]);
      ++next;
    }
  }
  return places;
}

bool ForceBalance::set_loads(const StaticLoads& loads) {
  std::optional<DrivenSizes> sizes = driven_sizes(*body_, loads.pressures_Pa);
  if (!sizes) return false;
  sizes_ = std::move(*sizes);
  loads_ = loads;
  rest_length_.clear();
  half_kink_.clear();
  rest_length_.reserve(body_->beams.size());
  half_kink_.reserve(body_->beams.size());
  for (const StaticBeam& beam : body_->beams) {
    rest_length_.push_back(body_->rest_length(sizes_, beam));
    half_kink_.push_back(body_->half_kink(sizes_, beam));
  }
  return true;
}

StaticState ForceBalance::state_at_rest() const { return {body_->rest, std::vector<char>(body_->beams.size(), 1)}; }

void ForceBalance::place_plates(StaticState& state) const {
  for (std::size_t place = 0; place < body_->places.size(); ++place) {
    const std::size_t plate = body_->places[place].plate;
    const PlateMotion motion = plate < loads_.plates.size() ? loads_.plates[plate] : PlateMotion{};
    const Quaternion<double> turn = quaternion_of(motion.rotation);
    const std::size_t node = body_->voxel_count() + place;
    const Vector3<double> centre = body_->plates[plate].centre;
    state.poses[node] = {centre + motion.displacement + rotate(matrix(turn), body_->rest[node].position - centre), turn};
  }
}

void ForceBalance::move(StaticState& state, const Eigen::VectorXd& step) const {
  for (std::size_t i = 0; i < free_nodes_.size(); ++i) {
    const auto s = step.segment<6>(6 * static_cast<Eigen::Index>(i));
    Pose& pose = state.poses[free_nodes_[i]];
    pose.position = pose.position + body_->edge_m * Vector3<double>{s[0], s[1], s[2]};
    Quaternion<double> q = quaternion_of(Vector3<double>{s[3], s[4], s[5]}) * pose.orientation;
    const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    pose.orientation = {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
  }
}

bool ForceBalance::update_beam_states(StaticState& state, bool only_to_large) const {
  bool changed = false;
  for (std::size_t i = 0; i < body_->beams.size(); ++i) {
    if (only_to_large && state.small[i] == 0) continue;
    const StaticBeam& beam = body_->beams[i];
    const BeamEnds<double> ends =
        beam_ends(state.poses[beam.lower], state.poses[beam.upper], beam.axis, rest_length_[i], half_kink_[i]);
    const char now = published_state(ends, static_cast<double>(state.small[i])).small ? 1 : 0;
    changed = changed || now != state.small[i];
    state.small[i] = now;
  }
  return changed;
}

std::optional<Eigen::Index> ForceBalance::first_unknown(std::size_t node) const {
  if (!free_[node]) return std::nullopt;
  return 6 * static_cast<Eigen::Index>(*free_[node]);
}

Eigen::VectorXd ForceBalance::linearise(const StaticState& state) {
  if (!stiffness_) lay_down_stiffness();
  stiffness_->set_zero();
  return scaled(sum_loads(state, &*stiffness_));
}

Eigen::VectorXd ForceBalance::masses() const {
  Eigen::VectorXd masses(unknown_count());
  for (std::size_t i = 0; i < free_nodes_.size(); ++i) {
    const Eigen::Index at = 6 * static_cast<Eigen::Index>(i);
    const double per = 1.0 / (force_scale_ * body_->edge_m);
    masses.segment<3>(at).setConstant(body_->mass_kg[free_nodes_[i]] * body_->edge_m * body_->edge_m * per);
    masses.segment<3>(at + 3).setConstant(body_->inertia_kg_m2[free_nodes_[i]] * per);
  }
  return masses;
}

std::vector<NodeLoad> ForceBalance::sum_loads(const StaticState& state, BlockMatrix* stiffness) const {
  std::vector<NodeLoad> loads(body_->rest.size(), NodeLoad::Zero());
  for (std::size_t beam = 0; beam < body_->beams.size(); ++beam) add_beam(state, beam, loads, stiffness);
  if (!coupled_.empty()) add_coupling(state, loads, stiffness);
  add_weight_and_ground(state, loads, stiffness);
  for (const PointLoad& point : loads_.points) loads[point.voxel] += joined(point.force, point.moment);
  return loads;
}

void ForceBalance::add_beam(const StaticState& state, std::size_t index, std::vector<NodeLoad>& loads,
                            BlockMatrix* stiffness) const {
  const StaticBeam& beam = body_->beams[index];
  const BeamEnds<double> ends =
      beam_ends(state.poses[beam.lower], state.poses[beam.upper], beam.axis, rest_length_[index], half_kink_[index]);
  const bool small = state.small[index] != 0;
  EndLoads on_ends;
  if (stiffness == nullptr) {
    on_ends = beam_end_loads(ends, small, beam.coefficients, beam.axis);
  } else {
    const BeamTangent tangent = beam_tangent(ends, small, beam.coefficients, beam.axis, body_->edge_m);
    on_ends = tangent.loads;
    const double edge = body_->edge_m;
    Eigen::Matrix<double, 12, 1> scale;
    scale << edge, edge, edge, 1.0, 1.0, 1.0, edge, edge, edge, 1.0, 1.0, 1.0;
    const Eigen::Matrix<double, 12, 12> k = scale.asDiagonal() * tangent.stiffness * scale.asDiagonal() / (force_scale_ * edge);
    const BlockPlaces& places = beam_places_[index];
    for (std::size_t block = 0; block < 4; ++block) {
      if (!places[block]) continue;
      stiffness->add(*places[block], 0, 0,
                     k.block<6, 6>(static_cast<Eigen::Index>(block / 2 * 6), static_cast<Eigen::Index>(block % 2 * 6)));
    }
  }
  loads[beam.lower] += on_ends.head<6>();
  loads[beam.upper] += on_ends.tail<6>();
}

void ForceBalance::add_coupling(const StaticState& state, std::vector<NodeLoad>& loads, BlockMatrix* stiffness) const {
  const std::vector<CouplingSpring> springs = coupling_springs(*body_, state.poses, rest_length_);
  const double scale = body_->edge_m / force_scale_;
  const auto add = [&](const BlockPlaces& places, const Matrix3d& k) {
    for (std::size_t block = 0; block < 4; ++block) {
      // Equal ends (lower-lower, upper-upper) have positive stiffness, unequal ends negative.
      if (places[block]) stiffness->add(*places[block], 0, 0, (block == 0 || block == 3 ? scale : -scale) * k);
    }
  };
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const CouplingSpring& spring = springs[i];
    const Eigen::Vector3d force = spring.tension * spring.direction;
    loads[body_->beams[i].lower].head<3>() += force;
    loads[body_->beams[i].upper].head<3>() -= force;
    if (stiffness == nullptr || !(spring.length > 0.0)) continue;
    add(beam_places_[i],
        spring.tension / spring.length * (Matrix3d::Identity() - spring.direction * spring.direction.transpose()));
  }
  if (stiffness == nullptr) return;
  for (std::size_t pair = 0; pair < coupled_.size(); ++pair) {
    const CouplingSpring& first = springs[coupled_[pair][0]];
    const CouplingSpring& second = springs[coupled_[pair][1]];
    add(coupled_places_[pair],
        body_->parameters.lateral_coupling * first.weight * second.weight * first.direction * second.direction.transpose());
  }
}

std::vector<ForceBalance::PressedFoot> ForceBalance::pressed_feet(const StaticState& state, std::size_t voxel) const {
  if (feet_.empty()) return {};
  const HollowVoxels& voxels = body_->voxels;
  const std::array<double, 3> half_lengths_m = body_->foot_half_lengths(sizes_, voxel);
  const auto bulge_of = [&](std::size_t other, std::size_t axis) {
    const double mean = body_->bulge(sizes_, other, axis);
    return WallBulge{.mean = mean, .peak = mean * body_->parameters.bulge_peak_ratio_of(voxels.bulge_class[other][axis])};
  };
  const Pose& pose = state.poses[voxel];
  const Rotation<double> turn = matrix(pose.orientation);
  std::vector<PressedFoot> pressed;
  for (const WallFoot& foot : feet_[voxel]) {
    const Vector3<double> arm = rotate(turn, place_of(foot, half_lengths_m, stands_out_m(foot, bulge_of)));
    const double depth = -(pose.position.z + arm.z);
    const double stiffness = foot.share / feet_of_a_wall * body_->parameters.ground_stiffness_N_per_m;
    if (depth > 0.0) pressed.push_back({arm, stiffness, stiffness * depth});
  }
  return pressed;
}

double ForceBalance::ground_force(const StaticState& state, std::size_t voxel) const {
  double sum = 0.0;
  for (const PressedFoot& foot : pressed_feet(state, voxel)) sum += foot.push;
  return sum;
}

void ForceBalance::add_weight_and_ground(const StaticState& state, std::vector<NodeLoad>& loads, BlockMatrix* stiffness) const {
  constexpr Eigen::Index z = 2;
  const double edge = body_->edge_m;
  for (std::size_t voxel = 0; voxel < body_->voxel_count(); ++voxel) {
    loads[voxel][z] -= body_->mass_kg[voxel] * loads_.gravity_m_s2;
    for (const auto& [arm, foot_stiffness, push] : pressed_feet(state, voxel)) {
      // Derivative of the foot's height with respect to the displacement along z and the rotations about x, y and z.
      const Eigen::Vector4d rise{1.0, arm.y, -arm.x, 0.0};
      loads[voxel].tail<4>() += push * rise;
      if (stiffness == nullptr || !free_[voxel]) continue;
      Eigen::Matrix4d k = foot_stiffness * rise * rise.transpose();
      k(1, 1) += push * arm.z;
      k(2, 2) += push * arm.z;
      k(1, 3) -= push * arm.x;
      k(2, 3) -= push * arm.y;
      const Eigen::Vector4d scale{edge, 1.0, 1.0, 1.0};
      const Eigen::Matrix4d scaled_k = scale.asDiagonal() * k * scale.asDiagonal() / (force_scale_ * edge);
      stiffness->add(stiffness->place(*free_[voxel], *free_[voxel]), z, z, scaled_k);
    }
  }
}

Eigen::VectorXd ForceBalance::scaled(const std::vector<NodeLoad>& loads) const {
  Eigen::VectorXd result(unknown_count());
  for (std::size_t i = 0; i < free_nodes_.size(); ++i) {
    const NodeLoad& load = loads[free_nodes_[i]];
    const Eigen::Index at = 6 * static_cast<Eigen::Index>(i);
    result.segment<3>(at) = load.head<3>() / force_scale_;
    result.segment<3>(at + 3) = load.tail<3>() / (force_scale_ * body_->edge_m);
  }
  return result;
}

}  // namespace menger::voxel
