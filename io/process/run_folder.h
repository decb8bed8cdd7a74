#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/run_status.h"

namespace menger::io {

/// Refuses a folder with results of another program: names such as result.toml would be replaced, others would stay, and both
/// would pass for one result.
/// @throws InputError "walker: holds results of menger simulate: choose another folder with -o" if the manifest there is
/// another's
void refuse_results_of_another(const std::filesystem::path& folder, const std::string& program);

/// The folder that a program writes the results of a run into.
///
/// A run begins by removing what an earlier one left there, so that no file of the earlier run passes for one of this run, also
/// if this one is killed. It ends by writing its manifest. A checkpoint, from which a run goes on, is kept until the run says
/// otherwise.
class RunFolder {
 public:
  /// @param program that runs: "menger-calibrate" @throws InputError if the folder holds results of another program, so that a
  /// run finds it before it begins
  RunFolder(std::string program, std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] std::filesystem::path file(std::string_view name) const { return folder_ / name; }

  /// Whether the folder has a manifest of this program.
  [[nodiscard]] bool is_own() const;

  /// Begins the run: removes files of an earlier run, manifest.json last. @param names what this run may leave unwritten; see
  /// remove_files for patterns @throws InputError naming path and reason
  void begin(const std::vector<std::string_view>& names) const;

  /// Removes more files of an earlier run, and no others.
  void remove(const std::vector<std::string_view>& names) const;

  /// Adds the wall time of earlier calls, which this one goes on from.
  void add_seconds(double seconds) { earlier_seconds_ += seconds; }

  /// Wall time of the run: seconds since this object was made, and those of earlier calls.
  [[nodiscard]] double seconds() const;

  /// Ends the run: writes manifest.json.
  /// @param parameters everything that determined the results, including defaults, as TOML
  /// @param inputs the files that were read, with the hash of their content
  void finish(std::string parameters, std::map<std::string, std::string> inputs,
              std::optional<std::uint64_t> seed = std::nullopt) const;

 private:
  std::string program_;
  std::filesystem::path folder_;
  std::chrono::steady_clock::time_point start_;
  double earlier_seconds_ = 0.0;
};

/// Returns the exit code of a run with this status: `done` if completed, `interrupted` if stopped, otherwise `numerical`.
int exit_code_of(RunStatus status);

/// The exit code of a run in several parts: interrupted if one was stopped, done if all completed, otherwise numerical.
int exit_code_of(std::span<const RunStatus> parts);

}  // namespace menger::io
