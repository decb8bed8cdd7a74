#include "evolution/posture/fall.h"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "io/vtk/collection.h"
#include "io/vtk/vtk_file.h"
#include "tests/support/moved_grid.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

using tests::Place;

/// One cell of 1 x 1 x 2 m, of which each corner has moved.
vtkSmartPointer<vtkUnstructuredGrid> cell(const std::function<Place(const Place&)>& moved_to) {
  const std::vector<Place> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  auto grid = tests::moved_grid(corners, moved_to, tests::PointsAre::moved);
  constexpr std::array<vtkIdType, 8> ids{0, 1, 2, 3, 4, 5, 6, 7};
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
  return grid;
}

Place turned(const Place& place, double lean_deg, double turn_deg) {
  const double lean = lean_deg * std::numbers::pi / 180.0;
  const double turn = turn_deg * std::numbers::pi / 180.0;
  const Place leant{place[0] * std::cos(lean) + place[2] * std::sin(lean), place[1],
                    place[2] * std::cos(lean) - place[0] * std::sin(lean)};
  return {leant[0] * std::cos(turn) - leant[1] * std::sin(turn), leant[0] * std::sin(turn) + leant[1] * std::cos(turn), leant[2]};
}

class FallTest : public testing::Test {
 protected:
  /// Writes four frames in each of some strokes of 1 s, at whose ends the body leans and has turned about the vertical.
  void write(const std::vector<double>& leans_deg, double turn_deg = 0.0) {
    std::vector<io::CollectionEntry> entries;
    for (std::size_t n = 0; n <= 4 * leans_deg.size(); ++n) {
      const bool is_end = n % 4 == 0 && n > 0;
      const double between_deg = n == 0 ? 0.0 : 60.0;  // within a stroke it may lean as it likes
      const double lean_deg = is_end ? leans_deg[n / 4 - 1] : between_deg;
      const std::string name = "frame_" + std::to_string(n) + ".vtu";
      io::write_vtu(folder_ / name, *cell([&](const Place& place) { return turned(place, lean_deg, n == 0 ? 0.0 : turn_deg); }));
      entries.push_back({0.25 * static_cast<double>(n), name});
    }
    io::write_collection(folder_ / "frames.pvd", entries);
  }

  tests::TestFolder folder_;
};

TEST_F(FallTest, IsALeanAtTheEndOfAStroke) {
  write({10.0, 12.0, 70.0, 80.0});
  const auto fall = fall_in_walk(folder_, 1.0);
  ASSERT_TRUE(fall);
  EXPECT_DOUBLE_EQ(fall->time_s, 3.0);
  EXPECT_NEAR(fall->lean_deg, 60.0, 1e-6);
}

TEST_F(FallTest, IsNoneOfABodyThatKeepsItsPostureOrTurns) {
  write({20.0, 20.0, 25.0});
  EXPECT_FALSE(fall_in_walk(folder_, 1.0));
  write({0.0, 0.0, 0.0}, 90.0);
  EXPECT_FALSE(fall_in_walk(folder_, 1.0));
}

TEST_F(FallTest, IsNotToldWithoutFramesAtTheEndsOfStrokes) {
  EXPECT_FALSE(fall_in_walk(folder_, 1.0));
  write({10.0, 70.0});
  EXPECT_FALSE(fall_in_walk(folder_, 0.3)) << "fewer than two frames in a stroke";
  EXPECT_FALSE(fall_in_walk(folder_, 5.0)) << "no whole stroke";
}

TEST_F(FallTest, RefusesDamagedFrames) {
  write({10.0, 70.0});
  io::write_whole(folder_ / "frame_8.vtu", "no grid");
  EXPECT_THROW(fall_in_walk(folder_, 1.0), io::InputError);
  write({10.0, 70.0});
  io::write_vtu(folder_ / "frame_0.vtu", *vtkSmartPointer<vtkUnstructuredGrid>::New());
  EXPECT_THROW(fall_in_walk(folder_, 1.0), io::InputError) << "a body without points";
}

}  // namespace
}  // namespace menger::evolution
