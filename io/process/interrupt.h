#pragma once

#include <atomic>

namespace menger::io {

/// Makes the first Ctrl-C or SIGTERM set interrupted() instead of ending the program. A second one ends the program at once.
/// Further calls only end hold_interrupts(). run_program calls this first of all.
///
/// A program that does not come to a stopping point leaves with exit code 130 about a second later, with one line on standard
/// error: it may be in a call of a library for minutes. It leaves after three seconds at the latest, also where it waits for
/// other programs, which end with it. Files are whole, since those that were being written are removed (see
/// remove_pending_files).
void catch_interrupts();

/// Keeps Ctrl-C and SIGTERM waiting until catch_interrupts(), also in a program that takes the place of this one. For the time in
/// which libraries are loaded and started, when nothing can answer them.
void hold_interrupts();

/// Returns whether the user asked to stop. Long loops check it and return with RunStatus::stopped.
const std::atomic<bool>& interrupted();

/// Tells that the program has come to a stopping point. After Ctrl-C it is then given the time that it needs to write what it
/// has; it must neither compute nor draw. Without Ctrl-C this does nothing.
void come_to_stop();

}  // namespace menger::io
