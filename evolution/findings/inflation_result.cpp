#include "evolution/findings/inflation_result.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "evolution/findings/result_files.h"
#include "evolution/posture/bend.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "meshes/load_cases/shape_agreement.h"
#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::kilopascals;
using io::millimetres;

namespace {

/// "50 % more air", "7 % less air"
std::string air_text(double growth) {
  return io::formatted("%.0f", 100.0 * std::abs(growth - 1.0)) + (growth < 1.0 ? " % less air" : " % more air");
}

/// How far what does not walk bends: "; the middle of its far end moves 14 mm sideways, seen from the near one". Empty for what
/// walks, whose inflation stands on the ground.
std::string bend_text(const fs::path& results, const meshes::Robot& robot) {
  if (robot.walks) return "";
  try {
    const auto bend = bend_in_inflation(results / "inflate", robot.design.cell_edge_m);
    return bend ? "; the middle of its far end moves " + millimetres(bend->sideways_m) +
                      " sideways, seen from the near one (thin walls bend fingers " +
                      meshes::thin_wall_bend_deficit_text(meshes::to_string(robot.fidelity)) +
                      " too little; quadratic ones, in the stage validate, decide)"
                : "";
  } catch (const io::InputError&) {
    return "";  // the growth is known without the fields
  }
}

}  // namespace

bool are_of_one_state(double a_Pa, double b_Pa) {
  constexpr double tolerance_Pa = 1.0;
  return std::abs(a_Pa - b_Pa) <= tolerance_Pa;
}

std::optional<std::size_t> state_at(const std::vector<double>& pressures_Pa, double pressure_Pa) {
  const auto found = std::ranges::find_if(pressures_Pa, [&](double state_Pa) { return are_of_one_state(state_Pa, pressure_Pa); });
  if (found == pressures_Pa.end()) return std::nullopt;
  return static_cast<std::size_t>(found - pressures_Pa.begin());
}

std::optional<double> last_pressure_Pa(const io::CsvContents& curves) {
  std::optional<double> lowest_Pa;
  std::optional<double> highest_Pa;
  for (const std::string& column : curves.columns()) {
    if (!column.ends_with("_pressure_Pa") || curves.row_count() == 0) continue;
    const auto pressure_Pa = curves.optional_number(curves.row_count() - 1, column);
    if (!pressure_Pa) continue;
    lowest_Pa = std::min(lowest_Pa.value_or(*pressure_Pa), *pressure_Pa);
    highest_Pa = std::max(highest_Pa.value_or(*pressure_Pa), *pressure_Pa);
  }
  return lowest_Pa && *lowest_Pa < 0.0 ? lowest_Pa : highest_Pa;
}

std::vector<InflatedChamber> chambers_in(const io::CsvContents& curves) {
  std::vector<InflatedChamber> chambers;
  for (const std::string& column : curves.columns()) {
    constexpr std::string_view end = "_volume_m3";
    if (!column.starts_with("plenum") || !column.ends_with(end)) continue;
    const std::string name = column.substr(0, column.size() - end.size());
    chambers.push_back({curves.numbers(name + "_pressure_Pa"), curves.numbers(column)});
  }
  return chambers;
}

std::optional<ChamberGrowth> growth_at(const std::vector<InflatedChamber>& chambers, double pressure_Pa) {
  double at_rest_m3 = 0.0;
  double driven_m3 = 0.0;
  std::vector<double> growths;
  for (const InflatedChamber& chamber : chambers) {
    const auto reached = state_at(chamber.pressures_Pa, pressure_Pa);
    if (!reached || !(chamber.volumes_m3.front() > 0.0)) return std::nullopt;
    const double volume_m3 = chamber.volumes_m3[*reached];
    at_rest_m3 += chamber.volumes_m3.front();
    driven_m3 += volume_m3;
    growths.push_back(volume_m3 / chamber.volumes_m3.front());
  }
  if (growths.empty()) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(growths);
  return ChamberGrowth{.whole = driven_m3 / at_rest_m3, .least = least, .most = most};
}

double strongest_pressure_Pa(const meshes::Robot& robot) {
  const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot);
  return -lowest_Pa > highest_Pa ? lowest_Pa : highest_Pa;
}

std::string driven_text(const meshes::Robot& robot, double pressure_Pa) {
  return kilopascals(pressure_Pa) + (robot.drive == meshes::RobotDrive::antiphase ? " in the chambers of one material" : "");
}

std::string inflation_end(const fs::path& results, const meshes::Robot& robot) {
  const auto result = table_at(results / "inflate/result.toml");
  if (!result) return "";
  std::string end = early_end(*result);
  if (end.empty() || !io::is_file(results / "inflate/curves.csv")) return end;
  const double last_Pa = last_pressure_Pa(io::read_csv(results / "inflate/curves.csv")).value_or(0.0);
  if (result->text("status") == "wall_contact") return "walls of a chamber touch at " + driven_text(robot, last_Pa);
  return end + ", at " + driven_text(robot, last_Pa);
}

std::optional<double> contact_pressure_Pa(const fs::path& results) {
  const auto result = table_at(results / "inflate/result.toml");
  if (!result || result->text("status") != "wall_contact" || !io::is_file(results / "inflate/curves.csv")) return std::nullopt;
  return last_pressure_Pa(io::read_csv(results / "inflate/curves.csv"));
}

std::string inflation_text(const fs::path& results, const meshes::Robot& robot) {
  if (!table_at(results / "inflate/result.toml")) return "";
  if (std::string end = inflation_end(results, robot); !end.empty()) return end;
  const double pressure_Pa = strongest_pressure_Pa(robot);
  const auto growth = growth_at(chambers_in(io::read_csv(results / "inflate/curves.csv")), pressure_Pa);
  if (!growth) return "";
  if (robot.drive != meshes::RobotDrive::antiphase)
    return "at " + kilopascals(pressure_Pa) + " it holds " + air_text(growth->whole) + bend_text(results, robot);
  const std::string least = air_text(growth->least);
  const std::string most = air_text(growth->most);
  const bool has_one_unit = growth->least >= 1.0 && least != most;  // "20 to 50 % more air"
  return "at " + driven_text(robot, pressure_Pa) + ", each of them holds " +
         (least == most ? least : (has_one_unit ? least.substr(0, least.find(' ')) : least) + " to " + most);
}

}  // namespace menger::evolution
