#pragma once

#include <atomic>

namespace menger::io {

/// Makes the first Ctrl-C or SIGTERM set interrupted() instead of ending the program. A second one ends the program at once.
void catch_interrupts();

/// Returns whether the user asked to stop. Long loops check it and return with RunStatus::stopped.
const std::atomic<bool>& interrupted();

}  // namespace menger::io
