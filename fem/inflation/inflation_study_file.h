#pragma once

#include <filesystem>
#include <functional>

#include "fem/inflation/inflation_study.h"
#include "io/text/toml_document.h"

namespace menger::fem {

/// Reads a study of `menger inflate`. Tables and keys, with defaults where there are any:
///
/// [design] file, and the keys of meshes::read_hollow_body_options; or [mesh] file (.msh or .vtu) and length_unit_m = 1.
/// [material] record (the name of a silicone of menger or a .toml file) with law = "recommended" or the name of another law of
/// the record and law_variant = 1 (which of those with that name), or a table [material.law]; volumetric = "simo_taylor";
/// bulk_modulus_Pa (50 shear moduli); density_kg_per_m3 (the record's). [[material.regions]] the same with region = "lid", ...
/// [element] degree = 2, formulation = "three_field", refinements = 0.
/// [supports] kind = "ground_guided", ground_stiffness_Pa_per_m = 1e7, [[supports.labels]] label, held = ["x", "y", "z"].
/// [loads] gravity_m_per_s2 = 0.
/// [[plates]] name, side ("x min" ... "z max", of the body's bounding box) or label, grip = "bonded" or "sliding" (on a side,
/// along whose normal alone such a plate moves); displacement_x_m, displacement_y_m, displacement_z_m and rotation_x_rad,
/// rotation_y_rad, rotation_z_rad (rotation vector about the middle of its faces): the motion at the knots of the path, the first
/// of them 0; what is not given stays 0. What a plate holds no support moves. [path] one of pressure_Pa, volume_ratio, gas_amount
/// (with gas_exponent = 1, ambient_pressure_Pa = 101325): the values at the knots, of which the first is that at rest: 0 of
/// pressure_Pa, 1 of the others; or [[path.plenum]] name and the same for each plenum; first_step, largest_step, smallest_step,
/// stations, touching_gap, desired_iterations, predictor_order as in PathOptions. [solver] linear = "automatic",
/// largest_direct_size, linear_tolerance, force_tolerance, volume_tolerance, largest_iteration_count, predict_pressure. [output]
/// fields = true, fields_every = 1, pictures = true, [[output.points]] name, position_m.
/// @throws io::InputError with file, key and value for anything else, and for files that it names and that cannot be read
InflationStudy read_inflation_study(const std::filesystem::path& file);

/// A silicone from the keys of a table, see read_inflation_study. @param read_input is given every file before it is read
/// @param notes takes what was assumed
StudyMaterial read_study_material(const io::TomlTable& table, const std::function<void(const std::filesystem::path&)>& read_input,
                                  std::vector<std::string>& notes);

}  // namespace menger::fem
