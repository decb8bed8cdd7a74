#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "voxel/calibration/calibration.h"
#include "voxel/calibration/calibration_start.h"

/// Bodies that response by closed forms in place of the surrogate, so that a fit takes milliseconds and the truth is known.
namespace menger::voxel::samples {

/// Of the corners that a bar of two by two cells across consists of.
inline constexpr std::size_t corner_wall_class = 2;

/// Wall class along the bar, told apart by the number of cells across.
inline std::size_t class_of(const meshes::LoadCase& load_case) {
  return load_case.cells[1] == 1 ? closed_wall_class : corner_wall_class;
}

/// Bars of two halves in series, plates on the ends, a joint where the level is 2.
inline LoadCaseResponse closed_forms(const SurrogateParameters& p, const meshes::LoadCase& load_case,
                                     const std::vector<std::vector<double>>& states) {
  using meshes::LoadCaseKind;
  const std::size_t c = class_of(load_case);
  const double edge = p.voxel_edge_m();
  const double length = edge * load_case.cells[0];
  const double joint_axial = load_case.level == 2 ? p.joint.axial : 1.0;
  const double axial_N = joint_axial * p.axial_Pa[c] * edge * edge;
  LoadCaseResponse response;
  response.columns = meshes::response_columns(load_case.kind);
  response.values.resize(response.columns.size());
  for (const std::vector<double>& state : states) {
    const double extension = p.extension[c].value(state[0]);
    const double bulge = p.bulge[c].value(state[0]);
    if (!(std::abs(extension) < 2.0 && std::abs(bulge) < 2.0)) {
      response.status = io::RunStatus::not_converged;
      return response;
    }
    std::vector<double> row = state;
    const double second = state.size() > 1 ? state[1] : 0.0;
    const double extent = length * extension + 2.0 * edge * bulge;
    switch (load_case.kind) {
      case LoadCaseKind::inflation:
        row.insert(row.end(),
                   {3.0 * extension + 6.0 * bulge, extent, edge * extension + 2.0 * edge * bulge,
                    edge * extension + 2.0 * edge * bulge, edge * extension + edge * bulge * (1.0 + p.bulge_peak_ratio[c])});
        break;
      case LoadCaseKind::stretch: {
        const double strain = second / length - extension;
        row.insert(row.end(), {axial_N * strain, extension + 4.0 * bulge, edge * bulge, edge * bulge});
        break;
      }
      case LoadCaseKind::bending:
        row.push_back(p.bending_Pa[c] * std::pow(edge, 4) / 12.0 * second / length);
        break;
      case LoadCaseKind::torsion:
        row.push_back(p.torsion_Pa[c] * std::pow(edge, 4) / 12.0 * second / length);
        break;
      case LoadCaseKind::press:
        row.push_back(p.ground_stiffness_N_per_m * load_case.cells[0] * second);
        break;
      default:
        response.status = io::RunStatus::not_converged;
        return response;
    }
    for (std::size_t column = 0; column < row.size(); ++column) response.values[column].push_back(row[column]);
    if (load_case.kind == LoadCaseKind::stretch) response.largest_strain = std::max(response.largest_strain, second / length);
  }
  return response;
}

inline meshes::CurveProvenance provenance() {
  meshes::CurveProvenance made;
  made.load_case.cell_edge_m = 0.01;
  made.load_case.wall_thickness_m = 0.002;
  made.silicone = "Dragon Skin 10";
  made.law = "neo_hookean, shear_modulus_Pa = 86677";
  made.shear_modulus_Pa = 86677.0;
  made.density_kg_m3 = 1070.0;
  made.model = "closed forms";
  made.relative_uncertainty = 0.02;
  return made;
}

inline PressureLaw law(double slope_per_Pa, double pressure_softening_per_Pa, double vacuum_softening_per_Pa) {
  return {.slope_per_Pa = slope_per_Pa,
          .pressure_softening_per_Pa = pressure_softening_per_Pa,
          .vacuum_softening_per_Pa = vacuum_softening_per_Pa};
}

/// Parameters away from rough_parameters and from their proportions, with all that the closed forms know.
inline SurrogateParameters truth() {
  SurrogateParameters p = rough_parameters(provenance(), 1);
  p.axial_Pa.fill(60e3);
  p.axial_Pa[closed_wall_class] = 140e3;
  p.bending_Pa = p.axial_Pa;
  p.torsion_Pa = p.axial_Pa;
  for (double& value : p.bending_Pa) value *= 1.6;
  for (double& value : p.torsion_Pa) value *= 0.7;
  p.extension.fill(law(4e-6, 20e-6, -15e-6));
  p.extension[closed_wall_class] = law(2.5e-6, 20e-6, -15e-6);
  p.bulge.fill(law(1e-6, 30e-6, -25e-6));
  p.bulge[closed_wall_class] = law(4e-7, 30e-6, -25e-6);
  p.bulge_peak_ratio.fill(3.1);
  p.bulge_peak_ratio[closed_wall_class] = 2.2;
  p.ground_stiffness_N_per_m = 5000.0;
  return p;
}

inline meshes::ResponseCurve curve_of(const meshes::LoadCase& load_case, const SurrogateParameters& parameters) {
  meshes::ResponseCurve curve;
  curve.provenance = provenance();
  curve.provenance.load_case = load_case;
  std::vector<std::vector<double>> states;
  for (const double pressure_Pa : load_case.pressures_Pa) {
    if (load_case.imposed.empty()) states.push_back({pressure_Pa});
    for (const double value : load_case.imposed) states.push_back({pressure_Pa, value});
  }
  const LoadCaseResponse response = closed_forms(parameters, load_case, states);
  curve.columns = response.columns;
  curve.values = response.values;
  return curve;
}

/// Load cases on a tube of three cells and on a bar of 3 x 2 x 2 cells.
inline std::vector<meshes::LoadCase> load_cases() {
  using meshes::LoadCaseKind;
  std::vector<meshes::LoadCase> cases;
  for (const int across : {1, 2}) {
    const auto add = [&](LoadCaseKind kind, std::vector<double> pressures_Pa, std::vector<double> imposed) {
      meshes::LoadCase load_case = provenance().load_case;
      load_case.kind = kind;
      load_case.name = (across == 1 ? "tube_" : "bar_") + std::string(meshes::to_string(kind));
      load_case.cells = {3, across, across};
      load_case.digits = std::string(static_cast<std::size_t>(3 * across * across), '1');
      load_case.pressures_Pa = std::move(pressures_Pa);
      load_case.imposed = std::move(imposed);
      cases.push_back(load_case);
    };
    add(LoadCaseKind::inflation, {-12000, -9000, -6000, -3000, 3000, 6000, 9000, 12000, 15000}, {});
    add(LoadCaseKind::stretch, {0, 8000}, {-0.003, 0.003, 0.006});
    add(LoadCaseKind::bending, {0}, {0.1, 0.3, 0.5});
    add(LoadCaseKind::torsion, {0}, {0.1, 0.3, 0.5});
    add(LoadCaseKind::press, {0}, {0.0005, 0.001});
  }
  return cases;
}

/// The curves of load_cases() for parameters, as residuals see them, with Gaussian noise of the stated standard deviations.
inline std::vector<FittedCurve> noisy_curves(const SurrogateParameters& parameters, std::uint64_t seed, double noise = 1.0) {
  std::mt19937_64 stream(seed);
  std::normal_distribution<double> normal;
  std::vector<FittedCurve> curves;
  for (const meshes::LoadCase& load_case : load_cases()) {
    curves.push_back(fitted_curve(curve_of(load_case, parameters)));
    FittedCurve& curve = curves.back();
    for (std::size_t o = 0; o < curve.ordinates.size(); ++o) {
      for (double& value : curve.reference[o]) value += noise * curve.sigma[o] * normal(stream);
    }
  }
  return curves;
}

inline CalibrationProblem problem(std::vector<FittedCurve> curves) {
  CalibrationProblem made;
  made.start = rough_parameters(provenance(), 1);
  const ValueRange pressures = pressure_range_Pa(curves);
  made.bounds = default_bounds(made.start, pressures.lowest, pressures.highest);
  made.curves = std::move(curves);
  made.responder = closed_forms;
  return made;
}

inline const FittedValue& value_named(const CalibrationFit& fit, const std::string& name) {
  const auto found =
      std::find_if(fit.values.begin(), fit.values.end(), [&](const FittedValue& value) { return value.parameter.name == name; });
  if (found == fit.values.end()) throw std::out_of_range(name);
  return *found;
}

/// All that has a value of its own per wall class; what `samples::truth()` needs.
inline const DetailSet by_class{CalibrationDetail::bulge_classes, CalibrationDetail::extension_classes,
                                CalibrationDetail::stiffness_classes};

}  // namespace menger::voxel::samples
