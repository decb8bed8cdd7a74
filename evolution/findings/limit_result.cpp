#include "evolution/findings/limit_result.h"

#include <algorithm>

#include "evolution/findings/result_files.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::kilopascals;
using io::percents;

namespace {

/// The limit pressure that the search for it found, in which all chambers have one pressure.
std::optional<double> common_limit_Pa(const fs::path& results) {
  const auto result = table_at(results / "limit/result.toml");
  const auto limit = result ? meshes::limit_pressure(*result) : std::nullopt;
  return limit ? std::optional(limit->pressure_Pa) : std::nullopt;
}

}  // namespace

std::optional<double> limit_pressure_Pa(const fs::path& results) {
  const std::optional<double> common_Pa = common_limit_Pa(results);
  const auto inflation = table_at(results / "inflate/result.toml");
  if (!inflation || inflation->text("status") != "limit_point") return common_Pa;
  const auto driven = meshes::limit_pressure(*inflation);
  if (!driven) return common_Pa;
  return std::min(driven->pressure_Pa, common_Pa.value_or(driven->pressure_Pa));
}

std::string where_at_limit(const fs::path& results, const meshes::Robot& robot, double limit_Pa) {
  const bool is_antiphase = robot.drive == meshes::RobotDrive::antiphase;
  return is_antiphase && limit_Pa == common_limit_Pa(results) ? " (all chambers together)" : "";
}

std::string limit_text(const fs::path& results, const meshes::Robot& robot) {
  const auto result = table_at(results / "limit/result.toml");
  if (!result) return "";
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  if (const auto limit_Pa = limit_pressure_Pa(results)) {
    return "it balloons at " + kilopascals(*limit_Pa) + where_at_limit(results, robot, *limit_Pa) +
           " by these elements, which put it " + meshes::thin_wall_excess_text() + " too high; the drive of " +
           kilopascals(drive_Pa) + " is " + percents(drive_Pa / *limit_Pa) + " of that";
  }
  const io::CsvContents curves = io::read_csv(results / "limit/curves.csv");
  double highest_Pa = 0.0;
  for (const std::string& column : curves.columns()) {
    if (!column.starts_with("plenum") || !column.ends_with("_pressure_Pa")) continue;
    for (const double pressure_Pa : curves.numbers(column)) highest_Pa = std::max(highest_Pa, pressure_Pa);
  }
  return "no limit pressure was found up to " + kilopascals(highest_Pa) + "; " + result->text("status");
}

}  // namespace menger::evolution
