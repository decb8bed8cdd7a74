#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>

#include "voxel/engine/close_pairs.h"
#include "voxel/engine/divergence.h"
#include "voxel/engine/pressure_drive.h"
#include "voxel/engine/voxel_body.h"
#include "voxel/engine/voxel_loads.h"
#include "voxel/engine/voxel_state.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/model/actuation.h"
#include "voxel/model/strain_range.h"

namespace menger::voxel {

/// Results of the steps so far, beside the state.
struct RunRecord {
  std::uint64_t steps = 0;
  std::optional<Divergence> divergence;
  std::optional<StrainRange> strain_range;  ///< of a calibrated body
};

/// A body in motion, with all of a step that the sweeps do not do: the clock, the drive, the limits of the model, the close
/// pairs, and the origin of positions, which moves along with the body.
///
/// The sweeps come from the code that steps the body: EngineOf voxel by voxel, LaneGroup with robots in SIMD lanes, BlockLanes
/// with blocks in SIMD lanes. A step is
///
///   begin_step(); the loads of all beams; check_strains(); the loads of contacts, with close_pairs(); the sweep over voxels;
///   end_step().
template <class Real>
class MovingBody {
 public:
  /// @param kernels find the contacts; they must outlive this object
  /// @param options which terms are kept where they cannot matter
  MovingBody(VoxelBody body, const VoxelLoads& loads, const StepKernels<Real>& kernels, const KernelOptions& options);
  MovingBody(const MovingBody&) = delete;
  MovingBody& operator=(const MovingBody&) = delete;

  [[nodiscard]] const VoxelBody& body() const { return body_; }
  [[nodiscard]] const RunRecord& record() const { return record_; }
  [[nodiscard]] const VoxelState<Real>& state() const { return state_; }

  /// What the sweeps read and write.
  [[nodiscard]] StepData<Real>& data() { return state_.data; }
  [[nodiscard]] const StepData<Real>& data() const { return state_.data; }

  /// Returns the close pairs; null where no pair can collide.
  [[nodiscard]] ClosePairs<Real>* close_pairs() { return close_pairs_.get(); }
  [[nodiscard]] const ClosePairs<Real>* close_pairs() const { return close_pairs_.get(); }

  /// Returns the pressure drive of a calibrated body; null for other bodies.
  [[nodiscard]] const PressureDrive<Real>* pressures() const { return pressures_.get(); }

  /// Whether the sweep over voxels computes the drive.
  [[nodiscard]] bool sweep_drives() const { return sweep_drives_; }

  /// Returns the present rest length (m) of a beam.
  [[nodiscard]] double rest_length_m(std::size_t axis, std::size_t beam) const;

  /// Whether the sizes of solid voxels are set between the steps, because the drive is not a plain sine.
  [[nodiscard]] bool shaped() const { return shaped_; }

  /// Returns the drive at the end of a step. A plain sine of solid voxels has no rates here; see StepConstants.
  /// @param steps counted from the start, with this one
  [[nodiscard]] DriveMoment drive_after(std::uint64_t steps) const;

  /// Counts steps that other code has made all by itself, on the numbers of data(), which now hold the state after them.
  /// @param count >= 1
  /// @param strained whether the last step was cut short before voxels moved, because a strain was out of range
  /// @param too_fast whether a voxel was too fast in the last step, or not finite
  /// @param strains of a calibrated body in all of these steps but the last
  void take_over(std::uint64_t count, bool strained, bool too_fast, const StrainRange& strains);

  /// Whether a body whose voxels are on average here, m from the origin, is so far from it that the origin moves along; never in
  /// double. Code that makes steps all by itself asks for it now and then.
  [[nodiscard]] bool is_far(const std::array<double, 3>& middle_m) const;

  /// Sets the constants of the sweeps to the drive at the end of the step.
  void begin_step();

  /// Compares the strains of this step with the limits, before sizes and positions change.
  /// @param out_of_range whether the sweep over beams found a strain that is beyond the limit or not finite
  void check_strains(bool out_of_range);

  /// Does the same as check_strains after the voxels have moved. It first sets their sizes back to those at the start of the
  /// step.
  void check_strains_after_move(bool out_of_range);

  /// Ends the step: counts it, sets the drive where no sweep does, checks the speed, and moves the origin along.
  /// @param lanes copies the body's numbers between the sweeps and the lines of data(), which this class reads: `take()` copies
  /// all of them, `take_poses()` the poses, and `put_positions()` copies positions and floor_depth back after the origin has
  /// moved
  template <class Lanes>
  void end_step(const VoxelSweep& seen, const Lanes& lanes);

 private:
  [[nodiscard]] double time_s() const { return static_cast<double>(record_.steps) * body_.time_step_s; }
  void set_constants();
  void find_close_pairs(const VoxelLoads& loads, const StepKernels<Real>& kernels, const KernelOptions& options);
  void start_drive();
  void drive_to(double time_s);
  void note_strain();
  void check_validity();
  void note_speed();
  [[nodiscard]] bool may_be_far(double displacement_m);
  bool stay_near_origin();

  VoxelBody body_;
  VoxelState<Real> state_;
  RunRecord record_;
  bool sweep_drives_;
  bool shaped_;  ///< sizes are set between the steps, because the drive is not a plain sine
  std::unique_ptr<PressureDrive<Real>> pressures_;
  std::unique_ptr<ClosePairs<Real>> close_pairs_;
  Real rate_scale_;       ///< of all steps but the first
  double floor_depth_m_;  ///< of the floor below the world's z = 0
  double path_m_ = 0.0;   ///< bound on the displacement of any voxel since the origin was last checked
};

/// The `lanes` of end_step for a body whose numbers are in lines while it is stepped. Nothing needs to be copied.
struct InLines {
  void take() const {}
  void take_poses() const {}
  void put_positions() const {}
};

/// Whether any voxel may have moved by an edge since the origin was last checked. Never in double: there a kilometre costs a
/// tenth of a picometre. The check is only needed where positions are rounded to single precision.
template <class Real>
inline bool MovingBody<Real>::may_be_far(double displacement_m) {
  if constexpr (std::is_same_v<Real, double>) {
    return false;
  } else {
    path_m_ += displacement_m;
    return path_m_ >= body_.edge_m;
  }
}

template <class Real>
template <class Lanes>
inline void MovingBody<Real>::end_step(const VoxelSweep& seen, const Lanes& lanes) {
  const double largest_displacement_m = std::sqrt(seen.largest_displacement2);
  if (close_pairs_) close_pairs_->moved(largest_displacement_m);
  ++record_.steps;
  state_.data.rate_scale = rate_scale_;
  if (pressures_ || shaped_) drive_to(time_s());
  if (seen.out_of_range) {
    lanes.take();
    note_speed();
  } else if (may_be_far(largest_displacement_m)) {
    lanes.take_poses();
    if (stay_near_origin()) lanes.put_positions();
  }
  if (record_.divergence) record_.divergence->time_s = time_s();
}

}  // namespace menger::voxel
