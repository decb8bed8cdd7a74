#include "voxel/lanes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "voxel/engine.h"
#include "voxel/instruction_sets.h"
#include "voxel/lane_group.h"

namespace menger::voxel {

namespace {

/// Whether two robots that run in lanes can do so side by side.
bool go_together(const Simulation::Engine& a, const Simulation::Engine& b) {
  return a.steps == b.steps && a.time_step_s == b.time_step_s && a.cell_edge_m == b.cell_edge_m &&
         a.lattice->grid == b.lattice->grid && a.physics == b.physics;
}

/// Which cells of its grid a robot has.
std::vector<bool> shape_of(const Lattice& lattice) {
  const auto [nx, ny, nz] = lattice.grid;
  std::vector<bool> shape(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz), false);
  for (const meshes::CellIndex& cell : lattice.cells) {
    const int place = cell.x + nx * (cell.y + ny * cell.z);
    shape[static_cast<std::size_t>(place)] = true;
  }
  return shape;
}

/// Cells of a shape that another does not have.
std::size_t cells_beyond(const std::vector<bool>& shape, const std::vector<bool>& other) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] && !other[i]) ++count;
  }
  return count;
}

/// Robots of one kind in the order in which lanes take them: the largest first, then always the one that adds the fewest cells to
/// those that its register has, and of these the largest.
template <class Real>
class Packing {
 public:
  explicit Packing(std::vector<EngineOf<Real>*> robots) : robots_(std::move(robots)) {
    for (const EngineOf<Real>* robot : robots_) shapes_.push_back(shape_of(*robot->lattice));
  }

  [[nodiscard]] std::size_t left() const { return robots_.size(); }

  /// Takes out the next `count` robots, or all that are left.
  std::vector<EngineOf<Real>*> take(std::size_t count) {
    std::vector<EngineOf<Real>*> taken;
    std::vector<bool> all;
    while (taken.size() < count && !robots_.empty()) {
      const std::size_t next = best_for(all);
      if (all.empty()) all.assign(shapes_[next].size(), false);
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] || shapes_[next][i];
      taken.push_back(robots_[next]);
      robots_.erase(robots_.begin() + static_cast<std::ptrdiff_t>(next));
      shapes_.erase(shapes_.begin() + static_cast<std::ptrdiff_t>(next));
    }
    return taken;
  }

 private:
  [[nodiscard]] std::size_t best_for(const std::vector<bool>& all) const {
    std::size_t best = 0;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    std::size_t most_voxels = 0;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const std::size_t added = all.empty() ? 0 : cells_beyond(shapes_[i], all);
      const std::size_t voxels = robots_[i]->lattice->voxel_count();
      if (added > fewest || (added == fewest && voxels <= most_voxels)) continue;
      best = i;
      fewest = added;
      most_voxels = voxels;
    }
    return best;
  }

  std::vector<EngineOf<Real>*> robots_;
  std::vector<std::vector<bool>> shapes_;
};

/// Steps robots of one kind to the end, a register full at a time.
template <class Real>
void advance_kind(std::vector<EngineOf<Real>*> robots, std::uint64_t steps, const std::atomic<bool>* stop, InstructionSet set) {
  Packing<Real> packing(std::move(robots));
  while (packing.left() > 0) {
    const LaneKernels<Real>& kernels = lane_kernels_for<Real>(set, packing.left());
    const std::vector<EngineOf<Real>*> taken = packing.take(static_cast<std::size_t>(kernels.lanes));
    if (taken.size() == 1 && kernels.lanes > 1) {
      static_cast<void>(taken.front()->advance(steps, stop));
    } else {
      LaneGroup<Real>(taken, kernels).advance(steps, stop);
    }
  }
}

/// Steps all robots of one number type that run in lanes; the others stay as they are.
template <class Real>
void advance_in_lanes(std::span<Simulation::Engine* const> engines, double time_s, const std::atomic<bool>* stop,
                      InstructionSet requested) {
  constexpr NumberType number = std::is_same_v<Real, double> ? NumberType::float64 : NumberType::float32;
  std::vector<std::vector<EngineOf<Real>*>> kinds;
  for (Simulation::Engine* engine : engines) {
    if (engine->physics.integration.number != number) continue;
    auto* robot = static_cast<EngineOf<Real>*>(engine);
    if (!robot->runs_in_lanes() || robot->steps >= steps_until(time_s, robot->time_step_s)) continue;
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
    const std::uint64_t steps = steps_until(time_s, kind.front()->time_step_s) - kind.front()->steps;
    advance_kind(std::move(kind), steps, stop, set);
  }
}

}  // namespace

std::vector<io::RunStatus> advance_together_to(std::span<Simulation> simulations, double time_s, const std::atomic<bool>* stop,
                                               InstructionSet instruction_set) {
  std::vector<Simulation::Engine*> engines;
  for (Simulation& simulation : simulations) engines.push_back(simulation.engine_.get());
  advance_in_lanes<double>(engines, time_s, stop, instruction_set);
  advance_in_lanes<float>(engines, time_s, stop, instruction_set);
  // What is left are the robots that go alone; the others are there, diverged, or stop with the next look at `stop`.
  std::vector<io::RunStatus> statuses;
  for (Simulation& simulation : simulations) statuses.push_back(simulation.advance_to(time_s, stop));
  return statuses;
}

}  // namespace menger::voxel
