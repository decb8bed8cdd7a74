#include "fem/space/parallel_program.h"

#include <iostream>

#include "fem/space/rank_agreement.h"
#include "io/process/program.h"

namespace menger::fem {

int run_parallel_program(std::string_view name, const std::function<int(int rank, int rank_count)>& body) {
  int rank = 0;
  int rank_count = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
  if (rank > 0) {  // all ranks would print the same
    std::cout.setstate(std::ios::failbit);
    std::cerr.setstate(std::ios::failbit);
  }
  bool is_agreed = true;
  const int code = io::run_program(name, [&] {
    try {
      return body(rank, rank_count);
    } catch (const Agreed&) {
      throw;
    } catch (...) {
      is_agreed = false;
      std::cerr.clear();  // the first rank may not have had this error
      throw;
    }
  });
  // The other ranks would wait for this one.
  if (!is_agreed && rank_count > 1) MPI_Abort(MPI_COMM_WORLD, code);
  return code;
}

}  // namespace menger::fem
