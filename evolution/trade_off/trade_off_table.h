#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/text/csv_table.h"

namespace menger::evolution {

/// One run at one fidelity: its results and its cost.
struct TradeRow {
  std::string model;                              ///< "finite elements" or "voxels"
  std::string label;                              ///< the fidelity for people
  std::map<std::string, std::string> fidelity{};  ///< by column, without the columns of the other model
  std::vector<std::optional<double>> values{};    ///< by observable; none if the run did not get so far

  /// Relative errors by observable: |value - value of the reference|, divided by the scale of error_scales. So an observable that
  /// barely changes need not be more exact than the others. Those of the reference itself are the estimates that reference() was
  /// given, rescaled in the same way.
  std::vector<std::optional<double>> errors{};
  std::optional<double> error{};  ///< the largest of the errors; none if one that counts is missing

  std::optional<double> seconds{};  ///< wall time
  std::optional<double> cpu_seconds{};
  /// Largest resident memory of the process that ran, in 1e6 bytes, as the kernel counts it: with code and libraries, and never
  /// less than the memory of this program when it started the run.
  std::optional<double> peak_megabytes{};
  std::optional<std::uint64_t> unknowns{};
  std::optional<std::uint64_t> voxels{};
  std::optional<std::uint64_t> steps{};  ///< time steps, or Newton iterations

  /// A word of io::RunStatus, "skipped" (never run) or "failed" (the program did not give a result).
  std::string status = "skipped";
  std::string reason{};     ///< why it did not complete, or a remark on the result
  bool is_refused = false;  ///< failed because the program refused its input

  /// What was outside the range of validity of the voxel parameters, a sentence each. None for a run without such parameters.
  std::optional<std::vector<std::string>> outside_validity{};

  [[nodiscard]] bool is_outside() const { return outside_validity && !outside_validity->empty(); }
};

/// The runs of one comparison at all fidelities, in the order in which the study has them.
struct TradeTable {
  std::vector<std::string> observables;       ///< names with units, different from the names of fidelities
  std::vector<std::string> fidelity_columns;  ///< of both models
  std::vector<TradeRow> rows{};
  std::optional<std::size_t> reference{};  ///< the finest row that completed

  /// Estimated errors of the reference itself by observable, relative in the same way as the errors of rows; none without an
  /// estimate.
  std::vector<std::optional<double>> reference_errors{};
  std::optional<double> reference_error{};  ///< the largest of these; none if an observable that counts has none

  /// Whether the processor time of all runs is known, which other work on the machine changes less than their wall time.
  [[nodiscard]] bool has_processor_times() const {
    return std::ranges::all_of(rows, [](const TradeRow& row) { return !row.seconds || row.cpu_seconds; });
  }
  /// What a run costs, s: processor time if that of all is known, or else wall time.
  [[nodiscard]] std::optional<double> cost_s(const TradeRow& row) const {
    return has_processor_times() ? row.cpu_seconds : row.seconds;
  }
};

/// Returns, by observable, the scale of relative changes and errors: the magnitude of its value, but at least a tenth of the
/// largest magnitude of the same unit (lengths have names that end with _m; all others share a unit). Zero if there is no value,
/// or if all values of its unit are zero.
std::vector<double> error_scales(const std::vector<std::string>& observables, const std::vector<std::optional<double>>& values);

/// Sets the reference of a table and the errors of all rows. An observable does not count if its scale is zero: the reference has
/// no value, or nothing of its unit moves.
/// @param reference position of the reference among the rows
/// @param reference_errors by observable, relative to the reference's value itself
void compare_with_reference(TradeTable& table, std::size_t reference, std::vector<std::optional<double>> reference_errors);

/// Returns the rows that no other row beats in both cost and error, by ascending cost; of equals the first. An error below
/// the reference's own error counts as that error, because smaller ones cannot be told apart. A gain of less than a hundredth of
/// the error does not count, because it may differ on another computer.
std::vector<std::size_t> pareto_front(const TradeTable& table);

/// The cheapest run that is accurate enough.
struct Recommendation {
  double target = 0.0;             ///< relative error
  std::optional<std::size_t> row;  ///< the cheapest whose error, as pareto_front counts it, is at most the target
};
std::vector<Recommendation> recommendations(const TradeTable& table, const std::vector<double>& targets);

/// Returns recommendations as text for people, a line each: "for 5 % you need ..., it costs 1.2 s of a core and 80 MB".
std::string recommendation_text(const TradeTable& table, const std::vector<double>& targets);

/// Returns recommendations as TOML: `[[recommendation]]` with target_relative_error, found, model, fidelity columns,
/// relative_error, reference_relative_error, seconds, cpu_seconds, peak_memory_MB, and outside_validity if it is true. @param
/// table_name in place of `recommendation`
std::string recommendation_toml(const TradeTable& table, const std::vector<double>& targets, const std::string& table_name);

/// Makes a table of all rows: model, fidelity columns, observables, their relative errors, cost, role (reference, on the front),
/// validity of calibrated voxels ("inside" or "outside"; the reason says why), status, reason.
io::CsvTable trade_csv(const TradeTable& table);

}  // namespace menger::evolution
