#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "io/process/child_program.h"

namespace menger::io {

/// A run of another program in a folder of its own. The folder holds all files that the program reads.
struct ProgramJob {
  std::string name;  ///< name shown to people
  std::filesystem::path program;
  std::vector<std::string> arguments;         ///< files are given by their names in the folder
  std::map<std::string, std::string> inputs;  ///< content by file name
  double time_limit_s = 600.0;
  double estimated_s = 1.0;  ///< rough estimate of the wall time, for the progress bar

  /// Working folder of a program that resumes from the files in it. The program is then always called and the files are kept. If
  /// empty, the folder is named by job_hash and emptied before each run.
  std::filesystem::path kept_folder{};
};

/// How a job ended.
struct ProgramJobResult {
  std::filesystem::path folder;
  ChildOutcome outcome;
  double time_limit_s = 0.0;  ///< the limit of this run
  bool repeated = true;       ///< whether this call ran the job; false: an earlier call did
  std::string message;        ///< last line on standard error; empty if the program gave a result

  /// Whether the program gave a result: exit code done or numerical.
  [[nodiscard]] bool has_result() const;
  [[nodiscard]] bool is_stopped() const { return outcome.end == ChildEnd::stopped; }
  [[nodiscard]] bool is_refused() const;  ///< whether the program rejected its input (exit code 2)

  /// Returns why there is no result: time limit, stop by the user, signal, or exit code, with the message. Precondition:
  /// !has_result().
  [[nodiscard]] std::string failure() const;
};

/// Options for running jobs.
struct ProgramJobOptions {
  std::filesystem::path runs;               ///< folder with one folder per job
  const std::atomic<bool>* stop = nullptr;  ///< the job is told to end once this is true
  std::function<void(double seconds)> waiting;
};

/// Returns the name of a job's folder: the first 16 digits of the SHA-256 of program, arguments and inputs. The content of the
/// program is hashed, not its name, because another build may give another result or need another time.
std::string job_hash(const ProgramJob& job);

/// Runs a job, or returns the recorded result of an earlier call.
///
/// A job with a `kept_folder` is always run. Any other job is run unless its folder holds a result of an earlier call. A run that
/// failed or was stopped is repeated from its beginning, so that its times are those of a whole run. A run that exceeded its time
/// limit is repeated only if the limit is larger now.
/// @throws InputError if the program cannot be started or the folder cannot be written
ProgramJobResult run_job(const ProgramJob& job, const ProgramJobOptions& options);

}  // namespace menger::io
