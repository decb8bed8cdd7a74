#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/genome/cppn.h"
#include "evolution/genome/cppn_variation.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// What a genome describes.
enum class BodyPlan {
  fractal,     ///< one network (shape, material): a basal body that is its own pattern of aggregation
  nonfractal,  ///< three networks: a basal body (shape, material), the arrangement of basal bodies, and the arrangement of those
               ///< arrangements
  single_actuator  ///< one network (shape): a fractal of material 1 only
};
std::string_view to_string(BodyPlan plan);  ///< "fractal", "nonfractal" or "single-actuator"

/// What one network of a body plan looks like.
struct NetworkPlan {
  std::size_t output_count = 1;
  Activation output_activation = Activation::sigmoid;  ///< sigmoid, or identity where the plain sum is the output
};

/// The networks of a body plan, the basal body's first. Single outputs hand on their plain sum: only its sign counts, which the
/// sigmoid keeps.
std::vector<NetworkPlan> networks_of(BodyPlan plan);

/// The networks that a body is grown from; their number and outputs follow from a body plan.
struct Genome {
  std::vector<Cppn> networks;

  bool operator==(const Genome&) const = default;
};

/// Whether the genome has the networks of the plan, by number and outputs.
bool fits(const Genome& genome, BodyPlan plan);

/// A genome of new-born networks; its body need not be valid.
Genome random_genome(BodyPlan plan, const VariationOptions& options, RandomStream& random);

/// The genome as text: a line "network" before the text of each network.
std::string to_text(const Genome& genome);

/// The inverse of to_text. @throws io::InputError naming the line if the text is no genome
Genome genome_from_text(std::string_view text);

}  // namespace menger::evolution
