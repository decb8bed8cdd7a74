#include "evolution/study/voxel_evaluator.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numeric>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "evolution/study/fallen.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "voxel/device/device_steps.h"
#include "voxel/device/robot_runner.h"
#include "voxel/lanes/body_posture.h"
#include "voxel/lanes/lane_packing.h"
#include "voxel/lanes/lanes.h"
#include "voxel/lanes/simulation.h"
#include "voxel/scene/physics_file.h"

namespace menger::evolution {

namespace {

/// With fewer voxels per thread, synchronising the threads costs more than they gain.
constexpr double fewest_voxels_per_thread = 1000.0;

/// Steps times voxels between two changes of the number of threads: a few tenths of a second of one thread, so that the cost of a
/// change is negligible.
constexpr double voxel_steps_per_piece = 5e6;

std::array<double, 3> difference(const std::array<double, 3>& to, const std::array<double, 3>& from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

std::vector<std::array<double, 3>> centres_of_mass_m(std::span<const voxel::Simulation> simulations) {
  std::vector<std::array<double, 3>> centres;
  centres.reserve(simulations.size());
  for (const voxel::Simulation& simulation : simulations) centres.push_back(simulation.centre_of_mass_m());
  return centres;
}

/// Advances a body on as many threads as it may use.
io::RunStatus advance_shared(voxel::Simulation& simulation, double time_s, const std::atomic<bool>& stop,
                             const ThreadsNow& threads) {
  const auto voxels = static_cast<double>(simulation.voxel_count());
  int most_threads = std::max(1, static_cast<int>(voxels / fewest_voxels_per_thread));
  const double piece_s = std::ceil(voxel_steps_per_piece / voxels) * simulation.time_step_s();
  io::RunStatus status = io::RunStatus::completed;
  while (status == io::RunStatus::completed && simulation.time_s() < time_s) {
    simulation.set_threads(std::clamp(threads(), 1, most_threads));
    try {
      status = simulation.advance_to(std::min(time_s, simulation.time_s() + piece_s), &stop);
    } catch (const std::system_error&) {  // no thread could be started, and no step was made: one thread is enough
      if (most_threads == 1) throw;
      most_threads = 1;
    }
  }
  return status;
}

}  // namespace

VoxelEvaluator::VoxelEvaluator(const voxel::Physics& physics, double cell_edge_m, double duration_s, double measure_from_s,
                               std::optional<LastPeriods> last, io::Device device, double largest_lean_deg)
    : physics_(physics),
      cell_edge_m_(cell_edge_m),
      duration_s_(duration_s),
      measure_from_s_(measure_from_s),
      last_(last),
      device_(device),
      largest_lean_deg_(largest_lean_deg) {
  assert(measure_from_s >= 0.0 && measure_from_s < duration_s);
}

std::vector<io::RunStatus> VoxelEvaluator::advance(Walkers& walkers, double time_s, const std::atomic<bool>& stop,
                                                   const ThreadsNow& threads) const {
  std::vector<voxel::Simulation>& simulations = walkers.simulations;
  if (device_ == io::Device::cuda) {
    voxel::DeviceAdvance advance = voxel::advance_on_device_to(simulations, time_s, &stop, voxel::Stepper::graphics_processor);
    for (std::size_t i = 0; i < simulations.size(); ++i)
      if (advance.on_processor[i]) walkers.on_processor[i] = true;
    return std::move(advance.statuses);
  }
  const bool is_large =
      simulations.size() == 1 && static_cast<double>(simulations.front().voxel_count()) >= 2 * fewest_voxels_per_thread;
  if (is_large) return {advance_shared(simulations.front(), time_s, stop, threads)};
  return voxel::advance_together_to(simulations, time_s, &stop);
}

Evaluation VoxelEvaluator::evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const {
  const EvaluationTask task{body, level};
  const EvaluationTask* const alone[] = {&task};
  return evaluate_together(alone, stop, [] { return 1; }).front();
}

std::vector<Evaluation> VoxelEvaluator::evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                          const std::atomic<bool>& stop, const ThreadsNow& threads) const {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Evaluation> evaluations(tasks.size());
  Walkers walkers;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    voxel::Physics physics = physics_;
    if (physics.surrogate) physics.surrogate->level = tasks[i]->level;
    try {
      walkers.simulations.emplace_back(tasks[i]->body, cell_edge_m_, physics);
      walkers.results.push_back(&evaluations[i]);
    } catch (const voxel::OutsideValidity& outside) {
      // For one body of many this is not wrong input, but a body without a result.
      evaluations[i].status = io::RunStatus::diverged;
      evaluations[i].outside_validity = outside.what();
      evaluations[i].reason = "outside the range of validity: " + evaluations[i].outside_validity;
    }
  }
  walkers.on_processor.resize(walkers.simulations.size());
  walk(walkers, stop, threads);
  on_processor_ += static_cast<std::size_t>(std::ranges::count(walkers.on_processor, true));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (Evaluation& evaluation : evaluations) evaluation.seconds = seconds / static_cast<double>(tasks.size());
  return evaluations;
}

double VoxelEvaluator::voxel_edge_m() const {
  return physics_.surrogate ? physics_.surrogate->parameters.voxel_edge_m() : cell_edge_m_;
}

/// Advances the simulations period by period and writes the displacement in each into the results, and how far bodies lean.
void VoxelEvaluator::walk_periods(Walkers& walkers, const std::atomic<bool>& stop, const ThreadsNow& threads) const {
  auto& [simulations, results, on_processor, leans] = walkers;
  std::vector<voxel::BodyPosture> postures;
  if (tells_falls())
    for (const voxel::Simulation& simulation : simulations) postures.emplace_back(voxel::poses_of(simulation), voxel_edge_m());
  std::vector<std::vector<std::array<double, 3>>> upright_axes(postures.size());
  std::vector<std::array<double, 3>> before_m = centres_of_mass_m(simulations);
  const std::size_t count = whole_periods(duration_s_, last_->period_s);
  for (std::size_t n = 1; n <= count; ++n) {
    // Simulations that have diverged or stopped here stay so.
    static_cast<void>(advance(walkers, std::min(static_cast<double>(n) * last_->period_s, duration_s_), stop, threads));
    const std::vector<std::array<double, 3>> now_m = centres_of_mass_m(simulations);
    for (std::size_t i = 0; i < simulations.size(); ++i)
      results[i]->period_displacements_m.push_back(difference(now_m[i], before_m[i]));
    for (std::size_t i = 0; i < postures.size(); ++i)
      if (!simulations[i].divergence()) upright_axes[i].push_back(postures[i].upright_axis(voxel::poses_of(simulations[i])));
    before_m = now_m;
  }
  for (const std::vector<std::array<double, 3>>& axes : upright_axes) leans.push_back(meshes::largest_lean(axes));
}

/// Advances the simulations to the end and writes the outcomes into the results.
void VoxelEvaluator::walk(Walkers& walkers, const std::atomic<bool>& stop, const ThreadsNow& threads) const {
  auto& [simulations, results, on_processor, leans] = walkers;
  const std::vector<std::array<double, 3>> start_m = centres_of_mass_m(simulations);
  // Simulations that have diverged or stopped here stay so.
  if (last_)
    walk_periods(walkers, stop, threads);
  else
    static_cast<void>(advance(walkers, measure_from_s_, stop, threads));
  const std::vector<std::array<double, 3>> from_m = centres_of_mass_m(simulations);
  const std::vector<io::RunStatus> statuses = advance(walkers, duration_s_, stop, threads);
  for (std::size_t i = 0; i < simulations.size(); ++i) {
    const voxel::Simulation& simulation = simulations[i];
    Evaluation& result = *results[i];
    result.status = statuses[i];
    if (result.status == io::RunStatus::completed) {
      result.displacement_m = last_ ? steady_displacement_m(result.period_displacements_m, *last_)
                                    : difference(simulation.centre_of_mass_m(), from_m[i]);
      const std::array<double, 3> whole_m = difference(simulation.centre_of_mass_m(), start_m[i]);
      if (tells_falls() && leans[i].angle_deg > largest_lean_deg_)
        set_fallen(leans[i], whole_m, result);
      else if (last_)
        result.left_out_m = difference(whole_m, result.displacement_m.value());
      else if (measure_from_s_ > 0.0)
        result.left_out_m = difference(from_m[i], start_m[i]);
    } else {
      result.period_displacements_m.clear();
    }
    if (const auto& divergence = simulation.divergence()) result.reason = voxel::divergence_text(*divergence);
    result.outside_validity = io::joined(simulation.outside_validity(), "; ");
    result.steps = simulation.steps();
  }
}

std::vector<std::vector<std::size_t>> VoxelEvaluator::groups(std::span<const EvaluationTask> tasks, int workers) const {
  std::vector<std::vector<std::size_t>> groups;
  if (device_ == io::Device::cuda) {
    // The device shares itself out among robots that it is given together. To build them takes a processor little beside that.
    if (tasks.empty()) return groups;
    std::vector<std::size_t>& all = groups.emplace_back(tasks.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return groups;
  }
  std::vector<std::size_t> modules;
  std::vector<const meshes::Polycube*> bodies;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (tasks[i].level > 1) {
      groups.push_back({i});
    } else {
      modules.push_back(i);
      bodies.push_back(&tasks[i].body);
    }
  }
  for (std::vector<std::size_t>& group : voxel::lane_groups(bodies, cell_edge_m_, physics_, workers)) {
    for (std::size_t& position : group) position = modules[position];
    groups.push_back(std::move(group));
  }
  return groups;
}

std::string VoxelEvaluator::physics() const {
  std::string text = "duration_s = " + io::number_text(duration_s_) + "\n";
  if (measure_from_s_ > 0.0) text += "measure_from_s = " + io::number_text(measure_from_s_) + "\n";
  if (last_) text += "measure_periods = " + std::to_string(last_->count) + "\n";
  if (tells_falls()) text += "largest_lean_deg = " + io::number_text(largest_lean_deg_) + "\n";
  if (device_ != io::Device::cpu) text += "device = \"" + std::string(to_string(device_)) + "\"\n";
  return text + "cell_edge_m = " + io::number_text(cell_edge_m_) + "\n" + voxel::physics_text(physics_);
}

std::string VoxelEvaluator::remark() const {
  const std::size_t count = on_processor_;
  if (count == 0) return "";
  return std::to_string(count) + (count == 1 ? " body was" : " bodies were") +
         " moved on the processor, because they touch themselves at too many places for the graphics processor, or their physics "
         "are not made for it";
}

double VoxelEvaluator::cost(const meshes::Polycube& body, int /*level*/) const { return static_cast<double>(body.count()); }

}  // namespace menger::evolution
