#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"

namespace menger::evolution {

/// How a body is computed by the voxel engine.
struct VoxelFidelity {
  std::string number = "float64";
  std::string damping = "increments";
  double time_step_fraction = 0.9;
  std::string exclusion_depth = "1";                  ///< or "off"
  std::optional<std::filesystem::path> parameters{};  ///< of a calibrated body

  bool operator==(const VoxelFidelity&) const = default;
};

/// All combinations, from coarse to fine: by parameters in their order, then by collisions (off, then from the largest exclusion
/// depth to the smallest), by time step from large to small, float32 before float64, and damping from velocities first where
/// increments are asked for, too. float32 goes with damping from velocities only. The last is the finest.
/// @param parameters empty: one body without any
std::vector<VoxelFidelity> voxel_fidelities(const VoxelChoice& choice, const std::vector<std::filesystem::path>& parameters);

/// A row without a result yet. @param voxels_per_cell none for a body that is not calibrated
TradeRow voxel_row(const VoxelFidelity& fidelity, std::optional<int> voxels_per_cell);

/// The tables [collisions] and [integration] of a scene.
std::string integration_text(const VoxelFidelity& fidelity);

/// A run of `menger simulate` in which the body is brought to the pressure and settles, without ground and weight.
/// @param program menger-simulate
io::ProgramJob settling_job(const TradeStudy& study, const VoxelFidelity& fidelity, double pressure_Pa,
                            const std::filesystem::path& program);

/// A run of `menger simulate` in which the body walks, with the physics of the scene of the study or the engine's own.
io::ProgramJob gait_job(const TradeStudy& study, const VoxelFidelity& fidelity, const std::filesystem::path& program);

/// Reads status, voxels, steps and what of a run lay outside the range of validity. @return whether it completed @throws
/// io::InputError if the result cannot be read
bool read_voxel_summary(const io::ProgramJobResult& result, TradeRow& row);

/// Distance (m) that the centre of mass walked, from end to end, as the one value of the row.
void read_gait_result(const io::ProgramJobResult& result, TradeRow& row);

}  // namespace menger::evolution
