#include "evolution/genome/offspring.h"

#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/text/input_error.h"

namespace menger::evolution {

namespace {

constexpr std::size_t body_network = 0;

/// Chooses each of K networks with probability 1/K; if none was chosen, one of them uniformly. Where the body must vary, chooses
/// again until its network is among them.
std::vector<std::size_t> choose_networks(std::size_t count, bool body_must_vary, RandomStream& random) {
  std::vector<std::size_t> chosen;
  do {
    chosen.clear();
    for (std::size_t network = 0; network < count; ++network) {
      if (random.chance(1.0 / static_cast<double>(count))) chosen.push_back(network);
    }
    if (chosen.empty()) chosen.push_back(random.below(count));
  } while (body_must_vary && chosen.front() != body_network);
  return chosen;
}

/// Returns in how many cells of all arrays two phenotypes of a body plan differ.
std::size_t changed_cells(const Phenotype& child, const Phenotype& parent) {
  const std::string child_key = phenotype_key(child);
  const std::string parent_key = phenotype_key(parent);
  return std::transform_reduce(child_key.begin(), child_key.end(), parent_key.begin(), std::size_t{0}, std::plus<>(),
                               std::not_equal_to<>());
}

/// Returns how many bodies were refused for each reason, as in "too small: 12, weak contact: 3".
std::string refusals_text(const std::map<Refusal, std::size_t>& refusals) {
  std::string text;
  for (const auto& [reason, count] : refusals)
    text.append(text.empty() ? "" : ", ").append(to_string(reason)).append(": ").append(std::to_string(count));
  return text;
}

}  // namespace

Offspring random_offspring(const OffspringOptions& options, RandomStream& random) {
  std::map<Refusal, std::size_t> refusals;
  bool has_arrangements = false;
  for (std::size_t draws = 1; draws <= options.largest_draws; ++draws) {
    Genome genome = random_genome(options.decoder.plan, options.variation, random);
    Phenotype phenotype = decode(genome, options.decoder);
    has_arrangements = phenotype.has_arrangements();
    const std::optional<Refusal> reason = refusal(phenotype, options.constraints);
    if (!reason) return {std::move(genome), std::move(phenotype), draws};
    ++refusals[*reason];
  }
  const std::string smallest =
      has_arrangements ? "smallest_arranged_body_cells = " + std::to_string(options.constraints.smallest_arranged_body)
                       : "smallest_body_cells = " + std::to_string(options.constraints.smallest_body);
  throw io::InputError("the constraints of the study cannot be met: none of " + std::to_string(options.largest_draws) +
                       " random bodies was valid (" + refusals_text(refusals) + "; " + smallest +
                       ", largest_body_cells = " + std::to_string(options.constraints.largest_body) + ", disconnected = \"" +
                       std::string(to_string(options.constraints.disconnected)) +
                       "\", castable = " + (options.constraints.castable ? "true" : "false") + ")");
}

Offspring child_of(const Genome& parent, const Phenotype& parent_phenotype, const OffspringOptions& options,
                   RandomStream& random) {
  Offspring child{parent, parent_phenotype, 0};
  const bool body_must_vary = !options.mutants_may_keep_body;
  for (const std::size_t network : choose_networks(parent.networks.size(), body_must_vary, random)) {
    const Cppn original = child.genome.networks[network];
    const Phenotype original_phenotype = child.phenotype;
    bool accepted = false;
    for (std::size_t attempt = 0; attempt < options.largest_tries && !accepted; ++attempt) {
      ++child.tries;
      child.genome.networks[network] = original;
      vary(child.genome.networks[network], options.variation, random);
      decode_network(child.genome, network, options.decoder, child.phenotype);
      const std::size_t changed = changed_cells(child.phenotype, parent_phenotype);
      accepted = changed > 0 && changed <= options.most_changed_cells && is_valid(child.phenotype, options.constraints);
    }
    if (accepted) continue;
    child.genome.networks[network] = original;
    child.phenotype = original_phenotype;
    if (body_must_vary && network == body_network) break;
  }
  return child;
}

}  // namespace menger::evolution
