#pragma once

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// A straight bar of `length` cells of material 1 along x.
Polycube bar(int length);

/// A horizontal plane of n x n cells of material 1.
Polycube plane(int n);

/// A full cube of n x n x n cells of material 1.
Polycube full_cube(int n);

/// The basal Menger sponge: 3 x 3 x 3 without its centre and the centres of its faces, 20 cells of material 1.
Polycube menger_sponge();

}  // namespace menger::meshes
