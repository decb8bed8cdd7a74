#include "evolution/page/walk_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "evolution/outputs/report_numbers.h"
#include "evolution/page/section_parts.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

bool is_walk(const CommandOutput& output) {
  return (command_of(output) == "locomote" || command_of(output) == "simulate") && has_file(output, "trajectory.csv");
}

std::string model_of(const CommandOutput& output) {
  if (command_of(output) == "locomote") return "finite elements";
  return output.is_calibrated ? "surrogate" : "voxels";
}

/// The file with the outcome of a walk.
const char* outcome_file(const CommandOutput& output) {
  return command_of(output) == "locomote" ? "locomotion.toml" : "result.toml";
}

/// A direction along which progress counts, and the walk that goes there.
struct CommonDirection {
  std::array<double, 2> along{};  ///< of length 1
  std::string walk{};             ///< for people: where its results are, with its direction
};

/// The direction along which the progress of all walks of a body counts, so that walks which go opposite ways look so: that of
/// its walk on the finest finite elements, or else of any, which walks at all. Nothing if none does.
std::optional<CommonDirection> common_direction(const CommandOutput& of, const std::vector<CommandOutput>& outputs) {
  std::optional<CommonDirection> direction;
  double most_elements = -1.0;
  for (const CommandOutput& other : outputs) {
    if (!is_walk(other) || (&other != &of && !are_of_one_body(other.stated, of.stated))) continue;
    try {
      const io::TomlTable result = io::read_toml(other.folder / outcome_file(other));
      const double elements = command_of(other) == "locomote" ? result.optional_number("elements").value_or(0.0) : -0.5;
      const auto lengths = result.optional_number("horizontal_displacement_body_lengths");
      if (elements <= most_elements || !result.has("displacement_m")) continue;
      const std::vector<double> moved_m = result.numbers("displacement_m");
      const double way_m = moved_m.size() == 3 ? std::hypot(moved_m[0], moved_m[1]) : 0.0;
      if (!(way_m > 0.0) || lengths.value_or(1.0) < meshes::walk_limits::least_body_lengths) continue;
      most_elements = elements;
      direction = {.along = {moved_m[0] / way_m, moved_m[1] / way_m},
                   .walk = (other.name.empty() ? heading_of(other) : other.name) + " (" + model_of(other) + ", " +
                           io::degrees(meshes::direction_deg(moved_m[0], moved_m[1])) + " from x)"};
    } catch (const io::InputError&) {
      continue;  // told where its own walk is shown
    }
  }
  return direction;
}

/// What is drawn of a walk in the chart of progress.
enum class DrawnProgress { of_walk, of_what_is_no_walk, distance };

/// Says in a chart of progress along which directions it counts, what is no walk, and of which series it is the distance from the
/// start: of what is no walk and has no walk of its body beside it. @param drawn by series
void tell_what_is_drawn(const std::vector<DrawnProgress>& drawn, const std::vector<std::string>& directions,
                        PageChart& progress) {
  const auto has = [&](DrawnProgress one) { return std::ranges::find(drawn, one) != drawn.end(); };
  const std::string distance = "the horizontal distance from its start, since the line to its end is chance.";
  if (directions.empty()) {
    progress.title = "Distance from the start over time";
    progress.y.title = "distance of the centre of mass from its start (mm)";
    progress.note = "What ends within " + io::percents(meshes::walk_limits::least_body_lengths) +
                    " of its length from its start is no walk: drawn is " + distance;
    return;
  }
  progress.note =
      "Along one direction for all walks of a body, that of its walk on the finest finite elements, or else in voxels: " +
      io::joined(directions, "; ") +
      ". A curve falls where the body goes back, and one that ends below 0 went the other way. Where a walk goes to "
      "and fro, distance and direction depend on when one looks.";
  if (has(DrawnProgress::of_what_is_no_walk))
    progress.note += " What ends within " + io::percents(meshes::walk_limits::least_body_lengths) +
                     " of its length from its start is no walk, and gives no direction.";
  if (has(DrawnProgress::distance)) progress.note += " Of what is no walk, and of a body without any, it is " + distance;
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    if (drawn[n] == DrawnProgress::of_what_is_no_walk) progress.series[n].name += " (no walk)";
    if (drawn[n] == DrawnProgress::distance) progress.series[n].name += " (no walk: distance from its start)";
  }
}

}  // namespace

PageSection walk_section(const std::vector<CommandOutput>& outputs, std::vector<std::string>& notes) {
  PageSection section{.title = "Walks", .id = "walks"};
  PageChart progress{.title = "Progress over time",
                     .x = {.title = "time (s)"},
                     .y = {.title = "progress of the centre of mass (mm)"},
                     .series = {}};
  std::vector<DrawnProgress> drawn;  // by series
  std::vector<std::string> directions;
  PageChart path{.title = "Paths seen from above",
                 .x = {.title = "x (mm)"},
                 .y = {.title = "y (mm)"},
                 .series = {},
                 .equal_scale = true,
                 .note = "Every path begins at 0, 0."};
  PageChart energy{.title = "Energy that finite elements lose or gain by numerical error",
                   .x = {.title = "time (s)"},
                   .y = {.title = "imbalance of energy (mJ)"},
                   .series = {}};
  PageTable table{
      .title = "Walks, from start to end",
      .columns = {"model", "distance (mm)", "distance (body lengths)", "speed (body lengths / min)", "direction (degrees from x)",
                  "time (s)", "status", "body", "from"},
      .rows = {},
      .note = "Distance, speed and direction are those of the centre of mass from the start to the end of each walk."};
  for (const CommandOutput& output : outputs) {
    if (!is_walk(output)) continue;
    try {
      const io::CsvContents walk = io::read_csv(output.folder / "trajectory.csv");
      const std::string name = heading_of(output) + ", " + model_of(output);
      const bool dashed = command_of(output) == "simulate";
      const std::vector<double> time_s = column_of(walk, "time_s");
      std::vector<double> x_mm = column_of(walk, "centre_of_mass_x_m", 1e3);
      std::vector<double> y_mm = column_of(walk, "centre_of_mass_y_m", 1e3);
      for (std::vector<double>* values : {&x_mm, &y_mm})
        for (const double first = values->empty() ? 0.0 : values->front(); double& value : *values) value -= first;
      const char* file = outcome_file(output);
      const io::TomlTable result = io::read_toml(output.folder / file);
      const auto lengths = result.optional_number("horizontal_displacement_body_lengths");
      const bool goes_nowhere = lengths && *lengths < meshes::walk_limits::least_body_lengths;
      const auto direction_of_body = common_direction(output, outputs);
      // What ended early has no displacement, and may have a way all the same.
      const bool has_own_line = !direction_of_body && !goes_nowhere;
      std::vector<double> progress_mm = direction_of_body ? progress_of(walk, direction_of_body->along)
                                        : has_own_line    ? progress_of(walk)
                                                          : distance_from_start(walk);
      const std::string direction_words = direction_of_body ? direction_of_body->walk
                                          : has_own_line    ? name + " (the line to its own end)"
                                                            : "";
      if (!direction_words.empty() && std::ranges::find(directions, direction_words) == directions.end())
        directions.push_back(direction_words);
      for (double& value : progress_mm) value *= 1e3;
      progress.series.push_back({.name = name, .x = time_s, .y = std::move(progress_mm), .dashed = dashed});
      drawn.push_back(!goes_nowhere       ? DrawnProgress::of_walk
                      : direction_of_body ? DrawnProgress::of_what_is_no_walk
                                          : DrawnProgress::distance);
      path.series.push_back({.name = name, .x = x_mm, .y = y_mm, .dashed = dashed});
      if (walk.has("imbalance_J")) energy.series.push_back({.name = name, .x = time_s, .y = column_of(walk, "imbalance_J", 1e3)});
      const auto moved_m = result.optional_number("horizontal_displacement_m");
      const double end_s = result.number("time_s");
      std::string direction = shown_number(std::optional<double>());
      if (result.has("displacement_m") && !goes_nowhere) {
        const std::vector<double> vector_m = result.numbers("displacement_m");
        if (vector_m.size() == 3) direction = shown_whole(meshes::direction_deg(vector_m[0], vector_m[1]));
      }
      table.rows.push_back({model_of(output), shown_number(moved_m ? std::optional(1e3 * *moved_m) : std::nullopt),
                            shown_number(lengths),
                            shown_number(lengths && end_s > 0.0 ? std::optional(60.0 * *lengths / end_s) : std::nullopt),
                            direction, shown_number(end_s), result.text("status"), heading_of(output), file_of(output, file)});
      if (const std::string reason = result.text_or("reason", ""); !reason.empty())
        section.words.push_back(std::string(name).append(": ").append(reason).append("."));
    } catch (const io::InputError& error) {
      notes.emplace_back(error.what());
    }
  }
  if (table.rows.empty()) return section;
  tell_what_is_drawn(drawn, directions, progress);
  section.charts = {std::move(progress), std::move(path)};
  if (!energy.series.empty()) section.charts.push_back(std::move(energy));
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace menger::evolution
