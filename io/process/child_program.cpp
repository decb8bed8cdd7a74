#include "io/process/child_program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "io/process/exit_code.h"
#include "io/text/input_error.h"

namespace menger::io {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what, int error) {
  throw InputError(file.string() + ": " + what + ": " + std::generic_category().message(error));
}

/// A file descriptor that is closed at the end of its scope and is not inherited by other programs.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const std::filesystem::path& file, int flags)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
    if (number_ < 0) fail(file, "cannot be opened", errno);
  }
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// Runs in the child between fork and exec. It uses only calls that are allowed there in a program with several threads.
[[noreturn]] void become(char* const* words, const char* folder, const std::array<int, 3>& streams, int report, pid_t parent) {
  // On an error the child can only send its number through the pipe.
  const auto give_up = [report] {
    const int error = errno;
    (void)!::write(report, &error, sizeof error);
    ::_exit(127);
  };
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
  if (::getppid() != parent) ::_exit(127);
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (*folder != '\0' && ::chdir(folder) != 0) give_up();
  for (int stream = 0; stream < 3; ++stream) {
    if (::dup2(streams.at(static_cast<std::size_t>(stream)), stream) < 0) give_up();
  }
  ::execv(words[0], words);
  give_up();
  ::_exit(127);
}

pid_t start(const ChildProgram& child) {
  const Descriptor in("/dev/null", O_RDONLY);
  const Descriptor out(child.out, O_CREAT | O_TRUNC | O_WRONLY | O_APPEND);
  const Descriptor err(child.err, (child.err == child.out ? 0 : O_TRUNC) | O_CREAT | O_WRONLY | O_APPEND);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) fail(child.program, "cannot be started", errno);
  const Descriptor answer(pipe[0]);
  Descriptor report(pipe[1]);

  const std::string program = std::filesystem::absolute(child.program).string();
  std::vector<std::string> texts{program};
  texts.insert(texts.end(), child.arguments.begin(), child.arguments.end());
  std::vector<char*> words;
  words.reserve(texts.size() + 1);
  for (std::string& text : texts) words.push_back(text.data());
  words.push_back(nullptr);

  const pid_t parent = ::getpid();
  const pid_t process = ::fork();
  if (process < 0) fail(child.program, "cannot be started", errno);
  if (process == 0) {
    become(words.data(), child.folder.c_str(), {in.number(), out.number(), err.number()}, report.number(), parent);
  }
  ::setpgid(process, process);  // in both processes, so that it is done before either continues
  report.close();
  int error = 0;
  ssize_t got = 0;
  do got = ::read(answer.number(), &error, sizeof error);
  while (got < 0 && errno == EINTR);
  if (got == 0) return process;  // the program has started: the pipe closed without data
  ::waitpid(process, nullptr, 0);
  fail(child.program, "cannot be started", error);
}

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

}  // namespace

ChildOutcome run_child(const ChildProgram& child) {
  const Clock::time_point begin = Clock::now();
  const pid_t process = start(child);
  ChildOutcome outcome;
  std::optional<Clock::time_point> asked;  // when the child was asked to end
  bool forced = false;
  int status = 0;
  rusage usage{};
  auto pause = std::chrono::milliseconds(1);
  auto last_told = begin;
  while (true) {
    const pid_t ended = ::wait4(process, &status, WNOHANG, &usage);
    if (ended == process) break;
    if (ended < 0 && errno != EINTR) fail(child.program, "was lost", errno);
    if (!asked) {
      const bool is_stopped = child.stop != nullptr && child.stop->load();
      if (is_stopped || seconds_since(begin) > child.time_limit_s) {
        outcome.end = is_stopped ? ChildEnd::stopped : ChildEnd::timed_out;
        asked = Clock::now();
        ::kill(-process, SIGINT);
      }
    } else if (!forced && seconds_since(*asked) > child.patience_s) {
      ::kill(-process, SIGKILL);
      forced = true;
    }
    if (child.waiting && Clock::now() - last_told >= std::chrono::milliseconds(100)) {
      last_told = Clock::now();
      child.waiting(seconds_since(begin));
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(20));
  }
  outcome.wall_s = seconds_since(begin);
  outcome.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome.peak_memory_bytes = 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  if (!asked && WIFSIGNALED(status)) outcome.end = ChildEnd::signalled;
  // A child whose time was up may have ended by itself just then; one that stops because it was asked to has another exit code.
  const bool has_result = outcome.exit_code == exit_code::done || outcome.exit_code == exit_code::numerical;
  if (outcome.end == ChildEnd::timed_out && !forced && has_result) outcome.end = ChildEnd::exited;
  return outcome;
}

std::filesystem::path program_in(const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::path program = folder / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(program, ignored)) throw InputError(program.string() + ": there is no such program");
  if (::access(program.c_str(), X_OK) != 0) fail(program, "cannot be run", errno);
  return program;
}

}  // namespace menger::io
