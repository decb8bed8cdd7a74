#include "fem/space/parallel_session.h"

#include <deal.II/base/mpi.h>

#include <cstdlib>

namespace menger::fem {
namespace {

/// Starts of Open MPI that depend on nothing but this process; what the user has set stays.
void keep_the_start_to_this_process() {
  const int keep = 0;
  // hwloc looks for graphics cards on X displays, and its client ends the process when such a display, perhaps one that another
  // program opened to draw off-screen, closes meanwhile.
  setenv("HWLOC_COMPONENTS", "-gl", keep);
  // A process without mpirun starts a daemon, for spawning others: needless here, and it may fail on a busy machine.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
  // Such processes share one folder for files, which the first to end takes away from those that start meanwhile; alone they need
  // none.
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
