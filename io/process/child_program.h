#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace menger::io {

/// A program to run and what it may take.
struct ChildProgram {
  std::filesystem::path program;
  std::vector<std::string> arguments{};
  std::filesystem::path folder{};                                 ///< in which it works; exists
  std::filesystem::path out{};                                    ///< file for its standard output, written over
  std::filesystem::path err{};                                    ///< file for its standard error, written over; may be `out`
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< wall time after which it is ended
  double patience_s = 20.0;                       ///< between the request to end and the end by force (SIGINT, SIGKILL)
  const std::atomic<bool>* stop = nullptr;        ///< the request to end is passed on once this is true
  std::function<void(double seconds)> waiting{};  ///< called about ten times a second with the wall time since the start
};

/// Why a child came to its end.
enum class ChildEnd {
  exited,     ///< by itself, with an exit code
  signalled,  ///< by a signal that did not come from here
  timed_out,  ///< it took longer than its limit
  stopped     ///< the user asked to stop
};

/// How a child ended and what it took, of all processes that it waited for.
struct ChildOutcome {
  ChildEnd end = ChildEnd::exited;
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;      ///< that ended it, 0 if it exited
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< user and system time

  /// Largest resident memory. Never less than what this program itself had taken when it started the child: the kernel counts the
  /// copy that becomes the child.
  std::uint64_t peak_memory_bytes = 0;
};

/// Runs a program to its end, without a standard input and in a process group of its own: Ctrl-C at the terminal reaches only
/// this program, which passes it on once. The child is killed if this program dies.
/// @throws InputError naming the program or file if it cannot be started
ChildOutcome run_child(const ChildProgram& child);

/// A program in a folder. @throws InputError if there is none of this name that may be run
std::filesystem::path program_in(const std::filesystem::path& folder, const std::string& name);

/// The folder of the running program, where the other programs of menger lie, too.
std::filesystem::path own_program_folder();

}  // namespace menger::io
