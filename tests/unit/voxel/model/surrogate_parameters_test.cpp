#include "voxel/model/surrogate_parameters.h"

#include <gtest/gtest.h>

namespace menger::voxel {
namespace {

SurrogateParameters with_plates() {
  SurrogateParameters p;
  p.extension.fill({.slope_per_Pa = 2e-6});
  p.bulge.fill({.slope_per_Pa = 3e-6});
  p.plate_stretch_ratio = 3.0;
  p.plate_draw_in = 0.2;
  p.plate_rise = 0.08;
  p.plate_draw_in_per_Pa = 1e-3;
  p.plate_edge_share = 0.25;
  p.plate_arm_ratio = 1.5;
  p.wide_volume_ratio = 1.1;
  return p;
}

constexpr double half_bent_Pa = 1000.0;  // 1 / plate_draw_in_per_Pa

TEST(LawsOfPlates, LengthenBeamsAndDrawThemIn) {
  const SurrogateParameters p = with_plates();
  const auto length = [&](std::size_t law_class) { return p.extension_of(law_class).value(half_bent_Pa); };
  EXPECT_DOUBLE_EQ(length(inside_plate), 3.0 * 2e-3 - 0.1);
  EXPECT_DOUBLE_EQ(length(plate_edge), 1.5 * 2e-3 - 0.025);
  EXPECT_DOUBLE_EQ(length(beside_arm), length(plate_edge));
  EXPECT_DOUBLE_EQ(length(inner_edge), length(inside_plate)) << "of the same slope here as that of limbs";
  EXPECT_DOUBLE_EQ(length(walls::limb), 2e-3);
  EXPECT_DOUBLE_EQ(length(middle_of_plate), 2e-3) << "no class of beams";
}

TEST(LawsOfPlates, LiftFacesFurtherFromTheMiddleOutwardsLessAndBesideArmsMore) {
  const SurrogateParameters p = with_plates();
  const auto bulge = [&](std::size_t law_class) { return p.bulge_of(law_class).value(half_bent_Pa); };
  EXPECT_DOUBLE_EQ(bulge(walls::corner), 3e-3);
  EXPECT_DOUBLE_EQ(bulge(middle_of_plate), 3e-3 + 0.04);
  EXPECT_DOUBLE_EQ(bulge(side_of_plate), 3e-3 + 0.02);
  EXPECT_DOUBLE_EQ(bulge(corner_of_plate), 3e-3 + 0.01);
  EXPECT_DOUBLE_EQ(bulge(side_with_arm), 1.5 * bulge(side_of_plate));
  EXPECT_DOUBLE_EQ(bulge(corner_with_arm), 1.5 * bulge(corner_of_plate));
  EXPECT_DOUBLE_EQ(bulge(corner_with_two_arms), 2.25 * bulge(corner_of_plate));
}

TEST(LawsOfPlates, HaveMoreVolumeBelowWideWallsOnly) {
  const SurrogateParameters p = with_plates();
  for (std::size_t law_class = 0; law_class < law_class_count; ++law_class) {
    const bool is_wide = wall_class_of(law_class) <= walls::corner;
    EXPECT_EQ(p.volume_ratio_of(law_class), is_wide ? 1.1 : 1.0) << law_class_text(law_class);
  }
}

}  // namespace
}  // namespace menger::voxel
