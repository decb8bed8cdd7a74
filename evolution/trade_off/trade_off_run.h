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

/// What a trade gave.
struct TradeResult {
  /// Or stopped; not_converged if some table has no reference, or no search found a champion.
  io::RunStatus status = io::RunStatus::completed;
  double pressure_Pa = 0.0;        ///< to which the body was brought
  std::optional<TradeTable> body;  ///< finite elements and settled voxels
  std::optional<TradeTable> gait;
  std::optional<SearchTrade> search;
  std::vector<std::string> notes;
  std::size_t repeated = 0;  ///< runs that were made by this call, not found from an earlier one
};

/// Runs everything that a study asks for and writes into a folder:
/// - tradeoff.csv, gait.csv, search.csv: a row per run (see trade_csv, search_csv),
/// - tradeoff.png with a panel per table, recommendation.txt and recommendation.toml, search.png, search.txt,
/// - runs/: a folder per run, by which a second call finds it.
///
/// Runs that fail or exceed their limits stand in the tables with their status; the others go on. A stopped trade writes no
/// table and keeps its finished runs.
/// @throws io::InputError if a program is missing or the input of every row of a table is refused, voxel parameters are those of
/// another body or two files of them divide a cell alike, nothing is left to run, or the folder cannot be written
TradeResult run_trade_off(const TradeStudy& study, const std::filesystem::path& folder, const TradeOptions& options);

}  // namespace menger::evolution
