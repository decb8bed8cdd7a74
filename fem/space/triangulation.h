#pragma once

#include <deal.II/grid/tria.h>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Fills a triangulation of deal.II with a mesh, which becomes its coarse mesh.
///
/// Boundary ids are the indices of the labels, material ids those of the regions. The manifold is that of the mesh's geometry.
/// @throws io::InputError if an element is inverted, or deal.II finds no valid mesh in the elements
void make_triangulation(const meshes::HexahedralMesh& mesh, dealii::Triangulation<3>& triangulation);

}  // namespace menger::fem
