#include "io/ranks/mpi_start.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

bool is_started_as_rank() {
  constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"};
  if (std::ranges::any_of(names, [](const char* name) { return std::getenv(name) != nullptr; })) return true;
  // A batch script has no number of tasks of a step.
  const char* const tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  return tasks != nullptr && std::atoi(tasks) > 1;
}

void forget_mpi_start() {
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const bool is_of_start =
        text.starts_with("OMPI_") || text.starts_with("PMIX_") || text.starts_with("PMI_") || text.starts_with("SLURM_STEP");
    if (is_of_start) names.emplace_back(text.substr(0, text.find('=')));
  }
  for (const std::string& name : names) unsetenv(name.c_str());
}

void keep_mpi_start_to_this_process() {
  const int keep = 0;
  // hwloc looks for graphics cards on X displays. Its X client ends the process if such a display closes meanwhile, for example
  // one that another program opened to draw off-screen.
  setenv("HWLOC_COMPONENTS", "-gl", keep);
  // A process without mpirun starts a daemon to spawn others. It is not needed here, and its start may fail on a busy machine.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
  // Processes without mpirun share one folder for files. The first one to end removes it while others start. A single process
  // needs no such folder.
  const bool is_under_mpirun = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
  if (!is_under_mpirun) setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
}

}  // namespace menger::io
