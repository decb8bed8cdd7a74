#include "evolution/reference/reevaluation_surrogate.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "evolution/reference/reevaluation_locomotion.h"
#include "evolution/study/walk_evaluator.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "meshes/design/fractal.h"
#include "meshes/hexahedra/hollow_body_check.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "voxel/lanes/simulation.h"
#include "voxel/scene/scene.h"

namespace menger::evolution {
namespace {

voxel::Simulation simulation_of(const ReevaluationStudy& study, const meshes::Polycube& body) {
  return {meshes::fractal(body, study.level, voxel::machine_memory_bytes()), study.search.search.cell_edge_m,
          study.search.physics};
}

std::array<double, 3> minus(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Moves a body as a search on finite elements does.
SurrogateWalk walk_on_elements(const ReevaluationStudy& study, const meshes::Polycube& body, const std::atomic<bool>* stop) {
  Study search = study.search;
  search.duration_s = study.duration_s;
  search.measure_from_s = study.measure_from_s;
  search.largest_lean_deg = 180.0;  // a fallen robot keeps its displacement, as on finer elements
  const auto start = std::chrono::steady_clock::now();
  const fem::WalkResult walked = fem::walk(walk_of(search, body, study.level), stop);
  SurrogateWalk walk;
  for (const fem::WalkRecord& record : walked.records) walk.trajectory.push_back({record.time_s, record.centre_of_mass_m, {}});
  walk.result.status = walked.status;
  walk.result.reason = walked.reason;
  walk.result.steps = walked.steps;
  if (walked.status == io::RunStatus::completed) measure(search, walked, walk.result);
  walk.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return walk;
}

class VoxelWalker {
 public:
  VoxelWalker(const ReevaluationStudy& study, const meshes::Polycube& body, bool with_frames)
      : study_(study), last_(measured_periods(study.search)), with_frames_(with_frames), simulation_(simulation_of(study, body)) {
    if (last_) per_period_ = static_cast<std::size_t>(std::lround(last_->period_s / study.record_interval_s));
  }

  SurrogateWalk walk(const std::atomic<bool>* stop) {
    const auto start = std::chrono::steady_clock::now();
    const auto records = static_cast<std::size_t>(std::ceil(study_.duration_s / study_.record_interval_s * (1.0 - 1e-12)));
    const auto per_frame = static_cast<std::size_t>(std::lround(study_.frame_interval_s / study_.record_interval_s));
    const auto left_out = static_cast<std::size_t>(std::lround(study_.measure_from_s / study_.record_interval_s));
    Evaluation& result = walk_.result;
    result.status = io::RunStatus::completed;
    record(true);
    for (std::size_t n = 1; n <= records && result.status == io::RunStatus::completed; ++n) {
      result.status = simulation_.advance_to(n == records ? study_.duration_s : time_of(n, left_out), stop);
      if (result.status == io::RunStatus::completed) record(n % per_frame == 0);
    }
    if (result.status == io::RunStatus::completed) measure(left_out);
    if (const auto& divergence = simulation_.divergence()) result.reason = voxel::divergence_text(*divergence);
    result.outside_validity = io::joined(simulation_.outside_validity(), "; ");
    result.steps = simulation_.steps();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(walk_);
  }

 private:
  /// Returns the time of a record. Those at measure_from_s and at the ends of periods get exactly the times that the search gives
  /// them, so that displacements count from the same steps.
  [[nodiscard]] double time_of(std::size_t record, std::size_t left_out) const {
    if (last_ && record % per_period_ == 0) {
      const std::size_t period = record / per_period_;
      return std::min(static_cast<double>(period) * last_->period_s, study_.duration_s);
    }
    return record == left_out ? study_.measure_from_s : static_cast<double>(record) * study_.record_interval_s;
  }

  /// Sets both displacements from the trajectory. @param left_out number of records before the first that counts
  void measure(std::size_t left_out) {
    if (last_) return measure_last_periods();
    const voxel::Trajectory& trajectory = walk_.trajectory;
    const auto difference = [](const voxel::TrajectoryPoint& to, const voxel::TrajectoryPoint& from) {
      return minus(to.centre_of_mass_m, from.centre_of_mass_m);
    };
    walk_.result.displacement_m = difference(trajectory.back(), trajectory.at(left_out));
    if (left_out > 0) walk_.result.left_out_m = difference(trajectory[left_out], trajectory.front());
  }

  void measure_last_periods() {
    const voxel::Trajectory& trajectory = walk_.trajectory;
    const std::size_t count = whole_periods(study_.duration_s, last_->period_s);
    const auto end_m = [&](std::size_t period) {
      return trajectory.at(std::min(period * per_period_, trajectory.size() - 1)).centre_of_mass_m;
    };
    PeriodDisplacements periods;
    for (std::size_t n = 1; n <= count; ++n) periods.push_back(minus(end_m(n), end_m(n - 1)));
    walk_.result.displacement_m = steady_displacement_m(periods, *last_);
    walk_.result.left_out_m = minus(minus(trajectory.back().centre_of_mass_m, trajectory.front().centre_of_mass_m),
                                    walk_.result.displacement_m.value());
  }

  void record(bool is_frame) {
    walk_.trajectory.push_back({simulation_.time_s(), simulation_.centre_of_mass_m(), {}});
    if (with_frames_ && is_frame) walk_.frames.push_back(simulation_.frame());
  }

  const ReevaluationStudy& study_;
  std::optional<LastPeriods> last_;
  std::size_t per_period_ = 0;  ///< records, if the last periods are measured
  bool with_frames_;
  voxel::Simulation simulation_;
  SurrogateWalk walk_;
};

}  // namespace

PeriodDisplacements period_displacements_m(const voxel::Trajectory& trajectory, double period_s, double duration_s) {
  PeriodDisplacements periods;
  const std::size_t count = whole_periods(duration_s, period_s);
  std::array<double, 3> before_m = trajectory.front().centre_of_mass_m;
  for (std::size_t n = 1; n <= count; ++n) {
    const std::array<double, 3> now_m = voxel::point_at(trajectory, static_cast<double>(n) * period_s).centre_of_mass_m;
    periods.push_back(minus(now_m, before_m));
    before_m = now_m;
  }
  return periods;
}

meshes::Design design_of(const ReevaluationStudy& study, const meshes::Polycube& body) {
  return {"re-evaluated design", body, study.search.search.cell_edge_m};
}

meshes::HollowBodyOptions casting_of(const ReevaluationStudy& study, const LocomotionOptions& elements) {
  const HollowModule module = module_of(study.search);
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = module.wall_thickness_m;
  options.elements_through_wall = elements.elements_through_wall;
  fem::set_elements(elements.elements, options);
  options.chambers = module.chambers;
  options.level = study.level;
  return options;
}

std::string obstacle_to_reference(const ReevaluationStudy& study, const meshes::Polycube& body) {
  try {
    const meshes::Design design = design_of(study, body);
    const meshes::HollowBodyOptions options = casting_of(study, study.elements);
    meshes::check_design(design, options);
    meshes::check_body(design, options, meshes::ModularBody(body, study.level, options.chambers));
    if (uses_elements(study.search)) {
      fem::LocomotionStudy walk = locomotion_study(study, study.elements, body, false);
      fem::prepare(walk);
    }
    if (!study.compares_elements()) (void)simulation_of(study, body);
  } catch (const io::InputError& fault) {  // it cannot be cast
    return fault.what();
  } catch (const std::invalid_argument& fault) {  // its chambers cannot follow the drive, or it is outside of the calibration
    return fault.what();
  } catch (const std::length_error& fault) {
    return fault.what();
  }
  return "";
}

SurrogateWalk surrogate_walk(const ReevaluationStudy& study, const meshes::Polycube& body, bool with_frames,
                             const std::atomic<bool>* stop) {
  if (study.compares_elements()) return walk_on_elements(study, body, stop);
  return VoxelWalker(study, body, with_frames).walk(stop);
}

}  // namespace menger::evolution
