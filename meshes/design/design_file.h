#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "meshes/design/polycube.h"

namespace menger::meshes {

/// A design: a basal body and the edge length of its cells.
struct Design {
  std::string name;
  Polycube body;
  double cell_edge_m = 0.01;  ///< edge of a cell of level 1, in metres, > 0

  bool operator==(const Design&) const = default;
};

/// Returns the body length of a design at a level, see fractal.h. The longest side of its grid counts.
double body_length_m(const Design& design, int level);

/// Reads a design from a TOML file with the keys name, cell_edge_m and layers. The layers are listed from the ground up. Each
/// layer is an array of strings of digits, one string per row of constant y. In the file x increases along a row and y increases
/// downwards.
/// @throws io::InputError with file, key and value for wrong input, including an empty body
Design read_design(const std::filesystem::path& file);

/// Describes the keys of a design file; see read_design.
void describe(io::StudyVisitor& visitor, Design& design);

/// Describes the keys with which a table of a study gives a design: `file`, or the design itself as `layers` or `digits`. With a
/// file, cell_edge_m replaces the cell edge of the file. Texts of a study contain the design itself.
/// @param file the file that was named, set by a reader, which also reads it; otherwise nothing
void describe_design(io::StudyVisitor& visitor, Design& design, std::optional<std::filesystem::path>& file);

/// Writes a design so that read_design returns the same design; whole or not at all. @throws io::InputError if the file cannot be
/// written
void write_design(const std::filesystem::path& file, const Design& design);

/// Returns the text that write_design writes.
std::string design_text(const Design& design);

}  // namespace menger::meshes
