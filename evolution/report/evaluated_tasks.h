#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "evolution/report/generation_summary.h"

namespace menger::evolution {

/// An evaluation that was made for a generation.
struct EvaluatedTask {
  std::size_t batch = 0;         ///< evaluations of a batch start together; the next batch starts when all of them are done
  std::uint64_t individual = 0;  ///< the first that needed the result
  std::string design_hash;
  int level = 1;
  std::size_t scenario = 0;
  std::size_t voxels = 0;
  Evaluation result;  ///< with its wall time
};

/// Returns the evaluations made for a generation, batch by batch, in the order in which the search asked for them.
///
/// The archive does not keep the batches. They are found by repeating the decisions of the search from the archived results
/// (outlook).
/// @throws io::InputError if the archive has no such generation, or lacks a result that its selection needed
std::vector<EvaluatedTask> evaluated_tasks(const RunView& run, int generation);

/// Makes a table with a row per evaluation of all finished generations: generation, batch, individual, design, level, scenario
/// (from 1), voxels, steps, status, and wall time in the column `seconds`. Bodies that were evaluated together have equal shares
/// of their wall time.
io::CsvTable timing_table(const RunView& run);

/// Makes a table with a row per generation and number of workers. It estimates from the wall times of evaluations how long a
/// generation would take with that many workers, batch after batch (see list_schedule).
///
/// The columns are the time with the costliest task first, as the search does it; with tasks in the order in which they were
/// asked for; the least time possible; the time if all evaluations were one batch; and the time in which some worker has nothing
/// to do. The last column is the time that the generation really took, from its last start.
///
/// The estimate has two limits. Wall times of bodies that were evaluated together are shares of one task, which other numbers of
/// workers would divide differently. Wall times of bodies that several threads shared are shorter than those of one worker.
io::CsvTable schedule_table(const RunView& run, const std::vector<std::size_t>& workers);

}  // namespace menger::evolution
