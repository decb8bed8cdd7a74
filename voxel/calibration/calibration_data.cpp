#include "voxel/calibration/calibration_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

namespace menger::voxel {
namespace {

constexpr double smallest_share = 1e-2;  // of the largest ordinate of the same unit

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

std::string unit_of(const std::string& column) {
  // "N_m" before "m": the longer first
  constexpr std::array<std::string_view, 6> units{"N_m", "Pa", "Hz", "rad", "N", "m"};
  for (const std::string_view unit : units) {
    if (column.ends_with("_" + std::string(unit))) return std::string(unit);
  }
  return {};
}

FittedCurve fitted_curve(const meshes::ResponseCurve& curve, double weight) {
  FittedCurve fitted;
  fitted.load_case = curve.provenance.load_case;
  fitted.weight = weight;
  const std::size_t abscissae = meshes::abscissa_count(fitted.load_case.kind);
  for (std::size_t row = 0; row < curve.row_count(); ++row) {
    std::vector<double> state;
    for (std::size_t a = 0; a < abscissae; ++a) state.push_back(curve.values[a][row]);
    fitted.states.push_back(std::move(state));
  }
  std::map<std::string, double> largest_of_unit;
  for (std::size_t c = abscissae; c < curve.columns.size(); ++c) {
    double& largest = largest_of_unit[unit_of(curve.columns[c])];
    largest = std::max(largest, largest_magnitude(curve.values[c]));
  }
  for (std::size_t c = abscissae; c < curve.columns.size(); ++c) {
    const double floor = smallest_share * largest_of_unit.at(unit_of(curve.columns[c]));
    const double magnitude = std::max(largest_magnitude(curve.values[c]), floor);
    if (magnitude == 0.0) continue;
    fitted.ordinates.push_back(curve.columns[c]);
    fitted.reference.push_back(curve.values[c]);
    fitted.sigma.push_back(curve.provenance.relative_uncertainty * magnitude);
  }
  return fitted;
}

std::optional<std::vector<std::vector<double>>> responses_of(const FittedCurve& curve, const LoadCaseResponse& response) {
  if (response.status != io::RunStatus::completed) return std::nullopt;
  std::vector<std::vector<double>> responses;
  for (const std::string& ordinate : curve.ordinates) {
    const auto place = std::find(response.columns.begin(), response.columns.end(), ordinate);
    if (place == response.columns.end()) return std::nullopt;
    const std::vector<double>& column = response.values.at(static_cast<std::size_t>(place - response.columns.begin()));
    const bool finite = std::all_of(column.begin(), column.end(), [](double value) { return std::isfinite(value); });
    if (column.size() != curve.states.size() || !finite) return std::nullopt;
    responses.push_back(column);
  }
  return responses;
}

std::vector<double> residuals_of(const FittedCurve& curve, const std::vector<std::vector<double>>& responses) {
  std::vector<double> residuals;
  residuals.reserve(curve.residual_count());
  for (std::size_t o = 0; o < curve.ordinates.size(); ++o) {
    for (std::size_t row = 0; row < curve.states.size(); ++row)
      residuals.push_back((responses[o][row] - curve.reference[o][row]) / curve.sigma[o]);
  }
  return residuals;
}

std::vector<double> slopes_of(const FittedCurve& curve, const std::vector<std::string>& columns, const ResponseSlope& slope) {
  std::vector<double> slopes;
  slopes.reserve(curve.residual_count());
  for (std::size_t o = 0; o < curve.ordinates.size(); ++o) {
    const auto place = std::ranges::find(columns, curve.ordinates[o]) - columns.begin();
    for (const double value : slope.at(static_cast<std::size_t>(place))) slopes.push_back(value / curve.sigma[o]);
  }
  return slopes;
}

}  // namespace menger::voxel
