#pragma once

namespace menger::io {

/// Returns the memory that programs can use on this machine: what is built in, or less if a control group (a container) limits
/// it. It does not depend on how much of it is in use.
double machine_memory_bytes();

}  // namespace menger::io
