#include "voxel/calibration.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "voxel/covered_pressures.h"

namespace menger::voxel {
namespace {

/// All curves' residuals; a curve without answer has none.
std::vector<std::vector<double>> all_residuals(const CalibrationProblem& problem, const SurrogateParameters& parameters) {
  std::vector<std::vector<double>> residuals;
  for (const FittedCurve& curve : problem.curves) {
    const auto answers = answers_of(curve, problem.responder(parameters, curve.load_case, curve.states));
    residuals.push_back(answers ? residuals_of(curve, *answers) : std::vector<double>{});
  }
  return residuals;
}

/// Whether any differs by more than what equilibria leave of their tolerance, which is far less than a standard deviation.
bool differ(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  constexpr double noise = 1e-6;
  const auto far = [](double one, double other) { return std::abs(one - other) > noise; };
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (a[c].size() != b[c].size()) return true;
    if (!std::equal(a[c].begin(), a[c].end(), b[c].begin(), [&](double one, double other) { return !far(one, other); }))
      return true;
  }
  return false;
}

ValidityRange validity_of(const CalibrationProblem& problem, const SurrogateParameters& parameters) {
  ValidityRange validity;
  for (const FittedCurve& curve : problem.curves) {
    const ValueRange pressures = pressure_range_Pa({curve});
    cover(validity, body_walls(curve.load_case), pressures.lowest, pressures.highest);
    const LoadCaseResponse response = problem.responder(parameters, curve.load_case, curve.states);
    validity.smallest_strain = std::min(validity.smallest_strain, response.smallest_strain);
    validity.largest_strain = std::max(validity.largest_strain, response.largest_strain);
    const int cells = materials::longest_side_cells(curve.load_case.cells, curve.load_case.digits);
    validity.longest_body_cells = std::max(validity.longest_body_cells, cells);
    validity.longest_aggregate_modules =
        std::max(validity.longest_aggregate_modules, materials::longest_side_modules(cells, curve.load_case.level));
  }
  return validity;
}

/// A calibration as it grows.
struct Search {
  const CalibrationProblem& problem;
  const CalibrationPlan& plan;
  Calibration calibration;

  [[nodiscard]] bool pays(const CalibrationFit& fit) const {
    if (calibration.steps.empty() || plan.choice) return true;
    if (fit.status != io::RunStatus::completed) return false;
    const CalibrationFit& best = calibration.fit();
    return best.status != io::RunStatus::completed || fit.aic < best.aic - plan.aic_margin;
  }

  /// Fits one more detail. @return false if it was stopped
  bool try_detail(CalibrationDetail detail) {
    if (plan.begin) plan.begin(detail);
    CalibrationStep step;
    step.detail = detail;
    SurrogateParameters start = problem.start;
    if (!calibration.steps.empty()) {
      step.kept_before = calibration.details();
      if (calibration.fit().parameter_count > 0) start = calibration.fit().parameters;
    }
    start = with_detail(start, detail, problem.start, pressure_range_Pa(problem.curves).highest);
    const auto parameters = fitted_parameters(step.details(), calibration.classes, problem.bounds, problem.start);
    step.fit = fit_parameters(problem.curves, parameters, start, problem.responder, plan.fit);
    step.fit.parameters.validity = validity_of(problem, step.fit.parameters);
    const bool is_stopped = step.fit.status == io::RunStatus::stopped;
    step.is_kept = calibration.steps.empty() || (!is_stopped && pays(step.fit));
    calibration.steps.push_back(std::move(step));
    if (calibration.steps.back().is_kept) calibration.chosen = calibration.steps.size() - 1;
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
  constexpr double change = 1.01;
  const auto rest = all_residuals(problem, problem.start);
  const auto matters = [&](const auto& alter) {
    SurrogateParameters changed = problem.start;
    alter(changed);
    return differ(all_residuals(problem, changed), rest);
  };
  DeterminedClasses classes{{}, {}, {}};
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const bool stiffness = matters([&](SurrogateParameters& p) {
      p.axial_Pa[c] *= change;
      p.bending_Pa[c] *= change;
      p.torsion_Pa[c] *= change;
    });
    if (stiffness) classes.stiffness.push_back(c);
    if (matters([&](SurrogateParameters& p) { p.extension[c].slope_per_Pa *= change; })) classes.extension.push_back(c);
    if (matters([&](SurrogateParameters& p) { p.bulge[c].slope_per_Pa *= change; })) classes.bulge.push_back(c);
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

Calibration calibrate(const CalibrationProblem& problem, const CalibrationPlan& plan) {
  Search search{problem, plan, {}};
  search.calibration.classes = determined_classes(problem);
  std::deque<CalibrationDetail> open(plan.details.begin(), plan.details.end());
  std::size_t in_vain = 0;  // since the last one that was kept
  while (in_vain < open.size()) {
    const CalibrationDetail detail = open.front();
    open.pop_front();
    if (!search.try_detail(detail) || plan.choice == detail) break;
    if (search.calibration.steps.back().is_kept) {
      in_vain = 0;
    } else {
      open.push_back(detail);
      ++in_vain;
    }
  }
  return search.calibration;
}

}  // namespace menger::voxel
