#include "voxel/validation/validation_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "voxel/calibration/calibration.h"
#include "voxel/validation/validation_summary.h"
#include "voxel/validation/validation_tables.h"

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
    case Quantity::elbow_ratio:
    case Quantity::plate_stretch_ratio:
    case Quantity::plate_draw_in:
    case Quantity::plate_rise:
    case Quantity::plate_draw_in_rate:
    case Quantity::plate_edge_share:
    case Quantity::plate_arm_ratio:
    case Quantity::wide_volume_ratio:
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

/// The curves that a part is fitted to.
Curves fitted_of(const Curves& curves, OwnPart part) {
  if (part != OwnPart::sizes) return curves;
  Curves inflations;
  for (const meshes::ResponseCurve& curve : curves) {
    if (curve.provenance.load_case.kind == LoadCaseKind::inflation) inflations.push_back(curve);
  }
  return inflations.empty() ? curves : inflations;
}

/// Details of a part that the parameters do not have, so that a fit has no slope to start with.
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
  look(CalibrationDetail::elbows, Quantity::elbow_ratio, parameters.elbow_ratio > 0.0);
  look(CalibrationDetail::plates, Quantity::plate_draw_in, parameters.plate_draw_in > 0.0);
  return missing;
}

/// Fits a part of the parameters, without some details.
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
                    CalibrationDetail::lateral,
                    CalibrationDetail::elbows,
                    CalibrationDetail::plates};
  for (const CalibrationDetail detail : left_out) details.erase(detail);
  std::vector<FittedParameter> unknowns;
  for (const FittedParameter& unknown : fitted_parameters(details, determined_classes(problem), problem.bounds, problem.start)) {
    if (belongs(unknown.quantity, part)) unknowns.push_back(unknown);
  }
  return fit_parameters(problem.curves, unknowns, problem.start, problem.responder, {.stop = stop});
}

/// Fits a part to a body: first with the details that the parameters have, then also with those that they lack, if that is
/// better.
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

/// Whether a number counts, in a report on the numbers inside the range of validity or on all, see CauseReport::inside.
bool counts(Validity validity, bool inside) { return !inside || validity == Validity::inside; }

/// Whether any number in displacement and volume is inside the range of validity.
bool has_inside(const std::vector<CurveComparison>& comparisons) {
  const auto is_inside = [](const auto& number) { return is_aimed_at(number.kind) && number.validity == Validity::inside; };
  return std::any_of(comparisons.begin(), comparisons.end(), [&](const CurveComparison& comparison) {
    return std::any_of(comparison.errors.begin(), comparison.errors.end(), is_inside) ||
           std::any_of(comparison.without_equilibrium.begin(), comparison.without_equilibrium.end(), is_inside);
  });
}

/// Root mean square of the errors of some kinds that count; nothing if there are none.
std::optional<double> rms(const std::vector<CurveComparison>& comparisons, bool inside,
                          const std::function<bool(ObservableKind)>& of_kind) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const CurveComparison& comparison : comparisons) {
    for (const ObservableError& error : comparison.errors) {
      if (!of_kind(error.kind) || !counts(error.validity, inside)) continue;
      sum += error.error * error.error;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

/// Sets the errors of a trial from the numbers that count; 0 if no displacement and no volume counts.
void assess(CauseTrial& trial, std::vector<CurveComparison> comparisons, bool inside) {
  trial.rms_error = rms(comparisons, inside, is_aimed_at).value_or(0.0);
  trial.rms_stiffness_error = rms(comparisons, inside, [](ObservableKind kind) { return kind == ObservableKind::stiffness; });
  trial.all_computed = std::all_of(comparisons.begin(), comparisons.end(), [&](const CurveComparison& comparison) {
    return std::none_of(comparison.without_equilibrium.begin(), comparison.without_equilibrium.end(),
                        [&](const UndeterminedNumber& number) { return counts(number.validity, inside); });
  });
  trial.comparisons = std::move(comparisons);
}

/// The name of a part in a sentence.
std::string name_of(OwnPart part) {
  constexpr std::array<std::string_view, 4> names{"nothing", "rest lengths", "stiffnesses", "rest lengths and stiffnesses"};
  return std::string(names.at(static_cast<std::size_t>(part))) + " fitted to this body";
}

/// A sentence on which of the trials closes the gap; see explain_miss.
std::string verdict_of(const CauseReport& report) {
  constexpr double closing_share = 0.25;
  constexpr double most_share = 0.5;
  constexpr double least_gap = 1e-6;  // size of rounding and of the remaining error of the solver
  if (report.trials.size() < 4) return "stopped before all trials were made";
  const CauseTrial& as_it_is = report.trials.front();
  if (as_it_is.all_computed && as_it_is.rms_error < least_gap) return "there is no error to explain";
  const auto rms_of = [&](OwnPart part) { return report.trials[static_cast<std::size_t>(part)].rms_error; };
  const auto leaves_at_most = [&](OwnPart part, double share) {
    return report.trials[static_cast<std::size_t>(part)].all_computed && rms_of(part) <= share * as_it_is.rms_error;
  };
  const auto closes = [&](OwnPart part) { return leaves_at_most(part, closing_share); };
  const bool sizes = closes(OwnPart::sizes);
  const bool stiffness = closes(OwnPart::stiffness);
  if (sizes && stiffness)
    return "rest lengths or stiffnesses fitted to this body remove the error: the curves do not distinguish the two";
  if (sizes) return name_of(OwnPart::sizes) + " remove the error: its chambers extend or bulge differently from those of the fit";
  if (stiffness) return name_of(OwnPart::stiffness) + " remove the error: its walls bear loads differently from those of the fit";
  if (closes(OwnPart::both)) return "only both together, " + name_of(OwnPart::both) + ", remove the error";
  const auto best = std::min_element(report.trials.begin(), report.trials.end(), [](const CauseTrial& a, const CauseTrial& b) {
    return std::pair(!a.all_computed, a.rms_error) < std::pair(!b.all_computed, b.rms_error);
  });
  std::string text;
  for (const OwnPart part : {OwnPart::sizes, OwnPart::stiffness}) {
    if (!leaves_at_most(part, most_share)) continue;
    text += (text.empty() ? "" : ", or ") + name_of(part) + " remove most of the error, which falls to " + percent(rms_of(part));
  }
  return text + (text.empty() ? "" : "; ") + "no parameters fitted to this body remove the error (at best " +
         percent(best->rms_error) + ", with " + name_of(best->part) +
         "): boxes and beams between their centres do not have the shape of these walls";
}

/// Median error of a kind over all bodies, with one part fitted to each.
std::string pooled_median(const std::vector<CauseReport>& reports, OwnPart part, ObservableKind kind) {
  std::vector<double> magnitudes;
  std::size_t without_equilibrium = 0;
  for (const CauseReport& report : reports) {
    for (const CurveComparison& comparison : report.trials.at(static_cast<std::size_t>(part)).comparisons) {
      for (const ObservableError& error : comparison.errors) {
        if (error.kind == kind && counts(error.validity, report.inside)) magnitudes.push_back(std::abs(error.error));
      }
      without_equilibrium += static_cast<std::size_t>(std::count_if(
          comparison.without_equilibrium.begin(), comparison.without_equilibrium.end(),
          [&](const UndeterminedNumber& number) { return number.kind == kind && counts(number.validity, report.inside); }));
    }
  }
  const std::optional<double> median = quantile(std::move(magnitudes), 0.5, without_equilibrium);
  return median ? percent(*median) : "none";
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

std::string_view to_string(OwnPart part) {
  constexpr std::array<std::string_view, 4> words{"nothing", "sizes", "stiffness", "both"};
  return words.at(static_cast<std::size_t>(part));
}

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
      assess(trial, present, report.inside);
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
      assess(trial, std::move(own), report.inside);
    }
    report.trials.push_back(trial);
  }
  report.verdict = verdict_of(report);
  return report;
}

std::vector<std::string> cause_lines(const std::vector<CauseReport>& reports) {
  std::vector<std::string> lines;
  for (const CauseReport& report : reports) {
    lines.push_back("causes of the error of " + report.body + " (root mean square of errors in displacement and volume" +
                    std::string(report.inside ? "" : ", all outside the range of validity") + "):");
    for (const CauseTrial& trial : report.trials) {
      std::string line = "  " + std::string(to_string(trial.part)) + " fitted to this body: " + percent(trial.rms_error);
      if (trial.rms_stiffness_error) line += ", stiffness " + percent(*trial.rms_stiffness_error);
      if (trial.status != io::RunStatus::completed)
        line += " (the fit: " + std::string(io::to_string(trial.status)) + ", " + trial.reason + ")";
      if (!trial.all_computed) line += " (some states have no equilibrium)";
      lines.push_back(line);
    }
    lines.push_back("  " + report.verdict);
  }
  if (reports.size() < 2) return lines;
  lines.emplace_back("median errors of these bodies together, displacement and volume:");
  for (const CauseTrial& trial : reports.front().trials) {
    lines.push_back("  " + std::string(to_string(trial.part)) +
                    " fitted to each body: " + pooled_median(reports, trial.part, ObservableKind::displacement) + ", " +
                    pooled_median(reports, trial.part, ObservableKind::volume));
  }
  return lines;
}

}  // namespace menger::voxel
