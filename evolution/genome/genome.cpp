#include "evolution/genome/genome.h"

#include <algorithm>

#include "io/text/input_error.h"

namespace menger::evolution {

namespace {

constexpr std::string_view network_header = "network\n";

}  // namespace

std::string_view to_string(BodyPlan plan) {
  switch (plan) {
    case BodyPlan::fractal:
      return "fractal";
    case BodyPlan::nonfractal:
      return "nonfractal";
    case BodyPlan::nonfractal_two_scales:
      return "nonfractal-two-scales";
    case BodyPlan::single_actuator:
      return "single-actuator";
  }
  return {};
}

std::vector<NetworkPlan> networks_of(BodyPlan plan) {
  switch (plan) {
    case BodyPlan::fractal:
      return {{2, Activation::sigmoid}};
    case BodyPlan::nonfractal:
      return {{2, Activation::sigmoid}, {1, Activation::identity}, {1, Activation::identity}};
    case BodyPlan::nonfractal_two_scales:
      return {{2, Activation::sigmoid}, {1, Activation::identity}};
    case BodyPlan::single_actuator:
      return {{1, Activation::identity}};
  }
  return {};
}

bool fits(const Genome& genome, BodyPlan plan) {
  return std::ranges::equal(
      genome.networks, networks_of(plan), [](std::size_t has, std::size_t wanted) { return has == wanted; }, &Cppn::output_count,
      &NetworkPlan::output_count);
}

Genome random_genome(BodyPlan plan, const VariationOptions& options, RandomStream& random) {
  Genome genome;
  for (const auto& [output_count, output_activation] : networks_of(plan)) {
    genome.networks.push_back(random_cppn(output_count, output_activation, options, random));
  }
  return genome;
}

std::string to_text(const Genome& genome) {
  std::string text;
  for (const Cppn& network : genome.networks) (text += network_header) += to_text(network);
  return text;
}

Genome genome_from_text(std::string_view text) {
  if (!text.starts_with(network_header)) throw io::InputError("a genome must start with the line \"network\"");
  Genome genome;
  while (!text.empty()) {
    text.remove_prefix(network_header.size());
    // The header counts at the start of a line only.
    std::size_t length = text.starts_with(network_header) ? 0 : text.find("\nnetwork\n");
    length = length == std::string_view::npos ? text.size() : length + (length > 0 ? 1 : 0);
    genome.networks.push_back(cppn_from_text(text.substr(0, length)));
    text.remove_prefix(length);
  }
  return genome;
}

}  // namespace menger::evolution
