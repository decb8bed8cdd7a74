#include "voxel/scene/scene_file.h"

#include <algorithm>
#include <string>

#include "io/study/study_reader.h"
#include "io/study/study_text.h"
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

/// Describes the keys of the design. @param design_file set to the file that is named, when reading
void describe_body(io::StudyVisitor& visitor, Scene& scene, std::optional<std::filesystem::path>& design_file) {
  visitor.table({.name = "design", .help = "The body.", .earlier_text = "design.file"}, [&] {
    meshes::describe_design(visitor, scene.design, design_file);
    visitor.integer({.name = "level",
                     .help = "Level of the fractal: 1 is the design itself, at 2 each cell is a copy of the design.",
                     .earlier = "/level"},
                    scene.level, io::within(1, largest_level));
  });
}

void describe_time(io::StudyVisitor& visitor, Scene& scene) {
  visitor.number({.name = "duration_s", .help = "Time that is simulated.", .earlier = "/duration_s"}, scene.duration_s,
                 io::positive());
  scene.record_interval_s = std::min(scene.record_interval_s, scene.duration_s);
  visitor.number(
      {.name = "record_interval_s",
       .help = "Time between records, at most the duration. A record is taken at the first step at or after each multiple of it.",
       .earlier = "/record_interval_s"},
      scene.record_interval_s, io::positive());
  visitor.check(scene.record_interval_s <= scene.duration_s, "record_interval_s", "must be at most duration_s");
  if (const io::TomlTable* table = visitor.source()) {
    visitor.check(scene.duration_s / scene.record_interval_s <= largest_record_count,
                  table->has("record_interval_s") ? "record_interval_s" : "duration_s", "makes more than a million records");
  }
}

void describe_output(io::StudyVisitor& visitor, Scene& scene) {
  visitor.boolean({"frames", "Whether frames of the body are written for ParaView."}, scene.output.frames);
  visitor.boolean({"pictures", "Whether pictures are made."}, scene.output.pictures);
  visitor.integer({"records_per_frame", "Number of records per frame."}, scene.output.records_per_frame, io::at_least(1));
}

void describe_scene(io::StudyVisitor& visitor, Scene& scene, std::optional<std::filesystem::path>& design_file) {
  describe_body(visitor, scene, design_file);
  visitor.table({"time", "Simulated time, and time between records."}, [&] { describe_time(visitor, scene); });
  visitor.table({"output", "Files that are written in addition to the trajectory."}, [&] { describe_output(visitor, scene); });
  visitor.boolean({"energy_ledger", "Whether the energy balance is computed (slow)."}, scene.energy_ledger);
  describe(visitor, scene.physics);
  visitor.check(!scene.energy_ledger || scene.physics.integration.number != NumberType::float32, "energy_ledger",
                "needs number = \"float64\"");
}

/// The level and its name in messages.
struct GivenLevel {
  int level = 1;
  std::string name;
};

GivenLevel given_level(int in_file, std::optional<int> option) {
  if (!option) return {in_file, "design.level = " + std::to_string(in_file)};
  const io::Range range = io::within(1, largest_level);
  const std::string name = "--level " + std::to_string(*option);
  if (!range.contains(*option)) throw io::InputError(name + ": " + range.demand());
  return {*option, name};
}

std::string gibibytes(std::size_t bytes) { return io::formatted("%.3g GiB", static_cast<double>(bytes) / 1073741824.0); }

/// Why a calibrated body cannot have this design; empty if it can.
std::string unusable_calibration(const Scene& scene) {
  const CalibratedBody& body = *scene.physics.surrogate;
  // Pieces are refused only at level 1, where the design is the whole body. run_scene checks other levels once they are built.
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

void describe(io::StudyVisitor& visitor, Scene& scene) {
  std::optional<std::filesystem::path> design_file;
  describe_scene(visitor, scene, design_file);
}

std::string scene_text(const Scene& scene) { return io::described_text(scene); }

LoadedScene read_scene(const std::filesystem::path& file, std::optional<int> level, std::size_t memory_bytes) {
  const io::TomlTable table = io::read_toml(file);
  LoadedScene loaded{.scene = {}, .files = {file}};
  Scene& scene = loaded.scene;
  std::optional<std::filesystem::path> design_file;
  io::refuse_earlier_names(table, [](io::StudyVisitor& visitor) {
    Scene usual;
    describe(visitor, usual);
  });
  io::StudyReader reader(table);
  describe_scene(reader, scene, design_file);
  table.finish();
  check_friction(table, scene.physics);
  if (design_file) loaded.files.push_back(*design_file);
  if (const auto parameters = parameters_file(table)) loaded.files.push_back(*parameters);
  const GivenLevel given = given_level(scene.level, level);
  scene.level = given.level;

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
                         " of memory, but this machine has " + gibibytes(memory_bytes));
  }
  return loaded;
}

}  // namespace menger::voxel
