#pragma once

#include <functional>
#include <string_view>

namespace menger::fem {

/// Runs the body of a program that mpirun may have started several times, within a ParallelSession: as io::run_program does, but
/// that the first rank alone speaks, and that the others end, too, when one fails by itself.
/// @param body is told its rank and the number of ranks @return the exit code
int run_parallel_program(std::string_view name, const std::function<int(int rank, int rank_count)>& body);

}  // namespace menger::fem
