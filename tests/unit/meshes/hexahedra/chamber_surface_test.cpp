#include "meshes/hexahedra/chamber_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "io/text/input_error.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/mesh_quality.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::meshes {
namespace {

std::string fault(const HexahedralMesh& mesh) {
  try {
    require_closed_chambers(mesh, "mesh.vtu");
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "closed";
}

TEST(ChamberSurface, MissingFaceOpensTheChamber) {
  HexahedralMesh mesh = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  EXPECT_EQ(fault(mesh), "closed");
  const std::size_t chamber = label_index(mesh, "chamber 0");
  const auto face = std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const BoundaryFace& f) { return f.label == chamber; });
  face->label = label_index(mesh, "outer");
  EXPECT_TRUE(fault(mesh).starts_with("mesh.vtu: chamber 0 is open: 4 edges")) << fault(mesh);
}

TEST(ChamberSurface, TurnedFaceIsNoPartOfAClosedSurface) {
  HexahedralMesh mesh = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  const std::size_t chamber = label_index(mesh, "chamber 0");
  const auto face = std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const BoundaryFace& f) { return f.label == chamber; });
  std::reverse(face->corners.begin(), face->corners.end());
  EXPECT_TRUE(fault(mesh).starts_with("mesh.vtu: chamber 0 is open: 4 edges")) << fault(mesh);
}

TEST(ChamberSurface, OuterSurfaceIsNoChamber) {
  HexahedralMesh mesh = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  mesh.chambers[0].labels = {label_index(mesh, "outer"), label_index(mesh, "ground")};
  EXPECT_NE(fault(mesh).find("encloses solid, not air"), std::string::npos) << fault(mesh);
}

TEST(ChamberSurface, LabelBoundsOneChamberOnly) {
  HexahedralMesh mesh = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  mesh.chambers.push_back(mesh.chambers[0]);
  mesh.chambers[1].name = "chamber 1";
  EXPECT_EQ(fault(mesh), "mesh.vtu: chamber 1: label \"chamber 0\" already bounds another chamber");
  mesh.chambers[1].labels.clear();
  EXPECT_EQ(fault(mesh), "mesh.vtu: chamber 1 has no faces");
}

TEST(ChamberSurface, OnlyFacesOfSymmetryInCoordinatePlanesCloseAChamber) {
  HexahedralMesh mesh = hollow_cube_quarter(0.02, 0.002, 1);
  EXPECT_EQ(fault(mesh), "closed");
  HexahedralMesh unnamed = mesh;
  unnamed.label_names[label_index(mesh, "symmetry x")] = "side";
  EXPECT_NE(fault(unnamed).find("is open"), std::string::npos);
  for (Point& point : mesh.points) point[0] += 0.001;
  EXPECT_NE(fault(mesh).find("is open"), std::string::npos);
}

TEST(ChamberSurface, VolumeDoesNotDependOnThePlaceOfAClosedChamber) {
  HollowBodyOptions options;
  options.tubes = {{{0, 0, 0}, Side::z_max, 0.004}};
  HollowBody body = hollow_polycube(hollow_cube_design(0.02), options);
  for (Point& point : body.mesh.points) point = {point[0] - 0.3, point[1] + 0.2, point[2] + 0.5};
  // Terms 25 times the size of the body cancel.
  EXPECT_NEAR(enclosed_volume(body.mesh, body.mesh.chambers[0]), body.chambers[0].volume_m3, 1e-11 * body.chambers[0].volume_m3);
}

TEST(MeshQuality, ReportsSizesShapesAndVolumes) {
  HollowBodyOptions options;
  options.elements_through_wall = 2;
  options.largest_element_m = 0.004;
  options.growth = 2.0;
  const MeshQuality quality = mesh_quality(hollow_polycube(hollow_cube_design(0.02), options));
  EXPECT_NEAR(quality.scaled_jacobian_min, 1.0, 1e-12);
  EXPECT_NEAR(quality.scaled_jacobian_mean, 1.0, 1e-12);
  EXPECT_LE(quality.longest_edge_m, 0.004);
  EXPECT_GT(quality.aspect_ratio_max, 2.0);
  EXPECT_LE(quality.aspect_ratio_max, 4.5);
  ASSERT_EQ(quality.volumes.size(), 2U);
  for (const MeasuredVolume& volume : quality.volumes)
    EXPECT_NEAR(volume.mesh_m3, volume.closed_form_m3.value(), 1e-12 * volume.mesh_m3) << volume.part;
  const std::string table = quality_table(quality).text();
  EXPECT_TRUE(table.starts_with("quantity,value,closed_form\npoints,")) << table;
  EXPECT_NE(table.find("\nchamber 0 volume_m3,4.09"), std::string::npos) << table;
  EXPECT_NE(quality_text(quality).find("chamber 0: 4.096 cm^3"), std::string::npos) << quality_text(quality);
}

TEST(MeshQuality, InvertedElementsAreRefusedWithTheirNumberAndPlace) {
  HexahedralMesh mesh = box({1.0, 1.0, 1.0}, {3, 1, 1});
  EXPECT_NO_THROW(require_no_inverted_elements(mesh, "box"));
  // The corner at (2/3, 0, 0) is dragged through element 1 into element 0.
  for (Point& point : mesh.points) {
    if (std::abs(point[0] - 2.0 / 3.0) < 1e-9 && point[1] == 0.0 && point[2] == 0.0) point[0] = 0.1;
  }
  try {
    require_no_inverted_elements(mesh, "box");
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("box: 1 of 3 elements are inverted; the first is element 1 around ("))
        << error.what();
  }
}

}  // namespace
}  // namespace menger::meshes
