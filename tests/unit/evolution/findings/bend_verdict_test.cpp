#include "evolution/findings/bend_verdict.h"

#include <vtkCellType.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>

#include "io/vtk/collection.h"
#include "io/vtk/vtk_file.h"
#include "tests/support/moved_grid.h"
#include "tests/unit/evolution/findings/robot_results.h"

namespace menger::evolution {
namespace {

using tests::PointsAre;

/// A row of three cells of 10 mm along x, of which the end at 30 mm has moved up.
vtkSmartPointer<vtkUnstructuredGrid> bent_row(double up_m, PointsAre points_are) {
  std::vector<tests::Place> corners;
  for (int x = 0; x <= 3; ++x) {
    for (const auto& [y, z] : std::vector<std::array<double, 2>>{{0, 0}, {0.01, 0}, {0.01, 0.01}, {0, 0.01}})
      corners.push_back({0.01 * x, y, z});
  }
  const auto moved_to = [&](const tests::Place& place) {
    return tests::Place{place[0], place[1], place[2] + (place[0] > 0.025 ? up_m : 0.0)};
  };
  auto grid = tests::moved_grid(corners, moved_to, points_are);
  for (vtkIdType n = 0; n < 12; n += 4) {
    const std::array<vtkIdType, 8> ids{n, n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7};
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
  }
  return grid;
}

class BendVerdict : public RobotResults {
 protected:
  BendVerdict() {
    take_robot("111", "[drive]\nmode = \"hold\"\npressure_Pa = [0, 3000]\n[walk]\npresent = false\n");
    write_inflation("completed");
    io::write_vtu(folder_ / "inflate/rest.vtu", *bent_row(0.0, PointsAre::at_rest));
    io::write_vtu(folder_ / "inflate/last.vtu", *bent_row(0.004, PointsAre::at_rest));
    io::write_collection(folder_ / "inflate/fields.pvd", {{0.0, "rest.vtu"}, {1.0, "last.vtu"}});
    write_validated("completed", "[1500, 3000]", "1500\n3000\n");
    io::write_vtu(folder_ / "validate/elements.vtu", *bent_row(0.005, PointsAre::moved));
    io::write_vtu(folder_ / "validate/voxels.vtu", *bent_row(0.006, PointsAre::moved));
    io::write_collection(folder_ / "validate/worst.pvd", {{1.0, "elements.vtu", 0}, {1.0, "voxels.vtu", 1}});
  }
};

TEST_F(BendVerdict, TellsWhatAllModelsSay) {
  EXPECT_EQ(
      bend_verdict(folder_, robot_),
      "At 3 kPa the middle of its far end moves 5 mm sideways by quadratic elements (validate), which bend fingers up to 3 % too "
      "much, and 6 mm in the surrogate: the surrogate bends 20 % too much. Thin walls (inflate) give 4 mm; they bend fingers 17 "
      "to 26 % too little.");
  expect_has(verdict(), bend_verdict(folder_, robot_));
  io::write_vtu(folder_ / "validate/elements.vtu", *bent_row(0.0001, PointsAre::moved));
  expect_has(bend_verdict(folder_, robot_), " and 6 mm in the surrogate. Thin walls");  // what hardly bends has no share
}

TEST_F(BendVerdict, NeedsAllModelsAtThePressureOfTheDrive) {
  write_inflation("limit_point");
  EXPECT_EQ(bend_verdict(folder_, robot_), "");
  write_inflation("completed");
  write_validated("limit_point", "[1500, 3000]", "1500\n");
  EXPECT_EQ(bend_verdict(folder_, robot_), "");
  write_validated("completed", "[1500, 3000]", "1500\n3000\n");
  io::write_whole(folder_ / "validate/voxels.vtu", "no fields");
  EXPECT_EQ(bend_verdict(folder_, robot_), "");
  take_robot("111", "[drive]\npressure_Pa = [0, 3000]\n");
  EXPECT_EQ(bend_verdict(folder_, robot_), "") << "what walks is not held at one end";
}

}  // namespace
}  // namespace menger::evolution
