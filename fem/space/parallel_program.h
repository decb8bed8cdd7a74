#pragma once

#include <functional>
#include <string_view>

namespace menger::fem {

/// Runs the body of a program that mpirun may have started several times, within a ParallelSession. It works as io::run_program,
/// with two differences: only the first rank prints, and if one rank fails by itself, the others end, too.
/// @param body called with its rank and the number of ranks @return the exit code
int run_parallel_program(std::string_view name, const std::function<int(int rank, int rank_count)>& body);

}  // namespace menger::fem
