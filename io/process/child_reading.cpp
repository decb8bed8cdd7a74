#include "io/process/child_reading.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "io/text/input_error.h"

namespace menger::io {
namespace {

// The first byte of an answer says what follows.
constexpr char content = 'c';
constexpr char input_error = 'i';
constexpr char no_memory = 'm';
constexpr char other_error = 'o';

bool write_all(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string read_all(int pipe) {
  std::string bytes;
  std::array<char, 1U << 16U> piece{};
  while (true) {
    const ssize_t got = ::read(pipe, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(piece.data(), static_cast<std::size_t>(got));
  }
}

/// Bounds the memory of this process, so that an absurd number of points in a file cannot take that of the whole machine. A
/// compressed mesh grows to about ten times the size of its file, and a library holds it several times.
void bound_memory(const std::filesystem::path& file) {
  constexpr rlim_t least_bytes = rlim_t{2} << 30U;
  constexpr rlim_t bytes_per_byte = 100;
  rlim_t pages = 0;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown || !(std::ifstream("/proc/self/statm") >> pages)) return;
  const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + least_bytes + bytes_per_byte * size;
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, std::min(limit.rlim_cur, bytes));
  (void)::setrlimit(RLIMIT_AS, &limit);
}

/// What the child does: it answers through the pipe and ends without the clean-up that belongs to its parent.
[[noreturn]] void answer(const std::filesystem::path& file, const std::function<std::string()>& read, int pipe, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
  if (::getppid() != parent) ::_exit(1);
  // The handlers of this program, or of MPI, would print and wait for others.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_IGN);  // they reach both: the parent decides what they mean
  const rlimit no_core{};
  (void)::setrlimit(RLIMIT_CORE, &no_core);
  bound_memory(file);
  std::string reply;
  try {
    reply = content + read();
  } catch (const InputError& error) {
    reply = input_error + std::string(error.what());
  } catch (const std::bad_alloc&) {
    reply = no_memory;
  } catch (const std::length_error&) {
    reply = no_memory;
  } catch (const std::exception& error) {
    reply = other_error + std::string(error.what());
  }
  ::_exit(write_all(pipe, reply) ? 0 : 1);
}

}  // namespace

std::string read_in_child(const std::filesystem::path& file, const std::string& library,
                          const std::function<std::string()>& read) {
  const auto fault = [&](const std::string& reason) { return InputError(file.string() + ": " + reason); };
  const auto reason_of = [](int error) { return std::generic_category().message(error); };
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw fault("cannot be read: " + reason_of(errno));
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[0]);
    answer(file, read, pipe[1], parent);
  }
  const int error = errno;
  ::close(pipe[1]);
  const std::string reply = child < 0 ? std::string() : read_all(pipe[0]);
  ::close(pipe[0]);
  if (child < 0) throw fault("cannot be read: " + reason_of(error));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    const std::string named = "signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
    if (signal == SIGKILL) throw fault("cannot be read: its reader was ended by " + named + ", maybe for want of memory");
    throw fault("is damaged: the library of " + library + ", which reads it, ended with " + named);
  }
  if (reply.empty() || WEXITSTATUS(status) != 0) throw std::runtime_error(file.string() + ": its reader ended without an answer");
  switch (reply.front()) {
    case content:
      return reply.substr(1);
    case input_error:
      throw InputError(reply.substr(1));
    case no_memory:
      throw fault("is damaged, or does not fit into memory");
    default:
      throw std::runtime_error(file.string() + ": " + reply.substr(1));
  }
}

}  // namespace menger::io
