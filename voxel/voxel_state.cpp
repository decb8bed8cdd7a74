#include "voxel/voxel_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "voxel/actuation.h"

namespace menger::voxel {

namespace {

constexpr std::size_t line_size = static_cast<std::size_t>(line_length);

std::size_t padded(std::size_t count) {
  constexpr auto pack = static_cast<std::size_t>(widest_pack);
  return (count + pack - 1) / pack * pack;
}

/// The coefficients of a class as the numbers of its table row.
template <class Real>
void put_row(Real* row, const VoxelCoefficients<double>& c) {
  const double values[] = {c.inverse_mass,   c.inverse_inertia,         c.weight,
                           c.global_damping, c.global_rotation_damping, c.floor.stiffness,
                           c.floor.damping,  c.floor.static_friction,   c.floor.kinetic_friction};
  for (const double value : values) *row++ = static_cast<Real>(value);
}

template <class Real>
void put_row(Real* row, const BeamCoefficients<double>& c) {
  const double values[] = {c.axial,      c.twist,     c.shear,     c.bend,       c.turn,          c.axial_root,
                           c.shear_root, c.bend_root, c.turn_root, c.twist_root, c.damping_lower, c.damping_upper};
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

template <class Real>
BeamCoefficients<Real> rounded(const BeamCoefficients<double>& c) {
  const auto r = [](double value) { return static_cast<Real>(value); };
  return {r(c.axial),      r(c.twist),     r(c.shear),     r(c.bend),       r(c.turn),          r(c.axial_root),
          r(c.shear_root), r(c.bend_root), r(c.turn_root), r(c.twist_root), r(c.damping_lower), r(c.damping_upper)};
}

}  // namespace

template <class Real>
VoxelState<Real>::VoxelState(const Lattice& lattice, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
                             const ClassTables& tables)
    : edge_(cell_edge_m), phases_(actuation_phases(lattice, physics.actuation)) {
  bool first_used = false;
  bool second_used = false;
  for (const meshes::Material material : lattice.material) (material == 1 ? first_used : second_used) = true;
  const bool any_fixed = std::find(loads.fixed.begin(), loads.fixed.end(), true) != loads.fixed.end();
  uniform_ = !any_fixed && (!(first_used && second_used) || physics.materials[0] == physics.materials[1]);

  allocate(lattice);
  fill_tables(tables);
  place_voxels(lattice, physics, loads, tables);
  fill_beams(lattice);
  const std::size_t one = static_cast<std::size_t>(lattice.material.front() - 1);
  data.voxel = rounded<Real>(tables.voxel[one]);
  data.beam = rounded<Real>(tables.beam[3 * one]);
}

template <class Real>
void VoxelState<Real>::allocate(const Lattice& lattice) {
  data.voxels = lattice.voxel_count();
  data.padded_voxels = padded(data.voxels);
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
void VoxelState<Real>::fill_tables(const ClassTables& tables) {
  constexpr auto row = static_cast<std::size_t>(class_values);
  voxel_table_.assign(row * tables.voxel.size(), Real(0));
  for (std::size_t c = 0; c < tables.voxel.size(); ++c) put_row(voxel_table_.data() + row * c, tables.voxel[c]);
  beam_table_.assign(row * tables.beam.size(), Real(0));
  for (std::size_t c = 0; c < tables.beam.size(); ++c) put_row(beam_table_.data() + row * c, tables.beam[c]);
  data.voxel_table = voxel_table_.data();
  data.beam_table = beam_table_.data();
}

template <class Real>
void VoxelState<Real>::place_voxels(const Lattice& lattice, const Physics& physics, const VoxelLoads& loads,
                                    const ClassTables& tables) {
  const auto put3 = [](Real* to, const std::array<double, 3>& v, double factor) {
    for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = static_cast<Real>(factor * v[axis]);
  };
  const bool loaded = !loads.force_N.empty() || !loads.moment_N_m.empty();
  if (loaded) external_.assign(line_size * all_voxels_, Real(0));
  const bool driven = is_driven(physics.actuation);
  for (std::size_t i = 0; i < all_voxels_; ++i) {
    Real* pose = pose_.data() + line_size * i;
    pose[slot::size] = static_cast<Real>(edge_);
    pose[slot::qw] = Real(1);
    if (i >= data.voxels) {
      // The ends of padding beams stand one edge apart along each axis, so that these beams carry nothing.
      if (i > data.padded_voxels) pose[i - data.padded_voxels - 1] = static_cast<Real>(edge_);
      continue;
    }
    const meshes::CellIndex& cell = lattice.cells[i];
    std::array<double, 3> position = {edge_ * static_cast<double>(cell.x), edge_ * static_cast<double>(cell.y),
                                      edge_ * static_cast<double>(cell.z)};
    for (std::size_t axis = 0; axis < 3 && !loads.initial_displacement_m.empty(); ++axis)
      position[axis] += loads.initial_displacement_m[i][axis];
    put3(pose, position, 1.0);
    const auto material = static_cast<std::size_t>(lattice.material[i] - 1);
    const bool fixed = !loads.fixed.empty() && loads.fixed[i];
    voxel_class_[i] = static_cast<std::int32_t>(2 * (material + (fixed ? 2 : 0)));

    const double angle = 2.0 * std::numbers::pi * phases_[i];
    const double size = edge_ * (loads.size_factor.empty() ? 1.0 : loads.size_factor[i]);
    const double amplitude = driven ? physics.actuation.amplitude * size : 0.0;
    size_base_[i] = static_cast<Real>(size);
    size_sine_[i] = static_cast<Real>(amplitude * std::cos(angle));
    size_cosine_[i] = static_cast<Real>(amplitude * std::sin(angle));

    Real* motion = motion_.data() + line_size * i;
    motion[slot::is_static] = Real(1);
    if (!loads.initial_velocity_m_s.empty()) {
      const std::array<double, 3>& velocity = loads.initial_velocity_m_s[i];
      put3(motion + slot::px, velocity, tables.mass_kg[material]);
      if (velocity[0] != 0.0 || velocity[1] != 0.0) motion[slot::is_static] = Real(0);
    }
    if (!loads.initial_angular_velocity_rad_s.empty())
      put3(motion + slot::hx, loads.initial_angular_velocity_rad_s[i], tables.inertia_kg_m2[material]);
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
void VoxelState<Real>::fill_beams(const Lattice& lattice) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    const std::size_t count = padded(beams.lower.size());
    lower_[axis] = beams.lower;
    upper_[axis] = beams.upper;
    lower_[axis].resize(count, static_cast<std::int32_t>(data.padded_voxels));
    upper_[axis].resize(count, static_cast<std::int32_t>(data.padded_voxels + 1 + axis));
    beam_class_[axis].assign(count, 0);
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const int at_lower = lattice.material[static_cast<std::size_t>(beams.lower[i])] - 1;
      const int at_upper = lattice.material[static_cast<std::size_t>(beams.upper[i])] - 1;
      beam_class_[axis][i] = 2 * (at_lower + 2 * at_upper);
    }
    constexpr auto values = static_cast<std::size_t>(history_values);
    history_[axis].assign(values * count, Real(0));
    for (std::size_t i = 0; i < count; ++i) history_[axis][(values - 1) * count + i] = Real(1);
    data.axis[axis] = {count, lower_[axis].data(), upper_[axis].data(), beam_class_[axis].data(), history_[axis].data()};
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

template class VoxelState<double>;
template class VoxelState<float>;

}  // namespace menger::voxel
