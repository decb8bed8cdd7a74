#include "io/process/run_folder.h"

#include <utility>

#include "io/process/exit_code.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"

namespace menger::io {
void RunFolder::remove(const std::vector<std::string_view>& names) const { remove_files(folder_, names); }

double RunFolder::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

void RunFolder::finish(std::string parameters, std::map<std::string, std::string> inputs,
                       std::optional<std::uint64_t> seed) const {
  io::write_manifest(folder_, {.program = program_,
                               .parameters = std::move(parameters),
                               .seed = seed,
                               .seconds = seconds(),
                               .inputs = std::move(inputs)});
}

int exit_code_of(RunStatus status) {
  if (status == RunStatus::completed) return exit_code::done;
  return status == RunStatus::stopped ? exit_code::interrupted : exit_code::numerical;
}

}  // namespace menger::io
