#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace menger::evolution {

/// Folder in the results of a loop to which results of another study make way.
inline constexpr std::string_view set_aside_folder = "earlier";

/// What a loop says came out, as it leaves it for the report in loop_verdict.json.
struct LoopVerdict {
  std::vector<std::string> lines{};              ///< sentences for people
  std::vector<std::string> forecast{};           ///< law, expected error and warnings, as they are known after the stages
  std::map<std::string, std::string> results{};  ///< io::hash_of_results by manifest, from the folder
  /// Likewise those of an earlier robot, which stages of this loop have left in their folders.
  std::map<std::string, std::string> left_behind{};
  std::optional<double> softest_limit_Pa{};  ///< at which the body balloons by the softest law of its silicone, if that is softer

  /// The folders of the results that the sentences are about and that have changed since, such as "simulate"; none: it is
  /// current.
  [[nodiscard]] std::vector<std::string> changed(const std::filesystem::path& results_folder) const;
};

/// Writes it into the folder of the results. @throws io::InputError if it cannot be written
void write_loop_verdict(const std::filesystem::path& results, const LoopVerdict& verdict);

/// Reads it. @return nothing if the folder has none @throws io::InputError naming the file if it cannot be read
std::optional<LoopVerdict> read_loop_verdict(const std::filesystem::path& results);

/// The name of its file in the folder of the results.
inline constexpr const char* loop_verdict_name = "loop_verdict.json";

/// The name of the file of a loop's state (LoopState), by which the folder of its results is known.
inline constexpr const char* loop_state_name = "loop.json";

}  // namespace menger::evolution
