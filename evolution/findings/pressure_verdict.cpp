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
  double limit_Pa = 0.0;  ///< near which the body may balloon by it: pressures go nearly with the modulus at rest
  [[nodiscard]] double safe_Pa() const { return meshes::largest_safe_share * limit_Pa; }
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

/// The pressures between which a body balloons, and up to which it is safe, by the law of its file.
struct OwnLimit {
  double least_Pa = 0.0;
  double most_Pa = 0.0;
  std::string where;  ///< see where_at_limit
  [[nodiscard]] double safe_Pa() const { return meshes::largest_safe_share * least_Pa; }
  [[nodiscard]] std::string between() const { return kilopascals(least_Pa) + " to " + kilopascals(most_Pa); }
};

/// @param limit_Pa of thin walls, which the stages of the loop have
OwnLimit own_limit(double limit_Pa, const std::string& where) {
  return {.least_Pa = meshes::least_limit_of_thin_walls_Pa(limit_Pa),
          .most_Pa = limit_Pa / (1.0 + meshes::least_thin_wall_excess),
          .where = where};
}

/// "safe up to 4.84 kPa, 20 % below the 6.06 kPa to 6.72 kPa at which it balloons."
std::string safe_text(const OwnLimit& own) {
  return "safe up to " + kilopascals(io::rounded_towards_rest(own.safe_Pa())) + ", " + meshes::safe_margin_text() +
         " below the " + own.between() + " at which it balloons" + own.where + ".";
}

/// What is known of a drive that the law of the file does not bear, or hardly.
std::string overload_verdict(const OwnLimit& own, double drive_Pa) {
  if (drive_Pa > own.most_Pa)
    return "It balloons at " + own.between() + own.where + ", before the " + kilopascals(drive_Pa) +
           " of its drive: " + lower_to(own.safe_Pa()) + ".";
  return "Its pressure of " + kilopascals(drive_Pa) + " is near that at which it balloons, " + own.between() + own.where + ": " +
         lower_to(own.safe_Pa()) + ".";
}

/// "balloons near 2.23 kPa", or "is near ballooning, 91 % of some 2.23 kPa". @pre the drive is not safe
std::string danger_text(const SoftestLaw& softest, double drive_Pa) {
  const std::string limit = kilopascals(softest.limit_Pa);
  return drive_Pa > softest.limit_Pa ? "balloons near " + limit
                                     : "is near ballooning, at " + percents(drive_Pa / softest.limit_Pa) + " of some " + limit;
}

std::string test_or_lower(const SoftestLaw& softest) {
  return "test the silicone that you cast, or " + lower_to(softest.safe_Pa()) + ".";
}

/// What the softest law says beside one that is told before.
std::string softest_verdict(const SoftestLaw& softest, double drive_Pa) {
  const std::string begin = "By the softest law of its silicone (" + softest.text + ") it ";
  if (drive_Pa <= softest.safe_Pa())
    return begin + "is safe, too, up to " + kilopascals(io::rounded_towards_rest(softest.safe_Pa())) + ".";
  return begin + danger_text(softest, drive_Pa) + ": " + test_or_lower(softest);
}

/// What both laws say of a drive. That which a body may not bear comes first: it is what a reader has to know.
/// @param limit_Pa of thin walls, by the law of the robot
std::vector<std::string> verdict_by_laws(const meshes::Robot& robot, double limit_Pa, const std::string& where) {
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  const OwnLimit own = own_limit(limit_Pa, where);
  const std::optional<SoftestLaw> softest = softest_law(robot, own.least_Pa);
  std::vector<std::string> lines;
  if (drive_Pa > own.safe_Pa()) {
    lines.push_back(overload_verdict(own, drive_Pa));
    if (softest) lines.push_back(softest_verdict(*softest, drive_Pa));
  } else if (softest && drive_Pa > softest->safe_Pa()) {
    lines.push_back("Your silicone decides whether it bears its pressure of " + kilopascals(drive_Pa) +
                    ": by the softest law of " + robot.record.name + " (" + softest->text + ") it " +
                    danger_text(*softest, drive_Pa) + ", so " + test_or_lower(*softest));
    lines.push_back("By the law of its file (" + meshes::law_text(robot.law, robot.record) + ") it bears it, and is " +
                    safe_text(own));
  } else {
    lines.push_back("It bears its pressure of " + kilopascals(drive_Pa) + ": " + safe_text(own));
    if (softest) lines.push_back(softest_verdict(*softest, drive_Pa));
  }
  return lines;
}

/// Adds the line on the softest law behind one that says that the elements do not know, if that law does not bear the drive.
void add_softest(const meshes::Robot& robot, double limit_Pa, std::vector<std::string>& lines) {
  const auto softest = softest_law(robot, meshes::least_limit_of_thin_walls_Pa(limit_Pa));
  const double drive_Pa = drive_pressure_Pa(robot)[1];
  if (softest && drive_Pa > softest->safe_Pa()) lines.push_back(softest_verdict(*softest, drive_Pa));
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
  const auto by_both_laws = [&] { return verdict_by_laws(robot, *limit_Pa, where_at_limit(results, robot, *limit_Pa)); };
  if (limit_Pa && drive_Pa > *limit_Pa) return by_both_laws();
  const auto inflation = is_inflated ? table_at(results / "inflate/result.toml") : std::nullopt;
  if (!inflation || drive_Pa <= 0.0) return {};
  if (const std::string end = inflation_end(results, robot); !end.empty() && inflation->text("status") != "wall_contact")
    return {"Whether it bears its pressure is not known: its inflation ended before " + kilopascals(drive_Pa) + " (" + end +
            ")."};
  if (std::string unstable = is_validated ? instability_verdict(results, robot, limit_Pa) : ""; !unstable.empty()) {
    std::vector<std::string> lines{std::move(unstable)};
    if (limit_Pa) add_softest(robot, *limit_Pa, lines);
    return lines;
  }
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
