#include "fem/boxes/explicit_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fem/elements/inverse_cube_root.h"
#include "tests/unit/fem/elements/element_samples.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

std::vector<ExplicitMaterial> all_materials() {
  const std::vector<materials::HyperelasticLaw> laws{
      materials::NeoHookean{50e3},
      materials::MooneyRivlin{20e3, 5e3},
      materials::Yeoh{21e3, 2.5e3, 0.1e3},
      materials::Ogden<1>{{materials::OgdenTerm{25e3, 3.25}}},
      materials::Ogden<2>{{materials::OgdenTerm{60e3, 1.5}, materials::OgdenTerm{-2.5e3, -4.0}}},
      materials::Ogden<3>{{materials::OgdenTerm{10e3, 2.0}, materials::OgdenTerm{20e3, 1.3}, materials::OgdenTerm{-3e3, -2.5}}},
      materials::Gent{46e3, 20.0},
      materials::ArrudaBoyce{32e3, 1.6}};
  std::vector<ExplicitMaterial> result;
  for (const auto& law : laws) {
    result.push_back({law, materials::QuadraticVolume{1e6}, 0.0});
    result.push_back({law, materials::LogSquaredVolume{1e6}, 0.0});
    result.push_back({law, materials::SimoTaylorVolume{1e6}, 0.0});
  }
  return result;
}

std::string description(const ExplicitKernels& kernels, const ExplicitMaterial& material) {
  return std::string(kernels.instruction_set) + ", " + std::string(materials::name_of(material.law)) + ", volumetric law " +
         std::to_string(material.volume.index());
}

/// 27 boxes with edges of 1, 1.1 and 0.9, 1/3 of each: the last batch of any width is not full.
meshes::HexahedralMesh box_of_blocks() { return meshes::box({1.0, 1.1, 0.9}, {3, 3, 3}); }

double largest_magnitude(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

TEST(InverseCubeRoot, IsAccurateToRounding) {
  using Pack = xsimd::batch<double>;
  for (double x = 1e-6; x < 1e6; x *= 1.0137) {
    const double y = detail::inverse_cube_root(Pack(x)).get(0);
    EXPECT_NEAR(y * std::cbrt(x), 1.0, 1e-15) << x;  // a few units in the last place
  }
}

// The implicit elements know nothing of boxes: their gradients come from the Jacobian.
TEST(ExplicitKernels, ForcesAndEnergyAreThoseOfTheImplicitElements) {
  const meshes::HexahedralMesh mesh = box_of_blocks();
  const std::vector<double> displacements = random_numbers(3 * mesh.points.size(), 0.06, 1);
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    for (const ExplicitMaterial& material : all_materials()) {
      SCOPED_TRACE(description(kernels, material));
      const ExplicitBody body(
          mesh, {.regions = {{material, 1.0}}, .supports = {}, .point_supports = {}, .elements = ThreeFieldOptions{kernels}});
      std::vector<double> expected(displacements.size(), 0.0);
      double energy = 0.0;
      for (const meshes::ElementCorners& corners : mesh.elements) {
        SampleElement element;
        for (const std::size_t node : corners) {
          for (std::size_t i = 0; i < 3; ++i) {
            element.positions.push_back(mesh.points[node][i]);
            element.displacements.push_back(displacements[3 * node + i]);
          }
        }
        const ElementKernels implicit = best_element_kernels();
        const ElementMaterial same{1, Formulation::three_field, material.law, material.volume};
        const ElementResponse response = SampleBatch(implicit, same, {element}).evaluate()[0];
        ASSERT_GT(response.smallest_ratio, 0.0);
        energy += response.energy;
        for (std::size_t c = 0; c < 8; ++c)
          for (std::size_t i = 0; i < 3; ++i) expected[3 * corners[c] + i] += response.residual[3 * c + i];
      }
      const std::vector<double> forces = internal_forces(body, {displacements.data()});
      for (std::size_t n = 0; n < forces.size(); ++n)
        ASSERT_NEAR(forces[n], expected[n], 1e-12 * largest_magnitude(expected)) << n;
      EXPECT_NEAR(strain_energy_J(body, displacements), energy, 1e-12 * energy);
    }
  }
}

TEST(ExplicitKernels, ViscousForceOfSimpleShearIsThatOfAFluid) {
  const meshes::HexahedralMesh mesh = box_of_blocks();
  constexpr double viscosity = 7.0;
  constexpr double rate = 3.0;
  const std::vector<double> rest(3 * mesh.points.size(), 0.0);
  std::vector<double> velocities = rest;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) velocities[3 * n] = rate * mesh.points[n][1];
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    ExplicitMaterial material{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{1e6}, viscosity};
    const ExplicitBody body(
        mesh, {.regions = {{material, 1.0}}, .supports = {}, .point_supports = {}, .elements = ThreeFieldOptions{kernels}});
    const NodalMotion motion{rest.data(), velocities.data()};
    AlignedNumbers slots(24 * kernels.width * three_field(body).boxes().batch_count());
    const ElementsOutcome outcome =
        three_field(body).forces(motion, {0, three_field(body).boxes().batch_count()}, {}, slots.data());
    const double volume = 1.0 * 1.1 * 0.9;
    EXPECT_NEAR(outcome.dissipated_W, viscosity * rate * rate * volume, 1e-12 * viscosity * rate * rate);
    const std::vector<double> forces = internal_forces(body, motion);
    double power = 0.0;
    double top = 0.0;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      for (std::size_t i = 0; i < 3; ++i) power += forces[3 * n + i] * velocities[3 * n + i];
      if (mesh.points[n][1] > 1.0999) top += forces[3 * n];
    }
    EXPECT_NEAR(power, outcome.dissipated_W, 1e-12 * power);
    EXPECT_NEAR(top, viscosity * rate * 1.0 * 0.9, 1e-12 * top);  // shear stress times area
  }
}

// d is zero for any deformed body that turns, and its trace does not count.
TEST(ExplicitKernels, ViscousForceIgnoresRotationAndDilation) {
  const meshes::HexahedralMesh mesh = box_of_blocks();
  const std::vector<double> displacements = random_numbers(3 * mesh.points.size(), 0.05, 2);
  const Point spin{1.0, -2.0, 0.5};
  std::vector<double> velocities;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    Point x = mesh.points[n];
    for (std::size_t i = 0; i < 3; ++i) x[i] += displacements[3 * n + i];
    const Point velocity = sum(cross(spin, x), scaled(0.7, x));
    velocities.insert(velocities.end(), velocity.begin(), velocity.end());
  }
  const ExplicitMaterial viscous{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{1e6}, 100.0};
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    const ExplicitBody body(
        mesh, {.regions = {{viscous, 1.0}}, .supports = {}, .point_supports = {}, .elements = ThreeFieldOptions{kernels}});
    const std::vector<double> with = internal_forces(body, {displacements.data(), velocities.data()});
    const std::vector<double> without = internal_forces(body, {displacements.data()});
    for (std::size_t n = 0; n < with.size(); ++n) EXPECT_NEAR(with[n], without[n], 1e-12 * largest_magnitude(without));
  }
}

// On a deformed body the power of the viscous forces must still be what is called dissipated, and positive.
TEST(ExplicitKernels, DissipationIsThePowerOfTheViscousForce) {
  const meshes::HexahedralMesh mesh = box_of_blocks();
  const std::vector<double> displacements = random_numbers(3 * mesh.points.size(), 0.05, 3);
  const std::vector<double> velocities = random_numbers(3 * mesh.points.size(), 1.0, 4);
  for (const materials::HyperelasticLaw& law : {materials::HyperelasticLaw{materials::NeoHookean{50e3}},
                                                materials::HyperelasticLaw{materials::Yeoh{21e3, 2.5e3, 0.1e3}}}) {
    for (const ExplicitKernels& kernels : available_explicit_kernels()) {
      const ExplicitMaterial material{law, materials::SimoTaylorVolume{1e6}, 50.0};
      const ExplicitBody body(
          mesh, {.regions = {{material, 1.0}}, .supports = {}, .point_supports = {}, .elements = ThreeFieldOptions{kernels}});
      AlignedNumbers slots(24 * kernels.width * three_field(body).boxes().batch_count());
      const NodalMotion motion{displacements.data(), velocities.data()};
      const double dissipated =
          three_field(body).forces(motion, {0, three_field(body).boxes().batch_count()}, {}, slots.data()).dissipated_W;
      const std::vector<double> with = internal_forces(body, motion);
      const std::vector<double> without = internal_forces(body, {displacements.data()});
      double power = 0.0;
      for (std::size_t n = 0; n < with.size(); ++n) power += (with[n] - without[n]) * velocities[n];
      EXPECT_GT(dissipated, 0.0);
      EXPECT_NEAR(power, dissipated, 1e-10 * dissipated);  // elastic forces, subtracted, are larger
    }
  }
}

TEST(ExplicitKernels, AnswersThatDoNotExistAreReported) {
  const meshes::HexahedralMesh mesh = box_of_blocks();
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    const ExplicitMaterial gent{materials::Gent{46e3, 20.0}, materials::SimoTaylorVolume{1e6}, 0.0};
    const ExplicitBody body(
        mesh, {.regions = {{gent, 1.0}}, .supports = {}, .point_supports = {}, .elements = ThreeFieldOptions{kernels}});
    AlignedNumbers slots(24 * kernels.width * three_field(body).boxes().batch_count());
    const auto ratio_of = [&](const std::vector<double>& displacements) {
      return three_field(body)
          .forces({displacements.data()}, {0, three_field(body).boxes().batch_count()}, {}, slots.data())
          .smallest_ratio;
    };
    const auto stretched = [&](double stretch, double across) {
      std::vector<double> u;
      for (const Point& X : mesh.points) {
        u.push_back((stretch - 1.0) * X[0]);
        u.push_back((across - 1.0) * X[1]);
        u.push_back((across - 1.0) * X[2]);
      }
      return u;
    };
    EXPECT_NEAR(ratio_of(stretched(1.2, 0.9)), 1.2 * 0.81, 1e-12);
    EXPECT_LE(ratio_of(stretched(-1.0, 1.0)), 0.0);
    EXPECT_LE(ratio_of(stretched(5.0, 1.0 / std::sqrt(5.0))), 0.0);  // I1 - 3 = 22.4 is beyond the limit of 20
    std::vector<double> none = stretched(1.0, 1.0);
    none[41] = std::nan("");
    EXPECT_LE(ratio_of(none), 0.0);
    ASSERT_TRUE(body.elements().failed_element(none));
    EXPECT_FALSE(body.elements().failed_element(none)->is_finite);
  }
}

}  // namespace
}  // namespace menger::fem
