#pragma once

#include <filesystem>

#include "evolution/trade_off/trade_off_run.h"
#include "evolution/trade_off/trade_off_study.h"

namespace menger::evolution {

/// Writes tables, recommendations and pictures of a trade into a folder (see run_trade_off), each whole or not at all.
/// @param result gets a note for a picture that could not be drawn @throws io::InputError if the place cannot be written
void write_trade(const TradeStudy& study, const std::filesystem::path& folder, bool pictures, TradeResult& result);

}  // namespace menger::evolution
