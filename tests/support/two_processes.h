#pragma once

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program_run.h"
#include "tests/support/wait_until.h"

namespace menger::test_support {

/// Starts mpirun of Open MPI, with as many processes as its arguments say. It passes Ctrl-C on after five seconds, and kills
/// processes that have not ended five seconds later. Its default is one second each, which is too short on a busy machine; a test
/// may set it.
inline ProgramRun start_under_mpirun(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_odls_base_sigkill_timeout", "5", 0);
  arguments.insert(arguments.begin(), {"mpirun", "--oversubscribe", "--timeout", "300"});
  return {folder, "/usr/bin/env", std::move(arguments)};
}

/// Starts a program as two processes.
inline ProgramRun start_two_processes(const std::filesystem::path& folder, const std::string& program,
                                      std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"-n", "2", program});
  return start_under_mpirun(folder, std::move(arguments));
}

/// Returns the exit code of the job that mpirun ran. Where a rank does not answer, the first one ends the job by MPI_Abort, of
/// which mpirun says with which code. In its own end, after that, mpirun of Debian 12 (Open MPI 4.1.4 with PMIx 4.2.2) may crash.
inline int code_of_job(const Outcome& mpirun) {
  const std::string words = "with errorcode ";
  const std::size_t code = mpirun.err.find(words);
  const bool has_crashed = mpirun.signal == SIGSEGV && mpirun.err.find("PMIx_server_finalize") != std::string::npos;
  return has_crashed && code != std::string::npos ? std::stoi(mpirun.err.substr(code + words.size())) : mpirun.code;
}

/// Returns the processes that mpirun has started on this machine, by rank.
inline std::map<int, pid_t> ranks_of(const ProgramRun& mpirun) {
  std::map<int, pid_t> ranks;
  const std::string process = std::to_string(mpirun.process());
  std::ifstream children("/proc/" + process + "/task/" + process + "/children");
  const std::string name = "OMPI_COMM_WORLD_RANK=";
  for (pid_t child = 0; children >> child;) {
    std::ifstream environment("/proc/" + std::to_string(child) + "/environ");
    for (std::string entry; std::getline(environment, entry, '\0');)
      if (entry.starts_with(name)) ranks[std::stoi(entry.substr(name.size()))] = child;
  }
  return ranks;
}

/// Waits until a process has ended, whether or not its parent has asked how. @return false if it has not
[[nodiscard]] inline bool wait_for_end(pid_t process) {
  return wait_until([&] {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string stat;
    std::getline(file, stat);
    const std::size_t name_end = stat.rfind(") ");  // the name may contain anything
    return name_end == std::string::npos || stat.at(name_end + 2) == 'Z';
  });
}

}  // namespace menger::test_support
