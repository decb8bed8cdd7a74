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

/// Chooses each of K networks with probability 1/K; if none was chosen, one of them uniformly.
std::vector<std::size_t> choose_networks(std::size_t count, RandomStream& random) {
  std::vector<std::size_t> chosen;
  for (std::size_t network = 0; network < count; ++network) {
    if (random.chance(1.0 / static_cast<double>(count))) chosen.push_back(network);
  }
  if (chosen.empty()) chosen.push_back(random.below(count));
  return chosen;
}

/// Returns whether two phenotypes of a body plan differ in no more cells than a limit.
bool is_near(const Phenotype& child, const Phenotype& parent, std::size_t most_changed_cells) {
  if (most_changed_cells >= largest_array_cells) return true;
  const std::string key = phenotype_key(child);
  return std::transform_reduce(key.begin(), key.end(), phenotype_key(parent).begin(), std::size_t{0}, std::plus<>(),
                               std::not_equal_to<>()) <= most_changed_cells;
}

/// Varies copies of a network of a child until the child is accepted. @returns whether a copy was kept
bool vary_network(Offspring& child, std::size_t network, const OffspringOptions& options, RandomStream& random,
                  const auto& is_accepted) {
  const Cppn original = child.genome.networks[network];
  const Phenotype original_phenotype = child.phenotype;
  for (std::size_t attempt = 0; attempt < options.largest_tries; ++attempt) {
    ++child.tries;
    child.genome.networks[network] = original;
    vary(child.genome.networks[network], options.variation, random);
    decode_network(child.genome, network, options.decoder, child.phenotype);
    if (is_accepted()) return true;
  }
  child.genome.networks[network] = original;
  child.phenotype = original_phenotype;
  return false;
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

Offspring child_of(const Genome& parent, const Phenotype& parent_phenotype, const OffspringOptions& options, RandomStream& random,
                   const std::function<bool(const Phenotype&)>& is_refused) {
  Offspring child{parent, parent_phenotype, 0};
  const auto is_allowed = [&] {
    return is_near(child.phenotype, parent_phenotype, options.most_changed_cells) &&
           is_valid(child.phenotype, options.constraints) && !(is_refused && is_refused(child.phenotype));
  };
  const auto is_another = [&] { return child.phenotype != parent_phenotype && is_allowed(); };
  for (const std::size_t network : choose_networks(parent.networks.size(), random))
    vary_network(child, network, options, random, is_another);

  const auto has_another_body = [&] { return child.phenotype.body != parent_phenotype.body; };
  if (options.mutants_may_keep_body || has_another_body()) return child;
  const bool kept = vary_network(child, body_network, options, random, [&] { return has_another_body() && is_allowed(); });
  return kept ? child : Offspring{parent, parent_phenotype, child.tries};
}

}  // namespace menger::evolution
