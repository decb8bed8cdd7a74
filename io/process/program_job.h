#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "io/process/child_program.h"

namespace menger::io {

/// A run of another program in a folder of its own, which holds all that it reads.
struct ProgramJob {
  std::string name;  ///< for people
  std::filesystem::path program;
  std::vector<std::string> arguments;         ///< files by their names in the folder
  std::map<std::string, std::string> inputs;  ///< content by file name
  double time_limit_s = 600.0;
  double estimated_s = 1.0;  ///< roughly, for the progress bar

  /// Where a program works that goes on by itself from what it finds there: it is always called, and what lies there is kept.
  /// Empty: a folder named by job_hash.
  std::filesystem::path kept_folder{};
};

/// How a job ended.
struct ProgramJobResult {
  std::filesystem::path folder;
  ChildOutcome outcome;
  double time_limit_s = 0.0;  ///< under which it ran
  bool repeated = true;       ///< false: an earlier call had run it
  std::string message;        ///< last line on standard error, where it gave no result

  /// Whether the program gave a result, be it that the physics ended early.
  [[nodiscard]] bool has_result() const;
  [[nodiscard]] bool is_stopped() const { return outcome.end == ChildEnd::stopped; }
  [[nodiscard]] bool is_refused() const;  ///< whether the program called its input wrong

  /// Why there is no result: its time was up, a signal, or an exit code with the message. Precondition: !has_result()
  [[nodiscard]] std::string failure() const;
};

/// What a runner of jobs may do.
struct ProgramJobOptions {
  std::filesystem::path runs;  ///< folder with a folder per job
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double seconds)> waiting;
};

/// Name of a job's folder: the start of the SHA-256 of program, arguments and inputs. The program counts by its content, since
/// another build may give another result at another speed.
std::string job_hash(const ProgramJob& job);

/// Runs a job, where it has no folder to keep unless its folder holds a result from an earlier call. A run that failed or was
/// stopped is run again, from its beginning, so that its times are those of a whole run; one whose time was up only if its limit
/// is larger now.
/// @throws InputError if the program cannot be started or the folder cannot be written
ProgramJobResult run_job(const ProgramJob& job, const ProgramJobOptions& options);

}  // namespace menger::io
