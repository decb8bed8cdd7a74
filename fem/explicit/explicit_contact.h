#pragma once

#include <span>
#include <vector>

#include "fem/contact/rigid_ground.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Returns the outer area of each node of a mesh, m^2: a quarter of every boundary face at the node that bounds no chamber, in
/// the reference configuration. The stiffness of the ground's springs is proportional to it.
std::vector<double> outer_node_areas_m2(const meshes::HexahedralMesh& mesh);

/// Returns the energy of the ground's springs, J.
/// @param positions_m current, 3 per node
/// @param areas_m2 per node
double ground_energy_J(const RigidGround& ground, std::span<const double> positions_m, std::span<const double> areas_m2);

/// Returns the force of the ground on the body, N, upwards.
double ground_force_N(const RigidGround& ground, std::span<const double> positions_m, std::span<const double> areas_m2);

}  // namespace menger::fem
