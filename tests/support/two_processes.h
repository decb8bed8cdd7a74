#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program_run.h"

namespace menger::test_support {

/// Starts a program as two processes of Open MPI. mpirun passes Ctrl-C on after five seconds, and kills processes that have not
/// ended five seconds later. Its default is one second each, which is too short on a busy machine.
inline ProgramRun start_two_processes(const std::filesystem::path& folder, const std::string& program,
                                      std::vector<std::string> arguments) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_odls_base_sigkill_timeout", "5", 1);
  arguments.insert(arguments.begin(), {"mpirun", "--oversubscribe", "-n", "2", program});
  return {folder, "/usr/bin/env", std::move(arguments)};
}

}  // namespace menger::test_support
