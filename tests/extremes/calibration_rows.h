#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/extremes/row.h"
#include "voxel/calibration/calibration.h"

namespace menger::extremes {

/// Returns the parameters from which the curves of the rows were made: all wall classes equal, no joints, no lateral coupling.
voxel::SurrogateParameters calibration_truth();

/// Returns curves of inflation, stretch, bending, torsion and pressing of a tube of three cells with these parameters, from
/// closed forms.
/// @param noise Gaussian, in units of the stated standard deviations, which are 2 % of the largest value of an ordinate
std::vector<voxel::FittedCurve> tube_curves(std::uint64_t seed, double noise = 1.0);

/// Returns the plan of a fit of the parameters of a tube: one law of extension, one of bulge, axial, bending and torsional
/// stiffness, contact.
voxel::CalibrationPlan tube_plan();

/// Returns a fitted value by name. @throws std::out_of_range if there is none
const voxel::FittedValue& value_named(const voxel::CalibrationFit& fit, const std::string& name);

/// Returns the first curve of a kind. @throws std::out_of_range if there is none
voxel::FittedCurve& curve_of_kind(std::vector<voxel::FittedCurve>& curves, meshes::LoadCaseKind kind);

/// Returns the position of an ordinate in a curve. @throws std::out_of_range if there is none
std::size_t ordinate_index(const voxel::FittedCurve& curve, const std::string& ordinate);

/// Returns the largest distance of a fitted value from the truth, in standard deviations. The standard deviations are those of
/// `stated`, which may be the same fit: half the width of its 95 % intervals divided by 1.96, in the solver's unknowns. Values
/// without an interval are left out.
double worst_distance(const voxel::CalibrationFit& found, const voxel::CalibrationFit& stated,
                      const voxel::SurrogateParameters& truth);

std::vector<Row> calibration_data_rows();
std::vector<Row> calibration_outlier_rows();
std::vector<Row> calibration_start_rows();
std::vector<Row> calibration_input_rows();

}  // namespace menger::extremes
