#pragma once

#include <cstdint>

#include "evolution/report/generation_summary.h"
#include "evolution/study/study.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// The cost of a generation.
struct GenerationCost {
  std::uint64_t voxel_steps = 0;    ///< voxels times steps, of the evaluations made for it and of its screening
  std::uint64_t element_steps = 0;  ///< elements times steps, of the same on finite elements
};

/// Returns a cost in element-steps.
double counted_cost(const GenerationCost& cost, const Budget& budget);

/// Computes the cost of a generation from the archive.
GenerationCost generation_cost(const RunView& run, int generation);

/// Makes a table with a row per finished generation: its voxel-steps and its element-steps.
io::CsvTable cost_table(const RunView& run);

}  // namespace menger::evolution
