#include "io/text/toml_document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <new>
#include <sstream>
#include <utility>

#include "io/text/toml_checks.h"
#include "io/text/toml_node.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

/// What people mean by something that is not TOML.
std::string hint_on(std::string_view problem) {
  const auto has = [&](std::string_view part) { return problem.find(part) != std::string_view::npos; };
  if (has("leading zeroes")) return "; a row of digits stands in quotes, as in \"010\", and a number has no zero before it";
  if (has("could not determine value type")) return "; text stands in quotes";
  if (has("saw ','")) return "; decimals have a point, as in 0.012, and several values stand in brackets";
  return "";
}

}  // namespace

TomlTable read_toml(const std::filesystem::path& file) { return parse_toml(read_whole(file), file); }

TomlTable parse_toml(std::string_view text, const std::filesystem::path& file) {
  require_shallow_toml(text, file);
  try {
    auto source = std::make_shared<TomlTable::Source>(TomlTable::Source{file, toml::parse(text, file.string())});
    TomlTable::Node node{.source = source, .table = &source->top, .prefix = {}, .asked = {}, .children = {}};
    return TomlTable(std::make_shared<TomlTable::Node>(std::move(node)));
  } catch (const toml::parse_error& error) {
    throw InputError(file.string() + ":" + std::to_string(error.source().begin.line) +
                     ": not TOML: " + std::string(error.description()) + hint_on(error.description()));
  } catch (const std::bad_alloc&) {
    throw InputError(file.string() + ": does not fit into memory");
  }
}

std::string toml_quoted(std::string_view text) {
  std::ostringstream quoted;
  quoted << toml::toml_formatter(toml::value<std::string>(text), toml::format_flags::none);
  return quoted.str();
}

std::string list_of_words(std::span<const std::string_view> words) {
  std::string list;
  for (const std::string_view word : words) list.append(list.empty() ? "" : " | ").append(toml_quoted(word));
  return list;
}

double TomlTable::number(std::string_view key, const Range& range) const {
  return node_->number(std::string(key), node_->require(key, "a number"), range);
}

double TomlTable::number_or(std::string_view key, double fallback, const Range& range) const {
  return optional_number(key, range).value_or(fallback);
}

std::optional<double> TomlTable::optional_number(std::string_view key, const Range& range) const {
  if (!asks_for(key)) return std::nullopt;
  return number(key, range);
}

std::int64_t TomlTable::integer(std::string_view key, const Range& range, const IntegerLimits& limits) const {
  return node_->integer(std::string(key), node_->require(key, "an integer"), range, limits);
}

std::vector<std::int64_t> TomlTable::integers(std::string_view key, const Range& range, const IntegerLimits& limits) const {
  constexpr std::string_view wanted = "an array of integers";
  std::vector<std::int64_t> values;
  node_->each(std::string(key), node_->require(key, wanted), wanted, [&](const std::string& name, const toml::node& element) {
    values.push_back(node_->integer(name, element, range, limits));
  });
  return values;
}

bool TomlTable::boolean(std::string_view key) const {
  const toml::node& node = node_->require(key, "true or false");
  return toml_value<bool>(node, "true or false", [&](const std::string& reason) { return node_->fault(key, node, reason); })
      .get();
}

bool TomlTable::boolean_or(std::string_view key, bool fallback) const { return asks_for(key) ? boolean(key) : fallback; }

std::string TomlTable::text(std::string_view key) const {
  return node_->text(std::string(key), node_->require(key, "a text in quotes"));
}

std::string TomlTable::text_or(std::string_view key, std::string_view fallback) const {
  return asks_for(key) ? text(key) : std::string(fallback);
}

std::filesystem::path TomlTable::path(std::string_view key) const {
  const std::string name = text(key);
  if (name.empty()) throw error(key, "must name a file");
  return (file().parent_path() / name).lexically_normal();  // an absolute name replaces the folder
}

std::optional<std::filesystem::path> TomlTable::optional_path(std::string_view key) const {
  if (!asks_for(key)) return std::nullopt;
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
  const std::string list = list_of_words(words);
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
  if (!asks_for(key)) return std::nullopt;
  return table(key);
}

TomlTable TomlTable::table_or_empty(std::string_view key) const {
  static const toml::table none;
  return asks_for(key) ? table(key) : TomlTable(node_->child(key, std::string(key), none));
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

bool TomlTable::asks_for(std::string_view key) const { return node_->find(key) != nullptr; }

void TomlTable::belongs_to(std::string_view key, std::string_view condition) const {
  std::string& known = node_->conditions[std::string(key)];
  known.append(known.empty() ? "" : " or ").append(condition);
}

bool TomlTable::has(std::string_view key) const { return node_->table->contains(key); }

bool TomlTable::is_table(std::string_view key) const {
  const toml::node* node = node_->table->get(key);
  return node != nullptr && node->is_table();
}

bool TomlTable::is_array_of_tables(std::string_view key) const {
  const toml::node* node = node_->table->get(key);
  return node != nullptr && node->is_array_of_tables();
}

bool TomlTable::is_array(std::string_view key) const {
  const toml::node* node = node_->table->get(key);
  return node != nullptr && node->is_array();
}

bool TomlTable::is_text(std::string_view key) const {
  const toml::node* node = node_->table->get(key);
  return node != nullptr && node->is_string();
}

const std::filesystem::path& TomlTable::file() const { return node_->source->file; }

TomlTable TomlTable::unasked() const {
  Node node{.source = node_->source, .table = node_->table, .prefix = node_->prefix, .asked = {}, .children = {}};
  return TomlTable(std::make_shared<Node>(std::move(node)));
}

InputError TomlTable::error(std::string_view key, std::string_view reason, std::span<const std::size_t> entry) const {
  if (const auto dot = key.find('.'); dot != std::string_view::npos && !has(key)) {
    const toml::node* inner = node_->table->get(key.substr(0, dot));
    if (inner != nullptr && inner->is_table()) return table(key.substr(0, dot)).error(key.substr(dot + 1), reason, entry);
  }
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

InputError TomlTable::missing(std::string_view keys, std::string_view reason) const {
  return InputError(node_->where(*node_->table) + node_->prefix + std::string(keys) + " is missing: " + std::string(reason));
}

void TomlTable::finish() const {
  std::vector<std::string> faults;
  Node::Names everywhere;
  node_->collect_asked(everywhere);
  node_->collect_unasked(everywhere, faults);
  if (faults.empty()) return;
  std::string message;
  for (const std::string& fault : faults) message.append(message.empty() ? "" : "\n").append(fault);
  throw InputError(message);
}

}  // namespace menger::io
