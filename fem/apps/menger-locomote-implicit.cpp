// The program that replaces menger-locomote for studies of implicit dynamics.
#include <filesystem>

#include "fem/implicit_locomotion/implicit_locomotion.h"
#include "fem/locomotion/locomotion_program.h"
#include "fem/space/parallel_program.h"
#include "fem/space/parallel_session.h"
#include "fem/space/rank_agreement.h"
#include "io/process/interrupt.h"
#include "io/text/input_error.h"

int main(int argc, char** argv) {
  using namespace menger;
  io::hold_interrupts();
  const fem::ParallelSession session(argc, argv);
  const auto refuse = [](const std::filesystem::path& study) -> int {
    throw io::InputError(study.string() + ": dynamics.method is not \"implicit\": run menger-locomote");
  };
  return fem::run_parallel_program("menger-locomote", [&](int rank, int rank_count) {
    fem::LocomotionMethod method{.is_implicit = true, .make = fem::make_implicit_locomotion, .pass_on = refuse};
    method.process_count = rank_count;
    method.on_every_process = [](const auto& action) { fem::on_every_rank(MPI_COMM_WORLD, action); };
    if (rank > 0)
      method.help = [](const fem::LocomotionStudy& study) { fem::help_implicit_locomotion(study, &io::interrupted()); };
    try {
      return fem::locomotion_program(argc, argv, method);
    } catch (const io::InputError& error) {
      // Either all processes have thrown this error, or only the first one. In the second case its body is destroyed, which ended
      // the other processes.
      throw fem::AgreedInputError(error.what());
    }
  });
}
