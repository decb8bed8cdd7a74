#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/text/csv_table.h"

namespace menger::evolution {

/// One run at one fidelity: what it found and what it took.
struct TradeRow {
  std::string model;                              ///< "finite elements" or "voxels"
  std::string label;                              ///< the fidelity for people
  std::map<std::string, std::string> fidelity{};  ///< by column; columns of the other model are missing
  std::vector<std::optional<double>> values{};    ///< by observable; none where the run did not get there

  /// By observable: |value - reference| by the magnitude of the reference's value, but at least by a tenth of the largest one of
  /// the same unit: what barely moves need not be known better than the rest. The reference's own are what judge() is told.
  std::vector<std::optional<double>> errors{};
  std::optional<double> error{};  ///< the largest of them; none if one that the reference has is missing

  std::optional<double> seconds{};  ///< wall time
  std::optional<double> cpu_seconds{};
  /// Largest resident memory of the process that ran (1e6 bytes), as the kernel counts it: code and libraries included, and never
  /// less than this program had taken when it started the run.
  std::optional<double> peak_megabytes{};
  std::optional<std::uint64_t> unknowns{};
  std::optional<std::uint64_t> voxels{};
  std::optional<std::uint64_t> steps{};  ///< time steps, or Newton iterations

  /// A word of io::RunStatus, "skipped" (never run) or "failed" (the program did not give a result).
  std::string status = "skipped";
  std::string reason{};     ///< why it is not completed, or what to know of it
  bool is_refused = false;  ///< failed because the program called its input wrong

  /// What of the run lay beyond what the voxel parameters were fitted on, a sentence each; none for what has no such parameters.
  std::optional<std::vector<std::string>> outside_validity{};

  [[nodiscard]] bool is_outside() const { return outside_validity && !outside_validity->empty(); }
};

/// All fidelities of one question, in the order in which they were asked for.
struct TradeTable {
  std::vector<std::string> observables;       ///< names with their units, unlike the names of fidelities
  std::vector<std::string> fidelity_columns;  ///< of both models
  std::vector<TradeRow> rows{};
  std::optional<std::size_t> reference{};  ///< the finest row that completed

  /// By observable, relative as the errors of rows: how far the reference itself may be off; none where nothing tells.
  std::vector<std::optional<double>> reference_errors{};
  std::optional<double> reference_error{};  ///< the largest; none if an observable that counts has none
};

/// By observable: what changes and errors are relative to, the magnitude of its value, but at least a tenth of the largest one of
/// the same unit (names that end with _m, and others); zero where there is none, or nothing of its unit moves.
std::vector<double> error_scales(const std::vector<std::string>& observables, const std::vector<std::optional<double>>& values);

/// Sets the errors of all rows. An observable does not count where the reference has none, or nothing of its unit moves: there is
/// nothing to be relative to.
/// @param reference_errors by observable, relative to the reference's value itself
void judge(TradeTable& table, std::size_t reference, std::vector<std::optional<double>> reference_errors);

/// The rows that no other row beats in both seconds and error, by ascending seconds; of equals the first. Errors below the
/// reference's own count as that, since nothing tells them apart, and a gain of less than a hundredth of the error as none:
/// another computer would find it otherwise.
std::vector<std::size_t> pareto_front(const TradeTable& table);

/// Answer to "which is the cheapest that is good enough?".
struct Recommendation {
  double target = 0.0;             ///< relative error
  std::optional<std::size_t> row;  ///< the fastest whose error, as pareto_front counts it, is at most the target
};
std::vector<Recommendation> recommendations(const TradeTable& table, const std::vector<double>& targets);

/// Recommendations for people, a line each: "for 5 % you need ..., it costs 1.2 s and 80 MB".
std::string recommendation_text(const TradeTable& table, const std::vector<double>& targets);

/// The same as TOML: `[[recommendation]]` with target_relative_error, found, fidelity columns, relative_error, seconds,
/// peak_memory_MB, outside_validity where it holds. @param table_name in place of `recommendation`
std::string recommendation_toml(const TradeTable& table, const std::vector<double>& targets, const std::string& table_name);

/// All rows: model, fidelity columns, observables, their relative errors, cost, whether the row is on the front, validity of
/// calibrated voxels ("inside", "outside"; the reason says why), status, reason.
io::CsvTable trade_csv(const TradeTable& table);

}  // namespace menger::evolution
