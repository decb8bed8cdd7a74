// Inflation of the hollow cube by finite elements: whole paths to 6 kPa with their costs, and elements per second of the kernels
// of each instruction set. One thread, process CPU time without the start of the program.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <array>
#include <string>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "fem/space/parallel_session.h"
#include "fem/statics/inflation_path.h"
#include "fem/statics/supports.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace fem = menger::fem;
namespace io = menger::io;
namespace materials = menger::materials;
namespace meshes = menger::meshes;

namespace {

constexpr double edge_m = 20e-3;
constexpr double pressure_Pa = 6e3;

const materials::NeoHookean silicone{50e3};
const materials::SimoTaylorVolume silicone_volume{2.5e6};

/// The hollow cube with walls of 2 mm in cubes of edge 2 mm / n.
meshes::HexahedralMesh hollow_cube(int elements_through_wall) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.elements_through_wall = elements_through_wall;
  return meshes::hollow_polycube(meshes::hollow_cube_design(edge_m), options).mesh;
}

/// Stands on its lower side, free to slide; two points take the rigid motions that are left.
fem::Body silicone_body(const meshes::HexahedralMesh& mesh) {
  fem::Body body;
  body.regions.assign(mesh.region_names.size(), {silicone, silicone_volume, 1070.0});
  for (const meshes::Chamber& chamber : mesh.chambers) body.chambers.push_back({chamber.labels, chamber.plenum});
  body.plenum_count = mesh.plenum_names.size();
  for (std::size_t label = 0; label < mesh.label_names.size(); ++label)
    if (mesh.label_names[label] == "ground") body.supports.push_back({label, {false, false, true}});
  body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{edge_m, 0.0, 0.0}, {false, true, false}}};
  return body;
}

struct PathCase {
  int degree;
  int elements_through_wall;
};

/// The path in two steps of 3 kPa.
fem::PathOptions two_steps() {
  fem::PathOptions options;
  options.first_step = options.largest_step = 0.5;
  return options;
}

void inflate(benchmark::State& state, const PathCase& c) {
  const meshes::HexahedralMesh mesh = hollow_cube(c.elements_through_wall);
  fem::PathReport report;
  double top_m = 0.0;
  for (auto unused : state) {
    (void)unused;
    const fem::Space space = fem::make_space(mesh, c.degree, 0, MPI_COMM_SELF);
    const fem::Body body = silicone_body(mesh);
    fem::Equilibrium equilibrium(space, body, {});
    const fem::NearestNode top = fem::nearest_node(space, {0.5 * edge_m, 0.5 * edge_m, edge_m});
    report = fem::follow_path(equilibrium, {{.kind = fem::DriveKind::pressure, .values = {0.0, pressure_Pa}}}, two_steps(),
                              [&](const fem::PathPoint&, const fem::BodyState& at, const fem::PathRestart&) {
                                top_m = at.displacements_m[3 * static_cast<std::size_t>(top.local) + 2];
                              });
    if (report.status != io::RunStatus::completed) {
      state.SkipWithError(report.reason.c_str());
      return;
    }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["newton"] = report.iterations;
  state.counters["factorisations"] = report.factorisations;
  state.counters["top_mm"] = top_m * 1e3;
  // of the program so far: that of the case only if it runs alone (--benchmark_filter)
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

enum class Wanted { energy, residual, stiffness };

struct KernelCase {
  fem::ElementKernels kernels;
  int degree;
  Wanted wanted;
};

void evaluate_elements(benchmark::State& state, const KernelCase& c) {
  using Packed = std::vector<double, xsimd::aligned_allocator<double, 64>>;
  const fem::ElementMaterial material{c.degree, fem::Formulation::three_field, silicone, silicone_volume};
  const fem::ElementShape shape{c.degree};
  const auto room = [&](std::size_t entries) { return Packed(entries * c.kernels.width); };
  Packed positions = room(3 * shape.nodes());
  Packed displacements = room(3 * shape.nodes());
  const auto side = static_cast<std::size_t>(c.degree) + 1;
  for (std::size_t a = 0; a < shape.nodes(); ++a) {
    const std::array<std::size_t, 3> at{a % side, a / side % side, a / (side * side)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < c.kernels.width; ++lane) {
        const double x = 2e-3 * static_cast<double>(at[i]) / c.degree;
        positions[(3 * a + i) * c.kernels.width + lane] = x;
        displacements[(3 * a + i) * c.kernels.width + lane] =
            (0.1 - 0.05 * static_cast<double>(i)) * x + 1e-6 * static_cast<double>(lane * a % 5);
      }
    }
  }
  Packed residual = room(3 * shape.nodes());
  Packed stiffness = room(9 * shape.pairs());
  Packed energy = room(1);
  Packed ratio = room(1);
  for (auto unused : state) {
    (void)unused;
    c.kernels.evaluate(material, {.positions = positions.data(),
                                  .displacements = displacements.data(),
                                  .residual = c.wanted == Wanted::energy ? nullptr : residual.data(),
                                  .stiffness = c.wanted == Wanted::stiffness ? stiffness.data() : nullptr,
                                  .energy = energy.data(),
                                  .smallest_ratio = ratio.data()});
    benchmark::DoNotOptimize(energy.data());
    benchmark::ClobberMemory();
  }
  if (!(ratio[0] > 0.0)) state.SkipWithError("the element is stretched beyond its law");
  state.counters["elements"] = benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(c.kernels.width),
                                                  benchmark::Counter::kIsRate);
}

std::string element_name(int degree) { return degree == 1 ? "Q1P0" : "Q2P1"; }

}  // namespace

int main(int argc, char** argv) {
  const fem::ParallelSession session(argc, argv);
  for (const PathCase c : {PathCase{1, 1}, PathCase{2, 1}, PathCase{2, 2}}) {
    const std::string name = "HollowCube/" + element_name(c.degree) + "/n=" + std::to_string(c.elements_through_wall);
    benchmark::RegisterBenchmark(name.c_str(), [c](benchmark::State& state) { inflate(state, c); })
        ->Unit(benchmark::kSecond)
        ->MeasureProcessCPUTime()
        ->Iterations(1);
  }
  for (const fem::ElementKernels& kernels : fem::available_element_kernels()) {
    for (const int degree : {1, 2}) {
      for (const auto& [wanted, word] :
           {std::pair{Wanted::energy, "energy"}, {Wanted::residual, "residual"}, {Wanted::stiffness, "stiffness"}}) {
        std::string name = "Element/" + element_name(degree);
        name.append("/").append(word).append("/").append(kernels.instruction_set);
        benchmark::RegisterBenchmark(name.c_str(), [c = KernelCase{kernels, degree, wanted}](benchmark::State& state) {
          evaluate_elements(state, c);
        })->Unit(benchmark::kMicrosecond);
      }
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
