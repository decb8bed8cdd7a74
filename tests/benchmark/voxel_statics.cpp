// Statics of the surrogate on a cube of 3 x 3 x 3 cells, one and two voxels along the edge of a cell, with the parameters of
// Dragon Skin 10: factors of the tangent, responses along a path of pressures, and their derivatives by twenty
// parameters against differences of whole responses. One thread, process CPU time.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <string>
#include <vector>

#include "voxel/model/surrogate_file.h"
#include "voxel/statics/equilibrium.h"
#include "voxel/statics/load_case_body.h"
#include "voxel/statics/load_case_response.h"
#include "voxel/statics/load_case_slopes.h"
#include "voxel/statics/tangent_factors.h"

namespace meshes = menger::meshes;
namespace voxel = menger::voxel;

namespace {

voxel::SurrogateParameters parameters_of(int voxels_per_cell) {
  voxel::SurrogateParameters p =
      voxel::read_surrogate(std::string(MENGER_SOURCE_DIR) + "/voxel/parameters/dragon_skin_10_1cm.toml");
  // The same silicone divided more finely: extensions are strains, bulges are by the edge of the voxel.
  p.voxels_per_cell = voxels_per_cell;
  for (voxel::PressureLaw& law : p.bulge) law.slope_per_Pa *= voxels_per_cell;
  return p;
}

meshes::LoadCase inflated_cube() {
  meshes::LoadCase load_case;
  load_case.name = "cube_inflation";
  load_case.cells = {3, 3, 3};
  load_case.digits = std::string(27, '1');
  load_case.cell_edge_m = 0.01;
  load_case.wall_thickness_m = 0.002;
  load_case.pressures_Pa = {500.0, 1000.0, 1500.0, 2000.0};
  return load_case;
}

/// By one part in ten thousand of the stiffnesses and slopes of five wall classes.
std::vector<voxel::ParameterSpan> spans_about(const voxel::SurrogateParameters& p) {
  constexpr double by = 1e-4;
  std::vector<voxel::ParameterSpan> spans;
  for (std::size_t c = 0; c < 5; ++c) {
    const auto add = [&](auto&& value_in) {
      voxel::ParameterSpan span{.below = p, .above = p, .below_by = by, .above_by = by};
      value_in(span.below) *= 1.0 - by;
      value_in(span.above) *= 1.0 + by;
      spans.push_back(span);
    };
    add([c](voxel::SurrogateParameters& of) -> double& { return of.axial_Pa.at(c); });
    add([c](voxel::SurrogateParameters& of) -> double& { return of.bending_Pa.at(c); });
    add([c](voxel::SurrogateParameters& of) -> double& { return of.extension.at(c).slope_per_Pa; });
    add([c](voxel::SurrogateParameters& of) -> double& { return of.bulge.at(c).slope_per_Pa; });
  }
  return spans;
}

/// The tangent of the inflated cube.
Eigen::SparseMatrix<double> tangent_of(int voxels_per_cell) {
  const meshes::LoadCase load_case = inflated_cube();
  const voxel::StaticBody body = voxel::load_case_body(parameters_of(voxels_per_cell), load_case);
  voxel::Equilibrium equilibrium(body, voxel::load_case_supports(load_case.kind));
  static_cast<void>(equilibrium.load(voxel::load_case_loads(load_case.kind, body, {1000.0})));
  return equilibrium.linearise();
}

void factorise(benchmark::State& state) {
  const Eigen::SparseMatrix<double> tangent = tangent_of(static_cast<int>(state.range(0)));
  voxel::TangentFactors factors;
  for (auto _ : state) {
    if (!factors.factorise(tangent)) state.SkipWithError("singular");
  }
}

void find_response(benchmark::State& state) {
  const voxel::SurrogateParameters parameters = parameters_of(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const voxel::LoadCaseResponse response = voxel::respond(parameters, inflated_cube());
    if (response.status != menger::io::RunStatus::completed) state.SkipWithError("no equilibrium");
  }
}

void differentiate(benchmark::State& state, const voxel::Responder& responder) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const voxel::SurrogateParameters parameters = parameters_of(static_cast<int>(state.range(0)));
  const std::vector<voxel::ParameterSpan> spans = spans_about(parameters);
  for (auto _ : state) {
    const voxel::ResponseSlopes slopes = responder.slopes(parameters, inflated_cube(), {}, spans);
    if (slopes.response.status != menger::io::RunStatus::completed) state.SkipWithError("no equilibrium");
  }
}

const voxel::Responder whole_responses = [](const auto& parameters, const auto& load_case, const auto& states) {
  return voxel::respond(parameters, load_case, states);
};

}  // namespace

BENCHMARK(factorise)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK(find_response)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(differentiate, equilibria, voxel::equilibrium_responder())->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(differentiate, differences, whole_responses)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
