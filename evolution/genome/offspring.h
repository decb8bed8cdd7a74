#pragma once

#include <cstddef>
#include <functional>

#include "evolution/genome/constraints.h"
#include "evolution/genome/cppn_variation.h"
#include "evolution/genome/decoder.h"
#include "evolution/genome/genome.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// Everything that decides how new genomes are made.
struct OffspringOptions {
  VariationOptions variation;
  DecoderOptions decoder;
  ConstraintOptions constraints;
  std::size_t largest_tries = 1500;                      ///< most variations tried per network of a child
  std::size_t largest_draws = 1'000'000;                 ///< most genomes drawn for one random individual
  std::size_t most_changed_cells = largest_array_cells;  ///< most cells of all arrays in which a child may differ
  bool mutants_may_keep_body = true;                     ///< whether a child may differ in its arrangements alone

  bool operator==(const OffspringOptions&) const = default;
};

/// A new genome, its phenotype, and how many draws or variations it took.
struct Offspring {
  Genome genome;
  Phenotype phenotype;
  std::size_t tries = 0;
};

/// Makes a random individual: draws genomes until one is valid.
/// @throws io::InputError if none of largest_draws genomes was valid: the constraints of the study cannot be met. The message has
/// the number of refused genomes for each reason
Offspring random_offspring(const OffspringOptions& options, RandomStream& random);

/// Makes a child of a genome.
///
/// Each of the K networks is chosen with probability 1/K; if none is chosen, one is drawn uniformly. Each chosen network is
/// varied in turn: up to largest_tries times, one uniformly drawn operator is applied to a copy of it. The copy is kept as soon
/// as the child's phenotype is valid and differs from the parent's, in most_changed_cells at most. If no copy is kept, the
/// network stays as it is, so the child may equal its parent.
///
/// With `is_refused`, a copy is kept only if that is false for the child's phenotype, as it is then: before the next network
/// varies.
///
/// Unless mutants_may_keep_body, a child that has the body of its parent is then given another one in the same way, by variations
/// of that network, and equals its parent if no copy is kept. So arrangements vary as often as they do else. Precondition:
/// parent_phenotype is the phenotype of the parent.
Offspring child_of(const Genome& parent, const Phenotype& parent_phenotype, const OffspringOptions& options, RandomStream& random,
                   const std::function<bool(const Phenotype&)>& is_refused = {});

}  // namespace menger::evolution
