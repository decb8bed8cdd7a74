// `menger locomote study.toml`. Studies of implicit dynamics run in a program of their own, whose libraries take long to load.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "fem/locomotion/locomotion_program.h"
#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/study/installed_folders.h"
#include "io/text/input_error.h"

namespace {

/// Returns the number of processes, from the environment that Open MPI's mpirun sets: this program does not use MPI.
int processes_started_together() {
  const char* count = std::getenv("OMPI_COMM_WORLD_SIZE");
  return count == nullptr ? 1 : std::max(1, std::atoi(count));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace menger;
  const auto become_implicit = [&](const std::filesystem::path& study) -> int {
    const std::filesystem::path program = io::program_in(io::own_program_folder(), "menger-locomote-implicit");
    io::hold_interrupts();
    if (io::interrupted()) return io::exit_code::interrupted;
    ::execv(program.c_str(), argv);
    throw io::InputError(study.string() + ": " + program.string() +
                         " cannot be started: " + std::generic_category().message(errno));
  };
  return io::run_program("menger-locomote", [&] {
    fem::LocomotionMethod method{.is_implicit = false, .make = fem::explicit_walk_dynamics, .pass_on = become_implicit};
    method.process_count = processes_started_together();
    return fem::locomotion_program(argc, argv, method);
  });
}
