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

/// Makes a child step by step.
class Variation {
 public:
  Variation(const Genome& parent, const Phenotype& parent_phenotype, const OffspringOptions& options)
      : parent_(parent), parent_phenotype_(parent_phenotype), options_(options), child_{parent, parent_phenotype, 0} {}

  [[nodiscard]] const Offspring& child() const { return child_; }

  [[nodiscard]] bool has_another_body() const { return child_.phenotype.body != parent_phenotype_.body; }

  /// Varies copies of a network until the child differs, or has another body, and is valid. @returns whether a copy was kept
  bool vary_network(std::size_t network, bool must_have_another_body, RandomStream& random) {
    const Cppn original = child_.genome.networks[network];
    const Phenotype original_phenotype = child_.phenotype;
    for (std::size_t attempt = 0; attempt < options_.largest_tries; ++attempt) {
      ++child_.tries;
      child_.genome.networks[network] = original;
      vary(child_.genome.networks[network], options_.variation, random);
      decode_network(child_.genome, network, options_.decoder, child_.phenotype);
      if ((has_another_body() || (!must_have_another_body && child_.phenotype != parent_phenotype_)) && is_near() &&
          is_valid(child_.phenotype, options_.constraints))
        return true;
    }
    child_.genome.networks[network] = original;
    child_.phenotype = original_phenotype;
    return false;
  }

  /// Makes the child equal to its parent again.
  void give_up() {
    child_.genome = parent_;
    child_.phenotype = parent_phenotype_;
  }

 private:
  /// Whether the child differs in no more cells than it may.
  [[nodiscard]] bool is_near() const {
    if (options_.most_changed_cells >= largest_array_cells) return true;
    const std::string key = phenotype_key(child_.phenotype);
    return std::transform_reduce(key.begin(), key.end(), parent_key_.begin(), std::size_t{0}, std::plus<>(),
                                 std::not_equal_to<>()) <= options_.most_changed_cells;
  }

  const Genome& parent_;
  const Phenotype& parent_phenotype_;
  const OffspringOptions& options_;
  const std::string parent_key_ = phenotype_key(parent_phenotype_);
  Offspring child_;
};

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
  Variation variation(parent, parent_phenotype, options);
  for (const std::size_t network : choose_networks(parent.networks.size(), random))
    variation.vary_network(network, false, random);
  if (!options.mutants_may_keep_body && !variation.has_another_body() && !variation.vary_network(body_network, true, random))
    variation.give_up();
  return variation.child();
}

}  // namespace menger::evolution
