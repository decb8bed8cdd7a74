#include "voxel/validation/validation_cause.h"

#include <algorithm>
#include <utility>

#include "voxel/calibration/calibration.h"
#include "voxel/validation/validation_cause_judgement.h"

namespace menger::voxel {

namespace {

using meshes::LoadCaseKind;
using Curves = std::vector<meshes::ResponseCurve>;

bool is_size(Quantity quantity) {
  switch (quantity) {
    case Quantity::extension_slope:
    case Quantity::extension_pressure_softening:
    case Quantity::extension_vacuum_softening:
    case Quantity::bulge_slope:
    case Quantity::bulge_pressure_softening:
    case Quantity::bulge_vacuum_softening:
    case Quantity::bulge_fading_share:
    case Quantity::bulge_fading:
    case Quantity::bulge_peak_ratio:
      return true;
    default:
      return false;
  }
}

bool is_stiffness(Quantity quantity) {
  switch (quantity) {
    case Quantity::axial:
    case Quantity::bending_ratio:
    case Quantity::torsion_ratio:
    case Quantity::shear_ratio:
    case Quantity::joint_axial:
    case Quantity::joint_bending:
    case Quantity::joint_torsion:
    case Quantity::lateral_coupling:
      return true;
    default:
      return false;
  }
}

bool belongs(Quantity quantity, OwnPart part) {
  const bool with_sizes = part == OwnPart::sizes || part == OwnPart::both;
  const bool with_stiffness = part == OwnPart::stiffness || part == OwnPart::both;
  return (with_sizes && is_size(quantity)) || (with_stiffness && is_stiffness(quantity));
}

/// What a part is fitted to.
Curves fitted_of(const Curves& curves, OwnPart part) {
  if (part != OwnPart::sizes) return curves;
  Curves inflations;
  for (const meshes::ResponseCurve& curve : curves) {
    if (curve.provenance.load_case.kind == LoadCaseKind::inflation) inflations.push_back(curve);
  }
  return inflations.empty() ? curves : inflations;
}

/// Details of a part that parameters have nothing of, and so no slope to begin with.
DetailSet missing_details(const SurrogateParameters& parameters, OwnPart part) {
  const auto fades = [](const PressureLaw& law) { return law.fading_share > 0.0; };
  const auto shears = [](double compliance_per_Pa) { return compliance_per_Pa > 0.0; };
  DetailSet missing;
  const auto look = [&](CalibrationDetail detail, Quantity quantity, bool is_there) {
    if (belongs(quantity, part) && !is_there) missing.insert(detail);
  };
  look(CalibrationDetail::fading, Quantity::bulge_fading, std::any_of(parameters.bulge.begin(), parameters.bulge.end(), fades));
  look(CalibrationDetail::shear, Quantity::shear_ratio,
       std::any_of(parameters.shear_compliance_per_Pa.begin(), parameters.shear_compliance_per_Pa.end(), shears));
  look(CalibrationDetail::lateral, Quantity::lateral_coupling, parameters.lateral_coupling > 0.0);
  return missing;
}

/// A fit of what belongs to a part, without some details.
CalibrationFit fit_part(const CalibrationProblem& problem, OwnPart part, const DetailSet& left_out,
                        const std::atomic<bool>* stop) {
  DetailSet details{CalibrationDetail::uniform,
                    CalibrationDetail::stiffness,
                    CalibrationDetail::stiffness_classes,
                    CalibrationDetail::extension_classes,
                    CalibrationDetail::bulge_classes,
                    CalibrationDetail::softening,
                    CalibrationDetail::fading,
                    CalibrationDetail::shear,
                    CalibrationDetail::joints,
                    CalibrationDetail::lateral};
  for (const CalibrationDetail detail : left_out) details.erase(detail);
  std::vector<FittedParameter> unknowns;
  for (const FittedParameter& unknown : fitted_parameters(details, determined_classes(problem), problem.bounds, problem.start)) {
    if (belongs(unknown.quantity, part)) unknowns.push_back(unknown);
  }
  return fit_parameters(problem.curves, unknowns, problem.start, problem.responder, {.stop = stop});
}

/// Fits a part to a body: first what the parameters know, then with details that they lack on top, if that is better.
CalibrationFit fit_own(const Curves& curves, OwnPart part, const SurrogateParameters& parameters, const Responder& responder,
                       const std::atomic<bool>* stop) {
  CalibrationProblem problem;
  problem.start = parameters;
  problem.responder = responder;
  for (const meshes::ResponseCurve& curve : fitted_of(curves, part)) problem.curves.push_back(fitted_curve(curve));
  const ValueRange pressures = pressure_range_Pa(problem.curves);
  problem.bounds = default_bounds(parameters, pressures.lowest, pressures.highest);
  const DetailSet missing = missing_details(parameters, part);
  CalibrationFit known = fit_part(problem, part, missing, stop);
  if (missing.empty() || known.status == io::RunStatus::stopped) return known;
  problem.start = known.parameters;
  for (const CalibrationDetail detail : missing)
    problem.start = with_detail(problem.start, detail, parameters, pressures.highest);
  CalibrationFit all = fit_part(problem, part, {}, stop);
  if (all.status == io::RunStatus::stopped || known.parameter_count == 0) return all;
  return all.parameter_count > 0 && all.chi2 < known.chi2 ? all : known;  // without parameters no fit was made
}

/// The rows of a curve that count.
meshes::ResponseCurve counting_part(const CurveComparison& comparison, bool inside) {
  meshes::ResponseCurve part = comparison.curve;
  for (std::size_t column = 0; column < part.values.size(); ++column) {
    part.values[column].clear();
    for (std::size_t row = 0; row < comparison.validity.size(); ++row) {
      if (counts(comparison.validity[row], inside)) part.values[column].push_back(comparison.curve.values[column][row]);
    }
  }
  return part;
}

}  // namespace

CauseReport explain_miss(const std::vector<CurveComparison>& comparisons, const std::string& body,
                         const SurrogateParameters& parameters, const Responder& responder, const CauseOptions& options) {
  CauseReport report{.body = body, .inside = true, .trials = {}, .verdict = {}};
  std::vector<CurveComparison> present;
  for (const CurveComparison& comparison : comparisons) {
    if (comparison.body == body) present.push_back(comparison);
  }
  report.inside = has_inside(present);
  SurrogateParameters own_sizes = parameters;
  std::vector<meshes::ResponseCurve> curves;
  for (const CurveComparison& comparison : present) {
    const meshes::ResponseCurve counting = counting_part(comparison, report.inside);
    if (counting.row_count() > 0) curves.push_back(counting);
  }
  for (const OwnPart part : {OwnPart::nothing, OwnPart::sizes, OwnPart::stiffness, OwnPart::both}) {
    if (options.begin) options.begin(part);
    CauseTrial trial{.part = part};
    if (part == OwnPart::nothing) {
      judge(trial, present, report.inside);
    } else {
      const CalibrationFit fit = fit_own(curves, part, part == OwnPart::both ? own_sizes : parameters, responder, options.stop);
      if (options.stop != nullptr && options.stop->load()) break;
      trial.status = fit.status;
      trial.reason = fit.reason;
      if (part == OwnPart::sizes) own_sizes = fit.parameters;
      std::vector<CurveComparison> own;
      own.reserve(present.size());
      for (const CurveComparison& comparison : present)
        own.push_back(compare(comparison.curve, body, fit.parameters, responder, comparison.validity));
      judge(trial, std::move(own), report.inside);
    }
    report.trials.push_back(trial);
  }
  report.verdict = verdict_of(report);
  return report;
}

}  // namespace menger::voxel
