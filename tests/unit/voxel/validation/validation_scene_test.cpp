#include "voxel/validation/validation_scene.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>

#include "io/text/input_error.h"
#include "io/vtk/vtk_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/voxel/validation/validation_samples.h"
#include "voxel/picture/vtk_output.h"
#include "voxel/statics/body_shape.h"
#include "voxel/validation/body_boxes.h"
#include "voxel/validation/kept_fields.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCaseKind;
using samples::bar_curve;
using samples::validation_parameters;

TEST(BodyBoxes, HaveTheSizeThatTheExtentsAreMeasuredOn) {
  const meshes::LoadCase load_case = bar_curve("bar", LoadCaseKind::inflation, {}).provenance.load_case;
  std::size_t states = 0;
  (void)visit_states(validation_parameters(), load_case, {{0.0}, {5e3}}, [&](std::size_t row, const Equilibrium& equilibrium) {
    const BodyBoxes boxes = body_boxes(equilibrium);
    ASSERT_EQ(boxes.corners_m.size(), 3U);
    const BodyShape shape(equilibrium);
    const double length_m = boxes.corners_m[2][6][0] - boxes.corners_m[0][0][0];
    EXPECT_NEAR(length_m, shape.extent(0), 1e-15) << "a straight bar: sums of numbers of a few centimetres";
    double volume = 0.0;
    for (const double ratio : boxes.volume_ratio) volume += 1e-6 * ratio;
    const double lengths = shape.extent(0) * shape.extent(1) * shape.extent(2);
    EXPECT_NEAR(volume, lengths, 1e-9 * lengths) << "a straight bar is a box of boxes";
    EXPECT_EQ(row, states++);
  });
  EXPECT_EQ(states, 2U);
}

class SideBySideFiles : public testing::Test {
 protected:
  SideBySideFiles() {
    comparison_.curve = bar_curve("bar_inflation", LoadCaseKind::inflation, {{0.0, 2e3, 4e3}, {}, {}, {}, {}, {}});
    comparison_.body = "bar";
  }

  [[nodiscard]] SideBySide sides() const {
    return {.comparison = &comparison_, .parameters = validation_parameters(), .fields = {}, .pictured_row = 2};
  }

  /// Fields of one element at 1 kPa times the step, its points turned about the z axis by `turn_rad` and all moved by 1 mm along
  /// x, both times the step. @param at_rest as earlier versions wrote them, with points at rest
  [[nodiscard]] fs::path write_fields(int steps, double turn_rad = 0.0, bool at_rest = false) const {
    std::vector<CollectionEntry> entries;
    for (int step = 0; step < steps; ++step) {
      constexpr std::array<std::array<double, 3>, 8> corners{{{0, 0, 0},
                                                              {0.03, 0, 0},
                                                              {0.03, 0.01, 0},
                                                              {0, 0.01, 0},
                                                              {0, 0, 0.01},
                                                              {0.03, 0, 0.01},
                                                              {0.03, 0.01, 0.01},
                                                              {0, 0.01, 0.01}}};
      vtkNew<vtkPoints> points;
      vtkNew<vtkDoubleArray> displacement;
      displacement->SetName("displacement_m");
      displacement->SetNumberOfComponents(3);
      std::array<vtkIdType, 8> ids{};
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const auto& [x, y, z] = corners.at(corner);
        const double c = std::cos(turn_rad * step);
        const double s = std::sin(turn_rad * step);
        const double u_x = 1e-3 * step + c * x - s * y - x;
        const double u_y = s * x + c * y - y;
        ids.at(corner) = at_rest ? points->InsertNextPoint(x, y, z) : points->InsertNextPoint(x + u_x, y + u_y, z);
        displacement->InsertNextTuple3(u_x, u_y, 0.0);
      }
      vtkNew<vtkUnstructuredGrid> grid;
      grid->SetPoints(points);
      grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
      grid->GetPointData()->AddArray(displacement);
      vtkNew<vtkDoubleArray> ratio;
      ratio->SetName("volume_ratio");
      for (int n = 0; n < (at_rest ? 8 : 1); ++n) ratio->InsertNextValue(1.0);
      if (at_rest)
        grid->GetPointData()->AddArray(ratio);
      else
        grid->GetCellData()->AddArray(ratio);
      vtkNew<vtkDoubleArray> pressure;
      pressure->SetName("plenum_pressures_Pa");
      pressure->InsertNextValue(1e3 * step);
      grid->GetFieldData()->AddArray(pressure);
      entries.push_back({static_cast<double>(step), "step_" + std::to_string(step) + ".vtu"});
      io::write_vtu(fields_folder() / entries.back().file, *grid);
    }
    write_collection(fields_folder() / "fields.pvd", entries);
    return fields_folder() / "fields.pvd";
  }

  [[nodiscard]] fs::path fields_folder() const { return folder_ / "curves/fields/bar_inflation"; }

  [[nodiscard]] vtkUnstructuredGrid& grid(const char* name) {
    reader_->SetFileName((folder_ / name).c_str());
    reader_->Update();
    return *reader_->GetOutput();
  }

  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
  CurveComparison comparison_;
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
};

TEST_F(SideBySideFiles, ShowTheSurrogateAloneWithoutFields) {
  const SideBySideOutcome outcome = write_side_by_side(folder_, sides(), false);
  EXPECT_EQ(outcome.states, 3U);
  ASSERT_EQ(outcome.notes.size(), 1U);
  EXPECT_NE(outcome.notes[0].find("only the surrogate"), std::string::npos);
  const std::vector<CollectionEntry> entries = read_collection(folder_ / "worst.pvd");
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[2], (CollectionEntry{2.0, "worst/voxels_0002.vtu", 1, "voxels"}));
  vtkUnstructuredGrid& voxels = grid("worst/voxels_0002.vtu");
  EXPECT_EQ(voxels.GetNumberOfCells(), 3);
  EXPECT_EQ(voxels.GetFieldData()->GetArray("pressure_Pa")->GetTuple1(0), 4e3);
  EXPECT_GT(voxels.GetCellData()->GetArray("volume_ratio")->GetTuple1(1), 1.0) << "under pressure voxels grow";
  EXPECT_EQ(voxels.GetCellData()->GetScalars(), voxels.GetCellData()->GetArray("volume_ratio"));
  vtkDataArray* displacements = voxels.GetPointData()->GetArray("displacement_m");
  ASSERT_NE(displacements, nullptr);
  for (int axis = 0; axis < 3; ++axis)  // the first corner of the first of three cells, and the last of the last
    EXPECT_NEAR(voxels.GetPoint(0)[axis] - displacements->GetComponent(0, axis), 0.0, 1e-8);
  EXPECT_NEAR(voxels.GetPoint(22)[0] - displacements->GetComponent(22, 0), 0.03, 1e-8);
  EXPECT_NEAR(voxels.GetPoint(22)[2] - displacements->GetComponent(22, 2), 0.01, 1e-8);
}

TEST_F(SideBySideFiles, PutBothModelsOnOneClock) {
  SideBySide both = sides();
  const fs::path collection = write_fields(3);
  both.fields = field_collection(folder_ / "curves/bar_inflation.toml", "bar_inflation");
  ASSERT_EQ(both.fields, collection);
  const SideBySideOutcome outcome = write_side_by_side(folder_, both);
  EXPECT_TRUE(outcome.notes.empty());
  const std::vector<CollectionEntry> entries = read_collection(folder_ / "worst.pvd");
  ASSERT_EQ(entries.size(), 6U);
  for (std::size_t row = 0; row < 3; ++row) {
    for (const std::size_t part : {0U, 1U}) {
      EXPECT_EQ(entries[2 * row + part].time_s, static_cast<double>(row));
      EXPECT_EQ(entries[2 * row + part].part, static_cast<int>(part));
    }
  }
  EXPECT_NEAR(grid("worst/elements_0002.vtu").GetBounds()[0], 2e-3, 1e-9)
      << "deformed by the fields, whose positions are of single precision";
  for (const char* name : {"worst/elements_0000.vtu", "worst/voxels_0000.vtu"}) {
    std::array<double, 6> at_rest{};
    grid(name).GetBounds(at_rest.data());
    const std::array<double, 6> body{0.0, 0.03, 0.0, 0.01, 0.0, 0.01};
    for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(at_rest.at(n), body.at(n), 1e-6) << name << ": both are at the same place";
  }
  EXPECT_EQ(fs::exists(folder_ / "worst.png"), outcome.picture.written);
  EXPECT_EQ(outcome.picture.written, outcome.picture.missing.empty());
}

TEST_F(SideBySideFiles, TurnTheSurrogateAsTheElementsAre) {
  SideBySide both = sides();
  constexpr double turn_rad = 0.2;
  both.fields = write_fields(3, turn_rad);
  ASSERT_EQ(write_side_by_side(folder_, both, false).states, 3U);
  vtkUnstructuredGrid& voxels = grid("worst/voxels_0002.vtu");
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  voxels.GetPoint(0, low.data());
  voxels.GetPoint(1, high.data());  // along the bar
  // positions in files of fields are of single precision, of a few centimetres
  EXPECT_NEAR(std::atan2(high[1] - low[1], high[0] - low[0]), 2.0 * turn_rad, 1e-5);
  EXPECT_NEAR(high[2], low[2], 1e-7);
}

TEST_F(SideBySideFiles, MoveFieldsOfEarlierVersionsToTheirPlaces) {
  SideBySide both = sides();
  both.fields = write_fields(3, 0.0, true);
  ASSERT_EQ(write_side_by_side(folder_, both, false).states, 3U);
  EXPECT_NEAR(grid("worst/elements_0002.vtu").GetBounds()[0], 2e-3, 1e-9);
}

TEST_F(SideBySideFiles, FindTheStepsOfAFinerPathByTheirPressures) {
  // Steps at 0, 1, ... 4 kPa; the curve has 0, 2 and 4 kPa.
  SideBySide both = sides();
  both.fields = write_fields(5);
  EXPECT_EQ(write_side_by_side(folder_, both, false).states, 3U);
  EXPECT_NEAR(grid("worst/elements_0001.vtu").GetBounds()[0], 2e-3, 1e-9) << "the step at 2 kPa";
  comparison_.curve.values[0] = {0.0, 2.5e3, 4e3};
  const SideBySideOutcome outcome = write_side_by_side(folder_, both, false);
  EXPECT_EQ(outcome.states, 2U) << "no step is near 2.5 kPa";
  EXPECT_EQ(outcome.notes.size(), 1U);
  EXPECT_FALSE(fs::exists(folder_ / "worst/elements_0001.vtu"));
}

TEST_F(SideBySideFiles, KeepNothingOfAnEarlierRun) {
  (void)write_side_by_side(folder_, sides(), false);
  comparison_.curve.values[0] = {0.0};
  (void)write_side_by_side(folder_, sides(), false);
  EXPECT_TRUE(fs::exists(folder_ / "worst/voxels_0000.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "worst/voxels_0001.vtu"));
}

TEST_F(SideBySideFiles, RefuseFieldsWithoutDisplacements) {
  SideBySide both = sides();
  both.fields = write_fields(3);
  fs::remove(fields_folder() / "step_1.vtu");
  try {
    (void)write_side_by_side(folder_, both, false);
    ADD_FAILURE();
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("step_1.vtu"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace menger::voxel
