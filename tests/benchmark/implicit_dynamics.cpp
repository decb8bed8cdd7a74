// Implicit dynamics: seconds of motion of the driven module on rough ground, at several tolerances. One process, CPU time.

#include "fem/implicit/implicit_dynamics.h"

#include <benchmark/benchmark.h>

#include <string>

#include "fem/space/parallel_session.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace fem = menger::fem;
namespace io = menger::io;
namespace materials = menger::materials;
namespace meshes = menger::meshes;

namespace {

/// The hollow cube of 20 mm of bench-explicit: walls of 2 mm, one element thick.
meshes::HexahedralMesh module_mesh() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  return meshes::hollow_polycube(meshes::hollow_cube_design(20e-3), options).mesh;
}

fem::Body silicone_body(const meshes::HexahedralMesh& mesh) {
  fem::Body body;
  body.regions.assign(mesh.region_names.size(), {materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1070.0});
  for (const meshes::Chamber& chamber : mesh.chambers) body.chambers.push_back({chamber.labels, chamber.plenum});
  body.plenum_count = mesh.plenum_names.size();
  body.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  return body;
}

fem::ImplicitOptions on_ground(const fem::Body& body, double viscosity_Pa_s, double tolerance) {
  fem::ImplicitOptions options;
  options.schedules.assign(body.plenum_count, {fem::SinePressure{.low_Pa = 0.0, .high_Pa = 6e3, .frequency_Hz = 3.0}, 0.0});
  options.viscosities_Pa_s.assign(body.regions.size(), viscosity_Pa_s);
  options.ground = fem::RigidGround{.height_m = 0.0,
                                    .stiffness_Pa_per_m = fem::ground_stiffness_Pa_per_m(2.5e6, 2e-3),
                                    .friction = {.static_coefficient = 0.6, .kinetic_coefficient = 0.5}};
  options.tolerance = tolerance;
  return options;
}

void run(benchmark::State& state, int degree, double viscosity_Pa_s, double tolerance, double time_s) {
  const meshes::HexahedralMesh mesh = module_mesh();
  const fem::Body body = silicone_body(mesh);
  const fem::Space space = fem::make_space(mesh, degree, 0, MPI_COMM_SELF);
  for (auto unused : state) {
    (void)unused;
    fem::ImplicitDynamics dynamics(space, body, on_ground(body, viscosity_Pa_s, tolerance));
    const fem::ImplicitReport& report = dynamics.advance_to(time_s);
    if (report.status != io::RunStatus::completed) {
      state.SkipWithError(report.reason.c_str());
      return;
    }
    state.counters["steps"] = static_cast<double>(dynamics.state().steps);
    state.counters["rejected"] = static_cast<double>(dynamics.state().rejected_steps);
    state.counters["iterations"] = static_cast<double>(dynamics.state().iterations);
    state.counters["factorisations"] = dynamics.factorisations();
    state.counters["height_mm"] = 1e3 * dynamics.centre_of_mass_m()[2];
  }
}

/// The module on a ground that is less rough backwards, three periods: what it walks, by how its mass is spread and how hard it
/// sticks. Mean place over the last period and place at its end, see ImplicitDynamics.
void walk(benchmark::State& state, bool lumped_mass, double stick_stiffness, double tolerance) {
  const meshes::HexahedralMesh mesh = module_mesh();
  const fem::Body body = silicone_body(mesh);
  const fem::Space space = fem::make_space(mesh, 1, 0, MPI_COMM_SELF);
  for (auto unused : state) {
    (void)unused;
    fem::ImplicitOptions options = on_ground(body, 10.0, tolerance);
    options.ground->friction.directional = fem::DirectionalFriction{.backward_factor = 0.3};
    options.lumped_mass = lumped_mass;
    options.stick_stiffness = stick_stiffness;
    fem::ImplicitDynamics dynamics(space, body, options);
    const double start = dynamics.centre_of_mass_m()[0];
    double mean_m = 0.0;
    for (int n = 1; n <= 300; ++n) {
      const fem::ImplicitReport& report = dynamics.advance_to(n / 300.0);
      if (report.status != io::RunStatus::completed) {
        state.SkipWithError(report.reason.c_str());
        return;
      }
      if (n > 200) mean_m += 0.01 * (dynamics.centre_of_mass_m()[0] - start);
    }
    state.counters["steps"] = static_cast<double>(dynamics.state().steps);
    state.counters["factorisations"] = dynamics.factorisations();
    state.counters["mean_um"] = 1e6 * mean_m;
    state.counters["end_um"] = 1e6 * (dynamics.centre_of_mass_m()[0] - start);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const fem::ParallelSession session(argc, argv);
  struct Case {
    const char* name;
    int degree;
    double viscosity_Pa_s;
    double tolerance;
    double time_s;
  };
  for (const Case& c : {Case{"Q1/elastic/default", 1, 0.0, fem::ImplicitOptions{}.tolerance, 5.0},
                        Case{"Q1/viscous/default", 1, 10.0, fem::ImplicitOptions{}.tolerance, 5.0},
                        Case{"Q1/viscous/tenth", 1, 10.0, 0.1 * fem::ImplicitOptions{}.tolerance, 1.0},
                        Case{"Q2/viscous/default", 2, 10.0, fem::ImplicitOptions{}.tolerance, 0.1}}) {
    benchmark::RegisterBenchmark(c.name,
                                 [c](benchmark::State& state) { run(state, c.degree, c.viscosity_Pa_s, c.tolerance, c.time_s); })
        ->Unit(benchmark::kSecond)
        ->MeasureProcessCPUTime()
        ->Iterations(1);
  }
  struct WalkCase {
    const char* name;
    bool lumped_mass;
    double stick_stiffness;
    double tolerance = fem::ImplicitOptions{}.tolerance;
  };
  constexpr double quarter = 0.25 * fem::ImplicitOptions{}.tolerance;
  for (const WalkCase& c :
       {WalkCase{"walk/consistent", false, 1.0}, WalkCase{"walk/lumped", true, 1.0}, WalkCase{"walk/lumped/stick 3", true, 3.0},
        WalkCase{"walk/lumped/stick 10", true, 10.0}, WalkCase{"walk/lumped/stick 30", true, 30.0},
        WalkCase{"walk/lumped/quarter", true, 1.0, quarter}, WalkCase{"walk/lumped/stick 10/quarter", true, 10.0, quarter},
        WalkCase{"walk/lumped/stick 30/quarter", true, 30.0, quarter},
        WalkCase{"walk/lumped/stick 30/sixteenth", true, 30.0, 0.25 * quarter}}) {
    benchmark::RegisterBenchmark(c.name,
                                 [c](benchmark::State& state) { walk(state, c.lumped_mass, c.stick_stiffness, c.tolerance); })
        ->Unit(benchmark::kSecond)
        ->MeasureProcessCPUTime()
        ->Iterations(1);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
