#include "fem/space/parallel_session.h"
#include "io/process/program.h"
#include "tests/extremes/part.h"
#include "tests/extremes/table.h"

int main(int argc, char** argv) {
  return menger::io::run_program("menger-extremes-fem", [&] {
    const menger::fem::ParallelSession session(argc, argv);
    return menger::extremes::part_program(menger::extremes::part(), argc, argv);
  });
}
