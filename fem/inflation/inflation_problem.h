#pragma once

#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "fem/statics/body.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The input of the solver, made from a study: a mesh, its loads and supports, and the drives of its plena.
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

/// Meshes the body of a study, and sets its supports, drives, plates and named points.
///
/// Planes of symmetry: faces labelled "symmetry x", "symmetry y" or "symmetry z" lie in the plane where that coordinate is 0 and
/// are held in that direction.
///
/// Horizontal rigid motions: where the body stands guided without a bonded plate, or rests, they are held at two nodes of its
/// surface, unless planes of symmetry hold them. The first node is the one nearest to the body's vertical middle line in x and y
/// (of several the lowest, then that with the least x and y). The second node is held in one direction, against turning:
/// - If the first node lies in the middle plane of y, the second one lies far away from it along x.
/// - Otherwise, if the first node lies in the middle plane of x, the second one lies far away from it along y.
/// - Otherwise the second node is the mirror image of the first. If there is no node, it lies far away along x.
///
/// So a body whose loads, shape and mesh are symmetric about the two vertical planes through the line never turns. It keeps the
/// line in its place if nodes lie on it. If not, as with linear elements of odd number, it shifts with the first node, by a part
/// of the wall's displacement there. For any other body, the choice of the nodes changes its position but not its deformation.
///
/// Named points: "top centre" and "side centre" are the middles of the top and of the +x side of the body's bounding box. If the
/// body is not there, the nearest corner of an element replaces them, and a note says so.
///
/// A free body is held at three points (see free_supports). It must have no planes of symmetry, which would hold it, too.
///
/// A resting body starts where the ground's pressure on faces labelled "ground" carries its weight.
///
/// The last note may state how far coarse walls are off (see note_on_coarse_walls).
/// @throws io::InputError naming file and value: for everything that the meshing rejects, an unknown label, region or plenum,
/// plena without a drive, a body without ground, labels that begin with "symmetry" and are none of the three or lie elsewhere, a
/// free body with planes of symmetry, and plates without a face or with a corner in common
InflationProblem make_problem(const InflationStudy& study);

/// Refuses a body that would not fit into the memory of this machine as finite elements (see estimated_memory_bytes). The message
/// names the keys that decide its size. @param bodies how many of its equilibria are kept at once
/// @throws io::InputError
void require_memory(const InflationStudy& study, const meshes::HexahedralMesh& mesh, int bodies = 1);

}  // namespace menger::fem
