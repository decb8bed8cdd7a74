#include "meshes/files/gmsh_mesh.h"

#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/mesh_quality.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/support/test_folder.h"
#include "tests/unit/meshes/hexahedra/mesh_checks.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

class GmshMesh : public testing::Test {
 protected:
  [[nodiscard]] std::string refusal(const std::string& text) const {
    io::write_whole(folder_ / "a.msh", text);
    return refusal_of(folder_ / "a.msh");
  }

  static std::string refusal_of(const fs::path& file) {
    try {
      static_cast<void>(read_gmsh_mesh(file));
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const tests::TestFolder folder_;
};

/// A mesh as a file of format 2.2, written from that format's description: points from 1, corners around the bottom, then the
/// top.
std::string msh_text(const HexahedralMesh& mesh, double unit_m) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  text += std::to_string(mesh.region_names.size() + mesh.label_names.size()) + "\n";
  for (std::size_t i = 0; i < mesh.region_names.size(); ++i)
    text += "3 " + std::to_string(i + 1) + " \"" + mesh.region_names[i] + "\"\n";
  for (std::size_t i = 0; i < mesh.label_names.size(); ++i)
    text += "2 " + std::to_string(i + 11) + " \"" + mesh.label_names[i] + "\"\n";
  text += "$EndPhysicalNames\n$Nodes\n" + std::to_string(mesh.points.size()) + "\n";
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    text += std::to_string(i + 1);
    for (const double x : mesh.points[i]) text += " " + io::number_text(x / unit_m);
    text += "\n";
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(mesh.elements.size() + mesh.faces.size()) + "\n";
  std::size_t number = 0;
  for (const BoundaryFace& face : mesh.faces) {
    const std::string group = std::to_string(face.label + 11);
    text.append(std::to_string(++number)).append(" 3 2 ").append(group).append(" ").append(group);
    for (const std::size_t corner : face.corners) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementCorners& c = mesh.elements[e];
    const std::string group = std::to_string(mesh.regions[e] + 1);
    text.append(std::to_string(++number)).append(" 5 2 ").append(group).append(" ").append(group);
    for (const std::size_t corner : {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]}) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

TEST_F(GmshMesh, KeepsPhysicalNamesAsLabelsAndRegions) {
  HollowBodyOptions options;
  options.lid = LidPlace::top;
  const HexahedralMesh original = hollow_polycube(hollow_cube_design(0.02), options).mesh;
  io::write_whole(folder_ / "cube.msh", msh_text(original, 1e-3));
  const HexahedralMesh mesh = read_gmsh_mesh(folder_ / "cube.msh", 1e-3);
  expect_sound(mesh);
  EXPECT_EQ(mesh.elements.size(), original.elements.size());
  for (const char* label : {"outer", "ground", "chamber 0"})
    EXPECT_NEAR(label_area(mesh, label), label_area(original, label), 1e-15) << label;
  ASSERT_EQ(mesh.chambers.size(), 1U);
  EXPECT_NEAR(enclosed_volume(mesh, mesh.chambers[0]), 4.096e-6, 1e-17);
  double lid = 0.0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.regions[e] == region_index(mesh, "lid")) lid += element_volume(corner_points(mesh, e));
  }
  EXPECT_NEAR(lid, 0.02 * 0.02 * 0.002, 1e-18);
}

TEST_F(GmshMesh, AcceptsPlanesOfSymmetryByName) {
  io::write_whole(folder_ / "quarter.msh", msh_text(hollow_cube_quarter(0.02, 0.002, 1), 1.0));
  const HexahedralMesh mesh = read_gmsh_mesh(folder_ / "quarter.msh");
  EXPECT_NEAR(enclosed_volume(mesh, mesh.chambers[0]), 4.096e-6 / 4.0, 1e-17);
}

TEST_F(GmshMesh, CapsCloseTheHolesOfChambers) {
  HollowBodyOptions options;
  options.tubes = {{{0, 0, 0}, Side::z_max, 0.004}};
  HexahedralMesh original = hollow_polycube(hollow_cube_design(0.02), options).mesh;
  // For users the sides of the tube are part of the chamber.
  for (BoundaryFace& face : original.faces) {
    if (face.label == label_index(original, "tube")) face.label = label_index(original, "chamber 0");
  }
  EXPECT_NE(refusal(msh_text(original, 1.0)).find("chamber 0 is open: 8 edges"), std::string::npos);
  // Triangles from the middle of the hole, which is a point of its own, to each edge of its rim.
  const auto& rim = original.chambers[0].caps[0].rim;
  std::string text = msh_text(original, 1.0);
  const auto replace = [&](const std::string& from, const std::string& to) { text.replace(text.find(from), from.size(), to); };
  const std::string middle = std::to_string(original.points.size() + 1);
  const std::size_t elements = original.elements.size() + original.faces.size();
  replace("$EndNodes", middle + " 0.01 0.01 0.02\n$EndNodes");
  replace("$Nodes\n" + std::to_string(original.points.size()), "$Nodes\n" + middle);
  replace("$Elements\n" + std::to_string(elements), "$Elements\n" + std::to_string(elements + rim.size()));
  replace("$PhysicalNames\n5", "$PhysicalNames\n6\n2 90 \"cap of the tube\"");
  std::string triangles;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    triangles.append(std::to_string(elements + i + 1)).append(" 2 2 90 90 ").append(middle);
    triangles.append(" ").append(std::to_string(rim[i][i % 2] + 1)).append(" ").append(std::to_string(rim[i][1 - i % 2] + 1));
    triangles.append("\n");
  }
  replace("$EndElements", triangles + "$EndElements");
  io::write_whole(folder_ / "tube.msh", text);
  const HexahedralMesh mesh = read_gmsh_mesh(folder_ / "tube.msh");
  ASSERT_EQ(mesh.chambers.size(), 1U);
  ASSERT_EQ(mesh.chambers[0].caps.size(), 1U);
  EXPECT_EQ(mesh.chambers[0].caps[0].rim.size(), 8U);
  EXPECT_EQ(mesh.points.size(), original.points.size());
  EXPECT_NEAR(enclosed_volume(mesh, mesh.chambers[0]), 4.096e-6 + 0.004 * 0.004 * 0.002, 1e-17);
  // Without the sides of the hole the cap touches no open edge.
  replace("\"chamber 0\"", "\"inside\"");
  EXPECT_NE(refusal(text).find("\"cap of the tube\" closes no chamber"), std::string::npos) << refusal(text);
}

/// Lets Gmsh itself mesh a box of 1 x 2 x 3, with two hexahedra along every side or with tetrahedra, of the given order, and
/// write it in its present format.
void write_box_of_gmsh(const fs::path& folder, int order, bool hexahedra) {
  const std::string to_hexahedra =
      "Transfinite Surface {:};\nRecombine Surface {:};\nTransfinite Volume {1};\nMesh.SecondOrderIncomplete = 0;\n";
  io::write_whole(folder / "box.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\nTransfinite Curve {:} = 3;\n" +
                                          (hexahedra ? to_hexahedra : std::string()) +
                                          "Physical Volume(\"silicone\") = {1};\nPhysical Surface(\"top\") = {6};\n");
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::open((folder / "box.geo").string());
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(order);
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  gmsh::write((folder / "box.msh").string());
  gmsh::finalize();
}

TEST_F(GmshMesh, ReadsWhatGmshWritesInBothOrders) {
  for (const int order : {1, 2}) {
    write_box_of_gmsh(folder_, order, true);
    const HexahedralMesh mesh = read_gmsh_mesh(folder_ / "box.msh");
    EXPECT_EQ(mesh.elements.size(), 8U);
    EXPECT_EQ(mesh.points.size(), 27U) << "order " << order;
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"silicone"});
    EXPECT_NEAR(solid_volume(mesh), 6.0, 1e-13);
    EXPECT_NEAR(label_area(mesh, "top"), 2.0, 1e-14);
    EXPECT_NEAR(label_area(mesh, "outer"), 20.0, 1e-13);
    for (const BoundaryFace& face : mesh.faces) {
      if (mesh.label_names[face.label] != "top") continue;
      EXPECT_DOUBLE_EQ(mesh.points[face.corners[0]][2], 3.0);
    }
    expect_sound(mesh);
  }
}

TEST_F(GmshMesh, RefusesOtherElementsByTheirName) {
  write_box_of_gmsh(folder_, 1, false);
  const std::string message = refusal_of(folder_ / "box.msh");
  EXPECT_NE(message.find("elements of the kind \"Tetrahedron 4\"; only hexahedra"), std::string::npos) << message;
}

TEST_F(GmshMesh, RefusesFilesThatAreNoMesh) {
  EXPECT_TRUE(refusal_of(folder_ / "none.msh").starts_with((folder_ / "none.msh").string()));
  for (const char* text : {"", "this is no mesh", "Point(1) = {0, 0, 0, 1};"}) {
    EXPECT_NE(refusal(text).find("a.msh: is not a mesh of Gmsh: it must begin with $MeshFormat"), std::string::npos)
        << refusal(text);
  }
  io::write_whole(folder_ / "mesh.geo", "Point(1) = {0, 0, 0, 1};");
  EXPECT_NE(refusal_of(folder_ / "mesh.geo").find("its name must end in .msh"), std::string::npos);
  const std::string whole = msh_text(box({1.0, 1.0, 1.0}, {2, 2, 2}), 1.0);
  EXPECT_EQ(refusal(whole), "accepted");
  EXPECT_NE(refusal(whole.substr(0, whole.size() / 2)).find("a.msh: is cut off"), std::string::npos);
}

TEST_F(GmshMesh, RefusesPointsThatAreNoNumbers) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    HexahedralMesh mesh = box({1.0, 1.0, 1.0}, {1, 1, 1});
    mesh.points[2][0] = bad;
    const std::string message = refusal(msh_text(mesh, 1.0));
    EXPECT_TRUE(message.starts_with((folder_ / "a.msh").string())) << message;
  }
}

TEST_F(GmshMesh, RefusesOpenChambersAndInvertedElements) {
  HexahedralMesh open = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  const std::size_t chamber = label_index(open, "chamber 0");
  std::find_if(open.faces.begin(), open.faces.end(), [&](const BoundaryFace& face) { return face.label == chamber; })->label = 0;
  const std::string message = refusal(msh_text(open, 1.0));
  EXPECT_NE(message.find("a.msh: chamber 0 is open: 4 edges"), std::string::npos) << message;
  HexahedralMesh inverted = box({1.0, 1.0, 1.0}, {2, 1, 1});
  for (Point& point : inverted.points) point[0] = point[0] == 0.5 ? 1.2 : point[0];
  EXPECT_NE(refusal(msh_text(inverted, 1.0)).find("elements are inverted"), std::string::npos);
}

TEST_F(GmshMesh, RefusesElementsWithPointsThatAreNotThere) {
  const std::string whole = msh_text(box({1.0, 1.0, 1.0}, {1, 1, 1}), 1.0);
  const std::size_t end = whole.rfind("\n$EndElements");
  const std::size_t last = whole.rfind(' ', end);
  for (const char* point : {"9", "77", "4000000000", "-1", "0"}) {
    const std::string message = refusal(whole.substr(0, last + 1) + point + whole.substr(end));
    EXPECT_TRUE(message.starts_with((folder_ / "a.msh").string())) << point << ": " << message;
  }
}

TEST_F(GmshMesh, RefusesMorePointsThanMemoryHolds) {
  std::string text = msh_text(box({1.0, 1.0, 1.0}, {1, 1, 1}), 1.0);
  text.replace(text.find("$Nodes\n8\n"), 9, "$Nodes\n900000000000\n");
  EXPECT_TRUE(refusal(text).starts_with((folder_ / "a.msh").string())) << refusal(text);
}

}  // namespace
}  // namespace menger::meshes
