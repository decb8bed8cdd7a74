#pragma once

#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "voxel/validation/validation_summary.h"
#include "voxel/validation/volume_actuation.h"

namespace menger::voxel {

/// A fraction as text in per cent: "6.6 %".
std::string percent(double fraction);

/// A table with one row per compared number: case, body, kind, observable, pressure_Pa, imposed (in the unit of the case),
/// finite_elements, surrogate, error (divided by the scale of the observable), pointwise_error, validity (see Validity).
io::CsvTable errors_table(const std::vector<CurveComparison>& comparisons);

/// A table with one row per kind and side of the range of validity, for all bodies together and then for each body. Columns: body
/// ("all"), kind, range ("inside", "outside"), count, without_equilibrium (numbers in states without an equilibrium of the
/// surrogate; they count as larger than any error), median, percentile_90, worst, pointwise_median, worst_body, worst_case,
/// worst_observable; of displacements also median_m, worst_m, and furthest_body, furthest_observable,
/// furthest_pressure_Pa, furthest_m, furthest_share, furthest_error of the FurthestDisplacement. Errors without a unit in their
/// name are fractions. Cells are empty if a number is missing.
io::CsvTable summary_table(const std::vector<CurveComparison>& comparisons);

/// A table with one row per body and observable, see SignCount: body, observable, range ("inside", "outside"), count, wrong.
io::CsvTable signs_table(const std::vector<CurveComparison>& comparisons);

/// A sentence: how many displacements on one side of the range of validity have the right sign, and which do not. Empty if none
/// was compared there.
std::string sign_sentence(const std::vector<CurveComparison>& comparisons, bool inside);

/// A sentence: how far the shape is off where it is furthest off, in millimetres, beside the largest error in per cent of a
/// curve. Outside the range of validity if no displacement was compared inside; empty without any.
std::string furthest_sentence(const std::vector<CurveComparison>& comparisons);

/// A table with one row per body, see VolumeActuation.
io::CsvTable actuation_table(const std::vector<VolumeActuation>& actuations, const ActuationAim& aim);

/// The summary of all bodies as aligned text columns, errors in per cent.
std::vector<std::string> summary_lines(const std::vector<CurveComparison>& comparisons);

/// Sentences: whether the aim is met in displacement and volume, and which bodies miss it.
std::vector<std::string> aim_sentences(const std::vector<CurveComparison>& comparisons, double aim);

}  // namespace menger::voxel
