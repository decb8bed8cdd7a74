#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/text/toml_document.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

std::string_view to_string(meshes::ChamberLayout layout);  ///< "single" or "per-phase"

/// Parameters as the TOML that read_surrogate reads, exact and always in the same order: equal text means equal parameters.
///
/// - `[holds_for]` silicone, law, cell_edge_m, wall_thickness_m, voxels_per_cell, chambers ("single", "per-phase")
/// - `[validity]` lowest_pressure_gap_1_Pa, lowest_pressure_gap_2_Pa, lowest_pressure_gap_3_Pa (of cells between facing walls
/// one, two, three or more cells apart), highest_pressure_Pa (seven numbers each, by wall class of a cell),
/// lowest_joint_pressure_Pa, highest_joint_pressure_Pa, smallest_strain, largest_strain, longest_body_cells,
/// longest_aggregate_modules
/// - `[mass]` density_kg_m3
/// - `[stiffness]` axial_Pa, bending_Pa, torsion_Pa and optionally shear_compliance_per_Pa, by default 0 (seven numbers each, by
/// wall class), lateral_coupling
/// - `[joint]` axial_factor, bending_factor, torsion_factor
/// - `[extension]` slope_per_Pa, pressure_softening_per_Pa, vacuum_softening_per_Pa, fading_share, fading_per_Pa (seven numbers
/// each)
/// - `[bulge]` the same, and peak_ratio (seven numbers)
/// - `[ground]` stiffness_N_per_m
/// - `[damping]` bond_ratio, measured
/// @param prefix of the table names, "surrogate." to put them into a larger file; empty for a file of their own
std::string surrogate_text(const SurrogateParameters& parameters, std::string_view prefix = {});

/// Reads voxel parameters. A table `[fit]`, in which a calibration reports how it found them, is left unread, but for
/// its status: of a file that is not "completed" the parameters are refused.
/// @throws io::InputError with file, key and value: keys missing or unknown, values out of the range that SurrogateParameters
/// states, a law with its pole or a size that vanishes within the range of validity of its wall class (of any, where a cell has
/// several voxels)
SurrogateParameters read_surrogate(const std::filesystem::path& file);

/// The same from the table that holds those tables; the caller ends with finish() of it or of the table it was taken from.
SurrogateParameters read_surrogate(const io::TomlTable& top);

}  // namespace menger::voxel
