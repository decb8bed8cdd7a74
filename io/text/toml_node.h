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

/// A parsed file; its tables stay where they are as long as it lives.
struct TomlTable::Source {
  std::filesystem::path file;
  toml::table top;
};

/// The node as a value, array or table of the given type. @throws fault("must be ...") if it is another
template <class Type, class Fault>
const auto& toml_value(const toml::node& node, std::string_view wanted, const Fault& fault) {
  if (const auto* value = node.as<Type>()) return *value;
  throw fault("must be " + std::string(wanted));
}

/// A table in its file and what has been asked of it so far. Names of nodes are keys or entries of arrays: "numbers[2]".
struct TomlTable::Node {
  std::shared_ptr<const Source> source;
  const toml::table* table = nullptr;
  std::string prefix;                                                  ///< path of the table with a dot at the end
  std::set<std::string, std::less<>> asked;                            ///< keys, present or not
  std::map<std::string, std::vector<std::shared_ptr<Node>>> children;  ///< tables taken from it
  std::map<std::string, std::string, std::less<>> conditions{};        ///< under which a key would mean something

  /// The value of a key, nullptr if there is none; counts as asking for the key.
  const toml::node* find(std::string_view key);
  const toml::node& require(std::string_view key, std::string_view wanted);

  /// The start of a message: "file:line: ".
  [[nodiscard]] std::string where(const toml::node& node) const;
  [[nodiscard]] InputError fault(std::string_view name, const toml::node& node, std::string_view reason) const;

  [[nodiscard]] double number(const std::string& name, const toml::node& node, const Range& range) const;
  [[nodiscard]] std::string text(const std::string& name, const toml::node& node) const;

  /// Calls `read(name, element)` for each element of an array.
  template <class Read>
  void each(const std::string& name, const toml::node& node, std::string_view wanted, const Read& read) const {
    const toml::array& array =
        toml_value<toml::array>(node, wanted, [&](const std::string& reason) { return fault(name, node, reason); });
    for (std::size_t i = 0; i < array.size(); ++i) read(name + "[" + std::to_string(i + 1) + "]", array[i]);
  }

  /// The node of a table found in this one; the same one each time, so that what was asked of it adds up.
  std::shared_ptr<Node> child(std::string_view key, const std::string& name, const toml::node& node);

  /// Adds a message for every key that was never asked for, here and in the tables taken from here.
  void collect_unasked(std::vector<std::string>& faults) const;
};

}  // namespace menger::io
