#include "evolution/verdict/verdict.h"

#include <algorithm>
#include <utility>

#include "evolution/outputs/report_numbers.h"
#include "evolution/verdict/finding_words.h"
#include "evolution/verdict/pressure_findings.h"
#include "evolution/verdict/shape_findings.h"
#include "evolution/verdict/walk_findings.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/load_cases/shape_agreement.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

Finding ranking_finding(const RankingFacts& facts) {
  std::string text;
  Tone tone = Tone::caution;
  const std::string of = std::to_string(facts.compared) + " of " + io::counted(facts.designs, "robot");
  if (facts.spearman) {
    const IntervalFact& rank = *facts.spearman;
    text = "Over " + of + ", the rank correlation of the distances of " + facts.compared_with +
           " with those on finite elements is " + io::formatted("%.2f", rank.value);
    const bool has_interval = rank.low && rank.high;
    if (has_interval)
      text += " (95 % interval " + io::formatted("%.2f", *rank.low) + " to " + io::formatted("%.2f", *rank.high) + ")";
    if (!has_interval) {
      text += ": too few robots to say more.";
    } else if (*rank.low <= 0.0) {
      text += ": this can be chance.";
    } else {
      tone = rank.value >= judged_by::good_rank ? Tone::good : rank.value >= judged_by::usable_rank ? Tone::caution : Tone::bad;
      text += tone == Tone::good      ? ": it tells which robot walks better."
              : tone == Tone::caution ? ": it tells in part which robot walks better."
                                      : ": it hardly tells which robot walks better.";
    }
  } else {
    text = "Too few robots completed in both models to compare their ranking: " + of + ".";
  }
  if (facts.within_45_deg && facts.with_direction && *facts.with_direction > 0)
    text += " " + std::to_string(*facts.within_45_deg) + " of " + std::to_string(*facts.with_direction) +
            " go the same way within 45 degrees.";
  if (facts.median_error) text += " Its displacements are " + io::percents(*facts.median_error) + " off (median).";
  if (facts.best_per_minute)
    text += " The best on finite elements is " + facts.best_design + ", with " + speed_text(*facts.best_per_minute) + ".";
  return {tone, text, facts.source};
}

Finding search_finding(const SearchFacts& facts, bool several) {
  const std::string begin = several ? "Search " + facts.source + ": " : "";
  if (!facts.last_fitness) {
    return {Tone::bad,
            begin + "The search found no robot with a fitness in " + io::counted(facts.generations, "generation") + ".",
            facts.source};
  }
  std::string text = begin + "The best robot of generation " + facts.last_generation + " has a fitness of " +
                     shown_number(facts.last_fitness) + " " + facts.unit;
  if (facts.first_generation != facts.last_generation)
    text += "; the best of generation " + facts.first_generation + " had " + shown_number(facts.first_fitness);
  text += ".";
  const bool improved = facts.first_fitness && *facts.last_fitness > *facts.first_fitness;
  if (!improved && facts.generations > 1) text += " It did not improve.";
  if (!facts.is_walk) text += " That is no walk: give the search more generations or mutants.";
  return {facts.is_walk && (improved || facts.generations <= 1) ? Tone::good : Tone::caution, text, facts.source};
}

/// Whether a walk on finer elements is about that of the search, see judging_words.
/// @param is_squared whether scores are squares of distances
bool keeps_its_walk(const ConfirmedWalk& walk, bool is_squared) {
  if (!walk.score || !walk.fitness) return false;
  const double slower = std::min(*walk.score, *walk.fitness);
  const double faster = std::max(*walk.score, *walk.fitness);
  const double limit = meshes::walk_limits::same_speed * (is_squared ? meshes::walk_limits::same_speed : 1.0);
  return slower > 0.0 && faster <= limit * slower && walk.angle_deg.value_or(0.0) <= meshes::walk_limits::same_direction_deg;
}

/// "0.356 on standard elements (turned by 14 degrees)"
std::string confirmed_text(const ConfirmedWalk& walk) {
  std::string text = (walk.score ? shown_number(walk.score) : std::string("no walk")) + " on " + walk.elements + " elements";
  if (walk.angle_deg) text += " (turned by " + io::degrees(*walk.angle_deg) + ")";
  if (!walk.score && !walk.reason.empty()) text += " (" + walk.reason + ")";
  return text;
}

/// What the best robots of a search do on finer elements. @param facts which have such walks
Finding confirmation_finding(const SearchFacts& facts, bool several) {
  std::string robots;
  std::vector<std::pair<std::string, bool>> keep;  // rank of each robot; whether all of its walks are about that of the search
  const bool is_squared = facts.unit.starts_with("m\u00b2");
  for (const ConfirmedWalk& walk : facts.confirmed) {
    if (keep.empty() || walk.rank != keep.back().first) {
      keep.emplace_back(walk.rank, true);
      if (!robots.empty()) robots += ". ";
      robots +=
          "Number " + walk.rank + " (individual " + walk.individual + ") has " + shown_number(walk.fitness) + " in the search";
    }
    robots += ", " + confirmed_text(walk);
    keep.back().second = keep.back().second && keeps_its_walk(walk, is_squared);
  }
  const auto first = std::ranges::find(keep, true, &std::pair<std::string, bool>::second);
  const bool is_none = first == keep.end();
  const bool is_best = !is_none && first->first == "1";
  std::string text = several ? "Search " + facts.source + ": " : "";
  text += is_best ? "Its best robot keeps its walk on finer elements."
          : is_none
              ? "None of its robots that were tried on finer elements keeps its walk."
              : "Of its robots that were tried on finer elements number " + first->first + " is the first that keeps its walk.";
  Tone tone = Tone::caution;
  if (is_none) tone = Tone::bad;
  if (is_best && facts.is_walk) tone = Tone::good;
  return {tone, text + " In " + facts.unit + ": " + robots + ".", facts.source};
}

Finding modes_finding(const ModesFacts& facts) {
  if (!facts.first_frequency_Hz)
    return {Tone::caution, "No natural frequency was found (" + std::string(io::to_string(facts.status)) + ").", facts.source};
  return {Tone::good, "The lowest natural frequency is " + shown_number(*facts.first_frequency_Hz) + " Hz.", facts.source};
}

/// The sentence of the headline on rankings. @param worst of all
std::string ranking_headline(Tone worst, const std::vector<RankingFacts>& rankings) {
  if (rankings.size() > 1) {
    if (worst == Tone::good) return "The rankings of robots hold on finite elements.";
    return worst == Tone::bad ? "Not every ranking of robots holds on finite elements."
                              : "The rankings of robots are to be checked on finite elements, robot by robot.";
  }
  return sentence_of(rankings.front().compared_with + "'s ranking of robots " +
                     (worst == Tone::good  ? "holds on finite elements"
                      : worst == Tone::bad ? "does not hold on finite elements"
                                           : "is to be checked on finite elements, robot by robot"));
}

/// The sentence of the headline on how far the surrogate can be trusted. @param before what the headline says already
std::string trust_headline(const ReportFacts& facts, const WalkTrust& walks, const std::string& before, Tone& tone) {
  const auto conclude = [&](Tone other, const std::string& words) {
    tone = worse_of(tone, other);
    return words;
  };
  if (!walks.are_known) {
    return conclude(Tone::bad, walks.trusted
                                   ? "How some bodies walk is not known: finite elements do not agree among themselves."
                                   : "How this body walks is not known: finite elements do not agree among themselves.");
  }
  Tone ranking = Tone::missing;
  for (const RankingFacts& one : facts.rankings) ranking = worse_of(ranking, ranking_finding(one).tone);
  std::string on_ranking;
  if (!facts.rankings.empty()) on_ranking = conclude(ranking, ranking_headline(ranking, facts.rankings));
  if (walks.trusted) return conclude(*walks.trusted, walk_headline(facts, walks)) + (on_ranking.empty() ? "" : " " + on_ranking);
  if (!on_ranking.empty()) return on_ranking;
  if (const Tone shapes = tone_of_shapes(facts); shapes != Tone::missing)
    return conclude(shapes, shape_headline(facts, shapes, walks.were_compared));
  if (walks.were_compared)
    return conclude(Tone::caution,
                    "Both models walk, but too little or too briefly to tell whether the surrogate can be trusted.");
  if (!facts.validations.empty())
    return conclude(Tone::caution, "Whether the surrogate can be trusted is not known: no shape was compared inside its range.");
  if (walks.are_in_both) {
    return conclude(Tone::missing,
                    "The walks in both models are not of one body and drive, so they do not tell whether the surrogate can be "
                    "trusted.");
  }
  if (facts.searches.size() == 1 && facts.searches.front().last_fitness) {
    const SearchFacts& search = facts.searches.front();
    return conclude(Tone::missing, "The best robot of the search has a fitness of " + shown_number(search.last_fitness) + " " +
                                       search.unit + ". Nothing here compares its model with finite elements.");
  }
  const bool has_surrogate = !facts.calibrations.empty() || !facts.searches.empty() || !facts.walks.empty();
  if (!before.empty() && !has_surrogate) return {};
  return conclude(Tone::missing, "Nothing here compares the surrogate with finite elements on a whole body.");
}

}  // namespace

const char* to_string(Tone tone) {
  switch (tone) {
    case Tone::note:
      return "note";
    case Tone::good:
      return "good";
    case Tone::caution:
      return "caution";
    case Tone::bad:
      return "bad";
    case Tone::missing:
      return "missing";
  }
  return "";
}

Verdict verdict_of(const ReportFacts& facts) {
  Verdict verdict{.headline = {}};
  std::vector<Finding>& findings = verdict.findings;
  findings = pressure_findings(facts);
  if (facts.inflations.empty()) findings.push_back(missing("The pressure that the body bears", "inflate"));
  const WalkTrust walks = add_walks(facts, findings);
  for (const ValidationFacts& validation : facts.validations) findings.push_back(validation_finding(validation));
  if (facts.validations.empty()) findings.push_back(missing("How far the surrogate's shapes are off", "validate"));
  for (const CalibrationFacts& calibration : facts.calibrations) findings.push_back(calibration_finding(calibration));
  for (const ShippedParameters& shipped : facts.shipped)
    findings.push_back({Tone::note, "The parameters of the surrogate came with menger: " + shipped.file + ".", shipped.source});
  if (facts.calibrations.empty() && facts.shipped.empty())
    findings.push_back(missing("A calibration of the surrogate", "calibrate"));
  for (const SearchFacts& search : facts.searches) {
    findings.push_back(search_finding(search, facts.searches.size() > 1));
    if (!search.confirmed.empty()) findings.push_back(confirmation_finding(search, facts.searches.size() > 1));
  }
  for (const RankingFacts& ranking : facts.rankings) findings.push_back(ranking_finding(ranking));
  const bool are_confirmed = std::ranges::all_of(facts.searches, [](const SearchFacts& one) { return !one.confirmed.empty(); });
  if (!facts.searches.empty() && facts.rankings.empty() && !are_confirmed)
    findings.push_back(missing("Whether the robots of the search walk on finer elements", "reevaluate"));
  for (const ModesFacts& modes : facts.modes) findings.push_back(modes_finding(modes));
  std::stable_partition(findings.begin(), findings.end(), [](const Finding& finding) { return finding.tone != Tone::missing; });
  verdict.headline = pressure_headline(facts, verdict.tone);
  verdict.headline += trust_headline(facts, walks, verdict.headline, verdict.tone);
  // Walks come first in the headline, and must not hide that a shape is wrong.
  const auto wrong = std::ranges::find_if(
      facts.validations, [](const ValidationFacts& one) { return one.bodies == 1 && finding_on_shapes(one).tone == Tone::bad; });
  if (wrong != facts.validations.end() && verdict.headline.find("Do not trust the surrogate") == std::string::npos) {
    const std::string& name = wrong->displacement.worst_body;
    verdict.headline += " Do not trust the surrogate for the shape of " +
                        (are_of_one_body(facts.walks) || name.empty() ? "this body" : "another body here, " + name) + ".";
    verdict.tone = Tone::bad;
  }
  while (verdict.headline.ends_with(' ')) verdict.headline.pop_back();
  return verdict;
}

std::vector<std::string> judging_words() {
  return {
      "Shapes of several bodies can be relied on up to a median error of " + io::percents(judged_by::good_error) +
          ", and not above " + io::percents(judged_by::usable_error) + ". Those of one body, such as a robot in a loop, up to " +
          io::percents(meshes::largest_shape_error) + " in displacements and in chamber volumes, if no displacement of " +
          io::millimetres(meshes::smallest_signed_m) + " and more goes the wrong way.",
      "A pressure is safe up to " + io::percents(meshes::largest_safe_share) +
          " of the limit pressure, or of the highest pressure that the body bore where no limit is known; above, small faults of "
          "a cast wall decide. Thin walls put it " +
          meshes::thin_wall_excess_text() + " too high, so that " +
          io::percents(meshes::largest_safe_share * meshes::least_limit_of_thin_walls_Pa(1.0)) + " of theirs are safe.",
      "A walk below " + io::shown(meshes::walk_limits::least_body_lengths) +
          " body lengths is none. Two walks, of both models or of two meshes, agree if neither is more than " +
          io::shown(meshes::walk_limits::same_speed) + " times as fast as the other and their directions are within " +
          io::shown(meshes::walk_limits::same_direction_deg) + " degrees. They have nothing in common if one is more than " +
          io::shown(meshes::walk_limits::comparable_speed) + " times as fast.",
      "A ranking can be relied on from a rank correlation of " + io::shown(judged_by::good_rank) + ", and not below " +
          io::shown(judged_by::usable_rank) + " or where its 95 % interval reaches 0.",
      "These limits are choices of this page. Finite elements are no measurements: damping and friction are assumed.",
  };
}

}  // namespace menger::evolution
