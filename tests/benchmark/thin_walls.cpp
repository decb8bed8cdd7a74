// Internal forces of the elements of thin walls beside those of Q1/P0: a plate of 31 x 31 elements, about as many as a robot has,
// for each instruction set, number type, way to damp and law. Compare rows of one run
// (--benchmark_enable_random_interleaving=true): beside other work all of them get slower alike.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "fem/explicit/material_damping.h"
#include "fem/explicit/three_field_elements.h"
#include "fem/thin_walls/thin_wall_kernel.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace fem = menger::fem;
namespace materials = menger::materials;
namespace meshes = menger::meshes;

namespace {

constexpr std::size_t side = 31;
constexpr std::size_t element_count = side * side;
constexpr std::array<double, 3> edges_m{2.5e-3, 2.5e-3, 2e-3};

const meshes::HexahedralMesh& plate() {
  static const meshes::HexahedralMesh mesh =
      meshes::box({static_cast<double>(side) * edges_m[0], static_cast<double>(side) * edges_m[1], edges_m[2]}, {side, side, 1});
  return mesh;
}

/// A plate that is stretched, bent and moves.
template <class Number>
struct Motion {
  std::vector<Number> displacements;
  std::vector<Number> velocities;

  Motion() {
    for (const meshes::Point& X : plate().points) {
      for (std::size_t i = 0; i < 3; ++i) {
        displacements.push_back(static_cast<Number>(0.05 * X[i] + 2.0 * X[0] * X[(i + 1) % 3]));
        velocities.push_back(static_cast<Number>(X[(i + 2) % 3]));
      }
    }
    displacements.push_back(Number(0));
    velocities.push_back(Number(0));
  }
};

struct Damping {
  const char* name;
  double viscosity_Pa_s = 0.0;
  std::vector<fem::MaxwellBranch> branches{};
  double relaxed_s = 0.0;
};

std::vector<Damping> dampings() {
  const std::vector<fem::MaxwellBranch> one{fem::maxwell_branch(50e3, fem::assumed_silicone_loss())};
  const std::vector<fem::MaxwellBranch> three{{5e3, 0.16}, {5e3, 0.024}, {20e3, 3.5e-3}};
  return {{"elastic"},
          {"viscous", 10.0},
          {"branch", 0.0, one},
          {"branch_relaxing", 0.0, one, 1e-4},
          {"branches", 0.0, three},
          {"branches_relaxing", 0.0, three, 1e-4}};
}

void count_elements(benchmark::State& state) {
  const auto updates = static_cast<double>(state.iterations()) * static_cast<double>(element_count);
  state.counters["s_per_element"] = benchmark::Counter(updates, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void three_field(benchmark::State& state, const fem::ExplicitKernels& kernels, const Damping& damping) {
  const fem::ExplicitMaterial material{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, damping.viscosity_Pa_s,
                                       damping.branches};
  const fem::ThreeFieldElements elements(plate(), {{material, 1070.0}}, kernels);
  const Motion<double> motion;
  fem::AlignedNumbers slots(24 * kernels.width * elements.boxes().batch_count());
  fem::AlignedNumbers tensors =
      std::get<fem::AlignedNumbers>(elements.branches_at_rest(std::vector<double>(motion.displacements.size() - 1, 0.0)));
  const fem::BranchTensors branch{tensors.empty() ? nullptr : tensors.data(), damping.relaxed_s, elements.sets_apart()};
  for (auto unused : state) {
    (void)unused;
    const auto outcome = elements.forces({motion.displacements.data(), motion.velocities.data()},
                                         {0, elements.boxes().batch_count()}, branch, slots.data());
    if (!(outcome.smallest_ratio > 0.0)) state.SkipWithError("an element has no value");
    benchmark::ClobberMemory();
  }
  count_elements(state);
}

template <class Number>
void thin_walls(benchmark::State& state, const fem::ThinWallKernels<Number>& kernels, fem::ThinWallElement element,
                const materials::HyperelasticLaw& law, const Damping& damping) {
  using Numbers = std::vector<Number, xsimd::aligned_allocator<Number, 64>>;
  const std::size_t width = kernels.width;
  const std::size_t batches = (element_count + width - 1) / width;
  const auto shape = fem::shape_of(edges_m);
  Numbers shapes(shape.size() * width * batches);
  std::vector<double> pressures(batches, 500.0);
  std::vector<std::uint32_t> nodes;
  for (std::size_t lane = 0; lane < width * batches; ++lane) {
    for (std::size_t n = 0; n < shape.size(); ++n)
      shapes[(lane / width * shape.size() + n) * width + lane % width] = static_cast<Number>(shape[n]);
    for (std::size_t c = 0; c < 8; ++c)
      nodes.push_back(
          static_cast<std::uint32_t>(3 * plate().elements[std::min(lane, element_count - 1)][fem::global_corner(2, c)]));
  }
  const std::vector<std::uint8_t> normals(batches, 2);
  const fem::ThinWallBatches<Number> all{element, batches, nodes.data(), shapes.data(), normals.data(), pressures.data()};
  const Motion<Number> motion;
  Numbers slots(fem::slot_numbers_per_lane * width * batches);
  const std::size_t set = fem::thin_wall_branch_numbers(element) * width * batches;
  Numbers branch((fem::most_branches + 1) * set);
  for (std::size_t n = 0; n <= fem::most_branches; ++n)
    kernels.rest_branches(all, {motion.displacements.data()}, branch.data() + n * set);
  const fem::ThinWallMaterial material{.law = law,
                                       .bulk_modulus_Pa = 50.0 * materials::shear_modulus_at_rest_Pa(law),
                                       .viscosity_Pa_s = damping.viscosity_Pa_s,
                                       .branches = damping.branches};
  for (auto unused : state) {
    (void)unused;
    const auto outcome =
        kernels.forces(material, all, {motion.displacements.data(), motion.velocities.data()},
                       {damping.branches.empty() ? nullptr : branch.data(), damping.relaxed_s, set}, slots.data());
    if (outcome.is_inverted()) state.SkipWithError("an element is inverted");
    benchmark::ClobberMemory();
  }
  count_elements(state);
}

template <class Number>
void add_thin_walls(const fem::ThinWallKernels<Number>& kernels, const materials::HyperelasticLaw& law, const Damping& damping) {
  for (const fem::ThinWallElement element : {fem::ThinWallElement::wall, fem::ThinWallElement::block}) {
    const std::string name = std::string(element == fem::ThinWallElement::wall ? "Wall/" : "Block/") +
                             (std::is_same_v<Number, float> ? "float/" : "double/") + std::string(kernels.instruction_set) + "/" +
                             std::string(materials::name_of(law)) + "/" + damping.name;
    benchmark::RegisterBenchmark(name.c_str(), [kernels, element, law, damping](benchmark::State& state) {
      thin_walls(state, kernels, element, law, damping);
    })->Unit(benchmark::kMicrosecond);
  }
}

template <class Number>
void add_number_type() {
  const materials::HyperelasticLaw plain = materials::NeoHookean{50e3};
  for (const auto& kernels : fem::available_thin_wall_kernels<Number>()) add_thin_walls(kernels, plain, dampings().front());
  const auto best = fem::best_thin_wall_kernels<Number>();
  for (std::size_t n = 1; n < dampings().size(); ++n) add_thin_walls(best, plain, dampings()[n]);
  const std::vector<materials::HyperelasticLaw> others{
      materials::MooneyRivlin{20e3, 5e3},
      materials::Yeoh{21e3, 2.5e3, 0.1e3},
      materials::Ogden<1>{{materials::OgdenTerm{25e3, 3.25}}},
      materials::Ogden<3>{{materials::OgdenTerm{10e3, 2.0}, materials::OgdenTerm{20e3, 1.3}, materials::OgdenTerm{-3e3, -2.5}}},
      materials::Gent{46e3, 20.0},
      materials::ArrudaBoyce{32e3, 1.6}};
  for (const auto& law : others) add_thin_walls(best, law, dampings().front());
}

}  // namespace

int main(int argc, char** argv) {
  for (const auto& kernels : fem::available_explicit_kernels()) {
    for (const Damping& damping : dampings()) {
      const std::string name = "ThreeField/double/" + std::string(kernels.instruction_set) + "/neo_hookean/" + damping.name;
      benchmark::RegisterBenchmark(name.c_str(), [kernels, damping](benchmark::State& state) {
        three_field(state, kernels, damping);
      })->Unit(benchmark::kMicrosecond);
    }
  }
  add_number_type<double>();
  add_number_type<float>();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
