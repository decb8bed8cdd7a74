#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "evolution/genome/robot_form.h"
#include "evolution/search/search_plan.h"
#include "voxel/model/parameters.h"

namespace menger::evolution {

/// A search on the voxel engine: everything that decides its result.
struct Study {
  SearchPlan search;
  double duration_s = 5.0;      ///< simulated per evaluation, > 0
  double measure_from_s = 0.0;  ///< displacement counts from then on, >= 0 and < duration_s
  voxel::Physics physics;

  /// Study of re-evaluation that says how search.judging judges; empty in a study that was read from its text, where the hash of
  /// what it says stands.
  std::filesystem::path judge_file{};

  bool operator==(const Study&) const = default;
};

/// What makes two robots of a study different: a drive that is the same for all cells does not tell materials apart, and only a
/// wave asks where a body stands.
Distinction distinction_of(const Study& study);

/// Voxels that a whole cell is made of.
std::size_t voxels_in_cell(const Study& study);

/// What a reader of the results should know about the values of the study, a sentence each.
std::vector<std::string> study_notes(const Study& study);

/// What of a study with calibrated parameters lies outside their range of validity for every body that its search may make, a
/// sentence each: a drive that no single wall was fitted at, nor joints where there are several modules; chambers; the shortest
/// bodies that its cells fit in. Necessary for a body without a fault, not sufficient: which walls a body has is judged body by
/// body (voxel::outside_validity).
std::vector<std::string> outside_validity_of_all(const Study& study);

/// The same for a body of the search that has every wall and is as long as it may be: what some bodies may meet, not all.
std::vector<std::string> outside_validity_of_some(const Study& study);

/// Memory in bytes that evaluations in this many threads may take, when every body is full; saturates at SIZE_MAX.
std::size_t estimated_memory_bytes(const Study& study, int threads);

}  // namespace menger::evolution
