#include "voxel/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/range.h"
#include "io/text/toml_document.h"
#include "voxel/engine/scale_check.h"
#include "voxel/scene/body_pieces.h"
#include "voxel/scene/calibrated_body_file.h"
#include "voxel/scene/physics_file.h"

namespace menger::voxel {
namespace {

meshes::Design read_inline_design(const io::TomlTable& table) {
  meshes::Design design = meshes::read_drawn_design(table);
  design.cell_edge_m = table.number("cell_edge_m", io::positive());
  if (design.body.count() == 0) throw table.error("digits", "the body is empty");
  return design;
}

/// The table of an inline design; none if the key holds a text, which names a file.
std::optional<io::TomlTable> inline_design(const io::TomlTable& table) {
  try {
    return table.optional_table("design");
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

std::filesystem::path design_file(const io::TomlTable& table) {
  try {
    return table.path("design");
  } catch (const io::InputError&) {
    throw table.error("design", "must be the name of a design file or a table [design]");
  }
}

void read_scene_design(const io::TomlTable& table, LoadedScene& loaded) {
  if (const auto design = inline_design(table)) {
    loaded.scene.design = read_inline_design(*design);
    return;
  }
  loaded.files.push_back(design_file(table));
  loaded.scene.design = meshes::read_design(loaded.files.back());
}

/// The level and what messages call it.
struct GivenLevel {
  int level = 1;
  std::string name;
};

GivenLevel read_level(const io::TomlTable& table, int fallback, std::optional<int> option) {
  const io::Range range = io::within(1, largest_level);
  const int in_file = table.integer_or("level", fallback, range);
  if (!option) return {in_file, "level = " + std::to_string(in_file)};
  const std::string name = "--level " + std::to_string(*option);
  if (!range.contains(*option)) throw io::InputError(name + ": " + range.demand());
  return {*option, name};
}

std::string gibibytes(std::size_t bytes) { return io::formatted("%.3g GiB", static_cast<double>(bytes) / 1073741824.0); }

SceneOutput read_output(const io::TomlTable& table) {
  const SceneOutput defaults;
  return {.frames = table.boolean_or("frames", defaults.frames),
          .pictures = table.boolean_or("pictures", defaults.pictures),
          .records_per_frame = table.integer_or("records_per_frame", defaults.records_per_frame, io::at_least(1))};
}

/// What keeps a calibrated body from being this design, or an empty text.
std::string unusable_calibration(const Scene& scene) {
  const CalibratedBody& body = *scene.physics.surrogate;
  // Pieces are refused at level 1 only, where the design is the whole body; run_scene asks about the others once they are built.
  if (const BodyPieces pieces = body_pieces(scene.design.body, scene.physics); pieces.is_refused) return pieces.text;
  if (std::string problem = unusable_parameters(body, scene.design.cell_edge_m, &scene.design.body); !problem.empty())
    return problem;
  if (body.outside_range == OutsideRange::refuse) {
    const std::vector<std::string> faults = outside_validity(body, scene.design.body);
    if (!faults.empty()) return faults.front();
  }
  return "";
}

}  // namespace

LoadedScene read_scene(const std::filesystem::path& file, std::optional<int> level, std::size_t memory_bytes) {
  const io::TomlTable table = io::read_toml(file);
  LoadedScene loaded{.scene = {}, .files = {file}};
  Scene& scene = loaded.scene;
  read_scene_design(table, loaded);
  const GivenLevel given = read_level(table, scene.level, level);
  scene.level = given.level;
  scene.physics = read_physics(table);
  if (const auto parameters = parameters_file(table)) loaded.files.push_back(*parameters);
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

  if (scene.physics.surrogate) {
    scene.physics.surrogate->level = scene.level;
    if (const std::string problem = unusable_calibration(scene); !problem.empty())
      throw io::InputError(file.string() + ": surrogate: " + problem);
  }
  if (const std::string problem = unusable_scales(scene.physics, scene.design.cell_edge_m, scene.duration_s); !problem.empty()) {
    throw io::InputError(file.string() + ": " + problem);
  }
  if (const std::size_t needed = estimated_memory_bytes(scene.design.body, scene.level, voxels_per_cell(scene.physics));
      needed > memory_bytes) {
    throw io::InputError(file.string() + ": " + given.name + ": the simulation would need about " + gibibytes(needed) +
                         " of memory, this machine has " + gibibytes(memory_bytes));
  }
  return loaded;
}

}  // namespace menger::voxel
