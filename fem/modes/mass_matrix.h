#pragma once

#include "fem/space/petsc_handle.h"
#include "fem/statics/assembly.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// Assembles the mass matrix of a body into a matrix with the structure of its stiffness (Assembly::make_matrix). Its blocks are
/// those of the consistent mass, M_ab = I int rho N_a N_b dV, kg, over the reference configuration. It is the same in every
/// state, because mass moves with the material. Gauss's rule with degree + 1 points per direction is exact on elements that are
/// parallelepipeds.
///
/// Thin walls: of a wall the mass is at its corners in its plane and consistent across it, M_ab = rho V / 4 (1/3 for a = b, 1/6
/// for the corner on the other face). Its stiffness lets it bend between its nodes, which trilinear shape functions do not; with
/// them frequencies of plates that bend between few elements come out too high, those of a hollow cube by 4 to 11 %, and with
/// this mass within 3 %. All mass at the nodes, as explicit walks have it, makes walls too slow that turn, by up to 7 %.
///
/// Rows and columns of held components are zero, so that the matrix is positive semidefinite. Without them it is definite where
/// all densities are > 0. The air in the chambers and around the body adds nothing. Collective.
void assemble_mass(const Assembly& assembly, const Body& body, Mat mass);

/// Adds a multiple of the mass matrix to a matrix of the same structure, such as a stiffness. Collective.
void add_mass(const Assembly& assembly, const Body& body, double factor, Mat matrix);

/// Returns the mass of the body, the sum of density x volume, kg, by the same rule. Collective; the same on all ranks.
double mass_of(const Space& space, const Body& body);

}  // namespace menger::fem
