#pragma once

#include <atomic>

namespace menger::io {

/// What happens if a program does not come to a stopping point after Ctrl-C.
enum class LateStop {
  wait,  ///< it is waited for: for programs that have others to end, or whose stopping points are never far apart
  /// The program leaves with exit code 130 about a second later, with one line on standard error. For programs that may be in a
  /// call of a library for minutes. Files are whole, since those that were being written are removed (see remove_pending_files).
  leave
};

/// Makes the first Ctrl-C or SIGTERM set interrupted() instead of ending the program. A second one ends the program at once.
/// Called once.
void catch_interrupts(LateStop late = LateStop::wait);

/// Returns whether the user asked to stop. Long loops check it and return with RunStatus::stopped.
const std::atomic<bool>& interrupted();

/// Tells that the program has come to a stopping point. After Ctrl-C it is then given the time that it needs to write what it
/// has; it must neither compute nor draw. Without Ctrl-C this does nothing.
void come_to_stop();

}  // namespace menger::io
