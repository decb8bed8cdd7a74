#pragma once

#include <span>

#include "fem/space/petsc_handle.h"
#include "fem/space/space.h"

namespace menger::fem {

/// Exchanges values of nodes, three per node, between their owner and the ranks that have them as ghosts. Spans hold 3 values per
/// local node, node by node.
class NodeExchange {
 public:
  explicit NodeExchange(const Space& space);

  /// Copies owned values to the ghosts of other ranks.
  void update_ghosts(std::span<double> values) const;

  /// Adds the values of ghosts to those of their owner.
  void add_from_ghosts(std::span<double> values) const;

 private:
  void copy_in(std::span<const double> values) const;
  void copy_out(std::span<double> values) const;

  bool alone_;
  VectorHandle ghosted_;
};

}  // namespace menger::fem
