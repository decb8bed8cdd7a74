#include "voxel/energy_books.h"

#include <algorithm>

#include "voxel/beam_sweep.h"
#include "voxel/voxel_sweep.h"

namespace menger::voxel {

EnergyBooks::EnergyBooks(const StepData<double>& data, bool uniform, bool velocity, bool floor, bool gravity, bool actuated)
    : data_(&data),
      uniform_(uniform),
      velocity_(velocity),
      floor_(floor),
      gravity_(gravity),
      actuated_(actuated),
      books_(data.padded_voxels + 4) {
  std::size_t beams = 0;
  for (const BeamAxisData<double>& axis : data.axis) beams += axis.count;
  rest_length_.assign(beams, 0.0);
  rest_length_force_.assign(beams, 0.0);
}

template <int Axis, bool Velocity, bool Uniform>
bool EnergyBooks::add_axis() {
  const StepData<double>& d = *data_;
  const BeamAxisData<double>& beams = d.axis[Axis];
  std::size_t offset = 0;
  for (int axis = 0; axis < Axis; ++axis) offset += d.axis[axis].count;
  bool out_of_range = false;
  for (std::size_t i = 0; i < beams.count; ++i) {
    const BeamCoefficients<double> c = Uniform ? d.beam : beam_coefficients<double>(d.beam_table, beams.beam_class + i);
    BeamEnds<double> ends;
    BeamHistory<double> history;
    const BeamStep<double> step = beam_step<Axis, Velocity, Uniform, double>(d, beams, i, c, ends, history);
    const BeamDeformation<double>& e = step.state.deformation;
    out_of_range = out_of_range || !(std::abs(e.displacement.x) <= d.strain_limit * ends.rest_length);
    ledger_.elastic_J += beam_energy(c, e, ends.rest_length);

    // U depends on the rest length through the extension and through the stiffness axial / rest length.
    const double strain = e.displacement.x / ends.rest_length;
    const double force = c.axial * (strain + 0.5 * strain * strain);
    if (!first_)
      ledger_.actuation_work_J -= 0.5 * (force + rest_length_force_[offset + i]) * (ends.rest_length - rest_length_[offset + i]);
    rest_length_[offset + i] = ends.rest_length;
    rest_length_force_[offset + i] = force;

    const auto lower = static_cast<std::size_t>(beams.lower[i]);
    const auto upper = static_cast<std::size_t>(beams.upper[i]);
    const auto book = [&](Kind kind, const BeamLoads<double>& in_frame) {
      const BeamLoads<double> loads = to_world(step.state.frame, in_frame);
      Lines<double> line{};
      const auto add = [&](std::size_t voxel, const Vector3<double>& force_on, const Vector3<double>& moment_on) {
        unpermute<Axis>(force_on, line, slot::fx);
        unpermute<Axis>(moment_on, line, slot::mx);
        Load& load = books_[voxel].load[kind];
        load.force = load.force + Vector3<double>{line.value[slot::fx], line.value[slot::fy], line.value[slot::fz]};
        load.moment = load.moment + Vector3<double>{line.value[slot::mx], line.value[slot::my], line.value[slot::mz]};
      };
      add(lower, loads.lower_force, loads.lower_moment);
      add(upper, loads.upper_force, loads.upper_moment);
    };
    book(elastic, step.elastic);
    book(bond_damping, step.damping);

    const BeamLoads<double> loads = to_world(step.state.frame, step.elastic + step.damping);
    Lines<double> lower_line{};
    Lines<double> upper_line{};
    unpermute<Axis>(loads.lower_force, lower_line, slot::fx);
    unpermute<Axis>(loads.lower_moment, lower_line, slot::mx);
    unpermute<Axis>(Uniform ? -loads.lower_force : loads.upper_force, upper_line, slot::fx);
    unpermute<Axis>(loads.upper_moment, upper_line, slot::mx);
    add_lines<double>(d.load, beams.lower + i, lower_line, beams.upper + i, upper_line);
  }
  return out_of_range;
}

template <bool Velocity, bool Uniform>
bool EnergyBooks::add_axes() {
  const bool x = add_axis<0, Velocity, Uniform>();
  const bool y = add_axis<1, Velocity, Uniform>();
  const bool z = add_axis<2, Velocity, Uniform>();
  return x || y || z;
}

bool EnergyBooks::add_beam_loads() {
  ledger_.elastic_J = 0.0;
  for (VoxelBook& book : books_) {
    book.last_load = book.load;
    book.load = {};
  }
  const bool out_of_range = velocity_ ? (uniform_ ? add_axes<true, true>() : add_axes<true, false>())
                                      : (uniform_ ? add_axes<false, true>() : add_axes<false, false>());
  // Contacts are added next, straight to the load lines: remember what stands there, to tell them apart.
  for (std::size_t i = 0; i < data_->voxels; ++i) {
    const double* load = data_->load + i * static_cast<std::size_t>(line_length);
    books_[i].load[collision].force = -Vector3<double>{load[slot::fx], load[slot::fy], load[slot::fz]};
  }
  return out_of_range;
}

template <bool Floor, bool Gravity>
VoxelSweep EnergyBooks::move(VoxelSweep (*sweep)(const StepData<double>&)) {
  const StepData<double>& d = *data_;
  double kinetic = 0.0;
  double height_weight = 0.0;
  for (std::size_t i = 0; i < d.voxels; ++i) {
    const std::size_t at = i * static_cast<std::size_t>(line_length);
    const VoxelCoefficients<double> c = uniform_ ? d.voxel : voxel_coefficients<double>(d.voxel_table, d.voxel_class + i);
    const Lines<double> pose = load_lines<double>(d.pose + at);
    const Lines<double> motion = load_lines<double>(d.motion + at);
    const Lines<double> load = load_lines<double>(d.load + at);
    const VoxelStep<double> step = voxel_step<Floor, Gravity, double>(d, c, pose, motion, load);
    VoxelBook& book = books_[i];

    const Vector3<double> momentum = {motion.value[slot::px], motion.value[slot::py], motion.value[slot::pz]};
    const Vector3<double> spin_momentum = {motion.value[slot::hx], motion.value[slot::hy], motion.value[slot::hz]};
    kinetic +=
        0.5 * c.inverse_mass * dot(momentum, step.momentum) + 0.5 * c.inverse_inertia * dot(spin_momentum, step.spin_momentum);
    height_weight += c.weight * pose.value[slot::z];

    book.load[collision].force =
        book.load[collision].force + Vector3<double>{load.value[slot::fx], load.value[slot::fy], load.value[slot::fz]};
    if (d.external_load != nullptr) {
      const Lines<double> external_line = load_lines<double>(d.external_load + at);
      book.load[external] = {{external_line.value[slot::fx], external_line.value[slot::fy], external_line.value[slot::fz]},
                             {external_line.value[slot::mx], external_line.value[slot::my], external_line.value[slot::mz]}};
    }
    book.load[global_damping] = {-(c.global_damping * step.velocity), -(c.global_rotation_damping * step.spin)};
    book.load[floor_normal].force = {0.0, 0.0, step.floor.normal_force};
    if constexpr (Floor) {
      // Friction is what the momentum lost beyond all other forces: stops by static friction included.
      const double weight = Gravity ? c.weight : 0.0;
      const Vector3<double> others =
          Vector3<double>{load.value[slot::fx], load.value[slot::fy], load.value[slot::fz] - weight + step.floor.normal_force} -
          c.global_damping * step.velocity;
      const Vector3<double> other_moments = Vector3<double>{load.value[slot::mx], load.value[slot::my], load.value[slot::mz]} -
                                            c.global_rotation_damping * step.spin;
      const double per_step = 1.0 / d.time_step;
      book.load[friction] = {per_step * (step.momentum - momentum) - others,
                             per_step * (step.spin_momentum - spin_momentum) - other_moments};
    }
    book_work(book);
    book.last_displacement = step.displacement;
    book.last_turn = step.turn;
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
  ledger_.largest_energy_J = std::max(ledger_.largest_energy_J, ledger_.kinetic_J + ledger_.elastic_J);
  first_ = false;
  return sweep(d);
}

void EnergyBooks::book_work(VoxelBook& book) {
  if (first_) return;
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(kinds); ++kind) {
    const Load& now = book.load[kind];
    const Load& last = book.last_load[kind];
    work_[kind] += 0.5 * (dot(now.force + last.force, book.last_displacement) + dot(now.moment + last.moment, book.last_turn));
  }
}

VoxelSweep EnergyBooks::move_voxels() {
  VoxelSweep (*sweep)(const StepData<double>&) = scalar_kernels_double().voxels[uniform_][floor_][gravity_][actuated_];
  if (floor_) return gravity_ ? move<true, true>(sweep) : move<true, false>(sweep);
  return gravity_ ? move<false, true>(sweep) : move<false, false>(sweep);
}

}  // namespace menger::voxel
