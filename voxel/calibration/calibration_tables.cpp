#include "voxel/calibration/calibration_tables.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace menger::voxel {
namespace {

using meshes::LoadCaseKind;

/// The kinds of load case among the curves, in the order of the enumeration.
std::set<LoadCaseKind> kinds_of(const std::vector<FittedCurve>& curves) {
  std::set<LoadCaseKind> kinds;
  for (const FittedCurve& curve : curves) kinds.insert(curve.load_case.kind);
  return kinds;
}

std::string classes_text(const FittedParameter& parameter) {
  std::vector<std::size_t> classes = parameter.classes;
  std::sort(classes.begin(), classes.end());
  std::string text;
  for (const std::size_t c : classes) text.append(text.empty() ? "" : " ").append(wall_class_names[c]);
  return text;
}

}  // namespace

double response_at(const FittedCurve& curve, const std::vector<double>& residuals, std::size_t n) {
  const std::size_t rows = curve.states.size();
  return curve.reference[n / rows][n % rows] + curve.sigma[n / rows] * residuals[n];
}

std::vector<OrdinateError> ordinate_errors(const std::vector<FittedCurve>& curves, const CalibrationFit& fit) {
  std::vector<OrdinateError> errors;
  for (std::size_t c = 0; c < fit.residuals.size(); ++c) {
    if (fit.residuals[c].empty()) continue;
    const std::size_t rows = curves[c].states.size();
    for (std::size_t o = 0; o < curves[c].ordinates.size(); ++o) {
      OrdinateError error{.curve = c, .ordinate = curves[c].ordinates[o]};
      double square = 0.0;
      double largest = curves[c].sigma[o];
      for (std::size_t row = 0; row < rows; ++row) {
        const double difference = curves[c].sigma[o] * fit.residuals[c][o * rows + row];
        square += difference * difference;
        if (std::abs(difference) > std::abs(error.worst)) error.worst = difference;
        largest = std::max(largest, std::abs(curves[c].reference[o][row]));
      }
      error.rms = std::sqrt(square / static_cast<double>(rows));
      error.relative = error.rms / largest;
      errors.push_back(error);
    }
  }
  return errors;
}

std::optional<double> relative_error_of(std::optional<LoadCaseKind> kind, const std::vector<FittedCurve>& curves,
                                        const CalibrationFit& fit) {
  double square = 0.0;
  double count = 0.0;
  for (const OrdinateError& error : ordinate_errors(curves, fit)) {
    if (kind && curves[error.curve].load_case.kind != *kind) continue;
    square += error.relative * error.relative;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return std::sqrt(square / count);
}

std::string body_text(const meshes::LoadCase& load_case) {
  std::string text;
  for (const int cells : load_case.cells) text.append(text.empty() ? "" : "x").append(std::to_string(cells));
  if (load_case.level > 1) text.append(" level ").append(std::to_string(load_case.level));
  if (load_case.digits.find('0') != std::string::npos) text.append(" (").append(load_case.digits).append(")");
  return text;
}

io::CsvTable detail_table(const Calibration& calibration, const std::vector<FittedCurve>& curves) {
  std::vector<std::string> columns{"detail",    "joined_with", "kept",         "status", "parameters",
                                   "residuals", "chi2",        "reduced_chi2", "aic",    "relative_rms"};
  const std::set<LoadCaseKind> kinds = kinds_of(curves);
  for (const LoadCaseKind kind : kinds) columns.push_back("relative_rms_" + std::string(meshes::to_string(kind)));
  io::CsvTable table(columns);
  for (const CalibrationStep& step : calibration.steps) {
    const CalibrationFit& fit = step.fit;
    const bool has_residuals = fit.residual_count > 0;
    const auto count = [&](std::size_t value) {
      return io::cell(has_residuals ? std::optional(static_cast<double>(value)) : std::nullopt);
    };
    const auto number = [&](double value) { return io::cell(has_residuals ? std::optional(value) : std::nullopt); };
    std::vector<io::CsvCell> cells{io::cell(to_string(step.detail)),
                                   io::cell(to_string(step.kept_before)),
                                   io::cell(step.is_kept ? "yes" : "no"),
                                   io::cell(io::to_string(fit.status)),
                                   count(fit.parameter_count),
                                   count(fit.residual_count),
                                   number(fit.chi2),
                                   number(fit.reduced_chi2()),
                                   number(fit.aic),
                                   io::cell(relative_error_of(std::nullopt, curves, fit))};
    for (const LoadCaseKind kind : kinds) cells.push_back(io::cell(relative_error_of(kind, curves, fit)));
    table.add_cells(cells);
  }
  return table;
}

io::CsvTable parameter_table(const CalibrationFit& fit) {
  io::CsvTable table({"parameter", "value", "lowest_95", "highest_95", "classes", "determination"});
  for (const FittedValue& value : fit.values) {
    const auto& interval = value.confidence_95;
    table.add_row(value.parameter.name, value.value, interval ? std::optional(interval->first) : std::nullopt,
                  interval ? std::optional(interval->second) : std::nullopt, classes_text(value.parameter),
                  to_string(value.determination));
  }
  return table;
}

io::CsvTable correlation_table(const CalibrationFit& fit) {
  std::vector<std::string> columns{"parameter"};
  for (std::size_t v = 0; v < fit.correlation.size(); ++v) columns.push_back(fit.values[v].parameter.name);
  io::CsvTable table(columns);
  for (std::size_t v = 0; v < fit.correlation.size(); ++v) {
    std::vector<io::CsvCell> cells{io::cell(fit.values[v].parameter.name)};
    for (const std::optional<double>& value : fit.correlation[v]) cells.push_back(io::cell(value));
    table.add_cells(cells);
  }
  return table;
}

io::CsvTable residual_table(const std::vector<FittedCurve>& curves, const CalibrationFit& fit) {
  io::CsvTable table({"case", "kind", "body", "ordinate", "rms", "worst", "unit", "relative"});
  for (const OrdinateError& error : ordinate_errors(curves, fit)) {
    const meshes::LoadCase& load_case = curves[error.curve].load_case;
    table.add_row(load_case.name, meshes::to_string(load_case.kind), body_text(load_case), error.ordinate, error.rms, error.worst,
                  unit_of(error.ordinate), error.relative);
  }
  return table;
}

io::CsvTable response_table(const std::vector<FittedCurve>& curves, const CalibrationFit& fit) {
  io::CsvTable table({"case", "kind", "body", "pressure_Pa", "imposed", "ordinate", "reference", "surrogate", "sigma"});
  for (std::size_t c = 0; c < fit.residuals.size(); ++c) {
    const FittedCurve& curve = curves[c];
    const std::size_t rows = curve.states.size();
    for (std::size_t n = 0; n < fit.residuals[c].size(); ++n) {
      const std::vector<double>& state = curve.states[n % rows];
      const auto imposed = state.size() > 1 ? std::optional(state[1]) : std::nullopt;
      table.add_row(curve.load_case.name, meshes::to_string(curve.load_case.kind), body_text(curve.load_case), state[0], imposed,
                    curve.ordinates[n / rows], curve.reference[n / rows][n % rows], response_at(curve, fit.residuals[c], n),
                    curve.sigma[n / rows]);
    }
  }
  return table;
}

}  // namespace menger::voxel
