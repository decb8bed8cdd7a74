#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "voxel/calibration/calibration.h"

namespace menger::voxel {

/// Draws one load case, reference as points and surrogate as lines: a panel per unit of the ordinates, a colour per ordinate and
/// run of equal outer abscissae. @param curve place among the curves
io::PictureOutcome draw_curve(const std::filesystem::path& file, const FittedCurve& curve, const std::vector<double>& residuals);

/// Draws the surrogate's ordinates over the reference's, each by its largest magnitude, a panel for all kinds: points on the
/// diagonal agree. Beside it what each detail leaves: the RMS error of every kind.
io::PictureOutcome draw_agreement(const std::filesystem::path& file, const Calibration& calibration,
                                  const std::vector<FittedCurve>& curves);

}  // namespace menger::voxel
