// Patch tests: on distorted hexahedra every element has to reproduce a homogeneous deformation, and with it a constant stress, up
// to the tolerance of the solver. Tables hold eight digits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fem_model.h"
#include "fem_table.h"
#include "materials/laws/homogeneous_deformations.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/materials/laws/law_samples.h"

namespace menger::fem {
namespace {

using materials::Tensor;

constexpr Point size{0.010, 0.008, 0.006};
constexpr EquilibriumOptions tight{.relative_force_tolerance = 1e-10, .linear = {}};

/// A box whose inner points are shifted at random, and those on its sides within them.
meshes::HexahedralMesh distorted_box() {
  constexpr std::size_t elements = 3;
  meshes::HexahedralMesh mesh = meshes::box(size, {elements, elements, elements});
  std::mt19937 generator(1);
  for (Point& point : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double shift = 2.0 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1.0;
      if (point[i] > 1e-3 * size[i] && point[i] < 0.999 * size[i]) point[i] += 0.2 * size[i] / elements * shift;
    }
  }
  return mesh;
}

/// Tractions P N of a homogeneous first Piola-Kirchhoff stress on all six sides of a box.
void load(Body& body, const meshes::HexahedralMesh& mesh, const Tensor<double>& stress) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Point column{stress(0, axis), stress(1, axis), stress(2, axis)};
    const std::string name(1, "xyz"[axis]);
    body.tractions.push_back({meshes::label_index(mesh, name + " min"), scaled(-1.0, column)});
    body.tractions.push_back({meshes::label_index(mesh, name + " max"), column});
  }
}

template <class F>
void for_each_element(F&& f) {
  for (const int degree : {1, 2})
    for (const Formulation formulation : {Formulation::three_field, Formulation::displacement}) f(degree, formulation);
}

/// sigma = P F^T / J of a material.
template <class Material>
Tensor<double> cauchy_stress(const Material& material, const Tensor<double>& F) {
  return materials::combination(1.0 / materials::determinant(F),
                                materials::product(first_piola_stress(material, F), transpose(F)), 0.0, F);
}

/// The largest difference of the Cauchy stress from a constant, Pa, over all points of all elements.
double stress_error_Pa(Model& model, const Tensor<double>& expected) {
  double largest = 0.0;
  model.equilibrium.assembly().elements().evaluate_points(
      model.state.displacements_m, [&](const ElementGroups::PointResult& points) {
        for (std::size_t n = 0; n < points.cauchy_stress.size(); ++n)
          largest = std::max(largest, std::abs(points.cauchy_stress[n] - expected.components[n % 9]));
      });
  return largest;
}

std::vector<double> homogeneous_displacements(const Space& space, const Tensor<double>& F) {
  std::vector<double> displacements;
  for (const Point& X : space.positions)
    for (std::size_t i = 0; i < 3; ++i) displacements.push_back(F(i, 0) * X[0] + F(i, 1) * X[1] + F(i, 2) * X[2] - X[i]);
  return displacements;
}

/// Solves from a state that is a thousandth of the box away from that of F, and expects F. Solutions need not be stable: under
/// dead loads compressed blocks may give way.
void expect_homogeneous(Model& model, const Tensor<double>& F, const Tensor<double>& cauchy_stress_Pa, double tolerance) {
  const std::vector<double> exact = homogeneous_displacements(model.space, F);
  std::mt19937 generator(2);
  model.state.displacements_m = exact;
  for (double& u : model.state.displacements_m) u += 1e-3 * size[2] * static_cast<double>(generator()) / 4294967295.0;
  const EquilibriumReport report = model.equilibrium.solve(model.state, {}, 1.0);
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_LT(materials::distance(model.state.displacements_m, exact), tolerance * size[0]);
  EXPECT_LT(stress_error_Pa(model, cauchy_stress_Pa), 100.0 * tolerance * materials::largest(cauchy_stress_Pa.components));
}

/// Stretch and shear in every direction. F is upper triangular, so that the origin, a point on the x axis and one on the y axis
/// hold its rotation without a force.
TEST(PatchTest, DistortedElementsReproduceAGeneralDeformationOfEveryLaw) {
  const Tensor<double> F{{1.3, 0.2, -0.15, 0.0, 0.9, 0.25, 0.0, 0.0, 0.856}};
  materials::for_each_law([&](const auto& law) {
    const auto material = materials::with_volume(law);
    const Tensor<double> stress = cauchy_stress(material, F);
    for_each_element([&](int degree, Formulation formulation) {
      SCOPED_TRACE(std::string(materials::name_of(law)) + ", degree " + std::to_string(degree));
      const meshes::HexahedralMesh mesh = distorted_box();
      Body body = body_of(law, material.volume, formulation);
      load(body, mesh, first_piola_stress(material, F));
      body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, true}},
                             {{size[0], 0.0, 0.0}, {false, true, true}},
                             {{0.0, size[1], 0.0}, {false, false, true}}};
      Model model(mesh, degree, body, tight);
      expect_homogeneous(model, F, stress, 1e-9);
    });
  });
}

struct UniaxialState {
  double stretch;
  double lateral_stretch;
  double cauchy_stress_Pa;
  double nominal_stress_Pa;
  double energy_density_Pa;
};

/// Dead load on one side, symmetry on three: the lateral sides are free.
TEST(PatchTest, NearlyIncompressibleUniaxialStatesAreThoseOfTheTable) {
  const std::vector<UniaxialState> table{{0.7, 1.191491800, -46970.352, -66681.588, 8629.6901},
                                         {1.3, 0.879713417, 45345.962, 35093.045, 5665.0539},
                                         {2.0, 0.715072153, 168040.479, 85923.833, 49341.7989}};
  for (const UniaxialState& expected : table) {
    for_each_element([&](int degree, Formulation formulation) {
      const meshes::HexahedralMesh mesh = distorted_box();
      Body body = body_of(materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, formulation);
      hold(body, mesh, "x min", {true, false, false});
      hold(body, mesh, "y min", {false, true, false});
      hold(body, mesh, "z min", {false, false, true});
      body.tractions = {{meshes::label_index(mesh, "x max"), {expected.nominal_stress_Pa, 0.0, 0.0}}};
      Model model(mesh, degree, body, tight);
      const double lateral = expected.lateral_stretch;
      // the digits of the table
      expect_homogeneous(model, materials::diagonal(expected.stretch, lateral, lateral),
                         materials::diagonal(expected.cauchy_stress_Pa, 0.0, 0.0), 1e-8);
      const Point corner = model.displacement_at(size);
      const std::string name = "uniaxial " + std::to_string(expected.stretch).substr(0, 3) + (degree == 1 ? " Q1" : " Q2") +
                               (formulation == Formulation::displacement ? ""
                                : degree == 1                            ? "/P0"
                                                                         : "/P1");
      const double energy_J = model.equilibrium.totals(model.state).strain_energy_J;
      expect_close(name + ", stretch", 1.0 + corner[0] / size[0], expected.stretch, 1e-8);
      expect_close(name + ", lateral stretch", 1.0 + corner[1] / size[1], expected.lateral_stretch, 1e-8);
      expect_close(name + ", energy density Pa", energy_J / (size[0] * size[1] * size[2]), expected.energy_density_Pa, 1e-8);
    });
  }
}

/// The nominal stress of an incompressible body stretches one with kappa = 1e4 mu by 1 + O(mu / kappa) of what it should; with
/// the strong hardening of some laws and moduli up to 125 kPa the factor before mu / kappa stays below 5.
TEST(PatchTest, HomogeneousDeformationsAreThoseOfTheIncompressibleLaws) {
  constexpr double stretch = 1.3;
  constexpr double bulk_to_shear = 1e4;
  materials::for_each_law([&](const auto& law) {
    const double bulk_modulus_Pa = bulk_to_shear * materials::shear_modulus_at_rest_Pa(law);
    for (const auto mode :
         {materials::LoadingMode::uniaxial, materials::LoadingMode::equibiaxial, materials::LoadingMode::planar}) {
      const meshes::HexahedralMesh mesh = meshes::box(size, {1, 1, 1});
      Body body = body_of(law, materials::SimoTaylorVolume{bulk_modulus_Pa});
      hold(body, mesh, "x min", {true, false, false});
      hold(body, mesh, "y min", {false, true, false});
      hold(body, mesh, "z min", {false, false, true});
      const double stress_Pa = materials::nominal_stress(law, mode, stretch).stress_Pa;
      body.tractions = {{meshes::label_index(mesh, "x max"), {stress_Pa, 0.0, 0.0}}};
      if (mode == materials::LoadingMode::equibiaxial)
        body.tractions.push_back({meshes::label_index(mesh, "y max"), {0.0, stress_Pa, 0.0}});
      if (mode == materials::LoadingMode::planar) hold(body, mesh, "y max", {false, true, false});
      Model model(mesh, 1, body);
      model.follow({});
      const auto stretches = materials::stretches_of(mode, stretch);
      const Point corner = model.displacement_at(size);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(1.0 + corner[i] / size[i], stretches[i], 5.0 / bulk_to_shear) << materials::name_of(law) << ", " << i;
    }
  });
}

}  // namespace
}  // namespace menger::fem
