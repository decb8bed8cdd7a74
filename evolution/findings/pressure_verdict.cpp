#include "evolution/findings/pressure_verdict.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "evolution/findings/compared_inflation.h"
#include "evolution/findings/elements_verdict.h"
#include "evolution/findings/inflation_result.h"
#include "evolution/findings/limit_result.h"
#include "evolution/findings/result_files.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::kilopascals;
using io::percents;

namespace {

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
std::string lower_to(double safe_Pa) { return "lower drive.pressure_Pa to " + io::pascals_towards_rest(safe_Pa) + " or less"; }

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
         ": safe up to " + kilopascals(io::rounded_towards_rest(safe_Pa)) + ", 20 % below the " + between +
         " at which it balloons" + where + ".";
}

/// What the softest law of its silicone says of a drive; empty where the robot has that law.
/// @param limit_Pa of thin walls, by the law of the robot
std::string softest_verdict(const meshes::Robot& robot, double limit_Pa) {
  const std::optional<SoftestLaw> softest = softest_law(robot, meshes::least_limit_of_thin_walls_Pa(limit_Pa));
  if (!softest) return "";
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const double safe_Pa = meshes::largest_safe_share * softest->limit_Pa;
  const std::string begin = "By the softest law of its silicone (" + softest->text + ") it ";
  if (drive_Pa <= safe_Pa) return begin + "is safe, too, up to " + kilopascals(io::rounded_towards_rest(safe_Pa)) + ".";
  const std::string test = ": test the silicone that you cast, or " + lower_to(safe_Pa) + ".";
  if (drive_Pa > softest->limit_Pa) return begin + "balloons near " + kilopascals(softest->limit_Pa) + test;
  return begin + "is near ballooning, " + percents(drive_Pa / softest->limit_Pa) + " of " + kilopascals(softest->limit_Pa) + test;
}

/// That the body loses its equilibrium below the pressure of its drive on the elements of the validation; empty unless it does.
/// @param limit_Pa of thin walls, if they have one
std::string instability_verdict(const fs::path& results, const meshes::Robot& robot, std::optional<double> limit_Pa) {
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const auto validated = compared_inflation(results);
  if (!validated || !validated->is_unstable() || *validated->missed_Pa <= 0.0 || *validated->missed_Pa > drive_Pa + 1.0)
    return "";
  const std::string thin = limit_Pa ? kilopascals(meshes::least_limit_of_thin_walls_Pa(*limit_Pa)) : kilopascals(drive_Pa);
  const double safe_Pa = meshes::largest_safe_share * validated->last_Pa;
  return "Whether it bears its pressure of " + kilopascals(drive_Pa) + " is not known: quadratic elements" +
         validate_supports(robot) + " lose their stable equilibrium " + where_ended(*validated) +
         ", where a body buckles or balloons; thin walls" + inflate_supports(robot) + " see no such point below " + thin + ". " +
         (safe_Pa > 0.0 ? "To be safe by both, " + lower_to(safe_Pa) + "." : "");
}

}  // namespace

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

}  // namespace menger::evolution
