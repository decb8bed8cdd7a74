#pragma once

#include <filesystem>
#include <string>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"

namespace menger::meshes {

/// How a design is hollowed out and meshed: keys of the table of a design.
void describe(io::StudyVisitor& visitor, HollowBodyOptions& options);

/// Reads how a design is hollowed out and meshed from the keys of a table that bear the names of HollowBodyOptions:
/// wall_thickness_m, elements_through_wall, largest_element_m, growth, chambers ("single" or "per-phase"), level, hole_edge_m,
/// lid ("none", "bottom", "top"), joint_region, and tables [[tubes]] with cell (three integers), side ("x min" ... "z max") and
/// edge_m. Every key has the default of the struct; those of a tube have none. The caller finishes the table.
/// @throws io::InputError with file, key and value for what cannot be so for any design
HollowBodyOptions read_hollow_body_options(const io::TomlTable& table);

/// A design and how to mesh it.
struct MeshStudy {
  std::filesystem::path design_file;
  Design design;
  HollowBodyOptions options;
};

/// Reads either a design, meshed with the default options, or a file with the key `design` (a file name that counts from the
/// folder of this file) and the keys of read_hollow_body_options. @throws io::InputError with file, key and value
MeshStudy read_mesh_study(const std::filesystem::path& file);

/// All options as the TOML text that read_hollow_body_options gives back, for manifests.
std::string hollow_body_text(const HollowBodyOptions& options);

/// The words for the options that are one of a few.
const io::Words<ChamberLayout>& chamber_layout_words();
const io::Words<LidPlace>& lid_place_words();
const io::Words<Side>& side_words();

}  // namespace menger::meshes
