// What menger-locomote becomes for studies of implicit dynamics.
#include <filesystem>

#include "fem/implicit_locomotion.h"
#include "fem/locomotion_program.h"
#include "fem/parallel_session.h"
#include "io/input_error.h"
#include "io/program.h"

int main(int argc, char** argv) {
  using namespace menger;
  const fem::ParallelSession session(argc, argv);
  const auto refuse = [](const std::filesystem::path& study) -> int {
    throw io::InputError(study.string() + ": dynamics.method is not \"implicit\": run menger-locomote");
  };
  return io::run_program("menger-locomote", [&] {
    return fem::locomotion_program(argc, argv, {.is_implicit = true, .make = fem::make_implicit_locomotion, .pass_on = refuse});
  });
}
