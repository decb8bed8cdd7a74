#pragma once

#include <string>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// Returns the words for the kinds in files.
const io::Words<LoadCaseKind>& load_case_kind_words();

/// Returns the words for the chambers of a module: whether they are per phase.
const io::Words<bool>& case_chamber_words();

/// Returns the key in files for the imposed values of a kind, its second abscissa: "displacement_m", "angle_rad",
/// "gravity_factor". Empty for kinds without imposed values.
std::string imposed_key(LoadCaseKind kind);

/// Describes the keys of a fully stated load case, as in the provenance of a response curve. All must be given.
void describe(io::StudyVisitor& visitor, LoadCase& load_case);

/// Describes the name of a load case: letters, digits, "-" and "_", so that files can have the name.
void describe_name(io::StudyVisitor& visitor, LoadCase& load_case);

/// Describes the keys of the body: cells and digits.
void describe_cells(io::StudyVisitor& visitor, LoadCase& load_case);

/// Describes the imposed values, for each kind under its imposed_key.
void describe_imposed(io::StudyVisitor& visitor, LoadCase& load_case);

/// Returns a load case as the lines of a TOML table. Numbers are exact.
std::string load_case_text(const LoadCase& load_case);

/// Reads the text of load_case_text. The caller finishes the table.
/// @throws io::InputError with file, key and value for anything that is not a load case: a name with characters other than
/// letters, digits, "-" and "_", digits that do not fill the cells or are all 0, a wall not thinner than half a cell, no
/// pressure, imposed values of another kind
LoadCase read_load_case(const io::TomlTable& table);

/// Reads the keys of the body: cells and digits. @throws io::InputError with file, key and value
void read_cells(const io::TomlTable& table, LoadCase& load_case);

}  // namespace menger::meshes
