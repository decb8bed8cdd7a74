#include "voxel/lanes/lanes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "voxel/engine/engine.h"
#include "voxel/kernels/instruction_sets.h"
#include "voxel/lanes/aggregate_engine.h"
#include "voxel/lanes/lane_group.h"
#include "voxel/lanes/lane_packing.h"

namespace menger::voxel {

namespace {

/// Whether two robots that run in lanes can run side by side.
bool go_together(const Engine& one, const Engine& other) {
  const VoxelBody& a = one.body();
  const VoxelBody& b = other.body();
  return one.record().steps == other.record().steps && a.time_step_s == b.time_step_s && a.edge_m == b.edge_m &&
         a.lattice.grid == b.lattice.grid && a.physics == b.physics;
}

template <class Real>
constexpr NumberType number_type_of = std::is_same_v<Real, double> ? NumberType::float64 : NumberType::float32;

/// Advances robots of one kind, one register at a time, or one robot after the other where that is faster.
template <class Real>
void advance_kind(const std::vector<EngineOf<Real>*>& robots, std::uint64_t steps, const std::atomic<bool>* stop,
                  InstructionSet set, LaneUse use) {
  std::vector<std::vector<bool>> cells;
  std::vector<std::size_t> left;
  const std::array<int, 3>& grid = robots.front()->body().lattice.grid;
  for (const EngineOf<Real>* robot : robots) {
    left.push_back(cells.size());
    cells.push_back(cells_of(grid, robot->body().lattice.cells));
  }
  const auto lanes = static_cast<std::size_t>(lane_kernels_for<Real>(set, robots.size()).lanes);
  const std::size_t widest = most_lanes_of(number_type_of<Real>, set);  // for a robot that runs alone
  while (!left.empty()) {
    const std::vector<std::size_t> taken = take_similar(cells, left, lanes);
    std::vector<EngineOf<Real>*> together;
    std::vector<std::vector<bool>> of_register;
    for (const std::size_t i : taken) {
      together.push_back(robots[i]);
      of_register.push_back(cells[i]);
    }
    if (use == LaneUse::always || lanes_pay(of_register, grid, widest)) {
      std::vector<MovingBody<Real>*> bodies;
      bodies.reserve(together.size());
      for (EngineOf<Real>* robot : together) bodies.push_back(&robot->moving_body());
      LaneGroup<Real>(bodies, lane_kernels_for<Real>(set, bodies.size())).advance(steps, stop);
    } else {
      for (EngineOf<Real>* robot : together) static_cast<void>(robot->advance(steps, stop));
    }
  }
}

/// Advances all robots of one number type that run in lanes. The others stay as they are.
template <class Real>
void advance_in_lanes(std::span<Engine* const> engines, double time_s, const std::atomic<bool>* stop, InstructionSet requested,
                      LaneUse use) {
  std::vector<std::vector<EngineOf<Real>*>> kinds;
  for (Engine* engine : engines) {
    const VoxelBody& body = engine->body();
    if (body.physics.integration.number != number_type_of<Real>) continue;
    auto* robot = static_cast<EngineOf<Real>*>(engine);
    if (!runs_in_lanes(*robot) || robot->record().steps >= steps_until(time_s, body.time_step_s)) continue;
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& one) { return go_together(*one.front(), *robot); });
    if (kind == kinds.end()) {
      kinds.push_back({robot});
    } else {
      kind->push_back(robot);
    }
  }
  const InstructionSet set = resolve(requested);
  for (std::vector<EngineOf<Real>*>& kind : kinds) {
    const EngineOf<Real>& first = *kind.front();
    const std::uint64_t steps = steps_until(time_s, first.body().time_step_s) - first.record().steps;
    advance_kind(kind, steps, stop, set, use);
  }
}

}  // namespace

std::vector<io::RunStatus> advance_together_to(std::span<Simulation> simulations, double time_s, const std::atomic<bool>* stop,
                                               InstructionSet instruction_set, LaneUse use) {
  std::vector<Engine*> engines;
  for (Simulation& simulation : simulations) engines.push_back(simulation.engine_.get());
  advance_in_lanes<double>(engines, time_s, stop, instruction_set, use);
  advance_in_lanes<float>(engines, time_s, stop, instruction_set, use);
  // The robots that run alone are still to be advanced. For the others this only returns the status: at the end, diverged or
  // stopped.
  std::vector<io::RunStatus> statuses;
  for (Simulation& simulation : simulations) statuses.push_back(simulation.advance_to(time_s, stop));
  return statuses;
}

}  // namespace menger::voxel
