#pragma once

namespace menger::io {

/// Returns whether a program that starts ranks of MPI, such as mpirun or srun, started this process. It is told by the
/// environment alone: Open MPI, PMIx and PMI tell each process its rank there, and srun how many processes its step has. A
/// program that is started by itself, in a batch script of Slurm as well, is no rank.
bool is_started_as_rank();

/// Sets Open MPI up so that its start depends only on this process, before MPI is started. What the user has set stays.
void keep_mpi_start_to_this_process();

/// Removes what tells a rank that it is one from the environment, once MPI has started, for programs that the rank starts.
void forget_mpi_start();

}  // namespace menger::io
