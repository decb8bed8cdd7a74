#include "voxel/engine/moving_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "voxel/model/actuation.h"

namespace menger::voxel {

template <class Real>
MovingBody<Real>::MovingBody(VoxelBody body, const VoxelLoads& loads, const StepKernels<Real>& kernels,
                             const KernelOptions& options)
    : body_(std::move(body)), state_(body_, loads), rate_scale_(static_cast<Real>(1.0 / body_.time_step_s)) {
  const bool drives_sizes = is_driven(body_.physics.actuation) && !body_.hollow;
  shaped_ = drives_sizes && is_shaped(body_.physics.actuation);
  sweep_drives_ = (drives_sizes && !shaped_) || options.kept_terms().actuation;
  // A floor that is kept in the loop although the sweep has none lies infinitely deep. The feet of a calibrated body find the
  // floor themselves; see FootContact.
  const bool seen_by_sweep = body_.physics.floor && !body_.hollow;
  floor_depth_m_ = seen_by_sweep ? 0.5 * body_.edge_m : std::numeric_limits<double>::infinity();
  set_constants();
  find_close_pairs(loads, kernels, options);
  start_drive();
}

template <class Real>
void MovingBody<Real>::set_constants() {
  StepData<Real>& d = state_.data;
  const Physics& physics = body_.physics;
  const double time_step = body_.time_step_s;
  const double speed_limit = body_.speed_limit_m_s;
  d.floor_depth = static_cast<Real>(floor_depth_m_ + state_.origin_m()[2]);
  d.time_step = static_cast<Real>(time_step);
  d.rate_scale = Real(0);
  d.angular_frequency = static_cast<Real>(2.0 * std::numbers::pi / physics.actuation.period_s());
  d.strain_limit = static_cast<Real>(physics.limits.strain);
  d.displacement_limit2 = static_cast<Real>(speed_limit * time_step * speed_limit * time_step);
  d.stop_rotation_in_static_friction = physics.stop_rotation_in_static_friction;
  d.single_precision_rest_lengths = physics.integration.single_precision_rest_lengths;
  d.balances_moments = physics.beam_moments == BeamMoments::balanced;
}

template <class Real>
void MovingBody<Real>::find_close_pairs(const VoxelLoads& loads, const StepKernels<Real>& kernels, const KernelOptions& options) {
  const Physics& physics = body_.physics;
  if (!physics.collisions.exclusion_depth) return;
  CollisionRule rule(body_.lattice, *physics.collisions.exclusion_depth);
  if (rule.excludes_every_pair() && !options.kept_terms().collisions) return;
  double largest_factor = 1.0;
  for (const double factor : loads.size_factor) largest_factor = std::max(largest_factor, factor);
  const double amplitude = is_driven(physics.actuation) ? physics.actuation.amplitude : 0.0;
  const double largest_size = body_.hollow ? largest_collision_size_m(*body_.hollow, *physics.surrogate)
                                           : body_.edge_m * largest_factor * (1.0 + amplitude);
  close_pairs_ = std::make_unique<ClosePairs<Real>>(std::move(rule), largest_size, body_.edge_m, kernels, options);
  if (!body_.hollow) close_pairs_->tell_drives_apart(state_.data);
}

template <class Real>
void MovingBody<Real>::start_drive() {
  const Actuation& actuation = body_.physics.actuation;
  if (body_.hollow) {
    pressures_ =
        std::make_unique<PressureDrive<Real>>(body_.lattice, *body_.hollow, *body_.physics.surrogate, actuation, body_.phases);
    record_.strain_range.emplace();
  }
  if (pressures_ || shaped_) {
    drive_to(0.0);
  } else {
    const DriveAngle start = drive_angle(0.0, actuation.period_s());
    state_.set_sizes(start.sine, start.cosine);
  }
}

/// Sets the sizes and rest lengths that no sweep computes.
template <class Real>
void MovingBody<Real>::drive_to(double time_s) {
  if (pressures_) pressures_->set(time_s, state_.data);
  if (shaped_) state_.set_sizes(drive_moment(body_.physics.actuation, time_s));
}

template <class Real>
double MovingBody<Real>::rest_length_m(std::size_t axis, std::size_t beam) const {
  return static_cast<double>(voxel::rest_length_m(state_.data, axis, beam));
}

template <class Real>
void MovingBody<Real>::begin_step() {
  if (!sweep_drives_) return;
  const DriveMoment next = drive_after(record_.steps + 1);
  state_.data.next_sine = static_cast<Real>(next.sine);
  state_.data.next_cosine = static_cast<Real>(next.cosine);
}

template <class Real>
DriveMoment MovingBody<Real>::drive_after(std::uint64_t steps) const {
  const double end_s = static_cast<double>(steps) * body_.time_step_s;
  if (shaped_ || pressures_) return drive_moment(body_.physics.actuation, end_s);
  const DriveAngle angle = drive_angle(end_s, body_.physics.actuation.period_s());
  DriveMoment moment;
  moment.sine = angle.sine;
  moment.cosine = angle.cosine;
  return moment;
}

template <class Real>
void MovingBody<Real>::take_over(std::uint64_t count, bool strained, bool too_fast, const StrainRange& strains) {
  record_.steps += count - 1;
  if (pressures_) {
    pressures_->widen(strains);
    pressures_->set(time_s(), state_.data);  // to the rest lengths of the last step
  }
  if (strained || pressures_) check_strains(strained);
  // Nobody has added up how far voxels moved: far enough to look at the origin, and to list close pairs anew.
  end_step({too_fast, body_.edge_m * body_.edge_m}, InLines{});
  if (close_pairs_ && !record_.divergence) close_pairs_->make(state_.data.pose);
}

template <class Real>
bool MovingBody<Real>::is_far(const std::array<double, 3>& middle_m) const {
  return std::is_same_v<Real, float> && state_.is_far(middle_m);
}

template <class Real>
void MovingBody<Real>::check_strains(bool out_of_range) {
  if (out_of_range) note_strain();
  if (pressures_) check_validity();
}

template <class Real>
void MovingBody<Real>::check_strains_after_move(bool out_of_range) {
  if (sweep_drives_) {
    const DriveAngle start = drive_angle(time_s(), body_.physics.actuation.period_s());
    state_.set_sizes(start.sine, start.cosine);
  }
  check_strains(out_of_range);
}

/// Records at which beam the run diverged.
template <class Real>
void MovingBody<Real>::note_strain() {
  Divergence found{
      .voxel = 0, .cell = {}, .quantity = "strain", .value = 0.0, .limit = body_.physics.limits.strain, .time_s = 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = body_.lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const double strain = static_cast<double>(state_.data.axis[axis].history[i]) / rest_length_m(axis, i);
      if (std::abs(strain) <= std::abs(*found.value)) continue;
      found.voxel = static_cast<std::size_t>(beams.lower[i]);
      if (!std::isfinite(strain)) {
        found.quantity = "not finite";
        found.value.reset();
        found.cell = body_.cell_of(found.voxel);
        record_.divergence = found;
        return;
      }
      found.value = strain;
    }
  }
  found.cell = body_.cell_of(found.voxel);
  record_.divergence = found;
}

/// Compares the strains with those that the parameters were fitted on.
template <class Real>
void MovingBody<Real>::check_validity() {
  pressures_->note_strains(state_.data);
  const StrainRange& strains = pressures_->strains();
  record_.strain_range = strains;
  const CalibratedBody& calibrated = *body_.physics.surrogate;
  const ValidityRange& validity = calibrated.parameters.validity;
  if (record_.divergence || calibrated.outside_range == OutsideRange::warn) return;
  const bool too_small = strains.smallest < validity.smallest_strain;
  if (!too_small && strains.largest <= validity.largest_strain) return;
  const double value = too_small ? strains.smallest : strains.largest;
  Divergence found{.voxel = 0,
                   .cell = {},
                   .quantity = "strain outside the range of validity",
                   .value = value,
                   .limit = too_small ? validity.smallest_strain : validity.largest_strain,
                   .time_s = 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = body_.lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const double strain = static_cast<double>(state_.data.axis[axis].history[i] / state_.data.axis[axis].rest_length[i]);
      if (strain == value) found.voxel = static_cast<std::size_t>(beams.lower[i]);
    }
  }
  found.cell = body_.cell_of(found.voxel);
  record_.divergence = found;
}

/// Records at which voxel the run diverged.
template <class Real>
void MovingBody<Real>::note_speed() {
  Divergence found{.voxel = 0, .cell = {}, .quantity = "speed", .value = 0.0, .limit = body_.speed_limit_m_s, .time_s = 0.0};
  for (std::size_t i = 0; i < body_.lattice.voxel_count(); ++i) {
    const std::array<double, 3> velocity = state_.velocity_m_s(i);
    const double speed = std::hypot(velocity[0], velocity[1], velocity[2]);
    if (speed <= *found.value) continue;
    found.voxel = i;
    found.value = speed;
    if (std::isfinite(speed)) continue;
    found.quantity = "not finite";
    found.value.reset();
    break;
  }
  found.cell = body_.cell_of(found.voxel);
  record_.divergence = found;
}

/// Moves the origin of positions to the body if the body is far from it.
/// @return whether it moved
template <class Real>
bool MovingBody<Real>::stay_near_origin() {
  path_m_ = 0.0;
  if (!state_.take_origin_along()) return false;
  state_.data.floor_depth = static_cast<Real>(floor_depth_m_ + state_.origin_m()[2]);
  // The list holds positions from the former origin.
  if (close_pairs_) close_pairs_->make(state_.data.pose);
  return true;
}

template class MovingBody<double>;
template class MovingBody<float>;

}  // namespace menger::voxel
