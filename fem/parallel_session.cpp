#include "fem/parallel_session.h"

#include <deal.II/base/mpi.h>

namespace menger::fem {

struct ParallelSession::Libraries {
  Libraries(int& argc, char**& argv) : session(argc, argv, 1) {}
  dealii::Utilities::MPI::MPI_InitFinalize session;
};

ParallelSession::ParallelSession(int& argc, char**& argv) : libraries_(std::make_unique<Libraries>(argc, argv)) {}

ParallelSession::~ParallelSession() = default;

}  // namespace menger::fem
