#include "voxel/simulate/sliced_run.h"

#include <algorithm>
#include <utility>

namespace menger::voxel {
namespace {

constexpr double slice_seconds = 0.1;         ///< wall time between two reports of progress
constexpr double largest_slice_growth = 8.0;  ///< so that a clock reading near zero does not make the next slice endless

}  // namespace

SlicedRun::SlicedRun(Simulation& simulation, double duration_s, const std::atomic<bool>* stop, Report progress)
    : simulation_(&simulation), duration_s_(duration_s), stop_(stop), progress_(std::move(progress)) {}

double SlicedRun::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

io::RunStatus SlicedRun::advance_to(double until_s) {
  io::RunStatus status = io::RunStatus::completed;
  while (status == io::RunStatus::completed && simulation_->time_s() < until_s) {
    const double start_s = seconds();
    const std::uint64_t steps_before = simulation_->steps();
    // Rounding may change the quotient. Only advance_to stops at the exact last step.
    const double steps_left = (until_s - simulation_->time_s()) / simulation_->time_step_s();
    status = steps_left > slice_steps_ + 1.0 ? simulation_->advance(static_cast<std::uint64_t>(slice_steps_), stop_)
                                             : simulation_->advance_to(until_s, stop_);
    const double steps_per_second = static_cast<double>(simulation_->steps() - steps_before) / (seconds() - start_s);
    slice_steps_ = std::max(1.0, std::min(largest_slice_growth * slice_steps_, slice_seconds * steps_per_second));
    if (status == io::RunStatus::completed && simulation_->time_s() < until_s) report();
  }
  return status;
}

void SlicedRun::report() const {
  if (!progress_) return;
  const double elapsed_s = seconds();
  const double rate = elapsed_s > 0.0 ? simulation_->time_s() / elapsed_s : 0.0;
  const double remaining_s = rate > 0.0 ? std::max(0.0, duration_s_ - simulation_->time_s()) / rate : 0.0;
  progress_({simulation_->time_s(), duration_s_, rate, remaining_s});
}

}  // namespace menger::voxel
