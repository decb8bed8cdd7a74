#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "voxel/calibration/calibration_fit.h"

namespace menger::voxel {

/// A calibration problem: response curves, the parameters to fit to them, and the model that computes responses.
struct CalibrationProblem {
  std::vector<FittedCurve> curves;
  SurrogateParameters start;  ///< also holds the parameters that are not fitted
  CalibrationBounds bounds;
  Responder responder;
};

/// The details of the model to try, and how to choose among them.
struct CalibrationPlan {
  /// Details in the order in which they are tried; the first is always kept. Softening by class is not among the defaults: with
  /// so many unknowns the search often ends beside the minimum.
  std::vector<CalibrationDetail> details{CalibrationDetail::uniform,
                                         CalibrationDetail::stiffness,
                                         CalibrationDetail::sections,
                                         CalibrationDetail::shear,
                                         CalibrationDetail::bulge_classes,
                                         CalibrationDetail::lateral,
                                         CalibrationDetail::elbows,
                                         CalibrationDetail::fading,
                                         CalibrationDetail::plates,
                                         CalibrationDetail::extension_classes,
                                         CalibrationDetail::stiffness_classes,
                                         CalibrationDetail::joints};
  /// If given, all details up to this one are kept, for any gain, if their fits complete. Otherwise Akaike's criterion decides.
  std::optional<CalibrationDetail> choice;
  double aic_margin = 10.0;  ///< a detail is kept if it lowers the criterion by more than this
  CalibrationFitOptions fit;
  std::function<void(CalibrationDetail)> begin;  ///< called before each fit; may be empty
};

/// The fit of one detail together with those kept before.
struct CalibrationStep {
  CalibrationDetail detail = CalibrationDetail::uniform;
  DetailSet kept_before;  ///< the details that it was joined with
  bool is_kept = false;
  CalibrationFit fit;

  [[nodiscard]] DetailSet details() const;
};

struct Calibration {
  DeterminedClasses classes;
  std::vector<CalibrationStep> steps;  ///< in the order in which they were tried; the last may have been stopped
  std::size_t chosen = 0;              ///< the last one kept
  /// The first step whose detail was to be kept for any gain but whose fit did not complete.
  std::optional<std::size_t> missed{};

  [[nodiscard]] const CalibrationFit& fit() const { return steps[chosen].fit; }
  /// The fit that decides how the calibration ended: a fit that was stopped (which is not kept), otherwise a requested one that
  /// failed, otherwise the chosen one.
  [[nodiscard]] const CalibrationFit& ended() const {
    if (steps.back().fit.status == io::RunStatus::stopped) return steps.back().fit;
    return missed ? steps[*missed].fit : fit();
  }
  [[nodiscard]] DetailSet details() const { return steps[chosen].details(); }
};

/// Sentences on the details whose last fit did not complete, and why. The result without them remains valid.
std::vector<std::string> failed_details(const Calibration& calibration);

/// Finds the wall classes whose stiffness, extension or bulge changes a response of the surrogate at the start. If no class does,
/// the class with four walls represents all.
DeterminedClasses determined_classes(const CalibrationProblem& problem);

/// Fits the parameters of the surrogate to the curves. Details are tried one after the other, together with those kept so far,
/// and each fit begins at the result of the last one kept.
///
/// Details that gained too little are tried again after others were kept, because an effect that is small beside one error may be
/// large beside the next. The calibration ends when no detail gains enough. If a fit leaves a larger error than the one before,
/// which is a special case of it, it is made again from there. A detail whose fit does not complete is not kept and does not
/// change the earlier ones, unless none of those completed either. The range of validity of every result is set: pressures by the
/// walls of the bodies in the load cases, the longest body, and the strains of the surrogate's responses.
Calibration calibrate(const CalibrationProblem& problem, const CalibrationPlan& plan);

/// The names of details, such as "uniform + stiffness", in the order of the enumeration.
std::string to_string(const DetailSet& details);

/// Lowest and highest pressure (Pa) among the states of curves and zero.
ValueRange pressure_range_Pa(const std::vector<FittedCurve>& curves);

}  // namespace menger::voxel
