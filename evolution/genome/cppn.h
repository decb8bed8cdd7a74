#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace menger::evolution {

/// What a node of a network does to the weighted sum s of its inputs.
enum class Activation : std::uint8_t {
  identity,           ///< s
  sigmoid,            ///< 2 / (1 + exp(−s)) − 1
  sine,               ///< sin s
  absolute,           ///< |s|
  negative_absolute,  ///< −|s|
  square,             ///< s²
  negative_square,    ///< −s²
  root,               ///< √|s|
  negative_root,      ///< −√|s|
  sign,               ///< −1, 0 or 1
  negative_sign,      ///< 1, 0 or −1
  step                ///< 1 for s > 0, otherwise 0
};

/// The word for an activation, as written in genomes: "sine", "negative-root", ...
std::string_view to_string(Activation activation);
std::optional<Activation> activation_from_string(std::string_view word);

/// The inputs of every network: the coordinates of a cell, its distance from the centre and a bias of 1, in this order.
inline constexpr std::array<std::string_view, 5> cppn_inputs{"x", "y", "z", "d", "b"};
inline constexpr std::size_t cppn_input_count = cppn_inputs.size();

/// An edge carries weight times the value of node `from` to node `to`; nodes are positions in Cppn::nodes.
struct CppnEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  double weight = 0.0;

  bool operator==(const CppnEdge&) const = default;
};

/// A node: an input, an output, or a hidden node with its label.
struct CppnNode {
  Activation activation = Activation::identity;
  int hidden_label = -1;  ///< number of a hidden node, unique in its network; −1 for inputs and outputs

  bool operator==(const CppnNode&) const = default;
};

/// A compositional pattern-producing network: a directed acyclic graph of weighted sums and activations.
///
/// Invariants: the inputs come first in `nodes`, then `output_count` outputs, then the hidden nodes in the order of their
/// insertion; edges stand in the order of their insertion (which decides the order of summation and, in one mode of expression,
/// the values); no edge enters an input or leaves an output; no two edges join the same pair; no cycle.
struct Cppn {
  std::size_t output_count = 0;
  std::vector<CppnNode> nodes;
  std::vector<CppnEdge> edges;

  bool operator==(const Cppn&) const = default;

  [[nodiscard]] std::size_t output(std::size_t index) const { return cppn_input_count + index; }
  [[nodiscard]] std::size_t first_hidden() const { return cppn_input_count + output_count; }
  [[nodiscard]] std::size_t hidden_count() const { return nodes.size() - first_hidden(); }
  [[nodiscard]] bool is_input(std::size_t node) const { return node < cppn_input_count; }
  [[nodiscard]] bool is_output(std::size_t node) const { return node >= cppn_input_count && node < first_hidden(); }
  [[nodiscard]] bool is_hidden(std::size_t node) const { return node >= first_hidden(); }

  /// Position in `edges` of the edge between two nodes, or none.
  [[nodiscard]] std::optional<std::size_t> find_edge(std::size_t from, std::size_t to) const;

  /// Whether there is a path along edges from one node to another; every node reaches itself.
  [[nodiscard]] bool reaches(std::size_t from, std::size_t to) const;

  /// Deletes a hidden node with its edges and renumbers the nodes behind it.
  void erase_hidden(std::size_t node);
};

/// Every input joined to every output by an edge of weight 0, no hidden node.
Cppn bare_cppn(std::size_t output_count, Activation output_activation);

/// The network as lines of text: "outputs sigmoid sigmoid", "hidden 0 sine" per hidden node, "edge x h0 -0.25" per edge; nodes
/// are called x, y, z, d, b, out0, out1, ..., h0, h1, ...; weights are the shortest decimal that reads back to the same double.
std::string to_text(const Cppn& network);

/// The inverse of to_text. @throws io::InputError naming the line if the text is not a network that keeps the invariants
Cppn cppn_from_text(std::string_view text);

}  // namespace menger::evolution
