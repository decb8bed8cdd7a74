#pragma once

#include <filesystem>
#include <string>

#include "evolution/trade_off/trade_off_table.h"
#include "io/picture/chart.h"

namespace menger::evolution {

/// Error (%) against seconds, both logarithmic: a point per run, the front as a line, the reference's own error as a level below
/// which differences mean little. Errors below a tenth of it, or without it below 1e-4 %, are drawn there. Rows without error or
/// time are left out.
/// @param title of the panel
io::ChartPanel trade_panel(const TradeTable& table, const std::string& title);

}  // namespace menger::evolution
