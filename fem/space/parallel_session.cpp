#include "fem/space/parallel_session.h"

#include <deal.II/base/mpi.h>

#include "io/ranks/mpi_start.h"

namespace menger::fem {

struct ParallelSession::Libraries {
  Libraries(int& argc, char**& argv) : session(argc, argv, 1) {}
  dealii::Utilities::MPI::MPI_InitFinalize session;
};

ParallelSession::ParallelSession(int& argc, char**& argv) {
  io::keep_mpi_start_to_this_process();
  libraries_ = std::make_unique<Libraries>(argc, argv);
}

ParallelSession::~ParallelSession() = default;

}  // namespace menger::fem
