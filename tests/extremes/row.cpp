#include "tests/extremes/row.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

namespace menger::extremes {

void Outcome::add(bool holds, std::string_view text) {
  is_as_expected_ = is_as_expected_ && holds;
  if (!text_.empty()) text_ += "; ";
  if (!holds) text_ += "NOT AS EXPECTED: ";
  text_ += text;
}

void Outcome::expect_near(std::string_view what, double computed, double expected, double relative_tolerance) {
  const double off = std::abs(computed - expected);
  const double relative = expected != 0.0 ? off / std::abs(expected) : off;
  add(off <= relative_tolerance * std::abs(expected),
      std::string(what) + " " + shown(computed, 7) + " against " + shown(expected, 7) + ", off by " + shown(relative, 2));
}

void Outcome::expect_at_most(std::string_view what, double value, double bound) {
  add(std::abs(value) <= bound, std::string(what) + " " + shown(value, 3) + " (at most " + shown(bound, 3) + ")");
}

void Outcome::expect_between(std::string_view what, double value, double lower, double upper) {
  add(lower <= value && value <= upper,
      std::string(what) + " " + shown(value, 5) + " (" + shown(lower) + " to " + shown(upper) + ")");
}

void Outcome::expect_status(io::RunStatus status, io::RunStatus expected, std::string_view reason) {
  std::string text(io::to_string(status));
  if (!reason.empty()) text += " (" + std::string(reason) + ")";
  add(status == expected, text);
}

void Outcome::expect(bool holds, std::string_view statement) { add(holds, statement); }

void Outcome::note(std::string_view text) { add(true, text); }

void Outcome::expect_energy_error(double relative_error, double bound) {
  energy_error_ =
      std::isfinite(relative_error) ? std::max(energy_error_.value_or(0.0), std::abs(relative_error)) : relative_error;
  if (!(std::abs(relative_error) <= bound)) expect_at_most("energy error", relative_error, bound);
}

RowResult run_row(const Row& row) {
  RowResult result{.name = row.name, .done = row.done, .expected = row.expected, .happened = {}, .energy_error = {}};
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  try {
    row.run(outcome);
  } catch (const std::exception& error) {
    outcome.expect(false, std::string("an exception: ") + error.what());
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (outcome.text().empty()) outcome.expect(false, "nothing was looked at");
  result.happened = outcome.text();
  result.is_as_expected = outcome.is_as_expected();
  result.energy_error = outcome.energy_error();
  return result;
}

}  // namespace menger::extremes
