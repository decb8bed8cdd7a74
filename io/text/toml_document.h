#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/range.h"

namespace menger::io {

/// The words for the values of an enumeration in files, in the order in which messages list them.
template <class Value>
using Words = std::vector<std::pair<std::string_view, Value>>;

/// The least and greatest integers that a type can hold.
struct IntegerLimits {
  std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  std::int64_t highest = std::numeric_limits<std::int64_t>::max();
};

/// Returns the integers that both a type and a file (64 bits, signed) can hold.
template <std::integral Integer>
constexpr IntegerLimits limits_of();

/// A table of a TOML file. Callers ask for its keys one by one. Every error is an InputError that names file, line, key and
/// value.
///
/// A copy refers to the same table. finish() reports the keys that were never asked for. Numbers must be finite: nan and inf are
/// refused. An accessor throws InputError if the key is missing, has another type or lies outside its range. Accessors with a
/// fallback and optional ones accept a missing key.
class TomlTable {
 public:
  double number(std::string_view key, const Range& range = any_number()) const;  ///< integers are accepted too
  double number_or(std::string_view key, double fallback, const Range& range = any_number()) const;
  std::optional<double> optional_number(std::string_view key, const Range& range = any_number()) const;

  template <std::integral Integer = int>
  Integer integer(std::string_view key, const Range& range = any_number()) const;
  std::int64_t integer(std::string_view key, const Range& range, const IntegerLimits& limits) const;
  template <std::integral Integer>
  Integer integer_or(std::string_view key, Integer fallback, const Range& range = any_number()) const;

  bool boolean(std::string_view key) const;
  bool boolean_or(std::string_view key, bool fallback) const;

  std::string text(std::string_view key) const;
  std::string text_or(std::string_view key, std::string_view fallback) const;

  /// Returns a path. A relative one counts from the folder of the TOML file. Whether the file exists is not checked.
  std::filesystem::path path(std::string_view key) const;
  std::optional<std::filesystem::path> optional_path(std::string_view key) const;

  std::vector<double> numbers(std::string_view key, const Range& range = any_number()) const;
  std::vector<std::int64_t> integers(std::string_view key, const Range& range, const IntegerLimits& limits) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::vector<std::vector<std::string>> text_rows(std::string_view key) const;  ///< an array of arrays of strings

  /// Returns the value of one of the given words. For any other word the error lists them.
  template <class Value>
  Value word(std::string_view key, const Words<Value>& words) const;
  template <class Value>
  Value word_or(std::string_view key, Value fallback, const Words<Value>& words) const;

  TomlTable table(std::string_view key) const;
  std::optional<TomlTable> optional_table(std::string_view key) const;
  TomlTable table_or_empty(std::string_view key) const;                ///< a table without keys if there is none
  std::vector<TomlTable> tables(std::string_view key) const;           ///< an array of tables, at least one
  std::vector<TomlTable> optional_tables(std::string_view key) const;  ///< an array of tables, none if the key is missing

  /// Records when a key has a meaning. finish() reports it if the key is present and was never asked for.
  /// @param condition the condition under which it has a meaning: `method = "implicit"`
  void belongs_to(std::string_view key, std::string_view condition) const;

  bool has(std::string_view key) const;       ///< does not count as asking for the key
  bool is_text(std::string_view key) const;   ///< whether the value is a string; does not count as asking for the key
  bool is_table(std::string_view key) const;  ///< whether the value is a table; does not count as asking for the key
  bool is_array(std::string_view key) const;  ///< whether the value is an array; does not count as asking for the key
  /// Whether the value is an array of tables; does not count as asking for the key.
  bool is_array_of_tables(std::string_view key) const;
  bool asks_for(std::string_view key) const;  ///< whether the key exists; counts as asking for the key
  const std::filesystem::path& file() const;

  /// Returns the same table as if no key had been asked for. What is asked of it does not count here.
  [[nodiscard]] TomlTable unasked() const;

  /// Returns the error for a value that was read but is not valid: `file:line: table.key = value: reason`.
  /// @param key may lead through tables: "ground.height_m"
  /// @param entry position inside nested arrays, counted from 0 (written from 1)
  [[nodiscard]] InputError error(std::string_view key, std::string_view reason, std::span<const std::size_t> entry = {}) const;

  /// Calls `read`, which reads the file that a key names. If the file is refused, the message begins with the place of the key.
  template <class Read>
  auto reading(std::string_view key, const Read& read) const -> decltype(read()) {
    try {
      return read();
    } catch (const InputError& refusal) {
      throw error(key, refusal.what());
    }
  }

  /// Returns the error for several missing keys of which one is needed: `file:line: table.side or label is missing: ...`.
  [[nodiscard]] InputError missing(std::string_view keys, std::string_view reason) const;

  /// Checks that every key was asked for.
  /// @throws InputError naming every key of this table, and of the tables taken from it, that was never asked for
  void finish() const;

 private:
  friend TomlTable parse_toml(std::string_view text, const std::filesystem::path& file);
  struct Source;
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}

  std::size_t checked_word(std::string_view key, std::span<const std::string_view> words) const;

  std::shared_ptr<Node> node_;
};

/// Reads a TOML file and returns its top table. @throws InputError if it cannot be read or is not TOML
TomlTable read_toml(const std::filesystem::path& file);

/// Reads TOML from a text in memory. `file` is used only for messages and relative paths.
TomlTable parse_toml(std::string_view text, const std::filesystem::path& file);

/// Returns a text as a TOML string with its quotes.
std::string toml_quoted(std::string_view text);

/// Returns a list of words for people: `"direct" | "iterative"`.
std::string list_of_words(std::span<const std::string_view> words);

template <std::integral Integer>
constexpr IntegerLimits limits_of() {
  using Limits = std::numeric_limits<Integer>;
  IntegerLimits limits;
  if (std::in_range<std::int64_t>(Limits::min())) limits.lowest = static_cast<std::int64_t>(Limits::min());
  if (std::in_range<std::int64_t>(Limits::max())) limits.highest = static_cast<std::int64_t>(Limits::max());
  return limits;
}

template <std::integral Integer>
Integer TomlTable::integer(std::string_view key, const Range& range) const {
  return static_cast<Integer>(integer(key, range, limits_of<Integer>()));
}

template <std::integral Integer>
Integer TomlTable::integer_or(std::string_view key, Integer fallback, const Range& range) const {
  if (!asks_for(key)) return fallback;
  return integer<Integer>(key, range);
}

template <class Value>
Value TomlTable::word(std::string_view key, const Words<Value>& words) const {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : words) names.push_back(name);
  return words[checked_word(key, names)].second;
}

template <class Value>
Value TomlTable::word_or(std::string_view key, Value fallback, const Words<Value>& words) const {
  if (!asks_for(key)) return fallback;
  return word(key, words);
}

}  // namespace menger::io
