#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "evolution/genome/cppn_expression.h"
#include "evolution/genome/genome.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

struct DecoderOptions {
  BodyPlan plan = BodyPlan::fractal;
  ExpressionOptions expression;

  bool operator==(const DecoderOptions&) const = default;
};

/// What a genome looks like: the arrays of 3 x 3 x 3 cells that decide every aggregate.
struct Phenotype {
  meshes::Polycube body;  ///< the basal body, face-connected

  /// Non-fractal plan only: which cells of the level-2 grid hold a basal body, and which of the level-3 grid hold a level-2
  /// aggregate; face-connected, of material 1. Grids without cells (0 x 0 x 0) for the fractal plans.
  meshes::Polycube arrangement;
  meshes::Polycube arrangement_of_arrangements;

  bool operator==(const Phenotype&) const = default;

  /// Whether the arrangements are given by arrays of their own.
  [[nodiscard]] bool has_arrangements() const { return arrangement.nx() > 0; }
};

/// Largest level of a body plan with arrangements; fractal plans have no largest level.
inline constexpr int largest_arranged_level = 3;

/// Grows the phenotype: a cell is occupied where its network's first output is > 0, of material 2 where the second one is > 0 and
/// 1 elsewhere; of these the largest face-connected component (of the presence, whatever the materials) is kept. Not-a-number
/// compares false: no cell, or material 1. Precondition: fits(genome, options.plan).
Phenotype decode(const Genome& genome, const DecoderOptions& options);

/// Grows only the array of one network of the genome anew; the others of `phenotype` stay.
void decode_network(const Genome& genome, std::size_t network, const DecoderOptions& options, Phenotype& phenotype);

/// The body of a level (3^level cells per side): the fractal of the basal body, or the arrangements filled with it.
/// @throws std::invalid_argument for level < 1, or level > 3 of a phenotype with arrangements; what meshes::fractal throws for
/// too large a grid
meshes::Polycube aggregate(const Phenotype& phenotype, int level);

/// Cells that the body of a level occupies, without building it; saturates at SIZE_MAX. Throws as aggregate does for a wrong
/// level.
std::size_t aggregate_cell_count(const Phenotype& phenotype, int level);

/// Equal for two phenotypes of one body plan exactly when they are equal: the digits of all arrays, joined by "|".
std::string phenotype_key(const Phenotype& phenotype);

/// The phenotype that has this key. @throws io::InputError if it is not the key of one
Phenotype phenotype_from_key(std::string_view key);

/// SHA-256 of the phenotype's key as 64 hexadecimal digits: the name of a design in tables and file names.
std::string phenotype_hash(const Phenotype& phenotype);

}  // namespace menger::evolution
