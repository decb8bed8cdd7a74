#include "io/process/interrupt.h"

#include <csignal>

namespace menger::io {

namespace {

std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void note_interrupt(int /*signal*/) { interrupt_flag.store(true); }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;  // NOLINT(cppcoreguidelines-pro-type-union-access): the interface of POSIX
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second signal has the default action and ends the program
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupted() { return interrupt_flag; }

}  // namespace menger::io
