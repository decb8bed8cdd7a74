#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "evolution/genome/cppn.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// Which activations variation draws from.
enum class ActivationSet {
  paper,         ///< sin, abs, square, sqrt(abs), step
  released_code  ///< sin, ±abs, ±square, ±sqrt(abs), ±sign
};
std::string_view to_string(ActivationSet set);  ///< "paper" or "released-code"

/// What variation may do to the sigmoid of an output.
enum class OutputFunction {
  kept,  ///< outputs stay in [−1, 1] for ever
  /// an output is a node like others: once mutated, its sigmoid never returns
  mutable_  // NOLINT(readability-identifier-naming): the plain word is a keyword
};
std::string_view to_string(OutputFunction function);  ///< "kept" or "mutable"

struct VariationOptions {
  ActivationSet activations = ActivationSet::paper;
  OutputFunction output_function = OutputFunction::kept;

  bool operator==(const VariationOptions&) const = default;
};

/// The activations of a set, in the order in which they are numbered for drawing.
std::span<const Activation> activations_of(ActivationSet set);

/// Splits a uniformly drawn edge (u, v, w): it is replaced by (h, v, 1) and (u, h, w) with a new hidden node h of a uniformly
/// drawn activation. Nothing happens without an edge.
void add_node(Cppn& network, const VariationOptions& options, RandomStream& random);

/// Deletes a uniformly drawn hidden node h; every pair of edges (u, h, a), (h, v, c) leaves an edge (u, v, a c), in the place of
/// one that was there. Nothing happens without a hidden node.
void remove_node(Cppn& network, RandomStream& random);

/// Joins a uniformly drawn ordered pair of nodes that are not joined in either direction by an edge of weight +0.1 or −0.1 that
/// closes no cycle. Pairs are drawn at most 999 times; nothing happens if none of them will do.
void add_link(Cppn& network, RandomStream& random);

/// Deletes a uniformly drawn edge, if there is one.
void remove_link(Cppn& network, RandomStream& random);

/// Gives a uniformly drawn node a uniformly drawn different activation of the set. Drawn are hidden nodes and, if the output
/// function is mutable, outputs that have a function (outputs that hand on their sum stay so). Nothing happens if there is no
/// such node.
void mutate_function(Cppn& network, const VariationOptions& options, RandomStream& random);

/// Draws a new weight for a uniformly drawn edge: normal around the old one with standard deviation 0.5, clipped to [−1, 1],
/// redrawn until it differs. Nothing happens without an edge.
void mutate_weight(Cppn& network, RandomStream& random);

/// Deletes hidden nodes that nothing enters, then those that nothing leaves, until every hidden node has both.
void prune(Cppn& network);

/// One of the six operators, drawn uniformly, followed by prune.
void vary(Cppn& network, const VariationOptions& options, RandomStream& random);

/// The birth of a network: bare_cppn, then 10 times add_node, 10 times add_link, 5 times remove_link, 100 times mutate_function,
/// 100 times mutate_weight, prune.
/// @param output_activation sigmoid, or identity for an output that hands on its sum
Cppn random_cppn(std::size_t output_count, Activation output_activation, const VariationOptions& options, RandomStream& random);

}  // namespace menger::evolution
