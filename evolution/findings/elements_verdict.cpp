#include "evolution/findings/elements_verdict.h"

#include <cmath>
#include <cstddef>

#include "evolution/findings/inflation_result.h"
#include "evolution/findings/result_files.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/is_file.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::kilopascals;
using io::percents;

namespace {

/// Growths of the chamber that differ by less than this are told as one.
constexpr double same_growth = 0.05;

}  // namespace

std::string inflate_supports(const meshes::Robot& robot) { return robot.walks ? " (inflate, on the ground)" : " (inflate)"; }

std::string validate_supports(const meshes::Robot& robot) { return robot.walks ? " (validate, free)" : " (validate)"; }

std::string elements_verdict(const fs::path& results, const meshes::Robot& robot) {
  const auto inflation = table_at(results / "inflate/result.toml");
  if (robot.chambers != meshes::ChamberLayout::single || !inflation || !early_end(*inflation).empty()) return "";
  if (!io::is_file(results / "inflate/curves.csv") || !io::is_file(results / "validate/errors.csv")) return "";
  const double drive_Pa = strongest_pressure_Pa(robot);
  const auto grown = growth_at(chambers_in(io::read_csv(results / "inflate/curves.csv")), drive_Pa);
  const io::CsvContents compared = io::read_csv(results / "validate/errors.csv");
  for (std::size_t row = 0; row < compared.row_count(); ++row) {
    const bool is_there =
        compared.text(row, "observable") == "volume_change" && are_of_one_state(compared.number(row, "pressure_Pa"), drive_Pa);
    if (!is_there || !grown) continue;
    const double thin = grown->whole;
    const double quadratic = 1.0 + compared.number(row, "finite_elements");
    const double difference = std::abs(quadratic / thin - 1.0);
    if (difference <= same_growth) return "";
    return "At " + kilopascals(drive_Pa) + " two kinds of finite elements differ by " + percents(difference) +
           " in its chamber: " + io::formatted("%.2f", thin) + " times its volume at rest by thin walls" +
           inflate_supports(robot) + ", " + io::formatted("%.2f", quadratic) + " times by quadratic elements" +
           validate_supports(robot) + "." +
           (robot.walks ? " The ground holds the body back: part of the difference is that." : "");
  }
  return "";
}

}  // namespace menger::evolution
