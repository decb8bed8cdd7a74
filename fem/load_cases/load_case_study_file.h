#pragma once

#include <filesystem>

#include "fem/load_cases/load_case_study.h"

namespace menger::fem {

/// Reads a set of load cases. Tables and keys, with defaults where there are any:
///
/// relative_uncertainty = 0.05, of every ordinate by its largest magnitude: what the discretisation and the idealised shape
/// (walls of even thickness, sharp edges) are taken to be worth where nothing better is known. [material] as in a study of
/// `menger inflate` (see read_inflation_study); a density is needed. [body] cell_edge_m, wall_thickness_m, level = 1, chambers =
/// "single": for cases that give none of their own. [elements] degree = 2, through_wall = 1, largest_element_m (as in the wall),
/// growth = 1.5.
/// [[case]] name (letters, digits, "-", "_"), kind (see LoadCaseKind); either design (a design file, whose cell edge does not
/// count) or cells = [1, 1, 1] and digits = "1"; pressures_Pa or pressure_fractions (see CaseRequest; an inflation needs neither
/// and finds its own, `states` = 12 of them), largest_pressure_Pa; displacement_m, angle_rad or gravity_factor as the kind
/// demands; and any key of [body] or [elements] where the case differs.
/// @throws io::InputError with file, key and value for anything else, and for files that it names and that cannot be read
LoadCaseStudy read_load_case_study(const std::filesystem::path& file);

}  // namespace menger::fem
