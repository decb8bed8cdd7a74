#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/study/study.h"

namespace menger::evolution {

/// Values that take the place of a study file's, as if they stood there: to run a study at another size.
struct StudyOverrides {
  std::optional<int> generations;
  std::optional<std::vector<int>> levels;
  std::optional<double> duration_s;
  std::optional<std::uint64_t> seed;
};

/// Reads a study from TOML. `preset = "paper"` or `"released-code"` must be given; every other key is one option, whose value is
/// the preset's unless the study gives its own:
///
/// - generations, seed
/// - `[population]` survivors, mutants, newcomers
/// - `[genome]` encoding ("fractal", "nonfractal", "single-actuator"), activations ("paper", "released-code"), output_function
///   ("kept", "mutable"), expression ("every-consumer", "first-consumer"), axes ("xyz", "zyx"), largest_tries
/// - `[body]` cell_edge_m, levels, smallest_body_cells, smallest_arranged_body_cells, disconnected ("reject", "penalise",
///   "allow"), castable
/// - `[evaluation]` duration_s, objective ("body-lengths", "squared-metres-per-scale"), duplicates ("archived-result", "culled"),
///   pruning, stand (bodies stand on the ground from the start), measure_from_s (displacement counts from then on)
/// - `[judge]` study (a study of re-evaluation, see read_reevaluation_study), every, designs, budget_element_steps,
///   voxel_steps_per_element_step: finite elements judge survivors and correct the fitness (see run_search); for one level only.
///   In the text of an archive the hash `protocol` stands in place of `study`
/// - `[check_dt]` every, designs: the best survivors of every so many generations are evaluated again with half the time step,
///   which changes nothing in the search (see StepChecking)
/// - `[materials]` poissons_ratio (only 0) and the tables of voxel::read_physics; with `[surrogate]` bodies are hollow cells with
///   calibrated parameters, whose chambers must be able to follow the drive; with outside_range = "refuse" only what no body of
///   the search could be inside of is wrong input (outside_validity_of_all), bodies are judged one by one
///
/// @param memory_bytes a study with one evaluation that may need more is refused
/// @throws io::InputError with file, key and value
Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides = {});
Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides, std::size_t memory_bytes);

/// The files that decide a study: its own, and those that `[surrogate]` takes its parameters from and `[judge]` its study, if it
/// names them.
/// @throws io::InputError if the study cannot be read
std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& file);

/// The study that resolved_text wrote, or a preset. @param file for messages only @throws io::InputError as read_study does
Study study_from_text(std::string_view text, const std::filesystem::path& file);

/// The study of an archive. @throws io::InputError if the archive holds none that this menger understands
Study archived_study(const RunArchive& archive);

/// The text of a preset's file, "paper" or "released-code".
std::string_view preset_text(std::string_view name);

}  // namespace menger::evolution
