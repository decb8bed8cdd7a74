#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace menger::io {

/// A program to run as a child process, with its limits.
struct ChildProgram {
  std::filesystem::path program;
  std::vector<std::string> arguments{};
  std::filesystem::path folder{};                                 ///< its working folder, which exists
  std::filesystem::path out{};                                    ///< file for its standard output; overwritten
  std::filesystem::path err{};                                    ///< file for its standard error; overwritten; may be `out`
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< wall time after which it is told to end
  double patience_s = 20.0;                                       ///< wall time between the request to end (SIGINT) and SIGKILL
  const std::atomic<bool>* stop = nullptr;                        ///< once this is true, the child is told to end
  std::function<void(double seconds)> waiting{};  ///< called about ten times a second with the wall time since the start
};

/// Why a child process ended.
enum class ChildEnd {
  exited,     ///< it ended by itself, with an exit code
  signalled,  ///< a signal ended it that this program did not send
  timed_out,  ///< it exceeded its time limit, and gave no result (exit code done or numerical) when it was asked to end
  stopped     ///< the user asked to stop
};

/// How a child process ended and the resources that it used, including all processes that it waited for.
struct ChildOutcome {
  ChildEnd end = ChildEnd::exited;
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;      ///< the signal that ended it; 0 if it exited
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< user and system time

  /// Largest resident memory. It is never less than the memory that this program used when it started the child: the kernel also
  /// counts the copy of this program that becomes the child.
  std::uint64_t peak_memory_bytes = 0;
};

/// Runs a program until it ends.
///
/// The program has no standard input and a process group of its own. Ctrl-C at the terminal reaches only this program, which
/// passes it on once. The child is killed if this program dies.
/// @throws InputError naming the program or file if it cannot be started
ChildOutcome run_child(const ChildProgram& child);

/// Returns the path of a program in a folder. @throws InputError if there is no executable file of this name
std::filesystem::path program_in(const std::filesystem::path& folder, const std::string& name);

}  // namespace menger::io
