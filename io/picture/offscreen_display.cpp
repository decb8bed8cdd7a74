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

/// In the child of a fork: becomes the X server. Only calls that are safe after fork().
[[noreturn]] void become_server(int number_pipe, const char* number_pipe_text, pid_t parent) {
  setpgid(0, 0);  // Ctrl-C in the terminal must not end the server while a picture is being drawn
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(exec_failed);
  fcntl(number_pipe, F_SETFD, 0);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  execlp("Xvfb", "Xvfb", "-displayfd", number_pipe_text, "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset",
         static_cast<char*>(nullptr));
  _exit(exec_failed);
}

/// The line that the server writes once it is ready; empty if it ended or took too long.
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
  std::array<int, 2> number_pipe{};
  if (pipe2(number_pipe.data(), O_CLOEXEC) != 0) {
    missing_ = "no pipe to start Xvfb with";
    return;
  }
  const std::string number_pipe_text = std::to_string(number_pipe[1]);
  const pid_t parent = getpid();
  server_ = fork();
  if (server_ == 0) become_server(number_pipe[1], number_pipe_text.c_str(), parent);
  close(number_pipe[1]);
  const std::string number = server_ > 0 ? read_line(number_pipe[0]) : std::string();
  close(number_pipe[0]);
  if (!number.empty() && connect(":" + number)) return;

  // A server that could not even be started closes the pipe a moment before it ends.
  const std::optional<int> status = number.empty() ? wait_for_end(std::chrono::seconds(1)) : std::nullopt;
  if (status && WIFEXITED(*status) && WEXITSTATUS(*status) == exec_failed) {
    missing_ = "no X display and no Xvfb to stand in for one: install the package xvfb";
  } else if (number.empty()) {
    missing_ = "no X display, and Xvfb did not start";
  } else {
    missing_ = "Xvfb offers no OpenGL: install the package libgl1-mesa-dri";
  }
  end_server();
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
