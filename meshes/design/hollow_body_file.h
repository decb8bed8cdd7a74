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

/// How a design is hollowed out and meshed: keys of the table of a design.
void describe(io::StudyVisitor& visitor, HollowBodyOptions& options);

/// A design and how to mesh it.
struct MeshStudy {
  std::optional<std::filesystem::path> design_file;  ///< nothing for a design that is drawn in the study
  Design design;
  HollowBodyOptions options;
};

/// The keys of a study of `menger mesh`; `menger mesh --keys` lists them.
void describe(io::StudyVisitor& visitor, MeshStudy& study);

/// Reads either a design, meshed with the default options, or a study of `menger mesh`.
/// @throws io::InputError with file, key and value
MeshStudy read_mesh_study(const std::filesystem::path& file);

/// All options as the lines of a table, whose header is the caller's. @param table its name, for the tables in it; empty: the top
std::string hollow_body_text(const HollowBodyOptions& options, std::string_view table = {});

/// The words for the options that are one of a few.
const io::Words<ChamberLayout>& chamber_layout_words();
const io::Words<LidPlace>& lid_place_words();
const io::Words<Side>& side_words();

}  // namespace menger::meshes
