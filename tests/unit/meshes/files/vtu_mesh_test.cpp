#include "meshes/files/vtu_mesh.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/support/small_disk.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

class VtuMesh : public testing::Test {
 protected:
  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
};

void expect_equal(const HexahedralMesh& a, const HexahedralMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.region_names, b.region_names);
  EXPECT_EQ(a.label_names, b.label_names);
  EXPECT_EQ(a.plenum_names, b.plenum_names);
  EXPECT_EQ(a.geometry, b.geometry);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_EQ(a.faces[i].corners, b.faces[i].corners);
    EXPECT_EQ(a.faces[i].label, b.faces[i].label);
  }
  ASSERT_EQ(a.chambers.size(), b.chambers.size());
  for (std::size_t i = 0; i < a.chambers.size(); ++i) {
    EXPECT_EQ(a.chambers[i].name, b.chambers[i].name);
    EXPECT_EQ(a.chambers[i].labels, b.chambers[i].labels);
    EXPECT_EQ(a.chambers[i].plenum, b.chambers[i].plenum);
    ASSERT_EQ(a.chambers[i].caps.size(), b.chambers[i].caps.size());
    for (std::size_t cap = 0; cap < a.chambers[i].caps.size(); ++cap)
      EXPECT_EQ(a.chambers[i].caps[cap].rim, b.chambers[i].caps[cap].rim);
  }
}

HollowBody body_with_everything() {
  HollowBodyOptions options;
  options.level = 2;
  options.hole_edge_m = 0.002;
  options.tubes = {{{0, 0, 0}, Side::z_max, 0.0025}, {{3, 0, 0}, Side::x_max, 0.002}};
  options.lid = LidPlace::bottom;
  options.joint_region = true;
  return hollow_polycube({"bar", bar(2), 0.00667}, options);
}

TEST_F(VtuMesh, ReadsBackEqual) {
  for (const HexahedralMesh& mesh :
       {body_with_everything().mesh, box({1.0, 2.0, 3.0}, {1, 2, 3}), thick_sphere_octant(1.0, 2.0, 2, 2),
        thick_cylinder_quarter(1.0, 2.0, 1.0, {1, 3, 1}), hollow_cube_quarter(0.02, 0.002, 1)}) {
    write_vtu_mesh(folder_ / "mesh.vtu", mesh);
    expect_equal(read_vtu_mesh(folder_ / "mesh.vtu"), mesh);
  }
}

TEST_F(VtuMesh, OtherProgramsSeeHexahedraQuadrilateralsAndNames) {
  const HexahedralMesh mesh = body_with_everything().mesh;
  write_vtu_mesh(folder_ / "mesh.vtu", mesh);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder_ / "mesh.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  ASSERT_EQ(grid.GetNumberOfCells(), static_cast<vtkIdType>(mesh.elements.size() + mesh.faces.size()));
  auto* names = vtkStringArray::SafeDownCast(grid.GetFieldData()->GetAbstractArray("label_names"));
  auto* chamber_names = vtkStringArray::SafeDownCast(grid.GetFieldData()->GetAbstractArray("chamber_names"));
  ASSERT_TRUE(names != nullptr && chamber_names != nullptr);
  vtkDataArray& label = *grid.GetCellData()->GetArray("label");
  vtkDataArray& region = *grid.GetCellData()->GetArray("region");
  vtkDataArray& chamber = *grid.GetCellData()->GetArray("chamber");
  vtkIdType chamber_faces = 0;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    if (grid.GetCellType(cell) == VTK_HEXAHEDRON) {
      EXPECT_EQ(label.GetTuple1(cell), -1.0);
      EXPECT_GE(region.GetTuple1(cell), 0.0);
      continue;
    }
    ASSERT_EQ(grid.GetCellType(cell), VTK_QUAD);
    EXPECT_EQ(region.GetTuple1(cell), -1.0);
    const std::string name = names->GetValue(static_cast<vtkIdType>(label.GetTuple1(cell)));
    if (name == "chamber 1") {
      EXPECT_EQ(chamber_names->GetValue(static_cast<vtkIdType>(chamber.GetTuple1(cell))), "chamber 1");
      ++chamber_faces;
    }
    if (name == "outer") {
      EXPECT_EQ(chamber.GetTuple1(cell), -1.0);
    }
  }
  EXPECT_GT(chamber_faces, 0);
}

TEST_F(VtuMesh, EqualMeshesAreEqualFiles) {
  write_vtu_mesh(folder_ / "a.vtu", body_with_everything().mesh);
  write_vtu_mesh(folder_ / "b.vtu", body_with_everything().mesh);
  EXPECT_EQ(io::read_whole(folder_ / "a.vtu"), io::read_whole(folder_ / "b.vtu"));
}

std::string refusal(const fs::path& file) {
  try {
    static_cast<void>(read_vtu_mesh(file));
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST_F(VtuMesh, RefusesFilesThatAreNoMesh) {
  const fs::path file = folder_ / "mesh.vtu";
  EXPECT_TRUE(refusal(file).starts_with(file.string())) << "missing";
  io::write_whole(file, "solid");
  EXPECT_EQ(refusal(file), file.string() + ": is not a VTK file of unstructured cells (.vtu)");
  write_vtu_mesh(file, body_with_everything().mesh);
  const std::string whole = io::read_whole(file);
  io::write_whole(file, whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(refusal(file).starts_with(file.string())) << "cut off: " << refusal(file);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  grid->SetPoints(points);
  const vtkIdType corner = 0;
  grid->InsertNextCell(VTK_VERTEX, 1, &corner);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  writer->Write();
  EXPECT_EQ(refusal(file), file.string() + ": has no field data region_names, so menger did not write this mesh");
}

TEST_F(VtuMesh, RefusesInvertedElementsAndOpenChambers) {
  HexahedralMesh open = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  for (BoundaryFace& face : open.faces) face.label = face.corners[0] % 7 == 0 ? label_index(open, "outer") : face.label;
  write_vtu_mesh(folder_ / "open.vtu", open);
  EXPECT_NE(refusal(folder_ / "open.vtu").find("open.vtu: chamber 0 is open"), std::string::npos);
  HexahedralMesh inverted = box({1.0, 1.0, 1.0}, {1, 1, 1});
  std::swap(inverted.elements[0][0], inverted.elements[0][1]);
  write_vtu_mesh(folder_ / "inverted.vtu", inverted);
  EXPECT_NE(refusal(folder_ / "inverted.vtu").find("1 of 1 elements are inverted"), std::string::npos);
}

TEST_F(VtuMesh, AFullDiskLeavesTheEarlierFile) {
  const fs::path file = folder_ / "mesh.vtu";
  write_vtu_mesh(file, body_with_everything().mesh);
  const std::string whole = io::read_whole(file);
  for (const std::size_t room : {std::size_t{0}, std::size_t{4096}, whole.size() / 2, whole.size() - 1}) {
    std::string message;
    {
      const SmallDisk disk(room);
      try {
        write_vtu_mesh(file, body_with_everything().mesh);
      } catch (const io::InputError& error) {
        message = error.what();
      }
    }
    EXPECT_TRUE(message.starts_with(file.string())) << room << ": " << message;
    EXPECT_EQ(io::read_whole(file), whole) << room;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "temporary files are left";
}

TEST_F(VtuMesh, RefusesPointsThatAreNoNumbers) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    HexahedralMesh mesh = box({1.0, 1.0, 1.0}, {1, 1, 1});
    mesh.points[3][1] = bad;
    write_vtu_mesh(folder_ / "mesh.vtu", mesh);
    EXPECT_NE(refusal(folder_ / "mesh.vtu").find("point 3 has a coordinate that is not a finite number"), std::string::npos)
        << refusal(folder_ / "mesh.vtu");
  }
}

TEST_F(VtuMesh, RefusesFacesThatAreNotTheBoundary) {
  const fs::path file = folder_ / "mesh.vtu";
  const auto refused = [&](const auto& change) {
    HexahedralMesh mesh = box({1.0, 1.0, 2.0}, {1, 1, 2});
    change(mesh);
    write_vtu_mesh(file, mesh);
    return refusal(file);
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_EQ(refused([](HexahedralMesh&) {}), "accepted");
  EXPECT_TRUE(has(refused([](HexahedralMesh& m) { m.faces.pop_back(); }), "1 sides of elements on the boundary have no face"));
  EXPECT_TRUE(has(refused([](HexahedralMesh& m) { m.faces.push_back(m.faces[0]); }), "is given twice"));
  EXPECT_TRUE(
      has(refused([](HexahedralMesh& m) { std::swap(m.faces[0].corners[0], m.faces[0].corners[2]); }), "in the wrong order"));
  EXPECT_TRUE(has(refused([](HexahedralMesh& m) {
                    for (std::size_t i = 0; i < 4; ++i) m.faces[0].corners[i] = m.elements[0][face_corners[5][i]];
                  }),
                  "lies inside the solid"));
  EXPECT_TRUE(has(refused([](HexahedralMesh& m) { m.faces[0].corners = {0, 1, 2, 11}; }), "belongs to no element"));
}

/// The file of a mesh after a change to what VTK reads from it.
template <class Change>
void rewrite(const fs::path& file, const Change& change) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  change(*reader->GetOutput());
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(reader->GetOutput());
  writer->SetFileName(file.c_str());
  writer->Write();
}

TEST_F(VtuMesh, RefusesAMissingGeometryAndBrokenNumbers) {
  const fs::path file = folder_ / "mesh.vtu";
  write_vtu_mesh(file, box({1.0, 1.0, 1.0}, {1, 1, 1}));
  rewrite(file, [](vtkUnstructuredGrid& grid) { grid.GetFieldData()->RemoveArray("geometry"); });
  EXPECT_NE(refusal(file).find("must have field data geometry"), std::string::npos) << refusal(file);
  write_vtu_mesh(file, box({1.0, 1.0, 1.0}, {1, 1, 1}));
  rewrite(file, [](vtkUnstructuredGrid& grid) {
    vtkNew<vtkDoubleArray> broken;
    broken->SetName("geometry");
    broken->InsertNextValue(0.5);
    grid.GetFieldData()->RemoveArray("geometry");
    grid.GetFieldData()->AddArray(broken);
  });
  EXPECT_NE(refusal(file).find("geometry holds 0.5, which must be a whole number"), std::string::npos) << refusal(file);
}

TEST_F(VtuMesh, APlaceUnderAFileIsRefused) {
  io::write_whole(folder_ / "file", "text");
  EXPECT_THROW(write_vtu_mesh(folder_ / "file/mesh.vtu", box({1.0, 1.0, 1.0}, {1, 1, 1})), io::InputError);
  EXPECT_EQ(io::read_whole(folder_ / "file"), "text");
}

/// A mesh of one element as VTK's text, which a test can damage.
std::string text_of_a_box(const fs::path& folder) {
  write_vtu_mesh(folder / "box.vtu", box({1.0, 1.0, 1.0}, {1, 1, 1}));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "box.vtu").c_str());
  reader->Update();
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(reader->GetOutput());
  writer->SetDataModeToAscii();
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

TEST_F(VtuMesh, RefusesArraysThatVtkDoesNotCheck) {
  const fs::path file = folder_ / "mesh.vtu";
  const std::string whole = text_of_a_box(folder_);
  const auto refused = [&](const std::string& found, const std::string& replaced) {
    std::string text = whole;
    const std::size_t at = text.find(found);
    EXPECT_NE(at, std::string::npos) << found << " is not in\n" << text;
    if (at != std::string::npos) text.replace(at, found.size(), replaced);
    io::write_whole(file, text);
    return refusal(file);
  };
  EXPECT_EQ(refused("VTKFile", "VTKFile"), "accepted");
  EXPECT_TRUE(refused("<Array type=\"String\"", "<Array type=\"Strange\"").starts_with(file.string())) << refusal(file);
  EXPECT_EQ(refused("8 12 16 20 24 28", "4 12 16 20 24 28"), file.string() + ": cell 0 has 4 corners, its type has 8");
  EXPECT_TRUE(refused("8 12 16 20 24 28", "8 12 16 20 24 9999").starts_with(file.string())) << refusal(file);
  EXPECT_TRUE(refused("8 12 16 20 24 28", "8 4 16 20 24 28").starts_with(file.string())) << refusal(file);
}

}  // namespace
}  // namespace menger::meshes
