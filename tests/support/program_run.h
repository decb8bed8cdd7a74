#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "io/text/whole_file.h"

namespace menger::test_support {

/// How a program ended, and its output.
struct Outcome {
  int code = -1;   ///< exit code; -1 if a signal ended it
  int signal = 0;  ///< the signal that ended it
  std::string out;
  std::string err;
};

/// A program that runs in a folder. Its output goes to the files stdout.txt and stderr.txt there.
class ProgramRun {
 public:
  ProgramRun(std::filesystem::path folder, const std::filesystem::path& program, std::vector<std::string> arguments)
      : folder_(std::move(folder)) {
    arguments.insert(arguments.begin(), program.string());
    std::vector<char*> words;
    words.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    constexpr int flags = O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC;
    const int out = open((folder_ / "stdout.txt").c_str(), flags, 0644);  // NOLINT(cppcoreguidelines-pro-type-vararg)
    const int err = open((folder_ / "stderr.txt").c_str(), flags, 0644);  // NOLINT(cppcoreguidelines-pro-type-vararg)
    child_ = fork();
    if (child_ != 0) {
      close(out);
      close(err);
      return;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // NOLINT(cppcoreguidelines-pro-type-vararg): not to outlive a test that is killed
    if (chdir(folder_.c_str()) != 0) _exit(126);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execv(words[0], words.data());
    _exit(126);
  }

  /// Returns what it has printed so far.
  [[nodiscard]] std::string printed() const { return io::read_whole(folder_ / "stdout.txt"); }

  void send(int signal) const { kill(child_, signal); }

  [[nodiscard]] pid_t process() const { return child_; }

  /// Returns the name of the program that the process runs at present: it may become another one.
  [[nodiscard]] std::string name() const {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/" + std::to_string(child_) + "/exe", unknown).filename().string();
  }

  /// Returns the processor time that it has used so far. It has not been waited for.
  [[nodiscard]] double processor_seconds() const {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(child_, &clock) == 0) clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Waits until it has used so much processor time, or has ended before.
  void wait_for_processor_seconds(double seconds) const {
    while (processor_seconds() < seconds) {
      siginfo_t ended{};
      const bool is_known = waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0;
      if (!is_known || ended.si_pid != 0) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  /// Waits until the program ends.
  [[nodiscard]] Outcome wait() const {
    int status = 0;
    waitpid(child_, &status, 0);
    Outcome outcome;
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = printed();
    outcome.err = io::read_whole(folder_ / "stderr.txt");
    return outcome;
  }

 private:
  std::filesystem::path folder_;
  pid_t child_ = -1;
};

}  // namespace menger::test_support
