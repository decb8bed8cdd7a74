#include "meshes/hexahedra/mesh_assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "io/text/input_error.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/meshes/hexahedra/mesh_checks.h"

namespace menger::meshes {
namespace {

NamedHexahedra named(const HexahedralMesh& mesh) {
  NamedHexahedra input{mesh.points, mesh.elements, mesh.regions, mesh.region_names, {}, mesh.label_names, {}};
  for (const BoundaryFace& face : mesh.faces) input.faces.push_back({face.corners, face.label});
  return input;
}

void mirror(ElementCorners& corners) {
  for (std::size_t c = 0; c < 4; ++c) std::swap(corners[c], corners[c + 4]);
}

std::string assembly_refusal(const NamedHexahedra& input) {
  try {
    static_cast<void>(assemble_mesh(input, "a.msh"));
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshAssembly, RepairsHandednessAndFacesThatLookTheWrongWay) {
  const HexahedralMesh original = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  for (const std::size_t period : {1U, 2U, 3U}) {  // all elements, every second, every third
    NamedHexahedra input = named(original);
    for (std::size_t e = 0; e < input.elements.size(); e += period) mirror(input.elements[e]);
    for (std::size_t f = 0; f < input.faces.size(); f += period)
      std::reverse(input.faces[f].corners.begin(), input.faces[f].corners.end());
    const HexahedralMesh mesh = assemble_mesh(input, "a.msh");
    expect_sound(mesh);
    EXPECT_NEAR(solid_volume(mesh), solid_volume(original), 1e-12 * solid_volume(original));
    ASSERT_EQ(mesh.chambers.size(), 1U);
    EXPECT_NEAR(enclosed_volume(mesh, mesh.chambers[0]), 4.096e-6, 1e-17);
    EXPECT_NEAR(label_area(mesh, "ground"), 4e-4, 1e-15);
  }
}

TEST(MeshAssembly, UnnamedFacesAreOuter) {
  NamedHexahedra input = named(box({1.0, 1.0, 1.0}, {2, 2, 2}));
  input.faces.resize(1);
  const HexahedralMesh mesh = assemble_mesh(input, "a.msh");
  EXPECT_EQ(mesh.faces.size(), 24U);
  EXPECT_NEAR(label_area(mesh, "outer"), 5.75, 1e-14);
}

TEST(MeshAssembly, RefusesChambersThatAreOpenOrInsideOut) {
  const HexahedralMesh cube = hollow_polycube(hollow_cube_design(0.02), {}).mesh;
  NamedHexahedra open = named(cube);
  const std::size_t chamber = label_index(cube, "chamber 0");
  open.faces.erase(
      std::find_if(open.faces.begin(), open.faces.end(), [&](const NamedFace& face) { return face.label == chamber; }));
  EXPECT_TRUE(assembly_refusal(open).starts_with("a.msh: chamber 0 is open")) << assembly_refusal(open);
  NamedHexahedra outside = named(cube);
  outside.label_names[label_index(cube, "chamber 0")] = "inside";
  for (NamedFace& face : outside.faces) {
    if (face.label != chamber) face.label = label_index(cube, "outer");
  }
  outside.label_names[label_index(cube, "outer")] = "chamber";
  EXPECT_TRUE(assembly_refusal(outside).starts_with("a.msh: chamber encloses solid, not air")) << assembly_refusal(outside);
}

// A ring of eight elements whose ends meet without being merged: all are connected through faces, the other way round.
TEST(MeshAssembly, RefusesFacesInTheSamePlaceThatShareNoPoints) {
  NamedHexahedra ring = named(box({3.0, 3.0, 1.0}, {3, 3, 1}));
  ring.faces.clear();
  ring.elements.erase(ring.elements.begin() + 4);
  ring.regions.pop_back();
  EXPECT_EQ(assembly_refusal(ring), "accepted");
  for (std::size_t corner : {0U, 2U, 4U, 6U}) {  // of the second element, towards the first
    std::size_t& at = ring.elements[1][corner];
    ring.points.push_back(ring.points[at]);
    at = ring.points.size() - 1;
  }
  EXPECT_NE(assembly_refusal(ring).find("two faces lie in the same place"), std::string::npos) << assembly_refusal(ring);
  ring.label_names = {"slit"};
  const auto name_side = [&](std::size_t element, std::size_t side) {
    ring.faces.push_back({face_of_element(ring.elements[element], side), 0});
  };
  name_side(0, 1);
  EXPECT_NE(assembly_refusal(ring), "accepted") << "one side has a name";
  name_side(1, 0);
  EXPECT_EQ(assembly_refusal(ring), "accepted") << "both have";
}

TEST(MeshAssembly, RefusesElementsThatAreReallyInverted) {
  NamedHexahedra input = named(box({1.0, 1.0, 1.0}, {2, 1, 1}));
  // The plane between the two elements is drawn through one of them: numbering cannot repair that.
  for (Point& point : input.points) {
    if (point[0] == 0.5) point[0] = 1.2;
  }
  EXPECT_TRUE(assembly_refusal(input).starts_with("a.msh: 1 of 2 elements are inverted; the first is element 1"))
      << assembly_refusal(input);
}

TEST(MeshAssembly, RefusesFacesAndElementsThatDoNotFit) {
  const NamedHexahedra sound = named(box({1.0, 1.0, 1.0}, {2, 1, 1}));
  EXPECT_EQ(assembly_refusal(sound), "accepted");
  NamedHexahedra inner = sound;
  const ElementCorners& first = inner.elements[0];
  inner.faces.push_back({{first[1], first[3], first[7], first[5]}, 1});
  EXPECT_EQ(assembly_refusal(inner), "a.msh: a face of \"x max\" around (500, 500, 500) mm lies inside the solid");
  NamedHexahedra diagonal = sound;
  diagonal.faces.push_back({{first[0], first[3], first[7], first[4]}, 1});
  EXPECT_NE(assembly_refusal(diagonal).find("belongs to no element"), std::string::npos);
  NamedHexahedra twice = sound;
  twice.faces.push_back({twice.faces[0].corners, twice.faces[0].label + 1});
  EXPECT_NE(assembly_refusal(twice).find("also belongs to"), std::string::npos);
  NamedHexahedra apart = sound;
  for (std::size_t& corner : apart.elements[1]) {
    apart.points.push_back(apart.points[corner]);
    corner = apart.points.size() - 1;
  }
  apart.faces.clear();
  EXPECT_NE(assembly_refusal(apart).find("only 1 of 2 elements are connected"), std::string::npos);
  NamedHexahedra crowded = sound;
  crowded.elements.push_back(crowded.elements[0]);
  crowded.elements.push_back(crowded.elements[0]);
  crowded.regions.assign(4, 0);
  EXPECT_NE(assembly_refusal(crowded).find("share one face"), std::string::npos);
  EXPECT_EQ(assembly_refusal({}), "a.msh: holds no hexahedra");
}

}  // namespace
}  // namespace menger::meshes
