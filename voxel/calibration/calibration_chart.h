#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "voxel/calibration/calibration.h"

namespace menger::voxel {

/// Draws one load case, reference as points and surrogate as lines: a panel per unit of the ordinates, a colour per ordinate and
/// run of equal outer abscissae. @param curve place among the curves
io::PictureOutcome draw_curve(const std::filesystem::path& file, const FittedCurve& curve, const std::vector<double>& residuals);

/// Draws how closely calibrated voxels follow finite elements: the value of one over that of the other, as fractions of the
/// largest in each curve, so that points on the diagonal agree. A second panel has the RMS error that each detail of the model
/// leaves, by kind of load case.
io::PictureOutcome draw_agreement(const std::filesystem::path& file, const Calibration& calibration,
                                  const std::vector<FittedCurve>& curves);

}  // namespace menger::voxel
