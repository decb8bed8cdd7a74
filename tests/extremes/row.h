#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/formatted.h"
#include "io/text/run_status.h"

namespace menger::extremes {

/// The outcome of a row, and whether it is as expected. All results are joined to one text. A number that is not finite is never
/// as expected.
class Outcome {
 public:
  /// Expects |computed - expected| <= tolerance |expected|.
  void expect_near(std::string_view what, double computed, double expected, double relative_tolerance);

  /// Expects |value| <= bound.
  void expect_at_most(std::string_view what, double value, double bound);

  /// Expects lower <= value <= upper.
  void expect_between(std::string_view what, double value, double lower, double upper);

  /// Expects a status. @param reason why the run ended with it; may be empty
  void expect_status(io::RunStatus status, io::RunStatus expected, std::string_view reason = {});

  /// Expects that a statement holds.
  void expect(bool holds, std::string_view statement);

  /// Adds information without a check.
  void note(std::string_view text);

  /// Records an error of the energy balance, divided by the largest energy of the run. The largest error of the row is kept. The
  /// outcome is not as expected if the error exceeds `bound`.
  void expect_energy_error(double relative_error, double bound);

  [[nodiscard]] bool is_as_expected() const { return is_as_expected_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::optional<double>& energy_error() const { return energy_error_; }

 private:
  void add(bool holds, std::string_view text);

  bool is_as_expected_ = true;
  std::string text_;
  std::optional<double> energy_error_;
};

/// A test case at the limit of what the models can compute. Its outcome is stated before it runs.
struct Row {
  std::string name;      ///< letters, digits and spaces
  std::string done;      ///< what the row computes
  std::string expected;  ///< a value with tolerance and reason, or a status and the reason for it
  bool is_slow = false;  ///< only runs in full runs
  /// Computes the results and checks them. It limits its number of steps or iterations itself.
  std::function<void(Outcome&)> run;
};

/// The rows of one model.
struct Part {
  std::string name;  ///< "voxel", "fem" or "calibration"
  std::vector<Row> rows;
};

/// The result of a row.
struct RowResult {
  std::string name, done, expected, happened;
  bool is_as_expected = false;
  std::optional<double> energy_error;
  double seconds = 0.0;
};

/// Runs a row. An exception is an outcome that is not as expected.
RowResult run_row(const Row& row);

using io::shown;

}  // namespace menger::extremes
