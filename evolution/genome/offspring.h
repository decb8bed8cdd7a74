#pragma once

#include <cstddef>

#include "evolution/genome/constraints.h"
#include "evolution/genome/cppn_variation.h"
#include "evolution/genome/decoder.h"
#include "evolution/genome/genome.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

struct OffspringOptions {
  VariationOptions variation;
  DecoderOptions decoder;
  ConstraintOptions constraints;
  std::size_t largest_tries = 1500;       ///< variations tried per network of a child
  std::size_t largest_draws = 1'000'000;  ///< genomes drawn for one random individual

  bool operator==(const OffspringOptions&) const = default;
};

/// A genome, what it grows into, and how many draws or variations it took.
struct Offspring {
  Genome genome;
  Phenotype phenotype;
  std::size_t tries = 0;
};

/// A new-born individual: genomes are drawn until one is valid.
/// @throws io::InputError if largest_draws genomes were drawn in vain: the constraints of the study cannot be met; the message
/// says how many were refused for which reason
Offspring random_offspring(const OffspringOptions& options, RandomStream& random);

/// A child. Each of the K networks is chosen with probability 1/K, one drawn uniformly if none was. Each chosen one is varied in
/// turn: up to largest_tries times one uniformly drawn operator is applied to a copy of it, which is kept as soon as the child's
/// phenotype differs from the parent's and is valid; otherwise the network stays as it is, so the child may equal its parent.
/// Precondition: parent_phenotype is what the parent decodes to.
Offspring child_of(const Genome& parent, const Phenotype& parent_phenotype, const OffspringOptions& options,
                   RandomStream& random);

}  // namespace menger::evolution
