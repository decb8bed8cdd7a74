#include "fem/inflation/field_output.h"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <filesystem>
#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/fem/statics/hollow_cube_space.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

Point moved(const Point& X) { return {0.1 * X[0], -0.2 * X[2], 0.3 * X[1]}; }

class FieldOutput : public testing::Test {
 protected:
  /// A field whose values tell the node.
  static NodalFields numbered(const Space& space) {
    NodalFields fields;
    for (std::size_t n = 0; n < space.positions.size(); ++n) {
      const double k = static_cast<double>(n);
      fields.deformation_gradient.push_back({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 + k});
      fields.cauchy_stress.push_back({3.0 * k, 0.0, 0.0, 0.0, 0.0, 0.0});
    }
    for (std::size_t e = 0; e < space.local_element_count(); ++e) {
      const double k = static_cast<double>(e);
      fields.elements.push_back({.volume_ratio = 1.0 + k, .largest_stretch = 2.0 + k, .von_mises_stress_Pa = 3.0 + k});
    }
    return fields;
  }

  static vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }

  const tests::TestFolder folder_;
};

TEST_F(FieldOutput, ReadsBackEveryNodeCellAndField) {
  for (const int degree : {1, 2}) {
    const Space space = hollow_cube_space(degree);
    FieldSeries series(folder_, MPI_COMM_WORLD);
    series.add(space, at_nodes(space, moved), numbered(space),
               {.step = degree, .s = 0.25, .plenum_pressures_Pa = {6000.0, 7.0}, .names = {{"left", "right"}, {"wall", "lid"}}});
    const auto grid = read(folder_ / "fields" / ("step_000" + std::to_string(degree) + ".vtu"));
    ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(space.positions.size()));
    ASSERT_EQ(grid->GetNumberOfCells(), 98);
    vtkPointData& data = *grid->GetPointData();
    for (vtkIdType n = 0; n < grid->GetNumberOfPoints(); ++n) {
      const auto node = static_cast<std::size_t>(n);
      const double k = static_cast<double>(n);
      for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        const double displacement = moved(space.positions[node])[axis];
        ASSERT_EQ(grid->GetPoint(n)[i], space.positions[node][axis] + displacement);
        ASSERT_EQ(data.GetArray("displacement_m")->GetComponent(n, i), displacement);
      }
      ASSERT_EQ(data.GetArray("cauchy_stress_Pa")->GetComponent(n, 0), 3.0 * k);
      ASSERT_EQ(data.GetArray("pressure_Pa")->GetComponent(n, 0), -k);
      ASSERT_NEAR(data.GetArray("principal_stretches")->GetComponent(n, 0), 1.0 + k, 1e-12 * (1.0 + k));
    }
    for (const char* name : {"volume_ratio", "von_mises_stress_Pa"}) EXPECT_EQ(data.GetArray(name), nullptr) << name;
    vtkCellData& cells = *grid->GetCellData();
    EXPECT_EQ(cells.GetArray("volume_ratio")->GetComponent(5, 0), 6.0);
    EXPECT_EQ(cells.GetArray("largest_stretch")->GetComponent(5, 0), 7.0);
    EXPECT_EQ(cells.GetArray("von_mises_stress_Pa")->GetComponent(5, 0), 8.0);
    EXPECT_EQ(cells.GetScalars(), cells.GetArray("largest_stretch"));
    EXPECT_EQ(data.GetVectors(), data.GetArray("displacement_m"));
    EXPECT_EQ(grid->GetFieldData()->GetAbstractArray("plenum_names")->GetVariantValue(1).ToString(), "right");
    EXPECT_EQ(grid->GetFieldData()->GetAbstractArray("region_names")->GetVariantValue(0).ToString(), "wall");
    EXPECT_EQ(grid->GetCellData()->GetArray("region")->GetComponent(5, 0), 0.0);
    EXPECT_EQ(grid->GetCellData()->GetArray("rank")->GetComponent(5, 0), 0.0);
    EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.25);
    EXPECT_EQ(grid->GetFieldData()->GetArray("plenum_pressures_Pa")->GetComponent(1, 0), 7.0);
  }
}

TEST_F(FieldOutput, CellsOfVtkAreTheElements) {
  for (const int degree : {1, 2}) {
    const Space space = hollow_cube_space(degree);
    FieldSeries series(folder_, MPI_COMM_WORLD);
    series.add(space, at_nodes(space, moved), numbered(space), {});
    const auto grid = read(folder_ / "fields/step_0000.vtu");
    const std::size_t count = space.nodes_per_element();
    for (vtkIdType e = 0; e < grid->GetNumberOfCells(); ++e) {
      // `moved` is linear, so the map from the reference cube is affine; any wrong order of nodes bends it
      const auto element = static_cast<std::size_t>(e) * count;
      const auto place = [&](std::size_t node) {
        Point X = space.positions[static_cast<std::size_t>(space.element_nodes[element + node])];
        const Point u = moved(X);
        for (std::size_t i = 0; i < 3; ++i) X[i] += u[i];
        return X;
      };
      const Point low = place(0);
      const Point high = place(count - 1);
      const Point along_x = place(static_cast<std::size_t>(space.degree));
      const Point along_y = place(static_cast<std::size_t>(space.degree * (space.degree + 1)));
      const std::array<double, 3> xi{0.2, 0.5, 0.9};
      int sub_cell = 0;
      Point x{};
      std::array<double, 27> weights{};
      grid->GetCell(e)->EvaluateLocation(sub_cell, xi.data(), x.data(), weights.data());
      for (std::size_t i = 0; i < 3; ++i) {
        const double along_z = high[i] - along_x[i] - along_y[i] + low[i];
        ASSERT_NEAR(x[i], low[i] + xi[0] * (along_x[i] - low[i]) + xi[1] * (along_y[i] - low[i]) + xi[2] * along_z, 1e-15)
            << "cell " << e;
      }
    }
  }
}

TEST_F(FieldOutput, CollectionNamesEveryStepOnceWithItsParameter) {
  const Space space = hollow_cube_space(1);
  FieldSeries series(folder_, MPI_COMM_WORLD);
  for (const int step : {0, 1, 1}) series.add(space, at_nodes(space, moved), numbered(space), {.step = step, .s = 0.5 * step});
  const std::string text = io::read_whole(folder_ / "fields.pvd");
  EXPECT_NE(text.find("timestep=\"0.5\" part=\"0\" file=\"fields/step_0001.vtu\""), std::string::npos) << text;
  EXPECT_EQ(text.find("step_0001"), text.rfind("step_0001")) << text;
}

TEST_F(FieldOutput, KeepsWhatItIsToldAndRemovesOtherStepsOnly) {
  const Space space = hollow_cube_space(1);
  FieldSeries series(folder_, MPI_COMM_WORLD);
  for (const int step : {0, 1, 2}) series.add(space, at_nodes(space, moved), numbered(space), {.step = step, .s = 0.5 * step});
  io::write_whole(folder_ / "fields/mine.vtu", "not of menger");
  FieldSeries next(folder_, MPI_COMM_WORLD);
  next.keep_only({{.step = 1, .s = 0.5}, {.step = 5, .s = 2.5}});
  EXPECT_TRUE(fs::exists(folder_ / "fields/step_0001.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "fields/step_0002.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "fields/step_0000.vtu"));
  EXPECT_TRUE(fs::exists(folder_ / "fields/mine.vtu"));
  const std::string text = io::read_whole(folder_ / "fields.pvd");
  EXPECT_NE(text.find("timestep=\"0.5\" part=\"0\" file=\"fields/step_0001.vtu\""), std::string::npos) << text;
  for (const char* gone : {"step_0000", "step_0002", "step_0005"}) EXPECT_EQ(text.find(gone), std::string::npos) << text;
  next.keep_only({});
  EXPECT_FALSE(fs::exists(folder_ / "fields.pvd"));
}

TEST_F(FieldOutput, RefusesAPlaceThatIsNoFolder) {
  const Space space = hollow_cube_space(1);
  io::write_whole(folder_ / "taken", "a file");
  FieldSeries series(folder_ / "taken", MPI_COMM_WORLD);
  EXPECT_THROW(series.add(space, at_nodes(space, moved), numbered(space), {}), io::InputError);
}

}  // namespace
}  // namespace menger::fem
