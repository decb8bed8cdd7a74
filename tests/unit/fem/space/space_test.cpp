#include "fem/space/space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fem/surfaces/cap_volume.h"
#include "fem/surfaces/chamber_volume.h"
#include "io/text/input_error.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

TEST(Space, HasTheNodesOfALattice) {
  const meshes::HexahedralMesh mesh = meshes::box({1.0, 2.0, 3.0}, {2, 3, 4});
  for (const int degree : {1, 2}) {
    for (const int refinements : {0, 1}) {
      const Space space = make_space(mesh, degree, refinements, MPI_COMM_SELF);
      const int steps = degree * (refinements == 0 ? 1 : 2);
      EXPECT_EQ(space.node_count, (2 * steps + 1) * (3 * steps + 1) * (4 * steps + 1));
      EXPECT_EQ(space.owned_count, space.node_count);
      EXPECT_EQ(space.local_node_count(), space.node_count);
      EXPECT_EQ(space.element_count, refinements == 0 ? 24U : 192U);
      EXPECT_EQ(space.local_element_count(), space.element_count);
      EXPECT_EQ(space.element_nodes.size(), space.element_count * space.nodes_per_element());
      const std::set<Index> used(space.element_nodes.begin(), space.element_nodes.end());
      EXPECT_EQ(used.size(), static_cast<std::size_t>(space.node_count));
    }
  }
}

TEST(Space, NumbersTheNodesOfElementsLexicographically) {
  for (const int degree : {1, 2}) {
    const Space space = make_space(meshes::box({1.0, 2.0, 3.0}, {1, 2, 1}), degree, 0, MPI_COMM_SELF);
    const auto side = static_cast<std::size_t>(degree) + 1;
    const Point edge{1.0, 1.0, 3.0};
    for (std::size_t e = 0; e < space.local_element_count(); ++e) {
      const Index* nodes = space.element_nodes.data() + e * space.nodes_per_element();
      const Point first = space.positions[static_cast<std::size_t>(nodes[0])];
      for (std::size_t a = 0; a < space.nodes_per_element(); ++a) {
        const std::array<std::size_t, 3> at{a % side, a / side % side, a / (side * side)};
        const Point& x = space.positions[static_cast<std::size_t>(nodes[a])];
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(x[i] - first[i], edge[i] * static_cast<double>(at[i]) / degree, 1e-14);
      }
    }
  }
}

TEST(Space, KnowsTheElementOfTheMeshThatAnElementIsAPartOf) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  for (const int refinements : {0, 1}) {
    const Space space = make_space(mesh, 1, refinements, MPI_COMM_SELF);
    ASSERT_EQ(space.mesh_elements.size(), space.local_element_count());
    for (std::size_t e = 0; e < space.local_element_count(); ++e) {
      Point middle{};
      for (std::size_t a = 0; a < 8; ++a)
        middle = sum(middle, scaled(0.125, space.positions[static_cast<std::size_t>(space.element_nodes[8 * e + a])]));
      const meshes::ElementCorners& corners = mesh.elements[space.mesh_elements[e]];
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GT(middle[i], mesh.points[corners[0]][i]);
        EXPECT_LT(middle[i], mesh.points[corners[7]][i]);
      }
    }
  }
}

template <std::size_t n>
FaceNodes<n> positions_of(const Space& space, const SpaceFace& face) {
  FaceNodes<n> nodes;
  for (std::size_t a = 0; a < n; ++a) nodes[a] = space.positions[static_cast<std::size_t>(face.nodes[a])];
  return nodes;
}

/// Integral of the normal over a plane face with equidistant nodes.
template <std::size_t n>
Point area_vector(const Space& space, const SpaceFace& face) {
  const FaceNodes<n> x = positions_of<n>(space, face);
  constexpr std::size_t degree = face_degree<n>;
  return cross(difference(x[degree], x[0]), difference(x[degree * (degree + 1)], x[0]));
}

// A box has the area vectors of its sides, each outward, and keeps its labels through refinement.
TEST(Space, FacesLookOutOfTheSolidAndKeepTheirLabels) {
  const Point size{1.0, 2.0, 3.0};
  const meshes::HexahedralMesh mesh = meshes::box(size, {2, 1, 2});
  for (const int degree : {1, 2}) {
    for (const int refinements : {0, 1}) {
      const Space space = make_space(mesh, degree, refinements, MPI_COMM_SELF);
      std::array<Point, 6> area{};
      for (const SpaceFace& face : space.faces) {
        ASSERT_LT(face.label, 6U);
        area[face.label] = sum(area[face.label], degree == 1 ? area_vector<4>(space, face) : area_vector<9>(space, face));
        for (std::size_t a = 0; a < space.nodes_per_face(); ++a) {
          const std::size_t axis = face.label / 2;
          const double plane = face.label % 2 == 1 ? size[axis] : 0.0;
          EXPECT_NEAR(space.positions[static_cast<std::size_t>(face.nodes[a])][axis], plane, 1e-14);
        }
      }
      for (std::size_t label = 0; label < 6; ++label) {
        ASSERT_EQ(mesh.label_names[label], (std::array{"x min", "x max", "y min", "y max", "z min", "z max"})[label]);
        for (std::size_t i = 0; i < 3; ++i) {
          const double area_of_side = size[(i + 1) % 3] * size[(i + 2) % 3];
          const double expected = i != label / 2 ? 0.0 : label % 2 == 1 ? area_of_side : -area_of_side;
          EXPECT_NEAR(area[label][i], expected, 1e-13) << mesh.label_names[label];
        }
      }
    }
  }
}

template <std::size_t n>
double volume_of_chamber(const Space& space, std::size_t label) {
  double volume = 0.0;
  for (const SpaceFace& face : space.faces)
    if (face.label == label) volume += chamber_volume<n>(positions_of<n>(space, face));
  return volume;
}

TEST(Space, ChamberFacesEncloseTheChamber) {
  const meshes::HexahedralMesh mesh = hollow_cube_quarter();
  for (const int refinements : {0, 1}) {
    const double truth_m3 = 2e-3 * 2e-3 * 4e-3;
    EXPECT_NEAR(volume_of_chamber<4>(make_space(mesh, 1, refinements, MPI_COMM_SELF), chamber), truth_m3, 1e-14 * 1e-6);
    EXPECT_NEAR(volume_of_chamber<9>(make_space(mesh, 2, refinements, MPI_COMM_SELF), chamber), truth_m3, 1e-14 * 1e-6);
  }
}

// New nodes lie on the sphere, not on the chords: the volume of an octant converges to that of the ball, four times nearer for
// each refinement of degree 1.
TEST(Space, NodesOfRefinedSpheresLieOnThem) {
  const meshes::HexahedralMesh mesh = meshes::thick_sphere_octant(1.0, 2.0, 1, 1);
  const auto label = static_cast<std::size_t>(std::find(mesh.label_names.begin(), mesh.label_names.end(), "chamber 0") -
                                              mesh.label_names.begin());
  for (const int degree : {1, 2}) {
    for (const int refinements : {0, 1, 2}) {
      const Space space = make_space(mesh, degree, refinements, MPI_COMM_SELF);
      for (const SpaceFace& face : space.faces) {
        if (face.label != label) continue;
        for (std::size_t a = 0; a < space.nodes_per_face(); ++a)
          EXPECT_NEAR(norm(space.positions[static_cast<std::size_t>(face.nodes[a])]), 1.0, 1e-12);
      }
    }
  }
}

meshes::HexahedralMesh cube_with_tube() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.tubes = {{.cell = {0, 0, 0}, .side = meshes::Side::z_max, .edge_m = 2e-3}};
  return meshes::hollow_polycube(meshes::hollow_cube_design(1e-2), options).mesh;
}

template <std::size_t k>
double volume_of_caps(const Space& space) {
  double volume = 0.0;
  for (const SpaceCap& cap : space.caps) {
    const std::vector<Index> nodes = rim_nodes(cap);
    std::vector<Point> positions;
    positions.reserve(nodes.size());
    for (const Index node : nodes) positions.push_back(space.positions[static_cast<std::size_t>(node)]);
    const auto number = [&](Index node) {
      return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    Rim<k> rim;
    for (const RimSegment& segment : cap.rim) {
      if constexpr (k == 2) {
        rim.segments.push_back({number(segment.first), number(segment.last)});
      } else {
        rim.segments.push_back({number(segment.first), number(segment.middle), number(segment.last)});
      }
    }
    volume += cap_volume<k>(rim, positions);
  }
  return volume;
}

/// Whether every node where a segment begins is one where another ends.
bool is_closed(const SpaceCap& cap) {
  std::set<Index> first;
  std::set<Index> last;
  for (const RimSegment& segment : cap.rim) {
    first.insert(segment.first);
    last.insert(segment.last);
  }
  return first == last && first.size() == cap.rim.size();
}

// Walls, tube and cap together enclose the chamber and the hole: (10 - 2 * 2)^3 mm^3 and 2 * 2 * 2 mm^3.
TEST(Space, CapsCloseTheirChambersAfterRefinement) {
  const meshes::HexahedralMesh mesh = cube_with_tube();
  ASSERT_EQ(mesh.chambers.size(), 1U);
  const auto walls = [&](const auto& volume_of, const Space& space) {
    double volume = 0.0;
    for (const std::size_t label : mesh.chambers[0].labels) volume += volume_of(space, label);
    return volume;
  };
  constexpr double truth_m3 = 6e-3 * 6e-3 * 6e-3 + 2e-3 * 2e-3 * 2e-3;
  for (const int refinements : {0, 1}) {
    const Space linear = make_space(mesh, 1, refinements, MPI_COMM_SELF);
    const Space quadratic = make_space(mesh, 2, refinements, MPI_COMM_SELF);
    ASSERT_EQ(linear.caps.size(), 1U);
    ASSERT_EQ(quadratic.caps.size(), 1U);
    EXPECT_TRUE(is_closed(linear.caps[0]));
    EXPECT_TRUE(is_closed(quadratic.caps[0]));
    EXPECT_EQ(linear.caps[0].rim.size(), mesh.chambers[0].caps[0].rim.size() << refinements);
    EXPECT_EQ(quadratic.caps[0].rim.size(), linear.caps[0].rim.size());
    for (const RimSegment& segment : quadratic.caps[0].rim) {
      ASSERT_GE(segment.middle, 0);
      const auto at = [&](Index node) { return quadratic.positions[static_cast<std::size_t>(node)]; };
      EXPECT_LT(norm(difference(at(segment.middle), scaled(0.5, sum(at(segment.first), at(segment.last))))), 1e-15);
    }
    EXPECT_NEAR(walls(volume_of_chamber<4>, linear) + volume_of_caps<2>(linear), truth_m3, 1e-12 * truth_m3);
    EXPECT_NEAR(walls(volume_of_chamber<9>, quadratic) + volume_of_caps<3>(quadratic), truth_m3, 1e-12 * truth_m3);
  }
}

// The rim of a cylinder is an arc: refinement must find it off the chords of the coarse mesh.
TEST(Space, CapsWithCurvedRimsAreFoundAfterRefinement) {
  const meshes::HexahedralMesh mesh = meshes::thick_cylinder_quarter(1e-3, 2e-3, 1e-3, {1, 2, 1});
  for (const int degree : {1, 2}) {
    for (const int refinements : {0, 1, 2}) {
      const Space space = make_space(mesh, degree, refinements, MPI_COMM_SELF);
      ASSERT_EQ(space.caps.size(), 1U);
      EXPECT_EQ(space.caps[0].rim.size(), mesh.chambers[0].caps[0].rim.size() << refinements);
      for (const Index node : rim_nodes(space.caps[0])) {
        const Point& x = space.positions[static_cast<std::size_t>(node)];
        EXPECT_NEAR(std::hypot(x[0], x[1]), 1e-3, 1e-15);
        EXPECT_NEAR(x[2], 1e-3, 1e-15);
      }
    }
  }
}

TEST(Space, KeepsTheRegionsOfElements) {
  meshes::HexahedralMesh mesh = meshes::box({2.0, 1.0, 1.0}, {2, 1, 1});
  mesh.region_names = {"wall", "lid"};
  mesh.regions = {0, 1};
  const Space space = make_space(mesh, 1, 1, MPI_COMM_SELF);
  ASSERT_EQ(space.element_regions.size(), 16U);
  for (std::size_t e = 0; e < 16; ++e) {
    const Point& corner = space.positions[static_cast<std::size_t>(space.element_nodes[8 * e])];
    EXPECT_EQ(space.element_regions[e], corner[0] < 1.0 - 1e-12 ? 0U : 1U);
  }
}

TEST(Space, RefusesElementsThatAreInsideOut) {
  meshes::HexahedralMesh mesh = meshes::box({1.0, 1.0, 1.0}, {1, 1, 1});
  for (std::size_t c = 0; c < 4; ++c) std::swap(mesh.elements[0][c], mesh.elements[0][c + 4]);
  EXPECT_THROW((void)make_space(mesh, 1, 0, MPI_COMM_SELF), io::InputError);
}

}  // namespace
}  // namespace menger::fem
