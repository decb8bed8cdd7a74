#include "io/process/program.h"
#include "tests/extremes/part.h"
#include "tests/extremes/table.h"

int main(int argc, char** argv) {
  return menger::io::run_program("menger-extremes-voxel",
                                 [&] { return menger::extremes::part_program(menger::extremes::part(), argc, argv); });
}
