#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolution/outputs/result_facts.h"
#include "evolution/verdict/finding.h"

namespace menger::evolution {

/// What walks say of the surrogate.
struct WalkTrust {
  bool were_compared = false;         ///< whether a body walks in both models, driven alike
  bool are_in_both = false;           ///< whether there are walks in both models, of whatever bodies
  bool are_known = true;              ///< whether finite elements agree among themselves on every walk
  std::optional<Tone> trusted{};      ///< the worst of all comparisons; nothing if they say nothing
  std::vector<std::string> bodies{};  ///< the bodies of which that is said
};

/// Adds the findings on walks, and on what the surrogates of them are expected to be off.
WalkTrust add_walks(const ReportFacts& facts, std::vector<Finding>& findings);

/// Returns whether all walks are of one body. What a validation of one body says is then of this one: it does not state which it
/// had.
bool are_of_one_body(const std::vector<WalkFacts>& walks);

/// Returns "0.8 body lengths a minute".
std::string speed_text(double per_minute);

/// Returns the sentence of the headline on walks that both models make. It names their bodies where the page tells of others,
/// too.
/// @param walks which say something of the surrogate
std::string walk_headline(const ReportFacts& facts, const WalkTrust& walks);

}  // namespace menger::evolution
