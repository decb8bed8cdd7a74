#pragma once

#include <filesystem>
#include <string>

#include "evolution/trade_off/trade_off_table.h"
#include "io/picture/chart.h"

namespace menger::evolution {

/// Draws error (%) against the cost (s) of TradeTable::cost_s, both logarithmic: a point per run, the Pareto front as a line, and
/// the reference's own error as a horizontal level, below which differences mean little. Errors below a tenth of that level, or
/// below 1e-4 %, are drawn at that limit. Rows without error or time are left out.
/// @param title of the panel
io::ChartPanel trade_panel(const TradeTable& table, const std::string& title);

}  // namespace menger::evolution
