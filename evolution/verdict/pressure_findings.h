#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/result_facts.h"
#include "evolution/verdict/finding.h"

namespace menger::evolution {

/// Returns a finding on each inflation: what it came to, and what that means for the drive of the body.
std::vector<Finding> pressure_findings(const ReportFacts& facts);

/// Returns the sentence of the headline on pressure, with a blank behind it; empty if there is none, as for several bodies.
/// @param tone set to that of the inflation which says how far the body can be used
std::string pressure_headline(const ReportFacts& facts, Tone& tone);

}  // namespace menger::evolution
