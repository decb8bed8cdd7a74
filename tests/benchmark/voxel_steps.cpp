// Voxel-steps per second of the engine on Menger sponges at three scales: one robot, one thread, the paper's physics.

#include <benchmark/benchmark.h>

#include <string>

#include "meshes/fractal.h"
#include "meshes/reference_shapes.h"
#include "voxel/simulation.h"

namespace {

using menger::voxel::InstructionSet;

struct Case {
  int level;
  menger::voxel::NumberType number;
  bool collisions;
  InstructionSet instruction_set;
};

menger::meshes::Polycube two_material_sponge() {
  return menger::meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211");
}

void voxel_steps(benchmark::State& state, const Case& c) {
  const menger::meshes::Polycube body = menger::meshes::fractal(two_material_sponge(), c.level);
  menger::voxel::Physics physics;
  physics.integration.number = c.number;
  // float cannot carry damping from increments.
  if (c.number == menger::voxel::NumberType::float32) physics.integration.damping = menger::voxel::DampingMode::velocity;
  if (!c.collisions) physics.collisions.exclusion_depth.reset();
  menger::voxel::Simulation simulation(body, 0.01, physics, {}, {.instruction_set = c.instruction_set});
  // The gait's own motion from the second quarter of its first cycle on: beams bend, feet slide, neighbours touch.
  if (simulation.advance_to(0.05) != menger::io::RunStatus::completed) {
    state.SkipWithError("diverged");
    return;
  }
  const std::uint64_t batch = 400000 / simulation.voxel_count() + 1;
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

void register_case(const std::string& name, const Case& c) {
  benchmark::RegisterBenchmark(name.c_str(), [c](benchmark::State& state) {
    voxel_steps(state, c);
  })->Unit(benchmark::kMillisecond);
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
        register_case(name.append("/collisions").append(suffix), {level, number, true, set});
      }
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
