#include "evolution/loop/loop_findings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>

#include "evolution/posture/bend.h"
#include "evolution/posture/fall.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/load_cases/shape_agreement.h"
#include "meshes/load_cases/walk_agreement.h"
#include "meshes/robot/robot_studies.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

using io::kilopascals;
using io::millimetres;
using io::percents;

std::optional<io::TomlTable> table_at(const fs::path& file) {
  if (!io::is_file(file)) return std::nullopt;
  return io::read_toml(file);
}

/// Status and reason of a result, where it did not complete: "diverged: ..."
std::string early_end(const io::TomlTable& result) {
  const std::string status = result.text("status");
  const std::string reason = result.text_or("reason", "");
  return status == "completed" ? "" : status + (reason.empty() ? "" : ": " + reason);
}

/// A walk of either model.
struct Walk {
  double x_m = 0.0;
  double y_m = 0.0;
  double body_lengths = 0.0;
  double time_s = 0.0;
  std::optional<double> fell_s{};  ///< when the body fell over, if it did

  [[nodiscard]] double distance_m() const { return std::hypot(x_m, y_m); }
  [[nodiscard]] double direction_deg() const { return std::atan2(y_m, x_m) * 180.0 / std::numbers::pi; }
};

/// @param file result.toml of simulate or locomotion.toml of locomote, which have the same names
/// @param result what it holds
std::optional<Walk> walk_in(const fs::path& file, const io::TomlTable& result, const meshes::Robot& robot) {
  if (!result.has("displacement_m")) return std::nullopt;
  const std::vector<double> moved_m = result.numbers("displacement_m");
  if (moved_m.size() != 3) return std::nullopt;
  Walk walk{moved_m[0], moved_m[1], result.number("horizontal_displacement_body_lengths"), result.number("time_s")};
  try {
    if (const auto fall = fall_in_walk(file.parent_path(), 1.0 / robot.frequency_Hz)) walk.fell_s = fall->time_s;
  } catch (const io::InputError&) {
    // Frames that cannot be read tell of no fall, and the walk is known without them.
  }
  return walk;
}

/// "fell over at 1.7 s"; empty if it did not
std::string fall_text(const Walk& walk) { return walk.fell_s ? "fell over at " + io::shown(*walk.fell_s, 2) + " s" : ""; }

std::string walk_text(const fs::path& file, const meshes::Robot& robot) {
  const auto result = table_at(file);
  if (!result) return "";
  const std::optional<Walk> walk = walk_in(file, *result, robot);
  if (!walk) return early_end(*result);
  std::string text = "it moves " + millimetres(walk->distance_m()) + " (" + io::body_lengths(walk->body_lengths) + ") in " +
                     io::shown(walk->time_s, 3) + " s";
  if (walk->fell_s) text += ", but " + fall_text(*walk) + ": this is no walk";
  if (const std::string end = early_end(*result); !end.empty()) text += "; " + end;
  return text;
}

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

/// A chamber, or several that are joined, in the states of an inflation.
struct Chamber {
  std::vector<double> pressures_Pa;
  std::vector<double> volumes_m3;
};

std::vector<Chamber> chambers_in(const io::CsvContents& curves) {
  std::vector<Chamber> chambers;
  for (const std::string& column : curves.columns()) {
    constexpr std::string_view end = "_volume_m3";
    if (!column.starts_with("plenum") || !column.ends_with(end)) continue;
    const std::string name = column.substr(0, column.size() - end.size());
    chambers.push_back({curves.numbers(name + "_pressure_Pa"), curves.numbers(column)});
  }
  return chambers;
}

/// How chambers grow at a pressure, as multiples of their volumes at rest.
struct Growth {
  double whole = 0.0;  ///< of all together
  double least = 0.0;  ///< of that which grows least
  double most = 0.0;
};

/// The growth of chambers, each where its pressure is the drive's; nothing if that was not reached.
std::optional<Growth> growth_at(const std::vector<Chamber>& chambers, double pressure_Pa) {
  constexpr double tolerance_Pa = 1.0;
  double at_rest_m3 = 0.0;
  double driven_m3 = 0.0;
  std::vector<double> growths;
  for (const Chamber& chamber : chambers) {
    const auto reached = std::ranges::find_if(chamber.pressures_Pa,
                                              [&](double state_Pa) { return std::abs(state_Pa - pressure_Pa) <= tolerance_Pa; });
    if (reached == chamber.pressures_Pa.end() || !(chamber.volumes_m3.front() > 0.0)) return std::nullopt;
    const double volume_m3 = chamber.volumes_m3[static_cast<std::size_t>(reached - chamber.pressures_Pa.begin())];
    at_rest_m3 += chamber.volumes_m3.front();
    driven_m3 += volume_m3;
    growths.push_back(volume_m3 / chamber.volumes_m3.front());
  }
  if (growths.empty()) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(growths);
  return Growth{.whole = driven_m3 / at_rest_m3, .least = least, .most = most};
}

/// "50 % more air", "7 % less air"
std::string air_text(double growth) {
  return io::formatted("%.0f", 100.0 * std::abs(growth - 1.0)) + (growth < 1.0 ? " % less air" : " % more air");
}

/// The pressure of the drive that is furthest from 0.
double strongest_pressure_Pa(const meshes::Robot& robot) {
  const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot);
  return -lowest_Pa > highest_Pa ? lowest_Pa : highest_Pa;
}

/// The pressure furthest from 0 in the last state of an inflation.
double last_pressure_Pa(const std::vector<Chamber>& chambers) {
  double last_Pa = 0.0;
  for (const Chamber& chamber : chambers) {
    if (!chamber.pressures_Pa.empty() && std::abs(chamber.pressures_Pa.back()) > std::abs(last_Pa))
      last_Pa = chamber.pressures_Pa.back();
  }
  return last_Pa;
}

/// A pressure as robot.toml has it, in three digits, not further from 0: "4870 Pa", "-427 Pa".
std::string pressure_of_key(double pressure_Pa) {
  constexpr double digits = 3.0;
  const double step_Pa =
      std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(std::abs(pressure_Pa), 1.0))) - digits + 1.0));
  const double rounding = 1e-9;
  const double steps = std::floor(std::abs(pressure_Pa) / step_Pa + rounding);
  return io::formatted("%.0f Pa", std::copysign(steps * step_Pa, pressure_Pa));
}

/// "6 kPa", and in which chambers where a drive loads them by turns.
std::string driven_text(const meshes::Robot& robot, double pressure_Pa) {
  return kilopascals(pressure_Pa) + (robot.drive == meshes::RobotDrive::antiphase ? " in the chambers of one material" : "");
}

/// How the inflation to the states of the drive ended early, and where; empty if it did not.
std::string inflation_end(const fs::path& results, const meshes::Robot& robot) {
  const auto result = table_at(results / "inflate/result.toml");
  if (!result) return "";
  std::string end = early_end(*result);
  if (end.empty() || !io::is_file(results / "inflate/curves.csv")) return end;
  const double last_Pa = last_pressure_Pa(chambers_in(io::read_csv(results / "inflate/curves.csv")));
  if (result->text("status") == "wall_contact") return "walls of a chamber touch at " + driven_text(robot, last_Pa);
  return end + ", at " + driven_text(robot, last_Pa);
}

/// The pressure of the last state before walls of a chamber touched; nothing if they did not, or it is not known.
std::optional<double> contact_pressure_Pa(const fs::path& results) {
  const auto result = table_at(results / "inflate/result.toml");
  if (!result || result->text("status") != "wall_contact" || !io::is_file(results / "inflate/curves.csv")) return std::nullopt;
  return last_pressure_Pa(chambers_in(io::read_csv(results / "inflate/curves.csv")));
}

/// The inflation of the body in the stage validate: its own finite elements, which compute states of growing pressure.
struct ValidatedInflation {
  std::string status;
  std::vector<double> planned_Pa;     ///< the states that were to be compared
  std::vector<double> compared_Pa;    ///< those that were reached
  std::optional<double> missed_Pa{};  ///< the first that was not
  double last_Pa = 0.0;               ///< the last one reached before that; 0: the body at rest

  /// Whether walls of a chamber touch before a state, so that the walk passes through this contact.
  [[nodiscard]] bool has_contact() const { return status == "wall_contact" && missed_Pa; }
  /// Whether no stable equilibrium followed.
  [[nodiscard]] bool is_unstable() const { return status == "limit_point" && missed_Pa; }
};

/// The pressure in the reason of a curve that ended early: "pressure_Pa = -750 was not reached: ..."
std::optional<double> pressure_in(const std::string& reason) {
  constexpr std::string_view beginning = "pressure_Pa = ";
  if (!reason.starts_with(beginning)) return std::nullopt;
  double pressure_Pa = 0.0;
  const auto [rest, fault] = std::from_chars(reason.data() + beginning.size(), reason.data() + reason.size(), pressure_Pa);
  return fault == std::errc() ? std::optional(pressure_Pa) : std::nullopt;
}

std::optional<ValidatedInflation> validated_inflation(const fs::path& results) {
  const auto curve = table_at(results / "validate/curves/robot_inflation.toml");
  if (!curve || !io::is_file(results / "validate/curves/robot_inflation.csv")) return std::nullopt;
  ValidatedInflation found{.status = curve->text("status"), .planned_Pa = {}, .compared_Pa = {}};
  if (const auto load_case = curve->optional_table("case"); load_case && load_case->has("pressures_Pa"))
    found.planned_Pa = load_case->numbers("pressures_Pa");
  found.compared_Pa = io::read_csv(results / "validate/curves/robot_inflation.csv").numbers("pressure_Pa");
  if (found.status == "completed") return found;
  found.missed_Pa = pressure_in(curve->text_or("reason", ""));
  for (const double compared_Pa : found.compared_Pa) {
    const bool is_that_way = found.missed_Pa && compared_Pa * *found.missed_Pa > 0.0;
    if (is_that_way && std::abs(compared_Pa) > std::abs(found.last_Pa)) found.last_Pa = compared_Pa;
  }
  return found;
}

/// "between 4 kPa and 5 kPa": where a curve ended. @pre a state was missed
std::string where_ended(const ValidatedInflation& validated) {
  return "between " + (validated.last_Pa == 0.0 ? "rest" : kilopascals(validated.last_Pa)) + " and " +
         kilopascals(*validated.missed_Pa);
}

/// What ended a curve, for people.
std::string why_ended(const ValidatedInflation& validated) {
  if (validated.status == "wall_contact") return "walls of a chamber touch";
  return validated.status == "limit_point" ? "no stable equilibrium follows" : validated.status;
}

/// "compared at 1 to 4 of 6 kPa, where the finite elements ended (no stable equilibrium follows)"; empty if all states of the
/// drive were compared.
std::string compared_text(const fs::path& results) {
  const auto validated = validated_inflation(results);
  if (!validated || validated->status == "completed" || validated->planned_Pa.empty()) return "";
  std::vector<std::string> ways;
  for (const double way : {1.0, -1.0}) {
    double first_Pa = 0.0;
    double last_Pa = 0.0;
    for (const double compared_Pa : validated->compared_Pa) {
      if (compared_Pa * way <= 0.0) continue;
      if (first_Pa == 0.0 || std::abs(compared_Pa) < std::abs(first_Pa)) first_Pa = compared_Pa;
      if (std::abs(compared_Pa) > std::abs(last_Pa)) last_Pa = compared_Pa;
    }
    double end_Pa = 0.0;
    for (const double planned_Pa : validated->planned_Pa)
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
  return "compared " + io::joined(ways, ", ") + ", where the finite elements ended (" + why_ended(*validated) + ")";
}

/// How far what does not walk bends: "; the middle of its far end moves 14 mm sideways, seen from the near one". Empty for what
/// walks, whose inflation stands on the ground.
std::string bend_text(const fs::path& results, const meshes::Robot& robot) {
  if (robot.walks) return "";
  try {
    const auto bend = bend_in_inflation(results / "inflate", robot.design.cell_edge_m);
    return bend ? "; the middle of its far end moves " + millimetres(bend->sideways_m) + " sideways, seen from the near one" : "";
  } catch (const io::InputError&) {
    return "";  // the growth is known without the fields
  }
}

std::string inflate_text(const fs::path& results, const meshes::Robot& robot) {
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
  return "at " + driven_text(robot, pressure_Pa) + " each of these holds " +
         (least == most ? least : (has_one_unit ? least.substr(0, least.find(' ')) : least) + " to " + most);
}

/// The limit pressure that the search for it found, in which all chambers have one pressure.
std::optional<double> common_limit_Pa(const fs::path& results) {
  const auto result = table_at(results / "limit/result.toml");
  const auto limit = result ? meshes::limit_pressure(*result) : std::nullopt;
  return limit ? std::optional(limit->pressure_Pa) : std::nullopt;
}

/// The least pressure at which the body balloons: of the search for it, and of the inflation to the states of the drive, where
/// that ended so.
std::optional<double> limit_pressure_Pa(const fs::path& results) {
  const std::optional<double> common_Pa = common_limit_Pa(results);
  const auto inflation = table_at(results / "inflate/result.toml");
  if (!inflation || inflation->text("status") != "limit_point") return common_Pa;
  const auto driven = meshes::limit_pressure(*inflation);
  if (!driven) return common_Pa;
  return std::min(driven->pressure_Pa, common_Pa.value_or(driven->pressure_Pa));
}

/// " (all chambers together)" where a limit pressure was found so, and the drive loads them by turns.
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

/// A displacement of a body that the surrogate misses.
struct MissedDisplacement {
  double difference_m = 0.0;
  std::string observable;  ///< for people
};

/// What the validation found of the robot itself.
struct ShapeErrors {
  /// Medians inside the range of the parameters, or outside if nothing lies inside.
  std::optional<double> displacement{};
  std::optional<double> volume{};
  bool is_inside = true;
  std::optional<double> displacement_beyond{};   ///< the median outside, where others lie inside
  std::optional<double> displacement_m{};        ///< inside, or outside if nothing lies inside: the median in lengths
  std::optional<MissedDisplacement> furthest{};  ///< likewise: of the largest difference
  std::size_t signs = 0;
  std::size_t wrong_signs = 0;
  std::vector<std::string> wrong_ways{};  ///< the displacements with a wrong sign, for people
};

std::optional<ShapeErrors> shape_errors(const fs::path& results) {
  if (!io::is_file(results / "validate/summary.csv")) return std::nullopt;
  const io::CsvContents summary = io::read_csv(results / "validate/summary.csv");
  const auto row_of = [&](const std::string& range, const std::string& kind) {
    std::optional<std::size_t> found;
    for (std::size_t row = 0; row < summary.row_count(); ++row) {
      if (summary.text(row, "body") == "all" && summary.text(row, "range") == range && summary.text(row, "kind") == kind)
        found = row;
    }
    return found;
  };
  const auto number = [&](const std::string& range, const std::string& kind, const std::string& column) {
    const auto row = row_of(range, kind);
    return row ? summary.optional_number(*row, column) : std::nullopt;
  };
  const auto furthest = [&](const std::string& range) {
    const auto row = row_of(range, "displacement");
    const auto difference_m = row ? summary.optional_number(*row, "furthest_m") : std::nullopt;
    if (!difference_m) return std::optional<MissedDisplacement>();
    return std::optional(MissedDisplacement{.difference_m = *difference_m,
                                            .observable = io::displacement_words(summary.text(*row, "furthest_observable"))});
  };
  const auto median = [&](const std::string& range, const std::string& kind) { return number(range, kind, "median"); };
  ShapeErrors errors;
  for (const std::string range : {"inside", "outside"}) {
    errors.displacement = median(range, "displacement");
    errors.volume = median(range, "volume");
    if (summary.has("furthest_m")) {  // none in results of earlier versions
      errors.displacement_m = number(range, "displacement", "median_m");
      errors.furthest = furthest(range);
    }
    errors.is_inside = range == "inside";
    if (errors.displacement || errors.volume) break;
  }
  if (errors.is_inside) errors.displacement_beyond = median("outside", "displacement");
  const io::CsvContents signs = io::read_csv(results / "validate/signs.csv");
  for (std::size_t row = 0; row < signs.row_count(); ++row) {
    errors.signs += signs.count(row, "count");
    errors.wrong_signs += signs.count(row, "wrong");
    if (signs.count(row, "wrong") > 0) errors.wrong_ways.push_back(io::displacement_words(signs.text(row, "observable")));
  }
  return errors;
}

/// Where the errors lie that the medians inside the range of the fit do not tell of.
std::string range_text(const ShapeErrors& errors) {
  if (!errors.is_inside) return ", all outside what the fit covers";
  return errors.displacement_beyond ? "; " + percents(*errors.displacement_beyond) + " outside what the fit covers" : "";
}

/// "37 %", and how much that is in millimetres where this is known: "37 % (0.68 mm)"
std::string median_text(const ShapeErrors& errors) {
  return percents(*errors.displacement) + (errors.displacement_m ? " (" + millimetres(*errors.displacement_m, 2) + ")" : "");
}

/// " by 2.07 mm, in the height of the top"; empty where this is not known
std::string furthest_text(const ShapeErrors& errors) {
  if (!errors.furthest) return "";
  return " by " + millimetres(errors.furthest->difference_m) + ", in " + errors.furthest->observable;
}

/// "6 of 36 displacements go the wrong way (the extent along y)"
std::string wrong_way_text(const ShapeErrors& errors) {
  return std::to_string(errors.wrong_signs) + " of " + std::to_string(errors.signs) + " displacements go the wrong way (" +
         io::joined(errors.wrong_ways) + ")";
}

/// Returns the last line of a log that begins with a word.
std::string line_of(const fs::path& log, const std::string& beginning) {
  if (!io::is_file(log)) return "";
  const std::string text = "\n" + io::read_whole(log);
  const std::size_t start = text.rfind("\n" + beginning);
  if (start == std::string::npos) return "";
  return text.substr(start + 1, text.find('\n', start + 1) - start - 1);
}

std::string validate_text(const fs::path& results, const meshes::Robot& robot) {
  const auto errors = shape_errors(results);
  if (!errors) return "";
  if (!errors->displacement && !errors->volume) return "the voxels have no equilibrium where they were compared";
  std::string text = robot.drive == meshes::RobotDrive::antiphase ? "shape of this body, all chambers at one pressure: "
                                                                  : "shape of this body: ";
  if (errors->displacement) text += median_text(*errors) + " off in displacements";
  if (errors->volume) text += (errors->displacement ? ", " : "") + percents(*errors->volume) + " in chamber volume";
  text += " (medians)";
  if (errors->furthest) text += ", furthest off" + furthest_text(*errors);
  text += range_text(*errors);
  if (errors->wrong_signs > 0) text += "; " + wrong_way_text(*errors);
  if (const std::string compared = compared_text(results); !compared.empty()) text += "; " + compared;
  const std::string end = line_of(results / "logs/validate.txt", "note: robot_inflation: the surrogate ends after ");
  if (!end.empty()) text += "; " + end.substr(end.find("the surrogate"));
  return text;
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

std::string evolve_text(const fs::path& log) {
  const std::string note = "note: ";
  const std::string refused = line_of(log, note + "finite elements refused ");
  const std::string champion = line_of(log, "Champion: ");  // with its walks on other elements, which the log is for
  return champion.substr(0, champion.find(';')) + (refused.empty() ? "" : "; " + refused.substr(note.size()));
}

std::string finding_of(const std::string& stage, const fs::path& results, const meshes::Robot& robot) {
  if (stage == "mesh") return mesh_text(results);
  if (stage == "inflate") return inflate_text(results, robot);
  if (stage == "limit") return limit_text(results, robot);
  if (stage == "load_cases") return load_cases_text(results);
  if (stage == "calibrate") return calibrate_text(results);
  if (stage == "validate") return validate_text(results, robot);
  if (stage == "simulate") return walk_text(results / "simulate/result.toml", robot);
  if (stage == "locomote" || stage == "locomote_finer") return walk_text(results / stage / "locomotion.toml", robot);
  if (stage == "evolve") return evolve_text(results / "logs/evolve.txt");
  if (stage == "export") return export_text(results);
  if (stage == "reevaluate") return "ranking in reevaluate/reevaluation.csv";
  return "";
}

meshes::WalkAgreement agreement(const Walk& one, const Walk& other) {
  const auto outcome = [](const Walk& walk) {
    return meshes::WalkOutcome{walk.fell_s ? 0.0 : walk.body_lengths, walk.time_s, walk.direction_deg()};
  };
  return meshes::compare_walks(outcome(one), outcome(other));
}

bool agree(const Walk& one, const Walk& other) { return agreement(one, other) <= meshes::WalkAgreement::both_go_nowhere; }

/// Walks of one duration differ in time by a few steps at most.
bool are_as_long(const Walk& one, const Walk& other) {
  constexpr double largest_share = 0.01;
  return std::abs(one.time_s - other.time_s) <= largest_share * std::max(one.time_s, other.time_s);
}

/// Whether a body got somewhere on its feet.
bool is_walk(const Walk& walk) { return !walk.fell_s && walk.body_lengths >= meshes::walk_limits::least_body_lengths; }

/// "67 mm and 70 mm, 3 degrees apart". @pre not both go nowhere
std::string both(const Walk& one, const Walk& other) {
  const std::string distances = millimetres(one.distance_m()) + " and " + millimetres(other.distance_m());
  if (agreement(one, other) == meshes::WalkAgreement::one_goes_nowhere)
    return distances + ", of which the " + (is_walk(one) ? "second" : "first") +
           (one.fell_s || other.fell_s ? " is a fall" : " is no walk");
  const std::string angle = io::formatted("%.0f", meshes::angle_between(one.direction_deg(), other.direction_deg()));
  return distances + ", " + angle + (angle == "1" ? " degree apart" : " degrees apart");
}

/// @param compared see compared_text
std::string shape_verdict(const ShapeErrors& errors, const std::string& compared) {
  if (!errors.displacement) return "The surrogate gives this body no shape that can be compared.";
  const double worse = std::max(*errors.displacement, errors.displacement_beyond.value_or(0.0));
  if (worse <= meshes::largest_shape_error && errors.wrong_signs == 0 && errors.is_inside)
    return "The surrogate takes the shape of this body well" + (compared.empty() ? "." : ", " + compared + ".");
  std::string reasons = median_text(errors) + " off in the median" + range_text(errors);
  if (errors.furthest) reasons += "; furthest off" + furthest_text(errors);
  if (errors.wrong_signs > 0) reasons += "; " + wrong_way_text(errors);
  if (!compared.empty()) reasons += "; " + compared;
  return "Do not trust the surrogate's shape of this body: " + reasons + ". See validate/worst.png.";
}

/// The softest law in the record of a silicone, where it is softer than the robot's.
struct SoftestLaw {
  std::string text;       ///< see meshes::law_text
  double limit_Pa = 0.0;  ///< at which the body may balloon by it
};

/// @param limit_Pa at which the body may balloon by the law of the robot
std::optional<SoftestLaw> softest_law(const meshes::Robot& robot, double limit_Pa) {
  const std::vector<materials::SourcedLaw> others = other_laws_of(robot);
  if (others.empty()) return std::nullopt;
  const materials::SourcedLaw softest = materials::softest_and_stiffest(others).first;
  const double ratio = materials::shear_modulus_at_rest_Pa(softest.law) / materials::shear_modulus_at_rest_Pa(robot.law.law);
  if (ratio >= 1.0) return std::nullopt;
  return SoftestLaw{.text = meshes::law_text(softest, robot.record), .limit_Pa = ratio * limit_Pa};
}

/// "lower drive.pressure_Pa to 4870 Pa or less"
std::string lower_to(double safe_Pa) { return "lower drive.pressure_Pa to " + pressure_of_key(safe_Pa) + " or less"; }

/// What is known of a drive whose limit pressure is known, by the law of its file.
/// @param limit_Pa of thin walls, which the stages of the loop have
std::string limit_verdict(const meshes::Robot& robot, double limit_Pa, const std::string& where) {
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const double least_Pa = meshes::least_limit_of_thin_walls_Pa(limit_Pa);
  const double most_Pa = limit_Pa / (1.0 + meshes::least_thin_wall_excess);
  const double safe_Pa = meshes::largest_safe_share * least_Pa;
  const std::string between = kilopascals(least_Pa) + " to " + kilopascals(most_Pa);
  if (drive_Pa > most_Pa)
    return "It balloons at " + between + where + ", before the " + kilopascals(drive_Pa) + " of its drive: " + lower_to(safe_Pa) +
           ".";
  if (drive_Pa > safe_Pa)
    return "Its pressure of " + kilopascals(drive_Pa) + " is near that at which it balloons, " + between + where + ": " +
           lower_to(safe_Pa) + ".";
  const std::optional<SoftestLaw> softest = softest_law(robot, least_Pa);
  const bool is_by_one_law = softest && drive_Pa > meshes::largest_safe_share * softest->limit_Pa;
  return "It bears its pressure of " + kilopascals(drive_Pa) +
         (is_by_one_law ? " by its law (" + meshes::law_text(robot.law, robot.record) + "), " +
                              (drive_Pa > softest->limit_Pa ? "not" : "hardly") + " by the softest of its silicone"
                        : "") +
         ": safe up to " + kilopascals(safe_Pa) + ", 20 % below the " + between + " at which it balloons" + where + ".";
}

/// What the softest law of its silicone says of a drive; empty where the robot has that law.
/// @param limit_Pa of thin walls, by the law of the robot
std::string softest_verdict(const meshes::Robot& robot, double limit_Pa) {
  const std::optional<SoftestLaw> softest = softest_law(robot, meshes::least_limit_of_thin_walls_Pa(limit_Pa));
  if (!softest) return "";
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const double safe_Pa = meshes::largest_safe_share * softest->limit_Pa;
  const std::string begin = "By the softest law of its silicone (" + softest->text + ") it ";
  if (drive_Pa <= safe_Pa) return begin + "is safe, too, up to " + kilopascals(safe_Pa) + ".";
  const std::string test = ": test the silicone that you cast, or " + lower_to(safe_Pa) + ".";
  if (drive_Pa > softest->limit_Pa) return begin + "balloons near " + kilopascals(softest->limit_Pa) + test;
  return begin + "is near ballooning, " + percents(drive_Pa / softest->limit_Pa) + " of " + kilopascals(softest->limit_Pa) + test;
}

// A body that walks stands on the ground where it is inflated, and on none where it is validated: its volume differs by that,
// too.
std::string supports_of_inflate(const meshes::Robot& robot) { return robot.walks ? " (inflate, on the ground)" : " (inflate)"; }
std::string supports_of_validate(const meshes::Robot& robot) { return robot.walks ? " (validate, free)" : " (validate)"; }

/// That the body loses its equilibrium below the pressure of its drive on the elements of the validation; empty unless it does.
/// @param limit_Pa of thin walls, if they have one
std::string instability_verdict(const fs::path& results, const meshes::Robot& robot, std::optional<double> limit_Pa) {
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const auto validated = validated_inflation(results);
  if (!validated || !validated->is_unstable() || *validated->missed_Pa <= 0.0 || *validated->missed_Pa > drive_Pa + 1.0)
    return "";
  const std::string thin = limit_Pa ? kilopascals(meshes::least_limit_of_thin_walls_Pa(*limit_Pa)) : kilopascals(drive_Pa);
  const double safe_Pa = meshes::largest_safe_share * validated->last_Pa;
  return "Whether it bears its pressure of " + kilopascals(drive_Pa) + " is not known: quadratic elements" +
         supports_of_validate(robot) + " lose their stable equilibrium " + where_ended(*validated) +
         ", where a body buckles or balloons; thin walls" + supports_of_inflate(robot) + " see no such point below " + thin +
         ". " + (safe_Pa > 0.0 ? "To be safe by both, " + lower_to(safe_Pa) + "." : "");
}

/// Whether the walls of chambers touch before a drive has come to its lowest pressure, on which elements.
/// @param is_validated whether the results have a validation of this robot
std::string contact_verdict(const fs::path& results, const meshes::Robot& robot, bool is_validated) {
  const auto inflation = table_at(results / "inflate/result.toml");
  if (!inflation) return "";
  const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot);
  const bool has_thin_contact = inflation->text("status") == "wall_contact";
  const auto validated = is_validated ? validated_inflation(results) : std::nullopt;
  const bool has_quadratic_contact = validated && validated->has_contact();
  if (!has_thin_contact && !has_quadratic_contact) {
    if (lowest_Pa >= 0.0 || !early_end(*inflation).empty()) return "";
    const bool ends_before = validated && validated->status != "completed";
    return "Down to " + kilopascals(lowest_Pa) + " no walls of a chamber touch" +
           (ends_before ? " by thin walls (inflate)." : ".");
  }
  std::vector<std::string> contacts;
  const auto thin_Pa = has_thin_contact ? contact_pressure_Pa(results) : std::nullopt;
  std::optional<double> free_Pa = thin_Pa;  // the last pressure at which no model has a contact
  if (has_thin_contact)
    contacts.push_back((thin_Pa ? "at " + driven_text(robot, *thin_Pa) + " " : std::string()) + "by thin walls (inflate)");
  if (has_quadratic_contact) {
    const bool is_common = robot.drive == meshes::RobotDrive::antiphase;  // see validate_text
    contacts.push_back(where_ended(*validated) + (is_common ? " in all chambers together" : "") +
                       " by quadratic elements (validate)");
    if (!free_Pa || std::abs(validated->last_Pa) < std::abs(*free_Pa)) free_Pa = validated->last_Pa;
  }
  const bool is_vacuum = (thin_Pa && *thin_Pa < 0.0) || (has_quadratic_contact && *validated->missed_Pa < 0.0);
  std::string text = "Walls of a chamber touch " + io::joined(contacts, ", ") + ", before the " +
                     kilopascals(is_vacuum ? lowest_Pa : highest_Pa) + " of its drive";
  if (!has_thin_contact && early_end(*inflation).empty())
    text += "; thin walls (inflate) come to " + kilopascals(is_vacuum ? lowest_Pa : highest_Pa) + " without";
  text += ". Shapes beyond are not sure, nor are walks, whose walls press on each other.";
  if (!is_vacuum) return text;
  // As far from where walls touch as a pressure has to be from ballooning.
  const double safe_Pa = meshes::largest_safe_share * free_Pa.value_or(0.0);
  if (safe_Pa < 0.0) return text + " Raise the lowest drive.pressure_Pa to " + pressure_of_key(safe_Pa) + " or more.";
  return has_quadratic_contact
             ? text + " Raise the lowest drive.pressure_Pa well above " + pressure_of_key(*validated->missed_Pa) + "."
             : text;
}

/// How a drive compares with the pressure at which the body balloons, in sentences.
/// @param is_inflated whether the results have an inflation up to the pressure of the drive
/// @param is_validated whether they have a validation of this robot
std::vector<std::string> pressure_verdict(const fs::path& results, const meshes::Robot& robot, bool is_inflated,
                                          bool is_validated) {
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const auto limit_Pa = limit_pressure_Pa(results);
  const auto by_both_laws = [&] {
    return std::vector{limit_verdict(robot, *limit_Pa, where_at_limit(results, robot, *limit_Pa)),
                       softest_verdict(robot, *limit_Pa)};
  };
  if (limit_Pa && drive_Pa > *limit_Pa) return by_both_laws();
  const auto inflation = is_inflated ? table_at(results / "inflate/result.toml") : std::nullopt;
  if (!inflation || drive_Pa <= 0.0) return {};
  if (const std::string end = inflation_end(results, robot); !end.empty() && inflation->text("status") != "wall_contact")
    return {"Whether it bears its pressure is not known: its inflation ended before " + kilopascals(drive_Pa) + " (" + end +
            ")."};
  if (std::string unstable = is_validated ? instability_verdict(results, robot, limit_Pa) : ""; !unstable.empty())
    return {std::move(unstable), limit_Pa ? softest_verdict(robot, *limit_Pa) : ""};
  if (!limit_Pa)
    return {"It bears its pressure. How far it is from ballooning is not known: " + limit_text(results, robot) + "."};
  return by_both_laws();
}

/// Growths of the chamber that differ by less than this are told as one.
constexpr double same_growth = 0.05;

/// How far the finite elements of the stages inflate and validate differ in the volume of the chamber at the pressure of the
/// drive.
std::string elements_verdict(const fs::path& results, const meshes::Robot& robot) {
  const auto inflation = table_at(results / "inflate/result.toml");
  if (robot.chambers != meshes::ChamberLayout::single || !inflation || !early_end(*inflation).empty()) return "";
  if (!io::is_file(results / "inflate/curves.csv") || !io::is_file(results / "validate/errors.csv")) return "";
  const double drive_Pa = strongest_pressure_Pa(robot);
  const auto grown = growth_at(chambers_in(io::read_csv(results / "inflate/curves.csv")), drive_Pa);
  const io::CsvContents compared = io::read_csv(results / "validate/errors.csv");
  for (std::size_t row = 0; row < compared.row_count(); ++row) {
    const bool is_there =
        compared.text(row, "observable") == "volume_change" && std::abs(compared.number(row, "pressure_Pa") - drive_Pa) <= 1.0;
    if (!is_there || !grown) continue;
    const double thin = grown->whole;
    const double quadratic = 1.0 + compared.number(row, "finite_elements");
    const double difference = std::abs(quadratic / thin - 1.0);
    if (difference <= same_growth) return "";
    return "At " + kilopascals(drive_Pa) + " its chamber is known to " + percents(difference) + ": " +
           io::formatted("%.2f", thin) + " times its volume at rest by thin walls" + supports_of_inflate(robot) + ", " +
           io::formatted("%.2f", quadratic) + " times by quadratic elements" + supports_of_validate(robot) + "." +
           (robot.walks ? " The ground holds the body back: part of the difference is that." : "");
  }
  return "";
}

/// Whether a robot, and what drives its cells, is its own mirror image in a plane across one of the axes x and y, so that it has
/// no reason to go one way along this axis rather than the other.
bool is_mirror_image(const meshes::Robot& robot, bool is_across_x) {
  const meshes::Polycube& body = robot.design.body;
  const bool has_phases = robot.drive == meshes::RobotDrive::antiphase;
  const auto same = [&](std::uint8_t a, std::uint8_t b) {
    return has_phases ? a == b : (a == meshes::empty) == (b == meshes::empty);
  };
  for (const meshes::CellIndex& cell : body.occupied()) {
    const meshes::CellIndex mirrored{is_across_x ? body.nx() - 1 - cell.x : cell.x, is_across_x ? cell.y : body.ny() - 1 - cell.y,
                                     cell.z};
    if (!same(body.at_or_empty(cell), body.at_or_empty(mirrored))) return false;
  }
  return true;
}

/// Whether walks agree in direction, and not in distance.
bool have_one_direction(const Walk& one, const Walk& other) {
  return agreement(one, other) != meshes::WalkAgreement::one_goes_nowhere &&
         meshes::angle_between(one.direction_deg(), other.direction_deg()) <= meshes::walk_limits::same_direction_deg;
}

std::string mesh_verdict(const Walk& coarser, const Walk& finer, const meshes::Robot& robot) {
  if (!are_as_long(coarser, finer)) return "Its walks on two meshes last differently long and are not compared.";
  if (coarser.fell_s && finer.fell_s) return "It falls over on finite elements of two meshes: it does not walk.";
  if (agreement(coarser, finer) == meshes::WalkAgreement::both_go_nowhere) {
    return "It does not walk on finite elements of two meshes: it ends within " +
           percents(meshes::walk_limits::least_body_lengths) + " of its length from where it began" +
           (robot.evolves ? "; the search has found no walker: give it more generations or mutants ([search])." : ".");
  }
  const std::string on_meshes = " on finite elements of two meshes";
  if (agree(coarser, finer)) return "Finite elements of two meshes agree on the walk: " + both(coarser, finer) + ".";
  if (agreement(coarser, finer) == meshes::WalkAgreement::one_goes_nowhere) {
    const Walk& none = is_walk(coarser) ? finer : coarser;
    return "Whether it walks is not known: it moves " + millimetres(coarser.distance_m()) + " and " +
           millimetres(finer.distance_m()) + on_meshes + ", and " + millimetres(none.distance_m()) +
           (none.fell_s ? " is a fall." : " is no walk.");
  }
  if (have_one_direction(coarser, finer))
    return "The direction of its walk is known, its distance is not: " + both(coarser, finer) + on_meshes + ".";
  const bool is_symmetric = is_mirror_image(robot, std::abs(finer.x_m) >= std::abs(finer.y_m));
  return "How it walks is not known: " + both(coarser, finer) + on_meshes + ". Chance decides such a walk" +
         (is_symmetric ? "; a body that differs from its mirror image walks more surely." : ".");
}

std::string model_verdict(const Walk& voxels, const Walk& elements) {
  if (!are_as_long(voxels, elements)) return "The walks of both models last differently long and are not compared.";
  if (agreement(voxels, elements) == meshes::WalkAgreement::both_go_nowhere)
    return "It walks in neither model, so that the surrogate cannot be judged by its walk.";
  return (agree(voxels, elements) ? "The surrogate walks as finite elements do: "
                                  : "The surrogate does not walk as finite elements do: ") +
         both(voxels, elements) + " (surrogate and finite elements).";
}

/// What the walk of the surrogate is worth where finite elements of two meshes do not agree on theirs.
std::string unknown_walk_verdict(const Walk& voxels, const Walk& coarser, const Walk& finer) {
  const std::string distance = millimetres(voxels.distance_m());
  if (voxels.fell_s) return "";  // told already
  if (!have_one_direction(coarser, finer) || !are_as_long(voxels, finer))
    return "So the walk of the surrogate, " + distance + ", cannot be judged.";
  if (have_one_direction(voxels, finer))
    return "The surrogate goes that way, too; its distance, " + distance + ", cannot be judged.";
  return model_verdict(voxels, finer);
}

}  // namespace

std::string stage_finding(const std::string& stage, const fs::path& results, const meshes::Robot& robot) {
  try {
    return finding_of(stage, results, robot);
  } catch (const io::InputError&) {
    return "";  // results of another version; the log has what the program said
  }
}

std::string overdrive(const fs::path& results, const meshes::Robot& robot) {
  try {
    const double drive_Pa = drive_pressure_Pa(robot)[1];
    const auto limit_Pa = limit_pressure_Pa(results);
    const auto inflation = table_at(results / "inflate/result.toml");
    // Some bodies snap through a limit point and bear more beyond it.
    if (!limit_Pa || drive_Pa <= *limit_Pa || !inflation || early_end(*inflation).empty()) return "";
    return "it balloons at " + kilopascals(*limit_Pa) + ", before the " + kilopascals(drive_Pa) + " of drive.pressure_Pa";
  } catch (const io::InputError&) {
    return "";
  }
}

std::string early_contact(const fs::path& results, const meshes::Robot& robot) {
  try {
    const auto contact_Pa = contact_pressure_Pa(results);
    const double first_Pa = strongest_pressure_Pa(robot) / meshes::validated_states;
    if (!contact_Pa || std::abs(*contact_Pa) >= std::abs(first_Pa)) return "";
    return "walls of a chamber touch at " + kilopascals(*contact_Pa) + ", before the first state that it compares";
  } catch (const io::InputError&) {
    return "";
  }
}

std::optional<double> softest_limit_Pa(const fs::path& results, const meshes::Robot& robot) {
  try {
    const auto limit_Pa = limit_pressure_Pa(results);
    const std::optional<SoftestLaw> softest =
        limit_Pa ? softest_law(robot, meshes::least_limit_of_thin_walls_Pa(*limit_Pa)) : std::nullopt;
    return softest ? std::optional(softest->limit_Pa) : std::nullopt;
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

std::vector<std::string> loop_verdict(const fs::path& results, const meshes::Robot& robot, const std::set<std::string>& stages) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) {
    if (!line.empty()) lines.push_back(line);
  };
  try {
    if (stages.contains("limit"))
      for (const std::string& line : pressure_verdict(results, robot, stages.contains("inflate"), stages.contains("validate")))
        add(line);
    if (stages.contains("inflate")) add(contact_verdict(results, robot, stages.contains("validate")));
    if (stages.contains("inflate") && stages.contains("validate")) add(elements_verdict(results, robot));
    if (const auto errors = stages.contains("validate") ? shape_errors(results) : std::nullopt)
      add(shape_verdict(*errors, compared_text(results)));
    const auto walk_of = [&](const std::string& stage, const std::string& file, const std::string& model) {
      const auto result = stages.contains(stage) ? table_at(results / stage / file) : std::nullopt;
      if (!result) return std::optional<Walk>();
      const std::string end = early_end(*result);
      if (end.empty()) {
        const std::optional<Walk> walk = walk_in(results / stage / file, *result, robot);
        if (walk && walk->fell_s)
          lines.push_back("The body " + fall_text(*walk) + " in the walk " + model + ": this is no walk.");
        return walk;
      }
      lines.push_back("The walk " + model + " ended early and is not compared (" + end + ").");
      return std::optional<Walk>();
    };
    const auto voxels = walk_of("simulate", "result.toml", "of the surrogate");
    const auto elements = walk_of("locomote", "locomotion.toml", "on finite elements");
    const auto finer = walk_of("locomote_finer", "locomotion.toml", "on finite elements of the finer mesh");
    if (elements && finer) add(mesh_verdict(*elements, *finer, robot));
    const bool is_known = !elements || !finer || agree(*elements, *finer);
    if (voxels && !is_known) add(unknown_walk_verdict(*voxels, *elements, *finer));
    if (const auto& reference = finer ? finer : elements; voxels && reference && is_known)
      add(model_verdict(*voxels, *reference));
  } catch (const io::InputError&) {
    lines.emplace_back("Some results cannot be read; run the loop again.");
  }
  return lines;
}

}  // namespace menger::evolution
