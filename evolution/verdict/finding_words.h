#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "evolution/verdict/finding.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// "not_converged, the step became too small"
std::string with_reason(io::RunStatus status, const std::string& reason);

/// A line of a program as a sentence.
std::string sentence_of(std::string line);

/// That something was not computed, with the command (without menger) that computes it.
Finding missing(const std::string& what, const std::string& command);

/// Which of two tones is worse: `missing` is none.
Tone worse_of(Tone a, Tone b);

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

}  // namespace menger::evolution
