#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/study/study.h"
#include "io/study/study_visitor.h"

namespace menger::evolution {

/// Values that replace those of a study file, as if the file had them: to run a study at another size.
struct StudyOverrides {
  std::optional<int> generations;
  std::optional<std::vector<int>> levels;
  std::optional<double> duration_s;
  std::optional<std::uint64_t> seed;
  std::optional<io::Device> device{};
};

/// Describes the keys of a study, without its preset. With `[surrogate]`, bodies are hollow cells with calibrated parameters, and
/// their chambers must be able to follow the drive. On finite elements bodies are hollow, too, and a study can state silicone,
/// walls, chambers and pressure without parameters; the texts of such a study hold the law itself.
void describe(io::StudyVisitor& visitor, Study& study);

/// The content of a study file: a preset, and a study whose values replace those of the preset.
struct PresetStudy {
  PresetStudy();

  std::string preset = "paper";  ///< or "released-code"
  Study study;                   ///< at first that of the preset
};

/// Describes the keys of a study file, for people: `menger evolve --keys`. A reader begins with the preset that the file names.
void describe(io::StudyVisitor& visitor, PresetStudy& file);

/// Reads a study file. `preset` must be given. Every other key is an option; its value is that of the preset unless the file
/// gives one. With `outside_range = "refuse"` in `[surrogate]`, the study is refused only if every body of the search would be
/// outside the range of validity (outside_validity_of_all); otherwise bodies are checked one by one.
/// @throws io::InputError with file, key and value
Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides = {});

/// Does the same for a given amount of memory. @param memory_bytes the study is refused if one evaluation may need more
Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides, std::size_t memory_bytes);

/// Returns the files that decide a study: its own, the parameters that `[surrogate]` names, and the silicone that `[material]`
/// names.
/// @throws io::InputError if the study cannot be read
std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& file);

/// Returns the study as TOML with every value, exact and always in the same order. Equal text means equal studies, and reading
/// the text gives the same study.
std::string resolved_text(const Study& study);

/// Returns the same without what decides only when a search ends and what follows: the number of generations, the budget, and the
/// number of robots to confirm. One run can continue another exactly if these texts are equal.
std::string identity_text(const Study& study);

/// Reads the study from the text of resolved_text or of a preset. @param file for messages only @throws io::InputError as
/// read_study does
Study study_from_text(std::string_view text, const std::filesystem::path& file);

/// Reads the study of an archive, also of one with earlier names of keys, and without its table [reference], see was_corrected.
/// @throws io::InputError if this program cannot read it
Study archived_study(const RunArchive& archive);

/// Returns whether finite elements corrected the scores of the search of an archive. Its fitness is the corrected one. Earlier
/// versions had such searches: a table [reference] or [judge].
bool was_corrected(const RunArchive& archive);

/// Returns why the last periods of a study cannot be measured in its time, or an empty text.
std::string unmeasurable_periods(const Study& study);

/// Returns the text of the file of a preset, "paper" or "released-code".
std::string_view preset_text(std::string_view name);

}  // namespace menger::evolution
