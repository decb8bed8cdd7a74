#include "io/toml_document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "io/whole_file.h"

namespace menger::io {

namespace {

struct Source {
  std::filesystem::path file;
  toml::table top;
};

std::string value_text(const toml::node& node) {
  if (node.is_table()) return "{...}";
  if (node.is_array()) return "[...]";
  if (const auto* string = node.as_string()) return toml_quoted(string->get());
  std::ostringstream text;
  text << toml::node_view<const toml::node>(node);
  return text.str();
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// The node as a value, array or table of the given type; throws fault("must be ...") otherwise.
template <class Type, class Fault>
const auto& expect(const toml::node& node, std::string_view wanted, const Fault& fault) {
  if (const auto* value = node.as<Type>()) return *value;
  throw fault("must be " + std::string(wanted));
}

}  // namespace

/// A table in its document and what has been asked of it so far.
struct TomlTable::Node {
  std::shared_ptr<const Source> source;
  const toml::table* table = nullptr;
  std::string prefix;                                                  // path of the table with a dot at the end
  std::set<std::string, std::less<>> asked;                            // keys, present or not
  std::map<std::string, std::vector<std::shared_ptr<Node>>> children;  // tables taken from it

  const toml::node* find(std::string_view key) {
    asked.emplace(key);
    return table->get(key);
  }

  const toml::node& require(std::string_view key, std::string_view wanted) {
    if (const toml::node* node = find(key)) return *node;
    throw InputError(where(*table) + prefix + std::string(key) + " is missing: " + std::string(wanted) + " is needed");
  }

  [[nodiscard]] std::string where(const toml::node& node) const {
    const auto line = node.source().begin.line;
    std::string place = source->file.string();
    if (line > 0) place.append(":").append(std::to_string(line));
    return place + ": ";
  }

  [[nodiscard]] InputError fault(std::string_view name, const toml::node& node, std::string_view reason) const {
    return InputError{where(node) + prefix + std::string(name) + " = " + value_text(node) + ": " + std::string(reason)};
  }

  [[nodiscard]] double number(const std::string& name, const toml::node& node, const Range& range) const {
    if (!node.is_number()) throw fault(name, node, "must be a number");
    const double value = node.value<double>().value_or(static_cast<double>(node.value_or(std::int64_t{0})));
    if (!std::isfinite(value)) throw fault(name, node, "must be a finite number");
    if (!range.contains(value)) throw fault(name, node, range.demand());
    return value;
  }

  [[nodiscard]] std::string text(const std::string& name, const toml::node& node) const {
    return expect<std::string>(node, "a string", [&](const std::string& reason) { return fault(name, node, reason); }).get();
  }

  /// Calls `read(name, element)` for each element of an array.
  template <class Read>
  void each(const std::string& name, const toml::node& node, std::string_view wanted, const Read& read) const {
    const toml::array& array =
        expect<toml::array>(node, wanted, [&](const std::string& reason) { return fault(name, node, reason); });
    for (std::size_t i = 0; i < array.size(); ++i) read(name + "[" + std::to_string(i + 1) + "]", array[i]);
  }

  /// The node of a table found in this one; the same one each time, so that what was asked of it adds up.
  std::shared_ptr<Node> child(std::string_view key, const std::string& name, const toml::node& node) {
    const toml::table& found =
        expect<toml::table>(node, "a table", [&](const std::string& reason) { return fault(name, node, reason); });
    auto& known = children[std::string(key)];
    const auto same = std::find_if(known.begin(), known.end(), [&](const auto& candidate) { return candidate->table == &found; });
    if (same != known.end()) return *same;
    Node made{.source = source, .table = &found, .prefix = prefix + name + ".", .asked = {}, .children = {}};
    return known.emplace_back(std::make_shared<Node>(std::move(made)));
  }

  void collect_unasked(std::vector<std::string>& faults) const {
    for (const auto& [unasked, node] : *table) {
      const std::string_view key = unasked.str();
      if (asked.contains(key)) continue;
      std::string fault = where(node) + prefix + std::string(key) + ": unknown key";
      const auto nearest = std::min_element(asked.begin(), asked.end(), [&](const std::string& a, const std::string& b) {
        return edit_distance(a, key) < edit_distance(b, key);
      });
      const std::size_t near_miss = std::min<std::size_t>(3, 1 + key.size() / 5);
      if (nearest != asked.end() && edit_distance(*nearest, key) <= near_miss) fault += ", did you mean " + *nearest + "?";
      faults.push_back(std::move(fault));
    }
    for (const auto& [key, nodes] : children) {
      for (const auto& node : nodes) node->collect_unasked(faults);
    }
  }
};

TomlTable read_toml(const std::filesystem::path& file) { return parse_toml(read_whole(file), file); }

TomlTable parse_toml(std::string_view text, const std::filesystem::path& file) {
  try {
    auto source = std::make_shared<Source>(Source{file, toml::parse(text, file.string())});
    TomlTable::Node node{.source = source, .table = &source->top, .prefix = {}, .asked = {}, .children = {}};
    return TomlTable(std::make_shared<TomlTable::Node>(std::move(node)));
  } catch (const toml::parse_error& error) {
    throw InputError(file.string() + ":" + std::to_string(error.source().begin.line) +
                     ": not TOML: " + std::string(error.description()));
  }
}

std::string toml_quoted(std::string_view text) {
  std::ostringstream quoted;
  quoted << toml::toml_formatter(toml::value<std::string>(text), toml::format_flags::none);
  return quoted.str();
}

double TomlTable::number(std::string_view key, const Range& range) const {
  return node_->number(std::string(key), node_->require(key, "a number"), range);
}

double TomlTable::number_or(std::string_view key, double fallback, const Range& range) const {
  return optional_number(key, range).value_or(fallback);
}

std::optional<double> TomlTable::optional_number(std::string_view key, const Range& range) const {
  if (node_->find(key) == nullptr) return std::nullopt;
  return number(key, range);
}

std::int64_t TomlTable::checked_integer(std::string_view key, const Range& range, std::int64_t lowest,
                                        std::int64_t highest) const {
  const toml::node& node = node_->require(key, "an integer");
  const auto fault = [&](const std::string& reason) { return node_->fault(key, node, reason); };
  const std::int64_t value = expect<std::int64_t>(node, "an integer", fault).get();
  if (!range.contains(static_cast<double>(value))) throw fault(range.demand());
  if (value < lowest) throw fault("must be at least " + std::to_string(lowest));
  if (value > highest) throw fault("must be at most " + std::to_string(highest));
  return value;
}

bool TomlTable::boolean(std::string_view key) const {
  const toml::node& node = node_->require(key, "true or false");
  return expect<bool>(node, "true or false", [&](const std::string& reason) { return node_->fault(key, node, reason); }).get();
}

bool TomlTable::boolean_or(std::string_view key, bool fallback) const {
  return node_->find(key) == nullptr ? fallback : boolean(key);
}

std::string TomlTable::text(std::string_view key) const { return node_->text(std::string(key), node_->require(key, "a string")); }

std::string TomlTable::text_or(std::string_view key, std::string_view fallback) const {
  return node_->find(key) == nullptr ? std::string(fallback) : text(key);
}

std::filesystem::path TomlTable::path(std::string_view key) const {
  const std::string name = text(key);
  if (name.empty()) throw error(key, "must name a file");
  return (file().parent_path() / name).lexically_normal();  // an absolute name replaces the folder
}

std::optional<std::filesystem::path> TomlTable::optional_path(std::string_view key) const {
  if (node_->find(key) == nullptr) return std::nullopt;
  return path(key);
}

std::vector<double> TomlTable::numbers(std::string_view key, const Range& range) const {
  constexpr std::string_view wanted = "an array of numbers";
  std::vector<double> values;
  node_->each(std::string(key), node_->require(key, wanted), wanted,
              [&](const std::string& name, const toml::node& element) { values.push_back(node_->number(name, element, range)); });
  return values;
}

std::vector<std::string> TomlTable::texts(std::string_view key) const {
  constexpr std::string_view wanted = "an array of strings";
  std::vector<std::string> values;
  node_->each(std::string(key), node_->require(key, wanted), wanted,
              [&](const std::string& name, const toml::node& element) { values.push_back(node_->text(name, element)); });
  return values;
}

std::vector<std::vector<std::string>> TomlTable::text_rows(std::string_view key) const {
  constexpr std::string_view wanted = "an array of arrays of strings";
  std::vector<std::vector<std::string>> rows;
  node_->each(std::string(key), node_->require(key, wanted), wanted, [&](const std::string& name, const toml::node& row) {
    auto& values = rows.emplace_back();
    node_->each(name, row, "an array of strings",
                [&](const std::string& entry, const toml::node& element) { values.push_back(node_->text(entry, element)); });
  });
  return rows;
}

std::size_t TomlTable::checked_word(std::string_view key, std::span<const std::string_view> words) const {
  std::string list;
  for (const std::string_view word : words) list.append(list.empty() ? "" : " | ").append(toml_quoted(word));
  const toml::node& node = node_->require(key, list);
  const auto* text = node.as<std::string>();
  const auto found = text == nullptr ? words.end() : std::find(words.begin(), words.end(), text->get());
  if (found == words.end()) throw node_->fault(key, node, "must be " + list);
  return static_cast<std::size_t>(found - words.begin());
}

TomlTable TomlTable::table(std::string_view key) const {
  return TomlTable(node_->child(key, std::string(key), node_->require(key, "a table")));
}

std::optional<TomlTable> TomlTable::optional_table(std::string_view key) const {
  if (node_->find(key) == nullptr) return std::nullopt;
  return table(key);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  constexpr std::string_view wanted = "an array of tables";
  std::vector<TomlTable> all;
  node_->each(std::string(key), node_->require(key, wanted), wanted, [&](const std::string& name, const toml::node& element) {
    all.push_back(TomlTable(node_->child(key, name, element)));
  });
  if (all.empty()) throw error(key, "needs at least one table");
  return all;
}

std::vector<TomlTable> TomlTable::optional_tables(std::string_view key) const {
  const toml::node* node = node_->find(key);
  if (node == nullptr || (node->is_array() && node->as_array()->empty())) return {};
  return tables(key);
}

bool TomlTable::has(std::string_view key) const { return node_->table->contains(key); }

const std::filesystem::path& TomlTable::file() const { return node_->source->file; }

InputError TomlTable::error(std::string_view key, std::string_view reason, std::span<const std::size_t> entry) const {
  const toml::node* node = node_->table->get(key);
  std::string name(key);
  if (node == nullptr) return InputError{node_->where(*node_->table) + node_->prefix + name + ": " + std::string(reason)};
  for (const std::size_t index : entry) {
    const toml::array* array = node->as_array();
    if (array == nullptr || index >= array->size()) break;
    node = array->get(index);
    name.append("[").append(std::to_string(index + 1)).append("]");
  }
  return node_->fault(name, *node, reason);
}

void TomlTable::finish() const {
  std::vector<std::string> faults;
  node_->collect_unasked(faults);
  if (faults.empty()) return;
  std::string message;
  for (const std::string& fault : faults) message.append(message.empty() ? "" : "\n").append(fault);
  throw InputError(message);
}

}  // namespace menger::io
