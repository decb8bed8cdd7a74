#include "evolution/posture/bend.h"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "evolution/posture/near_end.h"
#include "io/vtk/collection.h"
#include "io/vtk/vtk_file.h"
#include "tests/support/moved_grid.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

using tests::Place;

/// A bar of four cells of 1 m along x, of which each corner has moved.
vtkSmartPointer<vtkUnstructuredGrid> bar(const std::function<Place(const Place&)>& moved_to,
                                         tests::PointsAre points_are = tests::PointsAre::at_rest) {
  constexpr int cells = 4;
  std::vector<Place> corners;
  for (int x = 0; x <= cells; ++x) {
    for (const auto& [y, z] : std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      corners.push_back({static_cast<double>(x), y, z});
  }
  auto grid = tests::moved_grid(corners, moved_to, points_are);
  for (vtkIdType n = 0; n < 4 * cells; n += 4) {
    const std::array<vtkIdType, 8> ids{n, n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7};
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
  }
  return grid;
}

class BendTest : public testing::Test {
 protected:
  void write(const std::function<Place(const Place&)>& moved_to) {
    io::write_vtu(folder_ / "rest.vtu", *bar([](const Place& place) { return place; }));
    io::write_vtu(folder_ / "last.vtu", *bar(moved_to));
    io::write_collection(folder_ / "fields.pvd", {{0.0, "rest.vtu"}, {1.0, "last.vtu"}});
  }

  tests::TestFolder folder_;
};

/// Beyond the first cell the bar bends down, and gets longer.
Place bent(const Place& place) {
  const double beyond = std::max(0.0, place[0] - 1.0);
  return {place[0] + 0.1 * beyond, place[1], place[2] - 0.02 * beyond * beyond};
}

TEST_F(BendTest, IsThatOfTheFarEndAgainstTheNearOne) {
  write(bent);
  const auto bend = bend_in_inflation(folder_, 1.0);
  ASSERT_TRUE(bend);
  EXPECT_NEAR(bend->sideways_m, 0.18, 1e-9);
  EXPECT_NEAR(bend->along_m, 0.3, 1e-9);
}

TEST_F(BendTest, DoesNotDependOnHowTheBodyIsHeld) {
  write([](const Place& place) {
    const Place here = bent(place);
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    return Place{here[0] * c - here[2] * s + 5.0, here[1] - 2.0, here[0] * s + here[2] * c};
  });
  const auto bend = bend_in_inflation(folder_, 1.0);
  ASSERT_TRUE(bend);
  EXPECT_NEAR(bend->sideways_m, 0.18, 1e-9);
  EXPECT_NEAR(bend->along_m, 0.3, 1e-9);
}

TEST_F(BendTest, IsWhatIsLeftWithTheMotionOfTheNearEndTakenOut) {
  const auto floating = [](const Place& place) {
    const Place here = bent(place);
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    return Place{here[0] * c - here[2] * s + 5.0, here[1] - 2.0, here[0] * s + here[2] * c};
  };
  MovedPoints points;
  for (double x = 0.0; x <= 4.0; x += 1.0) {
    for (const auto& [y, z] : std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      points.rest_m.push_back({x, y, z});
      points.now_m.push_back(floating({x, y, z}));
    }
  }
  const RigidMotion motion = motion_of_near_end(points, 1.0);
  for (std::size_t n = 0; n < points.rest_m.size(); ++n) {
    const Place held = motion.taken_out(points.now_m[n]);
    const Place expected = bent(points.rest_m[n]);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(held.at(i), expected.at(i), 1e-9) << n;
  }
}

TEST_F(BendTest, NeedsTwoStates) {
  EXPECT_FALSE(bend_in_inflation(folder_, 1.0));
  write(bent);
  io::write_collection(folder_ / "fields.pvd", {{0.0, "rest.vtu"}});
  EXPECT_FALSE(bend_in_inflation(folder_, 1.0));
}

TEST_F(BendTest, IsToldOfBothModelsOfAValidation) {
  EXPECT_FALSE(bend_in_validation(folder_, 0, 1.0));
  const auto half_bent = [](const Place& place) {
    const Place whole = bent(place);
    return Place{0.5 * (place[0] + whole[0]), place[1], 0.5 * (place[2] + whole[2])};
  };
  io::write_vtu(folder_ / "elements.vtu", *bar(bent, tests::PointsAre::moved));
  io::write_vtu(folder_ / "voxels.vtu", *bar(half_bent, tests::PointsAre::moved));
  io::write_collection(folder_ / "worst.pvd", {{2.0, "elements.vtu", 0}, {2.0, "voxels.vtu", 1}, {3.0, "elements.vtu", 0}});
  const auto bend = bend_in_validation(folder_, 2, 1.0);
  ASSERT_TRUE(bend);
  EXPECT_NEAR(bend->elements.sideways_m, 0.18, 1e-9);
  EXPECT_NEAR(bend->elements.along_m, 0.3, 1e-9);
  EXPECT_NEAR(bend->voxels.sideways_m, 0.09, 1e-9);
  EXPECT_FALSE(bend_in_validation(folder_, 1, 1.0));
  EXPECT_FALSE(bend_in_validation(folder_, 3, 1.0)) << "the surrogate has no such state";
}

}  // namespace
}  // namespace menger::evolution
