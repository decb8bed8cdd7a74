#include "voxel/scene/scene.h"

#include <unistd.h>

#include <algorithm>
#include <limits>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "voxel/scene/physics_file.h"

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

const char* toml_boolean(bool value) { return value ? "true" : "false"; }

}  // namespace

double body_length_m(const meshes::Design& design, int level) {
  const int cells = std::max({design.body.nx(), design.body.ny(), design.body.nz()});
  return power(cells, level) * design.cell_edge_m;
}

std::size_t estimated_memory_bytes(const meshes::Polycube& basal_body, int level, int voxels_per_cell) {
  // Per voxel: its state, up to three beams, its share of a frame and of the list of close pairs. Per cell of the grid: the
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

std::string scene_text(const Scene& scene) {
  const meshes::Polycube& body = scene.design.body;
  return "level = " + std::to_string(scene.level) + "\nduration_s = " + io::number_text(scene.duration_s) +
         "\nrecord_interval_s = " + io::number_text(scene.record_interval_s) +
         "\nenergy_ledger = " + toml_boolean(scene.energy_ledger) + "\n[design]\nname = " + io::toml_quoted(scene.design.name) +
         "\ncell_edge_m = " + io::number_text(scene.design.cell_edge_m) + "\ncells = [" + std::to_string(body.nx()) + ", " +
         std::to_string(body.ny()) + ", " + std::to_string(body.nz()) + "]\ndigits = " + io::toml_quoted(body.digits()) +
         "\n[output]\nframes = " + toml_boolean(scene.output.frames) + "\npictures = " + toml_boolean(scene.output.pictures) +
         "\nrecords_per_frame = " + std::to_string(scene.output.records_per_frame) + "\n" + physics_text(scene.physics);
}

}  // namespace menger::voxel
