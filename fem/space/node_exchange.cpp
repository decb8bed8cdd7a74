#include "fem/space/node_exchange.h"

#include <algorithm>

namespace menger::fem {

NodeExchange::NodeExchange(const Space& space) {
  int ranks = 1;
  MPI_Comm_size(space.communicator, &ranks);
  alone_ = ranks == 1;
  if (alone_) return;
  petsc(VecCreateGhostBlock(space.communicator, 3, 3 * space.owned_count, PETSC_DETERMINE,
                            static_cast<PetscInt>(space.ghosts.size()), space.ghosts.data(), ghosted_.receive()));
}

void NodeExchange::update_ghosts(std::span<double> values) const {
  if (alone_) return;
  copy_in(values);
  petsc(VecGhostUpdateBegin(ghosted_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecGhostUpdateEnd(ghosted_, INSERT_VALUES, SCATTER_FORWARD));
  copy_out(values);
}

void NodeExchange::add_from_ghosts(std::span<double> values) const {
  if (alone_) return;
  copy_in(values);
  petsc(VecGhostUpdateBegin(ghosted_, ADD_VALUES, SCATTER_REVERSE));
  petsc(VecGhostUpdateEnd(ghosted_, ADD_VALUES, SCATTER_REVERSE));
  copy_out(values);
}

void NodeExchange::copy_in(std::span<const double> values) const {
  Vec local = nullptr;
  petsc(VecGhostGetLocalForm(ghosted_, &local));
  double* data = nullptr;
  petsc(VecGetArrayWrite(local, &data));
  std::copy(values.begin(), values.end(), data);
  petsc(VecRestoreArrayWrite(local, &data));
  petsc(VecGhostRestoreLocalForm(ghosted_, &local));
}

void NodeExchange::copy_out(std::span<double> values) const {
  Vec local = nullptr;
  petsc(VecGhostGetLocalForm(ghosted_, &local));
  const double* data = nullptr;
  petsc(VecGetArrayRead(local, &data));
  std::copy(data, data + values.size(), values.begin());
  petsc(VecRestoreArrayRead(local, &data));
  petsc(VecGhostRestoreLocalForm(ghosted_, &local));
}

}  // namespace menger::fem
