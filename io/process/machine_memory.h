#pragma once

namespace menger::io {

/// Returns the memory that this process can use: what is built into the machine, or less if a control group (a container) or a
/// limit of the process (ulimit -v) says so. It does not depend on how much of it is in use.
double machine_memory_bytes();

}  // namespace menger::io
