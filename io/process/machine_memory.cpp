#include "io/process/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace menger::io {

double machine_memory_bytes() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double limit = 0.0;
    if (std::ifstream(file) >> limit && limit > 0.0) bytes = std::min(bytes, limit);  // "max" is no number
  }
  return bytes;
}

}  // namespace menger::io
