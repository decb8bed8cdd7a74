#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/formatted.h"
#include "io/text/run_status.h"

namespace menger::extremes {

/// What happened in a row, and whether that is what was expected beforehand. Findings are put together to one text; a number
/// that is not finite is never as expected.
class Outcome {
 public:
  /// |computed - expected| <= tolerance |expected|.
  void expect_near(std::string_view what, double computed, double expected, double relative_tolerance);

  /// |value| <= bound.
  void expect_at_most(std::string_view what, double value, double bound);

  /// lower <= value <= upper.
  void expect_between(std::string_view what, double value, double lower, double upper);

  /// The status that was stated, whatever else happened. @param reason why it ended, empty if nothing is to be said
  void expect_status(io::RunStatus status, io::RunStatus expected, std::string_view reason = {});

  /// A statement that holds or not.
  void expect(bool holds, std::string_view statement);

  /// Something worth telling, without judging it.
  void note(std::string_view text);

  /// The largest of the errors that are handed in: energy that the books do not explain, by the largest energy of the run.
  /// Judged by expect_at_most against `bound`.
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

/// A case at the edge of what the models claim to bear. Its outcome is stated before it runs.
struct Row {
  std::string name;      ///< letters, digits and spaces
  std::string done;      ///< what is computed
  std::string expected;  ///< a value with tolerance and reason, or which status and why
  bool is_slow = false;  ///< only in full runs
  /// Computes and judges, in a number of steps or iterations that it limits itself.
  std::function<void(Outcome&)> judge;
};

/// The rows of a model.
struct Part {
  std::string name;  ///< "voxel", "fem" or "calibration"
  std::vector<Row> rows;
};

/// A row that was run.
struct RowResult {
  std::string name, done, expected, happened;
  bool is_as_expected = false;
  std::optional<double> energy_error;
  double seconds = 0.0;
};

/// Runs a row; what it throws is an outcome that nobody expected.
RowResult run_row(const Row& row);

using io::shown;

}  // namespace menger::extremes
