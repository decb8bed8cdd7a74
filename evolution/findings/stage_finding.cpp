#include "evolution/findings/stage_finding.h"

#include <cmath>
#include <cstddef>
#include <system_error>

#include "evolution/findings/found_walk.h"
#include "evolution/findings/inflation_result.h"
#include "evolution/findings/limit_result.h"
#include "evolution/findings/result_files.h"
#include "evolution/findings/search_result.h"
#include "evolution/findings/shape_result.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::percents;

namespace {

std::string mesh_text(const fs::path& results) {
  const io::CsvContents table = io::read_csv(results / "mesh/mesh_quality.csv");
  double solid_m3 = 0.0;
  double air_m3 = 0.0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string& quantity = table.text(row, "quantity");
    if (quantity.ends_with("volume_m3")) (quantity.starts_with("chamber") ? air_m3 : solid_m3) += table.number(row, "value");
  }
  return io::shown(1e6 * solid_m3, 3) + " cm3 of silicone around " + io::shown(1e6 * air_m3, 3) + " cm3 of air";
}

std::string calibrate_text(const fs::path& results) {
  const auto result = table_at(results / "calibrate/result.toml");
  if (!result) return "";
  if (std::string end = early_end(*result); !end.empty()) return end;
  const io::CsvContents curves = io::read_csv(results / "calibrate/residuals.csv");
  double squares = 0.0;
  for (const double error : curves.numbers("relative")) squares += error * error;
  if (curves.row_count() == 0) return "";
  return "the fit misses its curves by " + percents(std::sqrt(squares / static_cast<double>(curves.row_count()))) + " (RMS)";
}

std::string load_cases_text(const fs::path& results) {
  std::size_t cases = 0;
  std::size_t completed = 0;
  std::error_code error;
  for (fs::directory_iterator entry(results / "load_cases", error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() != ".toml") continue;
    ++cases;
    completed += early_end(io::read_toml(entry->path())).empty() ? 1U : 0U;
  }
  std::string text = std::to_string(cases) + " load cases";
  if (completed < cases) text += ", " + std::to_string(cases - completed) + " of which ended early and count as far as they go";
  return text;
}

std::string export_text(const fs::path& results) {
  const fs::path champion = results / "export/champion.toml";
  if (!io::is_file(champion)) return "no robot has a fitness";
  return "the best robot has " + std::to_string(meshes::read_design(champion).body.count()) + " cells; export/champion.toml";
}

std::string finding_of(const std::string& stage, const fs::path& results, const meshes::Robot& robot) {
  if (stage == "mesh") return mesh_text(results);
  if (stage == "inflate") return inflation_text(results, robot);
  if (stage == "limit") return limit_text(results, robot);
  if (stage == "load_cases") return load_cases_text(results);
  if (stage == "calibrate") return calibrate_text(results);
  if (stage == "validate") return shape_text(results, robot);
  if (stage == "simulate") return walk_text(results / "simulate/result.toml", robot);
  if (stage == "locomote" || stage == "locomote_finer") return walk_text(results / stage / "locomotion.toml", robot);
  if (stage == "evolve") return search_text(results);
  if (stage == "export") return export_text(results);
  if (stage == "reevaluate") return "ranking in reevaluate/reevaluation.csv";
  return "";
}

}  // namespace

std::string stage_finding(const std::string& stage, const fs::path& results, const meshes::Robot& robot) {
  try {
    return finding_of(stage, results, robot);
  } catch (const io::InputError&) {
    return "";  // results of another version; the log has what the program said
  }
}

}  // namespace menger::evolution
