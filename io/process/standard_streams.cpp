#include "io/process/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <system_error>

namespace menger::io {
namespace {

bool is_closed(int descriptor) {
  return ::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF;  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
}

bool has_lost_its_reader(int descriptor) {
  pollfd asked{.fd = descriptor, .events = POLLOUT, .revents = 0};
  return ::poll(&asked, 1, 0) > 0 && (static_cast<unsigned>(asked.revents) & (POLLERR | POLLHUP)) != 0U;
}

}  // namespace

void set_up_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is taken, which is this one: those below are open.
    if (is_closed(descriptor)) (void)::open("/dev/null", O_RDWR);  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

std::string lost_output() {
  std::cout.flush();
  std::fflush(stdout);
  if (std::ferror(stdout) == 0 || has_lost_its_reader(STDOUT_FILENO)) return {};
  // The error of the lost text is not known any more. The next attempt most likely fails for the same reason.
  const bool is_possible_now = ::write(STDOUT_FILENO, "\n", 1) == 1;
  return is_possible_now ? "some text was lost" : std::generic_category().message(errno);
}

}  // namespace menger::io
