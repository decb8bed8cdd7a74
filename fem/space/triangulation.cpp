#include "fem/space/triangulation.h"

#include <deal.II/grid/manifold_lib.h>

#include <string>

#include "io/text/input_error.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {

namespace {

dealii::SubCellData boundary_of(const meshes::HexahedralMesh& mesh) {
  dealii::SubCellData boundary;
  boundary.boundary_quads.reserve(mesh.faces.size());
  for (const meshes::BoundaryFace& face : mesh.faces) {
    dealii::CellData<2> quad;
    // deal.II numbers the corners of a quadrilateral lexicographically, not around it
    quad.vertices = {static_cast<unsigned>(face.corners[0]), static_cast<unsigned>(face.corners[1]),
                     static_cast<unsigned>(face.corners[3]), static_cast<unsigned>(face.corners[2])};
    quad.boundary_id = static_cast<dealii::types::boundary_id>(face.label);
    boundary.boundary_quads.push_back(quad);
  }
  return boundary;
}

void set_geometry(meshes::Geometry geometry, dealii::Triangulation<3>& triangulation) {
  constexpr dealii::types::manifold_id curved = 1;
  if (geometry == meshes::Geometry::straight) return;
  if (geometry == meshes::Geometry::spherical) {
    triangulation.set_manifold(curved, dealii::SphericalManifold<3>(dealii::Point<3>()));
  } else {
    triangulation.set_manifold(curved, dealii::CylindricalManifold<3>(2));
  }
  triangulation.set_all_manifold_ids(curved);
}

}  // namespace

void make_triangulation(const meshes::HexahedralMesh& mesh, dealii::Triangulation<3>& triangulation) {
  std::vector<dealii::Point<3>> vertices;
  vertices.reserve(mesh.points.size());
  for (const meshes::Point& point : mesh.points) vertices.emplace_back(point[0], point[1], point[2]);
  std::vector<dealii::CellData<3>> cells;
  cells.reserve(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!(meshes::smallest_determinant(corner_points(mesh, e)) > 0.0))
      throw io::InputError("the mesh cannot be used: the element at " +
                           meshes::millimetre_text(mesh.points[mesh.elements[e][0]]) + " is inverted");
    dealii::CellData<3> cell;
    for (std::size_t c = 0; c < 8; ++c) cell.vertices[c] = static_cast<unsigned>(mesh.elements[e][c]);
    cell.material_id = static_cast<dealii::types::material_id>(mesh.regions[e]);
    cells.push_back(cell);
  }
  try {
    triangulation.create_triangulation(vertices, cells, boundary_of(mesh));
  } catch (const dealii::ExceptionBase& error) {
    throw io::InputError(std::string("the mesh cannot be used: ") + error.what());
  }
  set_geometry(mesh.geometry, triangulation);
}

}  // namespace menger::fem
