// `menger locomote study.toml`. Studies of implicit dynamics go to a program of their own, whose libraries take long to load.
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "fem/locomotion_program.h"
#include "io/child_program.h"
#include "io/input_error.h"
#include "io/program.h"

int main(int argc, char** argv) {
  using namespace menger;
  const auto become_implicit = [&](const std::filesystem::path& study) -> int {
    const std::filesystem::path program = io::program_in(io::own_program_folder(), "menger-locomote-implicit");
    ::execv(program.c_str(), argv);
    throw io::InputError(study.string() + ": " + program.string() +
                         " cannot be started: " + std::generic_category().message(errno));
  };
  return io::run_program("menger-locomote", [&] {
    return fem::locomotion_program(argc, argv,
                                   {.is_implicit = false, .make = fem::make_explicit_locomotion, .pass_on = become_implicit});
  });
}
