#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"

namespace menger::meshes {

/// Describes how a design is made hollow and meshed: keys of the table of a design.
/// @param are_elements_free whether the keys that cut the body into elements have a meaning: they have none where the elements'
/// fidelity decides. Empty: the study has no choice of elements, so they always have.
void describe(io::StudyVisitor& visitor, HollowBodyOptions& options, std::optional<bool> are_elements_free = {});

/// A design and the options for meshing it.
struct MeshStudy {
  std::optional<std::filesystem::path> design_file;  ///< nothing if the design is given in the study itself
  Design design;
  HollowBodyOptions options;
};

/// Describes the keys of a study of `menger mesh`; `menger mesh --keys` lists them.
void describe(io::StudyVisitor& visitor, MeshStudy& study);

/// Reads a design, which is then meshed with the default options, or a study of `menger mesh`.
/// @throws io::InputError with file, key and value
MeshStudy read_mesh_study(const std::filesystem::path& file);

/// Returns all options as the lines of a table; the caller writes its header. @param table name of the table, used for the tables
/// in it; empty: the top of the file
std::string hollow_body_text(const HollowBodyOptions& options, std::string_view table = {});

/// The words in files for options with a few possible values.
const io::Words<ChamberLayout>& chamber_layout_words();
const io::Words<LidPlace>& lid_place_words();
const io::Words<Side>& side_words();

}  // namespace menger::meshes
