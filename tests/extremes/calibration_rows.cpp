#include "tests/extremes/calibration_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "tests/extremes/part.h"
#include "tests/unit/voxel/calibration/calibration_samples.h"

namespace menger::extremes {

voxel::SurrogateParameters calibration_truth() {
  voxel::SurrogateParameters truth = voxel::samples::truth();
  const std::size_t tube = voxel::closed_wall_class;
  truth.axial_Pa.fill(truth.axial_Pa[tube]);
  truth.bending_Pa.fill(truth.bending_Pa[tube]);
  truth.torsion_Pa.fill(truth.torsion_Pa[tube]);
  truth.extension.fill(truth.extension[tube]);
  truth.bulge.fill(truth.bulge[tube]);
  truth.bulge_peak_ratio.fill(truth.bulge_peak_ratio[tube]);
  return truth;
}

std::vector<voxel::FittedCurve> tube_curves(std::uint64_t seed, double noise) {
  std::vector<voxel::FittedCurve> curves = voxel::samples::noisy_curves(calibration_truth(), seed, noise);
  std::erase_if(curves, [](const voxel::FittedCurve& curve) {
    return voxel::samples::class_of(curve.load_case) != voxel::closed_wall_class;
  });
  return curves;
}

voxel::CalibrationPlan tube_plan() {
  voxel::CalibrationPlan plan;
  plan.details = {voxel::CalibrationDetail::uniform, voxel::CalibrationDetail::stiffness};
  plan.choice = voxel::CalibrationDetail::stiffness;
  return plan;
}

const voxel::FittedValue& value_named(const voxel::CalibrationFit& fit, const std::string& name) {
  const auto found = std::find_if(fit.values.begin(), fit.values.end(),
                                  [&](const voxel::FittedValue& value) { return value.parameter.name == name; });
  if (found == fit.values.end()) throw std::out_of_range("the fit has no " + name);
  return *found;
}

voxel::FittedCurve& curve_of_kind(std::vector<voxel::FittedCurve>& curves, meshes::LoadCaseKind kind) {
  const auto found =
      std::find_if(curves.begin(), curves.end(), [&](const voxel::FittedCurve& curve) { return curve.load_case.kind == kind; });
  if (found == curves.end()) throw std::out_of_range("no curve of " + std::string(meshes::to_string(kind)));
  return *found;
}

std::size_t ordinate_index(const voxel::FittedCurve& curve, const std::string& ordinate) {
  const auto found = std::find(curve.ordinates.begin(), curve.ordinates.end(), ordinate);
  if (found == curve.ordinates.end()) throw std::out_of_range(curve.load_case.name + " has no " + ordinate);
  return static_cast<std::size_t>(found - curve.ordinates.begin());
}

double worst_distance(const voxel::CalibrationFit& found, const voxel::CalibrationFit& stated,
                      const voxel::SurrogateParameters& truth) {
  constexpr double normal_quantile_95 = 1.959964;
  double worst = 0.0;
  for (const voxel::FittedValue& value : stated.values) {
    if (!value.confidence_95) continue;
    const voxel::FittedParameter& parameter = value.parameter;
    const double half_width =
        0.5 * (parameter.unknown_of(value.confidence_95->second) - parameter.unknown_of(value.confidence_95->first));
    const double off =
        parameter.unknown_of(value_named(found, parameter.name).value) - parameter.unknown_of(voxel::value_in(truth, parameter));
    const double distance = normal_quantile_95 * std::abs(off) / half_width;
    if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, distance);
  }
  return worst;
}

Part part() {
  Part part{.name = "calibration", .rows = {}};
  for (auto& rows : {calibration_data_rows(), calibration_outlier_rows(), calibration_start_rows(), calibration_input_rows()})
    std::copy(rows.begin(), rows.end(), std::back_inserter(part.rows));
  return part;
}

}  // namespace menger::extremes
