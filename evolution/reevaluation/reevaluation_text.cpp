#include <algorithm>
#include <array>
#include <vector>

#include "evolution/reevaluation/reevaluation_table.h"
#include "io/text/formatted.h"

namespace menger::evolution {
namespace {

std::string number_or_dash(const std::optional<double>& value, const char* format) {
  return value ? io::formatted(format, *value) : "-";
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

std::string design_line(const ReevaluationStudy& study, const JudgedDesign& judged) {
  const auto speed = [&](const std::optional<std::array<double, 3>>& displacement_m) {
    return displacement_m ? std::optional(motion_of(study, *displacement_m).body_lengths_per_minute) : std::nullopt;
  };
  const ModelGap gap = gap_of(study, judged);
  std::string line = padded(std::to_string(judged.design.rank), 5) + padded(judged.design.is_top ? "top" : "sample", 8) +
                     padded(std::to_string(judged.design.individual), 11) +
                     padded(number_or_dash(speed(judged.surrogate.result.displacement_m), "%.3f"), 13) +
                     padded(number_or_dash(speed(judged.elements.displacement_m), "%.3f"), 13) +
                     padded(number_or_dash(gap.ratio, "%.3f"), 9) + padded(number_or_dash(gap.angle_deg, "%.0f"), 8) + "  " +
                     std::string(status_word(judged.elements));
  if (!judged.elements.reason.empty()) line += ": " + judged.elements.reason;
  const Evaluation& surrogate = judged.surrogate.result;
  if (surrogate.status != io::RunStatus::completed)
    line += "; surrogate " + std::string(io::to_string(surrogate.status)) + ": " + surrogate.reason;
  if (!judged.is_balanced) line += "; falls over by itself";
  return line + "\n";
}

std::string interval_text(const std::optional<Interval>& interval) {
  if (!interval) return "no interval";
  return "95 % interval " + io::formatted("%.2f", interval->low) + " to " + io::formatted("%.2f", interval->high);
}

std::string correlation_text(const char* name, const std::optional<RankCorrelation>& found) {
  if (!found) return std::string(name) + " has no value";
  return std::string(name) + " " + io::formatted("%.2f", found->value) + " (" + interval_text(found->interval) + ")";
}

std::string direction_text(const char* angle, const std::optional<Share>& found) {
  if (!found) return "";
  return "  directions within " + std::string(angle) + " degrees: " + std::to_string(found->count) + " of " +
         std::to_string(found->of) + " (" + interval_text(found->interval) + ")\n";
}

std::string regret_text(std::size_t k, const std::optional<TopRegret>& found) {
  if (!found) return "";
  std::string text = "  looking only at the surrogate's best" + (k > 1 ? " " + std::to_string(k) : std::string()) + " loses " +
                     io::formatted("%.3f", found->regret) + " body lengths per minute of the best's " +
                     io::formatted("%.3f", found->best);
  if (k > 1) text += "; " + std::to_string(found->shared) + " of both models' best " + std::to_string(k) + " are the same";
  return text + "\n";
}

std::string ranking_text(const Ranking& ranking) {
  std::string text = ranking.name + ": " + std::to_string(ranking.compared) + " of " + std::to_string(ranking.judged) +
                     " designs completed in both models\n  rank correlation of the distances: " +
                     correlation_text("Spearman", ranking.spearman) + ", " + correlation_text("Kendall", ranking.kendall) + "\n";
  text += direction_text("45", ranking.within_45_deg) + direction_text("90", ranking.within_90_deg);
  text += regret_text(1, ranking.best);
  if (ranking.k > 1) text += regret_text(ranking.k, ranking.best_of_k);
  return text;
}

std::string judge_text(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::string text;
  for (const JudgeError& error : judge_errors(study, findings.designs, findings.variants)) {
    text += error.kind == "numerical" ? "the judge's own error: " : "the silicone's uncertain stiffness: ";
    text += "displacement changes by up to ";
    text += error.largest_change ? io::formatted("%.0f", 100.0 * *error.largest_change) + " %" : "-";
    text += ", direction by up to " + number_or_dash(error.largest_angle_deg, "%.0f") + " degrees, in " +
            std::to_string(error.compared) + " of " + std::to_string(error.runs) + " runs\n";
  }
  std::vector<double> gaps;
  for (const JudgedDesign& design : findings.designs) {
    if (const auto error = gap_of(study, design).relative_error) gaps.push_back(*error);
  }
  if (text.empty() || gaps.empty()) return text;
  std::ranges::sort(gaps);
  return text + "the surrogate's displacement is off by " +
         io::formatted("%.0f", 100.0 * 0.5 * (gaps[(gaps.size() - 1) / 2] + gaps[gaps.size() / 2])) + " % (median of " +
         std::to_string(gaps.size()) + " designs)\n";
}

}  // namespace

std::string findings_text(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::string text =
      std::to_string(findings.designs.size()) + " of " + std::to_string(findings.distinct) + " robots judged for " +
      io::formatted("%.4g", study.duration_s) + " s" +
      (study.measure_from_s > 0.0 ? " (the first " + io::formatted("%.4g", study.measure_from_s) + " s left out)" : "") +
      ", body lengths per minute:\n" + padded("rank", 5) + padded("of", 8) + padded("individual", 11) + padded("surrogate", 13) +
      padded("elements", 13) + padded("ratio", 9) + padded("angle", 8) + "  status\n";
  for (const JudgedDesign& judged : findings.designs) text += design_line(study, judged);
  if (!findings.refused.empty()) {
    text += std::to_string(findings.refused.size()) + " designs in line could not be judged, the first (rank " +
            std::to_string(findings.refused.front().rank) + "): " + findings.refused.front().reason + "\n";
  }
  for (const Ranking& ranking : findings.rankings) text += ranking_text(ranking);
  return text + judge_text(study, findings);
}

}  // namespace menger::evolution
