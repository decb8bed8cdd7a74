#include "evolution/genome/cppn_variation.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace menger::evolution {

namespace {

constexpr std::array paper_activations{Activation::sine, Activation::absolute, Activation::square, Activation::root,
                                       Activation::step};
constexpr std::array released_activations{Activation::sine,
                                          Activation::absolute,
                                          Activation::negative_absolute,
                                          Activation::square,
                                          Activation::negative_square,
                                          Activation::root,
                                          Activation::negative_root,
                                          Activation::sign,
                                          Activation::negative_sign};

constexpr double link_weight = 0.1;
constexpr double weight_deviation = 0.5;
constexpr int largest_link_attempts = 999;

void set_weight(Cppn& network, std::size_t from, std::size_t to, double weight) {
  if (const auto edge = network.find_edge(from, to)) {
    network.edges[*edge].weight = weight;
  } else {
    network.edges.push_back({from, to, weight});
  }
}

/// Returns the first hidden node that no edge enters (with `enters`) or that no edge leaves (without).
std::optional<std::size_t> find_loose_node(const Cppn& network, bool enters) {
  std::vector<bool> tied(network.nodes.size(), false);
  for (const CppnEdge& edge : network.edges) tied[enters ? edge.to : edge.from] = true;
  for (std::size_t node = network.first_hidden(); node < network.nodes.size(); ++node) {
    if (!tied[node]) return node;
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(ActivationSet set) { return set == ActivationSet::paper ? "paper" : "released-code"; }

std::string_view to_string(OutputFunction function) { return function == OutputFunction::kept ? "kept" : "mutable"; }

std::span<const Activation> activations_of(ActivationSet set) {
  if (set == ActivationSet::paper) return paper_activations;
  return released_activations;
}

void add_node(Cppn& network, const VariationOptions& options, RandomStream& random) {
  if (network.edges.empty()) return;
  const std::size_t position = random.below(network.edges.size());
  const auto activations = activations_of(options.activations);
  const Activation activation = activations[random.below(activations.size())];
  int largest_label = -1;
  for (const CppnNode& node : network.nodes) largest_label = std::max(largest_label, node.hidden_label);

  const CppnEdge split = network.edges[position];
  network.edges.erase(network.edges.begin() + static_cast<std::ptrdiff_t>(position));
  const std::size_t hidden = network.nodes.size();
  network.nodes.push_back({activation, largest_label + 1});
  network.edges.push_back({hidden, split.to, 1.0});
  network.edges.push_back({split.from, hidden, split.weight});
}

void remove_node(Cppn& network, RandomStream& random) {
  if (network.hidden_count() == 0) return;
  const std::size_t hidden = network.first_hidden() + random.below(network.hidden_count());
  const std::vector<CppnEdge> edges = network.edges;
  for (const CppnEdge& in : edges) {
    if (in.to != hidden) continue;
    for (const CppnEdge& out : edges) {
      if (out.from == hidden) set_weight(network, in.from, out.to, in.weight * out.weight);
    }
  }
  network.erase_hidden(hidden);
}

void add_link(Cppn& network, RandomStream& random) {
  const double weight = random.below(2) == 0 ? link_weight : -link_weight;
  for (int attempt = 0; attempt < largest_link_attempts; ++attempt) {
    const std::size_t from = random.below(network.nodes.size());
    const std::size_t to = random.below(network.nodes.size());
    if (from == to || network.is_output(from) || network.is_input(to)) continue;
    // An edge from `to` to `from` would close a cycle and is excluded by that.
    if (network.find_edge(from, to) || network.reaches(to, from)) continue;
    network.edges.push_back({from, to, weight});
    return;
  }
}

void remove_link(Cppn& network, RandomStream& random) {
  if (network.edges.empty()) return;
  network.edges.erase(network.edges.begin() + static_cast<std::ptrdiff_t>(random.below(network.edges.size())));
}

void mutate_function(Cppn& network, const VariationOptions& options, RandomStream& random) {
  std::vector<std::size_t> candidates;
  for (std::size_t node = cppn_input_count; node < network.nodes.size(); ++node) {
    const bool drawn = network.is_hidden(node) || (options.output_function == OutputFunction::mutable_ &&
                                                   network.nodes[node].activation != Activation::identity);
    if (drawn) candidates.push_back(node);
  }
  if (candidates.empty()) return;
  Activation& activation = network.nodes[candidates[random.below(candidates.size())]].activation;
  const auto activations = activations_of(options.activations);
  const Activation old = activation;
  while (activation == old) activation = activations[random.below(activations.size())];
}

void mutate_weight(Cppn& network, RandomStream& random) {
  if (network.edges.empty()) return;
  double& weight = network.edges[random.below(network.edges.size())].weight;
  const double old = weight;
  while (weight == old) weight = std::clamp(random.normal(old, weight_deviation), -1.0, 1.0);
}

void prune(Cppn& network) {
  for (bool stable = false; !stable;) {
    stable = true;
    for (const bool enters : {true, false}) {
      while (const auto node = find_loose_node(network, enters)) {
        network.erase_hidden(*node);
        stable = false;
      }
    }
  }
}

void vary(Cppn& network, const VariationOptions& options, RandomStream& random) {
  switch (random.below(6)) {
    case 0:
      add_node(network, options, random);
      break;
    case 1:
      remove_node(network, random);
      break;
    case 2:
      add_link(network, random);
      break;
    case 3:
      remove_link(network, random);
      break;
    case 4:
      mutate_function(network, options, random);
      break;
    default:
      mutate_weight(network, random);
      break;
  }
  prune(network);
}

Cppn random_cppn(std::size_t output_count, Activation output_activation, const VariationOptions& options, RandomStream& random) {
  Cppn network = bare_cppn(output_count, output_activation);
  for (int repeat = 0; repeat < 10; ++repeat) add_node(network, options, random);
  for (int repeat = 0; repeat < 10; ++repeat) add_link(network, random);
  for (int repeat = 0; repeat < 5; ++repeat) remove_link(network, random);
  for (int repeat = 0; repeat < 100; ++repeat) mutate_function(network, options, random);
  for (int repeat = 0; repeat < 100; ++repeat) mutate_weight(network, random);
  prune(network);
  return network;
}

}  // namespace menger::evolution
