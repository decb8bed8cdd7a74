#include "tests/fuzz/readers.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "evolution/archive/run_archive.h"
#include "evolution/loop/loop_state.h"
#include "evolution/outputs/command_outputs.h"
#include "evolution/page/body_frames.h"
#include "evolution/reevaluation/search_comparison.h"
#include "evolution/reference/reevaluation_study.h"
#include "evolution/study/study_file.h"
#include "evolution/trade_off/trade_off_study.h"
#include "fem/inflation/inflation_study_file.h"
#include "fem/load_cases/load_case_study_file.h"
#include "fem/locomotion/locomotion_checkpoint.h"
#include "fem/locomotion/locomotion_study_file.h"
#include "fem/pneumatics/pressure_schedule_file.h"
#include "fem/stall_map/stall_map_file.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/manifest.h"
#include "io/text/printable.h"
#include "io/text/whole_file.h"
#include "materials/fit/tensile_test.h"
#include "materials/laws/silicone_record.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/files/gmsh_mesh.h"
#include "meshes/files/vtu_mesh.h"
#include "meshes/load_cases/response_curve.h"
#include "meshes/robot/robot_file.h"
#include "voxel/calibration/calibration_frequency.h"
#include "voxel/calibration/calibration_study.h"
#include "voxel/model/expected_errors.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/picture/vtk_output.h"
#include "voxel/scene/scene_file.h"
#include "voxel/validation/validation_study.h"

namespace menger::tests {
namespace {

namespace fs = std::filesystem;

/// Plain writing, since io::write_whole waits for the disk.
void put(const fs::path& file, std::string_view content) {
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

template <class Value>
void drop(const Value& /*what was read*/) {}

/// A study of re-evaluation is read for a search: that of the sources whose robots are of silicone.
void read_reevaluation(const fs::path& file) {
  static const evolution::Study search = evolution::read_study(fs::path(MENGER_SOURCE_DIR) / "paper/silicone/study.toml");
  drop(evolution::read_reevaluation_study({.archive = "run.sqlite", .file = file}, search));
}

/// The table of a response curve is read only with the provenance that was written for it.
void read_curve_table(const fs::path& file) {
  static const std::string provenance = io::read_whole(fs::path(MENGER_SOURCE_DIR) / "tests/fuzz/seeds/curve/stretch.toml");
  constexpr std::string_view key = "table_hash = \"";
  const std::size_t at = provenance.find(key) + key.size();
  fs::path beside = file;
  beside.replace_extension(".toml");
  put(beside, std::string(provenance).replace(at, 64, io::file_hash(file)));
  drop(meshes::read_response_curve(beside));
}

/// The provenance of a response curve, beside its table.
void read_curve_provenance(const fs::path& file) {
  static const std::string table = io::read_whole(fs::path(MENGER_SOURCE_DIR) / "tests/fuzz/seeds/curve/stretch.csv");
  put(fs::path(file).replace_extension(".csv"), table);
  drop(meshes::read_response_curve(file));
}

void read_frequencies(const fs::path& file, std::string column) {
  voxel::FrequencyReference reference;
  reference.file = file;
  reference.column = std::move(column);
  drop(voxel::read_frequency_gains(reference));
}

void read_costs(const fs::path& file) {
  put(file.parent_path() / "reevaluation.csv",
      "elements_body_lengths,surrogate_body_lengths,elements_steps,elements_count\n0.5,0.25,100,20\n");
  drop(evolution::read_compared_search(file.parent_path(), {}));
}

void read_reevaluation_table(const fs::path& file) {
  put(file.parent_path() / "costs.csv", "voxel_steps,element_steps\n1000,0\n");
  drop(evolution::read_compared_search(file.parent_path(), {}));
}

/// Reads the file as the state in a checkpoint that is otherwise whole and of the same study.
void read_checkpoint(const fs::path& file) {
  const std::string state = io::read_whole(file);
  const std::string identity = "the study";
  put(file, "menger locomotion checkpoint 8\n" + io::content_hash(identity) + io::content_hash(state) + state);
  drop(fem::read_locomotion_checkpoint(file, identity));
}

/// Reads the file as two frames of a body that moves.
void read_frame(const fs::path& file) {
  constexpr std::size_t most_bytes = 1'000'000;
  drop(evolution::read_page_body(
      {.name = "fuzzed", .frames = {{0.0, file}, {1.0, file}}, .most_bytes = most_bytes, .body = std::nullopt}));
}

void read_manifest(const fs::path& file) {
  drop(io::program_of_manifest(file));
  drop(evolution::read_command_output(file));
}

/// Reads all that an archive holds.
void read_archive(const fs::path& file) {
  const evolution::RunArchive archive = evolution::RunArchive::open_to_read(file);
  drop(archive.study());
  drop(archive.generation_goal());
  drop(archive.next_id());
  drop(archive.tried_phenotype_keys());
  drop(archive.scenarios());
  drop(archive.screened_individuals());
  drop(archive.reevaluations());
  for (const evolution::FitDesign& design : archive.fit_designs()) drop(archive.individual(design.individual));
  const evolution::EvaluationKey key_of_seed{"h", 1, "physics"};
  drop(archive.evaluation(key_of_seed));
  drop(archive.step_check(key_of_seed));
  constexpr int most_generations = 20;
  for (int number = 0; number <= std::min(archive.last_generation().value_or(-1), most_generations); ++number) {
    drop(archive.generation(number));
    drop(archive.survivors(number));
  }
}

constexpr std::array all_readers{
    FuzzedReader{"evolve", "paper/fractal/fuzzed.toml", [](const fs::path& file) { drop(evolution::read_study(file)); }},
    FuzzedReader{"simulate", "voxel/scenes/fuzzed.toml", [](const fs::path& file) { drop(voxel::read_scene(file)); }},
    FuzzedReader{"inflate", "fem/studies/fuzzed.toml", [](const fs::path& file) { drop(fem::read_inflation_study(file)); }},
    FuzzedReader{"locomote", "fem/studies/fuzzed.toml", [](const fs::path& file) { drop(fem::read_locomotion_study(file)); }},
    FuzzedReader{"stall-map", "paper/pneumatics/fuzzed.toml",
                 [](const fs::path& file) { drop(fem::read_stall_map_study(file)); }},
    FuzzedReader{"load-cases", "fem/studies/load_cases/fuzzed.toml",
                 [](const fs::path& file) { drop(fem::read_load_case_study(file)); }},
    FuzzedReader{"calibrate", "voxel/studies/fuzzed.toml",
                 [](const fs::path& file) {
                   drop(voxel::read_calibration_study(file, {fs::path(MENGER_SOURCE_DIR) / "tests/fuzz/seeds/curve"}));
                 }},
    FuzzedReader{"validate", "voxel/studies/fuzzed.toml", [](const fs::path& file) { drop(voxel::read_validation_study(file)); }},
    FuzzedReader{"reevaluate", "paper/silicone/fuzzed.toml", read_reevaluation},
    FuzzedReader{"tradeoff", "paper/trade_off/fuzzed.toml",
                 [](const fs::path& file) { drop(evolution::read_trade_study(file)); }},
    FuzzedReader{"mesh", "fem/studies/fuzzed.toml", [](const fs::path& file) { drop(meshes::read_mesh_study(file)); }},
    FuzzedReader{"robot", "robots/fuzzed.toml", [](const fs::path& file) { drop(meshes::read_robot(file)); }},
    FuzzedReader{"loop", "robots/loop.json", [](const fs::path& file) { drop(evolution::LoopState(file)); }},
    FuzzedReader{"design", "meshes/designs/fuzzed.toml", [](const fs::path& file) { drop(meshes::read_design(file)); }},
    FuzzedReader{"parameters", "voxel/parameters/fuzzed.toml", [](const fs::path& file) { drop(voxel::read_surrogate(file)); }},
    FuzzedReader{"silicone", "materials/data/fuzzed.toml", [](const fs::path& file) { drop(materials::read_silicone(file)); }},
    FuzzedReader{"curve", "curves/stretch.toml", read_curve_provenance},
    FuzzedReader{"curve-table", "curves/stretch.csv", read_curve_table},
    FuzzedReader{"tensile", "fuzzed.csv", [](const fs::path& file) { drop(materials::read_tensile_test(file)); }},
    FuzzedReader{"pressures", "fuzzed.csv", [](const fs::path& file) { drop(fem::read_pressure_table(file)); }},
    FuzzedReader{"errors", "fuzzed.errors.csv",
                 [](const fs::path& file) { drop(voxel::read_expected_errors(file.parent_path() / "fuzzed.toml")); }},
    FuzzedReader{"frequencies", "fuzzed.csv", [](const fs::path& file) { read_frequencies(file, "tip"); }},
    FuzzedReader{"costs", "search/costs.csv", read_costs},
    FuzzedReader{"reevaluation", "search/reevaluation.csv", read_reevaluation_table},
    FuzzedReader{"collection", "fuzzed.pvd", [](const fs::path& file) { drop(voxel::read_collection(file)); }},
    FuzzedReader{"manifest", "manifest.json", read_manifest},
    FuzzedReader{"vtu", "fuzzed.vtu", [](const fs::path& file) { drop(meshes::read_vtu_mesh(file)); }},
    FuzzedReader{"msh", "fuzzed.msh", [](const fs::path& file) { drop(meshes::read_gmsh_mesh(file)); }},
    FuzzedReader{"frame", "fuzzed.vtu", read_frame},
    FuzzedReader{"checkpoint", "checkpoint.bin", read_checkpoint},
    FuzzedReader{"archive", "fuzzed.sqlite", read_archive}};

}  // namespace

std::span<const FuzzedReader> fuzzed_readers() { return all_readers; }

const FuzzedReader* fuzzed_reader(std::string_view name) {
  const auto* const found = std::ranges::find(all_readers, name, &FuzzedReader::name);
  return found == all_readers.end() ? nullptr : found;
}

fs::path fuzzed_place(const FuzzedReader& reader, const fs::path& root) {
  fs::path there = root;
  fs::path here = MENGER_SOURCE_DIR;
  for (const fs::path& part : fs::path(reader.file)) {
    if (fs::is_directory(here)) {
      for (const fs::directory_entry& entry : fs::directory_iterator(here)) {
        const fs::path name = entry.path().filename();
        if (name != part && name.string().front() != '.' && name != "build") fs::create_symlink(entry.path(), there / name);
      }
    }
    here /= part;
    there /= part;
    if (there != root / reader.file) fs::create_directories(there);
  }
  return there;
}

std::string read_fuzzed(const FuzzedReader& reader, const fs::path& root, const fs::path& file, std::string_view content) {
  put(file, content);
  try {
    reader.read(file);
    return {};
  } catch (const io::InputError& error) {
    std::string message = error.what();
    const bool names_named_file = message.starts_with('/');  // one that the file names, by an absolute path
    const bool names_file = names_named_file || message.find(root.string()) != std::string::npos ||
                            message.find(MENGER_SOURCE_DIR) != std::string::npos;
    if (!names_file) throw std::runtime_error("a message without a file: " + message);
    if (io::printable(message) != message) throw std::runtime_error("a message with control characters: " + message);
    return message;
  }
}

}  // namespace menger::tests
