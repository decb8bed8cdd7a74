#pragma once

#include <atomic>
#include <chrono>
#include <functional>

#include "io/text/run_status.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {

/// The progress of a run.
struct RunProgress {
  double time_s = 0.0;                  ///< simulated so far
  double duration_s = 0.0;              ///< to be simulated
  double simulated_s_per_second = 0.0;  ///< simulated time / wall time
  double remaining_s = 0.0;             ///< expected wall time to the end
};

/// Advances a simulation in slices of about a tenth of a second of wall time, and reports progress between them. The steps are
/// the same as those of Simulation::advance_to.
class SlicedRun {
 public:
  using Report = std::function<void(const RunProgress&)>;

  /// Starts the clock. @param simulation must outlive this object @param duration_s total time to simulate @param progress may be
  /// empty
  SlicedRun(Simulation& simulation, double duration_s, const std::atomic<bool>* stop, Report progress);

  /// Advances to a simulated time. @return see Simulation::advance_to
  [[nodiscard]] io::RunStatus advance_to(double until_s);

  void report() const;

  [[nodiscard]] double seconds() const;  ///< wall time since the start

 private:
  using Clock = std::chrono::steady_clock;

  Simulation* simulation_;
  double duration_s_;
  const std::atomic<bool>* stop_;
  Report progress_;
  Clock::time_point start_ = Clock::now();
  double slice_steps_ = 1.0;
};

}  // namespace menger::voxel
