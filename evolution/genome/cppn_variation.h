#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "evolution/genome/cppn.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// The set of activations from which variation draws.
enum class ActivationSet {
  paper,         ///< sin, abs, square, sqrt(abs), step
  released_code  ///< sin, ±abs, ±square, ±sqrt(abs), ±sign
};
std::string_view to_string(ActivationSet set);  ///< "paper" or "released-code"

/// Whether variation may replace the sigmoid of an output.
enum class OutputFunction {
  kept,  ///< never: outputs stay in [−1, 1]
  /// An output varies like any other node; once mutated, it never gets its sigmoid back.
  mutable_  // NOLINT(readability-identifier-naming): the plain word is a keyword
};
std::string_view to_string(OutputFunction function);  ///< "kept" or "mutable"

/// How networks vary.
struct VariationOptions {
  ActivationSet activations = ActivationSet::paper;
  OutputFunction output_function = OutputFunction::kept;

  bool operator==(const VariationOptions&) const = default;
};

/// Returns the activations of a set, in the order of their numbers when they are drawn.
std::span<const Activation> activations_of(ActivationSet set);

/// Splits a uniformly drawn edge (u, v, w): replaces it by (h, v, 1) and (u, h, w), with a new hidden node h of a uniformly drawn
/// activation. Does nothing if there is no edge.
void add_node(Cppn& network, const VariationOptions& options, RandomStream& random);

/// Deletes a uniformly drawn hidden node h. Every pair of edges (u, h, a), (h, v, c) becomes an edge (u, v, a c), which replaces
/// an edge from u to v if there is one. Does nothing if there is no hidden node.
void remove_node(Cppn& network, RandomStream& random);

/// Joins a uniformly drawn ordered pair of nodes by an edge of weight +0.1 or −0.1. The nodes must not be joined yet in either
/// direction, and the edge must not close a cycle. Draws at most 999 pairs; does nothing if none of them is suitable.
void add_link(Cppn& network, RandomStream& random);

/// Deletes a uniformly drawn edge, if there is one.
void remove_link(Cppn& network, RandomStream& random);

/// Gives a uniformly drawn node a different, uniformly drawn activation of the set. The node is a hidden node or, if the output
/// function is mutable, an output; outputs that pass on their plain sum (identity) stay as they are. Does nothing if there is no
/// such node.
void mutate_function(Cppn& network, const VariationOptions& options, RandomStream& random);

/// Draws a new weight for a uniformly drawn edge: normally distributed around the old weight with standard deviation 0.5, clipped
/// to [−1, 1], drawn again until it differs. Does nothing if there is no edge.
void mutate_weight(Cppn& network, RandomStream& random);

/// Deletes hidden nodes without an edge that enters, then those without an edge that leaves, until every hidden node has both.
void prune(Cppn& network);

/// Applies one of the six operators above, drawn uniformly, and then prune.
void vary(Cppn& network, const VariationOptions& options, RandomStream& random);

/// Returns a random network: bare_cppn, then 10 times add_node, 10 times add_link, 5 times remove_link, 100 times
/// mutate_function, 100 times mutate_weight, prune.
/// @param output_activation sigmoid, or identity for an output that passes on its plain sum
Cppn random_cppn(std::size_t output_count, Activation output_activation, const VariationOptions& options, RandomStream& random);

}  // namespace menger::evolution
