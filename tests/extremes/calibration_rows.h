#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/extremes/row.h"
#include "voxel/calibration/calibration.h"

namespace menger::extremes {

/// What the curves of the rows were made of: all wall classes alike, no joints, no lateral coupling.
voxel::SurrogateParameters calibration_truth();

/// Inflation, stretch, bending, torsion and pressing of a tube of three cells with that truth, from closed forms.
/// @param noise Gaussian, in stated standard deviations, which are 2 % of the largest of an ordinate
std::vector<voxel::FittedCurve> tube_curves(std::uint64_t seed, double noise = 1.0);

/// The fit of what a tube has: one law of extension, one of bulge, axial, bending and torsional stiffness, contact.
voxel::CalibrationPlan tube_plan();

/// A fitted value by name. @throws std::out_of_range if there is none
const voxel::FittedValue& value_named(const voxel::CalibrationFit& fit, const std::string& name);

/// The first curve of a kind. @throws std::out_of_range if there is none
voxel::FittedCurve& curve_of_kind(std::vector<voxel::FittedCurve>& curves, meshes::LoadCaseKind kind);

/// Place of an ordinate in a curve. @throws std::out_of_range if there is none
std::size_t ordinate_index(const voxel::FittedCurve& curve, const std::string& ordinate);

/// The largest distance of a value that a fit found from the truth, in standard deviations. These are what another fit (or the
/// same) states: half the width of its intervals of 95 % by 1.96, of the solver's unknowns; values without interval do not count.
double worst_distance(const voxel::CalibrationFit& found, const voxel::CalibrationFit& stated,
                      const voxel::SurrogateParameters& truth);

std::vector<Row> calibration_data_rows();
std::vector<Row> calibration_outlier_rows();
std::vector<Row> calibration_start_rows();
std::vector<Row> calibration_input_rows();

}  // namespace menger::extremes
