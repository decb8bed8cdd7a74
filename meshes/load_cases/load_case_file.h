#pragma once

#include <string>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// The words for the kinds in files.
const io::Words<LoadCaseKind>& load_case_kind_words();

/// The words for what chambers a module has: whether they are per phase.
const io::Words<bool>& case_chamber_words();

/// The key under which files give the imposed values of a kind, its second abscissa: "displacement_m", "angle_rad",
/// "gravity_factor"; empty for kinds that impose nothing.
std::string imposed_key(LoadCaseKind kind);

/// The keys of a load case that is stated in full, as the provenance of a response curve has it. All must be given.
void describe(io::StudyVisitor& visitor, LoadCase& load_case);

/// The part of them that names it: letters, digits, "-" and "_", so that files can have the name.
void describe_name(io::StudyVisitor& visitor, LoadCase& load_case);

/// The part that says which body: cells and digits.
void describe_cells(io::StudyVisitor& visitor, LoadCase& load_case);

/// The part that says what is imposed, each kind under its imposed_key.
void describe_imposed(io::StudyVisitor& visitor, LoadCase& load_case);

/// A load case as the lines of a TOML table, numbers exact.
std::string load_case_text(const LoadCase& load_case);

/// Reads what load_case_text writes. The caller finishes the table.
/// @throws io::InputError with file, key and value for anything that is no load case: a name with other signs than letters,
/// digits, "-" and "_", digits that do not fill the cells or are all 0, a wall not thinner than half a cell, no pressure, imposed
/// values of another kind
LoadCase read_load_case(const io::TomlTable& table);

/// Reads the part that says which body: cells and digits. @throws io::InputError with file, key and value
void read_cells(const io::TomlTable& table, LoadCase& load_case);

}  // namespace menger::meshes
