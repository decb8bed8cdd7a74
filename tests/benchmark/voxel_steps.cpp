// Voxel-steps per second of the engine under the paper's physics: Menger sponges at three scales, one robot at a time (its blocks
// in lanes, voxel by voxel, and by two threads) and robots in SIMD lanes, and different bodies in lanes. Of bodies in lanes only
// voxels that exist are counted.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "meshes/design/connectivity.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/lanes.h"
#include "voxel/lanes/simulation.h"

namespace {

using menger::voxel::InstructionSet;

struct Case {
  int level;
  menger::voxel::NumberType number;
  bool collisions;
  InstructionSet instruction_set;
  bool blocks_in_lanes = true;
  int threads = 1;
};

menger::meshes::Polycube two_material_sponge() {
  return menger::meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211");
}

menger::voxel::Physics physics_of(const Case& c) {
  menger::voxel::Physics physics;
  physics.integration.number = c.number;
  // float cannot carry damping from increments.
  if (c.number == menger::voxel::NumberType::float32) physics.integration.damping = menger::voxel::DampingMode::velocity;
  if (!c.collisions) physics.collisions.exclusion_depth.reset();
  return physics;
}

/// The gait's own motion from the second quarter of its first cycle on: beams bend, feet slide, neighbours touch.
constexpr double start_s = 0.05;

void voxel_steps(benchmark::State& state, const Case& c) {
  const menger::meshes::Polycube body = menger::meshes::fractal(two_material_sponge(), c.level);
  menger::voxel::Simulation simulation(
      body, 0.01, physics_of(c), {},
      {.instruction_set = c.instruction_set, .blocks_in_lanes = c.blocks_in_lanes, .threads = c.threads});
  if (simulation.advance_to(start_s) != menger::io::RunStatus::completed) {
    state.SkipWithError("diverged");
    return;
  }
  const std::uint64_t batch = 2000000 / simulation.voxel_count() + 1;
  std::uint64_t steps = 0;
  for (auto unused : state) {
    (void)unused;
    if (simulation.advance(batch) != menger::io::RunStatus::completed) {
      state.SkipWithError("diverged");
      break;
    }
    steps += batch;
  }
  state.counters["voxel_steps"] =
      benchmark::Counter(static_cast<double>(steps) * static_cast<double>(simulation.voxel_count()), benchmark::Counter::kIsRate);
}

/// Sponges of random materials: one shape, many robots.
std::vector<menger::meshes::Polycube> sponges(std::size_t count, int level) {
  std::mt19937 generator(1);
  std::vector<menger::meshes::Polycube> bodies;
  while (bodies.size() < count) {
    menger::meshes::Polycube body = two_material_sponge();
    for (const menger::meshes::CellIndex& cell : body.occupied())
      body.set(cell, static_cast<menger::meshes::Material>(1 + generator() % 2));
    bodies.push_back(menger::meshes::fractal(body, level));
  }
  return bodies;
}

/// Connected random bodies of 3 x 3 x 3 cells, each cell there with a chance of 0.6.
std::vector<menger::meshes::Polycube> random_bodies(std::size_t count) {
  std::mt19937 generator(1);
  std::vector<menger::meshes::Polycube> bodies;
  while (bodies.size() < count) {
    std::string digits(27, '0');
    for (char& digit : digits) {
      if (generator() % 10 < 6) digit = static_cast<char>('1' + generator() % 2);
    }
    const menger::meshes::Polycube body = menger::meshes::Polycube::from_digits(3, 3, 3, digits);
    if (menger::meshes::is_connected(body)) bodies.push_back(body);
  }
  return bodies;
}

void voxel_steps_in_lanes(benchmark::State& state, const Case& c, const std::vector<menger::meshes::Polycube>& bodies) {
  std::vector<menger::voxel::Simulation> simulations;
  std::size_t voxels = 0;
  for (const menger::meshes::Polycube& body : bodies) {
    simulations.emplace_back(body, 0.01, physics_of(c));
    voxels += simulations.back().voxel_count();
  }
  const auto advance = [&](double time_s) {
    const std::vector<menger::io::RunStatus> statuses =
        menger::voxel::advance_together_to(simulations, time_s, nullptr, c.instruction_set);
    return std::all_of(statuses.begin(), statuses.end(),
                       [](menger::io::RunStatus status) { return status == menger::io::RunStatus::completed; });
  };
  if (!advance(start_s)) {
    state.SkipWithError("diverged");
    return;
  }
  const auto batch = static_cast<double>(2000000 / voxels + 1);
  const std::uint64_t before = simulations.front().steps();
  for (auto unused : state) {
    (void)unused;
    if (!advance(simulations.front().time_s() + batch * simulations.front().time_step_s())) {
      state.SkipWithError("diverged");
      break;
    }
  }
  const std::uint64_t steps = simulations.front().steps() - before;
  state.counters["voxel_steps"] =
      benchmark::Counter(static_cast<double>(steps) * static_cast<double>(voxels), benchmark::Counter::kIsRate);
}

void register_lanes(const std::string& name, const Case& c, std::vector<menger::meshes::Polycube> (*bodies)(std::size_t, int),
                    std::size_t count) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    voxel_steps_in_lanes(state, c, bodies(count, c.level));
  })->Unit(benchmark::kMillisecond);
}

void register_case(const std::string& name, const Case& c) {
  auto* one = benchmark::RegisterBenchmark(name.c_str(), [c](benchmark::State& state) { voxel_steps(state, c); });
  one->Unit(benchmark::kMillisecond);
  if (c.threads > 1) one->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  using menger::voxel::NumberType;
  const std::string sizes[] = {"Menger/N=20/", "Menger/N=400/", "Menger/N=8000/"};
  for (const InstructionSet set : {InstructionSet::best, InstructionSet::scalar}) {
    const std::string suffix = set == InstructionSet::scalar ? "/scalar" : "";
    for (const NumberType number : {NumberType::float64, NumberType::float32}) {
      const std::string type = number == NumberType::float64 ? "double" : "float";
      for (int level = 1; level <= 3; ++level) {
        std::string name = sizes[level - 1];
        name.append(type);
        register_case(name + suffix, {level, number, false, set});
        register_case(name + "/collisions" + suffix, {level, number, true, set});
        if (set == InstructionSet::scalar || level == 1) continue;
        register_case(name + "/voxel-by-voxel", {level, number, false, set, false});
        register_case(name + "/collisions/voxel-by-voxel", {level, number, true, set, false});
        register_case(name + "/two-threads", {level, number, false, set, true, 2});
      }
    }
  }
  for (const NumberType number : {NumberType::float64, NumberType::float32}) {
    for (const bool collisions : {false, true}) {
      const std::string type =
          std::string(number == NumberType::float64 ? "double" : "float") + (collisions ? "/collisions" : "") + "/lanes";
      const std::size_t lanes = number == NumberType::float64 ? 8 : 16;
      for (int level = 1; level <= 2; ++level)
        register_lanes(sizes[level - 1] + type, {level, number, collisions, InstructionSet::best}, sponges, lanes);
      const auto different = [](std::size_t count, int) { return random_bodies(count); };
      register_lanes("different/" + type, {1, number, collisions, InstructionSet::best}, different, 4 * lanes);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
