#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/genome/cppn.h"
#include "evolution/genome/cppn_variation.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// What kind of body a genome describes, and by how many networks.
enum class BodyPlan {
  fractal,  ///< one network (shape, material): a basal body that is its own pattern of aggregation
  /// Three networks: a basal body (shape, material), the arrangement of basal bodies, and the arrangement of those arrangements.
  nonfractal,
  /// Two networks: as nonfractal, but without the arrangement of arrangements, for searches at levels 1 and 2.
  nonfractal_two_scales,
  single_actuator  ///< one network (shape): a fractal of material 1 only
};
std::string_view to_string(BodyPlan plan);  ///< "fractal", "nonfractal", "nonfractal-two-scales" or "single-actuator"

/// The outputs of one network of a body plan.
struct NetworkPlan {
  std::size_t output_count = 1;
  Activation output_activation = Activation::sigmoid;  ///< sigmoid, or identity where the plain sum is the output
};

inline constexpr std::size_t body_network = 0;  ///< the place of the network of the basal body among those of every plan

/// Returns the networks of a body plan, that of the basal body first. A single output passes on its plain sum: only its sign
/// counts, and the sigmoid would keep the sign.
std::vector<NetworkPlan> networks_of(BodyPlan plan);

/// The networks that a body is grown from. Their number and outputs follow from a body plan.
struct Genome {
  std::vector<Cppn> networks;

  bool operator==(const Genome&) const = default;
};

/// Returns whether the genome has the number of networks and outputs of the plan.
bool fits(const Genome& genome, BodyPlan plan);

/// Returns a genome of random networks (see random_cppn). Its body need not be valid.
Genome random_genome(BodyPlan plan, const VariationOptions& options, RandomStream& random);

/// Returns the genome as text: a line "network" before the text of each network.
std::string to_text(const Genome& genome);

/// Reads a genome from the text of to_text. @throws io::InputError with the line if the text is not a genome
Genome genome_from_text(std::string_view text);

}  // namespace menger::evolution
