#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/toml_document.h"

namespace menger::io {

/// A parsed file. Its tables keep their addresses as long as it exists.
struct TomlTable::Source {
  std::filesystem::path file;
  toml::table top;
};

/// Returns the node as a value, array or table of the given type. @throws fault("must be ...") if it has another type
template <class Type, class Fault>
const auto& toml_value(const toml::node& node, std::string_view wanted, const Fault& fault) {
  if (const auto* value = node.as<Type>()) return *value;
  throw fault("must be " + std::string(wanted));
}

/// A table in its file, and the keys that were asked for so far. The name of a node is a key or an entry of an array:
/// "numbers[2]".
struct TomlTable::Node {
  std::shared_ptr<const Source> source;
  const toml::table* table = nullptr;
  std::string prefix;                                                  ///< path of the table with a dot at the end
  std::set<std::string, std::less<>> asked;                            ///< keys that were asked for, present or not
  std::map<std::string, std::vector<std::shared_ptr<Node>>> children;  ///< tables taken from it
  std::map<std::string, std::string, std::less<>> conditions{};  ///< for each key: the condition under which it has a meaning

  /// Returns the value of a key; nullptr if there is none. Counts as asking for the key.
  const toml::node* find(std::string_view key);
  const toml::node& require(std::string_view key, std::string_view wanted);

  /// ", is it meant by KEY?" with a key of the table that nobody has asked for and that is nearly the one that is missing.
  [[nodiscard]] std::string meant_by(std::string_view key) const;

  /// Returns the start of a message: "file:line: ".
  [[nodiscard]] std::string where(const toml::node& node) const;
  [[nodiscard]] InputError fault(std::string_view name, const toml::node& node, std::string_view reason) const;

  [[nodiscard]] double number(const std::string& name, const toml::node& node, const Range& range) const;
  [[nodiscard]] std::int64_t integer(const std::string& name, const toml::node& node, const Range& range,
                                     const IntegerLimits& limits) const;
  [[nodiscard]] std::string text(const std::string& name, const toml::node& node) const;

  /// Calls `read(name, element)` for each element of an array.
  template <class Read>
  void each(const std::string& name, const toml::node& node, std::string_view wanted, const Read& read) const {
    const toml::array& array =
        toml_value<toml::array>(node, wanted, [&](const std::string& reason) { return fault(name, node, reason); });
    for (std::size_t i = 0; i < array.size(); ++i) read(name + "[" + std::to_string(i + 1) + "]", array[i]);
  }

  /// Returns the node of a table in this one. It is the same node each time, so that all keys that were asked for are recorded
  /// together.
  std::shared_ptr<Node> child(std::string_view key, const std::string& name, const toml::node& node);

  /// Full names ("element.degree") by key. Entries of an array of tables have one name.
  using Names = std::map<std::string, std::set<std::string>, std::less<>>;

  /// Adds the names of all keys that were asked for, here and in the tables taken from here.
  void collect_asked(Names& names) const;

  /// Adds a message for every key that was never asked for, here and in the tables taken from here.
  /// It suggests the key of this name that another table has, if there is one such table, or else one of nearly this name here.
  /// @param everywhere the keys of the whole file, see collect_asked
  void collect_unasked(const Names& everywhere, std::vector<std::string>& faults) const;
};

}  // namespace menger::io
