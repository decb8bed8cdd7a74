#include "voxel/validation/validation_tables.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>

#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/shape_agreement.h"

namespace menger::voxel {

namespace {

std::string percent_or_nothing(const std::optional<double>& fraction) { return fraction ? percent(*fraction) : ""; }

std::uint64_t number(std::size_t count) { return count; }

/// The word for a side of the range of validity.
std::string side_word(bool inside) { return inside ? "inside" : "outside"; }

void add_summaries(io::CsvTable& table, const std::vector<CurveComparison>& comparisons, const std::optional<std::string>& body) {
  for (const ErrorSummary& summary : summarise(comparisons, body)) {
    const auto furthest = summary.furthest ? std::optional(furthest_displacement(comparisons, *summary.furthest)) : std::nullopt;
    const auto of_furthest = [&](double FurthestDisplacement::*member) {
      return furthest ? std::optional(*furthest.*member) : std::nullopt;
    };
    table.add_row(body.value_or("all"), to_string(summary.kind), side_word(summary.inside), number(summary.count),
                  number(summary.without_equilibrium), summary.median, summary.percentile_90, summary.worst,
                  summary.pointwise_median, summary.worst_body, summary.worst_case, summary.worst_observable, summary.median_m,
                  summary.worst_m, furthest ? furthest->body : "", furthest ? furthest->observable : "",
                  of_furthest(&FurthestDisplacement::pressure_Pa), of_furthest(&FurthestDisplacement::difference_m),
                  of_furthest(&FurthestDisplacement::share), of_furthest(&FurthestDisplacement::error));
  }
}

/// Text on the numbers without a response; empty if all have one.
std::string without_response(const AimOutcome& outcome) {
  std::string text;
  if (outcome.undetermined_inside > 0) {
    text += "; no equilibrium inside the range (counted as missed): " + std::to_string(outcome.undetermined_inside) + " of " +
            std::to_string(outcome.count + outcome.undetermined_inside) + " values";
  }
  if (outcome.undetermined_outside > 0)
    text += "; no equilibrium outside the range (not counted): " + std::to_string(outcome.undetermined_outside);
  return text;
}

using Line = std::array<std::string, 9>;

/// Aligned text columns: the first and the last to the left, numbers to the right.
std::vector<std::string> aligned(const std::vector<Line>& lines) {
  std::array<std::size_t, std::tuple_size_v<Line>> widths{};
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths.at(i) = std::max(widths.at(i), line.at(i).size());
  }
  std::vector<std::string> texts;
  for (const Line& line : lines) {
    std::string text;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::string fill(widths.at(i) - line.at(i).size(), ' ');
      const bool to_the_left = i == 0 || i + 1 == widths.size();
      text += (i == 0 ? "" : "  ") + (to_the_left ? line.at(i) + fill : fill + line.at(i));
    }
    text.erase(text.find_last_not_of(' ') + 1);
    texts.push_back(text);
  }
  return texts;
}

}  // namespace

std::string percent(double fraction) { return io::formatted("%.3g %%", 100.0 * fraction); }

io::CsvTable errors_table(const std::vector<CurveComparison>& comparisons) {
  io::CsvTable table({"case", "body", "kind", "observable", "pressure_Pa", "imposed", "finite_elements", "surrogate", "error",
                      "pointwise_error", "validity"});
  for (const CurveComparison& comparison : comparisons) {
    for (const ObservableError& error : comparison.errors) {
      table.add_row(comparison.load_case().name, comparison.body, to_string(error.kind), error.observable, error.pressure_Pa,
                    error.imposed, error.reference, error.surrogate, error.error, error.pointwise_error,
                    to_string(error.validity));
    }
  }
  return table;
}

io::CsvTable summary_table(const std::vector<CurveComparison>& comparisons) {
  io::CsvTable table({"body",
                      "kind",
                      "range",
                      "count",
                      "without_equilibrium",
                      "median",
                      "percentile_90",
                      "worst",
                      "pointwise_median",
                      "worst_body",
                      "worst_case",
                      "worst_observable",
                      "median_m",
                      "worst_m",
                      "furthest_body",
                      "furthest_observable",
                      "furthest_pressure_Pa",
                      "furthest_m",
                      "furthest_share",
                      "furthest_error"});
  add_summaries(table, comparisons, std::nullopt);
  for (const std::string& body : bodies_of(comparisons)) add_summaries(table, comparisons, body);
  return table;
}

io::CsvTable signs_table(const std::vector<CurveComparison>& comparisons) {
  io::CsvTable table({"body", "observable", "range", "count", "wrong"});
  for (const SignCount& signs : count_signs(comparisons))
    table.add_row(signs.body, signs.observable, side_word(signs.inside), number(signs.count), number(signs.wrong));
  return table;
}

std::string sign_sentence(const std::vector<CurveComparison>& comparisons, bool inside) {
  std::size_t count = 0;
  std::size_t wrong = 0;
  std::vector<std::string> which;
  for (const SignCount& signs : count_signs(comparisons)) {
    if (signs.inside != inside) continue;
    count += signs.count;
    wrong += signs.wrong;
    if (signs.wrong > 0)
      which.push_back(signs.body + " " + signs.observable + " (" + std::to_string(signs.wrong) + " of " +
                      std::to_string(signs.count) + ")");
  }
  if (count == 0) return "";
  return std::string(inside ? "sign: " : "sign, outside the range of validity: ") + std::to_string(count - wrong) + " of " +
         std::to_string(count) + " displacements that are at least " + io::formatted("%.1f mm", 1e3 * meshes::smallest_signed_m) +
         " go the right way (the way of smaller ones is not judged)" +
         (which.empty() ? "" : "; the wrong way: " + io::joined(which));
}

std::string furthest_sentence(const std::vector<CurveComparison>& comparisons) {
  const std::vector<ErrorSummary> summaries = summarise(comparisons);
  const ErrorSummary* summary = nullptr;  // inside the range of validity, which comes first, or outside if nothing is inside
  for (const ErrorSummary& one : summaries)
    if (summary == nullptr && one.kind == ObservableKind::displacement) summary = &one;
  if (summary == nullptr || !summary->furthest) return "";
  const FurthestDisplacement furthest = furthest_displacement(comparisons, *summary->furthest);
  std::string text = std::string(summary->inside ? "furthest off: " : "furthest off, outside the range of validity: ") +
                     io::millimetres(furthest.difference_m) + ", " + percent(furthest.share) + " of the length of the body (" +
                     furthest.body + " " + furthest.observable + " at " + io::kilopascals(furthest.pressure_Pa) + ", " +
                     percent(furthest.error) + " of the largest in its curve)";
  if (summary->worst_m && *summary->worst_m < furthest.difference_m)
    text += "; the worst in per cent of its curve, " + percent(*summary->worst) + ", is " + io::millimetres(*summary->worst_m) +
            " (" + summary->worst_body + " " + summary->worst_observable + ")";
  if (summary->median_m) text += "; the median is " + io::millimetres(*summary->median_m);
  return text;
}

io::CsvTable actuation_table(const std::vector<VolumeActuation>& actuations, const ActuationAim& aim) {
  io::CsvTable table({"body", "chamber_share", "pressure_Pa", "outer_volume_change", "largest_change_aimed_at",
                      "pressure_for_largest_Pa", "smallest_change_aimed_at", "pressure_for_smallest_Pa", "highest_pressure_Pa",
                      "change_at_highest", "limit_pressure_Pa", "lowest_pressure_Pa", "change_at_lowest", "contact_pressure_Pa"});
  for (const VolumeActuation& actuation : actuations) {
    table.add_row(actuation.body, actuation.chamber_share, aim.pressure_Pa, actuation.change_at_pressure, aim.largest_change,
                  actuation.pressure_for_largest_Pa, aim.smallest_change, actuation.pressure_for_smallest_Pa,
                  actuation.highest_pressure_Pa, actuation.change_at_highest, actuation.limit_pressure_Pa,
                  actuation.lowest_pressure_Pa, actuation.change_at_lowest, actuation.contact_pressure_Pa);
  }
  return table;
}

std::vector<std::string> summary_lines(const std::vector<CurveComparison>& comparisons) {
  std::vector<Line> lines{
      {"observable", "range", "number", "without_equilibrium", "median", "90 %", "worst", "pointwise", "worst body"}};
  for (const ErrorSummary& summary : summarise(comparisons)) {
    lines.push_back({std::string(to_string(summary.kind)), side_word(summary.inside), std::to_string(summary.count),
                     std::to_string(summary.without_equilibrium), percent_or_nothing(summary.median),
                     percent_or_nothing(summary.percentile_90), percent_or_nothing(summary.worst),
                     percent_or_nothing(summary.pointwise_median), summary.worst_body});
  }
  return aligned(lines);
}

std::vector<std::string> aim_sentences(const std::vector<CurveComparison>& comparisons, double aim) {
  std::vector<std::string> sentences;
  for (const AimOutcome& outcome : assess(comparisons, aim)) {
    const std::string kind(to_string(outcome.kind));
    const std::size_t inside = outcome.count + outcome.undetermined_inside;
    if (inside == 0) {
      sentences.push_back(kind + ": no value was compared inside the range of validity, so that the aim cannot be judged" +
                          without_response(outcome));
      continue;
    }
    std::string text = kind + ": median error " + (outcome.median ? percent(*outcome.median) : "undetermined (no equilibrium)") +
                       ", aim " + percent(aim) + (outcome.met ? ": met" : ": missed") + without_response(outcome);
    if (!outcome.bodies_beyond.empty()) text += "; bodies that miss the aim: " + io::joined(outcome.bodies_beyond);
    sentences.push_back(text);
  }
  return sentences;
}

}  // namespace menger::voxel
