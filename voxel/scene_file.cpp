#include "voxel/scene_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "io/input_error.h"
#include "io/range.h"
#include "io/toml_document.h"
#include "voxel/physics_file.h"

namespace menger::voxel {
namespace {

meshes::Design read_inline_design(const io::TomlTable& table) {
  meshes::Design design;
  design.name = table.text_or("name", "robot");
  design.cell_edge_m = table.number("cell_edge_m", io::positive());
  std::array<int, 3> cells{3, 3, 3};
  if (table.has("cells")) {
    const auto sizes = table.numbers("cells", io::within(1, 1000));
    if (sizes.size() != 3) throw table.error("cells", "must be three integers, not " + std::to_string(sizes.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (sizes[axis] != std::floor(sizes[axis])) throw table.error("cells", "must be an integer", std::array{axis});
      cells[axis] = static_cast<int>(sizes[axis]);
    }
  }
  const std::string digits = table.text("digits");
  try {
    design.body = meshes::Polycube::from_digits(cells[0], cells[1], cells[2], digits);
  } catch (const std::invalid_argument& fault) {
    throw table.error("digits", fault.what());
  }
  if (design.body.count() == 0) throw table.error("digits", "the body is empty");
  return design;
}

meshes::Design read_scene_design(const io::TomlTable& table) {
  // A text names a file; anything else must be the table itself.
  std::optional<std::filesystem::path> file;
  try {
    file = table.path("design");
  } catch (const io::InputError&) {
    return read_inline_design(table.table("design"));
  }
  return meshes::read_design(*file);
}

std::string gibibytes(std::size_t bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g GiB", static_cast<double>(bytes) / 1073741824.0);
  return text.data();
}

SceneOutput read_output(const io::TomlTable& table) {
  const SceneOutput defaults;
  return {.frames = table.boolean_or("frames", defaults.frames),
          .pictures = table.boolean_or("pictures", defaults.pictures),
          .records_per_frame = table.integer_or("records_per_frame", defaults.records_per_frame, io::at_least(1))};
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, std::optional<int> level, std::size_t memory_bytes) {
  const io::TomlTable table = io::read_toml(file);
  Scene scene;
  scene.design = read_scene_design(table);
  scene.level = table.integer_or("level", scene.level, io::at_least(1));
  if (level) {
    if (*level < 1) throw io::InputError("level = " + std::to_string(*level) + ": must be >= 1");
    scene.level = *level;
  }
  scene.physics = read_physics(table);
  scene.duration_s = table.number_or("duration_s", scene.duration_s, io::positive());
  scene.record_interval_s = table.number_or("record_interval_s", std::min(scene.record_interval_s, scene.duration_s),
                                            {.lowest = 0.0, .highest = scene.duration_s, .lowest_excluded = true});
  if (scene.duration_s / scene.record_interval_s > largest_record_count) {
    throw table.error(table.has("record_interval_s") ? "record_interval_s" : "duration_s", "makes more than a million records");
  }
  scene.energy_ledger = table.boolean_or("energy_ledger", scene.energy_ledger);
  if (scene.energy_ledger && scene.physics.integration.number == NumberType::float32) {
    throw table.error("energy_ledger", "needs number = \"float64\"");
  }
  if (const auto output = table.optional_table("output")) scene.output = read_output(*output);
  table.finish();

  if (const std::size_t needed = estimated_memory_bytes(scene.design.body, scene.level); needed > memory_bytes) {
    throw io::InputError(file.string() + ": level = " + std::to_string(scene.level) + ": the simulation would need about " +
                         gibibytes(needed) + " of memory, this machine has " + gibibytes(memory_bytes));
  }
  return scene;
}

}  // namespace menger::voxel
