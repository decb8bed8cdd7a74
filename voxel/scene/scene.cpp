#include "voxel/scene/scene.h"

#include <unistd.h>

#include <limits>

namespace menger::voxel {
namespace {

constexpr double largest_size = static_cast<double>(std::numeric_limits<std::size_t>::max());

std::size_t saturated(double bytes) {
  return bytes >= largest_size ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(bytes);
}

double power(double base, int exponent) {
  double result = 1.0;
  for (int i = 0; i < exponent && result < largest_size; ++i) result *= base;
  return result;
}

}  // namespace

std::size_t estimated_memory_bytes(const meshes::Polycube& basal_body, int level, int voxels_per_cell) {
  // Per voxel: its state, up to three beams, and its share of a frame and of the list of close pairs. Per cell of the grid: the
  // material and the index of its voxel.
  constexpr double bytes_per_voxel = 2048.0;
  constexpr double bytes_per_cell = 8.0;
  const double cells = static_cast<double>(basal_body.nx()) * basal_body.ny() * basal_body.nz();
  const double voxels = power(voxels_per_cell, 3);
  return saturated(
      voxels * (bytes_per_voxel * power(static_cast<double>(basal_body.count()), level) + bytes_per_cell * power(cells, level)));
}

int voxels_per_cell(const Physics& physics) { return physics.surrogate ? physics.surrogate->parameters.voxels_per_cell : 1; }

std::size_t machine_memory_bytes() {
  return saturated(static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)));
}

}  // namespace menger::voxel
