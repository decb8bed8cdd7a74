#pragma once

#include <filesystem>

#include "evolution/trade_off/trade_off_settled.h"
#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"

namespace menger::evolution {

/// The voxels of a frame: where their centres are (centre_m, see voxel::write_frame) and how their boxes are turned.
/// @throws io::InputError if the file is none, with its name
SettledBody::Voxels frame_voxels(const std::filesystem::path& file);

/// Reads what a settling run gave into a row; the reason names every observable that was still moving at the end, by more than a
/// thousandth of its error_scales over the last tenth of the time.
/// @throws io::InputError if the result cannot be read
void read_settling_result(const TradeStudy& study, const SettledBody& body, double pressure_Pa,
                          const io::ProgramJobResult& result, TradeRow& row);

}  // namespace menger::evolution
