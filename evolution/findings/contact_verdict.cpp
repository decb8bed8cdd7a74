#include "evolution/findings/contact_verdict.h"

#include <cmath>
#include <optional>
#include <vector>

#include "evolution/findings/compared_inflation.h"
#include "evolution/findings/inflation_result.h"
#include "evolution/findings/result_files.h"
#include "io/shown/shown_quantity.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::kilopascals;

std::string contact_verdict(const fs::path& results, const meshes::Robot& robot, bool is_validated) {
  const auto inflation = table_at(results / "inflate/result.toml");
  if (!inflation) return "";
  const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot);
  const bool has_thin_contact = inflation->text("status") == "wall_contact";
  const auto validated = is_validated ? compared_inflation(results) : std::nullopt;
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
  if (safe_Pa < 0.0) return text + " Raise the lowest drive.pressure_Pa to " + io::pascals_towards_rest(safe_Pa) + " or more.";
  return has_quadratic_contact
             ? text + " Raise the lowest drive.pressure_Pa well above " + io::pascals_towards_rest(*validated->missed_Pa) + "."
             : text;
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

}  // namespace menger::evolution
