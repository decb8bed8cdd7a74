#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_runner.h"
#include "evolution/trade_off/trade_off_search.h"
#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// The result of a trade-off study.
struct TradeResult {
  /// completed, stopped, or not_converged if a table has no reference or no search found a champion.
  io::RunStatus status = io::RunStatus::completed;
  double pressure_Pa = 0.0;        ///< to which the body was inflated
  std::optional<TradeTable> body;  ///< finite elements and settled voxels
  std::optional<TradeTable> gait;
  std::optional<SearchTrade> search;
  std::vector<std::string> notes;
  std::size_t repeated = 0;  ///< number of runs made in this call, not found from an earlier one
};

/// Makes all runs of a study and writes into a folder:
/// - tradeoff.csv, gait.csv, search.csv: a row per run (see trade_csv, search_csv),
/// - tradeoff.png with a panel per table, recommendation.txt and recommendation.toml, search.png, search.txt,
/// - runs/: a folder per run, where a second call finds it.
///
/// Runs that fail or exceed their limits are in the tables with their status, and the others go on. If the user stops the study,
/// no table is written and finished runs are kept.
/// @throws io::InputError if a program is missing, a program refuses the input of every row of a table, voxel parameters are
/// those of another body, two files of parameters have the same number of voxels per cell, nothing is left to run, or the folder
/// cannot be written
TradeResult run_trade_off(const TradeStudy& study, const std::filesystem::path& folder, const TradeOptions& options);

}  // namespace menger::evolution
