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

/// Values that take the place of a study file's, as if they stood there: to run a study at another size.
struct StudyOverrides {
  std::optional<int> generations;
  std::optional<std::vector<int>> levels;
  std::optional<double> duration_s;
  std::optional<std::uint64_t> seed;
};

/// The keys of a study, without its preset. With `[surrogate]` bodies are hollow cells with calibrated parameters, whose chambers
/// must be able to follow the drive. Texts name the judge by the hash of its protocol, if it is known, and else by its study.
void describe(io::StudyVisitor& visitor, Study& study);

/// What a study file holds: a preset, and a study over it.
struct PresetStudy {
  PresetStudy();

  std::string preset = "paper";  ///< or "released-code"
  Study study;                   ///< that of the preset at first
};

/// The keys of a study file, for people: `menger evolve --keys`. A reader begins with the preset that is named.
void describe(io::StudyVisitor& visitor, PresetStudy& file);

/// Reads a study file. `preset` must be given; every other key is one option, whose value is the preset's unless the study gives
/// its own. With `outside_range = "refuse"` beside a `[surrogate]` only what no body of the search could be inside of is wrong
/// input (outside_validity_of_all), bodies are judged one by one.
///
/// @param memory_bytes a study with one evaluation that may need more is refused
/// @throws io::InputError with file, key and value
Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides = {});
Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides, std::size_t memory_bytes);

/// The files that decide a study: its own, and those that `[surrogate]` takes its parameters from and `[judge]` its study, if it
/// names them.
/// @throws io::InputError if the study cannot be read
std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& file);

/// The study as TOML with every value spelled out, always in the same order and exact: equal text means equal studies, and
/// reading it gives the study back, but for judge_file. Precondition: search.judging names its protocol, if there is one.
std::string resolved_text(const Study& study);

/// The same without the number of generations: what two runs must share so that one can continue the other.
std::string identity_text(const Study& study);

/// The study that resolved_text wrote, or a preset. @param file for messages only @throws io::InputError as read_study does
Study study_from_text(std::string_view text, const std::filesystem::path& file);

/// The study of an archive, also of one from before keys had their present names. @throws io::InputError if the archive holds
/// none that this menger understands
Study archived_study(const RunArchive& archive);

/// The text of a preset's file, "paper" or "released-code".
std::string_view preset_text(std::string_view name);

}  // namespace menger::evolution
