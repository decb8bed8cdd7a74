#include "evolution/page/verdict.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "evolution/page/report_numbers.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/load_cases/shape_agreement.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

std::string with_reason(io::RunStatus status, const std::string& reason) {
  return std::string(io::to_string(status)) + (reason.empty() ? "" : ", " + reason);
}

/// A line of a program as a sentence.
std::string sentence_of(std::string line) {
  if (!line.empty() && line.front() >= 'a' && line.front() <= 'z') line.front() = static_cast<char>(line.front() - 'a' + 'A');
  return line + ".";
}

/// "0.8", and "0.8 body lengths a minute"
std::string speed_number(double per_minute) { return io::shown(per_minute, per_minute < 100.0 ? 2 : 3); }
std::string speed_text(double per_minute) { return speed_number(per_minute) + " body lengths a minute"; }

/// What stands before a sentence on one of several results: its body where there are several, and where it is if the body has
/// several results of this kind.
template <class Facts, class IsOfOneKind>
std::string label_of(const Facts& one, const std::vector<Facts>& all, IsOfOneKind is_of_one_kind) {
  const bool has_bodies = std::ranges::any_of(all, [&](const Facts& other) { return other.name != one.name; });
  const bool has_runs = std::ranges::any_of(
      all, [&](const Facts& other) { return &other != &one && other.name == one.name && is_of_one_kind(one, other); });
  std::string label = has_bodies ? one.name : "";
  if (has_runs && !one.place.empty() && one.place != label) label += label.empty() ? one.place : " (" + one.place + ")";
  return label.empty() ? "" : label + ": ";
}

std::string label_of(const InflationFacts& inflation, const std::vector<InflationFacts>& all) {
  return label_of(inflation, all, [](const InflationFacts&, const InflationFacts&) { return true; });
}

std::string label_of(const WalkFacts& walk, const std::vector<WalkFacts>& all) {
  return label_of(walk, all, [](const WalkFacts& a, const WalkFacts& b) { return a.model == b.model; });
}

Finding missing(const std::string& what, const std::string& command) {
  return {Tone::missing, what + " was not computed.", "menger " + command};
}

/// "40 times", "92 % of"
std::string share_text(double share) {
  constexpr double least_times = 1.5;
  return share < least_times ? io::percents(share) + " of" : io::shown(share, 2) + " times";
}

/// The share of its limit pressure up to which a body is safe.
double safe_share(const InflationFacts& limited) {
  const bool has_thin_walls = limited.stated.elements == "thin_wall";
  return meshes::largest_safe_share * (has_thin_walls ? meshes::least_limit_of_thin_walls_Pa(1.0) : 1.0);
}

/// Pressures of other results of the body of an inflation.
struct KnownPressures {
  std::optional<double> drive_Pa{};          ///< the highest of the drives of its walks
  std::optional<double> limit_Pa{};          ///< the lowest limit pressure of its inflations
  double safe = meshes::largest_safe_share;  ///< see safe_share; of that inflation
  std::optional<double> softest_limit_Pa{};  ///< by the softest law of its silicone
};

KnownPressures known_pressures(const ReportFacts& facts, const InflationFacts& inflation) {
  KnownPressures known;
  if (inflation.place == "limit") known.softest_limit_Pa = facts.softest_limit_Pa;  // the stage of the loop
  for (const WalkFacts& walk : facts.walks) {
    const auto& drive_Pa = walk.stated.highest_pressure_Pa;
    if (drive_Pa && are_of_one_body(walk.stated, inflation.stated))
      known.drive_Pa = std::max(known.drive_Pa.value_or(*drive_Pa), *drive_Pa);
  }
  for (const InflationFacts& other : facts.inflations) {
    if (!other.limit || (&other != &inflation && !are_of_one_body(other.stated, inflation.stated))) continue;
    if (known.limit_Pa && *known.limit_Pa <= other.limit->pressure_Pa) continue;
    known.limit_Pa = other.limit->pressure_Pa;
    known.safe = safe_share(other);
  }
  return known;
}

Tone tone_of_share(double share, double safe) {
  if (share > 1.0) return Tone::bad;
  return share > safe ? Tone::caution : Tone::good;
}

/// What a share of the limit pressure means for a body. @param safe see safe_share
std::string meaning_of_share(double share, double safe) {
  if (share > 1.0) return ": it balloons or buckles before";
  return share > safe ? ": a thin spot in a cast wall decides" : "";
}

Finding limit_finding(const InflationFacts& facts, const KnownPressures& known, const std::string& begin) {
  const double limit_Pa = facts.limit->pressure_Pa;
  Finding finding{Tone::caution, begin, facts.source};
  finding.text += "Balloons or buckles at " + io::kilopascals(limit_Pa) +
                  ": there the pressure stops rising while the volume grows (limit point). Up to " +
                  io::kilopascals(io::rounded_towards_rest(safe_share(facts) * limit_Pa)) + " it is 20 % or more below that";
  if (facts.stated.elements == "thin_wall")
    finding.text += " and below what it may be: thin walls put limit pressures " + meshes::thin_wall_excess_text() +
                    " higher than three-field elements do (fem/README.md)";
  finding.text += ".";
  if (known.drive_Pa) {
    const double share = *known.drive_Pa / limit_Pa;
    finding.tone = tone_of_share(share, safe_share(facts));
    finding.text += " The drive of " + io::kilopascals(*known.drive_Pa) + " is " + share_text(share) + " the limit pressure" +
                    meaning_of_share(share, safe_share(facts)) + ".";
  }
  if (known.drive_Pa && known.softest_limit_Pa) {
    if (*known.drive_Pa > meshes::largest_safe_share * *known.softest_limit_Pa)
      finding.tone = std::max(finding.tone, Tone::caution);
    finding.text += " By the softest law of its silicone it balloons near " + io::kilopascals(*known.softest_limit_Pa) +
                    ", of which the drive is " + io::percents(*known.drive_Pa / *known.softest_limit_Pa) + ".";
  }
  return finding;
}

Finding inflation_finding(const InflationFacts& facts, const KnownPressures& known, const std::string& begin) {
  if (facts.limit) return limit_finding(facts, known, begin);
  const bool is_vacuum = facts.highest_pressure_Pa.value_or(1.0) <= 0.0 && facts.lowest_pressure_Pa.value_or(0.0) < 0.0;
  const std::string reached = is_vacuum                   ? io::kilopascals(*facts.lowest_pressure_Pa)
                              : facts.highest_pressure_Pa ? io::kilopascals(*facts.highest_pressure_Pa)
                                                          : "no pressure";
  const std::string by = facts.stated.elements == "thin_wall" ? " by thin walls" : "";
  const std::string growth =
      facts.volume_growth ? (facts.plena > 1 ? " Of its chambers, the one that grows most then has " : " Its chamber then has ") +
                                io::shown(1.0 + *facts.volume_growth, 3) + " times its volume at rest."
                          : "";
  if (facts.status == io::RunStatus::completed) {
    const std::string bend = facts.sideways_m
                                 ? " The middle of its far end moves " + io::millimetres(*facts.sideways_m) +
                                       " sideways, seen from the near one" +
                                       (facts.stated.elements == "thin_wall"
                                            ? "; thin walls bend fingers " + meshes::thin_wall_bend_deficit_text() + " too little"
                                            : "") +
                                       "."
                                 : "";
    Finding finding{Tone::good,
                    begin +
                        (is_vacuum ? "Evacuated to " + reached + by + ", where no walls of its chambers touch."
                                   : "Inflated to " + reached + by + ", without a limit point up to there.") +
                        growth + bend,
                    facts.source};
    if (is_vacuum) return finding;
    if (!known.limit_Pa) {
      finding.text += " How far this is from ballooning was not computed (path.volume_ratio, or menger loop)" +
                      std::string(facts.stated.elements == "thin_wall"
                                      ? ", and thin walls balloon " + meshes::thin_wall_excess_text() + " too late"
                                      : "") +
                      ".";
    }
    if (known.limit_Pa && facts.highest_pressure_Pa) {
      const double share = *facts.highest_pressure_Pa / *known.limit_Pa;
      finding.tone = tone_of_share(share, known.safe);
      finding.text += " " + reached + " is " + share_text(share) + " the limit pressure, " + io::kilopascals(*known.limit_Pa) +
                      (share > 1.0 ? "" : meaning_of_share(share, known.safe)) + ".";
    }
    return finding;
  }
  if (facts.status == io::RunStatus::limit_point) {
    return {
        Tone::caution,
        begin + "Inflated to " + reached + ". Beyond it no equilibrium was found (limit point): the body balloons or buckles.",
        facts.source};
  }
  if (facts.status == io::RunStatus::wall_contact) {
    const std::string last = facts.last_pressure_Pa ? io::kilopascals(*facts.last_pressure_Pa) : reached;
    return {Tone::caution,
            begin + "Walls of chambers touch beyond " + last + (facts.plena > 1 ? " of one of them" : "") +
                ". The finite elements end there.",
            facts.source};
  }
  return {Tone::caution,
          begin + "Inflated to " + reached + " only (" + with_reason(facts.status, facts.reason) +
              "). What happens beyond is not known.",
          facts.source};
}

Finding calibration_finding(const CalibrationFacts& facts) {
  if (!facts.median_error)
    return {Tone::bad, "The calibration of the surrogate gave no result (" + with_reason(facts.status, facts.reason) + ").",
            facts.source};
  std::string text =
      "The fitted surrogate is " + io::percents(*facts.median_error) + " off the finite elements it was fitted to (median of " +
      io::counted(facts.quantities, "quantity", "quantities") + " of " + io::counted(facts.cases, "load case") + ")";
  if (facts.worst_error) text += "; the worst is " + io::percents(*facts.worst_error) + " off (" + facts.worst_case + ")";
  text += ".";
  if (facts.status != io::RunStatus::completed) text += " The fit ended early (" + with_reason(facts.status, facts.reason) + ").";
  if (!facts.explained) text += " This is more than the uncertainty of the curves explains: the surrogate differs in shape.";
  const bool good = facts.explained && facts.status == io::RunStatus::completed && *facts.median_error <= judged_by::good_error;
  return {good ? Tone::good : Tone::caution, text, facts.source};
}

Tone tone_of_error(double median) {
  if (median <= judged_by::good_error) return Tone::good;
  return median <= judged_by::usable_error ? Tone::caution : Tone::bad;
}

/// Of one body alone, whether the surrogate takes its shape well, as the loop judges it.
/// @pre displacements have a median error
Tone tone_of(const ValidationFacts& facts) {
  if (facts.bodies == 1) {
    const double displacement = std::max(*facts.displacement.median, facts.displacement_outside.value_or(0.0));
    const double volume = std::max(facts.volume.median.value_or(0.0), facts.volume_outside.value_or(0.0));
    return meshes::is_shape_close(displacement, volume, facts.wrong_signs) ? Tone::good : Tone::bad;
  }
  const Tone by_size = tone_of_error(*facts.displacement.median);
  return facts.wrong_signs > 0 ? std::max(by_size, Tone::caution) : by_size;
}

/// Whether all that was compared lies outside the range of the fit, of one body alone.
bool is_all_outside(const ValidationFacts& facts) { return facts.bodies == 1 && !facts.displacement.median && facts.outside > 0; }

/// ": it is longer than the bodies of the fit"; empty if it is not known.
std::string why_text(const ValidationFacts& facts) {
  return facts.outside_why.empty() ? "" : ": " + io::joined(facts.outside_why, "; ");
}

/// " 6 of 36 displacements of at least 0.2 mm go the wrong way: extent y (5 of 5)."; empty if none does.
std::string wrong_signs_text(const ValidationFacts& facts) {
  if (facts.wrong_signs == 0) return "";
  return " " + std::to_string(facts.wrong_signs) + " of " + io::counted(facts.signs, "displacement") + " of at least " +
         io::millimetres(meshes::smallest_signed_m) + (facts.wrong_signs == 1 ? " goes" : " go") +
         " the wrong way: " + io::joined(facts.wrong_ways, ", ") + ".";
}

Finding finding_on_shapes(const ValidationFacts& facts) {
  const ErrorFact& shapes = facts.displacement;
  if (is_all_outside(facts)) {
    const std::string outside = "all that was compared lies outside the range of its fit" + why_text(facts) + ".";
    if (!facts.displacement_outside) return {Tone::bad, "Do not trust the surrogate for this body: " + outside, facts.source};
    const std::string errors = io::percents(*facts.displacement_outside) + " off finite elements (median)" +
                               (facts.volume_outside ? ", its volumes " + io::percents(*facts.volume_outside) : "");
    if (meshes::is_shape_close(*facts.displacement_outside, facts.volume_outside.value_or(0.0), facts.wrong_signs))
      return {Tone::caution, "The surrogate's shapes are " + errors + ", though " + outside, facts.source};
    return {Tone::bad,
            "Do not trust the surrogate for this body: its shapes are " + errors + "." + wrong_signs_text(facts) + " Also, " +
                outside,
            facts.source};
  }
  if (!shapes.median) {
    return {
        Tone::caution,
        "Whether the surrogate takes the right shapes is not known: no displacement was compared inside the range of its fit.",
        facts.source};
  }
  const bool has_bodies = facts.bodies > 1;
  std::string text = "The surrogate's shapes are " + io::percents(*shapes.median) +
                     (shapes.median_m && !has_bodies ? " (" + io::millimetres(*shapes.median_m, 2) + ")" : "") +
                     " off finite elements (median of " + io::counted(shapes.count, "displacement") + " of " +
                     io::counted(facts.bodies, "body", "bodies") + ", inside the range of the fit";
  if (shapes.worst) {
    text += "; the worst is " + io::percents(*shapes.worst) + " off";
    if (shapes.worst_m) text += ", or " + io::millimetres(*shapes.worst_m);
    if (has_bodies) text += ", of " + shapes.worst_body;
    if (shapes.worst_m) text += (has_bodies ? " in " : ", in ") + shapes.worst_observable;
  }
  if (shapes.furthest_m && shapes.furthest_error && shapes.worst_m && *shapes.worst_m < *shapes.furthest_m) {
    text += "; furthest off over the length of its body, by " + io::millimetres(*shapes.furthest_m) + " or " +
            io::percents(*shapes.furthest_error) + ", is " + (has_bodies ? shapes.furthest_body + " in " : "") +
            shapes.furthest_observable;
  }
  text += ")";
  if (facts.volume.median) text += ", its volumes " + io::percents(*facts.volume.median);
  text += ".";
  text += wrong_signs_text(facts);
  if (shapes.without_equilibrium > 0)
    text += " In " + io::counted(shapes.without_equilibrium, "state") + " it found no equilibrium.";
  if (facts.outside > 0) {
    text += " " +
            io::counted(facts.outside, "number outside the range of the fit does", "numbers outside the range of the fit do") +
            " not count here" + (has_bodies ? "" : why_text(facts)) + ".";
  }
  if (facts.bodies == 1 && tone_of(facts) == Tone::bad) text += " Do not trust the surrogate for this body.";
  return {tone_of(facts), text, facts.source};
}

Finding validation_finding(const ValidationFacts& facts) {
  Finding finding = finding_on_shapes(facts);
  if (facts.early_end.empty()) return finding;
  finding.text += " Its finite elements, quadratic ones, ended before the pressure of the drive (" + facts.early_end + ").";
  finding.tone = std::max(finding.tone, Tone::caution);
  return finding;
}

/// Whether a motion is no walk: it is too short, or the body fell over.
bool goes_nowhere(const WalkFacts& walk) {
  return walk.fell_s || (walk.body_lengths && *walk.body_lengths < meshes::walk_limits::least_body_lengths);
}

/// "on finite elements", "in the surrogate", "as voxels"
std::string in_model(WalkModel model) {
  return std::string(model == WalkModel::surrogate ? "in " : model == WalkModel::voxels ? "as " : "on ") + to_string(model);
}

Finding walk_finding(const WalkFacts& walk, const std::string& begin) {
  const std::string on = in_model(walk.model);
  if (!walk.body_lengths || !walk.per_minute) {
    return {Tone::bad,
            begin + "The walk " + on + " ended after " + io::shown(walk.time_s, 3) + " s (" +
                with_reason(walk.status, walk.reason) + ").",
            walk.source};
  }
  std::string text = begin + "It moves " + io::body_lengths(*walk.body_lengths) + " " + on + " in " + io::shown(walk.time_s, 3) +
                     " s, " + speed_text(*walk.per_minute);
  if (walk.fell_s) return {Tone::caution, text + ".", walk.source};  // that it fell is a finding of its own
  if (goes_nowhere(walk)) return {Tone::caution, text + ": it does not walk.", walk.source};
  if (walk.direction_deg) text += ", towards " + shown_whole(*walk.direction_deg) + " degrees from x";
  text += ".";
  if (walk.model == WalkModel::elements) return {Tone::good, text, walk.source};
  text += walk.model == WalkModel::surrogate ? " Its distances are not to be trusted without finite elements beside them."
                                             : " These are solid voxels, not hollow silicone.";
  return {Tone::caution, text, walk.source};
}

/// Whether a walk goes to and fro: where it ends, and so its direction, depends on when one looks. It does if it comes back by
/// more than half of the way to its end. A step back of a walker that then goes on is none.
bool goes_to_and_fro(const WalkFacts& walk) {
  constexpr double largest_share = 0.5;
  if (goes_nowhere(walk) || !walk.body_lengths || !walk.lowest_lengths || !walk.highest_lengths) return false;
  return walk.retreat_lengths.value_or(0.0) >
         std::max(meshes::walk_limits::least_body_lengths, largest_share * *walk.body_lengths);
}

Finding to_and_fro_finding(const WalkFacts& walk, const std::string& begin) {
  return {Tone::caution,
          begin + "The walk " + in_model(walk.model) + " goes to and fro: along the line to its end it is between " +
              io::shown(*walk.lowest_lengths, 2) + " and " + io::body_lengths(*walk.highest_lengths) + ", comes back by up to " +
              io::shown(*walk.retreat_lengths, 2) + ", and ends at " + io::shown(*walk.body_lengths, 2) +
              ". Its direction and distance depend on when one looks.",
          walk.source};
}

/// Whether a body that does not walk goes some way all the same, and comes back.
bool wanders(const WalkFacts& walk) {
  return goes_nowhere(walk) && !walk.fell_s && walk.farthest_m && walk.end_m &&
         walk.farthest_lengths.value_or(0.0) > meshes::walk_limits::least_body_lengths;
}

/// The line to the end of such a walk is chance: no direction is told.
Finding wander_finding(const WalkFacts& walk, const std::string& begin) {
  return {Tone::caution,
          begin + "What it does " + in_model(walk.model) + " is no walk: it wanders up to " +
              io::millimetres(*walk.farthest_m, 2) + " from its start, and ends " + io::millimetres(*walk.end_m, 2) + " from it.",
          walk.source};
}

Finding fall_finding(const WalkFacts& walk, const std::string& begin) {
  return {Tone::caution,
          begin + "The body falls over " + in_model(walk.model) + ", at " + io::shown(*walk.fell_s, 2) + " s: this is no walk.",
          walk.source};
}

bool has_walked(const WalkFacts& walk) { return walk.body_lengths && walk.per_minute; }

/// @pre both have walked
meshes::WalkAgreement agreement_of(const WalkFacts& a, const WalkFacts& b) {
  const auto outcome = [](const WalkFacts& walk) {
    return meshes::WalkOutcome{walk.fell_s ? 0.0 : *walk.body_lengths, walk.time_s, walk.direction_deg};
  };
  return meshes::compare_walks(outcome(a), outcome(b));
}

/// The angle between two walks; nothing if one of them has no direction, as what is no walk has none.
std::optional<double> angle_of(const WalkFacts& a, const WalkFacts& b) {
  if (!a.direction_deg || !b.direction_deg || goes_nowhere(a) || goes_nowhere(b)) return std::nullopt;
  return meshes::angle_between(*a.direction_deg, *b.direction_deg);
}

/// What a comparison of walks in both models says, and what follows for the surrogate.
struct WalkJudgement {
  Finding finding;
  std::optional<Tone> surrogate{};  ///< of the surrogate for this walk; nothing if this cannot be said
};

/// @param is_known whether finite elements agree among themselves on this walk
WalkJudgement judge_pair(const WalkFacts& elements, const WalkFacts& surrogate, bool is_known, const std::string& begin) {
  WalkJudgement judged{.finding = {Tone::bad, begin, elements.source + ", " + surrogate.source}};
  std::string& text = judged.finding.text;
  const std::string other = surrogate.model == WalkModel::voxels ? "as voxels" : "in the surrogate";
  const auto conclude = [&](Tone tone, std::optional<Tone> trust, const std::string& words) {
    judged.finding.tone = tone;
    judged.surrogate = trust;
    text += words;
    return judged;
  };
  if (!has_walked(elements) || !has_walked(surrogate)) {
    text += "One of both models did not complete the walk (finite elements: " + with_reason(elements.status, elements.reason) +
            "; surrogate: " + with_reason(surrogate.status, surrogate.reason) + "): they cannot be compared.";
    if (elements.per_minute) judged.surrogate = Tone::bad;
    return judged;
  }
  text += (!is_known || goes_nowhere(elements) || goes_nowhere(surrogate) ? "It moves " : "It walks ") +
          speed_text(*elements.per_minute) + " on finite elements and " + speed_number(*surrogate.per_minute) + " " + other;
  const meshes::WalkAgreement agreement = agreement_of(elements, surrogate);
  const bool both_walk =
      agreement != meshes::WalkAgreement::both_go_nowhere && agreement != meshes::WalkAgreement::one_goes_nowhere;
  if (const auto angle_deg = angle_of(elements, surrogate); angle_deg && both_walk && is_known) {
    const bool differs = *angle_deg > meshes::walk_limits::same_direction_deg;
    text += (differs ? ", in another direction (" : ", in about the same direction (") + io::degrees(*angle_deg) + " apart)";
  }
  if (!is_known)
    return conclude(Tone::note, std::nullopt,
                    ". Finite elements do not agree on this walk, so this says nothing of the surrogate.");
  switch (agreement) {
    case meshes::WalkAgreement::alike:
      return conclude(Tone::good, Tone::good, ". Both models agree on this walk.");
    case meshes::WalkAgreement::both_go_nowhere:
      return conclude(Tone::caution, std::nullopt, ": it walks in neither, so they cannot be compared.");
    case meshes::WalkAgreement::same_direction:
      return conclude(Tone::caution, Tone::caution, ". The surrogate tells where this body goes, not how fast.");
    case meshes::WalkAgreement::different:
      return conclude(Tone::bad, Tone::bad, ". Do not trust the surrogate for the walk of this body.");
    case meshes::WalkAgreement::one_goes_nowhere:
      break;
  }
  return conclude(Tone::bad, Tone::bad,
                  std::string(": ") + (goes_nowhere(elements) ? "on finite elements" : other) +
                      " it does not walk. Do not trust the surrogate for the walk of this body.");
}

/// Whether two walks can be compared: of one body driven alike, and equally long. One that ended early can be told of beside a
/// whole one.
bool are_comparable(const WalkFacts& a, const WalkFacts& b) {
  return are_one_walk(a.stated, b.stated) && (!has_walked(a) || !has_walked(b) || meshes::last_as_long(a.time_s, b.time_s));
}

/// Whether two walks go the same way, however far.
bool have_one_direction(const WalkFacts& a, const WalkFacts& b) {
  const auto angle_deg = angle_of(a, b);
  return angle_deg && *angle_deg <= meshes::walk_limits::same_direction_deg;
}

/// Walks of one body on finite elements, driven alike and equally long: their meshes or time steps differ.
struct ElementWalks {
  std::vector<const WalkFacts*> walks;
  meshes::WalkAgreement worst = meshes::WalkAgreement::alike;  ///< of any two of them
  std::pair<const WalkFacts*, const WalkFacts*> worst_pair{};  ///< null if there is only one

  [[nodiscard]] bool are_known() const { return worst <= meshes::WalkAgreement::same_direction; }
  [[nodiscard]] bool has(const WalkFacts& walk) const { return std::ranges::find(walks, &walk) != walks.end(); }
};

/// All walks on finite elements that completed, together with those of the same walk.
std::vector<ElementWalks> element_walks(const std::vector<WalkFacts>& walks) {
  std::vector<ElementWalks> groups;
  for (const WalkFacts& walk : walks) {
    if (walk.model != WalkModel::elements || !has_walked(walk)) continue;
    auto group = std::ranges::find_if(groups, [&](const ElementWalks& known) {
      return std::ranges::all_of(known.walks, [&](const WalkFacts* other) { return are_comparable(walk, *other); });
    });
    if (group == groups.end()) group = groups.insert(groups.end(), ElementWalks{.walks = {}});
    for (const WalkFacts* other : group->walks) {
      const meshes::WalkAgreement agreement = agreement_of(*other, walk);
      if (group->worst_pair.first != nullptr && agreement <= group->worst) continue;
      group->worst = agreement;
      group->worst_pair = {other, &walk};
    }
    group->walks.push_back(&walk);
  }
  return groups;
}

/// @pre there are at least two walks
Finding element_walks_finding(const ElementWalks& group, bool several_bodies) {
  const auto& [one, other] = group.worst_pair;
  Finding finding{Tone::good, several_bodies ? one->name + ": " : "", one->source + ", " + other->source};
  finding.text += io::counted(group.walks.size(), "walk") + " on finite elements, of one body driven alike (" + one->place +
                  " and " + other->place + (group.walks.size() > 2 ? " differ most" : "") +
                  "): " + speed_number(*one->per_minute) + " and " + speed_text(*other->per_minute);
  if (const auto angle_deg = angle_of(*one, *other)) finding.text += ", " + io::degrees(*angle_deg) + " apart";
  switch (group.worst) {
    case meshes::WalkAgreement::alike:
      finding.text += ". They agree, so this walk is known as far as finite elements go.";
      break;
    case meshes::WalkAgreement::both_go_nowhere:
      finding.tone = Tone::caution;
      finding.text += ". It does not walk.";
      break;
    case meshes::WalkAgreement::same_direction:
      finding.tone = Tone::caution;
      finding.text += ". They tell where this body goes, not how fast.";
      break;
    case meshes::WalkAgreement::different:
    case meshes::WalkAgreement::one_goes_nowhere:
      finding.tone = Tone::bad;
      finding.text += have_one_direction(*one, *other) ? ". The direction of this walk is known, its distance is not."
                                                       : ". How it walks is not known: chance decides such a walk.";
      break;
  }
  return finding;
}

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

Finding modes_finding(const ModesFacts& facts) {
  if (!facts.first_frequency_Hz)
    return {Tone::caution, "No natural frequency was found (" + std::string(io::to_string(facts.status)) + ").", facts.source};
  return {Tone::good, "The lowest natural frequency is " + shown_number(*facts.first_frequency_Hz) + " Hz.", facts.source};
}

/// Two walks of one body, driven alike and equally long, in both models.
using WalkPair = std::pair<const WalkFacts*, const WalkFacts*>;

std::vector<WalkPair> pairs_of(const std::vector<WalkFacts>& walks) {
  std::vector<WalkPair> pairs;
  for (const WalkFacts& elements : walks) {
    if (elements.model != WalkModel::elements) continue;
    for (const WalkFacts& other : walks)
      if (other.model != WalkModel::elements && are_comparable(elements, other)) pairs.emplace_back(&elements, &other);
  }
  return pairs;
}

/// What walks say of the surrogate.
struct WalkTrust {
  bool were_compared = false;         ///< whether a body walks in both models, driven alike
  bool are_in_both = false;           ///< whether there are walks in both models, of whatever bodies
  bool are_known = true;              ///< whether finite elements agree among themselves on every walk
  std::optional<Tone> trusted{};      ///< the worst of all comparisons; nothing if they say nothing
  std::vector<std::string> bodies{};  ///< the bodies of which that is said
};

/// A median error that is more than this times the expected one is told.
constexpr double much_more = 1.5;

/// The median error in a line of voxel::expected_error_text: "expected error for a block: 9.3 % in displacement ..."
std::optional<double> expected_displacement_error(const std::string& line) {
  const std::size_t end = line.find(" % in displacement");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t begin = line.rfind(' ', end - 1) + 1;
  double percents = 0.0;
  const auto [rest, fault] = std::from_chars(line.data() + begin, line.data() + end, percents);
  return fault == std::errc() && rest == line.data() + end ? std::optional(0.01 * percents) : std::nullopt;
}

/// Whether all walks are of one body. What a validation of one body says is then of this one: it does not state which it had.
bool are_of_one_body(const std::vector<WalkFacts>& walks) {
  return std::ranges::all_of(walks, [&](const WalkFacts& other) {
    return &other == &walks.front() || are_of_one_body(walks.front().stated, other.stated);
  });
}

/// Adds what the surrogate of a walk is expected to be off, beside what was measured on its body. Where no other body is known,
/// the expected error is that measured one, which has a finding of its own.
void add_expected_errors(const WalkFacts& walk, const ReportFacts& facts, const std::string& begin,
                         std::vector<Finding>& findings) {
  const std::vector<ValidationFacts>& validations = facts.validations;
  const bool is_measured = validations.size() == 1 && validations.front().bodies == 1 &&
                           validations.front().displacement.median && are_of_one_body(facts.walks);
  const auto is_of_one = [](const std::string& line) { return line.find("over 1 body") != std::string::npos; };
  if (is_measured && std::ranges::any_of(walk.expected_error, is_of_one)) return;
  for (const std::string& line : walk.expected_error) {
    Finding finding{Tone::caution, begin + sentence_of(line), walk.source};
    if (is_measured && line.starts_with("expected error")) {
      const ValidationFacts& own = validations.front();
      finding.text += " Measured on this body: " + io::percents(*own.displacement.median) + " in displacement";
      if (own.displacement.percentile_90)
        finding.text += " (one displacement in ten by more than " + io::percents(*own.displacement.percentile_90) + ")";
      if (own.volume.median) finding.text += " and " + io::percents(*own.volume.median) + " in chamber volume";
      finding.text += ".";
      const auto expected = expected_displacement_error(line);
      if (expected && *own.displacement.median > much_more * *expected) {
        finding.text += " This body is further off than others of its kind.";
        finding.tone = Tone::bad;
      }
      finding.source += ", " + own.source;
    }
    findings.push_back(std::move(finding));
  }
}

/// Adds the findings on walks.
WalkTrust add_walks(const ReportFacts& facts, std::vector<Finding>& findings) {
  WalkTrust trust;
  const std::vector<WalkPair> pairs = pairs_of(facts.walks);
  trust.were_compared = !pairs.empty();
  const std::vector<ElementWalks> groups = element_walks(facts.walks);
  for (const ElementWalks& group : groups) {
    if (group.walks.size() < 2) continue;
    findings.push_back(element_walks_finding(group, groups.size() > 1));
    trust.are_known = trust.are_known && group.are_known();
  }
  for (const auto& [elements, surrogate] : pairs) {
    const bool is_known = std::ranges::none_of(
        groups, [&, walk = elements](const ElementWalks& group) { return group.has(*walk) && !group.are_known(); });
    const WalkJudgement judged = judge_pair(*elements, *surrogate, is_known, label_of(*elements, facts.walks));
    findings.push_back(judged.finding);
    if (!judged.surrogate || (trust.trusted && *judged.surrogate < *trust.trusted)) continue;
    if (trust.trusted != judged.surrogate) trust.bodies.clear();
    trust.trusted = judged.surrogate;
    if (std::ranges::find(trust.bodies, elements->name) == trust.bodies.end()) trust.bodies.push_back(elements->name);
  }
  for (const WalkFacts& walk : facts.walks) {
    const bool is_paired =
        std::ranges::any_of(pairs, [&](const WalkPair& pair) { return pair.first == &walk || pair.second == &walk; });
    const std::string begin = label_of(walk, facts.walks);
    if (!is_paired) findings.push_back(walk_finding(walk, begin));
    if (goes_to_and_fro(walk)) findings.push_back(to_and_fro_finding(walk, begin));
    if (wanders(walk)) findings.push_back(wander_finding(walk, begin));
    if (walk.fell_s) findings.push_back(fall_finding(walk, begin));
    for (const std::string& line : walk.outside_validity) {
      const bool is_told = std::ranges::any_of(
          walk.expected_error, [&](const std::string& expected) { return expected.find(line) != std::string::npos; });
      if (is_told) continue;
      findings.push_back({Tone::caution,
                          std::string(begin).append("Beyond what the surrogate was fitted to: ").append(line).append("."),
                          walk.source});
    }
    add_expected_errors(walk, facts, begin, findings);
  }
  const auto has = [&](auto is) { return std::ranges::any_of(facts.walks, is); };
  const bool has_elements = has([](const WalkFacts& walk) { return walk.model == WalkModel::elements; });
  const bool has_other = has([](const WalkFacts& walk) { return walk.model != WalkModel::elements; });
  if (!has_elements && facts.robot_walks) findings.push_back(missing("A walk on finite elements", "locomote"));
  if (!has_other && facts.robot_walks) findings.push_back(missing("A walk in the surrogate", "simulate"));
  trust.are_in_both = has_elements && has_other;
  if (trust.are_in_both && pairs.empty()) {
    findings.push_back(
        {Tone::missing,
         "No body walks in both models with the same walls, silicone, drive and friction for the same time, so the "
         "walks cannot be compared.",
         "menger simulate, menger locomote"});
  }
  return trust;
}

/// Whether there are inflations, all of one body. What one of them does not state, two others may state differently.
bool are_of_one_body(const std::vector<InflationFacts>& inflations) {
  if (inflations.size() <= 1) return inflations.size() == 1;
  return std::ranges::all_of(inflations, [&](const InflationFacts& one) {
    return std::ranges::all_of(inflations,
                               [&](const InflationFacts& other) { return are_of_one_body(one.stated, other.stated); });
  });
}

/// Which of several inflations of a body says how far it can be used: that with the lowest limit pressure, or else the highest
/// pressure.
const InflationFacts& decisive(const std::vector<InflationFacts>& inflations) {
  return *std::ranges::min_element(inflations, [](const InflationFacts& a, const InflationFacts& b) {
    if (a.limit && b.limit) return a.limit->pressure_Pa < b.limit->pressure_Pa;
    if (a.limit || b.limit) return a.limit.has_value();
    return a.highest_pressure_Pa.value_or(0.0) > b.highest_pressure_Pa.value_or(0.0);
  });
}

/// The sentence of the headline on pressure; empty if there is none.
std::string pressure_headline(const ReportFacts& facts, Tone& tone) {
  if (!are_of_one_body(facts.inflations)) return {};
  const InflationFacts& one = decisive(facts.inflations);
  const KnownPressures known = known_pressures(facts, one);
  tone = inflation_finding(one, known, "").tone;
  if (one.limit) {
    const std::string limit = io::kilopascals(one.limit->pressure_Pa) + ", where the body balloons or buckles";
    const double share = known.drive_Pa.value_or(0.0) / one.limit->pressure_Pa;
    const double safe = safe_share(one);
    if (share > safe)
      return "The drive of " + io::kilopascals(*known.drive_Pa) + " is " + share_text(share) + " the limit pressure of " + limit +
             (share > 1.0 ? "." : meaning_of_share(share, safe) + ".") + " ";
    return "Usable up to " + io::kilopascals(io::rounded_towards_rest(safe * one.limit->pressure_Pa)) + ", 20 % or more below " +
           limit + ". ";
  }
  if (!one.highest_pressure_Pa || *one.highest_pressure_Pa <= 0.0) return {};
  const std::string reached = io::kilopascals(*one.highest_pressure_Pa);
  const std::string safe = io::kilopascals(io::rounded_towards_rest(safe_share(one) * *one.highest_pressure_Pa));
  if (one.status == io::RunStatus::completed)
    return "Usable up to " + safe + " at least, 20 % or more below the " + reached + " to which it was inflated. ";
  if (one.status == io::RunStatus::limit_point)
    return "Usable up to " + safe + ", 20 % or more below " + reached + ", beyond which the body balloons or buckles. ";
  return "Known up to " + reached + " only. ";
}

/// Which of several tones is worse: `missing` is none.
Tone worse_of(Tone a, Tone b) {
  if (a == Tone::missing || b == Tone::missing) return a == Tone::missing ? b : a;
  return std::max(a, b);
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

/// What a validation means for the shapes of the surrogate; missing if nothing was compared.
Tone tone_of_shapes(const ValidationFacts& facts) {
  if (facts.displacement.median) return tone_of(facts);
  return is_all_outside(facts) && facts.displacement_outside ? finding_on_shapes(facts).tone : Tone::missing;
}

/// The sentence of the headline on shapes. @param worst of all validations
std::string shape_headline(const ReportFacts& facts, Tone worst, bool were_walks_compared) {
  const std::string walks = were_walks_compared ? "its walks say nothing." : "its walks were not compared.";
  const bool is_close_outside =
      worst == Tone::caution && facts.validations.size() == 1 && is_all_outside(facts.validations.front());
  if (is_close_outside)
    return "The surrogate's shapes are close to finite elements, though outside the range of its fit; " + walks;
  if (worst == Tone::good) return "The surrogate's shapes can be used; " + walks;
  return (worst == Tone::caution ? "The surrogate's shapes are rough; " : "Do not trust the surrogate's shapes; ") + walks;
}

/// The sentence of the headline on walks that both models make. It names their bodies where the page tells of others, too.
std::string walk_headline(const ReportFacts& facts, const WalkTrust& walks) {
  const bool has_one_body = are_of_one_body(facts.walks) && facts.rankings.empty() && facts.searches.empty();
  const std::string bodies = io::joined(walks.bodies);
  const bool several = walks.bodies.size() > 1;
  if (*walks.trusted == Tone::good)
    return has_one_body ? "The surrogate walks as finite elements do."
                        : "With " + bodies + ", the surrogate walks as finite elements do.";
  if (*walks.trusted == Tone::caution)
    return "The surrogate tells where " + (has_one_body ? "this body walks" : bodies + (several ? " walk" : " walks")) +
           ", not how fast: let finite elements decide.";
  return "Do not trust the surrogate for the walk of " + (has_one_body ? "this body" : bodies) + ": let finite elements decide.";
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
  Tone shapes = Tone::missing;
  for (const ValidationFacts& one : facts.validations) shapes = worse_of(shapes, tone_of_shapes(one));
  if (shapes != Tone::missing) return conclude(shapes, shape_headline(facts, shapes, walks.were_compared));
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
  for (const InflationFacts& inflation : facts.inflations)
    findings.push_back(inflation_finding(inflation, known_pressures(facts, inflation), label_of(inflation, facts.inflations)));
  if (facts.inflations.empty()) findings.push_back(missing("The pressure that the body bears", "inflate"));
  const WalkTrust walks = add_walks(facts, findings);
  for (const ValidationFacts& validation : facts.validations) findings.push_back(validation_finding(validation));
  if (facts.validations.empty()) findings.push_back(missing("How far the surrogate's shapes are off", "validate"));
  for (const CalibrationFacts& calibration : facts.calibrations) findings.push_back(calibration_finding(calibration));
  for (const ShippedParameters& shipped : facts.shipped)
    findings.push_back({Tone::note, "The parameters of the surrogate came with menger: " + shipped.file + ".", shipped.source});
  if (facts.calibrations.empty() && facts.shipped.empty())
    findings.push_back(missing("A calibration of the surrogate", "calibrate"));
  for (const SearchFacts& search : facts.searches) findings.push_back(search_finding(search, facts.searches.size() > 1));
  for (const RankingFacts& ranking : facts.rankings) findings.push_back(ranking_finding(ranking));
  if (!facts.searches.empty() && facts.rankings.empty())
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
          " of the limit pressure; above, small faults of a cast wall decide. Thin walls put it " +
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
