#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "evolution/genome/cppn_expression.h"
#include "evolution/genome/genome.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// How a genome grows into a body.
struct DecoderOptions {
  BodyPlan plan = BodyPlan::fractal;
  ExpressionOptions expression;

  bool operator==(const DecoderOptions&) const = default;
};

/// The body that a genome grows into: the arrays of 3 x 3 x 3 cells that decide every aggregate.
struct Phenotype {
  meshes::Polycube body;  ///< the basal body, face-connected

  /// Non-fractal plan only: which cells of the level-2 grid hold a basal body, and which cells of the level-3 grid hold a level-2
  /// aggregate. Both are face-connected and of material 1. For the fractal plans they are grids without cells (0 x 0 x 0). For
  /// the non-fractal plan of two scales the second one is a cell alone, so that level 3 is level 2 in the middle of an empty
  /// grid.
  meshes::Polycube arrangement;
  meshes::Polycube arrangement_of_arrangements;

  bool operator==(const Phenotype&) const = default;

  /// Returns whether the arrangements are arrays of their own, as in the non-fractal plan.
  [[nodiscard]] bool has_arrangements() const { return arrangement.nx() > 0; }
};

/// The most cells that the arrays of a phenotype have together.
inline constexpr std::size_t largest_array_cells = 3 * basal_cells;

/// The largest level of a phenotype with arrangements.
inline constexpr int largest_arranged_level = 3;

/// Returns the largest level at which a body plan has a body of its own; the largest int for fractal plans, which have no such
/// level.
int largest_level(BodyPlan plan);

/// Grows the phenotype of a genome. A cell is occupied where the first output of its network is > 0. Its material is 2 where the
/// second output is > 0, and 1 elsewhere. Only the largest face-connected component is kept, whatever the materials in it. An
/// output that is not a number counts as not positive: no cell, or material 1. Precondition: fits(genome, options.plan).
Phenotype decode(const Genome& genome, const DecoderOptions& options);

/// Grows the array of one network of the genome again. The other arrays of `phenotype` stay as they are.
void decode_network(const Genome& genome, std::size_t network, const DecoderOptions& options, Phenotype& phenotype);

/// Returns the body of a level (3^level cells per side): the fractal of the basal body, or the arrangements filled with it.
/// @throws std::invalid_argument for level < 1, or level > 3 of a phenotype with arrangements; for a grid that is too large,
/// whatever meshes::fractal throws
meshes::Polycube aggregate(const Phenotype& phenotype, int level);

/// Returns the number of cells that the body of a level occupies, without building it. Saturates at SIZE_MAX. Throws as aggregate
/// does for a wrong level.
std::size_t aggregate_cell_count(const Phenotype& phenotype, int level);

/// Returns the digits of all arrays, joined by "|". Two phenotypes of one body plan have equal keys exactly if they are equal.
std::string phenotype_key(const Phenotype& phenotype);

/// Returns the phenotype with this key. @throws io::InputError if it is not the key of a phenotype
Phenotype phenotype_from_key(std::string_view key);

/// Returns the SHA-256 of the phenotype's key as 64 hexadecimal digits, which names a design in tables and file names.
std::string phenotype_hash(const Phenotype& phenotype);

}  // namespace menger::evolution
