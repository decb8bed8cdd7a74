#pragma once

#include <string>
#include <utility>
#include <vector>

#include "meshes/load_cases/response_curve.h"
#include "tests/support/surrogate_example.h"
#include "voxel/statics/load_case_response.h"

namespace menger::voxel::samples {

inline SurrogateParameters validation_parameters() { return tests::plain_surrogate_example(); }

/// A curve of a bar of three cells.
inline meshes::ResponseCurve bar_curve(const std::string& name, meshes::LoadCaseKind kind,
                                       std::vector<std::vector<double>> values) {
  meshes::ResponseCurve curve;
  curve.provenance.load_case.name = name;
  curve.provenance.load_case.kind = kind;
  curve.provenance.load_case.cells = {3, 1, 1};
  curve.provenance.load_case.digits = "111";
  curve.provenance.load_case.cell_edge_m = 0.01;
  curve.provenance.load_case.wall_thickness_m = 0.002;
  curve.provenance.load_case.pressures_Pa = {0.0};
  if (meshes::abscissa_count(kind) == 2) curve.provenance.load_case.imposed = {0.0};
  curve.provenance.silicone = "test silicone";
  curve.provenance.law = "neo-Hookean 86.7 kPa";
  curve.provenance.shear_modulus_Pa = 86.7e3;
  curve.provenance.density_kg_m3 = 1070.0;
  curve.provenance.model = "made up";
  curve.provenance.relative_uncertainty = 0.05;
  curve.columns = meshes::response_columns(kind);
  curve.values = std::move(values);
  return curve;
}

/// Responses with a table, whatever is asked, as far as it goes; its strains are those given.
inline Responder responding(std::vector<std::vector<double>> values, double largest_strain = 0.1,
                            io::RunStatus status = io::RunStatus::completed) {
  return [values = std::move(values), largest_strain, status](const SurrogateParameters&, const meshes::LoadCase& load_case,
                                                              const std::vector<std::vector<double>>&) {
    LoadCaseResponse response;
    response.status = status;
    response.columns = meshes::response_columns(load_case.kind);
    response.values = values;
    response.largest_strain = largest_strain;
    return response;
  };
}

}  // namespace menger::voxel::samples
