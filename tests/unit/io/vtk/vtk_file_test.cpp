#include "io/vtk/vtk_file.h"

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "io/text/whole_file.h"
#include "tests/support/paraview_files.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

/// An array whose values have no pattern to their bits; scalars have those at the ends of the type among them, whose length as a
/// vector is too large for VTK's own notes on an array.
template <class Array, class Value>
vtkSmartPointer<Array> values(const char* name, int components, vtkIdType tuples) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < components * tuples; ++i)
    array->SetValue(i, static_cast<Value>(std::sin(1.0 + 0.7 * static_cast<double>(i))));
  using Limits = std::numeric_limits<Value>;
  vtkIdType i = 0;
  for (const Value value : {Value(-0.0), Limits::min(), Limits::lowest(), Limits::max(), Limits::denorm_min()})
    if (components == 1 && i < tuples) array->SetValue(i++, value);
  return array;
}

/// A row of hexahedra, each with eight points of its own, with fields of every kind that menger writes.
vtkSmartPointer<vtkUnstructuredGrid> row_of_cubes(vtkIdType cubes, int type_of_points) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(type_of_points);
  grid->AllocateExact(cubes, 8 * cubes);
  vtkNew<vtkIntArray> region;
  region->SetName("region");
  for (vtkIdType cube = 0; cube < cubes; ++cube) {
    std::array<vtkIdType, 8> corners{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t circular = corner % 4;
      corners.at(corner) = points->InsertNextPoint(static_cast<double>(cube) / 3.0 + (circular == 1 || circular == 2 ? 0.3 : 0.0),
                                                   circular >= 2 ? 0.1 : 0.0, corner >= 4 ? 1.0 / 7.0 : 0.0);
    }
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
    region->InsertNextValue(static_cast<int>(cube) - 1);
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(values<vtkDoubleArray, double>("vector", 3, 8 * cubes));
  grid->GetPointData()->AddArray(values<vtkDoubleArray, double>("double", 1, 8 * cubes));
  grid->GetPointData()->AddArray(values<vtkFloatArray, float>("float", 1, 8 * cubes));
  grid->GetCellData()->AddArray(region);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  for (const char* name : {"wall", "", "a < b & \"c\""}) names->InsertNextValue(name);
  grid->GetFieldData()->AddArray(names);
  grid->GetFieldData()->AddArray(values<vtkDoubleArray, double>("TimeValue", 1, 1));
  return grid;
}

/// What VTK reads without a complaint.
vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkNew<vtkCallbackCommand> complaint;
  complaint->SetCallback([](vtkObject*, unsigned long, void*, void* text) { ADD_FAILURE() << static_cast<const char*>(text); });
  reader->AddObserver(vtkCommand::ErrorEvent, complaint);
  reader->AddObserver(vtkCommand::WarningEvent, complaint);
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

void expect_same_bits(vtkDataArray* read, vtkDataArray* written) {
  ASSERT_NE(read, nullptr);
  ASSERT_NE(written, nullptr);
  ASSERT_EQ(read->GetDataType(), written->GetDataType());
  ASSERT_EQ(read->GetNumberOfComponents(), written->GetNumberOfComponents());
  ASSERT_EQ(read->GetNumberOfValues(), written->GetNumberOfValues());
  const auto bytes = static_cast<std::size_t>(written->GetNumberOfValues() * written->GetDataTypeSize());
  if (bytes == 0) return;  // no bytes, perhaps no place either
  EXPECT_EQ(std::memcmp(read->GetVoidPointer(0), written->GetVoidPointer(0), bytes), 0) << written->GetName();
}

void expect_same(vtkUnstructuredGrid& read, vtkUnstructuredGrid& written) {
  expect_same_bits(read.GetPoints()->GetData(), written.GetPoints()->GetData());
  for (const char* name : {"vector", "double", "float"})
    expect_same_bits(read.GetPointData()->GetArray(name), written.GetPointData()->GetArray(name));
  expect_same_bits(read.GetCellData()->GetArray("region"), written.GetCellData()->GetArray("region"));
  expect_same_bits(read.GetFieldData()->GetArray("TimeValue"), written.GetFieldData()->GetArray("TimeValue"));
  auto* names = vtkStringArray::SafeDownCast(read.GetFieldData()->GetAbstractArray("names"));
  ASSERT_NE(names, nullptr);
  ASSERT_EQ(names->GetNumberOfValues(), 3);
  EXPECT_EQ(names->GetValue(1), "");
  EXPECT_EQ(names->GetValue(2), "a < b & \"c\"");
  ASSERT_EQ(read.GetNumberOfCells(), written.GetNumberOfCells());
  for (vtkIdType cell = 0; cell < written.GetNumberOfCells(); ++cell) {
    ASSERT_EQ(read.GetCellType(cell), VTK_HEXAHEDRON);
    vtkIdType count = 0, expected_count = 0;
    const vtkIdType *corners = nullptr, *expected = nullptr;
    read.GetCellPoints(cell, count, corners);
    written.GetCellPoints(cell, expected_count, expected);
    ASSERT_TRUE(std::equal(corners, corners + count, expected, expected + expected_count)) << cell;
  }
}

class VtkFile : public testing::Test {
 protected:
  const tests::TestFolder folder_;
};

TEST_F(VtkFile, HoldsItsDataInlineBinaryAndCompressed) {
  for (const IndexWidth indices : {IndexWidth::bits_32, IndexWidth::bits_64}) {
    write_vtu(folder_ / "a.vtu", *row_of_cubes(3, VTK_DOUBLE), indices);
    EXPECT_EQ(test_support::why_paraview_refuses(folder_ / "a.vtu"), "");
    // all of it is text, so that every parser of XML can read it
    for (const char c : read_whole(folder_ / "a.vtu")) ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~'));
  }
}

TEST_F(VtkFile, ComesBackBitForBit) {
  for (const int type_of_points : {VTK_FLOAT, VTK_DOUBLE}) {
    for (const IndexWidth indices : {IndexWidth::bits_32, IndexWidth::bits_64}) {
      const auto grid = row_of_cubes(3, type_of_points);
      write_vtu(folder_ / "a.vtu", *grid, indices);
      expect_same(*read(folder_ / "a.vtu"), *grid);
    }
  }
}

TEST_F(VtkFile, ComesBackBitForBitFromManyBlocks) {
  // 96,000 doubles are 768 kB, more than twenty of the blocks of 32 kB that are compressed one by one
  const auto grid = row_of_cubes(4000, VTK_DOUBLE);
  write_vtu(folder_ / "a.vtu", *grid);
  EXPECT_EQ(test_support::why_paraview_refuses(folder_ / "a.vtu"), "");
  expect_same(*read(folder_ / "a.vtu"), *grid);
}

TEST_F(VtkFile, MayHoldAnEmptyGrid) {
  const auto grid = row_of_cubes(0, VTK_DOUBLE);
  write_vtu(folder_ / "a.vtu", *grid);
  EXPECT_EQ(test_support::why_paraview_refuses(folder_ / "a.vtu"), "");
  const auto back = read(folder_ / "a.vtu");
  EXPECT_EQ(back->GetNumberOfPoints(), 0);
  EXPECT_EQ(back->GetNumberOfCells(), 0);
  expect_same_bits(back->GetFieldData()->GetArray("TimeValue"), grid->GetFieldData()->GetArray("TimeValue"));
}

}  // namespace
}  // namespace menger::io
