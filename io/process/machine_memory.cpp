#include "io/process/machine_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace menger::io {
namespace {

namespace fs = std::filesystem;

/// Lowers the memory to the limit in a file of a control group. "max" is no number.
void limit_by_file(const fs::path& file, double& bytes) {
  double limit = 0.0;
  if (std::ifstream(file) >> limit && limit > 0.0) bytes = std::min(bytes, limit);
}

/// Lowers the memory to the limits of the control group of this process and of all groups around it. In a container the group of
/// the process is the root of what it sees.
void limit_by_groups(double& bytes) {
  const fs::path root = "/sys/fs/cgroup";
  limit_by_file(root / "memory.max", bytes);
  limit_by_file(root / "memory/memory.limit_in_bytes", bytes);
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const bool is_unified = line.starts_with("0::/");
    const auto memory = line.find(":memory:/");
    if (!is_unified && memory == std::string::npos) continue;
    const fs::path top = is_unified ? root : root / "memory";
    fs::path group = line.substr(is_unified ? 4 : memory + 9);
    for (; !group.empty(); group = group.parent_path())
      limit_by_file(top / group / (is_unified ? "memory.max" : "memory.limit_in_bytes"), bytes);
  }
}

void limit_by_process(double& bytes) {
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
}

}  // namespace

double machine_memory_bytes() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  limit_by_groups(bytes);
  limit_by_process(bytes);
  return bytes;
}

}  // namespace menger::io
