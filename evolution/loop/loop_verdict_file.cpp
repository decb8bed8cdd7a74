#include "evolution/loop/loop_verdict_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/manifest.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::evolution {

namespace fs = std::filesystem;

std::vector<std::string> LoopVerdict::changed(const fs::path& results_folder) const {
  std::vector<std::string> folders;
  for (const auto& [manifest, hash] : results)
    if (io::hash_of_results(results_folder / manifest) != hash) folders.push_back(fs::path(manifest).parent_path().string());
  return folders;
}

void write_loop_verdict(const fs::path& results, const LoopVerdict& verdict) {
  nlohmann::json whole{{"program", "menger-loop"},
                       {"version", io::version()},
                       {"came_out", verdict.lines},
                       {"forecast", verdict.forecast},
                       {"manifests_sha256", verdict.results},
                       {"left_behind", verdict.left_behind}};
  if (verdict.softest_limit_Pa) whole["softest_limit_Pa"] = *verdict.softest_limit_Pa;
  io::write_whole(results / loop_verdict_name, whole.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::optional<LoopVerdict> read_loop_verdict(const fs::path& results) {
  const fs::path file = results / loop_verdict_name;
  if (!io::is_file(file)) return std::nullopt;
  const std::string text = io::read_whole(file);
  try {
    const nlohmann::json whole = nlohmann::json::parse(text);
    LoopVerdict verdict{.lines = whole.at("came_out").get<std::vector<std::string>>(),
                        .forecast = whole.value("forecast", std::vector<std::string>()),
                        .results = whole.at("manifests_sha256").get<std::map<std::string, std::string>>(),
                        .left_behind = whole.at("left_behind").get<std::map<std::string, std::string>>()};
    if (whole.contains("softest_limit_Pa")) verdict.softest_limit_Pa = whole.at("softest_limit_Pa").get<double>();
    return verdict;
  } catch (const nlohmann::json::exception&) {
    throw io::InputError(file.string() + ": is no verdict of a loop; run the loop again");
  }
}

}  // namespace menger::evolution
