#include "fem/locomotion/locomotion_sweep.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "fem/locomotion/locomotion_study_file.h"
#include "io/picture/chart.h"
#include "io/picture/path_panel.h"
#include "io/process/run_folder.h"
#include "io/shown/shown_column.h"
#include "io/text/formatted.h"
#include "io/text/toml_substitution.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

fs::path case_folder(std::size_t number) { return "case_" + io::padded(number, 2); }

/// The swept key as it is shown: "drive.frequency_Hz" is "frequency (Hz)".
io::ShownColumn shown_key(const LocomotionSweep& sweep) {
  const std::string& key = sweep.keys.front();
  return io::shown_column(key.substr(key.rfind('.') + 1));
}

/// Returns the panel of the paths from above.
io::ChartPanel paths_panel(const LocomotionSweep& sweep, const std::vector<SweepCase>& cases) {
  const io::ShownColumn key = shown_key(sweep);
  io::ChartPanel panel{.x = {.title = "path from above: x (body lengths)", .least_span = io::least_path_span},
                       .y = {.title = "y (body lengths)", .least_span = io::least_path_span},
                       .equal_scale = true};
  for (const SweepCase& one : cases) {
    io::ChartSeries path{.name = io::shown(key.factor * one.value) + (key.unit.empty() ? "" : " " + key.unit)};
    const LocomotionResult& result = one.result;
    for (const WalkRecord& record : result.records) {
      const Point moved = difference(record.centre_of_mass_m, result.records.front().centre_of_mass_m);
      path.x.push_back(moved[0] / result.body_length_m);
      path.y.push_back(moved[1] / result.body_length_m);
    }
    panel.series.push_back(std::move(path));
  }
  return panel;
}

/// Returns the panel of speeds over the value, for the cases that completed.
io::ChartPanel speeds_panel(const LocomotionSweep& sweep, const std::vector<SweepCase>& cases) {
  const io::ShownColumn key = shown_key(sweep);
  io::ChartSeries along_x{.name = "x", .marks = io::Marks::line_and_points};
  io::ChartSeries along_y{.name = "y", .marks = io::Marks::line_and_points};
  for (const SweepCase& one : cases) {
    const auto travel = travel_of(one.result);
    if (!travel) continue;
    const double per_minute = 60.0 / (one.result.body_length_m * one.result.time_s);
    for (io::ChartSeries* series : {&along_x, &along_y}) series->x.push_back(key.factor * one.value);
    along_x.y.push_back(per_minute * travel->displacement_m[0]);
    along_y.y.push_back(per_minute * travel->displacement_m[1]);
  }
  return {.x = {.title = key.title()},
          .y = {.title = "speed (body lengths per minute)", .least_span = io::least_path_span},
          .series = {along_x, along_y},
          .markers = {}};
}

}  // namespace

std::vector<LocomotionStudy> sweep_studies(const LocomotionStudy& study) {
  std::vector<LocomotionStudy> studies;
  for (const double value : study.sweep->values) {
    std::string text = study.text;
    for (const std::string& key : study.sweep->keys) text = io::with_number(text, key, value, study.file);
    studies.push_back(parse_locomotion_study(text, study.file));
    studies.back().sweep.reset();
    studies.back().threads = study.threads;  // the command line may have changed it
    studies.back().output.pictures = study.output.pictures;
    studies.back().inputs[study.file.string()] = study.inputs.at(study.file.string());
  }
  return studies;
}

std::vector<SweepCase> run_sweep(const LocomotionStudy& study, const fs::path& folder, const LocomotionRunOptions& options,
                                 const std::function<void(std::size_t number, const SweepCase& done)>& ran) {
  io::RunFolder own("menger-locomote", folder);
  const std::vector<LocomotionStudy> studies = sweep_studies(study);
  // All cases are checked first: one that cannot begin is found before the others have run for hours, and before files of an
  // earlier sweep are removed.
  for (std::size_t n = 0; n < studies.size(); ++n) check_locomotion(studies[n], folder / case_folder(n + 1), options);
  io::require_writable_folder(folder);
  own.begin({locomotion_files.begin(), locomotion_files.end()});
  std::vector<SweepCase> cases;
  for (std::size_t n = 0; n < studies.size(); ++n) {
    const double before_s = own.seconds();
    cases.push_back({study.sweep->values[n], run_locomotion(studies[n], folder / case_folder(n + 1), options)});
    own.add_seconds(std::max(0.0, cases.back().result.seconds - (own.seconds() - before_s)));  // of calls that it went on from
    sweep_table(*study.sweep, cases).write(folder / "sweep.csv");
    if (ran) ran(n + 1, cases.back());
    if (cases.back().result.status == io::RunStatus::stopped) break;
  }
  if (study.output.pictures && cases.back().result.status != io::RunStatus::stopped) {
    const io::Chart chart{.panels = {speeds_panel(*study.sweep, cases), paths_panel(*study.sweep, cases)}};
    if (const auto picture = io::write_chart(folder / "sweep.png", chart); !picture.written)
      cases.back().result.notes.push_back("no chart of the sweep: " + picture.missing);
  }
  own.finish(locomotion_text(study), study.inputs);
  return cases;
}

io::CsvTable sweep_table(const LocomotionSweep& sweep, const std::vector<SweepCase>& cases) {
  std::vector<std::string> columns{"case"};
  columns.insert(columns.end(), sweep.keys.begin(), sweep.keys.end());
  for (const char* name : {"status", "reason", "displacement_x_m", "displacement_y_m", "horizontal_displacement_m",
                           "body_lengths_per_minute", "direction_deg", "peak_height_m", "steps", "seconds"})
    columns.emplace_back(name);
  io::CsvTable table(columns);
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const LocomotionResult& result = cases[n].result;
    std::vector<io::CsvCell> row{io::cell(static_cast<std::uint64_t>(n + 1))};
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) row.push_back(io::cell(cases[n].value));
    row.push_back(io::cell(io::to_string(result.status)));
    row.push_back(io::cell(std::string_view(result.reason)));
    const auto travel = travel_of(result);
    const auto add = [&](auto number) { row.push_back(io::cell(travel ? std::optional(number(*travel)) : std::nullopt)); };
    add([](const Travel& t) { return t.displacement_m[0]; });
    add([](const Travel& t) { return t.displacement_m[1]; });
    add([](const Travel& t) { return t.horizontal_displacement_m; });
    add([](const Travel& t) { return t.body_lengths_per_minute; });
    add([](const Travel& t) { return t.direction_deg; });
    row.push_back(io::cell(peak_height_m(result)));
    row.push_back(io::cell(static_cast<std::uint64_t>(result.steps)));
    row.push_back(io::cell(result.seconds));
    table.add_cells(row);
  }
  return table;
}

}  // namespace menger::fem
