#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/text/range.h"
#include "io/text/toml_document.h"

namespace menger::io {

/// A key of a study, as people are told of it.
struct Key {
  std::string_view name;       ///< with its unit at the end: "duration_s"
  std::string_view help;       ///< what it means, one sentence
  std::string_view example{};  ///< a value in TOML. With one, a study must state the key, unless the key is optional
  /// Its name in files of earlier versions: a key of the same table, or from the top of the file: "/actuation.period_s".
  std::string_view earlier{};
  bool was_reciprocal = false;  ///< whether the number stood there as its reciprocal, a period for a frequency
  /// Whether another table, a file or the command line may give the value, so that a schema, which sees this table alone, cannot
  /// ask for it.
  bool may_be_elsewhere = false;
};

/// How many values a list may hold.
struct Count {
  std::size_t fewest = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// A value of a study as a file holds it. A path counts from the folder of the file.
using StudyValue = std::variant<bool, std::int64_t, double, std::string, std::filesystem::path, std::vector<std::int64_t>,
                                std::vector<double>, std::vector<std::string>, std::vector<std::vector<std::string>>>;

/// What may stand in place of a StudyValue, by its place among the types.
enum class ValueKind { boolean, integer, number, text, path, integers, numbers, texts, text_rows };

/// The least and the greatest integer that a type can hold.
struct IntegerLimits {
  std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  std::int64_t highest = std::numeric_limits<std::int64_t>::max();
};

/// A key with a value, and which values it takes.
struct StudyEntry {
  Key key;
  ValueKind kind = ValueKind::number;
  Range range{};                          ///< of each number
  IntegerLimits limits{};                 ///< of each integer, beside the range: those of the variable that takes it
  std::vector<std::string_view> words{};  ///< the only texts; empty: any. Beside a number: what may stand in its place
  Count count{};                          ///< of a list
  bool is_optional = false;               ///< a study may have no value here
  bool is_required() const { return !key.example.empty() && !is_optional; }
};

/// One of several ways to say the same, told apart by a key.
struct Alternative {
  std::string_view key;            ///< is in a file if, and only if, this is the way
  bool is_chosen = false;          ///< whether the study is one of these
  std::function<void()> choose;    ///< makes it one
  std::function<void()> describe;  ///< its keys, `key` among them
  std::string_view earlier{};      ///< name of `key` in files of earlier versions, as in Key
  bool is_for_programs = false;    ///< whether only programs say it in this way, so that people are not told of it
};

/// What goes through a study key by key: it reads or writes the study, or tells people about it.
///
/// Each type of study has one function `describe(StudyVisitor&, Study&)` that names every key once, with its meaning, its range
/// and where its value lies. Readers (study_reader.h), texts (study_text.h), templates (study_template.h), schemas
/// (study_schema.h) and tables of keys (study_keys.h) are visitors, so that none of them can forget a key.
///
/// A function that describes is run from top to bottom, and a value that a reader has read is there for what follows: ranges and
/// conditions may depend on it. Values have their defaults before. It must leave a valid study as it is.
class StudyVisitor {
 public:
  StudyVisitor() = default;
  StudyVisitor(const StudyVisitor&) = delete;
  StudyVisitor& operator=(const StudyVisitor&) = delete;
  virtual ~StudyVisitor() = default;

  void boolean(const Key& key, bool& value);
  template <std::integral Integer>
  void integer(const Key& key, Integer& value, const Range& range = any_number());
  template <std::integral Integer>
  void optional_integer(const Key& key, std::optional<Integer>& value, const Range& range = any_number());
  /// An integer, or nothing, for which the file has a word.
  template <std::integral Integer>
  void integer_or_word(const Key& key, std::optional<Integer>& value, std::string_view word, const Range& range = any_number());
  void number(const Key& key, double& value, const Range& range = any_number());
  void optional_number(const Key& key, std::optional<double>& value, const Range& range = any_number());
  void text(const Key& key, std::string& value);
  void optional_text(const Key& key, std::optional<std::string>& value);
  void path(const Key& key, std::filesystem::path& value);
  void optional_path(const Key& key, std::optional<std::filesystem::path>& value);
  template <class Value>
  void word(const Key& key, Value& value, const Words<Value>& words);
  template <class Value>
  void optional_word(const Key& key, std::optional<Value>& value, const Words<Value>& words);

  void numbers(const Key& key, std::vector<double>& values, const Range& range = any_number(), const Count& count = {});
  void optional_numbers(const Key& key, std::optional<std::vector<double>>& values, const Range& range = any_number(),
                        const Count& count = {});
  template <std::size_t size>
  void numbers(const Key& key, std::array<double, size>& values, const Range& range = any_number());
  template <std::integral Integer>
  void integers(const Key& key, std::vector<Integer>& values, const Range& range = any_number(), const Count& count = {});
  void texts(const Key& key, std::vector<std::string>& values, const Count& count = {});
  void optional_texts(const Key& key, std::optional<std::vector<std::string>>& values, const Count& count = {});
  /// Files and folders; relative ones count from the folder of the file.
  void paths(const Key& key, std::vector<std::filesystem::path>& values, const Count& count = {});
  void text_rows(const Key& key, std::vector<std::vector<std::string>>& rows);
  template <class Value>
  void words(const Key& key, std::vector<Value>& values, const Words<Value>& words, const Count& count = {});

  /// A table; its keys have their defaults in a file that has none.
  void table(const Key& key, const std::function<void()>& describe) { visit_table(key, describe); }

  /// A table that a study may have or not. @param describe_value describes a value
  template <class Value, class Describe>
  void optional_table(const Key& key, std::optional<Value>& value, const Describe& describe_value);

  /// An array of tables. @param describe_value describes one of them
  template <class Value, class Describe>
  void tables(const Key& key, std::vector<Value>& values, const Describe& describe_value, const Count& count = {});

  /// Several ways to say the same, of which a file has one; or none, if one is chosen at the start.
  /// @param missing what to tell people of a file with none where there must be one
  void one_of(const std::vector<Alternative>& alternatives, std::string_view missing = {}) {
    visit_choice(alternatives, missing);
  }

  /// Keys that mean something only if a condition holds. @param condition for people: `method = "implicit"`
  void only_if(bool holds, std::string_view condition, const std::function<void()>& describe) {
    visit_branch(holds, condition, describe);
  }

  /// Demands something of what was read. @param key whose value is shown; with the tables below this one, "ground.height_m"
  /// @param entry of a list, from 0
  /// @throws InputError, of a reader, with file, key and value, unless it holds
  void check(bool holds, std::string_view key, std::string_view reason, std::initializer_list<std::size_t> entry = {}) const {
    const TomlTable* table = source();
    if (table != nullptr && !holds) throw table->error(key, reason, {entry.begin(), entry.size()});
  }

  /// The table that is being read; nullptr if nothing is read. For what only a reader does, like opening a file that was named.
  [[nodiscard]] virtual const TomlTable* source() const { return nullptr; }

 protected:
  /// @param value nothing: not given. A reader changes it.
  virtual void visit(const StudyEntry& entry, std::optional<StudyValue>& value) = 0;
  virtual void visit_table(const Key& key, const std::function<void()>& describe) = 0;
  /// @param has whether there is one @param set makes one or takes it away
  virtual void visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                                    const std::function<void()>& describe) = 0;
  virtual void visit_tables(const Key& key, const Count& count, std::size_t size, const std::function<void(std::size_t)>& resize,
                            const std::function<void(std::size_t)>& describe) = 0;
  virtual void visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) = 0;
  virtual void visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) = 0;

 private:
  template <class Value>
  Value visited(const StudyEntry& entry, Value value) {
    std::optional<StudyValue> stored(std::move(value));
    visit(entry, stored);
    return std::get<Value>(std::move(*stored));
  }
  template <class Value>
  std::optional<Value> visited(const StudyEntry& entry, std::optional<Value> value) {
    std::optional<StudyValue> stored;
    if (value) stored.emplace(std::move(*value));
    visit(entry, stored);
    if (!stored) return std::nullopt;
    return std::get<Value>(std::move(*stored));
  }
};

/// What a type of integers can hold; of 64 bits, what a file can.
template <std::integral Integer>
IntegerLimits limits_of() {
  using Limits = std::numeric_limits<Integer>;
  const std::int64_t lowest = std::in_range<std::int64_t>(Limits::min()) ? static_cast<std::int64_t>(Limits::min())
                                                                         : std::numeric_limits<std::int64_t>::min();
  const std::int64_t highest = std::in_range<std::int64_t>(Limits::max()) ? static_cast<std::int64_t>(Limits::max())
                                                                          : std::numeric_limits<std::int64_t>::max();
  return {lowest, highest};
}

template <class Value>
std::vector<std::string_view> names_of(const Words<Value>& words) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : words) names.push_back(name);
  return names;
}

/// The word of a value; empty if it has none.
template <class Value>
std::string word_of(const Words<Value>& words, const Value& value) {
  const auto found = std::ranges::find(words, value, [](const auto& pair) { return pair.second; });
  return found == words.end() ? std::string() : std::string(found->first);
}

template <class Value>
Value value_of(const Words<Value>& words, std::string_view word) {
  return std::ranges::find(words, word, [](const auto& pair) { return pair.first; })->second;
}

template <std::integral Integer>
void StudyVisitor::integer(const Key& key, Integer& value, const Range& range) {
  const StudyEntry entry{.key = key, .kind = ValueKind::integer, .range = range, .limits = limits_of<Integer>()};
  value = static_cast<Integer>(visited(entry, static_cast<std::int64_t>(value)));
}

template <std::integral Integer>
void StudyVisitor::optional_integer(const Key& key, std::optional<Integer>& value, const Range& range) {
  const StudyEntry entry{
      .key = key, .kind = ValueKind::integer, .range = range, .limits = limits_of<Integer>(), .is_optional = true};
  std::optional<std::int64_t> wide;
  if (value) wide = static_cast<std::int64_t>(*value);
  wide = visited(entry, wide);
  value.reset();
  if (wide) value = static_cast<Integer>(*wide);
}

template <std::integral Integer>
void StudyVisitor::integer_or_word(const Key& key, std::optional<Integer>& value, std::string_view word, const Range& range) {
  const StudyEntry entry{.key = key, .kind = ValueKind::integer, .range = range, .limits = limits_of<Integer>(), .words = {word}};
  std::optional<StudyValue> stored;
  if (value)
    stored = static_cast<std::int64_t>(*value);
  else
    stored = std::string(word);
  visit(entry, stored);
  const auto* integer = std::get_if<std::int64_t>(&*stored);
  value.reset();
  if (integer != nullptr) value = static_cast<Integer>(*integer);
}

template <class Value>
void StudyVisitor::word(const Key& key, Value& value, const Words<Value>& words) {
  const StudyEntry entry{.key = key, .kind = ValueKind::text, .words = names_of(words)};
  value = value_of(words, visited(entry, word_of(words, value)));
}

template <class Value>
void StudyVisitor::optional_word(const Key& key, std::optional<Value>& value, const Words<Value>& words) {
  const StudyEntry entry{.key = key, .kind = ValueKind::text, .words = names_of(words), .is_optional = true};
  std::optional<std::string> word;
  if (value) word = word_of(words, *value);
  word = visited(entry, word);
  value.reset();
  if (word) value = value_of(words, *word);
}

template <std::size_t size>
void StudyVisitor::numbers(const Key& key, std::array<double, size>& values, const Range& range) {
  std::vector<double> list(values.begin(), values.end());
  numbers(key, list, range, {.fewest = size, .most = size});
  std::copy(list.begin(), list.end(), values.begin());
}

template <std::integral Integer>
void StudyVisitor::integers(const Key& key, std::vector<Integer>& values, const Range& range, const Count& count) {
  const StudyEntry entry{.key = key, .kind = ValueKind::integers, .range = range, .limits = limits_of<Integer>(), .count = count};
  const std::vector<std::int64_t> read = visited(entry, std::vector<std::int64_t>(values.begin(), values.end()));
  values.clear();
  for (const std::int64_t value : read) values.push_back(static_cast<Integer>(value));
}

template <class Value>
void StudyVisitor::words(const Key& key, std::vector<Value>& values, const Words<Value>& words, const Count& count) {
  const StudyEntry entry{.key = key, .kind = ValueKind::texts, .words = names_of(words), .count = count};
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const Value& value : values) names.push_back(word_of(words, value));
  names = visited(entry, names);
  values.clear();
  for (const std::string& name : names) values.push_back(value_of(words, name));
}

template <class Value, class Describe>
void StudyVisitor::optional_table(const Key& key, std::optional<Value>& value, const Describe& describe_value) {
  const auto set = [&](bool has) {
    if (!has) value.reset();
    if (has && !value) value.emplace();
  };
  visit_optional_table(key, value.has_value(), set, [&] { describe_value(*value); });
}

template <class Value, class Describe>
void StudyVisitor::tables(const Key& key, std::vector<Value>& values, const Describe& describe_value, const Count& count) {
  visit_tables(
      key, count, values.size(), [&](std::size_t size) { values.resize(size); },
      [&](std::size_t n) { describe_value(values[n]); });
}

}  // namespace menger::io
