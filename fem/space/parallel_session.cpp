#include "fem/space/parallel_session.h"

#include <deal.II/base/mpi.h>

#include <cstdlib>

namespace menger::fem {
namespace {

/// Sets Open MPI up so that its start depends only on this process. What the user has set stays.
void keep_the_start_to_this_process() {
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

}  // namespace

struct ParallelSession::Libraries {
  Libraries(int& argc, char**& argv) : session(argc, argv, 1) {}
  dealii::Utilities::MPI::MPI_InitFinalize session;
};

ParallelSession::ParallelSession(int& argc, char**& argv) {
  keep_the_start_to_this_process();
  libraries_ = std::make_unique<Libraries>(argc, argv);
}

ParallelSession::~ParallelSession() = default;

}  // namespace menger::fem
