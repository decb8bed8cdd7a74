#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "voxel/calibration/calibration.h"

namespace menger::voxel {

/// Draws one load case: the reference as points, the surrogate as lines. There is one panel per unit of the ordinates. A curve
/// over pressure has one colour per ordinate; a curve over an imposed value has one per ordinate and pressure.
/// @param residuals of the curve, see CalibrationFit
io::PictureOutcome draw_curve(const std::filesystem::path& file, const FittedCurve& curve, const std::vector<double>& residuals);

/// Draws how closely the calibrated voxels follow finite elements. The first panel has the value of one over that of the other,
/// as fractions of the largest in each curve, so that points on the diagonal agree. The second panel has the RMS error that each
/// detail of the model leaves, by kind of load case.
io::PictureOutcome draw_agreement(const std::filesystem::path& file, const Calibration& calibration,
                                  const std::vector<FittedCurve>& curves);

}  // namespace menger::voxel
