#include "evolution/findings/loop_verdict.h"

#include "evolution/findings/bend_verdict.h"
#include "evolution/findings/contact_verdict.h"
#include "evolution/findings/elements_verdict.h"
#include "evolution/findings/pressure_verdict.h"
#include "evolution/findings/search_result.h"
#include "evolution/findings/shape_result.h"
#include "evolution/findings/walk_verdict.h"
#include "io/text/input_error.h"

namespace menger::evolution {

namespace fs = std::filesystem;

std::vector<std::string> loop_verdict(const fs::path& results, const meshes::Robot& robot, const std::set<std::string>& stages) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) {
    if (!line.empty()) lines.push_back(line);
  };
  const bool is_inflated = stages.contains("inflate");
  const bool is_validated = stages.contains("validate");
  try {
    if (stages.contains("limit"))
      for (const std::string& line : pressure_verdict(results, robot, is_inflated, is_validated)) add(line);
    if (is_inflated) add(contact_verdict(results, robot, is_validated));
    if (is_inflated && is_validated) {
      add(elements_verdict(results, robot));
      add(bend_verdict(results, robot));
    }
    if (is_validated) add(shape_verdict(results, robot));
    for (const std::string& line : walk_verdict(results, robot, stages)) add(line);
    if (stages.contains("evolve")) add(search_verdict(results, robot));
  } catch (const io::InputError&) {
    lines.emplace_back("Some results cannot be read; run the loop again.");
  }
  return lines;
}

}  // namespace menger::evolution
