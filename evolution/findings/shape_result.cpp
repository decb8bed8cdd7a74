#include "evolution/findings/shape_result.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "evolution/findings/compared_inflation.h"
#include "evolution/findings/result_files.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/shape_agreement.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::millimetres;
using io::percents;

namespace {

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
  std::optional<double> volume_beyond{};         ///< likewise
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
  if (errors.is_inside) {
    errors.displacement_beyond = median("outside", "displacement");
    errors.volume_beyond = median("outside", "volume");
  }
  const io::CsvContents signs = io::read_csv(results / "validate/signs.csv");
  for (std::size_t row = 0; row < signs.row_count(); ++row) {
    errors.signs += signs.count(row, "count");
    errors.wrong_signs += signs.count(row, "wrong");
    if (signs.count(row, "wrong") == 0) continue;
    std::string way =
        io::displacement_words(signs.text(row, "observable"));  // which may have a row inside the range and one outside
    if (std::ranges::find(errors.wrong_ways, way) == errors.wrong_ways.end()) errors.wrong_ways.push_back(std::move(way));
  }
  return errors;
}

/// Where the errors lie that the medians inside the range of the fit do not tell of.
std::string range_text(const ShapeErrors& errors) {
  if (!errors.is_inside) return ", all outside what the fit covers";
  if (!errors.displacement_beyond) return "";
  return "; " + percents(*errors.displacement_beyond) + (errors.volume_beyond ? ", " + percents(*errors.volume_beyond) : "") +
         " outside what the fit covers";
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

/// "26 % (1.3 mm) off in displacements, 38 % in chamber volume (medians), furthest off by 2.07 mm, in the height of the top"
std::string medians_text(const ShapeErrors& errors) {
  std::string text;
  if (errors.displacement) text += median_text(errors) + " off in displacements";
  if (errors.volume) text += (errors.displacement ? ", " : "") + percents(*errors.volume) + " in chamber volume";
  text += " (medians)";
  if (errors.furthest) text += ", furthest off" + furthest_text(errors);
  return text + range_text(errors);
}

/// "6 of 36 displacements of at least 0.2 mm go the wrong way (the extent along y)": smaller ones have no way
std::string wrong_way_text(const ShapeErrors& errors) {
  return std::to_string(errors.wrong_signs) + " of " + std::to_string(errors.signs) + " displacements of at least " +
         millimetres(meshes::smallest_signed_m) + (errors.wrong_signs == 1 ? " goes" : " go") + " the wrong way (" +
         io::joined(errors.wrong_ways) + ")";
}

}  // namespace

std::string shape_text(const fs::path& results, const meshes::Robot& robot) {
  const auto errors = shape_errors(results);
  if (!errors) return "";
  if (!errors->displacement && !errors->volume) return "the voxels have no equilibrium where they were compared";
  std::string text = robot.drive == meshes::RobotDrive::antiphase ? "shape of this body, all chambers at one pressure: "
                                                                  : "shape of this body: ";
  text += medians_text(*errors);
  if (errors->wrong_signs > 0) text += "; " + wrong_way_text(*errors);
  if (const std::string compared = compared_text(results); !compared.empty()) text += "; " + compared;
  const std::string end = log_line(results / "logs/validate.txt", "note: robot_inflation: the surrogate ends after ");
  if (!end.empty()) text += "; " + end.substr(end.find("the surrogate"));
  return text;
}

std::string shape_verdict(const fs::path& results, const meshes::Robot& robot) {
  const auto found = shape_errors(results);
  if (!found) return "";
  const ShapeErrors& errors = *found;
  const std::string compared = compared_text(results);
  if (!errors.displacement) return "The surrogate gives this body no shape that can be compared.";
  const double displacement = std::max(*errors.displacement, errors.displacement_beyond.value_or(0.0));
  const double volume = std::max(errors.volume.value_or(0.0), errors.volume_beyond.value_or(0.0));
  const std::string at_one_pressure =
      robot.drive == meshes::RobotDrive::antiphase ? " with all its chambers at one pressure, which its drive never has" : "";
  if (meshes::is_shape_close(displacement, volume, errors.wrong_signs)) {
    std::string well = "The surrogate takes the shape of this body well" + at_one_pressure + ": " + median_text(errors) +
                       " off in the median" + (errors.furthest ? ", furthest off" + furthest_text(errors) : "");
    if (!errors.is_inside) well += "; all that was compared lies outside what the fit covers";
    return well + (compared.empty() ? "." : "; " + compared + ".");
  }
  std::string reasons = medians_text(errors);
  if (errors.wrong_signs > 0) reasons += "; " + wrong_way_text(errors);
  if (!compared.empty()) reasons += "; " + compared;
  return "Do not trust the surrogate's shape of this body" + at_one_pressure + ": " + reasons + ". See validate/worst.png.";
}

}  // namespace menger::evolution
