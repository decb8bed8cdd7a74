#include "io/process/machine_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace menger::io {
namespace {

// A container may have less than its machine.
TEST(MachineMemory, IsAtMostWhatIsBuiltIn) {
  std::ifstream file("/proc/meminfo");
  std::string name;
  double total_kB = 0.0;
  ASSERT_TRUE(file >> name >> total_kB);
  ASSERT_EQ(name, "MemTotal:");
  EXPECT_LE(machine_memory_bytes(), 1.001 * 1024.0 * total_kB);
  EXPECT_GE(machine_memory_bytes(), 1e8);
}

TEST(MachineMemory, DoesNotChangeWithItsUse) {
  const double before = machine_memory_bytes();
  const std::string used(100'000'000, 'x');
  EXPECT_EQ(machine_memory_bytes(), before) << used.back();
}

TEST(MachineMemory, IsAtMostTheLimitOfTheProcess) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer takes terabytes of memory that it does not use";
#endif
  constexpr rlim_t bytes = 3'000'000'000;
  const auto limited = [] {
    const rlimit limit{.rlim_cur = bytes, .rlim_max = bytes};
    setrlimit(RLIMIT_DATA, &limit);
    std::_Exit(machine_memory_bytes() <= static_cast<double>(bytes) ? 0 : 1);
  };
  EXPECT_EXIT(limited(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace menger::io
