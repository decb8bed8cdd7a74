#include "evolution/findings/pressure_verdict.h"

#include "tests/unit/evolution/findings/robot_results.h"

namespace menger::evolution {
namespace {

using PressureVerdict = RobotResults;

TEST_F(PressureVerdict, SaysWhetherTheBodyBearsItsPressure) {
  write_inflation("completed");
  write_limit("12000.0");
  // 12 kPa of thin walls may be 12 / 1.12 = 10.7 kPa, of which 80 % are safe.
  expect_has(verdict(),
             "It bears its pressure of 3 kPa: safe up to 8.57 kPa, 20 % below the 10.7 kPa to 11.9 kPa at which it balloons.\n");
  expect_has(verdict(),
             "By the softest law of its silicone (ogden1, Soft Robotics Materials Database, law_variant = 1) it is safe, too, up "
             "to 3.97 kPa.");
  // The softest law of Dragon Skin 10 has 0.46 times the shear modulus.
  EXPECT_NEAR(softest_limit_Pa(folder_, robot_).value(), 0.464 * 12000.0 / 1.12, 5.0);
  write_limit("8000.0");
  expect_has(
      verdict(),
      "Your silicone decides whether it bears its pressure of 3 kPa: by the softest law of Dragon Skin 10 (ogden1, Soft Robotics "
      "Materials Database, law_variant = 1) it is near ballooning, at 91 % of some 3.31 kPa, so test the silicone that you cast, "
      "or "
      "lower drive.pressure_Pa to 2650 Pa or less.\n");
  expect_has(
      verdict(),
      "By the law of its file (neo_hookean, modulus at 100 % strain of the data sheet divided by 1.75) it bears it, and is safe "
      "up to 5.71 kPa");
  write_limit("6000.0");
  expect_has(verdict(), "law_variant = 1) it balloons near 2.49 kPa, so test the silicone");
  expect_has(
      verdict(),
      "By the law of its file (neo_hookean, modulus at 100 % strain of the data sheet divided by 1.75) it bears it, and is "
      "safe up to 4.28 kPa");
  write_limit("3500.0");
  expect_has(verdict(),
             "Its pressure of 3 kPa is near that at which it balloons, 3.12 kPa to 3.47 kPa: lower drive.pressure_Pa to 2500 Pa "
             "or less.");
  expect_has(verdict(),
             "balloons near 1.45 kPa: test the silicone that you cast, or lower drive.pressure_Pa to 1160 Pa or less.");
  write_limit("2500.0");
  expect_has(verdict(),
             "It balloons at 2.23 kPa to 2.48 kPa, before the 3 kPa of its drive: lower drive.pressure_Pa to 1780 Pa or less.");
}

TEST_F(PressureVerdict, DoesNotSayThatABodyBearsWhatOtherElementsDoNot) {
  write_inflation("completed");
  write_limit("12000.0");
  write_validated("limit_point", "[500, 1000, 1500, 2000, 2500, 3000]", "500\n1000\n1500\n2000\n");
  expect_has(
      verdict(),
      "Whether it bears its pressure of 3 kPa is not known: quadratic elements (validate, free) lose their stable "
      "equilibrium between 2 kPa and 2.5 kPa, where a body buckles or balloons; thin walls (inflate, on the ground) see no "
      "such point below 10.7 kPa. To be safe by both, lower drive.pressure_Pa to 1600 Pa or less.");
  EXPECT_EQ(verdict().find("It bears"), std::string::npos) << verdict();
  stages_.erase("validate");
  expect_has(verdict(), "It bears its pressure of 3 kPa: safe up to 8.57 kPa");
}

TEST_F(PressureVerdict, SaysWhereFiniteElementsDiffer) {
  write_inflation("completed");
  io::write_whole(folder_ / "inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,1.5e-6\n");
  const auto write = [&](const std::string& change) {
    io::write_whole(folder_ / "validate/errors.csv",
                    "observable,pressure_Pa,finite_elements\nextent_x_m,3000,1e-4\nvolume_change,"
                    "1500,0.1\nvolume_change,3000," +
                        change + "\n");
  };
  write("0.52");
  EXPECT_EQ(verdict().find("differ by"), std::string::npos) << verdict();
  write("0.65");
  expect_has(verdict(),
             "At 3 kPa two kinds of finite elements differ by 10 % in its chamber: 1.50 times its volume at rest by thin walls "
             "(inflate, on the ground), 1.65 "
             "times by quadratic elements (validate, free). The ground holds the body back: part of the difference is that.");
  robot_.walks = false;
  expect_has(verdict(), "by thin walls (inflate), 1.65 times by quadratic elements (validate).");
  robot_.walks = true;
  write_inflation("not_converged");
  EXPECT_EQ(verdict().find("differ by"), std::string::npos) << "its last state has another pressure";
}

TEST_F(PressureVerdict, KnowsTheLimitPressureFromTheLeastPressureAfterSnapThrough) {
  write_inflation("completed");
  io::write_whole(folder_ / "limit/result.toml",
                  "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = 12000\n[[limit_points]]\n"
                  "plenum = \"plenum 0\"\npressure_Pa = 2000\n");
  EXPECT_EQ(found("limit"), "it balloons at 12 kPa" + too_high + "25 % of that");
  expect_has(verdict(), "It bears its pressure of 3 kPa: safe up to 8.57 kPa");
}

TEST_F(PressureVerdict, NeedsAnInflationUpToThePressureOfTheDrive) {
  write_limit("12000.0");
  EXPECT_EQ(verdict(), "");
  write_inflation("not_converged");
  EXPECT_EQ(verdict(), "Whether it bears its pressure is not known: its inflation ended before 3 kPa (not_converged).");
  write_inflation("completed");
  io::write_whole(folder_ / "limit/result.toml", "status = \"not_converged\"\n");
  io::write_whole(folder_ / "limit/curves.csv", "step,plenum_0_pressure_Pa\n0,0\n1,5000\n");
  expect_has(verdict(), "How far it is from ballooning is not known: no limit pressure was found up to 5 kPa; not_converged.");
}

}  // namespace
}  // namespace menger::evolution
