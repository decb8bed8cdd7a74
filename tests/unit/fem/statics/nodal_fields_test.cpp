#include "fem/statics/nodal_fields.h"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/laws/neo_hookean.h"
#include "tests/unit/fem/statics/hollow_cube_space.h"

namespace menger::fem {
namespace {

constexpr double shear_modulus_Pa = 5e4;
constexpr double bulk_modulus_Pa = 2.5e6;

Body neo_hookean_body(Formulation formulation) {
  Body body;
  body.formulation = formulation;
  body.regions.push_back({materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{bulk_modulus_Pa}, 0.0});
  return body;
}

NodalFields fields_of(const Space& space, const Body& body, const std::vector<double>& displacements) {
  Assembly assembly(space, body);
  return nodal_fields(assembly, displacements);
}

TEST(NodalFields, OfAHomogeneousDeformationAreItsClosedForm) {
  // stretches 1.2, 0.9, 1.05: sigma_i = mu J^(-5/3) (lambda_i^2 - mean) + kappa/2 (J - 1/J)
  const Point stretches{1.2, 0.9, 1.05};
  const double J = 1.2 * 0.9 * 1.05;
  const double mean = (1.2 * 1.2 + 0.9 * 0.9 + 1.05 * 1.05) / 3.0;
  for (const int degree : {1, 2}) {
    for (const Formulation formulation : {Formulation::three_field, Formulation::displacement}) {
      const Space space = hollow_cube_space(degree);
      const auto displacements = at_nodes(space, [&](const Point& X) {
        return Point{(stretches[0] - 1.0) * X[0], (stretches[1] - 1.0) * X[1], (stretches[2] - 1.0) * X[2]};
      });
      const NodalFields fields = fields_of(space, neo_hookean_body(formulation), displacements);
      for (std::size_t n = 0; n < space.positions.size(); ++n) {
        EXPECT_NEAR(fields.volume_ratio[n], J, 1e-12);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(fields.deformation_gradient[n][4 * i], stretches[i], 1e-12);
          const double sigma_Pa = shear_modulus_Pa * std::pow(J, -5.0 / 3.0) * (stretches[i] * stretches[i] - mean) +
                                  0.5 * bulk_modulus_Pa * (J - 1.0 / J);
          EXPECT_NEAR(fields.cauchy_stress[n][i], sigma_Pa, 1e-9 * bulk_modulus_Pa);  // rounding of F times kappa
          EXPECT_NEAR(fields.cauchy_stress[n][3 + i], 0.0, 1e-9 * bulk_modulus_Pa);
        }
      }
    }
  }
}

TEST(NodalFields, OfDegreeTwoAreExactForLinearGradients) {
  const Space space = hollow_cube_space(2);
  constexpr double a = 5.0;  // 1/m: the gradient changes by 0.2 across the body
  const auto displacements = at_nodes(space, [&](const Point& X) { return Point{a * X[0] * X[0], a * X[0] * X[2], 0.0}; });
  const NodalFields fields = fields_of(space, neo_hookean_body(Formulation::displacement), displacements);
  for (std::size_t n = 0; n < space.positions.size(); ++n) {
    const Point& X = space.positions[n];
    EXPECT_NEAR(fields.deformation_gradient[n][0], 1.0 + 2.0 * a * X[0], 1e-12);
    EXPECT_NEAR(fields.deformation_gradient[n][3], a * X[2], 1e-12);
    EXPECT_NEAR(fields.deformation_gradient[n][5], a * X[0], 1e-12);
  }
}

TEST(NodalFields, PrincipalStretchesDoNotSeeRotationsAndDescend) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  // R U with a turn about z and U = diag(0.8, 1.5, 1.1)
  const std::array<double, 9> F{0.8 * c, -1.5 * s, 0.0, 0.8 * s, 1.5 * c, 0.0, 0.0, 0.0, 1.1};
  const auto stretches = principal_stretches(F);
  EXPECT_NEAR(stretches[0], 1.5, 1e-13);
  EXPECT_NEAR(stretches[1], 1.1, 1e-13);
  EXPECT_NEAR(stretches[2], 0.8, 1e-13);
}

TEST(NodalFields, VonMisesStressIsTheAxialOneAndRootThreeTimesShear) {
  EXPECT_DOUBLE_EQ(von_mises_stress({-700.0, 0.0, 0.0, 0.0, 0.0, 0.0}), 700.0);
  EXPECT_DOUBLE_EQ(von_mises_stress({0.0, 0.0, 0.0, 0.0, 100.0, 0.0}), std::sqrt(3.0) * 100.0);
  EXPECT_DOUBLE_EQ(von_mises_stress({5e3, 5e3, 5e3, 0.0, 0.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(hydrostatic_pressure({-1.0, -2.0, -3.0, 9.0, 9.0, 9.0}), 2.0);
}

}  // namespace
}  // namespace menger::fem
