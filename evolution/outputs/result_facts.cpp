#include "evolution/outputs/result_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "evolution/findings/inflation_result.h"
#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/search_tables.h"
#include "evolution/posture/fall.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/run_status_words.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

std::vector<std::string> lines_of(const io::TomlTable& table, const char* key) {
  return table.has(key) ? table.texts(key) : std::vector<std::string>();
}

InflationFacts inflation_facts(const CommandOutput& output) {
  InflationFacts facts{
      .name = body_or_place(output), .place = output.name, .source = file_of(output, "result.toml"), .stated = output.stated};
  const io::TomlTable result = io::read_toml(output.folder / "result.toml");
  facts.status = result.word("status", io::run_status_words());
  facts.reason = result.text_or("reason", "");
  facts.limit = meshes::limit_pressure(result);
  const io::CsvContents curves = io::read_csv(output.folder / "curves.csv");
  std::optional<std::size_t> highest;
  std::optional<std::size_t> lowest;
  for (const std::string& column : curves.columns()) {
    if (!column.ends_with("_pressure_Pa")) continue;
    ++facts.plena;
    for (std::size_t row = 0; row < curves.row_count(); ++row) {
      const auto pressure_Pa = number_in(curves, row, column);
      if (pressure_Pa && (!facts.lowest_pressure_Pa || *pressure_Pa < *facts.lowest_pressure_Pa)) {
        facts.lowest_pressure_Pa = pressure_Pa;
        lowest = row;
      }
      if (!pressure_Pa || (facts.highest_pressure_Pa && *pressure_Pa <= *facts.highest_pressure_Pa)) continue;
      facts.highest_pressure_Pa = pressure_Pa;
      highest = row;
    }
  }
  facts.last_pressure_Pa = last_pressure_Pa(curves);
  if (const auto bend = bend_of(output)) facts.sideways_m = bend->sideways_m;
  for (const std::string& column : curves.columns()) {
    if (!column.ends_with("_volume_m3") || !highest) continue;
    const auto at_rest = number_in(curves, 0, column);
    const auto now = number_in(curves, *facts.highest_pressure_Pa > 0.0 ? *highest : lowest.value_or(*highest), column);
    if (at_rest && now && *at_rest > 0.0)
      facts.volume_growth = std::max(facts.volume_growth.value_or(-1.0), *now / *at_rest - 1.0);
  }
  return facts;
}

CalibrationFacts calibration_facts(const CommandOutput& output) {
  CalibrationFacts facts{.source = file_of(output, "residuals.csv"), .reason = {}};
  const io::TomlTable fit = io::read_toml(output.folder / "result.toml").table("fit");
  facts.status = fit.word("status", io::run_status_words());
  facts.reason = fit.text_or("reason", "");
  facts.explained = fit.boolean_or("explained", true);
  const io::CsvContents residuals = io::read_csv(output.folder / "residuals.csv");
  std::vector<double> errors;
  std::set<std::string> cases;
  for (std::size_t row = 0; row < residuals.row_count(); ++row) {
    const auto error = number_in(residuals, row, "relative");
    if (!error) continue;
    cases.insert(text_in(residuals, row, "case"));
    errors.push_back(*error);
    if (facts.worst_error && *error <= *facts.worst_error) continue;
    facts.worst_error = error;
    facts.worst_case = text_in(residuals, row, "case") + ", " + io::shown_column(text_in(residuals, row, "ordinate")).title();
  }
  facts.cases = cases.size();
  facts.quantities = errors.size();
  facts.median_error = median_of(errors);
  return facts;
}

std::size_t count_in(const io::CsvContents& table, std::size_t row, const char* column) {
  return static_cast<std::size_t>(std::max(0.0, number_in(table, row, column).value_or(0.0)));
}

/// Why numbers of a validation lie outside the range of validity, for people.
std::vector<std::string> reasons_outside(const io::CsvContents& errors) {
  const std::array<std::pair<const char*, const char*>, 4> words{{{"chambers", "its chambers are not those of the fit"},
                                                                  {"size", "it is longer than the bodies of the fit"},
                                                                  {"pressure", "its pressures are beyond those of the fit"},
                                                                  {"strain", "it strains more than the fit has seen"}}};
  std::vector<std::string> reasons;
  for (const auto& [validity, reason] : words) {
    bool is_there = false;
    for (std::size_t row = 0; row < errors.row_count(); ++row)
      is_there = is_there || text_in(errors, row, "validity") == validity;
    if (is_there) reasons.emplace_back(reason);
  }
  return reasons;
}

ValidationFacts validation_facts(const CommandOutput& output, const CommandOutput* loop) {
  const auto name_of = [&](const std::string& body) { return name_in_validation(body, output, loop); };
  ValidationFacts facts{.source = file_of(output, "summary.csv"), .displacement = {}, .volume = {}};
  const io::CsvContents summary = io::read_csv(output.folder / "summary.csv");
  std::set<std::string> bodies;
  for (std::size_t row = 0; row < summary.row_count(); ++row) {
    const std::string kind = text_in(summary, row, "kind");
    if (text_in(summary, row, "body") != "all") {
      bodies.insert(text_in(summary, row, "body"));
      continue;
    }
    if (text_in(summary, row, "range") != "inside") {
      facts.outside += count_in(summary, row, "count") + count_in(summary, row, "without_equilibrium");
      if (kind == "displacement") facts.displacement_outside = number_in(summary, row, "median");
      if (kind == "volume") facts.volume_outside = number_in(summary, row, "median");
      continue;
    }
    if (kind != "displacement" && kind != "volume") continue;
    (kind == "volume" ? facts.volume : facts.displacement) =
        ErrorFact{.count = count_in(summary, row, "count"),
                  .without_equilibrium = count_in(summary, row, "without_equilibrium"),
                  .median = number_in(summary, row, "median"),
                  .percentile_90 = number_in(summary, row, "percentile_90"),
                  .worst = number_in(summary, row, "worst"),
                  .worst_body = name_of(text_in(summary, row, "worst_body")),
                  .worst_observable = io::displacement_words(text_in(summary, row, "worst_observable")),
                  .median_m = number_in(summary, row, "median_m"),
                  .worst_m = number_in(summary, row, "worst_m"),
                  .furthest_m = number_in(summary, row, "furthest_m"),
                  .furthest_error = number_in(summary, row, "furthest_error"),
                  .furthest_body = name_of(text_in(summary, row, "furthest_body")),
                  .furthest_observable = io::displacement_words(text_in(summary, row, "furthest_observable"))};
  }
  facts.bodies = bodies.size();
  if (const std::filesystem::path curve = output.folder / "curves/robot_inflation.toml"; io::is_file(curve)) {
    const io::TomlTable ended = io::read_toml(curve);
    if (const std::string status = ended.text("status"); status != "completed")
      facts.early_end = status + ", " + ended.text_or("reason", "no reason");
  }
  if (const std::filesystem::path errors = output.folder / "errors.csv"; io::is_file(errors))
    facts.outside_why = reasons_outside(io::read_csv(errors));
  const std::filesystem::path signs_file = output.folder / "signs.csv";
  if (!io::is_file(signs_file)) return facts;
  const io::CsvContents signs = io::read_csv(signs_file);
  for (std::size_t row = 0; row < signs.row_count(); ++row) {
    // Of one body all count, as the loop does; of several only what the fit covers, as with their medians.
    if (facts.bodies > 1 && signs.has("range") && text_in(signs, row, "range") != "inside") continue;
    facts.signs += count_in(signs, row, "count");
    const std::size_t wrong = count_in(signs, row, "wrong");
    facts.wrong_signs += wrong;
    if (wrong == 0) continue;
    std::string way = facts.bodies > 1 ? name_of(text_in(signs, row, "body")) + " " : "";
    way += io::shown_column(text_in(signs, row, "observable")).quantity + " (" + std::to_string(wrong) + " of " +
           text_in(signs, row, "count") + ")";
    facts.wrong_ways.push_back(std::move(way));
  }
  return facts;
}

/// How far a walk goes along the line from its start to its end, how far it comes back, and how far it goes in any direction.
void add_progress(const CommandOutput& output, const std::vector<double>& moved_m, WalkFacts& facts) {
  const double end_m = std::hypot(moved_m[0], moved_m[1]);
  const std::filesystem::path file = output.folder / "trajectory.csv";
  if (!facts.body_lengths || !(end_m > 0.0) || !io::is_file(file)) return;
  facts.end_m = end_m;
  const double lengths_per_m = *facts.body_lengths / end_m;
  const io::CsvContents trajectory = io::read_csv(file);
  const std::vector<double> progress_m = progress_of(trajectory);
  for (const double at_m : progress_m) {
    if (!std::isfinite(at_m)) continue;
    const double lengths = lengths_per_m * at_m;
    facts.lowest_lengths = std::min(facts.lowest_lengths.value_or(lengths), lengths);
    facts.highest_lengths = std::max(facts.highest_lengths.value_or(lengths), lengths);
  }
  facts.retreat_lengths = lengths_per_m * largest_retreat(progress_m);
  for (const double at_m : distance_from_start(trajectory))
    if (std::isfinite(at_m)) facts.farthest_m = std::max(facts.farthest_m.value_or(at_m), at_m);
  if (facts.farthest_m) facts.farthest_lengths = lengths_per_m * *facts.farthest_m;
}

/// Whether the body falls over in its walk, as far as its frames tell.
void add_fall(const CommandOutput& output, WalkFacts& facts) {
  if (!output.stated.frequency_Hz || !(*output.stated.frequency_Hz > 0.0)) return;
  try {
    if (const auto fall = fall_in_walk(output.folder, 1.0 / *output.stated.frequency_Hz)) facts.fell_s = fall->time_s;
  } catch (const io::InputError&) {
    // The walk is known without its frames; what shows them in 3-D says that they cannot be read.
  }
}

WalkFacts walk_facts(const CommandOutput& output) {
  const bool on_elements = command_of(output) == "locomote";
  const char* file = on_elements ? "locomotion.toml" : "result.toml";
  WalkFacts facts{.name = body_or_place(output),
                  .place = output.name,
                  .source = file_of(output, file),
                  .model = on_elements ? WalkModel::elements : WalkModel::voxels,
                  .reason = {},
                  .stated = output.stated};
  const io::TomlTable result = io::read_toml(output.folder / file);
  facts.status = result.word("status", io::run_status_words());
  facts.reason = result.text_or("reason", "");
  facts.time_s = result.number("time_s", io::non_negative());
  facts.body_lengths = result.optional_number("horizontal_displacement_body_lengths");
  if (facts.body_lengths && facts.time_s > 0.0) facts.per_minute = 60.0 * *facts.body_lengths / facts.time_s;
  if (result.has("displacement_m")) {
    const std::vector<double> moved_m = result.numbers("displacement_m");
    if (moved_m.size() == 3) {
      facts.direction_deg = meshes::direction_deg(moved_m[0], moved_m[1]);
      add_progress(output, moved_m, facts);
    }
  }
  add_fall(output, facts);
  if (const auto surrogate = result.optional_table("surrogate")) {
    facts.model = WalkModel::surrogate;
    facts.expected_error = lines_of(*surrogate, "expected_error");
    facts.outside_validity = lines_of(*surrogate, "outside_validity");
  }
  return facts;
}

RankingFacts ranking_facts(const CommandOutput& output) {
  RankingFacts facts{.source = file_of(output, "ranking.csv"), .best_design = {}};
  if (compares_elements_of_search(nlohmann::json::parse(output.parameters, nullptr, false))) facts.compared_with = "the search";
  const io::CsvContents designs = io::read_csv(output.folder / "reevaluation.csv");
  facts.designs = designs.row_count();
  std::vector<double> errors;
  for (std::size_t row = 0; row < designs.row_count(); ++row) {
    if (const auto error = number_in(designs, row, "surrogate_relative_error")) errors.push_back(*error);
    const auto speed = number_in(designs, row, "elements_body_lengths_per_minute");
    if (speed && number_in(designs, row, "surrogate_body_lengths_per_minute")) ++facts.compared;
    if (!speed || (facts.best_per_minute && *speed <= *facts.best_per_minute)) continue;
    facts.best_per_minute = speed;
    facts.best_design = "rank " + text_in(designs, row, "rank") + " of the search";
  }
  facts.median_error = median_of(errors);
  const io::CsvContents ranking = io::read_csv(output.folder / "ranking.csv");
  for (std::size_t row = 0; row < ranking.row_count(); ++row) {
    if (text_in(ranking, row, "designs") != "all") continue;
    const auto value = number_in(ranking, row, "value");
    const std::string quantity = text_in(ranking, row, "quantity");
    if (quantity == "spearman" && value)
      facts.spearman = IntervalFact{*value, number_in(ranking, row, "low_95"), number_in(ranking, row, "high_95")};
    if (quantity == "direction_within_45_deg" && value) {
      facts.within_45_deg = count_in(ranking, row, "count");
      facts.with_direction = count_in(ranking, row, "of");
    }
  }
  return facts;
}

/// @param unit in the names of columns
std::vector<ConfirmedWalk> confirmed_walks(const io::CsvContents& table, const std::string& unit) {
  std::vector<ConfirmedWalk> walks;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    walks.push_back({.rank = text_in(table, row, "rank"),
                     .individual = text_in(table, row, "individual"),
                     .fitness = number_in(table, row, "fitness_" + unit),
                     .elements = text_in(table, row, "fidelity"),
                     .score = number_in(table, row, "score_" + unit),
                     .angle_deg = number_in(table, row, "angle_deg"),
                     .reason = text_in(table, row, "reason")});
  }
  return walks;
}

SearchFacts search_facts(const CommandOutput& output, const std::vector<CommandOutput>& outputs) {
  const SearchTables tables = read_search_tables(output, outputs);
  SearchFacts facts{.source = tables.source, .unit = {}};
  const io::CsvContents& generations = tables.generations;
  facts.generations = generations.row_count();
  const std::string fitness = fitness_column(generations);
  facts.unit = fitness_unit(tables);
  double evaluations = 0.0;
  for (std::size_t row = 0; row < generations.row_count(); ++row) {
    const auto value = number_in(generations, row, fitness);
    if (value && !facts.first_fitness) {
      facts.first_fitness = value;
      facts.first_generation = text_in(generations, row, "generation");
    }
    if (value) {
      facts.last_fitness = value;
      facts.last_generation = text_in(generations, row, "generation");
    }
    evaluations += number_in(generations, row, "evaluations").value_or(0.0);
  }
  facts.evaluations = evaluations;
  const std::string before_unit = "best_fitness_";
  if (tables.confirmed && fitness.starts_with(before_unit))
    facts.confirmed = confirmed_walks(*tables.confirmed, fitness.substr(before_unit.size()));
  if (facts.last_fitness && tables.walk_over_fitness)
    facts.is_walk = *facts.last_fitness * *tables.walk_over_fitness >= meshes::walk_limits::least_body_lengths;
  return facts;
}

ModesFacts modes_facts(const CommandOutput& output) {
  ModesFacts facts{.source = file_of(output, "modes.csv")};
  facts.status = io::read_toml(output.folder / "result.toml").word("status", io::run_status_words());
  const io::CsvContents modes = io::read_csv(output.folder / "modes.csv");
  if (modes.row_count() > 0) facts.first_frequency_Hz = number_in(modes, 0, "frequency_Hz");
  return facts;
}

}  // namespace

const char* to_string(WalkModel model) {
  switch (model) {
    case WalkModel::elements:
      return "finite elements";
    case WalkModel::surrogate:
      return "the surrogate";
    case WalkModel::voxels:
      return "voxels";
  }
  return "";
}

std::optional<Bend> bend_of(const CommandOutput& inflation) {
  if (inflation.stated.supports != "free" || !inflation.stated.body) return std::nullopt;
  try {
    return bend_in_inflation(inflation.folder, inflation.stated.body->cell_edge_m);
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

ReportFacts read_facts(const std::vector<CommandOutput>& outputs, std::vector<std::string>& notes) {
  ReportFacts facts;
  if (const CommandOutput* loop = loop_of(outputs)) facts.robot_walks = loop->robot_walks;
  const std::vector<const CommandOutput*> searches = searches_in(outputs);
  for (const CommandOutput& output : outputs) {
    const std::string command = command_of(output);
    if (const std::string file = parameters_of_menger(output);
        !file.empty() && std::ranges::find(facts.shipped, file, &ShippedParameters::file) == facts.shipped.end())
      facts.shipped.push_back({.file = file, .source = file_of(output, output.manifest.filename().string())});
    try {
      if (command == "inflate") facts.inflations.push_back(inflation_facts(output));
      if (command == "calibrate") facts.calibrations.push_back(calibration_facts(output));
      if (command == "validate") facts.validations.push_back(validation_facts(output, loop_of(outputs)));
      if (command == "simulate" || command == "locomote") facts.walks.push_back(walk_facts(output));
      if (command == "reevaluate") facts.rankings.push_back(ranking_facts(output));
      if (std::ranges::find(searches, &output) != searches.end()) facts.searches.push_back(search_facts(output, outputs));
      if (command == "modes") facts.modes.push_back(modes_facts(output));
    } catch (const io::InputError& error) {
      notes.emplace_back(error.what());
    }
  }
  return facts;
}

}  // namespace menger::evolution
