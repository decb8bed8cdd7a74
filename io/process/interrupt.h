#pragma once

#include <atomic>

namespace menger::io {

/// From here on the first Ctrl-C or SIGTERM sets interrupted() instead of ending the program; a second one ends it at once.
void catch_interrupts();

/// Whether the user asked to stop; work loops look at it and return with RunStatus::stopped.
const std::atomic<bool>& interrupted();

}  // namespace menger::io
