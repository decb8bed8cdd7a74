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
  return nodal_fields(assembly, displacements, {});
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
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(fields.deformation_gradient[n][4 * i], stretches[i], 1e-12);
          const double sigma_Pa = shear_modulus_Pa * std::pow(J, -5.0 / 3.0) * (stretches[i] * stretches[i] - mean) +
                                  0.5 * bulk_modulus_Pa * (J - 1.0 / J);
          EXPECT_NEAR(fields.cauchy_stress[n][i], sigma_Pa, 1e-9 * bulk_modulus_Pa);  // rounding of F times kappa
          EXPECT_NEAR(fields.cauchy_stress[n][3 + i], 0.0, 1e-9 * bulk_modulus_Pa);
        }
      }
      ASSERT_EQ(fields.elements.size(), space.local_element_count());
      for (const ElementState& element : fields.elements) {
        EXPECT_NEAR(element.volume_ratio, J, 1e-12);
        EXPECT_NEAR(element.largest_stretch, 1.2, 1e-12);
        EXPECT_NEAR(element.von_mises_stress_Pa, von_mises_stress(fields.cauchy_stress.front()), 1e-8 * bulk_modulus_Pa);
      }
    }
  }
}

// Rough displacements: values at the nodes leave the range of the elements, whose own ratios are those of their volumes.
TEST(NodalFields, HaveElementsWithTheRatiosOfTheirVolumes) {
  const Space space = hollow_cube_space(1);
  const auto displacements = at_nodes(space, [](const Point& X) {
    return Point{2e-4 * std::sin(900.0 * X[1]), 2e-4 * std::sin(1100.0 * X[2]), 3e-4 * std::sin(1300.0 * X[0] + 700.0 * X[2])};
  });
  const NodalFields fields = fields_of(space, neo_hookean_body(Formulation::three_field), displacements);
  double volume = 0.0;
  for (std::size_t e = 0; e < fields.elements.size(); ++e) {
    const Point& low = space.positions[static_cast<std::size_t>(space.element_nodes[8 * e])];
    const Point& high = space.positions[static_cast<std::size_t>(space.element_nodes[8 * e + 7])];
    volume += (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]) * fields.elements[e].volume_ratio;
  }
  // The volume between the moved surfaces, by the divergence theorem: faces of neighbours cancel.
  double enclosed = 0.0;
  for (const SpaceFace& face : space.faces) {
    const auto place = [&](std::size_t corner) {
      const auto node = static_cast<std::size_t>(face.nodes.at(corner));
      Point x = space.positions[node];
      for (std::size_t i = 0; i < 3; ++i) x[i] += displacements[3 * node + i];
      return x;
    };
    constexpr double gauss = 0.21132486540518711775;
    for (const double u : {gauss, 1.0 - gauss}) {
      for (const double v : {gauss, 1.0 - gauss}) {
        Point x{};
        Point along_u{};
        Point along_v{};
        for (std::size_t i = 0; i < 3; ++i) {
          const std::array<double, 4> c{place(0)[i], place(1)[i], place(2)[i], place(3)[i]};
          x[i] = (1 - u) * (1 - v) * c[0] + u * (1 - v) * c[1] + (1 - u) * v * c[2] + u * v * c[3];
          along_u[i] = (1 - v) * (c[1] - c[0]) + v * (c[3] - c[2]);
          along_v[i] = (1 - u) * (c[2] - c[0]) + u * (c[3] - c[1]);
        }
        enclosed += x[0] * (along_u[1] * along_v[2] - along_u[2] * along_v[1]) / 12.0;
        enclosed += x[1] * (along_u[2] * along_v[0] - along_u[0] * along_v[2]) / 12.0;
        enclosed += x[2] * (along_u[0] * along_v[1] - along_u[1] * along_v[0]) / 12.0;
      }
    }
  }
  EXPECT_NEAR(volume, enclosed, 1e-12 * enclosed);
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

}  // namespace
}  // namespace menger::fem
