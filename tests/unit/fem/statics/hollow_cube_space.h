#pragma once

#include <array>
#include <vector>

#include "fem/space/space.h"
#include "fem/surfaces/point.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::fem {

/// A hollow cube of 20 mm with walls of 4 mm: 98 elements.
inline Space hollow_cube_space(int degree) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 0.004;
  return make_space(meshes::hollow_polycube(meshes::hollow_cube_design(0.02), options).mesh, degree, 0, MPI_COMM_WORLD);
}

/// Values of a function of the reference position at the nodes, 3 per node.
template <class Function>
std::vector<double> at_nodes(const Space& space, const Function& function) {
  std::vector<double> values;
  for (const Point& X : space.positions) {
    const Point value = function(X);
    values.insert(values.end(), value.begin(), value.end());
  }
  return values;
}

}  // namespace menger::fem
