#include "evolution/findings/search_result.h"

#include "evolution/findings/result_files.h"

namespace menger::evolution {

namespace fs = std::filesystem;

namespace {

constexpr const char* champion_line = "Champion: ";

fs::path log_of_search(const fs::path& results) { return results / "logs/evolve.txt"; }

}  // namespace

std::string search_text(const fs::path& results) {
  const std::string note = "note: ";
  const std::string refused = log_line(log_of_search(results), note + "finite elements refused ");
  const std::string champion = log_line(log_of_search(results), champion_line);  // with its walks on other elements
  return champion.substr(0, champion.find(';')) + (refused.empty() ? "" : "; " + refused.substr(note.size()));
}

std::string search_verdict(const fs::path& results, const meshes::Robot& robot) {
  const std::string champion = log_line(log_of_search(results), champion_line);
  if (champion.empty()) return "";
  const std::string note = "note: the champion ";
  const std::string no_walk = log_line(log_of_search(results), note + "does not walk");
  return std::string("The best robot of the search") + (robot.evolves ? "" : ", which is not the body of this file") + ": " +
         champion.substr(std::string(champion_line).size()) + "." +
         (no_walk.empty() ? "" : " It " + no_walk.substr(note.size()) + ".");
}

}  // namespace menger::evolution
