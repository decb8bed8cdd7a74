#include "io/text/toml_node.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>

#include "io/text/near_miss.h"
#include "io/text/number_text.h"

namespace menger::io {

namespace {

/// Returns a number in the fewest digits that read back as the same, and so that it is seen to be no integer.
std::string float_text(double value) {
  const std::string text = number_text(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

/// Returns a key as a file may hold it: with quotes unless it consists of letters, digits, "_" and "-".
std::string key_text(std::string_view key) {
  const auto is_plain = [](char sign) {
    return std::isalnum(static_cast<unsigned char>(sign)) != 0 || sign == '_' || sign == '-';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), is_plain) ? std::string(key) : toml_quoted(key);
}

std::string value_text(const toml::node& node);

/// "[0, 2500]"; "[...]" for what is long or holds tables.
std::string array_text(const toml::array& array) {
  constexpr std::size_t longest = 60;
  constexpr const char* left_out = "[...]";
  std::string text = "[";
  for (const toml::node& value : array) {
    if (value.is_table()) return left_out;
    text += (text.size() > 1 ? ", " : "") + value_text(value);
    if (text.size() > longest) return left_out;
  }
  return text + "]";
}

std::string value_text(const toml::node& node) {
  if (node.is_table()) return "{...}";
  if (const auto* array = node.as_array()) return array_text(*array);
  if (const auto* string = node.as_string()) return toml_quoted(string->get());
  if (const auto* number = node.as_floating_point()) return float_text(number->get());
  std::ostringstream text;
  text << toml::node_view<const toml::node>(node);
  return text.str();
}

/// Returns the unit of a key in words: people write "12mm". @param name may end with a position: "pressure_Pa[2]"
std::string unit_note(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> units{
      {{"_m", " (metres)"}, {"_Pa", " (pascals)"}, {"_s", " (seconds)"}, {"_Hz", " (hertz)"}}};
  const std::string_view key = name.substr(0, name.find('['));
  if (key.find("_per_") != std::string_view::npos) return "";
  for (const auto& [ending, note] : units) {
    if (key.ends_with(ending)) return std::string(note);
  }
  return "";
}

}  // namespace

const toml::node* TomlTable::Node::find(std::string_view key) {
  asked.emplace(key);
  return table->get(key);
}

const toml::node& TomlTable::Node::require(std::string_view key, std::string_view wanted) {
  if (const toml::node* node = find(key)) return *node;
  throw InputError(where(*table) + prefix + std::string(key) + " is missing" + meant_by(key) + ": " + std::string(wanted) +
                   " is needed");
}

std::string TomlTable::Node::meant_by(std::string_view key) const {
  for (const auto& [other, node] : *table) {
    if (!asked.contains(other.str()) && near_miss(other.str(), std::vector{std::string(key)}))
      return ", is it meant by " + key_text(other.str()) + "?";
  }
  return "";
}

std::string TomlTable::Node::where(const toml::node& node) const {
  const auto line = node.source().begin.line;
  std::string place = source->file.string();
  if (line > 0) place.append(":").append(std::to_string(line));
  return place + ": ";
}

InputError TomlTable::Node::fault(std::string_view name, const toml::node& node, std::string_view reason) const {
  return InputError{where(node) + prefix + std::string(name) + " = " + value_text(node) + ": " + std::string(reason)};
}

double TomlTable::Node::number(const std::string& name, const toml::node& node, const Range& range) const {
  if (!node.is_number()) throw fault(name, node, "must be a number" + unit_note(name));
  const toml::value<double>* floating = node.as_floating_point();
  const double value = floating != nullptr ? floating->get() : static_cast<double>(node.as_integer()->get());
  if (!std::isfinite(value)) throw fault(name, node, "must be a finite number");
  if (!range.contains(value)) throw fault(name, node, range.demand());
  return value;
}

std::int64_t TomlTable::Node::integer(const std::string& name, const toml::node& node, const Range& range,
                                      const IntegerLimits& limits) const {
  const auto refuse = [&](const std::string& reason) { return fault(name, node, reason); };
  const std::int64_t value = toml_value<std::int64_t>(node, "an integer", refuse).get();
  if (!range.contains(static_cast<double>(value))) throw refuse(range.demand());
  if (value < limits.lowest) throw refuse("must be at least " + std::to_string(limits.lowest));
  if (value > limits.highest) throw refuse("must be at most " + std::to_string(limits.highest));
  return value;
}

std::string TomlTable::Node::text(const std::string& name, const toml::node& node) const {
  return toml_value<std::string>(node, "a text in quotes", [&](const std::string& reason) { return fault(name, node, reason); })
      .get();
}

std::shared_ptr<TomlTable::Node> TomlTable::Node::child(std::string_view key, const std::string& name, const toml::node& node) {
  const toml::table& found =
      toml_value<toml::table>(node, "a table", [&](const std::string& reason) { return fault(name, node, reason); });
  auto& known = children[std::string(key)];
  const auto same = std::find_if(known.begin(), known.end(), [&](const auto& candidate) { return candidate->table == &found; });
  if (same != known.end()) return *same;
  Node made{.source = source, .table = &found, .prefix = prefix + name + ".", .asked = {}, .children = {}};
  return known.emplace_back(std::make_shared<Node>(std::move(made)));
}

void TomlTable::Node::collect_asked(Names& names) const {
  std::string place = prefix;
  for (std::size_t open = place.find('['); open != std::string::npos; open = place.find('['))
    place.erase(open, place.find(']', open) + 1 - open);
  for (const std::string& key : asked) names[key].insert(place + key);
  for (const auto& [key, nodes] : children) {
    for (const auto& node : nodes) node->collect_asked(names);
  }
}

void TomlTable::Node::collect_unasked(const Names& everywhere, std::vector<std::string>& faults) const {
  const std::vector<std::string> known(asked.begin(), asked.end());
  for (const auto& [unasked, node] : *table) {
    const std::string_view key = unasked.str();
    if (asked.contains(key)) continue;
    if (const auto elsewhere = conditions.find(key); elsewhere != conditions.end()) {
      faults.emplace_back(fault(key, node, "belongs to " + elsewhere->second).what());
      continue;
    }
    std::string message = where(node) + prefix + key_text(key) + ": unknown key";
    const auto elsewhere_named = everywhere.find(key);
    const bool is_elsewhere = !node.is_table() && elsewhere_named != everywhere.end() && elsewhere_named->second.size() == 1;
    if (is_elsewhere)
      message += ", did you mean " + *elsewhere_named->second.begin() + "?";
    else if (const auto nearest = near_miss(key, known))
      message += ", did you mean " + *nearest + "?";
    faults.push_back(std::move(message));
  }
  for (const auto& [key, nodes] : children) {
    for (const auto& node : nodes) node->collect_unasked(everywhere, faults);
  }
}

}  // namespace menger::io
