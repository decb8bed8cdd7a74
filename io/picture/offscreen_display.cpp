#include "io/picture/offscreen_display.h"

#include <GL/glx.h>
#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

namespace menger::io {
namespace {

constexpr int exec_failed = 127;
constexpr auto server_start = std::chrono::seconds(20);
constexpr auto server_end = std::chrono::seconds(5);

/// Turns the child of a fork into the X server. It uses only calls that are safe after fork().
[[noreturn]] void become_server(int number_pipe, const char* number_pipe_text, const char* display, pid_t parent) {
  setpgid(0, 0);  // Ctrl-C in the terminal must not end the server while a picture is being drawn
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(exec_failed);
  fcntl(number_pipe, F_SETFD, 0);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  execlp("Xvfb", "Xvfb", display, "-displayfd", number_pipe_text, "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset",
         static_cast<char*>(nullptr));
  _exit(exec_failed);
}

/// Returns the line that the server writes once it is ready; empty if the server ended or took too long.
std::string read_line(int pipe) {
  std::string line;
  const auto deadline = std::chrono::steady_clock::now() + server_start;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    pollfd waiting{.fd = pipe, .events = POLLIN, .revents = 0};
    const int ready = left > 0 ? poll(&waiting, 1, static_cast<int>(left)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    char letter = 0;
    if (ready <= 0 || read(pipe, &letter, 1) != 1) return {};
    if (letter == '\n') return line;
    line += letter;
  }
}

/// Returns the number of the display to try. Each program and each attempt has another one.
///
/// Numbers 0 to 9, which Xvfb would choose itself, are not used. Open MPI uses hwloc to count the cores of a machine, and hwloc
/// connects to these displays to look for GPUs. A program ends when a server that it is connected to ends.
int display_number(int attempt) {
  constexpr int first = 100;
  constexpr int count = 50000;
  return first + (getpid() + 7919 * attempt) % count;
}

}  // namespace

OffscreenDisplay::OffscreenDisplay() {
  const char* display = std::getenv("DISPLAY");
  if (display != nullptr && *display != '\0' && connect(display)) return;
  start_server();
}

OffscreenDisplay::~OffscreenDisplay() {
  if (connection_ != nullptr) XCloseDisplay(static_cast<Display*>(connection_));
  end_server();
}

bool OffscreenDisplay::connect(const std::string& display) {
  Display* connection = XOpenDisplay(display.c_str());
  if (connection == nullptr) return false;
  int error_base = 0;
  int event_base = 0;
  if (glXQueryExtension(connection, &error_base, &event_base) == False) {
    XCloseDisplay(connection);
    return false;
  }
  connection_ = connection;
  return true;
}

void OffscreenDisplay::start_server() {
  constexpr int most_attempts = 20;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const std::string number = started_server(":" + std::to_string(display_number(attempt)));
    if (!number.empty() && connect(":" + number)) return;
    if (!number.empty()) {
      missing_ = "Xvfb has no OpenGL: install the package libgl1-mesa-dri";
      break;
    }
    // A server that could not be started, or whose display was already used, closes the pipe a moment before it ends.
    const std::optional<int> status = wait_for_end(std::chrono::seconds(1));
    if (status && WIFEXITED(*status) && WEXITSTATUS(*status) == exec_failed) {
      missing_ = "no X display and no Xvfb, which can replace it: install the package xvfb";
      return;
    }
    missing_ = "no X display, and Xvfb did not start";
    if (!status) break;
  }
  end_server();
}

std::string OffscreenDisplay::started_server(const std::string& display) {
  std::array<int, 2> number_pipe{};
  if (pipe2(number_pipe.data(), O_CLOEXEC) != 0) return {};
  const std::string number_pipe_text = std::to_string(number_pipe[1]);
  const pid_t parent = getpid();
  server_ = fork();
  if (server_ == 0) become_server(number_pipe[1], number_pipe_text.c_str(), display.c_str(), parent);
  close(number_pipe[1]);
  std::string number = server_ > 0 ? read_line(number_pipe[0]) : std::string();
  close(number_pipe[0]);
  return number;
}

std::optional<int> OffscreenDisplay::wait_for_end(std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  int status = 0;
  while (server_ > 0 && waitpid(server_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  server_ = -1;
  return status;
}

void OffscreenDisplay::end_server() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  if (wait_for_end(server_end)) return;
  kill(server_, SIGKILL);
  waitpid(server_, nullptr, 0);
  server_ = -1;
}

}  // namespace menger::io
