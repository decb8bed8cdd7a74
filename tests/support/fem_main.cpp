#include <gtest/gtest.h>

#include "fem/space/parallel_session.h"

#ifdef __SANITIZE_ADDRESS__
/// MPI and PETSc do not free all their memory; other memory errors are still found.
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): the name is the sanitizer's
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
#endif

/// Runs the tests of a program that needs MPI and PETSc. Both exist as long as the program runs.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const menger::fem::ParallelSession session(argc, argv);
  return RUN_ALL_TESTS();
}
