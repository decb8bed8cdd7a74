// Walks on a graphics processor beside those on a core of this one: steps alone, many bodies at once, and whole walks with their
// checks and contacts. Wall time; what lies in between, such as copies, is part of it.

#include <benchmark/benchmark.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "fem/device/cuda_step_taker.h"
#include "fem/walk/walk.h"
#include "io/device/graphics_processor.h"

namespace fem = menger::fem;
namespace io = menger::io;
namespace materials = menger::materials;
namespace meshes = menger::meshes;

namespace {

/// A table on four legs, of 13 cells of 10 mm.
meshes::Design quadruped() { return {"quadruped", meshes::Polycube::from_digits(3, 3, 3, "101000101111111111000000000"), 10e-3}; }

fem::WalkInput walk_input(fem::Fidelity fidelity, io::Device device) {
  fem::WalkInput input;
  input.design = quadruped();
  input.hollow.wall_thickness_m = 2e-3;
  input.elements.fidelity = fidelity;
  input.silicone.law.law = materials::NeoHookean{86.7e3};
  input.silicone.density_kg_per_m3 = 1070.0;
  input.drive = fem::SurrogateDrive{.pressure_Pa = {0.0, 6e3}, .frequency_Hz = 3.0};
  input.duration_s = 1.0;
  input.device = device;
  return input;
}

void count(benchmark::State& state, double element_steps) {
  state.counters["element_steps"] = element_steps;
  state.counters["s_per_element_step"] =
      benchmark::Counter(element_steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Runs act(n) in a thread each.
template <class Act>
void at_once(std::size_t threads, const Act& act) {
  std::vector<std::thread> running;
  for (std::size_t n = 0; n < threads; ++n) running.emplace_back([&act, n] { act(n); });
  for (std::thread& thread : running) thread.join();
}

/// Steps alone: `bodies` at once, eight orders of 256 steps each, from rest under a small pressure.
void steps(benchmark::State& state, fem::Fidelity fidelity, std::size_t bodies) {
  constexpr std::size_t steps_of_order = 256;
  constexpr std::size_t orders = 8;
  fem::PreparedWalk walk{walk_input(fidelity, io::Device::cuda)};
  fem::prepare(walk);
  const fem::ExplicitBodyOptions options = fem::body_options(walk);
  const fem::ExplicitBody body(walk.mesh, options);
  const fem::ExplicitOptions settings = fem::dynamics_options(walk);
  const std::size_t plena = walk.mesh.plenum_names.size();
  struct Moving {
    std::unique_ptr<fem::StepTaker> taker;
    std::vector<double> displacements;
    std::vector<double> velocities;
    fem::BranchNumbers branches;
  };
  std::vector<Moving> moving(bodies);
  for (Moving& one : moving) {
    one.taker = fem::cuda_step_taker(walk.mesh, body, options, settings.loads);
    one.displacements.assign(3 * walk.mesh.points.size(), 0.0);
    one.velocities = one.displacements;
    one.branches = body.elements().branches_at_rest(one.displacements);
  }
  const fem::StepsOrder order{.first_kick_s = 5e-5,
                              .step_s = 5e-5,
                              .count = steps_of_order,
                              .relaxation_interval_s = 4e-4,
                              .free_travel_m = 1e9,
                              .pressures_Pa = std::vector<double>(plena * (steps_of_order + 2), 1e3)};
  for (auto unused : state) {
    (void)unused;
    std::atomic<std::size_t> done = 0;
    at_once(bodies, [&](std::size_t n) {
      for (std::size_t k = 0; k < orders; ++k)
        done += moving[n].taker->take(order, {moving[n].displacements, moving[n].velocities, moving[n].branches}).steps;
    });
    if (done != bodies * orders * steps_of_order) state.SkipWithError("a body has failed");
  }
  count(state, static_cast<double>(state.iterations()) *
                   static_cast<double>(bodies * orders * steps_of_order * walk.mesh.elements.size()));
}

/// Whole walks of a second, `bodies` at once.
void walks(benchmark::State& state, fem::Fidelity fidelity, io::Device device, std::size_t bodies) {
  const fem::WalkInput input = walk_input(fidelity, device);
  double element_steps = 0.0;
  for (auto unused : state) {
    (void)unused;
    std::vector<std::optional<fem::WalkResult>> results(bodies);
    at_once(bodies, [&](std::size_t n) { results[n] = fem::walk(input); });
    for (const auto& result : results) {
      if (result->status != io::RunStatus::completed) state.SkipWithError(result->reason.c_str());
      element_steps += static_cast<double>(result->element_steps());
    }
  }
  state.counters["walks"] = static_cast<double>(state.iterations()) * static_cast<double>(bodies);
  count(state, element_steps);
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1)->Repetitions(2);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::string obstacle = io::obstacle_to_device();
  for (const fem::Fidelity fidelity : {fem::Fidelity::draft, fem::Fidelity::standard}) {
    const std::string name(fem::to_string(fidelity));
    add("Walks/" + name + "/one_core", [fidelity](benchmark::State& state) { walks(state, fidelity, io::Device::cpu, 1); });
    if (!obstacle.empty()) continue;
    for (const std::size_t bodies : {1U, 132U, 264U})
      add("Steps/" + name + "/cuda/" + std::to_string(bodies),
          [fidelity, bodies](benchmark::State& state) { steps(state, fidelity, bodies); });
    for (const std::size_t bodies : {1U, 128U, 256U})
      add("Walks/" + name + "/cuda/" + std::to_string(bodies),
          [fidelity, bodies](benchmark::State& state) { walks(state, fidelity, io::Device::cuda, bodies); });
  }
  if (!obstacle.empty()) benchmark::AddCustomContext("no graphics processor", obstacle);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
