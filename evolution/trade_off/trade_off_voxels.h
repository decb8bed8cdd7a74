#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"

namespace menger::evolution {

/// The fidelity of a computation by the voxel engine.
struct VoxelFidelity {
  std::string number = "float64";
  std::string damping = "increments";
  double time_step_fraction = 0.9;
  std::string exclusion_depth = "1";                  ///< or "off"
  std::optional<std::filesystem::path> parameters{};  ///< of a calibrated body

  bool operator==(const VoxelFidelity&) const = default;
};

/// Returns all combinations, from coarse to fine; the last is the finest. They are sorted by parameters in their order, then by
/// collisions (off, then from the largest exclusion depth to the smallest), then by time step from large to small, then float32
/// before float64, then damping from velocities before damping from increments. float32 is combined with damping from velocities
/// only.
/// @param parameters if empty, there is one body without parameters
std::vector<VoxelFidelity> voxel_fidelities(const VoxelChoice& choice, const std::vector<std::filesystem::path>& parameters);

/// Makes a row without a result yet. @param voxels_per_cell none for a body that is not calibrated
TradeRow voxel_row(const VoxelFidelity& fidelity, std::optional<int> voxels_per_cell);

/// Returns the tables [collisions] and [integration] of a scene.
std::string integration_text(const VoxelFidelity& fidelity);

/// Makes a job for `menger simulate` in which the body is brought to the pressure and settles, without ground and weight.
/// @param program menger-simulate
io::ProgramJob settling_job(const TradeStudy& study, const VoxelFidelity& fidelity, double pressure_Pa,
                            const std::filesystem::path& program);

/// Makes a job for `menger simulate` in which the body walks, with the physics of the study's scene or the engine's default.
io::ProgramJob gait_job(const TradeStudy& study, const VoxelFidelity& fidelity, const std::filesystem::path& program);

/// Reads status, voxels, steps and what was outside the range of validity into a row. @return whether the run completed
/// @throws io::InputError if the result cannot be read
bool read_voxel_summary(const io::ProgramJobResult& result, TradeRow& row);

/// Reads the horizontal displacement (m) of the centre of mass over the whole run, as the one value of a row.
void read_gait_result(const io::ProgramJobResult& result, TradeRow& row);

}  // namespace menger::evolution
