#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/run_status.h"

namespace menger::io {

/// The folder that a run writes its results into.
///
/// A run begins by removing what an earlier one left that it may not write itself, so that no file of the earlier run passes for
/// one of this run, also if this one is killed. It ends by writing its manifest.
class RunFolder {
 public:
  /// @param program that runs: "menger-calibrate"
  RunFolder(std::string program, std::filesystem::path folder)
      : program_(std::move(program)), folder_(std::move(folder)), start_(std::chrono::steady_clock::now()) {}

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  /// Removes files of an earlier run, and no others; see remove_files. @throws InputError naming path and reason
  void remove(const std::vector<std::string_view>& names) const;

  /// Seconds since this object was made.
  [[nodiscard]] double seconds() const;

  /// Ends the run: writes manifest.json. @param parameters everything that decided the results, defaults included, as TOML
  /// @param inputs files that were read, with the hash of their content
  void finish(std::string parameters, std::map<std::string, std::string> inputs,
              std::optional<std::uint64_t> seed = std::nullopt) const;

 private:
  std::string program_;
  std::filesystem::path folder_;
  std::chrono::steady_clock::time_point start_;
};

/// The exit code of a run with this status: done, interrupted if it was stopped, numerical for every other end.
int exit_code_of(RunStatus status);

}  // namespace menger::io
