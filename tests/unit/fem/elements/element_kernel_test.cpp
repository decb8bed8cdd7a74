#include "fem/elements/element_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fem/surfaces/chamber_volume.h"
#include "materials/laws/homogeneous_deformations.h"
#include "materials/laws/nearly_incompressible.h"
#include "tests/unit/fem/elements/element_samples.h"

namespace menger::fem {
namespace {

using materials::HyperelasticLaw;
using materials::Tensor;

constexpr double bulk_modulus_Pa = 1e6;

std::vector<HyperelasticLaw> all_laws() {
  return {
      materials::NeoHookean{50e3},
      materials::MooneyRivlin{20e3, 5e3},
      materials::Yeoh{21e3, 2.5e3, 0.1e3},
      materials::Ogden<1>{{materials::OgdenTerm{25e3, 3.25}}},
      materials::Ogden<2>{{materials::OgdenTerm{60e3, 1.5}, materials::OgdenTerm{-2.5e3, -4.0}}},
      materials::Ogden<3>{{materials::OgdenTerm{10e3, 2.0}, materials::OgdenTerm{20e3, 1.3}, materials::OgdenTerm{-3e3, -2.5}}},
      materials::Gent{46e3, 20.0},
      materials::ArrudaBoyce{32e3, 1.6}};
}

std::vector<VolumetricLaw> all_volumetric_laws() {
  return {materials::QuadraticVolume{bulk_modulus_Pa}, materials::LogSquaredVolume{bulk_modulus_Pa},
          materials::SimoTaylorVolume{bulk_modulus_Pa}};
}

/// Every law with every volumetric energy, both degrees and both formulations.
std::vector<ElementMaterial> all_materials() {
  std::vector<ElementMaterial> materials;
  for (const int degree : {1, 2}) {
    for (const Formulation formulation : {Formulation::three_field, Formulation::displacement}) {
      for (const HyperelasticLaw& law : all_laws()) {
        for (const VolumetricLaw& volume : all_volumetric_laws()) materials.push_back({degree, formulation, law, volume});
      }
    }
  }
  return materials;
}

std::string description(const ElementMaterial& material) {
  return std::string(materials::name_of(material.law)) + ", volumetric law " + std::to_string(material.volume.index()) +
         ", degree " + std::to_string(material.degree) +
         (material.formulation == Formulation::three_field ? ", three fields" : ", displacements");
}

ElementMaterial plain_material(int degree, Formulation formulation = Formulation::three_field) {
  return {degree, formulation, materials::NeoHookean{50e3}, materials::SimoTaylorVolume{bulk_modulus_Pa}};
}

SampleElement moved(SampleElement element, const std::vector<double>& direction, double step) {
  for (std::size_t n = 0; n < direction.size(); ++n) element.displacements[n] += step * direction[n];
  return element;
}

ElementResponse response_of(const ElementKernels& kernels, const ElementMaterial& material, const SampleElement& element) {
  return SampleBatch(kernels, material, {element}).evaluate()[0];
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum;
}

std::vector<double> product_with_matrix(const std::vector<double>& matrix, const std::vector<double>& vector) {
  std::vector<double> result(vector.size(), 0.0);
  for (std::size_t m = 0; m < vector.size(); ++m)
    for (std::size_t n = 0; n < vector.size(); ++n) result[m] += matrix[m * vector.size() + n] * vector[n];
  return result;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double result = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) result = std::max(result, std::abs(a[n] - b[n]));
  return result;
}

// Central differences along a direction in which every component takes part. Their error is about step^2 times the third
// derivative, some 1e-9 of the numbers compared, and that of rounding the energy 1e-16 / step.
constexpr double difference_step = 1e-5;
constexpr double difference_tolerance = 2e-8;

TEST(ElementKernels, ResidualIsTheDerivativeOfTheEnergy) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const SampleElement element = strained_element(material.degree, 1);
    const ElementResponse response = response_of(kernels, material, element);
    ASSERT_GT(response.smallest_ratio, 0.0) << description(material);
    for (unsigned seed = 2; seed < 5; ++seed) {
      const std::vector<double> direction = RandomNumbers(seed)(element.positions.size(), 1.0);
      const double ahead = response_of(kernels, material, moved(element, direction, difference_step)).energy;
      const double behind = response_of(kernels, material, moved(element, direction, -difference_step)).energy;
      const double difference = (ahead - behind) / (2.0 * difference_step);
      EXPECT_NEAR(product(response.residual, direction), difference, difference_tolerance * largest(response.residual))
          << description(material);
    }
  }
}

TEST(ElementKernels, StiffnessIsTheDerivativeOfTheResidual) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const SampleElement element = strained_element(material.degree, 6);
    const ElementResponse response = response_of(kernels, material, element);
    const std::vector<double> direction = RandomNumbers(7)(element.positions.size(), 1.0);
    std::vector<double> difference = response_of(kernels, material, moved(element, direction, difference_step)).residual;
    const std::vector<double> behind = response_of(kernels, material, moved(element, direction, -difference_step)).residual;
    for (std::size_t n = 0; n < difference.size(); ++n) difference[n] = (difference[n] - behind[n]) / (2.0 * difference_step);
    EXPECT_LT(largest_difference(product_with_matrix(response.stiffness, direction), difference),
              difference_tolerance * largest(response.stiffness))
        << description(material);
  }
}

TEST(ElementKernels, StiffnessIsSymmetric) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const ElementResponse response = response_of(kernels, material, strained_element(material.degree, 8));
    const std::size_t columns = 3 * ElementShape{material.degree}.nodes();
    const double tolerance = 1e-13 * largest(response.stiffness);  // rounding; only blocks on the diagonal could be unsymmetric
    for (std::size_t m = 0; m < columns; ++m)
      for (std::size_t n = 0; n < m; ++n)
        ASSERT_NEAR(response.stiffness[m * columns + n], response.stiffness[n * columns + m], tolerance) << description(material);
  }
}

// No net force and no net moment about the origin in the current configuration. Tolerance: rounding of 27 terms.
TEST(ElementKernels, ResidualIsInBalance) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const SampleElement element = strained_element(material.degree, 9);
    const std::vector<double> residual = response_of(kernels, material, element).residual;
    Point force{};
    Point moment{};
    for (std::size_t n = 0; n < residual.size(); n += 3) {
      const Point nodal{residual[n], residual[n + 1], residual[n + 2]};
      Point x{};
      for (std::size_t i = 0; i < 3; ++i) x[i] = element.positions[n + i] + element.displacements[n + i];
      force = sum(force, nodal);
      moment = sum(moment, cross(x, nodal));
    }
    EXPECT_LT(norm(force), 1e-12 * largest(residual)) << description(material);
    EXPECT_LT(norm(moment), 1e-12 * largest(residual)) << description(material);
  }
}

TEST(ElementKernels, RotatedElementIsAtRest) {
  const ElementKernels kernels = best_element_kernels();
  const double c = std::cos(2.0);
  const double s = std::sin(2.0);
  for (const ElementMaterial& material : all_materials()) {
    SampleElement element = strained_element(material.degree, 1);
    for (std::size_t n = 0; n < element.positions.size(); n += 3) {
      const double x = element.positions[n];
      const double y = element.positions[n + 1];
      element.displacements[n] = c * x - s * y - x + 3.0;
      element.displacements[n + 1] = s * x + c * y - y;
      element.displacements[n + 2] = -1.0;
    }
    const ElementResponse response = response_of(kernels, material, element);
    EXPECT_NEAR(response.energy, 0.0, 1e-15 * bulk_modulus_Pa) << description(material);
    // rounding of F times the bulk modulus
    EXPECT_LT(largest(response.residual), 1e-13 * bulk_modulus_Pa) << description(material);
    EXPECT_NEAR(response.smallest_ratio, 1.0, 1e-13) << description(material);
  }
}

TEST(ElementKernels, InstructionSetsAgreeToRounding) {
  const std::vector<ElementKernels> all = available_element_kernels();
  ASSERT_EQ(all.front().instruction_set, "baseline");
  EXPECT_EQ(best_element_kernels().instruction_set, all.back().instruction_set);
  for (const ElementMaterial& material : all_materials()) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      const SampleElement element = strained_element(material.degree, seed);
      const std::vector<double> step = RandomNumbers(seed + 20)(element.positions.size(), 0.01);
      const ElementResponse first = response_of(all.front(), material, element);
      const auto first_pressure = SampleBatch(all.front(), material, {element}).predict_pressure({step})[0];
      const auto first_points = SampleBatch(all.front(), material, {element}).evaluate_points()[0];
      for (const ElementKernels& other : all) {
        SCOPED_TRACE(description(material) + ", " + std::string(other.instruction_set));
        const ElementResponse response = response_of(other, material, element);
        EXPECT_NEAR(response.energy, first.energy, 1e-12 * first.energy);
        EXPECT_NEAR(response.smallest_ratio, first.smallest_ratio, 1e-12);
        EXPECT_LT(largest_difference(response.residual, first.residual), 1e-12 * largest(first.residual));
        EXPECT_LT(largest_difference(response.stiffness, first.stiffness), 1e-12 * largest(first.stiffness));
        const SampleBatch batch(other, material, {element});
        EXPECT_LT(largest_difference(batch.predict_pressure({step})[0], first_pressure), 1e-12 * bulk_modulus_Pa);
        EXPECT_LT(largest_difference(batch.evaluate_points()[0].cauchy_stress, first_points.cauchy_stress),
                  1e-12 * largest(first_points.cauchy_stress));
      }
    }
  }
}

// Every lane computes its own element, whatever its neighbours are: here one of them does not exist.
TEST(ElementKernels, LanesDoNotDisturbEachOther) {
  for (const ElementKernels& kernels : available_element_kernels()) {
    for (const int degree : {1, 2}) {
      const ElementMaterial material = plain_material(degree);
      std::vector<SampleElement> elements;
      for (unsigned lane = 0; lane < kernels.width; ++lane) elements.push_back(strained_element(degree, lane));
      for (double& u : elements[kernels.width / 2].displacements) u *= 1e3;
      const auto together = SampleBatch(kernels, material, elements).evaluate();
      for (std::size_t lane = 0; lane < kernels.width; ++lane) {
        if (lane == kernels.width / 2) continue;
        const ElementResponse alone = response_of(kernels, material, elements[lane]);
        EXPECT_EQ(together[lane].energy, alone.energy) << kernels.instruction_set;
        EXPECT_EQ(together[lane].smallest_ratio, alone.smallest_ratio) << kernels.instruction_set;
        EXPECT_EQ(together[lane].residual, alone.residual) << kernels.instruction_set;
        EXPECT_EQ(together[lane].stiffness, alone.stiffness) << kernels.instruction_set;
      }
    }
  }
}

TEST(ElementKernels, EnergyAloneIsThatWithEverything) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const SampleBatch batch(kernels, material, {strained_element(material.degree, 3)});
    const ElementResponse all = batch.evaluate()[0];
    EXPECT_DOUBLE_EQ(batch.evaluate_energy()[0].energy, all.energy) << description(material);
    EXPECT_DOUBLE_EQ(batch.evaluate_energy()[0].smallest_ratio, all.smallest_ratio) << description(material);
  }
}

/// An element whose every point has the deformation gradient diag(stretches).
SampleElement stretched_element(int degree, const std::array<double, 3>& stretches) {
  SampleElement element = strained_element(degree, 1);
  for (std::size_t n = 0; n < element.positions.size(); ++n)
    element.displacements[n] = (stretches[n % 3] - 1.0) * element.positions[n];
  return element;
}

TEST(ElementKernels, SmallestRatioIsThatOfTheVolume) {
  for (const ElementKernels& kernels : available_element_kernels()) {
    for (const int degree : {1, 2}) {
      const ElementResponse response = response_of(kernels, plain_material(degree), stretched_element(degree, {0.9, 0.8, 1.1}));
      EXPECT_NEAR(response.smallest_ratio, 0.9 * 0.8 * 1.1, 1e-13);
    }
  }
}

TEST(ElementKernels, InvertedElementIsReported) {
  for (const ElementKernels& kernels : available_element_kernels()) {
    for (const ElementMaterial& material : all_materials()) {
      const SampleElement inside_out = stretched_element(material.degree, {1.0, 1.0, -0.5});
      EXPECT_FALSE(response_of(kernels, material, inside_out).smallest_ratio > 0.0) << description(material);
      const SampleElement flat = stretched_element(material.degree, {1.0, 1.0, 0.0});
      EXPECT_FALSE(response_of(kernels, material, flat).smallest_ratio > 1e-12) << description(material);
    }
  }
}

// One corner is pushed through the element: at most points the volume ratio stays positive.
TEST(ElementKernels, PartlyInvertedElementIsReported) {
  for (const ElementKernels& kernels : available_element_kernels()) {
    for (const int degree : {1, 2}) {
      SampleElement element = strained_element(degree, 1);
      std::fill(element.displacements.begin(), element.displacements.end(), 0.0);
      element.displacements[0] = element.displacements[1] = element.displacements[2] = 0.9;
      const ElementMaterial material = plain_material(degree, Formulation::displacement);
      EXPECT_LT(response_of(kernels, material, element).smallest_ratio, 0.0);
    }
  }
}

// Gent: I1 - 3 must stay below the limit, 20; the uniaxial stretch 5 has I1 = 25.4.
TEST(ElementKernels, StretchBeyondLockingIsReported) {
  for (const ElementKernels& kernels : available_element_kernels()) {
    for (const int degree : {1, 2}) {
      ElementMaterial material = plain_material(degree);
      material.law = materials::Gent{46e3, 20.0};
      const auto uniaxial = [degree](double stretch) {
        return stretched_element(degree, {stretch, 1.0 / std::sqrt(stretch), 1.0 / std::sqrt(stretch)});
      };
      EXPECT_NEAR(response_of(kernels, material, uniaxial(4.5)).smallest_ratio, 1.0, 1e-12);
      EXPECT_LE(response_of(kernels, material, uniaxial(5.0)).smallest_ratio, 0.0);
    }
  }
}

TEST(ElementKernels, DisplacementsThatAreNoNumbersAreReported) {
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const ElementKernels& kernels : available_element_kernels()) {
      for (const ElementMaterial& material : all_materials()) {
        SampleElement element = strained_element(material.degree, 1);
        element.displacements[5] = none;
        EXPECT_FALSE(response_of(kernels, material, element).smallest_ratio > 0.0) << description(material);
      }
    }
  }
}

/// U'(J) of a volumetric law.
double volumetric_stress_Pa(const VolumetricLaw& law, double ratio) {
  return std::visit([ratio](const auto& any) { return any.derivative(ratio); }, law);
}

TEST(ElementKernels, StepOfZeroPredictsThePressureOfTheState) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const std::vector<double> zero(3 * ElementShape{material.degree}.nodes(), 0.0);
    // where the volume ratio is the same everywhere, the pressure is known
    const SampleBatch even(kernels, material, {stretched_element(material.degree, {1.1, 0.9, 1.02})});
    const double truth_Pa = volumetric_stress_Pa(material.volume, 1.1 * 0.9 * 1.02);
    const auto even_pressures = even.predict_pressure({zero});
    for (const double pressure_Pa : even_pressures[0])
      EXPECT_NEAR(pressure_Pa, truth_Pa, 1e-12 * bulk_modulus_Pa) << description(material);
    // elsewhere it is minus the hydrostatic pressure, and the stiffness with it the exact one
    const SampleBatch uneven(kernels, material, {strained_element(material.degree, 4)});
    const auto predicted = uneven.predict_pressure({zero});
    const std::vector<double> hydrostatic = uneven.evaluate_points()[0].pressure;
    for (std::size_t q = 0; q < hydrostatic.size(); ++q)
      EXPECT_NEAR(predicted[0][q], -hydrostatic[q], 1e-12 * bulk_modulus_Pa) << description(material);
    const ElementResponse exact = uneven.evaluate()[0];
    const ElementResponse with_prediction = uneven.evaluate(predicted)[0];
    EXPECT_LT(largest_difference(with_prediction.stiffness, exact.stiffness), 1e-13 * largest(exact.stiffness))
        << description(material);
  }
}

// What is left out is of second order: half the step leaves a quarter of the error.
TEST(ElementKernels, PredictedPressureIsRightToFirstOrder) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const SampleElement element = strained_element(material.degree, 4);
    const std::vector<double> direction = RandomNumbers(5)(element.positions.size(), 1.0);
    const std::vector<double> zero(direction.size(), 0.0);
    const auto error_of = [&](double length) {
      std::vector<double> step = direction;
      for (double& component : step) component *= length;
      const auto predicted = SampleBatch(kernels, material, {element}).predict_pressure({step})[0];
      const auto truth = SampleBatch(kernels, material, {moved(element, direction, length)}).predict_pressure({zero})[0];
      return largest_difference(predicted, truth);
    };
    EXPECT_NEAR(error_of(2e-4) / error_of(1e-4), 4.0, 0.1) << description(material);
  }
}

TEST(ElementKernels, PredictedPressureLeavesEnergyAndResidual) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    const SampleBatch batch(kernels, material, {strained_element(material.degree, 4)});
    const ElementResponse exact = batch.evaluate()[0];
    const ElementResponse other = batch.evaluate({RandomNumbers(6)(ElementShape{material.degree}.points(), 1e5)})[0];
    EXPECT_EQ(other.energy, exact.energy) << description(material);
    EXPECT_EQ(other.residual, exact.residual) << description(material);
    EXPECT_GT(largest_difference(other.stiffness, exact.stiffness), 1e-3 * largest(exact.stiffness)) << description(material);
  }
}

/// Hessian of the volume of a hexahedron by the positions of its nodes, from its six faces.
template <std::size_t n>
std::vector<double> hessian_of_volume(int degree, const SampleElement& element) {
  const std::size_t side = static_cast<std::size_t>(degree) + 1;
  const std::size_t columns = element.positions.size();
  std::vector<double> hessian(columns * columns, 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool is_far : {false, true}) {
      std::array<std::size_t, n> nodes{};
      FaceNodes<n> face;
      for (std::size_t a = 0; a < n; ++a) {
        // u x v is the axis if u and v follow it in cyclic order
        std::array<std::size_t, 3> at{};
        at[axis] = is_far ? side - 1 : 0;
        at[(axis + (is_far ? 1 : 2)) % 3] = a % side;
        at[(axis + (is_far ? 2 : 1)) % 3] = a / side;
        nodes[a] = at[0] + side * (at[1] + side * at[2]);
        for (std::size_t i = 0; i < 3; ++i)
          face[a][i] = element.positions[3 * nodes[a] + i] + element.displacements[3 * nodes[a] + i];
      }
      const auto share = chamber_volume_hessian<n>(face);  // of the air outside: minus that of the solid
      for (std::size_t a = 0; a < 3 * n; ++a) {
        for (std::size_t b = 0; b < 3 * n; ++b) {
          const std::size_t row = 3 * nodes[a / 3] + a % 3;
          hessian[row * columns + 3 * nodes[b / 3] + b % 3] -= share[3 * n * a + b];
        }
      }
    }
  }
  return hessian;
}

// A pressure c that is the same at all points enters the energy as c times the element's volume, which Gauss's rule integrates
// exactly; so it changes the stiffness by c times the Hessian of the volume, computed here from the element's faces. In the
// displacement form too.
TEST(ElementKernels, PredictedPressureEntersTheStiffnessWithTheHessianOfTheVolume) {
  const ElementKernels kernels = best_element_kernels();
  for (const int degree : {1, 2}) {
    for (const Formulation formulation : {Formulation::three_field, Formulation::displacement}) {
      const ElementMaterial material = plain_material(degree, formulation);
      const SampleElement element = strained_element(degree, 4);
      const SampleBatch batch(kernels, material, {element});
      const std::size_t points = ElementShape{degree}.points();
      const ElementResponse without = batch.evaluate({std::vector<double>(points, 0.0)})[0];
      const ElementResponse with = batch.evaluate({std::vector<double>(points, 3e5)})[0];
      std::vector<double> expected = degree == 1 ? hessian_of_volume<4>(1, element) : hessian_of_volume<9>(2, element);
      for (double& entry : expected) entry *= 3e5;
      std::vector<double> change = with.stiffness;
      for (std::size_t n = 0; n < change.size(); ++n) change[n] -= without.stiffness[n];
      EXPECT_LT(largest_difference(change, expected), 1e-11 * largest(with.stiffness));  // rounding of the stiffness
    }
  }
}

// A homogeneous deformation is in both forms the one of the material: F as set, sigma = P F^T / J with P of the material itself.
TEST(ElementKernels, PointsOfAHomogeneousDeformationHaveTheStressOfTheMaterial) {
  const ElementKernels kernels = best_element_kernels();
  const Tensor<double> F{{1.2, 0.3, -0.1, 0.05, 0.9, 0.2, 0.1, -0.15, 1.05}};
  const double J = materials::determinant(F);
  for (const ElementMaterial& material : all_materials()) {
    SampleElement element = strained_element(material.degree, 1);
    for (std::size_t n = 0; n < element.positions.size(); n += 3) {
      for (std::size_t i = 0; i < 3; ++i) {
        element.displacements[n + i] = -element.positions[n + i];
        for (std::size_t j = 0; j < 3; ++j) element.displacements[n + i] += F(i, j) * element.positions[n + j];
      }
    }
    const Tensor<double> P = std::visit(
        [&F](const auto& law, const auto& volume) {
          return materials::first_piola_stress(
              materials::NearlyIncompressible<std::decay_t<decltype(law)>, std::decay_t<decltype(volume)>>{law, volume}, F);
        },
        material.law, material.volume);
    const Tensor<double> tau = materials::product(P, materials::transpose(F));
    const PointResponse points = SampleBatch(kernels, material, {element}).evaluate_points()[0];
    for (std::size_t q = 0; q < ElementShape{material.degree}.points(); ++q) {
      for (std::size_t n = 0; n < 9; ++n) {
        EXPECT_NEAR(points.deformation_gradient[9 * q + n], F.components[n], 1e-13) << description(material);
        EXPECT_NEAR(points.cauchy_stress[9 * q + n], tau.components[n] / J, 1e-12 * bulk_modulus_Pa) << description(material);
      }
      EXPECT_NEAR(points.volume_ratio[q], J, 1e-13) << description(material);
      EXPECT_NEAR(points.pressure[q], -(tau(0, 0) + tau(1, 1) + tau(2, 2)) / (3.0 * J), 1e-12 * bulk_modulus_Pa)
          << description(material);
    }
  }
}

// The nominal stress of an incompressible bar is that of the difference of two principal stresses, whatever the pressure.
TEST(ElementKernels, PointsOfAStretchedBarFollowItsFormula) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    for (const double stretch : {0.7, 1.0, 1.5, 2.5}) {
      const auto stretches = materials::stretches_of(materials::LoadingMode::uniaxial, stretch);
      const PointResponse points =
          SampleBatch(kernels, material, {stretched_element(material.degree, stretches)}).evaluate_points()[0];
      const auto nominal = materials::nominal_stress(material.law, materials::LoadingMode::uniaxial, stretch);
      ASSERT_EQ(nominal.status, materials::LawStatus::valid);
      for (std::size_t q = 0; q < ElementShape{material.degree}.points(); ++q) {
        const double difference_Pa = points.cauchy_stress[9 * q] - points.cauchy_stress[9 * q + 4];
        // the volume ratio is 1 but for rounding, which the bulk modulus multiplies
        EXPECT_NEAR(difference_Pa, stretch * nominal.stress_Pa, 1e-12 * bulk_modulus_Pa) << description(material);
      }
    }
  }
}

// The energy of a homogeneous deformation is its density times the element's volume, here that of the unit cube.
TEST(ElementKernels, EnergyOfAHomogeneousDeformationIsItsDensityTimesTheVolume) {
  const ElementKernels kernels = best_element_kernels();
  for (const ElementMaterial& material : all_materials()) {
    SampleElement element{nodal_values(material.degree, [](const Point& x) { return x; }), {}};
    const double stretch = 1.3;
    element.displacements = element.positions;
    for (double& u : element.displacements) u *= stretch - 1.0;
    const double density =
        std::visit([&](const auto& volume) { return volume.energy(stretch * stretch * stretch); }, material.volume);
    const ElementResponse response = response_of(kernels, material, element);
    EXPECT_NEAR(response.energy, density, 1e-12 * density) << description(material);
  }
}

}  // namespace
}  // namespace menger::fem
