// A neo-Hookean sphere has a limit point, others have none. With kappa = 1e4 mu compression lowers the pressure by 1e-4 (by 1.9 %
// at 50 mu, in proportion to 1/kappa), and the parabola through three states a step of 0.02 in stretch apart has an error below
// 1e-4 of the pressure.

#include <gtest/gtest.h>

#include <cmath>

#include "fem_pressure_vessels.h"
#include "fem_table.h"

namespace menger::fem {
namespace {

constexpr double limit_pressure_Pa = 13751.934;
constexpr double limit_stretch = 1.492201;

VesselCase sphere(const materials::HyperelasticLaw& law) { return {Vessel::sphere, law, 1e4 * vessel_shear_modulus_Pa, 2}; }

PathReport inflate_to_stretch(const materials::HyperelasticLaw& law, double stretch) {
  Model model(vessel_mesh(Vessel::sphere, 1), 2, vessel_body(sphere(law)));
  return model.follow({{.kind = DriveKind::volume, .values = {1.0, std::pow(stretch, 3)}}}, equal_steps(60));
}

double stretch_of(const PathReport& report, double volume_m3) {
  return std::cbrt(volume_m3 / report.points.front().plenum_volumes_m3[0]);
}

TEST(LimitPoint, OfANeoHookeanSphereIsPassedUnderVolumeControl) {
  const PathReport report = inflate_to_stretch(materials::NeoHookean{vessel_shear_modulus_Pa}, 2.0);
  ASSERT_EQ(report.limit_points.size(), 1U);
  const LimitPoint& limit = report.limit_points[0];
  EXPECT_TRUE(limit.passed);
  expect_close("sphere limit pressure Pa, volume control", limit.pressure_Pa, limit_pressure_Pa, 3e-4);
  expect_close("sphere limit stretch, volume control", stretch_of(report, limit.volume_m3), limit_stretch, 1e-3);
}

TEST(LimitPoint, IsAbsentForMooneyRivlinAndOgdenSpheres) {
  EXPECT_TRUE(inflate_to_stretch(materials::MooneyRivlin{20e3, 5e3}, 2.0).limit_points.empty());
  const materials::Ogden<2> ogden{{materials::OgdenTerm{60e3, 1.5}, materials::OgdenTerm{-2.5e3, -4.0}}};
  EXPECT_TRUE(inflate_to_stretch(ogden, 2.0).limit_points.empty());
}

/// The path stops short of the limit, which is extrapolated; pressure is flat there, stretch is not.
TEST(LimitPoint, OfANeoHookeanSphereEndsAPathUnderPressureControl) {
  Model model(vessel_mesh(Vessel::sphere, 1), 2, vessel_body(sphere(materials::NeoHookean{vessel_shear_modulus_Pa})));
  const PathReport& report =
      model.follow({{.kind = DriveKind::pressure, .values = {0.0, 20e3}}}, equal_steps(20), {}, io::RunStatus::limit_point);
  ASSERT_EQ(report.limit_points.size(), 1U);
  const LimitPoint& limit = report.limit_points[0];
  EXPECT_FALSE(limit.passed);
  expect_close("sphere limit pressure Pa, pressure control", limit.pressure_Pa, limit_pressure_Pa, 1e-3);
  expect_close("sphere limit stretch, pressure control", stretch_of(report, limit.volume_m3), limit_stretch, 3e-2);
  EXPECT_LT(report.points.back().pressures_Pa[0], limit_pressure_Pa);
}

}  // namespace
}  // namespace menger::fem
