#pragma once

#include <string>
#include <string_view>

#include "io/text/toml_document.h"
#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// The words for the kinds in files.
const io::Words<LoadCaseKind>& load_case_kind_words();

/// The key under which files give the imposed values of a kind, its second abscissa: "displacement_m", "angle_rad",
/// "gravity_factor"; empty for kinds that impose nothing.
std::string imposed_key(LoadCaseKind kind);

/// A load case as the lines of a TOML table, numbers exact: name, kind, cells, digits, level, chambers ("single" or "per-phase"),
/// cell_edge_m, wall_thickness_m, pressures_Pa, and the imposed values under imposed_key(kind).
std::string load_case_text(const LoadCase& load_case);

/// Reads what load_case_text writes. The caller finishes the table.
/// @throws io::InputError with file, key and value for anything that is no load case: a name with other signs than letters,
/// digits, "-" and "_", digits that do not fill the cells or are all 0, a wall not thinner than half a cell, no pressure, imposed
/// values of another kind
LoadCase read_load_case(const io::TomlTable& table);

/// Reads the part that says which body: cells and digits. @throws io::InputError with file, key and value
void read_cells(const io::TomlTable& table, LoadCase& load_case);

/// Reads a name that can be that of a file: letters, digits, "-" and "_". @throws io::InputError with file, key and value
std::string read_case_name(const io::TomlTable& table);

}  // namespace menger::meshes
