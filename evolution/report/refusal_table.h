#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "evolution/report/generation_summary.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// A body of a search that finite elements refused. It has no fitness.
struct RefusedBody {
  std::uint64_t individual = 0;  ///< the first with this body
  int generation = 0;            ///< in which that was born
  Phenotype simulated;           ///< see as_simulated
  std::string reason;
};

/// The different bodies that a search on finite elements evaluated in its finished generations.
struct Refusals {
  std::size_t bodies = 0;  ///< all of them
  std::vector<RefusedBody> refused;
};

/// Reads which bodies finite elements refused. @param run of a search whose bodies finite elements evaluate
Refusals refusals_of(const RunView& run);

/// Makes a table with a row per body that finite elements refused.
io::CsvTable refusal_table(const Refusals& refusals);

/// Says for people how many bodies finite elements refused, and the most frequent reason, without a full stop; empty if none.
/// Reasons that differ by numbers alone, such as places of cells, are one.
std::string refusal_text(const Refusals& refusals);

}  // namespace menger::evolution
