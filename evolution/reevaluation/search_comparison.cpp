#include "evolution/reevaluation/search_comparison.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::array models{EvaluationModel::voxels, EvaluationModel::finite_elements, EvaluationModel::both};

void read_reevaluation(const fs::path& folder, double rate, ComparedSearch& search) {
  const fs::path own = folder / "reevaluated/reevaluation.csv";
  const fs::path beside = folder / "reevaluation.csv";  // as in former versions
  const fs::path file = io::is_file(own) ? own : beside;
  if (!io::is_file(file)) {
    throw io::InputError(folder.string() + ": has no reevaluation.csv: give menger reevaluate -o " +
                         (folder / "reevaluated").string());
  }
  const io::CsvContents table = io::read_csv(file);
  io::note_input(search.inputs, file);
  double spent = search.voxel_steps + rate * search.element_steps;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    ComparedRobot robot{.body_lengths = table.optional_number(row, "elements_body_lengths"),
                        .search_body_lengths = table.optional_number(row, "surrogate_body_lengths").value_or(0.0),
                        .element_steps = table.number(row, "elements_steps", io::non_negative()) *
                                         table.number(row, "elements_count", io::non_negative())};
    spent += rate * robot.element_steps;
    robot.total_voxel_steps = spent;
    search.robots.push_back(robot);
  }
}

/// Returns the best result so far against the cost, as a staircase.
io::ChartSeries progress_of(const ComparedSearch& search) {
  io::ChartSeries series{.marks = io::Marks::line, .colour = io::chart_colour(static_cast<std::size_t>(search.model))};
  std::optional<double> best;
  const auto add = [&](double steps) {
    if (!best) return;
    series.x.push_back(steps);
    series.y.push_back(*best);
  };
  for (const ComparedRobot& robot : search.robots) {
    add(robot.total_voxel_steps);
    if (robot.body_lengths) best = std::max(best.value_or(0.0), *robot.body_lengths);
    add(robot.total_voxel_steps);
  }
  return series;
}

std::optional<double> median_outcome(const std::vector<ComparedSearch>& searches, EvaluationModel model) {
  std::vector<double> outcomes;
  for (const ComparedSearch& search : searches) {
    if (search.model == model && search.best()) outcomes.push_back(*search.best()->body_lengths);
  }
  if (outcomes.empty()) return std::nullopt;
  std::ranges::sort(outcomes);
  const std::size_t middle = outcomes.size() / 2;
  return outcomes.size() % 2 == 1 ? outcomes[middle] : 0.5 * (outcomes[middle - 1] + outcomes[middle]);
}

double total_of(const ComparedSearch& search, const ComparisonOptions& options) {
  return search.voxel_steps + options.voxel_steps_per_element_step * (search.element_steps + search.reevaluation_element_steps);
}

}  // namespace

std::optional<ComparedRobot> ComparedSearch::best() const {
  const auto found = std::ranges::max_element(robots, {}, &ComparedRobot::body_lengths);
  return found == robots.end() || !found->body_lengths ? std::nullopt : std::optional(*found);
}

ComparedSearch read_compared_search(const fs::path& folder, const ComparisonOptions& options) {
  ComparedSearch search;
  search.name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  const io::CsvContents costs = io::read_csv(folder / "costs.csv");
  io::note_input(search.inputs, folder / "costs.csv");
  for (const double steps : costs.numbers("voxel_steps", io::non_negative())) search.voxel_steps += steps;
  for (const double steps : costs.numbers("element_steps", io::non_negative())) search.element_steps += steps;
  if (search.element_steps > 0.0)
    search.model = search.voxel_steps > 0.0 ? EvaluationModel::both : EvaluationModel::finite_elements;
  read_reevaluation(folder, options.voxel_steps_per_element_step, search);
  double left = options.budget_element_steps;
  const auto beyond = std::ranges::find_if(search.robots, [&](const ComparedRobot& robot) {
    left -= robot.element_steps;
    return left < 0.0;
  });
  search.robots.erase(beyond, search.robots.end());
  for (const ComparedRobot& robot : search.robots) search.reevaluation_element_steps += robot.element_steps;
  return search;
}

io::CsvTable comparison_table(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options) {
  io::CsvTable table({"search", "model", "evaluated", "failed", "voxel_steps", "element_steps", "reevaluation_element_steps",
                      "total_voxel_steps", "best_body_lengths", "search_body_lengths_of_best"});
  for (const ComparedSearch& search : searches) {
    const auto best = search.best();
    const auto failed = std::ranges::count_if(search.robots, [](const ComparedRobot& robot) { return !robot.body_lengths; });
    table.add_row(search.name, to_string(search.model), std::uint64_t{search.robots.size()}, static_cast<std::int64_t>(failed),
                  search.voxel_steps, search.element_steps, search.reevaluation_element_steps, total_of(search, options),
                  best ? best->body_lengths : std::nullopt, best ? std::optional(best->search_body_lengths) : std::nullopt);
  }
  return table;
}

io::Chart comparison_chart(const std::vector<ComparedSearch>& searches) {
  io::ChartPanel progress{.title = "best robot evaluated so far",
                          .x = {.title = "total cost with element-steps (1e9 voxel-steps)"},
                          .y = {.title = "distance on finite elements (body lengths)", .lowest = 0.0}};
  io::ChartPanel outcomes{.title = "outcome of each search",
                          .x = {.title = "number of the search of its model, in the order given", .lowest = 0.5},
                          .y = {.title = "distance on finite elements (body lengths)", .lowest = 0.0}};
  constexpr double steps_per_unit = 1e9;
  std::array<io::ChartSeries, models.size()> points;
  for (const ComparedSearch& search : searches) {
    io::ChartSeries line = progress_of(search);
    for (double& x : line.x) x /= steps_per_unit;
    io::ChartSeries& kind = points.at(static_cast<std::size_t>(search.model));
    if (kind.name.empty()) line.name = to_string(search.model);
    kind.name = to_string(search.model);
    kind.marks = io::Marks::points;
    kind.colour = line.colour;
    kind.x.push_back(static_cast<double>(kind.x.size() + 1));
    kind.y.push_back(search.best() ? *search.best()->body_lengths : std::numeric_limits<double>::quiet_NaN());
    progress.series.push_back(std::move(line));
  }
  std::size_t most = 1;
  for (io::ChartSeries& kind : points) {
    most = std::max(most, kind.x.size());
    if (!kind.x.empty()) outcomes.series.push_back(std::move(kind));
  }
  outcomes.x.highest = static_cast<double>(most) + 0.5;
  return {.title = "searches on voxels, on finite elements, and on both", .panels = {progress, outcomes}};
}

std::string comparison_text(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options) {
  std::string text;
  text +=
      io::formatted("%-20s %-16s %9s %14s %14s %12s\n", "search", "model", "evaluated", "total steps", "best [BL]", "in search");
  for (const ComparedSearch& search : searches) {
    const auto best = search.best();
    text += io::formatted("%-20.40s %-16s %9zu %14.4g %14s %12s\n", search.name.c_str(),
                          std::string(to_string(search.model)).c_str(), search.robots.size(), total_of(search, options),
                          best ? io::formatted("%.5f", *best->body_lengths).c_str() : "-",
                          best ? io::formatted("%.5f", best->search_body_lengths).c_str() : "-");
  }
  for (const EvaluationModel model : models) {
    if (const auto median = median_outcome(searches, model))
      text += "median outcome of searches on " + std::string(to_string(model)) + ": " + io::formatted("%.5f", *median) + "\n";
  }
  return text;
}

}  // namespace menger::evolution
