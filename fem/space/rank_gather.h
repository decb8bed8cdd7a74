#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace menger::fem {

/// The number of values that each rank gave, and where they begin in the list of all; on the first rank.
struct RankShares {
  std::vector<int> counts;
  std::vector<int> offsets;
};

/// Collects the values of all ranks on the first rank, one rank after the other. Returns them there, and nothing elsewhere.
/// Collective. @param type of a value @param own fewer than 2^31 on all ranks together
template <class Value>
std::vector<Value> gather_on_first(MPI_Comm communicator, MPI_Datatype type, const std::vector<Value>& own, RankShares& shares) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  const int count = static_cast<int>(own.size());
  shares.counts.assign(static_cast<std::size_t>(ranks), 0);
  MPI_Gather(&count, 1, MPI_INT, shares.counts.data(), 1, MPI_INT, 0, communicator);
  shares.offsets.assign(shares.counts.size(), 0);
  for (std::size_t r = 1; r < shares.counts.size(); ++r) shares.offsets[r] = shares.offsets[r - 1] + shares.counts[r - 1];
  std::vector<Value> all(static_cast<std::size_t>(shares.offsets.back() + shares.counts.back()));
  MPI_Gatherv(own.data(), count, type, all.data(), shares.counts.data(), shares.offsets.data(), type, 0, communicator);
  return all;
}

inline std::vector<double> gather_on_first(MPI_Comm communicator, const std::vector<double>& own) {
  RankShares shares;
  return gather_on_first(communicator, MPI_DOUBLE, own, shares);
}

/// Sends each rank its part of the values on the first rank; the part is as long as `own`. The reverse of gather_on_first.
/// Collective.
inline void scatter_from_first(MPI_Comm communicator, const std::vector<double>& all, std::vector<double>& own) {
  RankShares shares;
  gather_on_first(communicator, MPI_DOUBLE, own, shares);
  MPI_Scatterv(all.data(), shares.counts.data(), shares.offsets.data(), MPI_DOUBLE, own.data(), static_cast<int>(own.size()),
               MPI_DOUBLE, 0, communicator);
}

}  // namespace menger::fem
