#include "evolution/verdict/walk_findings.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "evolution/outputs/report_numbers.h"
#include "evolution/verdict/finding_words.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

/// "0.8"
std::string speed_number(double per_minute) { return io::shown(per_minute, per_minute < 100.0 ? 2 : 3); }

std::string label_of(const WalkFacts& walk, const std::vector<WalkFacts>& all) {
  return label_of(walk, all, [](const WalkFacts& a, const WalkFacts& b) { return a.model == b.model; });
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
  return meshes::angle_between_directions_deg(*a.direction_deg, *b.direction_deg);
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

}  // namespace

std::string speed_text(double per_minute) { return speed_number(per_minute) + " body lengths a minute"; }

bool are_of_one_body(const std::vector<WalkFacts>& walks) {
  return std::ranges::all_of(walks, [&](const WalkFacts& other) {
    return &other == &walks.front() || are_of_one_body(walks.front().stated, other.stated);
  });
}

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

}  // namespace menger::evolution
