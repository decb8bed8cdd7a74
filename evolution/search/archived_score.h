#pragma once

#include <optional>
#include <string>

#include "evolution/archive/run_archive.h"
#include "evolution/search/search_plan.h"

namespace menger::evolution {

/// Returns the hash of the design that a search at one level evaluates for a phenotype.
std::string simulated_design(const SearchPlan& plan, const Phenotype& phenotype);

/// Returns the score of a design in a search at one level; none if the evaluation failed or is not there.
/// @param design see simulated_design
/// @param latest results that a later generation asked for first are not seen
std::optional<double> archived_score(const SearchPlan& plan, const RunArchive& archive, const std::string& design,
                                     const std::string& physics_hash, std::optional<int> latest = std::nullopt);

}  // namespace menger::evolution
