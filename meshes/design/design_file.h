#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "meshes/design/polycube.h"

namespace menger::meshes {

/// A design: a basal body and the edge of its cells.
struct Design {
  std::string name;
  Polycube body;
  double cell_edge_m = 0.01;  ///< edge of a cell of level 1, in metres, > 0

  bool operator==(const Design&) const = default;
};

/// Reads a design from TOML: name, cell_edge_m and layers (from the ground up), each layer an array of strings of digits, one
/// string per row of constant y with y growing downwards in the file, x growing along the row.
/// @throws io::InputError with file, key and value for anything that is not such a design, an empty body included
Design read_design(const std::filesystem::path& file);

/// The keys of a design file; see read_design.
void describe(io::StudyVisitor& visitor, Design& design);

/// The keys by which a table of a study gives a design: `file`, or the design itself in its layers, or as digits; with a file,
/// cell_edge_m gives its cells another size. Texts have the design itself.
/// @param file that was named, for a reader; nothing otherwise. A reader reads it.
void describe_design(io::StudyVisitor& visitor, Design& design, std::optional<std::filesystem::path>& file);

/// Writes a design so that read_design gives it back; whole or not at all. @throws io::InputError if the place cannot be written
void write_design(const std::filesystem::path& file, const Design& design);

/// The text that write_design writes.
std::string design_text(const Design& design);

}  // namespace menger::meshes
