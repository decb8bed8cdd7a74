// What the step leaves out of scenes that cannot feel it, and what that saves: every scene runs with each term left out and kept,
// in turn, and the processor seconds of both go into a table. switched_off.md holds an outcome.
//   bench-switched-off [table.csv] [rounds]

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "evolution/study/study_file.h"
#include "io/process/program.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/temporary_folder.h"
#include "voxel/lanes/simulation.h"
#include "voxel/picture/vtk_output.h"
#include "voxel/scene/scene_file.h"

namespace {

namespace fs = std::filesystem;
using namespace menger;

/// Voxels and what happens to them for so long.
struct BenchScene {
  std::string name;
  meshes::Polycube body;
  double cell_edge_m = 0.01;
  voxel::Physics physics;
  double duration_s = 0.1;
  voxel::VoxelLoads loads{};
};

/// Processor seconds of this process.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Measured {
  double seconds = std::numeric_limits<double>::infinity();  ///< the least of all rounds
  std::array<double, 3> centre_m{};
};

/// What happens to the body while the clock runs.
using Job = std::function<void(voxel::Simulation&)>;

/// One voxel after the other, for what keeps a term does not run with blocks in lanes.
voxel::KernelOptions plain(voxel::KernelOptions options = {}) {
  options.blocks_in_lanes = false;
  return options;
}

void run_once(const BenchScene& scene, const voxel::KernelOptions& options, const Job& job, Measured& best) {
  voxel::Simulation simulation(scene.body, scene.cell_edge_m, scene.physics, scene.loads, options);
  const double start = processor_seconds();
  job(simulation);
  best.seconds = std::min(best.seconds, processor_seconds() - start);
  best.centre_m = simulation.centre_of_mass_m();
}

/// Both in turn, so that what else the machine does falls on both. @return the least seconds of the leaner and the fuller way
std::pair<Measured, Measured> measured(const BenchScene& scene, const voxel::KernelOptions& fuller, const Job& lean_job,
                                       const Job& full_job, int rounds) {
  std::pair<Measured, Measured> best;
  for (int round = 0; round < rounds; ++round) {
    run_once(scene, plain(), lean_job, best.first);
    run_once(scene, plain(fuller), full_job, best.second);
  }
  return best;
}

struct Term {
  std::string name;
  voxel::KernelOptions kept;
  std::string reported;  ///< what the simulation says where it leaves the term out
};

std::vector<Term> terms() {
  return {{"coefficients of voxels and beams", {.kept = {.coefficients = true}}, "coefficients per voxel and beam left out"},
          {"floor and friction", {.kept = {.floor = true}}, "floor left out"},
          {"gravity", {.kept = {.gravity = true}}, "gravity left out"},
          {"actuation", {.kept = {.actuation = true}}, "actuation left out"},
          {"collisions", {.kept = {.collisions = true}}, "collisions"},
          {"all of these", {.kept = voxel::all_terms}, ""},
          {"all of these, and close pairs anew in every step", {.every_term = true}, ""}};
}

/// Steps that looked at pairs, and beams in the large-angle state, as shares over a run.
struct Needs {
  double pair_steps = 0.0;
  double large_angles = 0.0;
};

Needs needs_of(const BenchScene& scene) {
  voxel::Simulation simulation(scene.body, scene.cell_edge_m, scene.physics, scene.loads);
  constexpr int looks = 100;
  Needs needs;
  for (int look = 1; look <= looks; ++look) {
    static_cast<void>(simulation.advance_to(scene.duration_s * look / looks));
    needs.large_angles += static_cast<double>(simulation.large_angle_beams());
  }
  needs.large_angles /= std::max(1.0, static_cast<double>(simulation.beam_count()) * looks);
  needs.pair_steps =
      static_cast<double>(simulation.collision_counts().steps_with_pairs) / static_cast<double>(simulation.steps());
  return needs;
}

std::string percent_text(double share) { return io::formatted("%.3g", 100.0 * share) + " %"; }

/// Whether the step leaves a term out, in words.
std::string state_of(const Term& term, const voxel::Simulation& simulation, const Needs& needs) {
  if (term.reported.empty()) return "";
  for (const std::string& line : simulation.kernel_report()) {
    if (line.rfind(term.reported, 0) != 0) continue;
    if (line.find("left out") != std::string::npos) return "left out";
    return "left out in " + percent_text(1.0 - needs.pair_steps) + " of steps";
  }
  return "needed";
}

/// A record every 20 ms with the frame for ParaView, as a scene is run, against none, as a search runs it.
Job recording(double duration_s) {
  return [=](voxel::Simulation& simulation) {
    const tests::TemporaryFolder folder("menger-switched-off");
    voxel::FrameSeries frames(folder.path());
    for (double time_s = 0.0; time_s < duration_s; time_s += 0.02) {
      frames.add(simulation.frame());
      static_cast<void>(simulation.advance_to(std::min(duration_s, time_s + 0.02)));
    }
    frames.finish();
  };
}

/// The body held still, its beams straight or, sheared by a tenth along all axes, all in the large-angle state: registers of
/// beams skip what that state asks for only where none of them is in it.
BenchScene held_still(const BenchScene& scene, double shear) {
  BenchScene held = scene;
  held.loads.fixed.assign(scene.body.count(), true);
  held.physics.actuation.mode = voxel::ActuationMode::none;
  for (const meshes::CellIndex& cell : scene.body.occupied()) {
    const double step_m = shear * scene.cell_edge_m;
    held.loads.initial_displacement_m.push_back({step_m * cell.y, step_m * cell.z, step_m * cell.x});
  }
  return held;
}

/// @return whether the outcome is the same with every term kept
bool add_rows(io::CsvTable& table, const BenchScene& scene, int rounds) {
  const voxel::Simulation simulation(scene.body, scene.cell_edge_m, scene.physics, scene.loads);
  const Needs needs = needs_of(scene);
  const auto steps = static_cast<std::uint64_t>(scene.duration_s / simulation.time_step_s());
  const Job advance = [&](voxel::Simulation& one) { static_cast<void>(one.advance_to(scene.duration_s)); };
  bool same = true;
  const auto show = [&](const std::string& term, const std::string& state, double kept_s, double left_out_s) {
    const double saved = 1.0 - left_out_s / kept_s;
    table.add_row(scene.name, std::uint64_t{simulation.voxel_count()}, steps, term, state, kept_s, left_out_s, saved);
    std::cout << io::formatted("%6.3f s ", kept_s) << io::formatted("%6.3f s ", left_out_s)
              << io::formatted("%5.1f %%  ", 100.0 * saved) << scene.name << ": " << term << (state.empty() ? "" : ", ") << state
              << std::endl;
  };
  const auto add = [&](const std::string& term, const std::string& state, const voxel::KernelOptions& fuller, const Job& job) {
    const auto [lean, full] = measured(scene, fuller, advance, job, rounds);
    same = same && lean.centre_m == full.centre_m;
    show(term, state, full.seconds, lean.seconds);
  };
  if (needs.large_angles > 0.0) {
    const BenchScene straight = held_still(scene, 0.0);
    const BenchScene sheared = held_still(scene, 0.1);
    std::pair<Measured, Measured> best;
    for (int round = 0; round < rounds; ++round) {
      run_once(straight, plain(), advance, best.first);
      run_once(sheared, plain(), advance, best.second);
    }
    show("large angles, of a body held still", "needed by " + percent_text(needs.large_angles) + " of beams and times",
         best.second.seconds, best.first.seconds);
  }
  for (const Term& term : terms()) add(term.name, state_of(term, simulation, needs), term.kept, advance);
  add("recording", "left out", {}, recording(scene.duration_s));
  return same;
}

meshes::Polycube two_material_sponge() { return meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211"); }

/// The paper's robot at its three scales.
std::vector<BenchScene> gaits() {
  const voxel::Physics physics = evolution::study_from_text(evolution::preset_text("paper"), "paper.toml").physics;
  std::vector<BenchScene> scenes;
  const double durations_s[] = {5.0, 0.4, 0.05};
  for (int level = 1; level <= 3; ++level) {
    scenes.push_back({"the paper's gait, Menger at level " + std::to_string(level), meshes::fractal(two_material_sponge(), level),
                      0.01, physics, durations_s[level - 1]});
  }
  return scenes;
}

/// A scene file of the repository.
BenchScene scene_of(const std::string& name, double duration_s) {
  const voxel::Scene scene = voxel::read_scene(fs::path(MENGER_SOURCE_DIR) / "voxel/scenes" / (name + ".toml")).scene;
  BenchScene made{name + ".toml", meshes::fractal(scene.design.body, scene.level), scene.design.cell_edge_m, scene.physics,
                  duration_s};
  if (made.physics.surrogate) made.physics.surrogate->level = scene.level;
  return made;
}

/// The closed forms' scenes: nothing is driven.
std::vector<BenchScene> closed_forms() {
  voxel::Physics still;
  still.actuation.mode = voxel::ActuationMode::none;
  voxel::Physics floating = still;
  floating.floor = false;
  floating.gravity_m_s2 = 0.0;
  voxel::Physics falling = still;
  falling.floor = false;
  voxel::VoxelLoads swinging;
  swinging.initial_velocity_m_s.assign(10, {0.0, 0.0, 0.0});
  swinging.initial_velocity_m_s[9] = {0.0, 0.0, 1e-3};
  return {{"free fall of a full cube", meshes::full_cube(3), 0.01, falling, 0.5},
          {"a full cube at rest", meshes::full_cube(3), 0.01, still, 5.0},
          {"ring-down of a bar of ten", meshes::bar(10), 0.01, floating, 10.0, swinging}};
}

int measure(int argc, char** argv) {
  const fs::path file = argc > 1 ? argv[1] : "switched_off.csv";
  const int rounds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  std::vector<BenchScene> scenes = gaits();
  for (const auto& [name, duration_s] :
       std::vector<std::pair<std::string, double>>{{"bar", 20.0}, {"quadruped", 5.0}, {"wave", 0.4}, {"silicone", 5.0}})
    scenes.push_back(scene_of(name, duration_s));
  for (const BenchScene& scene : closed_forms()) scenes.push_back(scene);
  io::CsvTable table({"scene", "voxels", "steps", "term", "state", "kept_seconds", "left_out_seconds", "saved"});
  std::cout << "    kept  left out   saved\n";
  bool same = true;
  for (const BenchScene& scene : scenes) same = add_rows(table, scene, rounds) && same;
  table.write(file);
  if (!same) std::cerr << "a term that was left out changed the outcome\n";
  return same ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("bench-switched-off", [&] { return measure(argc, argv); });
}
