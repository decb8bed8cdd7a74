#include "io/process/program_job.h"

#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>

#include "io/process/exit_code.h"
#include "io/process/progress.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "run.toml";
constexpr std::size_t name_length = 16;  ///< of 64 digits: enough for folder names

const Words<ChildEnd>& end_words() {
  static const Words<ChildEnd> words{{"exited", ChildEnd::exited}, {"timed_out", ChildEnd::timed_out}};
  return words;
}

std::string record_text(const ProgramJob& job, const ChildOutcome& outcome) {
  std::string text = "job = " + toml_quoted(job.name) + "\n";
  text += "end = " + toml_quoted(outcome.end == ChildEnd::exited ? "exited" : "timed_out") + "\n";
  text += "exit_code = " + std::to_string(outcome.exit_code) + "\n";
  text += "time_limit_s = " + number_text(job.time_limit_s) + "\n";
  text += "seconds = " + number_text(outcome.wall_s) + "\n";
  text += "cpu_seconds = " + number_text(outcome.cpu_s) + "\n";
  text += "peak_memory_bytes = " + std::to_string(outcome.peak_memory_bytes) + "\n";
  return text;
}

/// Returns what an earlier call recorded. Returns nothing if there is no record or it cannot be read; the run is then repeated.
std::optional<ProgramJobResult> recorded(const fs::path& folder) {
  if (!io::is_file(folder / record_name)) return std::nullopt;
  try {
    const TomlTable table = read_toml(folder / record_name);
    ProgramJobResult result{.folder = folder, .outcome = {}, .time_limit_s = 0.0, .repeated = false, .message = {}};
    result.outcome.end = table.word("end", end_words());
    result.outcome.exit_code = table.integer("exit_code");
    result.time_limit_s = table.number("time_limit_s");
    result.outcome.wall_s = table.number("seconds", non_negative());
    result.outcome.cpu_s = table.number("cpu_seconds", non_negative());
    result.outcome.peak_memory_bytes = table.integer<std::uint64_t>("peak_memory_bytes", at_least(0));
    return result;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string last_line(const fs::path& file) {
  std::string text = read_whole(file);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.find_last_of("\n\r") + 1);
}

void make_empty_folder(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be emptied: " + error.message());
  require_writable_folder(folder);
}

}  // namespace

bool ProgramJobResult::has_result() const {
  return outcome.end == ChildEnd::exited && (outcome.exit_code == exit_code::done || outcome.exit_code == exit_code::numerical);
}

bool ProgramJobResult::is_refused() const { return outcome.end == ChildEnd::exited && outcome.exit_code == exit_code::bad_input; }

std::string ProgramJobResult::failure() const {
  if (outcome.end == ChildEnd::timed_out) return "time limit of " + duration_text(time_limit_s);
  if (outcome.end == ChildEnd::stopped) return "stopped by the user";
  const bool by_signal = outcome.end == ChildEnd::signalled;
  std::string text = by_signal ? "ended by signal " + std::to_string(outcome.signal) + " (" + ::strsignal(outcome.signal) + ")"
                               : "exit code " + std::to_string(outcome.exit_code);
  if (!message.empty()) text += ": " + message;
  return text;
}

std::string job_hash(const ProgramJob& job) {
  std::string text = file_hash(job.program) + "\n";
  for (const std::string& argument : job.arguments) text += content_hash(argument) + "\n";
  for (const auto& [name, content] : job.inputs) text += name + "\n" + content_hash(content) + "\n";
  return content_hash(text).substr(0, name_length);
}

ProgramJobResult run_job(const ProgramJob& job, const ProgramJobOptions& options) {
  const bool keeps = !job.kept_folder.empty();
  const fs::path folder = keeps ? job.kept_folder : options.runs / job_hash(job);
  if (auto earlier = keeps ? std::nullopt : recorded(folder)) {
    const bool would_go_further = earlier->outcome.end == ChildEnd::timed_out && job.time_limit_s > earlier->time_limit_s;
    if (!would_go_further) return *earlier;
  }
  if (!keeps) make_empty_folder(folder);
  for (const auto& [name, content] : job.inputs) write_whole(folder / name, content);
  const ChildProgram child{.program = job.program,
                           .arguments = job.arguments,
                           .folder = folder,
                           .out = folder / "stdout.txt",
                           .err = folder / "stderr.txt",
                           .time_limit_s = job.time_limit_s,
                           .stop = options.stop,
                           .waiting = options.waiting};
  ProgramJobResult result{
      .folder = folder, .outcome = run_child(child), .time_limit_s = job.time_limit_s, .repeated = true, .message = {}};
  const bool is_known = result.has_result() || result.outcome.end == ChildEnd::timed_out;
  if (is_known && !keeps) write_whole(folder / record_name, record_text(job, result.outcome));
  if (!result.has_result()) result.message = last_line(folder / "stderr.txt");
  return result;
}

}  // namespace menger::io
