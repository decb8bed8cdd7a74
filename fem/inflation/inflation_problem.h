#pragma once

#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "fem/statics/body.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// A study made into what the solver takes: a mesh, what acts on it, and how its plena are driven.
struct InflationProblem {
  meshes::HexahedralMesh mesh;
  Body body;
  std::vector<PlenumDrive> drives;  ///< by plenum of the mesh
  std::vector<PlateDrive> plate_drives;
  std::vector<NamedPoint> points;  ///< "top centre" and "side centre", then those of the study
  Point low{};                     ///< of the bounding box at rest
  Point high{};                    ///< of the bounding box at rest
  double solid_volume_m3 = 0.0;
  std::vector<std::string> notes;
};

/// Meshes the body and names what holds and drives it.
///
/// Faces labelled "symmetry x", "symmetry y" or "symmetry z" lie in the plane where that coordinate is 0 and are held in that
/// direction. Where the body stands guided or rests, its horizontal rigid motions are held at two nodes of its surface: the one
/// nearest to its vertical middle line in x and y (of several the lowest, then that with the least x and y), and another in one
/// direction, against turning. That one lies far away along x beside the first, where the first lies in the middle plane of y;
/// else along y, where it lies in that of x; else it is the image of the first. So a body whose loads, shape and mesh are
/// symmetric about the two vertical planes through the line never turns, and keeps the line in its place if nodes lie on it; if
/// not, as with linear elements of odd number, it shifts with the first node, by a part of what the wall moves there. For any
/// other body the nodes change where it lies and not how it deforms.
///
/// "top centre" and "side centre" are the middles of the top and of the +x side of the body's bounding box; where the body is not
/// there, the nearest corner of an element takes their place, and a note says so.
///
/// A free body is held at three points (see free_supports), and must have no planes of symmetry, which would hold it, too.
///
/// A resting body starts where the ground's pressure on faces labelled "ground" carries its weight.
/// @throws io::InputError naming file and value: what the meshing refuses, an unknown label, region or plenum, plena that nothing
/// drives, a body without ground, labels that begin with "symmetry" and are none of the three or lie elsewhere, a
/// free body with planes of symmetry,
/// plates without a face or with a corner in common
InflationProblem make_problem(const InflationStudy& study);

}  // namespace menger::fem
