#include "meshes/design/reference_shapes.h"

namespace menger::meshes {

namespace {

constexpr Material solid = 1;

Polycube box(int nx, int ny, int nz) {
  Polycube body(nx, ny, nz);
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) body.set({x, y, z}, solid);
    }
  }
  return body;
}

}  // namespace

Polycube bar(int length) { return box(length, 1, 1); }

Polycube plane(int n) { return box(n, n, 1); }

Polycube full_cube(int n) { return box(n, n, n); }

Polycube menger_sponge() {
  Polycube body = full_cube(3);
  // the centre and its six face neighbours: cells with at least two middle coordinates
  for (const CellIndex& cell : body.occupied()) {
    if ((cell.x == 1) + (cell.y == 1) + (cell.z == 1) >= 2) body.set(cell, empty);
  }
  return body;
}

}  // namespace menger::meshes
