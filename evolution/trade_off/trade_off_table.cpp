#include "evolution/trade_off/trade_off_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "io/process/progress.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"

namespace menger::evolution {
namespace {

constexpr double smallest_share = 0.1;  ///< of the largest observable of a unit: the least scale of an error

bool is_length(const std::string& observable) { return observable.ends_with("_m"); }

/// Returns the largest of the errors that count; none if one of these is missing or none counts.
std::optional<double> largest_error(const std::vector<std::optional<double>>& errors, const std::vector<double>& scale) {
  std::optional<double> largest;
  for (std::size_t n = 0; n < scale.size(); ++n) {
    if (scale[n] == 0.0) continue;
    if (!errors[n]) return std::nullopt;
    largest = std::max(largest.value_or(0.0), *errors[n]);
  }
  return largest;
}

/// Returns the rows that have an error and a cost, the cheapest first; of equally cheap ones the one with the smaller error
/// first.
std::vector<std::size_t> by_cost(const TradeTable& table) {
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < table.rows.size(); ++n) {
    if (table.rows[n].error && table.cost_s(table.rows[n])) order.push_back(n);
  }
  std::ranges::stable_sort(order, {},
                           [&](std::size_t n) { return std::pair(*table.cost_s(table.rows[n]), *table.rows[n].error); });
  return order;
}

/// Returns the error of a row, but at least the error of the reference. Precondition: the row has an error.
double known_error(const TradeTable& table, std::size_t n) {
  return std::max(*table.rows[n].error, table.reference_error.value_or(0.0));
}

std::string cost_text(const TradeTable& table, const TradeRow& row) {
  const double cost_s = table.cost_s(row).value_or(0.0);
  std::string text = cost_s < 10.0 ? io::shown(cost_s, 2) + " s" : io::duration_text(cost_s);
  if (table.has_processor_times()) text += " of a core";
  if (row.peak_megabytes) text += " and " + io::formatted("%.0f", *row.peak_megabytes) + " MB";
  return text;
}

/// Returns the reason of a row and what was outside the range of validity.
std::string reason_text(const TradeRow& row) {
  std::string text = row.reason;
  const char* before = text.empty() ? "outside the range of validity: " : "; outside the range of validity: ";
  for (const std::string& fault : row.outside_validity.value_or(std::vector<std::string>{})) {
    text.append(before).append(fault);
    before = "; ";
  }
  return text;
}

io::CsvCell count_cell(const std::optional<std::uint64_t>& count) { return count ? io::cell(*count) : io::CsvCell{}; }

}  // namespace

std::vector<double> error_scales(const std::vector<std::string>& observables, const std::vector<std::optional<double>>& values) {
  assert(observables.size() == values.size());
  std::vector<double> all;
  for (std::size_t n = 0; n < observables.size(); ++n) {
    double largest = 0.0;
    for (std::size_t other = 0; other < observables.size(); ++other) {
      const bool same_unit = is_length(observables[other]) == is_length(observables[n]);
      if (same_unit && values[other]) largest = std::max(largest, std::abs(*values[other]));
    }
    all.push_back(values[n] ? std::max(std::abs(*values[n]), smallest_share * largest) : 0.0);
  }
  return all;
}

void compare_with_reference(TradeTable& table, std::size_t reference, std::vector<std::optional<double>> reference_errors) {
  assert(reference < table.rows.size() && reference_errors.size() == table.observables.size());
  table.reference = reference;
  table.reference_errors = std::move(reference_errors);
  const TradeRow finest = table.rows[reference];
  const std::vector<double> scale = error_scales(table.observables, finest.values);
  for (std::size_t n = 0; n < scale.size(); ++n) {
    auto& error = table.reference_errors[n];
    if (error && scale[n] > 0.0) *error *= std::abs(*finest.values[n]) / scale[n];
  }
  table.reference_error = largest_error(table.reference_errors, scale);
  for (TradeRow& row : table.rows) {
    row.errors.assign(table.observables.size(), std::nullopt);
    for (std::size_t n = 0; n < table.observables.size(); ++n) {
      if (scale[n] == 0.0 || !row.values[n]) continue;
      row.errors[n] = std::abs(*row.values[n] - *finest.values[n]) / scale[n];
    }
    row.error = largest_error(row.errors, scale);
  }
  table.rows[reference].errors = table.reference_errors;
  table.rows[reference].error = table.reference_error;
}

std::vector<std::size_t> pareto_front(const TradeTable& table) {
  constexpr double least_gain = 0.01;
  std::vector<std::size_t> front;
  for (const std::size_t n : by_cost(table)) {
    if (front.empty() || known_error(table, n) < (1.0 - least_gain) * known_error(table, front.back())) front.push_back(n);
  }
  return front;
}

std::vector<Recommendation> recommendations(const TradeTable& table, const std::vector<double>& targets) {
  // All rows count, not the front alone: a row may meet the target by a gain that is too small for the front.
  const std::vector<std::size_t> order = by_cost(table);
  std::vector<Recommendation> found;
  for (const double target : targets) {
    const auto good = std::ranges::find_if(order, [&](std::size_t n) { return known_error(table, n) <= target; });
    found.push_back({target, good == order.end() ? std::nullopt : std::optional(*good)});
  }
  return found;
}

std::string recommendation_text(const TradeTable& table, const std::vector<double>& targets) {
  std::string text;
  if (table.reference) {
    text += "reference: " + table.rows[*table.reference].label;
    text += table.reference_error ? ", itself within about " + io::percents(*table.reference_error) + "\n"
                                  : "; its own error is not known\n";
  }
  const bool has_errors = std::ranges::any_of(table.rows, [](const TradeRow& row) { return row.error.has_value(); });
  if (!has_errors) return text + "no errors can be given: there is no reference that moved, or no other run\n";
  for (const Recommendation& response : recommendations(table, targets)) {
    text += "for " + io::percents(response.target) + " ";
    if (response.row) {
      const TradeRow& row = table.rows[*response.row];
      text += "you need " + row.model + ", " + row.label + " (" + io::percents(*row.error) +
              (response.row == table.reference ? " by its own estimate" : " from the reference") + "), it costs " +
              cost_text(table, row);
      if (row.is_outside()) text += ", outside the range of validity of its parameters";
    } else if (table.reference_error && *table.reference_error > response.target) {
      text += "no run is accurate enough: the reference itself is known to " + io::percents(*table.reference_error) + " only";
    } else {
      text += "no run is accurate enough";
    }
    text += "\n";
  }
  return text;
}

std::string recommendation_toml(const TradeTable& table, const std::vector<double>& targets, const std::string& table_name) {
  std::string text;
  for (const Recommendation& response : recommendations(table, targets)) {
    const auto add = [&](const std::string& key, const std::string& value) {
      text.append(key).append(" = ").append(value).append("\n");
    };
    text.append(text.empty() ? "[[" : "\n[[").append(table_name).append("]]\n");
    add("target_relative_error", io::number_text(response.target));
    add("found", response.row ? "true" : "false");
    if (!response.row) continue;
    const TradeRow& row = table.rows[*response.row];
    add("model", io::toml_quoted(row.model));
    for (const auto& [column, value] : row.fidelity) add(column, io::toml_quoted(value));
    add("relative_error", io::number_text(*row.error));
    if (table.reference_error) add("reference_relative_error", io::number_text(*table.reference_error));
    if (row.seconds) add("seconds", io::number_text(*row.seconds));
    if (row.cpu_seconds) add("cpu_seconds", io::number_text(*row.cpu_seconds));
    if (row.peak_megabytes) add("peak_memory_MB", io::number_text(*row.peak_megabytes));
    if (row.is_outside()) add("outside_validity", "true");
  }
  return text;
}

io::CsvTable trade_csv(const TradeTable& table) {
  std::vector<std::string> columns{"model"};
  columns.insert(columns.end(), table.fidelity_columns.begin(), table.fidelity_columns.end());
  columns.insert(columns.end(), table.observables.begin(), table.observables.end());
  for (const std::string& observable : table.observables) columns.push_back(observable + "_relative_error");
  for (const char* column : {"relative_error", "reference_relative_error", "seconds", "cpu_seconds", "peak_memory_MB", "unknowns",
                             "voxels", "steps", "role", "validity", "status", "reason"}) {
    columns.emplace_back(column);
  }
  const std::vector<std::size_t> front = pareto_front(table);
  io::CsvTable csv(columns);
  for (std::size_t n = 0; n < table.rows.size(); ++n) {
    const TradeRow& row = table.rows[n];
    std::vector<io::CsvCell> cells{io::cell(row.model)};
    for (const std::string& column : table.fidelity_columns) {
      const auto value = row.fidelity.find(column);
      cells.push_back(value == row.fidelity.end() ? io::CsvCell{} : io::cell(value->second));
    }
    for (std::size_t o = 0; o < table.observables.size(); ++o) cells.push_back(io::cell(row.values[o]));
    for (std::size_t o = 0; o < table.observables.size(); ++o)
      cells.push_back(o < row.errors.size() ? io::cell(row.errors[o]) : io::CsvCell{});
    for (const auto& value : {row.error, table.reference_error, row.seconds, row.cpu_seconds, row.peak_megabytes})
      cells.push_back(io::cell(value));
    for (const auto& count : {row.unknowns, row.voxels, row.steps}) cells.push_back(count_cell(count));
    std::string role = std::find(front.begin(), front.end(), n) != front.end() ? "front" : "";
    if (table.reference == n) role = role.empty() ? "reference" : "reference, front";
    cells.push_back(io::cell(role));
    cells.push_back(row.outside_validity ? io::cell(row.is_outside() ? "outside" : "inside") : io::CsvCell{});
    cells.push_back(io::cell(row.status));
    cells.push_back(io::cell(reason_text(row)));
    csv.add_cells(cells);
  }
  return csv;
}

}  // namespace menger::evolution
