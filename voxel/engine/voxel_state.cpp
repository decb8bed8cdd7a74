#include "voxel/engine/voxel_state.h"

#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "voxel/kernels/voxel_step.h"
#include "voxel/model/actuation.h"
#include "voxel/model/elbows.h"
#include "voxel/model/wall_openings.h"

namespace menger::voxel {

namespace {

/// Whether any beam of a calibrated body has a kink under pressure.
bool has_kinks(const Lattice& lattice, const HollowVoxels& voxels, const SurrogateParameters& parameters) {
  if (has_tilted_limbs(wall_openings(lattice, voxels, parameters.voxels_per_cell))) return true;
  return parameters.elbow_ratio > 0.0 && has_elbows(elbow_turns(lattice, voxels, parameters.voxels_per_cell));
}

/// Bodies up to this many edges away from their origin keep it.
constexpr double farthest_edges = 8.0;

template <class Real>
std::size_t padded(std::size_t count) {
  constexpr std::size_t pack = widest_pack<Real>;
  return (count + pack - 1) / pack * pack;
}

/// Writes the coefficients of a class as the numbers of its table row.
template <class Real>
void put_row(Real* row, const VoxelCoefficients<double>& c) {
  const double values[] = {c.inverse_mass,   c.inverse_inertia,         c.weight,
                           c.global_damping, c.global_rotation_damping, c.floor.stiffness,
                           c.floor.damping,  c.floor.static_friction,   c.floor.kinetic_friction};
  for (const double value : values) *row++ = static_cast<Real>(value);
}

template <class Real>
void put_row(Real* row, const BeamCoefficients<double>& c) {
  const double values[] = {
      c.axial,     c.twist,     c.shear,      c.bend,          c.turn,          c.axial_root,      c.shear_root,
      c.bend_root, c.turn_root, c.twist_root, c.damping_lower, c.damping_upper, c.turn_difference, c.turn_difference_root};
  for (const double value : values) *row++ = static_cast<Real>(value);
}

template <class Real>
VoxelCoefficients<Real> rounded(const VoxelCoefficients<double>& c) {
  const auto r = [](double value) { return static_cast<Real>(value); };
  return {r(c.inverse_mass),
          r(c.inverse_inertia),
          r(c.weight),
          r(c.global_damping),
          r(c.global_rotation_damping),
          {r(c.floor.stiffness), r(c.floor.damping), r(c.floor.static_friction), r(c.floor.kinetic_friction)}};
}

std::array<double, 3> mean_of(const std::vector<std::array<double, 3>>& points) {
  std::array<double, 3> mean{};
  for (const auto& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += point[axis] / static_cast<double>(points.size());
  }
  return mean;
}

template <class Real>
BeamCoefficients<Real> rounded(const BeamCoefficients<double>& c) {
  const auto r = [](double value) { return static_cast<Real>(value); };
  return {r(c.axial),
          r(c.twist),
          r(c.shear),
          r(c.bend),
          r(c.turn),
          r(c.axial_root),
          r(c.shear_root),
          r(c.bend_root),
          r(c.turn_root),
          r(c.twist_root),
          r(c.damping_lower),
          r(c.damping_upper),
          r(c.turn_difference),
          r(c.turn_difference_root)};
}

}  // namespace

template <class Real>
VoxelState<Real>::VoxelState(const VoxelBody& body, const VoxelLoads& loads)
    : edge_(body.edge_m), uniform_(body.classes.uniform && !body.hollow) {
  const BodyClasses& classes = body.classes;
  allocate(body.lattice);
  fill_tables(classes);
  place_voxels(body, loads);
  fill_beams(body);
  data.voxel = rounded<Real>(classes.voxel[classes.voxel_class.front()]);
  data.beam = rounded<Real>(classes.beam[classes.beam_of_uniform]);
}

template <class Real>
void VoxelState<Real>::allocate(const Lattice& lattice) {
  data.voxels = lattice.voxel_count();
  data.padded_voxels = padded<Real>(data.voxels);
  all_voxels_ = data.padded_voxels + 4;
  pose_.assign(line_size * all_voxels_, Real(0));
  motion_.assign(line_size * all_voxels_, Real(0));
  load_.assign(line_size * all_voxels_, Real(0));
  residual_.assign(line_size * all_voxels_, Real(0));
  size_base_.assign(all_voxels_, static_cast<Real>(edge_));
  size_sine_.assign(all_voxels_, Real(0));
  size_cosine_.assign(all_voxels_, Real(0));
  voxel_class_.assign(all_voxels_, 0);
  data.pose = pose_.data();
  data.motion = motion_.data();
  data.load = load_.data();
  data.position_residual = residual_.data();
  data.size_base = size_base_.data();
  data.size_sine_part = size_sine_.data();
  data.size_cosine_part = size_cosine_.data();
  data.voxel_class = voxel_class_.data();
}

template <class Real>
void VoxelState<Real>::fill_tables(const BodyClasses& classes) {
  constexpr auto row = static_cast<std::size_t>(class_values);
  voxel_table_.assign(row * classes.voxel.size(), Real(0));
  for (std::size_t c = 0; c < classes.voxel.size(); ++c) put_row(voxel_table_.data() + row * c, classes.voxel[c]);
  beam_table_.assign(row * classes.beam.size(), Real(0));
  for (std::size_t c = 0; c < classes.beam.size(); ++c) put_row(beam_table_.data() + row * c, classes.beam[c]);
  data.voxel_table = voxel_table_.data();
  data.beam_table = beam_table_.data();
}

template <class Real>
std::array<double, 3> VoxelState<Real>::position_m(std::size_t voxel) const {
  std::array<double, 3> position{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t at = line_size * voxel + axis;
    position[axis] = origin_[axis] + (static_cast<double>(pose_[at]) - static_cast<double>(residual_[at]));
  }
  return position;
}

/// Returns three numbers of a voxel's motion times a coefficient of its class.
template <class Real>
std::array<double, 3> VoxelState<Real>::rate_of(std::size_t voxel, int first, int inverse) const {
  const Real* motion = motion_.data() + line_size * voxel + first;
  const Real* coefficients = voxel_table_.data() + line_size * static_cast<std::size_t>(voxel_class_[voxel]);
  const auto factor = static_cast<double>(coefficients[inverse]);
  return {factor * static_cast<double>(motion[0]), factor * static_cast<double>(motion[1]),
          factor * static_cast<double>(motion[2])};
}

template <class Real>
std::array<double, 3> VoxelState<Real>::velocity_m_s(std::size_t voxel) const {
  return rate_of(voxel, slot::px, class_slot::inverse_mass);
}

template <class Real>
std::array<double, 3> VoxelState<Real>::angular_velocity_rad_s(std::size_t voxel) const {
  return rate_of(voxel, slot::hx, class_slot::inverse_inertia);
}

template <class Real>
void VoxelState<Real>::put_position(std::size_t voxel, const std::array<double, 3>& world_m) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t at = line_size * voxel + axis;
    const double from_origin = world_m[axis] - origin_[axis];
    pose_[at] = static_cast<Real>(from_origin);
    residual_[at] = static_cast<Real>(static_cast<double>(pose_[at]) - from_origin);
  }
}

template <class Real>
bool VoxelState<Real>::move_origin(const std::vector<std::array<double, 3>>& positions_m) {
  const std::array<double, 3> middle = mean_of(positions_m);
  bool moved = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double way = middle[axis] - grid_middle_[axis] - origin_[axis];
    if (!(std::abs(way) > farthest_edges * edge_)) continue;
    origin_[axis] += way;
    moved = true;
  }
  return moved;
}

template <class Real>
bool VoxelState<Real>::is_far(const std::array<double, 3>& middle_m) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(middle_m[axis] - grid_middle_[axis]) > farthest_edges * edge_) return true;
  }
  return false;
}

template <class Real>
bool VoxelState<Real>::take_origin_along() {
  std::vector<std::array<double, 3>> positions;
  positions.reserve(data.voxels);
  for (std::size_t i = 0; i < data.voxels; ++i) positions.push_back(position_m(i));
  if (!move_origin(positions)) return false;
  for (std::size_t i = 0; i < data.voxels; ++i) put_position(i, positions[i]);
  return true;
}

template <class Real>
void VoxelState<Real>::place_on_grid(const Lattice& lattice, const std::vector<std::array<double, 3>>& displacements_m) {
  std::vector<std::array<double, 3>> positions;
  positions.reserve(data.voxels);
  for (const meshes::CellIndex& cell : lattice.cells)
    positions.push_back(
        {edge_ * static_cast<double>(cell.x), edge_ * static_cast<double>(cell.y), edge_ * static_cast<double>(cell.z)});
  grid_middle_ = mean_of(positions);
  for (std::size_t i = 0; i < displacements_m.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) positions[i][axis] += displacements_m[i][axis];
  }
  if constexpr (std::is_same_v<Real, float>) static_cast<void>(move_origin(positions));
  for (std::size_t i = 0; i < data.voxels; ++i) put_position(i, positions[i]);
}

template <class Real>
void VoxelState<Real>::place_voxels(const VoxelBody& body, const VoxelLoads& loads) {
  const auto put3 = [](Real* to, const std::array<double, 3>& v, double factor) {
    for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = static_cast<Real>(factor * v[axis]);
  };
  const bool loaded = !loads.force_N.empty() || !loads.moment_N_m.empty();
  if (loaded) external_.assign(line_size * all_voxels_, Real(0));
  const BodyClasses& classes = body.classes;
  const Actuation& actuation = body.physics.actuation;
  const bool driven = is_driven(actuation) && !body.hollow;
  place_on_grid(body.lattice, loads.initial_displacement_m);
  for (std::size_t i = 0; i < all_voxels_; ++i) {
    Real* pose = pose_.data() + line_size * i;
    pose[slot::size] = static_cast<Real>(edge_);
    pose[slot::qw] = Real(1);
    if (i >= data.voxels) {
      // The ends of padding beams stand one edge apart along each axis, so that these beams carry nothing.
      if (i > data.padded_voxels) pose[i - data.padded_voxels - 1] = static_cast<Real>(edge_);
      continue;
    }
    voxel_class_[i] = static_cast<std::int32_t>(2 * classes.voxel_class[i]);

    const double angle = 2.0 * std::numbers::pi * body.phases[i];
    const double size = edge_ * (loads.size_factor.empty() ? 1.0 : loads.size_factor[i]);
    const double amplitude = driven ? actuation.amplitude * size : 0.0;
    size_base_[i] = static_cast<Real>(size);
    size_sine_[i] = static_cast<Real>(amplitude * std::cos(angle));
    size_cosine_[i] = static_cast<Real>(amplitude * std::sin(angle));

    Real* motion = motion_.data() + line_size * i;
    motion[slot::is_static] = Real(1);
    if (!loads.initial_velocity_m_s.empty()) {
      const std::array<double, 3>& velocity = loads.initial_velocity_m_s[i];
      put3(motion + slot::px, velocity, classes.mass_kg[i]);
      if (velocity[0] != 0.0 || velocity[1] != 0.0) motion[slot::is_static] = Real(0);
    }
    if (!loads.initial_angular_velocity_rad_s.empty())
      put3(motion + slot::hx, loads.initial_angular_velocity_rad_s[i], classes.inertia_kg_m2[i]);
    if (loaded) {
      Real* external = external_.data() + line_size * i;
      if (!loads.force_N.empty()) put3(external + slot::fx, loads.force_N[i], 1.0);
      if (!loads.moment_N_m.empty()) put3(external + slot::mx, loads.moment_N_m[i], 1.0);
    }
  }
  if (loaded) {
    data.external_load = external_.data();
    load_ = external_;
    data.load = load_.data();
  }
}

template <class Real>
void VoxelState<Real>::fill_beams(const VoxelBody& body) {
  const bool own_lengths = body.hollow.has_value();
  const bool own_kinks = own_lengths && has_kinks(body.lattice, *body.hollow, body.physics.surrogate->parameters);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = body.lattice.beams[axis];
    const std::size_t count = padded<Real>(beams.lower.size());
    lower_[axis] = beams.lower;
    upper_[axis] = beams.upper;
    lower_[axis].resize(count, static_cast<std::int32_t>(data.padded_voxels));
    upper_[axis].resize(count, static_cast<std::int32_t>(data.padded_voxels + 1 + axis));
    beam_class_[axis].assign(count, 0);
    for (std::size_t i = 0; i < beams.lower.size(); ++i)
      beam_class_[axis][i] = static_cast<std::int32_t>(2 * body.classes.beam_class[axis][i]);
    history_[axis].assign(history_size * count, Real(0));
    for (std::size_t i = 0; i < count; ++i) history_[axis][(history_size - 1) * count + i] = Real(1);
    if (own_lengths) {
      rest_length_[axis].assign(count, static_cast<Real>(edge_));
      rest_length_rate_[axis].assign(count, Real(0));
    }
    if (own_kinks) half_kink_[axis].assign(4 * count, Real(0));
    data.axis[axis] = {.count = count,
                       .lower = lower_[axis].data(),
                       .upper = upper_[axis].data(),
                       .beam_class = beam_class_[axis].data(),
                       .history = history_[axis].data(),
                       .rest_length = own_lengths ? rest_length_[axis].data() : nullptr,
                       .rest_length_rate = own_lengths ? rest_length_rate_[axis].data() : nullptr,
                       .half_kink = own_kinks ? half_kink_[axis].data() : nullptr};
  }
}

template <class Real>
void VoxelState<Real>::set_sizes(double sine, double cosine) {
  const Real s = static_cast<Real>(sine);
  const Real c = static_cast<Real>(cosine);
  for (std::size_t i = 0; i < data.padded_voxels; ++i) {
    pose_[line_size * i + slot::size] = size_base_[i] + (size_sine_[i] * s + size_cosine_[i] * c);
    motion_[line_size * i + slot::size_rate] = data.angular_frequency * (size_sine_[i] * c - size_cosine_[i] * s);
  }
}

template <class Real>
void VoxelState<Real>::set_sizes(const DriveMoment& moment) {
  for (std::size_t i = 0; i < data.padded_voxels; ++i) {
    put_shaped_size<Real>(moment.sine, moment.cosine, moment.sine_rate, moment.cosine_rate, size_base_[i], size_sine_[i],
                          size_cosine_[i], pose_[line_size * i + slot::size], motion_[line_size * i + slot::size_rate]);
  }
}

template class VoxelState<double>;
template class VoxelState<float>;

}  // namespace menger::voxel
