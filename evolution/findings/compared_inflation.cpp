#include "evolution/findings/compared_inflation.h"

#include <algorithm>
#include <cmath>

#include "evolution/findings/inflation_result.h"
#include "evolution/findings/result_files.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/toml_document.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::kilopascals;

namespace {

/// The first of the planned states on one side of rest that was not reached.
std::optional<double> first_missed_Pa(const ComparedInflation& found, double way) {
  std::optional<double> first_Pa;
  for (const double planned_Pa : found.planned_Pa) {
    if (planned_Pa * way <= 0.0 || state_at(found.compared_Pa, planned_Pa)) continue;
    if (!first_Pa || std::abs(planned_Pa) < std::abs(*first_Pa)) first_Pa = planned_Pa;
  }
  return first_Pa;
}

/// What ended a curve, for people.
std::string why_ended(const ComparedInflation& compared) {
  if (compared.status == "wall_contact") return "walls of a chamber touch";
  return compared.status == "limit_point" ? "no stable equilibrium follows" : compared.status;
}

}  // namespace

std::optional<ComparedInflation> compared_inflation(const fs::path& results) {
  const auto curve = table_at(results / "validate/curves/robot_inflation.toml");
  if (!curve || !io::is_file(results / "validate/curves/robot_inflation.csv")) return std::nullopt;
  ComparedInflation found{.status = curve->text("status"), .planned_Pa = {}, .compared_Pa = {}};
  if (const auto load_case = curve->optional_table("case"); load_case && load_case->has("pressures_Pa"))
    found.planned_Pa = load_case->numbers("pressures_Pa");
  found.compared_Pa = io::read_csv(results / "validate/curves/robot_inflation.csv").numbers("pressure_Pa");
  if (found.status == "completed") return found;
  // Load cases follow their positive pressures first, and tell the status of the first path that ended early.
  for (const double way : {1.0, -1.0}) {
    found.missed_Pa = first_missed_Pa(found, way);
    if (found.missed_Pa) break;
  }
  for (const double compared_Pa : found.compared_Pa) {
    const bool is_that_way = found.missed_Pa && compared_Pa * *found.missed_Pa > 0.0;
    if (is_that_way && std::abs(compared_Pa) > std::abs(found.last_Pa)) found.last_Pa = compared_Pa;
  }
  return found;
}

std::string where_ended(const ComparedInflation& compared) {
  return "between " + (compared.last_Pa == 0.0 ? "rest" : kilopascals(compared.last_Pa)) + " and " +
         kilopascals(*compared.missed_Pa);
}

std::string compared_text(const fs::path& results) {
  const auto compared = compared_inflation(results);
  if (!compared || compared->status == "completed" || compared->planned_Pa.empty()) return "";
  std::vector<std::string> ways;
  for (const double way : {1.0, -1.0}) {
    double first_Pa = 0.0;
    double last_Pa = 0.0;
    for (const double compared_Pa : compared->compared_Pa) {
      if (compared_Pa * way <= 0.0) continue;
      if (first_Pa == 0.0 || std::abs(compared_Pa) < std::abs(first_Pa)) first_Pa = compared_Pa;
      if (std::abs(compared_Pa) > std::abs(last_Pa)) last_Pa = compared_Pa;
    }
    double end_Pa = 0.0;
    for (const double planned_Pa : compared->planned_Pa)
      if (planned_Pa * way > std::abs(end_Pa)) end_Pa = planned_Pa;
    if (end_Pa == 0.0) continue;
    if (last_Pa == 0.0) {
      ways.push_back((way < 0.0 ? "at no vacuum down to " : "at no pressure up to ") + kilopascals(end_Pa));
      continue;
    }
    std::string text = "at " + io::shown(1e-3 * first_Pa, 3);
    if (last_Pa != first_Pa) text += " to " + io::shown(1e-3 * last_Pa, 3);
    ways.push_back(last_Pa == end_Pa ? text + " kPa" : text + " of " + kilopascals(end_Pa));
  }
  return "compared " + io::joined(ways, ", ") + ", where the finite elements ended (" + why_ended(*compared) + ")";
}

}  // namespace menger::evolution
