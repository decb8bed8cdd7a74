#include "io/process/run_folder.h"

#include <algorithm>
#include <utility>

#include "io/process/exit_code.h"
#include "io/text/input_error.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

constexpr const char* manifest_name = "manifest.json";

/// "menger simulate" of menger-simulate.
std::string command_of(std::string program) {
  if (program.starts_with("menger-")) program[std::string_view("menger").size()] = ' ';
  return program;
}

}  // namespace

void refuse_results_of_another(const std::filesystem::path& folder, const std::string& program) {
  const std::string other = program_of_manifest(folder / manifest_name);
  if (other.empty() || other == program) return;
  throw InputError(folder.string() + ": holds results of " + command_of(other) + ": choose another folder with -o");
}

RunFolder::RunFolder(std::string program, std::filesystem::path folder)
    : program_(std::move(program)), folder_(std::move(folder)), start_(std::chrono::steady_clock::now()) {
  refuse_results_of_another(folder_, program_);
}

bool RunFolder::is_own() const { return program_of_manifest(file(manifest_name)) == program_; }

void RunFolder::begin(const std::vector<std::string_view>& names) const {
  remove(names);
  remove({manifest_name});
}

void RunFolder::remove(const std::vector<std::string_view>& names) const { remove_files(folder_, names); }

double RunFolder::seconds() const {
  return earlier_seconds_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void RunFolder::finish(std::string parameters, std::map<std::string, std::string> inputs,
                       std::optional<std::uint64_t> seed) const {
  io::write_manifest(folder_, {.program = program_,
                               .parameters = std::move(parameters),
                               .seed = seed,
                               .seconds = seconds(),
                               .inputs = std::move(inputs)});
}

int exit_code_of(RunStatus status) { return exit_code_of(std::span(&status, 1)); }

int exit_code_of(std::span<const RunStatus> parts) {
  if (std::ranges::find(parts, RunStatus::stopped) != parts.end()) return exit_code::interrupted;
  return std::ranges::all_of(parts, [](RunStatus part) { return part == RunStatus::completed; }) ? exit_code::done
                                                                                                 : exit_code::numerical;
}

}  // namespace menger::io
