// Verification on finer meshes, with the tolerances that they allow.

#include <gtest/gtest.h>

#include "fem_cooks_membrane.h"
#include "fem_cross_code.h"
#include "fem_pressure_vessels.h"
#include "fem_table.h"

namespace menger::fem {
namespace {

TEST(HollowCubeLong, AgreesWithOtherCodesForQ2DisplacementOnTheHalvedMesh) {
  expect_published({"cube Q2 n = 2", 2, Formulation::displacement, 2, 3.26556, 2.94283, 64.394, 8.0501e-3});
}

/// Both families converge to one deflection; the finest pair is 0.6 % apart.
TEST(CooksMembraneLong, MixedElementsAgree) {
  const double linear_mm = cook_tip_mm(1, Formulation::three_field, 32);
  const double quadratic_mm = cook_tip_mm(2, Formulation::three_field, 32);
  expect_close("Cook Q1/P0 32 x 32, tip mm", linear_mm, published_cook_tip_mm, 5e-3);
  expect_close("Cook Q2/P1 32 x 32, tip mm", quadratic_mm, published_cook_tip_mm, 5e-3);
  expect_close("Cook Q1/P0 to Q2/P1 32 x 32", linear_mm, quadratic_mm, 1e-2);
}

TEST(ThickSphereLong, PressureConvergesAsTheory) {
  std::vector<double> pressures_Pa;
  for (const std::size_t fineness : {1U, 2U, 4U}) {
    const VesselCase sphere{Vessel::sphere, materials::NeoHookean{vessel_shear_modulus_Pa}, 50.0 * vessel_shear_modulus_Pa, 2,
                            Formulation::displacement};
    pressures_Pa.push_back(inflate(sphere, fineness, {1.05}).at(0).pressure_Pa);
  }
  expect_order("sphere Q2, four elements through the wall, pressure Pa", pressures_Pa, 4124.611, 4.0, 0.1);
}

}  // namespace
}  // namespace menger::fem
