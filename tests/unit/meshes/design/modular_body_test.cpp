#include "meshes/design/modular_body.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace menger::meshes {
namespace {

ModularBody per_phase(const std::array<int, 3>& cells, const std::string& digits, int level = 1) {
  return {Polycube::from_digits(cells[0], cells[1], cells[2], digits), level, ChamberLayout::per_phase};
}

/// The places in the planes inside a body along an axis.
std::vector<PartitionPlace> places(const ModularBody& body, std::size_t axis) {
  const std::array<int, 3> size{body.cells().nx(), body.cells().ny(), body.cells().nz()};
  std::vector<PartitionPlace> result;
  for (int plane = 1; plane < size.at(axis); ++plane) result.push_back(body.partition_place(axis, plane));
  return result;
}

using enum PartitionPlace;
using Places = std::vector<PartitionPlace>;

TEST(ModularBody, CentresPartitionsWhereNoOuterWallLies) {
  EXPECT_EQ(places(per_phase({4, 1, 1}, "1221"), 0), (Places{centred, centred, centred}));
  EXPECT_EQ(places(per_phase({2, 2, 2}, "12212112"), 2), (Places{centred}));
}

TEST(ModularBody, PlacesPartitionsOnTheSideOfOuterWalls) {
  // Two skids, of which the plate has another phase than the right one.
  EXPECT_EQ(places(per_phase({4, 3, 2}, "100210021002111211121112"), 0), (Places{centred, centred, high}));
  // Feet in the first and the last column and in the first two rows.
  const ModularBody feet = per_phase({4, 4, 2}, "10021002000000001112111212221222");
  EXPECT_EQ(places(feet, 0), (Places{low, centred, high}));
  EXPECT_EQ(places(feet, 1), (Places{centred, low, centred}));
}

TEST(ModularBody, PlacesPartitionsOnTheSideOfMoreOuterWalls) {
  EXPECT_EQ(places(per_phase({2, 4, 1}, "10101201"), 0), (Places{low})) << "two on the low side, one on the high side";
  EXPECT_EQ(places(per_phase({2, 4, 1}, "01011210"), 0), (Places{high}));
}

// As many outer walls on either side: the partitions lie away from the middle, so that the mirror image has mirrored walls.
TEST(ModularBody, MirroredBodiesHaveMirroredPartitions) {
  // rows of 1122, 1000, 0222 and their mirror image
  EXPECT_EQ(places(per_phase({4, 3, 1}, "122210000222"), 0), (Places{low, centred, centred}));
  EXPECT_EQ(places(per_phase({4, 3, 1}, "222100012220"), 0), (Places{centred, centred, high}));
  EXPECT_EQ(places(per_phase({2, 3, 1}, "121001"), 0), (Places{low})) << "in the middle";
  EXPECT_EQ(places(per_phase({6, 3, 1}, "122200100000022200"), 0), (Places{low, centred, centred, centred, centred}))
      << "the middle is that of the cells";
}

TEST(ModularBody, HasTheSamePlacesInEveryModule) {
  const ModularBody body = per_phase({2, 2, 1}, "1210", 2);
  EXPECT_EQ(places(body, 0), (Places{low, centred, low}));
  EXPECT_EQ(places(body, 1), (Places{centred, centred, centred})) << "no partitions across y";
}

}  // namespace
}  // namespace menger::meshes
