#include "io/ranks/mpi_start.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace menger::io {
namespace {

/// An environment without anything of MPI; a process ends with its environment, so nothing is put back.
class MpiStart : public testing::Test {
 protected:
  MpiStart() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) unsetenv(name);
  }
  ~MpiStart() override {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) unsetenv(name);
  }
};

TEST_F(MpiStart, IsNoneForAProcessThatIsStartedByItself) {
  EXPECT_FALSE(is_started_as_rank());
  // In a batch script of Slurm, which is one process.
  setenv("SLURM_NTASKS", "16", 1);
  setenv("SLURM_PROCID", "0", 1);
  EXPECT_FALSE(is_started_as_rank());
  setenv("SLURM_STEP_NUM_TASKS", "1", 1);
  EXPECT_FALSE(is_started_as_rank());
}

TEST_F(MpiStart, IsToldByWhateverStartsRanks) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"}) {
    setenv(name, "0", 1);
    EXPECT_TRUE(is_started_as_rank()) << name;
    unsetenv(name);
  }
  setenv("SLURM_STEP_NUM_TASKS", "2", 1);
  EXPECT_TRUE(is_started_as_rank());
}

}  // namespace
}  // namespace menger::io
