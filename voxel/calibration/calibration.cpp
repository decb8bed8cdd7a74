#include "voxel/calibration/calibration.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include "voxel/model/covered_pressures.h"
#include "voxel/statics/load_case_body.h"

namespace menger::voxel {
namespace {

/// Computes the responses to all curves.
std::vector<LoadCaseResponse> responses_of(const CalibrationProblem& problem, const SurrogateParameters& parameters) {
  std::vector<LoadCaseResponse> responses(problem.curves.size());
  tbb::parallel_for(std::size_t{0}, responses.size(), [&](std::size_t c) {
    responses[c] = problem.responder(parameters, problem.curves[c].load_case, problem.curves[c].states);
  });
  return responses;
}

/// By span, whether the residuals of a curve depend on it.
std::vector<bool> spans_that_matter(const CalibrationProblem& problem, const FittedCurve& curve,
                                    const std::vector<ParameterSpan>& spans) {
  // Above the remaining error of equilibria, which is far below a standard deviation.
  constexpr double noise = 1e-6;
  const ResponseSlopes response = problem.responder.slopes(problem.start, curve.load_case, curve.states, spans);
  std::vector<bool> matters(spans.size(), false);
  if (!responses_of(curve, response.response)) return matters;
  for (std::size_t n = 0; n < spans.size(); ++n) {
    if (!response.slopes[n]) {
      matters[n] = true;  // with it there is no response
      continue;
    }
    const std::vector<double> slopes = slopes_of(curve, response.response.columns, *response.slopes[n]);
    matters[n] = std::ranges::any_of(slopes, [&](double slope) { return std::abs(slope) * spans[n].above_by > noise; });
  }
  return matters;
}

ValidityRange validity_of(const CalibrationProblem& problem, const SurrogateParameters& parameters) {
  ValidityRange validity;
  const std::vector<LoadCaseResponse> responses = responses_of(problem, parameters);
  for (std::size_t c = 0; c < responses.size(); ++c) {
    const FittedCurve& curve = problem.curves[c];
    const LoadCaseResponse& response = responses[c];
    const ValueRange pressures = pressure_range_Pa({curve});
    cover(validity, body_walls(curve.load_case), pressures.lowest, pressures.highest);
    validity.smallest_strain = std::min(validity.smallest_strain, response.smallest_strain);
    validity.largest_strain = std::max(validity.largest_strain, response.largest_strain);
    const int cells = meshes::longest_side_cells(curve.load_case.cells, curve.load_case.digits);
    validity.longest_body_cells = std::max(validity.longest_body_cells, cells);
    validity.longest_aggregate_modules =
        std::max(validity.longest_aggregate_modules, meshes::longest_side_modules(cells, curve.load_case.level));
  }
  return validity;
}

/// Whether a limb of a body leaves a plate.
bool has_necks(const meshes::LoadCase& load_case, const SurrogateParameters& parameters) {
  const StaticBody body = load_case_body(parameters, load_case);
  return std::ranges::any_of(body.openings,
                             [](const auto& of_voxel) { return std::ranges::any_of(of_voxel, &WallOpening::lifts); });
}

/// Whether any beam of a body turns at an elbow.
bool has_elbows(const meshes::LoadCase& load_case, const SurrogateParameters& parameters) {
  const StaticBody body = load_case_body(parameters, load_case);
  return std::ranges::any_of(body.beams, [](const StaticBeam& beam) { return beam.elbow != AcrossBeam<double>{}; });
}

/// Whether a fit completed and its error is no larger than that of another, regardless of their numbers of parameters.
bool is_as_good(const CalibrationFit& fit, const CalibrationFit& other) {
  constexpr double slack = 1.0;  // of the criterion, where smaller differences have no meaning
  const auto left = [](const CalibrationFit& of) { return of.aic - 2.0 * static_cast<double>(of.parameter_count); };
  if (fit.status != io::RunStatus::completed || fit.parameter_count == 0) return false;
  return other.status != io::RunStatus::completed || left(fit) <= left(other) + slack;
}

/// The state of a calibration in progress.
struct Search {
  const CalibrationProblem& problem;
  const CalibrationPlan& plan;
  Calibration calibration;

  [[nodiscard]] bool pays(const CalibrationFit& fit) const {
    if (calibration.steps.empty()) return true;
    if (fit.status != io::RunStatus::completed) return false;
    if (fit.parameter_count > calibration.fit().parameter_count && fit.residual_count > calibration.fit().residual_count)
      return true;  // it says something of curves that no other detail is fitted to
    const CalibrationFit& best = calibration.fit();
    return plan.choice || best.status != io::RunStatus::completed || fit.aic < best.aic - plan.aic_margin;
  }

  std::vector<std::size_t> necked;  ///< curves of bodies with plates that limbs leave
  std::vector<std::size_t> others;

  [[nodiscard]] std::vector<FittedCurve> curves_at(const std::vector<std::size_t>& places) const {
    std::vector<FittedCurve> curves;
    curves.reserve(places.size());
    for (const std::size_t place : places) curves.push_back(problem.curves[place]);
    return curves;
  }

  /// Fits parameters to some of the curves. The others have no residuals in the result.
  [[nodiscard]] CalibrationFit fit_to(const std::vector<std::size_t>& places, const std::vector<FittedParameter>& parameters,
                                      const SurrogateParameters& start) const {
    CalibrationFit fit = fit_parameters(curves_at(places), parameters, start, problem.responder, plan.fit);
    std::vector<std::vector<double>> residuals(problem.curves.size());
    for (std::size_t n = 0; n < fit.residuals.size(); ++n) residuals[places[n]] = std::move(fit.residuals[n]);
    fit.residuals = std::move(residuals);
    return fit;
  }

  /// Fits the neck ratio alone, to the bodies that have necks, and adds it to the last fit.
  [[nodiscard]] CalibrationFit fit_with_necks() const {
    CalibrationFit fit = calibration.fit();
    const auto parameters = fitted_parameters({CalibrationDetail::necks}, calibration.classes, problem.bounds, problem.start);
    const auto neck = std::ranges::find(parameters, Quantity::bulge_neck_ratio, &FittedParameter::quantity);
    const CalibrationFit own = fit_to(necked, {*neck}, fit.parameters);
    if (own.status != io::RunStatus::completed) {
      fit.status = own.status;
      fit.reason = own.reason;
      return fit;
    }
    fit.parameters.neck_ratio = own.parameters.neck_ratio;
    const std::size_t fitted = fit.correlation.size();
    fit.values.insert(fit.values.begin() + static_cast<std::ptrdiff_t>(fitted), own.values.front());
    for (auto& row : fit.correlation) row.emplace_back();
    fit.correlation.emplace_back(fitted + 1).back() = own.correlation.front().front();
    for (const std::size_t place : necked) fit.residuals[place] = own.residuals[place];
    fit.chi2 += own.chi2;
    fit.residual_count += own.residual_count;
    fit.parameter_count += own.parameter_count;
    fit.aic += own.aic;
    fit.explained = fit.explained && own.explained;
    return fit;
  }

  /// Fits a detail together with those kept, and takes the best result of all its starts. The starts give the detail its usual
  /// effect, where equilibria may be rare. The fit before is a special case of this one. If the result is not as good as that,
  /// the fit is made again from there.
  [[nodiscard]] CalibrationFit fit_with(CalibrationDetail detail, const DetailSet& details) const {
    if (detail == CalibrationDetail::necks) return fit_with_necks();
    const auto parameters = fitted_parameters(details, calibration.classes, problem.bounds, problem.start);
    const auto fit_from = [&](const SurrogateParameters& start) { return fit_to(others, parameters, start); };
    const bool has_before = !calibration.steps.empty() && calibration.fit().parameter_count > 0;
    const SurrogateParameters& before = has_before ? calibration.fit().parameters : problem.start;
    auto starts = starts_with_detail(before, detail, problem.start, pressure_range_Pa(problem.curves).highest);
    // A start that no curve feels would stay as it is, and bend all elbows by a number that nothing determines.
    if (detail == CalibrationDetail::elbows && std::ranges::none_of(problem.curves, [&](const FittedCurve& curve) {
          return has_elbows(curve.load_case, problem.start);
        }))
      starts = {before};
    CalibrationFit fit = fit_from(starts.front());
    for (std::size_t n = 1; n < starts.size() && fit.status != io::RunStatus::stopped; ++n) {
      CalibrationFit other = fit_from(starts[n]);
      const bool is_better = other.status == io::RunStatus::completed && (fit.status != other.status || other.aic < fit.aic);
      if (is_better || other.status == io::RunStatus::stopped) fit = std::move(other);
    }
    if (!has_before || detail == CalibrationDetail::sections || fit.status == io::RunStatus::stopped) return fit;
    if (is_as_good(fit, calibration.fit())) return fit;
    CalibrationFit again = fit_from(before);
    return again.status == io::RunStatus::stopped || is_as_good(again, fit) ? again : fit;
  }

  /// Fits one more detail. @return false if it was stopped
  bool try_detail(CalibrationDetail detail) {
    if (plan.begin) plan.begin(detail);
    CalibrationStep step;
    step.detail = detail;
    if (!calibration.steps.empty()) step.kept_before = calibration.details();
    step.fit = fit_with(detail, step.details());
    step.fit.parameters.validity = validity_of(problem, step.fit.parameters);
    const bool is_stopped = step.fit.status == io::RunStatus::stopped;
    step.is_kept = calibration.steps.empty() || (!is_stopped && pays(step.fit));
    const bool is_missed = plan.choice && !is_stopped && !step.is_kept;
    calibration.steps.push_back(std::move(step));
    if (calibration.steps.back().is_kept) calibration.chosen = calibration.steps.size() - 1;
    if (is_missed && !calibration.missed) calibration.missed = calibration.steps.size() - 1;
    return !is_stopped;
  }
};

}  // namespace

ValueRange pressure_range_Pa(const std::vector<FittedCurve>& curves) {
  ValueRange range;
  for (const FittedCurve& curve : curves) {
    for (const std::vector<double>& state : curve.states) {  // the pressure is the first abscissa of every kind
      range.lowest = std::min(range.lowest, state.front());
      range.highest = std::max(range.highest, state.front());
    }
  }
  return range;
}

DeterminedClasses determined_classes(const CalibrationProblem& problem) {
  constexpr double change = 0.01;
  DeterminedClasses classes{{}, {}, {}};
  std::vector<ParameterSpan> spans;
  std::vector<std::pair<std::vector<std::size_t>*, std::size_t>> meanings;  // by span: a list, and the class to add to it
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const auto add = [&](std::vector<std::size_t>& found, const auto& alter) {
      ParameterSpan span{.below = problem.start, .above = problem.start, .below_by = 0.0, .above_by = change};
      alter(span.above);
      spans.push_back(std::move(span));
      meanings.emplace_back(&found, c);
    };
    add(classes.stiffness, [c](SurrogateParameters& p) {
      for (ByWallClass<double>* stiffness : {&p.axial_Pa, &p.bending_Pa, &p.torsion_Pa}) (*stiffness)[c] *= 1.0 + change;
    });
    add(classes.extension, [c](SurrogateParameters& p) { p.extension[c].slope_per_Pa *= 1.0 + change; });
    add(classes.bulge, [c](SurrogateParameters& p) { p.bulge[c].slope_per_Pa *= 1.0 + change; });
  }
  std::vector<std::vector<bool>> matters(problem.curves.size());
  tbb::parallel_for(std::size_t{0}, matters.size(),
                    [&](std::size_t c) { matters[c] = spans_that_matter(problem, problem.curves[c], spans); });
  for (std::size_t n = 0; n < spans.size(); ++n) {
    if (std::ranges::any_of(matters, [n](const std::vector<bool>& of_curve) { return of_curve[n]; }))
      meanings[n].first->push_back(meanings[n].second);
  }
  for (auto* found : {&classes.stiffness, &classes.extension, &classes.bulge}) {
    if (found->empty()) found->push_back(closed_wall_class);
  }
  return classes;
}

DetailSet CalibrationStep::details() const {
  DetailSet all = kept_before;
  all.insert(detail);
  return all;
}

std::string to_string(const DetailSet& details) {
  std::string text;
  for (const CalibrationDetail detail : details) text.append(text.empty() ? "" : " + ").append(to_string(detail));
  return text;
}

std::vector<std::string> failed_details(const Calibration& calibration) {
  std::map<CalibrationDetail, std::string> failed;
  for (const CalibrationStep& step : calibration.steps) {
    failed.erase(step.detail);
    if (step.fit.status == io::RunStatus::completed) continue;
    failed[step.detail] = "detail " + std::string(to_string(step.detail)) + ": " + std::string(io::to_string(step.fit.status)) +
                          ", " + step.fit.reason + (step.is_kept ? "" : "; the result does not include it");
  }
  std::vector<std::string> sentences;
  sentences.reserve(failed.size());
  for (const auto& [detail, sentence] : failed) sentences.push_back(sentence);
  return sentences;
}

Calibration calibrate(const CalibrationProblem& problem, const CalibrationPlan& plan) {
  Search search{problem, plan, {}, {}, {}};
  search.calibration.classes = determined_classes(problem);
  for (std::size_t c = 0; c < problem.curves.size(); ++c)
    (has_necks(problem.curves[c].load_case, problem.start) ? search.necked : search.others).push_back(c);
  std::deque<CalibrationDetail> open(plan.details.begin(), plan.details.end());
  const auto necks = std::ranges::find(plan.details, CalibrationDetail::necks);
  const auto last = plan.choice ? std::ranges::find(plan.details, *plan.choice) : plan.details.end();
  const bool has_necks_detail = necks != plan.details.end() && (!plan.choice || necks <= last);
  std::erase(open, CalibrationDetail::necks);
  bool is_stopped = false;
  std::size_t in_vain = 0;  // number of details tried since the last one that was kept
  while (in_vain < open.size()) {
    const CalibrationDetail detail = open.front();
    open.pop_front();
    is_stopped = !search.try_detail(detail);
    if (is_stopped || plan.choice == detail) break;
    if (search.calibration.steps.back().is_kept) {
      in_vain = 0;
    } else {
      open.push_back(detail);
      ++in_vain;
    }
  }
  // Nothing else depends on the necks, and they depend on everything else.
  if (has_necks_detail && !is_stopped && !search.calibration.steps.empty())
    static_cast<void>(search.try_detail(CalibrationDetail::necks));
  return search.calibration;
}

}  // namespace menger::voxel
