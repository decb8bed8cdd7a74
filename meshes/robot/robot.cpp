#include "meshes/robot/robot.h"

#include <algorithm>
#include <cmath>

#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/law_file.h"
#include "meshes/design/modular_body.h"

namespace menger::meshes {
namespace {

/// Dragon Skin 10 in cells of 10 mm with walls of 2 mm, at which the pressures below were chosen.
constexpr double known_shear_modulus_Pa = 86.7e3;
constexpr double known_slenderness = 2.0 / 6.0;  ///< wall thickness over span
constexpr double known_drive_Pa = 6000.0;

}  // namespace

std::string_view to_string(RobotDrive drive) {
  switch (drive) {
    case RobotDrive::in_phase:
      return "in_phase";
    case RobotDrive::antiphase:
      return "antiphase";
    case RobotDrive::hold:
      return "hold";
  }
  return "";
}

std::string_view to_string(RobotFidelity fidelity) {
  switch (fidelity) {
    case RobotFidelity::draft:
      return "draft";
    case RobotFidelity::standard:
      return "standard";
    case RobotFidelity::fine:
      return "fine";
  }
  return "";
}

std::string_view to_string(RobotSearchModel model) {
  switch (model) {
    case RobotSearchModel::finite_elements:
      return "finite_elements";
    case RobotSearchModel::voxels:
      return "voxels";
    case RobotSearchModel::both:
      return "both";
  }
  return "";
}

std::string_view to_string(RobotMeasure measure) {
  switch (measure) {
    case RobotMeasure::last_periods:
      return "last_periods";
    case RobotMeasure::net_displacement:
      return "net_displacement";
  }
  return "";
}

double two_digits(double value) {
  if (value == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 1.0);
  return std::round(value / unit) * unit;
}

double scaled_pressure_Pa(const Robot& robot, double pressure_Pa) {
  const double stiffness = materials::shear_modulus_at_rest_Pa(robot.law.law) / known_shear_modulus_Pa;
  const double slenderness = robot.wall_thickness_m / robot.span_m() / known_slenderness;
  return two_digits(pressure_Pa * stiffness * (pressure_Pa < 0.0 ? slenderness * slenderness : slenderness));
}

double usual_pressure_Pa(const Robot& robot) { return scaled_pressure_Pa(robot, known_drive_Pa); }

std::array<double, 2> drive_pressure_Pa(const Robot& robot) {
  return robot.pressure_Pa.value_or(std::array{0.0, usual_pressure_Pa(robot)});
}

namespace {

/// A law with the beginning of its source: "neo_hookean, modulus at 100 % strain of the data sheet"
std::string named_law(const materials::SourcedLaw& sourced) {
  const std::size_t end = std::min({sourced.source.find(" ("), sourced.source.find(", "), sourced.source.find(';')});
  return std::string(materials::name_of(sourced.law)) + ", " + sourced.source.substr(0, end);
}

/// Which of the laws of one name in a record a law is, as law_variant counts them; nothing if its name is the only one.
std::optional<std::size_t> variant_of(const materials::SourcedLaw& law, const materials::SiliconeRecord& record) {
  const std::string line = materials::law_line(law.law);
  if (materials::law_line(record.recommended.law) == line) return std::nullopt;
  std::size_t variant = 0;
  std::size_t count = 0;
  for (const materials::SourcedLaw& other : record.others) {
    if (materials::name_of(other.law) != materials::name_of(law.law)) continue;
    ++count;
    if (variant == 0 && materials::law_line(other.law) == line) variant = count;
  }
  return count == 1 ? std::nullopt : std::optional(variant);
}

/// ", law_variant = 2"; empty where a law needs none
std::string variant_text(const materials::SourcedLaw& law, const materials::SiliconeRecord& record) {
  const auto variant = variant_of(law, record);
  return variant ? ", law_variant = " + std::to_string(*variant) : "";
}

/// The keys of robot.toml that mean a law of the record: "law_name = "yeoh", law_variant = 2"
std::string keys_of(const materials::SourcedLaw& law, const materials::SiliconeRecord& record) {
  if (materials::law_line(record.recommended.law) == materials::law_line(law.law)) return "without law_name";
  return "law_name = \"" + std::string(materials::name_of(law.law)) + "\"" + variant_text(law, record);
}

}  // namespace

std::string law_text(const materials::SourcedLaw& law, const materials::SiliconeRecord& record) {
  return named_law(law) + variant_text(law, record);
}

std::vector<materials::SourcedLaw> other_laws_of(const Robot& robot) {
  std::vector<materials::SourcedLaw> laws{robot.record.recommended};
  laws.insert(laws.end(), robot.record.others.begin(), robot.record.others.end());
  const std::string own = materials::law_line(robot.law.law);
  std::erase_if(laws, [&](const materials::SourcedLaw& one) { return materials::law_line(one.law) == own; });
  return laws;
}

std::string law_summary_of(const Robot& robot) {
  const double modulus_Pa = materials::shear_modulus_at_rest_Pa(robot.law.law);
  std::string text = "law: initial shear modulus " + io::kilopascals(modulus_Pa) + " (" + named_law(robot.law) + ")";
  const std::vector<materials::SourcedLaw> others = other_laws_of(robot);
  if (others.empty()) return text + "; the record has no other law";
  const auto times = [&](const materials::SourcedLaw& law) {
    const std::string ratio = io::formatted("%.2g", materials::shear_modulus_at_rest_Pa(law.law) / modulus_Pa);
    return (ratio == "1" ? "just" : ratio + " times") + " as stiff (" + keys_of(law, robot.record) + ")";
  };
  const auto [softest, stiffest] = materials::softest_and_stiffest(others);
  const bool is_one = others.size() == 1;
  text += (is_one ? "; the other law of the record is " : "; the other laws of the record are ") + times(softest);
  if (!is_one) text += " to " + times(stiffest);
  return text + ". The pressure that a body bears goes nearly with it";
}

std::size_t chamber_count(const Robot& robot) { return ModularBody(robot.design.body, 1, robot.chambers).regions().size(); }

namespace {

std::string chambers_text(const Robot& robot) {
  if (robot.chambers == ChamberLayout::single) return "one chamber";
  if (!robot.has_body()) return "a chamber for each region of one material";
  const std::size_t count = chamber_count(robot);
  return count == 1 ? "one chamber" : std::to_string(count) + " chambers";
}

}  // namespace

std::string summary_of(const Robot& robot) {
  const auto [lowest_Pa, highest_Pa] = drive_pressure_Pa(robot);
  std::string text = robot.design.name + ": ";
  const std::size_t cells = robot.design.body.count();
  text += robot.has_body() ? std::to_string(cells) + (cells == 1 ? " cell" : " cells") : "a body that a search finds, cells";
  text += " of " + io::millimetres(robot.design.cell_edge_m, 4) + " with walls of " + io::millimetres(robot.wall_thickness_m, 4) +
          ", " + robot.record.name + ", ";
  text += chambers_text(robot) + ", ";
  if (robot.drive == RobotDrive::hold) return text + "held at " + io::kilopascals(highest_Pa, 4);
  text +=
      io::shown(1e-3 * lowest_Pa) + " to " + io::shown(1e-3 * highest_Pa) + " kPa at " + io::shown(robot.frequency_Hz) + " Hz";
  return robot.drive == RobotDrive::antiphase ? text + ", cells of material 2 half a stroke later" : text;
}

}  // namespace menger::meshes
