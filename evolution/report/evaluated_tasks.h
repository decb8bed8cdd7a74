#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "evolution/report/generation_summary.h"

namespace menger::evolution {

/// An evaluation that was made for a generation.
struct EvaluatedTask {
  std::size_t batch = 0;         ///< those of a batch were asked for at once, the next batch when all of it was known
  std::uint64_t individual = 0;  ///< the first that asked
  std::string design_hash;
  int level = 1;
  std::size_t voxels = 0;
  Evaluation result;  ///< with its wall time
};

/// The evaluations made for a generation, batch by batch in the order in which they were asked for.
///
/// The archive does not keep the batches: the decisions of the search are taken again from its results (outlook).
/// @throws io::InputError if the archive holds no such generation, or lacks a result that its selection must have asked for
std::vector<EvaluatedTask> evaluated_tasks(const RunView& run, int generation);

/// A row per evaluation of all finished generations: generation, batch, individual, design, level, voxels, steps, status, and its
/// wall time in the column `seconds`, of bodies judged together an equal share.
io::CsvTable timing_table(const RunView& run);

/// A row per generation and number of workers: how long its evaluations would take, each batch after the other, from their wall
/// times (see list_schedule; those of bodies that were judged together are shares of one task, which other numbers of workers
/// would cut otherwise; those of bodies that several threads shared are shorter than one worker's): costliest first as the search
/// does, as asked for, at least; if all were one batch; and for how long some worker has nothing to do. The last column is what
/// the generation took where it was made, since it was begun for the last time.
io::CsvTable schedule_table(const RunView& run, const std::vector<std::size_t>& workers);

}  // namespace menger::evolution
