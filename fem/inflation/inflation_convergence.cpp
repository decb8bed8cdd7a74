#include "fem/inflation/inflation_convergence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "fem/inflation/inflation_problem.h"
#include "fem/space/rank_agreement.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

/// Returns the names and values of the observables.
std::vector<std::pair<std::string, double>> observables_of(const InflationResult& result) {
  std::vector<std::pair<std::string, double>> values;
  const PathPoint& last = result.path.points.back();
  for (std::size_t p = 0; p < result.plenum_names.size(); ++p) {
    values.emplace_back(io::column_part(result.plenum_names[p]) + "_pressure_Pa", last.pressures_Pa[p]);
    values.emplace_back(io::column_part(result.plenum_names[p]) + "_volume_m3", last.plenum_volumes_m3[p]);
  }
  for (std::size_t p = 0; p < result.point_names.size(); ++p) {
    const PointObservation& observation = result.observations.back()[p];
    const std::string name = io::column_part(result.point_names[p]);
    for (std::size_t i = 0; i < 3; ++i)
      values.emplace_back(name + "_displacement_" + "xyz"[i] + "_m", observation.displacement_m[i]);
    values.emplace_back(name + "_largest_stretch", observation.largest_stretch);
  }
  values.emplace_back("strain_energy_J", last.strain_energy_J);
  return values;
}

/// Smaller changes are not extrapolated: a value that is prescribed, or zero by symmetry except for rounding, does not converge.
constexpr double negligible = 1e-7;  ///< relative; tolerances of the solver are of this order

void extrapolate(ConvergenceRow& row, const ConvergenceRow& before) {
  row.change = row.value - before.value;
  if (!before.change || std::abs(*row.change) <= negligible * std::abs(row.value)) return;
  const double ratio = *before.change / *row.change;
  if (!(ratio > 0.0)) return;
  row.observed_order = std::log2(ratio);
  if (*row.observed_order > 0.0) row.richardson_estimate = row.value + *row.change / (ratio - 1.0);
}

}  // namespace

std::vector<ConvergenceRow> convergence_rows(const std::vector<InflationResult>& results) {
  std::vector<ConvergenceRow> rows;
  if (results.empty() || results.front().path.points.empty()) return rows;
  const std::size_t count = observables_of(results.front()).size();
  for (std::size_t o = 0; o < count; ++o) {
    for (std::size_t r = 0; r < results.size(); ++r) {
      const InflationResult& result = results[r];
      const bool is_comparable =
          !result.path.points.empty() && result.path.points.back().s == results.front().path.points.back().s;
      if (!is_comparable) break;
      const auto [name, value] = observables_of(result)[o];
      ConvergenceRow row{name, static_cast<int>(r), result.element_size_m, result.elements, result.unknowns, value, {}, {}, {}};
      if (r > 0) extrapolate(row, rows.back());
      rows.push_back(row);
    }
  }
  return rows;
}

io::CsvTable convergence_table(const std::vector<ConvergenceRow>& rows) {
  io::CsvTable table({"observable", "refinement", "element_size_m", "elements", "unknowns", "value", "change", "observed_order",
                      "richardson_estimate"});
  for (const ConvergenceRow& row : rows) {
    table.add_row(row.observable, row.refinement, row.element_size_m, static_cast<std::uint64_t>(row.elements),
                  static_cast<std::uint64_t>(row.unknowns), row.value, row.change, row.observed_order, row.richardson_estimate);
  }
  return table;
}

io::PictureOutcome draw_convergence(const std::filesystem::path& file, const std::vector<ConvergenceRow>& rows) {
  io::ChartPanel panel;
  panel.x = {.title = "element size (mm)", .logarithmic = true};
  panel.y = {.title = "difference from the estimated limit / this limit", .logarithmic = true};
  bool is_whole = true;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && rows[end].observable == rows[first].observable) ++end;
    const ConvergenceRow& finest = rows[end - 1];
    const double limit = finest.richardson_estimate.value_or(finest.value);
    const double scale = std::abs(limit);
    io::ChartSeries series{.name = finest.observable, .marks = io::Marks::line_and_points, .dashed = !finest.richardson_estimate};
    for (std::size_t r = first; r < end; ++r) {
      const double difference = std::abs(rows[r].value - limit);
      if (!(difference > negligible * scale) || difference > scale) {
        is_whole = is_whole && difference <= negligible * scale;
        continue;
      }
      series.x.push_back(1e3 * rows[r].element_size_m);
      series.y.push_back(difference / scale);
    }
    // with two meshes one is the limit; with more, a single point is left of an observable that is zero by symmetry
    const std::size_t fewest = end - first <= 2 ? 1 : 2;
    if (series.x.size() == 1) series.marks = io::Marks::points;
    if (series.x.size() >= fewest) panel.series.push_back(std::move(series));
    first = end;
  }
  if (!is_whole) panel.y.title += "; those above 1 are left out";
  const io::Chart chart{.title = "convergence (orders near re-entrant edges are observed, not asserted)", .panels = {panel}};
  return io::write_chart(file, chart, {.width_px = 1300, .height_px = 1000});
}

std::vector<InflationResult> run_convergence(const InflationStudy& study, int refinements, const std::filesystem::path& folder,
                                             const InflationOptions& options, const std::function<void(int)>& begun) {
  if (study.has_thin_walls() && refinements > 0)
    throw io::InputError(study.file.string() +
                         ": elements.kind \"thin_wall\": walls of one element are not split; compare fidelities");
  on_every_rank(options.communicator, [&] {  // before the coarse meshes are computed
    InflationStudy finest = study;
    finest.refinements += refinements;
    require_memory(finest, make_problem(study).mesh);
  });
  on_first_rank(options.communicator, [&] { io::remove_files(folder, {"convergence.csv", "convergence.png"}); });
  std::vector<InflationResult> results;
  for (int n = 0; n <= refinements; ++n) {
    if (begun) begun(n);
    InflationStudy finer = study;
    finer.refinements += n;
    results.push_back(run_inflation(finer, folder / ("refinement_" + std::to_string(n)), options));
    if (results.back().path.status != io::RunStatus::completed) break;
  }
  on_first_rank(options.communicator, [&] {
    const std::vector<ConvergenceRow> rows = convergence_rows(results);
    convergence_table(rows).write(folder / "convergence.csv");
    if (!study.output.pictures) return;
    const io::PictureOutcome picture = draw_convergence(folder / "convergence.png", rows);
    if (!picture.written) results.back().notes.push_back("no plot of convergence: " + picture.missing);
  });
  return results;
}

}  // namespace menger::fem
