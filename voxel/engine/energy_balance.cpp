#include "voxel/engine/energy_balance.h"

#include <algorithm>
#include <cmath>

#include "voxel/kernels/beam_sweep.h"
#include "voxel/kernels/voxel_sweep.h"

namespace menger::voxel {

EnergyBalance::EnergyBalance(const StepData<double>& data, BeamVariety variety, bool velocity, bool floor, bool gravity,
                             bool actuated, LateralCoupling<double>* coupling, const FootContact<double>* feet)
    : data_(&data),
      variety_(variety),
      velocity_(velocity),
      floor_(floor),
      gravity_(gravity),
      actuated_(actuated),
      coupling_(coupling),
      feet_(feet),
      balance_(data.padded_voxels + 4) {
  std::size_t beams = 0;
  for (const BeamAxisData<double>& axis : data.axis) beams += axis.count;
  for (auto* values : {&rest_length_, &last_rest_length_, &rest_length_force_, &last_rest_length_force_})
    values->assign(beams, 0.0);
  if (variety != BeamVariety::own_kinks) return;
  for (auto* values : {&half_kink_, &last_half_kink_, &half_kink_moment_, &last_half_kink_moment_})
    values->assign(beams, {0.0, 0.0});
}

template <int Axis, bool Velocity, BeamVariety Variety>
bool EnergyBalance::add_axis() {
  constexpr bool uniform = Variety == BeamVariety::uniform;
  const StepData<double>& d = *data_;
  const BeamAxisData<double>& beams = d.axis[Axis];
  std::size_t offset = 0;
  for (int axis = 0; axis < Axis; ++axis) offset += d.axis[axis].count;
  bool out_of_range = false;
  for (std::size_t i = 0; i < beams.count; ++i) {
    const BeamCoefficients<double> c = uniform ? d.beam : beam_coefficients<double>(d.beam_table, beams.beam_class + i);
    BeamEnds<double> ends;
    const BeamStep<double> step = beam_step<Axis, Velocity, Variety, double>(d, beams, i, c, ends);
    const BeamDeformation<double>& e = step.state.deformation;
    out_of_range = out_of_range || !(std::abs(e.displacement.x) <= d.strain_limit * ends.rest_length);
    ledger_.elastic_J += beam_energy(c, e, ends.rest_length);

    // U depends on the rest length through the extension and through the stiffness axial / rest length.
    const double strain = e.displacement.x / ends.rest_length;
    rest_length_[offset + i] = ends.rest_length;
    rest_length_force_[offset + i] = c.axial * (strain + 0.5 * strain * strain);

    if constexpr (Variety == BeamVariety::own_kinks) {
      // A kink turns the lower end one way and the upper end the other way.
      const BeamLoads<double> loads = to_world(step.state.frame, step.elastic);
      const Vector3<double> moment =
          rotate_back(matrix(ends.lower), loads.lower_moment) - rotate_back(matrix(ends.upper), loads.upper_moment);
      half_kink_[offset + i] = {beams.half_kink[i], beams.half_kink[beams.count + i]};
      half_kink_moment_[offset + i] = {moment.y, moment.z};
    }

    const auto lower = static_cast<std::size_t>(beams.lower[i]);
    const auto upper = static_cast<std::size_t>(beams.upper[i]);
    const auto add_loads = [&](Kind kind, const BeamLoads<double>& in_frame) {
      const BeamLoads<double> loads = to_world(step.state.frame, in_frame);
      Lines<double> line{};
      const auto add = [&](std::size_t voxel, const Vector3<double>& force_on, const Vector3<double>& moment_on) {
        unpermute<Axis>(force_on, line, slot::fx);
        unpermute<Axis>(moment_on, line, slot::mx);
        Load& load = balance_[voxel].load[kind];
        load.force = load.force + Vector3<double>{line.value[slot::fx], line.value[slot::fy], line.value[slot::fz]};
        load.moment = load.moment + Vector3<double>{line.value[slot::mx], line.value[slot::my], line.value[slot::mz]};
      };
      add(lower, loads.lower_force, loads.lower_moment);
      add(upper, loads.upper_force, loads.upper_moment);
    };
    add_loads(elastic, acting_loads(d.balances_moments, step.elastic, step.state, ends.rest_length));
    add_loads(bond_damping, acting_loads(d.balances_moments, step.damping, step.state, ends.rest_length));

    const BeamLoads<double> loads = to_world(step.state.frame, loads_of(d, step, ends.rest_length));
    Lines<double> lower_line{};
    Lines<double> upper_line{};
    unpermute<Axis>(loads.lower_force, lower_line, slot::fx);
    unpermute<Axis>(loads.lower_moment, lower_line, slot::mx);
    unpermute<Axis>(uniform ? -loads.lower_force : loads.upper_force, upper_line, slot::fx);
    unpermute<Axis>(loads.upper_moment, upper_line, slot::mx);
    add_lines<double>(d.load, beams.lower + i, lower_line, beams.upper + i, upper_line);
  }
  return out_of_range;
}

template <bool Velocity, BeamVariety Variety>
bool EnergyBalance::add_axes() {
  const bool x = add_axis<0, Velocity, Variety>();
  const bool y = add_axis<1, Velocity, Variety>();
  const bool z = add_axis<2, Velocity, Variety>();
  return x || y || z;
}

template <bool Velocity>
bool EnergyBalance::add_all_axes() {
  switch (variety_) {
    case BeamVariety::classes:
      return add_axes<Velocity, BeamVariety::classes>();
    case BeamVariety::uniform:
      return add_axes<Velocity, BeamVariety::uniform>();
    case BeamVariety::own_kinks:
      return add_axes<Velocity, BeamVariety::own_kinks>();
    case BeamVariety::own_lengths:
      break;
  }
  return add_axes<Velocity, BeamVariety::own_lengths>();
}

/// Adds the work that the drive does on the stored energy by changing rest lengths and kinks. It takes the mean of the forces at
/// both ends of the step.
void EnergyBalance::add_actuation() {
  for (std::size_t i = 0; i < rest_length_.size() && !first_; ++i) {
    const double change = rest_length_[i] - last_rest_length_[i];
    ledger_.actuation_work_J -= 0.5 * (rest_length_force_[i] + last_rest_length_force_[i]) * change;
  }
  for (std::size_t i = 0; i < half_kink_.size() && !first_; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double change = half_kink_[i][k] - last_half_kink_[i][k];
      ledger_.actuation_work_J -= 0.5 * (half_kink_moment_[i][k] + last_half_kink_moment_[i][k]) * change;
    }
  }
  last_half_kink_ = half_kink_;
  last_half_kink_moment_ = half_kink_moment_;
  last_rest_length_ = rest_length_;
  last_rest_length_force_ = rest_length_force_;
}

bool EnergyBalance::add_beam_loads() {
  ledger_.elastic_J = 0.0;
  for (VoxelBalance& balance : balance_) {
    balance.last_load = balance.load;
    balance.load = {};
  }
  const bool out_of_range = velocity_ ? add_all_axes<true>() : add_all_axes<false>();
  if (coupling_ != nullptr) {
    coupling_->add_loads(*data_);
    ledger_.elastic_J += coupling_->energy_J();
    std::size_t offset = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < coupling_->beam_count(axis); ++i)
        rest_length_force_[offset + i] += coupling_->rest_length_force_N(axis, i);
      offset += data_->axis[axis].count;
    }
  }
  add_actuation();
  // Contacts are added next, directly to the load lines. Their present values are kept so that the contacts can be separated from
  // them.
  for (std::size_t i = 0; i < data_->voxels; ++i) {
    const double* load = data_->load + i * line_size;
    balance_[i].load[collision].force = -Vector3<double>{load[slot::fx], load[slot::fy], load[slot::fz]};
  }
  return out_of_range;
}

template <bool Floor, bool Gravity>
VoxelSweep EnergyBalance::move(VoxelSweep (*sweep)(const StepData<double>&)) {
  const StepData<double>& d = *data_;
  double kinetic = 0.0;
  double height_weight = 0.0;
  for (std::size_t i = 0; i < d.voxels; ++i) {
    const std::size_t at = i * line_size;
    const VoxelCoefficients<double> c =
        variety_ == BeamVariety::uniform ? d.voxel : voxel_coefficients<double>(d.voxel_table, d.voxel_class + i);
    const Lines<double> pose = load_lines<double>(d.pose + at);
    const Lines<double> motion = load_lines<double>(d.motion + at);
    const Lines<double> load = load_lines<double>(d.load + at);
    const VoxelStep<double> step = voxel_step<Floor, Gravity, double>(d, d.floor_depth, c, pose, motion, load);
    VoxelBalance& balance = balance_[i];

    const Vector3<double> momentum = {motion.value[slot::px], motion.value[slot::py], motion.value[slot::pz]};
    const Vector3<double> spin_momentum = {motion.value[slot::hx], motion.value[slot::hy], motion.value[slot::hz]};
    kinetic +=
        0.5 * c.inverse_mass * dot(momentum, step.momentum) + 0.5 * c.inverse_inertia * dot(spin_momentum, step.spin_momentum);
    height_weight += c.weight * pose.value[slot::z];

    balance.load[collision].force =
        balance.load[collision].force + Vector3<double>{load.value[slot::fx], load.value[slot::fy], load.value[slot::fz]};
    if (d.external_load != nullptr) {
      const Lines<double> external_line = load_lines<double>(d.external_load + at);
      balance.load[external] = {{external_line.value[slot::fx], external_line.value[slot::fy], external_line.value[slot::fz]},
                                {external_line.value[slot::mx], external_line.value[slot::my], external_line.value[slot::mz]}};
    }
    balance.load[global_damping] = {-(c.global_damping * step.velocity), -(c.global_rotation_damping * step.spin)};
    balance.load[floor_normal].force = {0.0, 0.0, step.floor.normal_force};
    if (feet_ != nullptr) add_feet(balance, i);
    if (Floor && feet_ == nullptr) {
      // Friction is the change of momentum that no other force explains. It includes stops by static friction.
      const double weight = Gravity ? c.weight : 0.0;
      const Vector3<double> others =
          Vector3<double>{load.value[slot::fx], load.value[slot::fy], load.value[slot::fz] - weight + step.floor.normal_force} -
          c.global_damping * step.velocity;
      const Vector3<double> other_moments = Vector3<double>{load.value[slot::mx], load.value[slot::my], load.value[slot::mz]} -
                                            c.global_rotation_damping * step.spin;
      const double per_step = 1.0 / d.time_step;
      balance.load[friction] = {per_step * (step.momentum - momentum) - others,
                                per_step * (step.spin_momentum - spin_momentum) - other_moments};
    }
    add_work(balance);
    balance.last_displacement = step.displacement;
    balance.last_turn = step.turn;
  }
  ledger_.kinetic_J = kinetic;
  if (first_) {
    start_height_weight_J_ = height_weight;
    ledger_.kinetic_start_J = kinetic;
    ledger_.elastic_start_J = ledger_.elastic_J;
  }
  ledger_.gravitational_J = Gravity ? height_weight - start_height_weight_J_ : 0.0;
  ledger_.bond_damping_work_J = work_[bond_damping];
  ledger_.global_damping_work_J = work_[global_damping];
  ledger_.floor_normal_work_J = work_[floor_normal];
  ledger_.friction_work_J = work_[friction];
  ledger_.collision_work_J = work_[collision];
  ledger_.load_work_J = work_[external];
  ledger_.largest_energy_J =
      std::max({ledger_.largest_energy_J, ledger_.kinetic_J + ledger_.elastic_J, std::abs(ledger_.gravitational_J)});
  first_ = false;
  return sweep(d);
}

/// Counts the loads of the feet of a voxel as floor and friction, and takes them out of the collisions.
void EnergyBalance::add_feet(VoxelBalance& balance, std::size_t voxel) {
  const FootContact<double>::Load& pressing = feet_->pressing(voxel);
  const FootContact<double>::Load& held = feet_->friction(voxel);
  balance.load[floor_normal] = {pressing.force, pressing.moment};
  balance.load[friction] = {held.force, held.moment};
  balance.load[collision].force = balance.load[collision].force - (pressing.force + held.force);
}

void EnergyBalance::add_work(VoxelBalance& balance) {
  if (first_) return;
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(kinds); ++kind) {
    const Load& now = balance.load[kind];
    const Load& last = balance.last_load[kind];
    work_[kind] +=
        0.5 * (dot(now.force + last.force, balance.last_displacement) + dot(now.moment + last.moment, balance.last_turn));
  }
}

VoxelSweep EnergyBalance::move_voxels() {
  VoxelSweep (*sweep)(const StepData<double>&) =
      scalar_kernels_double().voxels[variety_ == BeamVariety::uniform][floor_][gravity_][actuated_];
  if (floor_) return gravity_ ? move<true, true>(sweep) : move<true, false>(sweep);
  return gravity_ ? move<false, true>(sweep) : move<false, false>(sweep);
}

}  // namespace menger::voxel
