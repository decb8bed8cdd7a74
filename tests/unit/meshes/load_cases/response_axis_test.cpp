#include "meshes/load_cases/response_axis.h"

#include <gtest/gtest.h>

namespace menger::meshes {
namespace {

TEST(ResponseAxis, NamesOneQuantityOrTheirKind) {
  EXPECT_EQ(response_axis_title({"force_N"}), "force (N)");
  EXPECT_EQ(response_axis_title({"volume_change"}), "volume change (%)");
  EXPECT_EQ(response_axis_title({"extent_x_m", "top_m"}), "displacement (mm)");
  EXPECT_EQ(response_axis_title({"frequency_1_Hz", "frequency_2_Hz"}), "natural frequency (Hz)");
  EXPECT_EQ(response_axis_title({"a_N", "b_N"}), "response (N)");
}

}  // namespace
}  // namespace menger::meshes
