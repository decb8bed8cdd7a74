#pragma once

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Returns a straight bar of `length` cells of material 1 along x.
Polycube bar(int length);

/// Returns a horizontal plane of n x n cells of material 1.
Polycube plane(int n);

/// Returns a full cube of n x n x n cells of material 1.
Polycube full_cube(int n);

/// Returns the basal Menger sponge: 3 x 3 x 3 cells without the centre and the centres of the faces, 20 cells of material 1.
Polycube menger_sponge();

}  // namespace menger::meshes
