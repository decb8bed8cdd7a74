#pragma once

#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::meshes {

/// Returns the load cases to which the voxels of a robot are fitted, as the tables [[case]] of a set for `menger load-cases`.
///
/// They are those of fem/studies/load_cases/dragon_skin_10_1cm.toml: the bodies have the robot's cells and walls, imposed
/// displacements grow with the edge of a cell, and pressures in pascals as in scaled_pressure_Pa. All bodies have one chamber:
/// what a fit learns of walls holds for any chambers.
std::string calibration_cases_text(const Robot& robot);

/// Returns the most cells along an edge of their bodies.
int longest_fitted_body_cells();

/// Whether the robot itself, inflated, is one of them: then no validation can hold it out.
bool is_fitted_body(const Robot& robot);

/// Returns their names.
std::vector<std::string> calibration_case_names();

}  // namespace menger::meshes
