#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace menger::evolution {

/// The function that a node of a network applies to the weighted sum s of its inputs.
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

/// Returns the word for an activation as genomes have it: "sine", "negative-root", ...
std::string_view to_string(Activation activation);
std::optional<Activation> activation_from_string(std::string_view word);

/// The inputs of every network: the coordinates of a cell, its distance from the centre and a bias of 1, in this order.
inline constexpr std::array<std::string_view, 5> cppn_inputs{"x", "y", "z", "d", "b"};
inline constexpr std::size_t cppn_input_count = cppn_inputs.size();

/// An edge: adds weight times the value of node `from` to the sum of node `to`. Nodes are positions in Cppn::nodes.
struct CppnEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  double weight = 0.0;

  bool operator==(const CppnEdge&) const = default;
};

/// A node: an input, an output, or a hidden node with a label.
struct CppnNode {
  Activation activation = Activation::identity;
  int hidden_label = -1;  ///< number of a hidden node, unique in its network; −1 for inputs and outputs

  bool operator==(const CppnNode&) const = default;
};

/// A compositional pattern-producing network: a directed acyclic graph of weighted sums and activations.
///
/// Invariants:
/// - `nodes` has the inputs first, then `output_count` outputs, then the hidden nodes in the order of their insertion.
/// - `edges` are in the order of their insertion. This decides the order of summation and, in one mode of expression, the values.
/// - No edge enters an input or leaves an output.
/// - No two edges join the same pair of nodes.
/// - There is no cycle.
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

  /// Returns the position in `edges` of the edge between two nodes, or none.
  [[nodiscard]] std::optional<std::size_t> find_edge(std::size_t from, std::size_t to) const;

  /// Returns whether there is a path along edges from one node to another. Every node reaches itself.
  [[nodiscard]] bool reaches(std::size_t from, std::size_t to) const;

  /// Deletes a hidden node and its edges, and renumbers the nodes behind it.
  void erase_hidden(std::size_t node);
};

/// Returns a network without hidden nodes in which an edge of weight 0 joins every input to every output.
Cppn bare_cppn(std::size_t output_count, Activation output_activation);

/// Returns the network as lines of text: "outputs sigmoid sigmoid", then "hidden 0 sine" for each hidden node, then "edge x h0
/// -0.25" for each edge. Nodes are called x, y, z, d, b, out0, out1, ..., h0, h1, ... A weight is the shortest decimal number
/// that reads back to the same double.
std::string to_text(const Cppn& network);

/// Reads a network from the text of to_text. @throws io::InputError with the line if the text is not a network that keeps the
/// invariants
Cppn cppn_from_text(std::string_view text);

}  // namespace menger::evolution
