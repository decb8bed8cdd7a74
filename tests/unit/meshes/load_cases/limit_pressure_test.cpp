#include "meshes/load_cases/limit_pressure.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/input_error_message.h"

namespace menger::meshes {
namespace {

std::optional<LimitPressure> of_points(const std::vector<std::pair<std::string, std::string>>& points) {
  std::string text = "status = \"completed\"\n";
  for (const auto& [plenum, pressure] : points)
    text += "[[limit_points]]\nplenum = \"" + plenum + "\"\npressure_Pa = " + pressure + "\n";
  return limit_pressure(io::parse_toml(text, "result.toml"));
}

TEST(LimitPressure, IsTheFirstOfAPlenumAndNotTheLeastPressureAfterSnapThrough) {
  const auto found = of_points({{"plenum 0", "3000"}, {"plenum 0", "1200"}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pressure_Pa, 3000.0);
  EXPECT_EQ(found->plenum, "plenum 0");
}

TEST(LimitPressure, IsTheLeastOfAllPlena) {
  const auto found = of_points({{"plenum 0", "3000"}, {"plenum 1", "2500"}, {"plenum 1", "900"}, {"plenum 0", "800"}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pressure_Pa, 2500.0);
  EXPECT_EQ(found->plenum, "plenum 1");
}

TEST(LimitPressure, IsNotOneOfVacuum) {
  EXPECT_FALSE(of_points({{"plenum 0", "-200"}}));
  EXPECT_EQ(of_points({{"plenum 0", "-200"}, {"plenum 0", "3000"}})->pressure_Pa, 3000.0);
  EXPECT_FALSE(of_points({}));
}

TEST(LimitPressure, RefusesAPointWithoutPressure) {
  EXPECT_NE(tests::message_of([] {
              (void)limit_pressure(io::parse_toml("[[limit_points]]\nplenum = \"a\"\n", "result.toml"));
            }).find("pressure_Pa"),
            std::string::npos);
}

}  // namespace
}  // namespace menger::meshes
