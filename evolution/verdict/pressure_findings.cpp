#include "evolution/verdict/pressure_findings.h"

#include <algorithm>
#include <optional>

#include "evolution/verdict/finding_words.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/load_cases/shape_agreement.h"

namespace menger::evolution {
namespace {

std::string label_of(const InflationFacts& inflation, const std::vector<InflationFacts>& all) {
  return label_of(inflation, all, [](const InflationFacts&, const InflationFacts&) { return true; });
}

/// "40 times", "92 % of"
std::string share_text(double share) {
  constexpr double least_times = 1.5;
  return share < least_times ? io::percents(share) + " of" : io::shown(share, 2) + " times";
}

/// The share of a limit pressure, or of one that a body bore, up to which it is safe.
double safe_share(const InflationFacts& limited) {
  const bool has_thin_walls = limited.stated.elements == "thin_wall";
  return meshes::largest_safe_share * (has_thin_walls ? meshes::least_limit_of_thin_walls_Pa(1.0) : 1.0);
}

/// "4.84 kPa, 20 % or more below 6.06 kPa"
std::string safe_text(const InflationFacts& facts, double pressure_Pa, const std::string& what) {
  return io::kilopascals(io::rounded_towards_rest(safe_share(facts) * pressure_Pa)) + what + ", " + meshes::safe_margin_text() +
         " or more below " + io::kilopascals(pressure_Pa);
}

/// Pressures of other results of the body of an inflation.
struct KnownPressures {
  std::optional<double> drive_Pa{};          ///< the highest of the drives of its walks
  std::optional<double> searched_Pa{};       ///< up to which a limit pressure was searched for and not found
  std::optional<double> limit_Pa{};          ///< the lowest limit pressure of its inflations
  double safe = meshes::largest_safe_share;  ///< see safe_share; of that inflation
  std::optional<double> softest_limit_Pa{};  ///< by the softest law of its silicone
  [[nodiscard]] bool is_softest_unsafe() const {
    return drive_Pa && softest_limit_Pa && *drive_Pa > meshes::largest_safe_share * *softest_limit_Pa;
  }
};

KnownPressures known_pressures(const ReportFacts& facts, const InflationFacts& inflation) {
  KnownPressures known;
  // The stages of the loop that are about its robot.
  if (inflation.place == "limit" || inflation.place == "inflate") known.softest_limit_Pa = facts.softest_limit_Pa;
  for (const WalkFacts& walk : facts.walks) {
    const auto& drive_Pa = walk.stated.highest_pressure_Pa;
    if (drive_Pa && are_of_one_body(walk.stated, inflation.stated))
      known.drive_Pa = std::max(known.drive_Pa.value_or(*drive_Pa), *drive_Pa);
  }
  for (const InflationFacts& other : facts.inflations) {
    const bool is_search = other.place == "limit" && !other.limit && are_of_one_body(other.stated, inflation.stated);
    if (is_search) known.searched_Pa = other.highest_pressure_Pa;
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
                  io::kilopascals(io::rounded_towards_rest(safe_share(facts) * limit_Pa)) + " it is " +
                  meshes::safe_margin_text() + " or more below that";
  if (facts.stated.elements == "thin_wall")
    finding.text += " and below what it may be: thin walls put limit pressures " + meshes::thin_wall_excess_text() +
                    " higher than three-field elements do (fem/load_cases/README.md)";
  finding.text += ".";
  if (known.drive_Pa) {
    const double share = *known.drive_Pa / limit_Pa;
    finding.tone = tone_of_share(share, safe_share(facts));
    finding.text += " The drive of " + io::kilopascals(*known.drive_Pa) + " is " + share_text(share) + " the limit pressure" +
                    meaning_of_share(share, safe_share(facts)) + ".";
  }
  if (known.drive_Pa && known.softest_limit_Pa) {
    if (known.is_softest_unsafe()) finding.tone = std::max(finding.tone, Tone::caution);
    finding.text += " By the softest law of its silicone it balloons near " + io::kilopascals(*known.softest_limit_Pa) +
                    ", of which the drive is " + io::percents(*known.drive_Pa / *known.softest_limit_Pa) + ".";
  }
  return finding;
}

/// What lies between a pressure that a body bore and that at which it balloons. @pre no limit pressure of it is known
std::string unknown_limit_text(const InflationFacts& facts, const KnownPressures& known) {
  std::string text = known.searched_Pa
                         ? " No limit pressure was found up to " + io::kilopascals(*known.searched_Pa)
                         : std::string(" How far this is from ballooning was not computed (path.volume_ratio, or menger loop)");
  if (facts.stated.elements == "thin_wall") text += "; thin walls balloon " + meshes::thin_wall_excess_text() + " too late";
  return text + ".";
}

/// How far the far end of a body that floats free moves; empty if it is not known.
std::string bend_text(const InflationFacts& facts) {
  if (!facts.sideways_m) return "";
  const bool has_thin_walls = facts.stated.elements == "thin_wall";
  return " The middle of its far end moves " + io::millimetres(*facts.sideways_m) + " sideways, seen from the near one" +
         (has_thin_walls
              ? "; thin walls bend fingers " + meshes::thin_wall_bend_deficit_text(facts.stated.fidelity) + " too little"
              : "") +
         ".";
}

/// What follows for a drive that is above what is safe by the pressure to which a body was inflated; empty if it is not.
std::string untested_drive_text(const InflationFacts& facts, const KnownPressures& known) {
  if (known.limit_Pa || !known.drive_Pa || !facts.highest_pressure_Pa) return "";
  if (*known.drive_Pa <= safe_share(facts) * *facts.highest_pressure_Pa) return "";
  return "Whether its drive of " + io::kilopascals(*known.drive_Pa) + " is safe is not known.";
}

/// Of an inflation whose path was followed to its end.
Finding completed_finding(const InflationFacts& facts, const KnownPressures& known, const std::string& begin, bool is_vacuum,
                          const std::string& reached) {
  const std::string by = facts.stated.elements == "thin_wall" ? " by thin walls" : "";
  Finding finding{Tone::good, begin, facts.source};
  finding.text += is_vacuum ? "Evacuated to " + reached + by + ", where no walls of its chambers touch."
                            : "Inflated to " + reached + by + ", without a limit point up to there.";
  if (facts.volume_growth)
    finding.text += (facts.plena > 1 ? " Of its chambers, the one that grows most then has " : " Its chamber then has ") +
                    io::shown(1.0 + *facts.volume_growth, 3) + " times its volume at rest.";
  finding.text += bend_text(facts);
  if (is_vacuum) return finding;
  if (!known.limit_Pa) {
    finding.text += unknown_limit_text(facts, known);
    if (const std::string untested = untested_drive_text(facts, known); !untested.empty()) {
      finding.text += " " + untested;
      finding.tone = Tone::caution;
    }
  } else if (facts.highest_pressure_Pa) {
    const double share = *facts.highest_pressure_Pa / *known.limit_Pa;
    finding.tone = tone_of_share(share, known.safe);
    finding.text += " " + reached + " is " + share_text(share) + " the limit pressure, " + io::kilopascals(*known.limit_Pa) +
                    (share > 1.0 ? "" : meaning_of_share(share, known.safe)) + ".";
  }
  if (known.is_softest_unsafe()) finding.tone = std::max(finding.tone, Tone::caution);
  return finding;
}

Finding inflation_finding(const InflationFacts& facts, const KnownPressures& known, const std::string& begin) {
  if (facts.limit) return limit_finding(facts, known, begin);
  const bool is_vacuum = facts.highest_pressure_Pa.value_or(1.0) <= 0.0 && facts.lowest_pressure_Pa.value_or(0.0) < 0.0;
  const std::string reached = is_vacuum                   ? io::kilopascals(*facts.lowest_pressure_Pa)
                              : facts.highest_pressure_Pa ? io::kilopascals(*facts.highest_pressure_Pa)
                                                          : "no pressure";
  if (facts.status == io::RunStatus::completed) return completed_finding(facts, known, begin, is_vacuum, reached);
  const std::string came_to = begin + (is_vacuum ? "Evacuated to " : "Inflated to ") + reached;
  if (facts.status == io::RunStatus::limit_point) {
    return {Tone::caution,
            came_to + ". Beyond it no equilibrium was found (limit point): the body " +
                (is_vacuum ? "buckles." : "balloons or buckles."),
            facts.source};
  }
  if (facts.status == io::RunStatus::wall_contact) {
    const std::string last = facts.last_pressure_Pa ? io::kilopascals(*facts.last_pressure_Pa) : reached;
    return {Tone::caution,
            begin + "Walls of chambers touch beyond " + last + (facts.plena > 1 ? " of one of them" : "") +
                ". The finite elements end there.",
            facts.source};
  }
  return {Tone::caution, came_to + " only (" + with_reason(facts.status, facts.reason) + "). What happens beyond is not known.",
          facts.source};
}

/// Whether there are inflations, all of one body. What one of them does not state, two others may state differently.
bool are_of_one_body(const std::vector<InflationFacts>& inflations) {
  if (inflations.size() <= 1) return inflations.size() == 1;
  return std::ranges::all_of(inflations, [&](const InflationFacts& one) {
    return std::ranges::all_of(inflations,
                               [&](const InflationFacts& other) { return are_of_one_body(one.stated, other.stated); });
  });
}

/// Which of several inflations of a body says how far it can be used: that with the lowest limit pressure; or else one that found
/// no equilibrium beyond its last pressure; or else that up to whose pressure most is safe.
const InflationFacts& decisive(const std::vector<InflationFacts>& inflations) {
  const auto safe_Pa = [](const InflationFacts& one) { return safe_share(one) * one.highest_pressure_Pa.value_or(0.0); };
  return *std::ranges::min_element(inflations, [&](const InflationFacts& a, const InflationFacts& b) {
    if (a.limit && b.limit) return a.limit->pressure_Pa < b.limit->pressure_Pa;
    if (a.limit || b.limit) return a.limit.has_value();
    const bool a_ends = a.status == io::RunStatus::limit_point;
    const bool b_ends = b.status == io::RunStatus::limit_point;
    if (a_ends || b_ends) return a_ends && b_ends ? safe_Pa(a) < safe_Pa(b) : a_ends;
    return safe_Pa(a) > safe_Pa(b);
  });
}

}  // namespace

std::vector<Finding> pressure_findings(const ReportFacts& facts) {
  std::vector<Finding> findings;
  for (const InflationFacts& inflation : facts.inflations)
    findings.push_back(inflation_finding(inflation, known_pressures(facts, inflation), label_of(inflation, facts.inflations)));
  return findings;
}

std::string pressure_headline(const ReportFacts& facts, Tone& tone) {
  if (!are_of_one_body(facts.inflations)) return {};
  const InflationFacts& one = decisive(facts.inflations);
  const KnownPressures known = known_pressures(facts, one);
  tone = inflation_finding(one, known, "").tone;
  if (one.limit) {
    const double limit_Pa = one.limit->pressure_Pa;
    const double share = known.drive_Pa.value_or(0.0) / limit_Pa;
    const double safe = safe_share(one);
    const std::string where = ", where the body balloons or buckles";
    if (share > safe)
      return "The drive of " + io::kilopascals(*known.drive_Pa) + " is " + share_text(share) + " the limit pressure of " +
             io::kilopascals(limit_Pa) + where + (share > 1.0 ? "." : meaning_of_share(share, safe) + ".") + " ";
    if (known.is_softest_unsafe()) {
      return "The silicone decides whether the drive of " + io::kilopascals(*known.drive_Pa) +
             " is safe: by its softest law the body balloons near " + io::kilopascals(*known.softest_limit_Pa) +
             ", by its own at " + io::kilopascals(limit_Pa) + ". ";
    }
    return "Usable up to " + safe_text(one, limit_Pa, "") + where + ". ";
  }
  if (!one.highest_pressure_Pa || *one.highest_pressure_Pa <= 0.0) return {};
  const double reached_Pa = *one.highest_pressure_Pa;
  if (one.status == io::RunStatus::completed) {
    const std::string untested = untested_drive_text(one, known);
    return "Usable up to " + safe_text(one, reached_Pa, " at least") + ", to which it was inflated. " +
           (untested.empty() ? "" : untested + " ");
  }
  if (one.status == io::RunStatus::limit_point)
    return "Usable up to " + safe_text(one, reached_Pa, "") + ", beyond which the body balloons or buckles. ";
  return "Known up to " + io::kilopascals(reached_Pa) + " only. ";
}

}  // namespace menger::evolution
