#include "io/process/interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>

#include "io/process/exit_code.h"
#include "io/text/whole_file.h"

namespace menger::io {

namespace {

using Clock = std::chrono::steady_clock;

/// How long a program has to come to a stopping point. A program that gets less than half of a processor has longer, but not for
/// ever: on a machine that is that busy even short steps take a second.
constexpr auto patience = std::chrono::seconds(1);
constexpr double least_processor_s = 0.5;
constexpr auto longest_patience = std::chrono::seconds(3);
constexpr auto pause = std::chrono::milliseconds(20);

std::atomic<bool> interrupt_flag{false};
std::atomic<bool> has_come_to_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

sem_t interrupt_came;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): the one way to wake a thread from a handler

/// Notes the first signal of either kind. The second has its default action, which ends the program once the handler returns.
extern "C" void note_interrupt(int signal) {
  if (interrupt_flag.exchange(true)) {
    ::signal(signal, SIG_DFL);
    ::raise(signal);
    return;
  }
  sem_post(&interrupt_came);
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

[[noreturn]] void leave() {
  remove_pending_files();
  // Other threads may hold the streams for ever.
  if (ftrylockfile(stdout) == 0) fflush_unlocked(stdout);
  const std::string line = std::string(isatty(STDERR_FILENO) == 1 ? "\n" : "") + program_invocation_short_name +
                           ": stopped in the middle of a computation; finished parts are kept\n";
  (void)!::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(exit_code::interrupted);
}

/// Waits for an interrupt, and leaves if the program does not stop by itself.
void watch() {
  while (sem_wait(&interrupt_came) != 0) {
  }
  const Clock::time_point start = Clock::now();
  const double processor_start_s = processor_seconds();
  const auto is_late = [&] {
    const auto passed = Clock::now() - start;
    return passed >= longest_patience || (passed >= patience && processor_seconds() - processor_start_s >= least_processor_s);
  };
  while (!has_come_to_stop) {
    if (is_late()) leave();
    std::this_thread::sleep_for(pause);
  }
}

/// The signals with which people stop a program.
sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void start_watching() {
  // Signals are for the other threads.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(watch).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void start_catching() {
  sem_init(&interrupt_came, 0, 0);
  start_watching();
  struct sigaction action {};
  action.sa_handler = note_interrupt;  // NOLINT(cppcoreguidelines-pro-type-union-access): the interface of POSIX
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

void catch_interrupts() {
  static std::atomic<bool> is_called{false};
  if (!is_called.exchange(true)) start_catching();
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

void hold_interrupts() {
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

const std::atomic<bool>& interrupted() { return interrupt_flag; }

void come_to_stop() {
  if (interrupt_flag) has_come_to_stop = true;
}

}  // namespace menger::io
