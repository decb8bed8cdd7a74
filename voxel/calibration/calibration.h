#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "voxel/calibration/calibration_fit.h"

namespace menger::voxel {

/// What is fitted to what.
struct CalibrationProblem {
  std::vector<FittedCurve> curves;
  SurrogateParameters start;  ///< also holds what is not fitted
  CalibrationBounds bounds;
  Responder responder;
};

/// Which details are tried, and how they are chosen.
struct CalibrationPlan {
  /// In the order in which they are tried; the first is always kept.
  /// Softening by class is left to those who ask for it: with so many unknowns the search often ends beside the minimum.
  std::vector<CalibrationDetail> details{
      CalibrationDetail::uniform, CalibrationDetail::stiffness,         CalibrationDetail::sections,
      CalibrationDetail::shear,   CalibrationDetail::bulge_classes,     CalibrationDetail::lateral,
      CalibrationDetail::fading,  CalibrationDetail::extension_classes, CalibrationDetail::stiffness_classes,
      CalibrationDetail::joints};
  /// All details up to this one are kept, whatever they buy, if their fits complete. Without it Akaike's criterion decides.
  std::optional<CalibrationDetail> choice;
  double aic_margin = 10.0;  ///< a detail is kept if it lowers the criterion by more than this
  CalibrationFitOptions fit;
  std::function<void(CalibrationDetail)> begin;  ///< called before each fit; may be empty
};

/// One detail, tried on top of others.
struct CalibrationStep {
  CalibrationDetail detail = CalibrationDetail::uniform;
  DetailSet kept_before;  ///< what it was joined with
  bool is_kept = false;
  CalibrationFit fit;

  [[nodiscard]] DetailSet details() const;
};

struct Calibration {
  DeterminedClasses classes;
  std::vector<CalibrationStep> steps;  ///< in the order in which they were tried; the last may have been stopped
  std::size_t chosen = 0;              ///< the last one kept
  /// A step whose detail was to be kept whatever it buys, and whose fit did not complete.
  std::optional<std::size_t> missed{};

  [[nodiscard]] const CalibrationFit& fit() const { return steps[chosen].fit; }
  /// How it ended: by the fit that was stopped, which is not kept, else by the one that was asked for and missed, else by the one
  /// chosen.
  [[nodiscard]] const CalibrationFit& ended() const {
    if (steps.back().fit.status == io::RunStatus::stopped) return steps.back().fit;
    return missed ? steps[*missed].fit : fit();
  }
  [[nodiscard]] DetailSet details() const { return steps[chosen].details(); }
};

/// In sentences, the details whose last fit did not complete, and why; what is there without them stands.
std::vector<std::string> failed_details(const Calibration& calibration);

/// Wall classes whose stiffness, extension or bulge changes an answer of the surrogate at the start. Where none does the class
/// with four walls stands for all.
DeterminedClasses determined_classes(const CalibrationProblem& problem);

/// Tries the details one after the other on top of those kept so far, each fit beginning with the result of the last one kept.
///
/// Those that did not pay are tried again after others were kept, because what is small beside one error may be large beside the
/// next; it ends when none pays any more. A fit that leaves more than the one before, which is a special case of it, is made
/// again from there. A detail whose fit does not complete is not kept, and takes nothing from those before it, unless none of
/// those completed either. Sets the range of validity of every result: pressures by the walls that the bodies of the load cases
/// have, the longest body, strains of the surrogate's answers.
Calibration calibrate(const CalibrationProblem& problem, const CalibrationPlan& plan);

/// "uniform + stiffness", in the order of the enumeration.
std::string to_string(const DetailSet& details);

/// Lowest and highest pressure of the states of curves, zero included.
ValueRange pressure_range_Pa(const std::vector<FittedCurve>& curves);

}  // namespace menger::voxel
