#include "evolution/genome/cppn.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::evolution {

namespace {

constexpr std::array<std::pair<Activation, std::string_view>, 12> activation_words{
    {{Activation::identity, "identity"},
     {Activation::sigmoid, "sigmoid"},
     {Activation::sine, "sine"},
     {Activation::absolute, "absolute"},
     {Activation::negative_absolute, "negative-absolute"},
     {Activation::square, "square"},
     {Activation::negative_square, "negative-square"},
     {Activation::root, "root"},
     {Activation::negative_root, "negative-root"},
     {Activation::sign, "sign"},
     {Activation::negative_sign, "negative-sign"},
     {Activation::step, "step"}}};

std::string numbered(std::string prefix, std::size_t number) { return prefix.append(std::to_string(number)); }

std::string hidden_name(int label) { return numbered("h", static_cast<std::size_t>(label)); }

std::string node_name(const Cppn& network, std::size_t node) {
  if (network.is_input(node)) return std::string(cppn_inputs[node]);
  if (network.is_output(node)) return numbered("out", node - cppn_input_count);
  return hidden_name(network.nodes[node].hidden_label);
}

std::optional<std::size_t> find_node(const Cppn& network, std::string_view name) {
  for (std::size_t node = 0; node < network.nodes.size(); ++node) {
    if (node_name(network, node) == name) return node;
  }
  return std::nullopt;
}

/// Splits a line at single spaces.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t space = std::min(line.find(' '), line.size());
    words.push_back(line.substr(0, space));
    line.remove_prefix(std::min(space + 1, line.size()));
  }
  return words;
}

template <class Number>
std::optional<Number> number_of(std::string_view word) {
  Number value{};
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Reads one line into a network. Returns what is wrong with the line, or an empty text.
std::string read_outputs(const std::vector<std::string_view>& words, Cppn& network) {
  if (!network.nodes.empty()) return "a second line of outputs";
  if (words.size() < 2) return "no output";
  network = bare_cppn(words.size() - 1, Activation::identity);
  network.edges.clear();
  for (std::size_t index = 0; index < network.output_count; ++index) {
    const auto activation = activation_from_string(words[index + 1]);
    if (!activation) return "unknown activation";
    network.nodes[network.output(index)].activation = *activation;
  }
  return {};
}

std::string read_hidden(const std::vector<std::string_view>& words, Cppn& network) {
  if (words.size() != 3) return "expected a label and an activation";
  const auto label = number_of<int>(words[1]);
  const auto activation = activation_from_string(words[2]);
  if (!label || *label < 0) return "not a label";
  if (!activation) return "unknown activation";
  if (find_node(network, hidden_name(*label))) return "label used twice";
  network.nodes.push_back({*activation, *label});
  return {};
}

std::string read_edge(const std::vector<std::string_view>& words, Cppn& network) {
  if (words.size() != 4) return "expected two nodes and a weight";
  const auto from = find_node(network, words[1]);
  const auto to = find_node(network, words[2]);
  const auto weight = number_of<double>(words[3]);
  if (!from || !to) return "unknown node";
  if (!weight || !std::isfinite(*weight)) return "not a weight";
  if (network.is_output(*from) || network.is_input(*to)) return "an edge out of an output or into an input";
  if (network.find_edge(*from, *to)) return "edge given twice";
  if (network.reaches(*to, *from)) return "edge closes a cycle";
  network.edges.push_back({*from, *to, *weight});
  return {};
}

}  // namespace

std::string_view to_string(Activation activation) { return activation_words[static_cast<std::size_t>(activation)].second; }

std::optional<Activation> activation_from_string(std::string_view word) {
  const auto* const found = std::ranges::find(activation_words, word, &std::pair<Activation, std::string_view>::second);
  if (found == activation_words.end()) return std::nullopt;
  return found->first;
}

std::optional<std::size_t> Cppn::find_edge(std::size_t from, std::size_t to) const {
  const auto found = std::ranges::find_if(edges, [from, to](const CppnEdge& edge) { return edge.from == from && edge.to == to; });
  if (found == edges.end()) return std::nullopt;
  return static_cast<std::size_t>(found - edges.begin());
}

bool Cppn::reaches(std::size_t from, std::size_t to) const {
  std::vector<bool> seen(nodes.size(), false);
  std::vector<std::size_t> pending{from};
  seen[from] = true;
  while (!pending.empty()) {
    const std::size_t node = pending.back();
    pending.pop_back();
    if (node == to) return true;
    for (const CppnEdge& edge : edges) {
      if (edge.from != node || seen[edge.to]) continue;
      seen[edge.to] = true;
      pending.push_back(edge.to);
    }
  }
  return false;
}

void Cppn::erase_hidden(std::size_t node) {
  assert(is_hidden(node) && node < nodes.size());
  std::erase_if(edges, [node](const CppnEdge& edge) { return edge.from == node || edge.to == node; });
  for (CppnEdge& edge : edges) {
    if (edge.from > node) --edge.from;
    if (edge.to > node) --edge.to;
  }
  nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(node));
}

Cppn bare_cppn(std::size_t output_count, Activation output_activation) {
  Cppn network;
  network.output_count = output_count;
  network.nodes.resize(cppn_input_count);
  network.nodes.resize(cppn_input_count + output_count, {output_activation, -1});
  for (std::size_t input = 0; input < cppn_input_count; ++input) {
    for (std::size_t index = 0; index < output_count; ++index) network.edges.push_back({input, network.output(index), 0.0});
  }
  return network;
}

std::string to_text(const Cppn& network) {
  std::string text = "outputs";
  for (std::size_t index = 0; index < network.output_count; ++index) {
    (text += ' ') += to_string(network.nodes[network.output(index)].activation);
  }
  text += '\n';
  for (std::size_t node = network.first_hidden(); node < network.nodes.size(); ++node) {
    const auto& [activation, label] = network.nodes[node];
    ((text += "hidden " + std::to_string(label)) += ' ') += to_string(activation);
    text += '\n';
  }
  for (const auto& [from, to, weight] : network.edges) {
    text += "edge " + node_name(network, from) + ' ' + node_name(network, to) + ' ' + io::number_text(weight) + '\n';
  }
  return text;
}

Cppn cppn_from_text(std::string_view text) {
  Cppn network;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    const auto words = words_of(line);
    std::string fault = "expected outputs, hidden or edge";
    if (!words.empty() && words[0] == "outputs") {
      fault = read_outputs(words, network);
    } else if (network.nodes.empty()) {
      fault = "expected outputs first";
    } else if (!words.empty() && words[0] == "hidden") {
      fault = read_hidden(words, network);
    } else if (!words.empty() && words[0] == "edge") {
      fault = read_edge(words, network);
    }
    if (!fault.empty())
      throw io::InputError("network, line " + std::to_string(number) + ", \"" + std::string(line) + "\": " + fault);
  }
  if (network.nodes.empty()) throw io::InputError("network without a line of outputs");
  return network;
}

}  // namespace menger::evolution
