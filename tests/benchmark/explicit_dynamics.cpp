// Explicit dynamics of finite elements: forces of elements alone for each instruction set, whole steps, half a second of the
// driven module, an aggregate on one and two threads, and two robots side by side, each on a thread of its own. Process CPU time
// and, beside it, wall time; one thread where nothing else is said.

#include "fem/explicit/explicit_dynamics.h"

#include <benchmark/benchmark.h>

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fem/explicit/material_damping.h"
#include "fem/explicit/three_field_elements.h"
#include "fem/walk/walk.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace fem = menger::fem;
namespace io = menger::io;
namespace materials = menger::materials;
namespace meshes = menger::meshes;

namespace {

struct Subject {
  std::string name;
  meshes::HexahedralMesh mesh;
};

/// The robot stand18 with cells of 1 cm, or an aggregate of copies of it whose chambers are joined by holes as wide as they are;
/// walls of 2 mm, one element thick.
Subject stand18(const std::string& name, int level) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.level = level;
  if (level > 1) options.hole_edge_m = 6e-3;
  const auto file = std::string(MENGER_SOURCE_DIR) + "/meshes/designs/stand18.toml";
  return {name, meshes::hollow_polycube(meshes::read_design(file), options).mesh};
}

/// The hollow cube of 20 mm, with walls as above, and stand18.
std::vector<Subject> subjects() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  return {{"cube20", meshes::hollow_polycube(meshes::hollow_cube_design(20e-3), options).mesh}, stand18("stand18", 1)};
}

/// How the silicone damps, all with a loss factor of about a tenth at 30 Hz.
struct Damping {
  const char* name;
  double viscosity_Pa_s = 0.0;
  std::vector<fem::MaxwellBranch> branches{};
};

std::vector<Damping> dampings() {
  return {{"elastic"},
          {"viscous", 10.0},
          {"branch", 0.0, {fem::maxwell_branch(50e3, {.source = "assumed", .tan_delta = 0.1, .frequency_Hz = 30.0})}}};
}

fem::ExplicitBody silicone_body(const meshes::HexahedralMesh& mesh, const Damping& damping, const fem::ExplicitKernels& kernels) {
  const fem::ExplicitMaterial material{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, damping.viscosity_Pa_s,
                                       damping.branches};
  fem::ExplicitBodyOptions options;
  options.regions.assign(mesh.region_names.size(), {material, 1070.0});
  options.elements = fem::ThreeFieldOptions{kernels};
  return {mesh, options};
}

/// Pressure, weight and a rough ground.
fem::ExplicitOptions on_ground(std::size_t plena) {
  fem::ExplicitOptions options;
  options.schedules.assign(plena, {fem::SinePressure{.low_Pa = 0.0, .high_Pa = 6e3, .frequency_Hz = 3.0}, 0.0});
  options.loads.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  options.loads.ground = fem::RigidGround{.height_m = 0.0,
                                          .stiffness_Pa_per_m = fem::ground_stiffness_Pa_per_m(2.5e6, 2e-3),
                                          .friction = {.static_coefficient = 0.6, .kinetic_coefficient = 0.5}};
  return options;
}

/// @param relaxed_s by which branches relax in each update; 0: they are springs
void element_forces(benchmark::State& state, const Subject& subject, const fem::ExplicitKernels& kernels, const Damping& damping,
                    double relaxed_s) {
  const fem::ExplicitBody body = silicone_body(subject.mesh, damping, kernels);
  std::vector<double> displacements;
  std::vector<double> velocities;
  for (const meshes::Point& X : subject.mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      displacements.push_back(0.1 * X[i] + X[0] * X[(i + 1) % 3]);
      velocities.push_back(X[(i + 2) % 3]);
    }
  }
  const auto& elements = dynamic_cast<const fem::ThreeFieldElements&>(body.elements());
  fem::AlignedNumbers slots(24 * kernels.width * elements.boxes().batch_count());
  fem::AlignedNumbers tensors =
      std::get<fem::AlignedNumbers>(elements.branches_at_rest(std::vector<double>(displacements.size(), 0.0)));
  const fem::BranchTensors branch{tensors.empty() ? nullptr : tensors.data(), relaxed_s};
  for (auto unused : state) {
    (void)unused;
    const fem::ElementsOutcome outcome =
        elements.forces({displacements.data(), velocities.data()}, {0, elements.boxes().batch_count()}, branch, slots.data());
    if (!(outcome.smallest_ratio > 0.0)) state.SkipWithError("an element is stretched beyond its law");
    benchmark::ClobberMemory();
  }
  const auto updates = static_cast<double>(state.iterations()) * static_cast<double>(elements.boxes().element_count());
  state.counters["s_per_element"] = benchmark::Counter(updates, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// What differs between runs.
struct Run {
  double time_s;
  Damping damping;
  bool has_self_contact = true;
  int threads = 1;
};

void run(benchmark::State& state, const Subject& subject, const Run& how) {
  const fem::ExplicitBody body = silicone_body(subject.mesh, how.damping, fem::best_explicit_kernels());
  std::size_t steps = 0;
  for (auto unused : state) {
    (void)unused;
    fem::ExplicitOptions options = on_ground(subject.mesh.plenum_names.size());
    options.threads = how.threads;
    if (!how.has_self_contact) options.self_contact.reset();
    fem::ExplicitDynamics dynamics(subject.mesh, body, options);
    const fem::ExplicitReport& report = dynamics.advance_to(how.time_s);
    if (report.status != io::RunStatus::completed) {
      state.SkipWithError(report.reason.c_str());
      return;
    }
    steps += dynamics.state().steps;
  }
  state.counters["steps"] = static_cast<double>(steps) / static_cast<double>(state.iterations());
  state.counters["elements"] = static_cast<double>(subject.mesh.elements.size());
  const double updates = static_cast<double>(steps) * static_cast<double>(subject.mesh.elements.size());
  state.counters["s_per_element"] = benchmark::Counter(updates, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// The quadruped of 13 cells with walls of 2 mm walks for half a second, in records of 10 ms as `menger locomote` writes them: by
/// thin walls of a fidelity, or by elements with mean dilatation if there is none.
void walk(benchmark::State& state, std::optional<fem::Fidelity> fidelity) {
  constexpr double shear_modulus_Pa = 86.7e3;
  constexpr int records = 50;
  meshes::HollowBodyOptions hollow;
  hollow.wall_thickness_m = 2e-3;
  if (fidelity) fem::set_elements({.kind = fem::ElementKind::thin_wall, .fidelity = *fidelity}, hollow);
  const auto file = std::string(MENGER_SOURCE_DIR) + "/meshes/designs/quadruped.toml";
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(meshes::read_design(file), hollow).mesh;
  const fem::ExplicitMaterial silicone{materials::NeoHookean{shear_modulus_Pa},
                                       materials::SimoTaylorVolume{50.0 * shear_modulus_Pa}, 0.0,
                                       fem::maxwell_branches(shear_modulus_Pa, fem::assumed_silicone_loss())};
  fem::ExplicitBodyOptions body_options;
  body_options.regions.assign(mesh.region_names.size(), {silicone, 1070.0});
  if (fidelity) {
    body_options.elements =
        fem::ThinWallOptions{.precision = fem::Precision::single_precision, .constants = fem::ThinWallConstants{}};
  }
  const fem::ExplicitBody body(mesh, body_options);
  std::size_t steps = 0;
  for (auto unused : state) {
    (void)unused;
    fem::ExplicitOptions options = on_ground(mesh.plenum_names.size());
    options.loads.ground->stiffness_Pa_per_m =
        fem::ground_stiffness_Pa_per_m(body.elements().contact_modulus_Pa(), body.smallest_edge_m());
    fem::ExplicitDynamics dynamics(mesh, body, options);
    for (int n = 1; n <= records; ++n) {
      const fem::ExplicitReport& report = dynamics.advance_to(0.01 * n);
      (void)dynamics.energies();
      if (report.status == io::RunStatus::completed) continue;
      state.SkipWithError(report.reason.c_str());
      return;
    }
    steps += dynamics.state().steps;
  }
  state.counters["steps"] = static_cast<double>(steps) / static_cast<double>(state.iterations());
  state.counters["elements"] = static_cast<double>(mesh.elements.size());
  const double updates = static_cast<double>(steps) * static_cast<double>(mesh.elements.size());
  state.counters["s_per_element"] = benchmark::Counter(updates, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void add_walk(const std::string& name, std::optional<fem::Fidelity> fidelity) {
  benchmark::RegisterBenchmark(("Walk/quadruped/" + name).c_str(), [fidelity](benchmark::State& state) { walk(state, fidelity); })
      ->Unit(benchmark::kSecond)
      ->MeasureProcessCPUTime()
      ->Iterations(1)
      ->Repetitions(3)
      ->ReportAggregatesOnly();
}

/// Robots side by side, each walking on a thread of its own as a search lets them: the quadruped of 13 cells, `draft`, for half a
/// second. Two robots on two quiet cores should give nearly twice the robots per second of one: they share no lock.
void walk_side_by_side(benchmark::State& state, std::size_t robots) {
  fem::WalkInput input;
  input.design = meshes::read_design(std::string(MENGER_SOURCE_DIR) + "/meshes/designs/quadruped.toml");
  input.hollow.wall_thickness_m = 2e-3;
  input.elements.fidelity = fem::Fidelity::draft;
  input.silicone.law.law = materials::NeoHookean{86.7e3};
  input.silicone.density_kg_per_m3 = 1070.0;
  input.stated_ground.friction = {.static_coefficient = 0.6, .kinetic_coefficient = 0.5};
  input.drive = fem::SurrogateDrive{.pressure_Pa = {0.0, 6e3}, .frequency_Hz = 3.0};
  input.duration_s = 0.5;
  std::atomic<std::size_t> completed{0};
  for (auto unused : state) {
    (void)unused;
    std::vector<std::jthread> walkers;
    for (std::size_t n = 0; n < robots; ++n)
      walkers.emplace_back([&] {
        if (fem::walk(input).status == io::RunStatus::completed) ++completed;
      });
  }
  const std::size_t wanted = robots * static_cast<std::size_t>(state.iterations());
  if (completed != wanted) state.SkipWithError("a walk did not complete");
  state.counters["robots_per_s"] = benchmark::Counter(static_cast<double>(wanted), benchmark::Counter::kIsRate);
}

void add_side_by_side(const std::string& name, std::size_t robots) {
  benchmark::RegisterBenchmark(("SideBySide/quadruped/draft/" + name).c_str(),
                               [robots](benchmark::State& state) { walk_side_by_side(state, robots); })
      ->Unit(benchmark::kSecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Iterations(4)
      ->Repetitions(3)
      ->ReportAggregatesOnly();
}

void add_run(const std::string& name, const Subject& subject, const Run& how) {
  benchmark::RegisterBenchmark(name.c_str(), [&subject, how](benchmark::State& state) { run(state, subject, how); })
      ->Unit(benchmark::kSecond)
      ->MeasureProcessCPUTime()
      ->Iterations(1);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Subject> bodies = subjects();
  for (const Subject& subject : bodies) {
    for (const fem::ExplicitKernels& kernels : fem::available_explicit_kernels()) {
      for (const Damping& damping : dampings()) {
        for (const double relaxed_s : {0.0, 1e-4}) {
          if (relaxed_s > 0.0 && damping.branches.empty()) continue;
          std::string name = "ElementForces/" + subject.name;
          name.append("/").append(kernels.instruction_set).append("/").append(damping.name);
          if (relaxed_s > 0.0) name.append("/relaxing");
          benchmark::RegisterBenchmark(name.c_str(), [&subject, kernels, damping, relaxed_s](benchmark::State& state) {
            element_forces(state, subject, kernels, damping, relaxed_s);
          })->Unit(benchmark::kMicrosecond);
        }
      }
    }
    const double time_s = subject.name == "cube20" ? 0.5 : 0.05;
    for (const Damping& damping : dampings())
      for (const bool has_self_contact : {true, false})
        add_run("OnGround/" + subject.name + "/" + damping.name + (has_self_contact ? "" : "/without_self_contact"), subject,
                {time_s, damping, has_self_contact});
  }
  add_walk("three_field", std::nullopt);
  add_walk("draft", fem::Fidelity::draft);
  add_walk("standard", fem::Fidelity::standard);
  add_walk("fine", fem::Fidelity::fine);
  const Subject aggregate = stand18("aggregate of stand18", 2);
  for (const Damping& damping : {dampings()[1], dampings()[2]})
    for (const int threads : {1, 2})
      add_run(std::string("OnGround/aggregate18/") + damping.name + "/threads" + std::to_string(threads), aggregate,
              {2e-3, damping, true, threads});
  add_side_by_side("one robot", 1);
  add_side_by_side("two robots side by side", 2);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
