#include "voxel/validation/validation_cause_judgement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "voxel/validation/validation_summary.h"
#include "voxel/validation/validation_tables.h"

namespace menger::voxel {

namespace {

bool is_aimed_at(ObservableKind kind) { return kind == ObservableKind::displacement || kind == ObservableKind::volume; }

/// Root mean square of the errors of some kinds that count; nothing without any.
std::optional<double> rms(const std::vector<CurveComparison>& comparisons, bool inside,
                          const std::function<bool(ObservableKind)>& of_kind) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const CurveComparison& comparison : comparisons) {
    for (const ObservableError& error : comparison.errors) {
      if (!of_kind(error.kind) || !counts(error.validity, inside)) continue;
      sum += error.error * error.error;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

/// What to call a part in a sentence.
std::string name_of(OwnPart part) {
  constexpr std::array<std::string_view, 4> names{"nothing", "rest lengths", "stiffnesses", "rest lengths and stiffnesses"};
  return std::string(names.at(static_cast<std::size_t>(part))) + " of its own";
}

/// Median error of a kind over all bodies with one part of their own.
std::string pooled_median(const std::vector<CauseReport>& reports, OwnPart part, ObservableKind kind) {
  std::vector<double> magnitudes;
  std::size_t unanswered = 0;
  for (const CauseReport& report : reports) {
    for (const CurveComparison& comparison : report.trials.at(static_cast<std::size_t>(part)).comparisons) {
      for (const ObservableError& error : comparison.errors) {
        if (error.kind == kind && counts(error.validity, report.inside)) magnitudes.push_back(std::abs(error.error));
      }
      unanswered += static_cast<std::size_t>(std::count_if(
          comparison.unanswered.begin(), comparison.unanswered.end(),
          [&](const UnansweredNumber& number) { return number.kind == kind && counts(number.validity, report.inside); }));
    }
  }
  const std::optional<double> median = quantile(std::move(magnitudes), 0.5, unanswered);
  return median ? percent(*median) : "none";
}

}  // namespace

std::string_view to_string(OwnPart part) {
  constexpr std::array<std::string_view, 4> words{"nothing", "sizes", "stiffness", "both"};
  return words.at(static_cast<std::size_t>(part));
}

bool counts(Validity validity, bool inside) { return !inside || validity == Validity::inside; }

bool has_inside(const std::vector<CurveComparison>& comparisons) {
  const auto is_inside = [](const auto& number) { return is_aimed_at(number.kind) && number.validity == Validity::inside; };
  return std::any_of(comparisons.begin(), comparisons.end(), [&](const CurveComparison& comparison) {
    return std::any_of(comparison.errors.begin(), comparison.errors.end(), is_inside) ||
           std::any_of(comparison.unanswered.begin(), comparison.unanswered.end(), is_inside);
  });
}

void judge(CauseTrial& trial, std::vector<CurveComparison> comparisons, bool inside) {
  trial.rms_error = rms(comparisons, inside, is_aimed_at).value_or(0.0);
  trial.rms_stiffness_error = rms(comparisons, inside, [](ObservableKind kind) { return kind == ObservableKind::stiffness; });
  trial.all_answered = std::all_of(comparisons.begin(), comparisons.end(), [&](const CurveComparison& comparison) {
    return std::none_of(comparison.unanswered.begin(), comparison.unanswered.end(),
                        [&](const UnansweredNumber& number) { return counts(number.validity, inside); });
  });
  trial.comparisons = std::move(comparisons);
}

std::string verdict_of(const CauseReport& report) {
  constexpr double closing_share = 0.25;
  constexpr double most_share = 0.5;
  constexpr double least_gap = 1e-6;  // rounding, and what the solver leaves
  if (report.trials.size() < 4) return "stopped before all trials were made";
  const CauseTrial& as_it_is = report.trials.front();
  if (as_it_is.all_answered && as_it_is.rms_error < least_gap) return "there is no gap to close";
  const auto rms_of = [&](OwnPart part) { return report.trials[static_cast<std::size_t>(part)].rms_error; };
  const auto leaves_at_most = [&](OwnPart part, double share) {
    return report.trials[static_cast<std::size_t>(part)].all_answered && rms_of(part) <= share * as_it_is.rms_error;
  };
  const auto closes = [&](OwnPart part) { return leaves_at_most(part, closing_share); };
  const bool sizes = closes(OwnPart::sizes);
  const bool stiffness = closes(OwnPart::stiffness);
  if (sizes && stiffness) return "either rest lengths or stiffnesses of its own close the gap: the curves do not tell them apart";
  if (sizes) return name_of(OwnPart::sizes) + " close the gap: its chambers extend or bulge otherwise than those of the fit";
  if (stiffness) return name_of(OwnPart::stiffness) + " close the gap: its walls bear loads otherwise than those of the fit";
  if (closes(OwnPart::both)) return "only both " + name_of(OwnPart::both) + " close the gap";
  const auto best = std::min_element(report.trials.begin(), report.trials.end(), [](const CauseTrial& a, const CauseTrial& b) {
    return std::pair(!a.all_answered, a.rms_error) < std::pair(!b.all_answered, b.rms_error);
  });
  std::string text;
  for (const OwnPart part : {OwnPart::sizes, OwnPart::stiffness}) {
    if (!leaves_at_most(part, most_share)) continue;
    text += (text.empty() ? "" : ", or ") + name_of(part) + " take most of the gap away, to " + percent(rms_of(part));
  }
  return text + (text.empty() ? "" : "; ") + "no parameters of its own close it (at best " + percent(best->rms_error) +
         ", with " + name_of(best->part) + "): boxes and beams between their centres do not have the shape of these walls";
}

std::vector<std::string> cause_lines(const std::vector<CauseReport>& reports) {
  std::vector<std::string> lines;
  for (const CauseReport& report : reports) {
    lines.push_back("why " + report.body + " is missed (root mean square of errors in displacement and volume" +
                    std::string(report.inside ? "" : ", all outside the range of validity") + "):");
    for (const CauseTrial& trial : report.trials) {
      std::string line = "  with " + std::string(to_string(trial.part)) + " of its own: " + percent(trial.rms_error);
      if (trial.rms_stiffness_error) line += ", stiffness " + percent(*trial.rms_stiffness_error);
      if (trial.status != io::RunStatus::completed)
        line += " (the fit: " + std::string(io::to_string(trial.status)) + ", " + trial.reason + ")";
      if (!trial.all_answered) line += " (some states have no equilibrium)";
      lines.push_back(line);
    }
    lines.push_back("  " + report.verdict);
  }
  if (reports.size() < 2) return lines;
  lines.emplace_back("median errors of these bodies together, displacement and volume:");
  for (const CauseTrial& trial : reports.front().trials) {
    lines.push_back("  with " + std::string(to_string(trial.part)) +
                    " of their own: " + pooled_median(reports, trial.part, ObservableKind::displacement) + ", " +
                    pooled_median(reports, trial.part, ObservableKind::volume));
  }
  return lines;
}

}  // namespace menger::voxel
