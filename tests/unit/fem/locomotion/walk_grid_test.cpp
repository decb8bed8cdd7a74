#include "fem/locomotion/walk_grid.h"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/unit/fem/locomotion/locomotion_samples.h"

namespace menger::fem {
namespace {

using namespace locomotion_samples;
using Gradient = std::array<double, 9>;

/// A body whose points are at F X + (1, 2, 3) mm at 0.5 s, with pressures in its plena.
struct MovedSample {
  LocomotionStudy study;
  std::vector<double> displacements{};
  std::vector<double> velocities{};
  std::vector<double> pressures{};

  explicit MovedSample(const std::string& text, const Gradient& F = {1, 0, 0, 0, 1, 0, 0, 0, 1}) : study(sample_study(text)) {
    for (const meshes::Point& X : study.mesh.points) {
      for (std::size_t i = 0; i < 3; ++i) {
        double x = 1e-3 * static_cast<double>(i + 1);
        for (std::size_t j = 0; j < 3; ++j) x += F[3 * i + j] * X[j];
        displacements.push_back(x - X[i]);
      }
    }
    velocities.assign(displacements.size(), 0.25);
    for (std::size_t p = 0; p < study.mesh.plenum_names.size(); ++p) pressures.push_back(800.0 + 100.0 * static_cast<double>(p));
  }

  [[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> grid() const {
    return WalkGrid(study.mesh, study.material.law).at({0.5, displacements, velocities, pressures});
  }
};

double at(vtkUnstructuredGrid& grid, const char* name, vtkIdType cell) {
  return grid.GetCellData()->GetArray(name)->GetComponent(cell, 0);
}

TEST(WalkGrid, HasThePointsOfTheMovedBodyAndTheirWayFromRest) {
  const MovedSample moved(hook_study, {1.1, 0.1, 0, 0, 0.9, 0, 0.2, 0, 1});
  const auto grid = moved.grid();
  const auto& points = moved.study.mesh.points;
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(points.size()));
  vtkDataArray* displacements = grid->GetPointData()->GetArray("displacement_m");
  for (vtkIdType n = 0; n < grid->GetNumberOfPoints(); ++n) {
    for (int i = 0; i < 3; ++i) {
      const double at_rest = grid->GetPoint(n)[i] - displacements->GetComponent(n, i);
      EXPECT_NEAR(at_rest, points[static_cast<std::size_t>(n)][static_cast<std::size_t>(i)], 1e-17);
    }
  }
  EXPECT_NEAR(grid->GetPoint(0)[1], 0.9 * points[0][1] + 0.002, 1e-17);
  EXPECT_EQ(grid->GetPointData()->GetVectors(), displacements);
  EXPECT_EQ(grid->GetPointData()->GetArray("velocity_m_per_s")->GetComponent(3, 1), 0.25);
}

// Elements whose corners are in the wrong order have no volume, or a negative one.
TEST(WalkGrid, HasElementsOfTheBodysVolume) {
  const MovedSample moved(hook_study);
  const auto grid = moved.grid();
  double volume = 0.0;
  for (std::size_t e = 0; e < moved.study.mesh.elements.size(); ++e) {
    vtkCell* cell = grid->GetCell(static_cast<vtkIdType>(e));
    ASSERT_EQ(cell->GetCellType(), VTK_HEXAHEDRON);
    meshes::Point low{};
    meshes::Point high{};
    const auto corner = [&](vtkIdType c, meshes::Point& x) { grid->GetPoint(cell->GetPointId(static_cast<int>(c)), x.data()); };
    corner(0, low);
    corner(6, high);  // the opposite one in VTK's order
    volume += (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  }
  // Three cells of 10 mm less the chamber: 6 x 6 x 6 mm in each, and two passages of 4 x 6 x 6 mm.
  EXPECT_NEAR(volume, 3e-6 - (3.0 * 216e-9 + 2.0 * 144e-9), 1e-15);
}

TEST(WalkGrid, ShowsWallsOfChambersWithTheirPressure) {
  const MovedSample moved(hook_study);
  const auto grid = moved.grid();
  vtkIdType walls = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    const bool is_wall = at(*grid, "chamber", c) == 0.0;
    EXPECT_EQ(grid->GetCellType(c), is_wall ? VTK_QUAD : VTK_HEXAHEDRON);
    EXPECT_EQ(at(*grid, "region", c), is_wall ? -1.0 : 0.0);
    EXPECT_EQ(at(*grid, "chamber_pressure_Pa", c), 800.0) << "of the only chamber, also for elements";
    walls += is_wall ? 1 : 0;
  }
  EXPECT_GT(walls, 0);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.5);
  EXPECT_EQ(grid->GetFieldData()->GetArray("plenum_pressures_Pa")->GetTuple1(0), 800.0);
  for (const char* name : {"chamber_names", "plenum_names", "region_names"})
    EXPECT_EQ(grid->GetFieldData()->GetAbstractArray(name)->GetNumberOfValues(), 1) << name;
}

// Two cells with a chamber each: the one at x < 10 mm and the one beyond. The wall between belongs to both.
TEST(WalkGrid, GivesElementsThePressureOfTheChamberNextToThem) {
  const std::string two_chambers =
      "[design]\nname = \"pair\"\ncells = [2, 1, 1]\ndigits = \"12\"\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n"
      "chambers = \"per-phase\"\n";
  for (const char* elements : {"", "elements_through_wall = 3\n[elements]\nkind = \"three_field\"\n"}) {
    const MovedSample moved(two_chambers + elements + silicone + ground + drive + short_time + no_pictures);
    ASSERT_EQ(moved.study.mesh.chambers.size(), 2U);
    const auto grid = moved.grid();
    for (vtkIdType e = 0; e < static_cast<vtkIdType>(moved.study.mesh.elements.size()); ++e) {
      double middle = 0.0;
      for (vtkIdType c = 0; c < 8; ++c) middle += grid->GetPoint(grid->GetCell(e)->GetPointId(static_cast<int>(c)))[0] / 8.0;
      middle -= 1e-3;
      if (std::abs(middle - 0.01) < 0.002) continue;
      const double on_left = moved.pressures[moved.study.mesh.chambers[0].plenum];
      const double on_right = moved.pressures[moved.study.mesh.chambers[1].plenum];
      ASSERT_NE(on_left, on_right);
      EXPECT_EQ(at(*grid, "chamber_pressure_Pa", e), middle < 0.01 ? on_left : on_right) << elements << " at " << middle;
    }
  }
}

// The whole body is stretched to 1.5 along x and keeps its volume: sigma = mu (l^2 - 1/l).
TEST(WalkGrid, ShowsStretchStressAndVolumeOfElementsAndTheirWalls) {
  constexpr double shear_modulus_Pa = 5e4;  // that of the sample
  const double across = 1.0 / std::sqrt(1.5);
  for (const char* elements : {"", "[elements]\nkind = \"three_field\"\n"}) {
    const MovedSample stretched(hook + elements + silicone + ground + drive + short_time + no_pictures,
                                {1.5, 0, 0, 0, across, 0, 0, 0, across});
    const auto grid = stretched.grid();
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
      ASSERT_NEAR(at(*grid, "largest_stretch", c), 1.5, 1e-6) << elements;
      ASSERT_NEAR(at(*grid, "von_mises_stress_Pa", c), shear_modulus_Pa * (1.5 * 1.5 - 1.0 / 1.5), 1e-6 * shear_modulus_Pa);
      ASSERT_NEAR(at(*grid, "volume_ratio", c), 1.0, 1e-6);
    }
    EXPECT_EQ(grid->GetCellData()->GetScalars(), grid->GetCellData()->GetArray("largest_stretch"));
  }
  const MovedSample grown(hook_study, {1.1, 0, 0, 0, 1.2, 0, 0, 0, 1.3});
  EXPECT_NEAR(at(*grown.grid(), "volume_ratio", 0), 1.1 * 1.2 * 1.3, 1e-6);
}

// A wall has what its own element has, wherever that lies in the mesh.
TEST(WalkGrid, GivesWallsTheStateOfTheElementBehindThem) {
  MovedSample moved(hook_study);
  const auto& mesh = moved.study.mesh;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) moved.displacements[3 * n] += 10.0 * std::pow(mesh.points[n][0], 2);
  const auto grid = moved.grid();
  const auto elements = static_cast<vtkIdType>(mesh.elements.size());
  for (vtkIdType wall = elements; wall < grid->GetNumberOfCells(); ++wall) {
    vtkIdList* corners = grid->GetCell(wall)->GetPointIds();
    bool is_there = false;
    for (vtkIdType e = 0; e < elements && !is_there; ++e) {
      vtkIdList* own = grid->GetCell(e)->GetPointIds();
      int shared = 0;
      for (vtkIdType c = 0; c < 4; ++c) shared += own->IsId(corners->GetId(c)) >= 0 ? 1 : 0;
      is_there = shared == 4 && at(*grid, "largest_stretch", e) == at(*grid, "largest_stretch", wall);
    }
    EXPECT_TRUE(is_there) << "wall " << wall - elements;
  }
}

}  // namespace
}  // namespace menger::fem
