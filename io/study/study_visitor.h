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
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/text/range.h"
#include "io/text/toml_document.h"

namespace menger::io {

/// A key of a study with its documentation.
struct Key {
  std::string_view name;  ///< with its unit at the end: "duration_s"
  std::string_view help;  ///< its meaning, one sentence
  /// A value in TOML. If there is an example, a study must state the key, unless the key is optional.
  std::string_view example{};
  /// Its name in files of earlier versions. It is in the same table, or counts from the top of the file: "/actuation.period_s".
  std::string_view earlier{};
  bool was_reciprocal = false;  ///< whether the earlier key held the reciprocal, such as a period for a frequency
  /// For a table whose name was that of a text in earlier versions: the present key of that text, beside the table:
  /// "design.file".
  std::string_view earlier_text{};
  /// Whether another table, a file or the command line may give the value instead. A schema sees only this table, so it does not
  /// require the key then.
  bool may_be_elsewhere = false;
  /// For a path: a data folder of menger (data_folder), whose files a study may name without path and suffix.
  std::string_view data{};
};

/// How many values a list may hold.
struct Count {
  std::size_t fewest = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// A value of a study as a file holds it. A path counts from the folder of the file.
using StudyValue = std::variant<bool, std::int64_t, double, std::string, std::filesystem::path, std::vector<std::int64_t>,
                                std::vector<double>, std::vector<std::string>, std::vector<std::vector<std::string>>>;

/// The kind of value that a key takes, in the order of the types of StudyValue.
enum class ValueKind { boolean, integer, number, text, path, integers, numbers, texts, text_rows };

/// A key and the values that it accepts.
struct StudyEntry {
  Key key;
  ValueKind kind = ValueKind::number;
  Range range{};  ///< for each number
  /// For each integer, in addition to the range: the limits of the variable that receives it.
  IntegerLimits limits{};
  /// The only texts that are accepted; empty: any text. For an integer: the words that may replace it.
  std::vector<std::string_view> words{};
  Count count{};             ///< for a list
  bool is_optional = false;  ///< whether a study may have no value here
  bool names_keys = false;   ///< whether the texts are names of keys of the same study
  bool is_required() const { return !key.example.empty() && !is_optional; }
};

/// One of several forms in which a study can state the same thing. Its key tells them apart.
struct Alternative {
  std::string_view key;            ///< present in a file if, and only if, the file uses this form
  bool is_chosen = false;          ///< whether the study has this form now
  std::function<void()> choose;    ///< gives the study this form
  std::function<void()> describe;  ///< its keys, `key` among them
  std::string_view earlier{};      ///< name of `key` in files of earlier versions, as in Key
  bool is_for_programs = false;    ///< whether only programs use this form; it is not shown to people
};

/// Goes through a study key by key. Derived classes read a study, write it or document its keys.
///
/// Each type of study has one function `describe(StudyVisitor&, Study&)` that names every key once, with its meaning, its range
/// and the variable that holds its value. Readers (study_reader.h), texts (study_text.h), templates (study_template.h), schemas
/// (study_schema.h) and tables of keys (study_keys.h) are visitors, so none of them can miss a key.
///
/// A `describe` function runs from top to bottom. A reader has stored each value before the next key is visited, so ranges and
/// conditions may depend on earlier values. All values must have their defaults before. The function must not change a valid
/// study.
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
  /// An integer, or no value, which the file states as a word.
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
  /// Names of keys of the same file, with the tables that contain them: "ground.height_m".
  void key_names(const Key& key, std::vector<std::string>& values, const Count& count = {});
  void optional_texts(const Key& key, std::optional<std::vector<std::string>>& values, const Count& count = {});
  /// Files and folders. Relative paths count from the folder of the study file.
  void paths(const Key& key, std::vector<std::filesystem::path>& values, const Count& count = {});
  void text_rows(const Key& key, std::vector<std::vector<std::string>>& rows);
  template <class Value>
  void words(const Key& key, std::vector<Value>& values, const Words<Value>& words, const Count& count = {});

  /// A table. If a file does not have it, its keys have their defaults.
  void table(const Key& key, const std::function<void()>& describe) { visit_table(key, describe); }

  /// A table that a study may leave out. @param describe_value describes its content
  template <class Value, class Describe>
  void optional_table(const Key& key, std::optional<Value>& value, const Describe& describe_value);

  /// An array of tables. @param describe_value describes one of them
  template <class Value, class Describe>
  void tables(const Key& key, std::vector<Value>& values, const Describe& describe_value, const Count& count = {});

  /// Several forms of the same thing, of which a file uses one. A file may use none if the study has one by default, or if
  /// `missing` is empty.
  /// @param missing the message for a file with none of them
  void one_of(const std::vector<Alternative>& alternatives, std::string_view missing = {}) {
    visit_choice(alternatives, missing);
  }

  /// Keys that have a meaning only if a condition holds. @param condition for people: `method = "implicit"`
  void only_if(bool holds, std::string_view condition, const std::function<void()>& describe) {
    visit_branch(holds, condition, describe);
  }

  /// Keys that get their defaults from the value of an earlier key, such as a preset. A template has them as comments: a key that
  /// it stated would hide that value. @param key the earlier key
  void defaults_from(std::string_view key, const std::function<void()>& describe) { visit_defaults(key, describe); }

  /// Checks a condition on values that were read. Only a reader checks it.
  /// @param key the key whose value the message shows; may lead through tables below this one: "ground.height_m"
  /// @param entry position in a list, counted from 0
  /// @throws InputError with file, key and value unless the condition holds
  void check(bool holds, std::string_view key, std::string_view reason, std::initializer_list<std::size_t> entry = {}) const {
    const TomlTable* table = source();
    if (table != nullptr && !holds) throw table->error(key, reason, {entry.begin(), entry.size()});
  }

  /// Returns the table that is being read; nullptr if nothing is read. Use it for work that only a reader does, such as opening a
  /// named file.
  [[nodiscard]] virtual const TomlTable* source() const { return nullptr; }

 protected:
  /// @param value empty if not given; a reader changes it
  virtual void visit(const StudyEntry& entry, std::optional<StudyValue>& value) = 0;
  virtual void visit_table(const Key& key, const std::function<void()>& describe) = 0;
  /// @param has whether there is a table
  /// @param set creates or removes the table
  virtual void visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                                    const std::function<void()>& describe) = 0;
  virtual void visit_tables(const Key& key, const Count& count, std::size_t size, const std::function<void(std::size_t)>& resize,
                            const std::function<void(std::size_t)>& describe) = 0;
  virtual void visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) = 0;
  virtual void visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) = 0;
  virtual void visit_defaults(std::string_view, const std::function<void()>& describe) { describe(); }

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

/// Returns the message for a word that is none of the words of a key.
std::string no_such_word(std::string_view word, const std::vector<std::string_view>& words);

template <class Value>
std::vector<std::string_view> names_of(const Words<Value>& words) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : words) names.push_back(name);
  return names;
}

/// Returns the words of an enumeration, from its to_string.
template <class... Values>
auto words_of(Values... values) {
  Words<std::common_type_t<Values...>> words;
  (words.emplace_back(to_string(values), values), ...);
  return words;
}

/// Returns the word for a value; empty if it has none.
template <class Value>
std::string word_of(const Words<Value>& words, const Value& value) {
  const auto found = std::ranges::find(words, value, [](const auto& pair) { return pair.second; });
  return found == words.end() ? std::string() : std::string(found->first);
}

/// Returns the value of a word. @throws std::invalid_argument if it is none of these words. Readers refuse such a word before; so
/// it is the word of a value for which a description has none.
template <class Value>
Value value_of(const Words<Value>& words, std::string_view word) {
  const auto found = std::ranges::find(words, word, [](const auto& pair) { return pair.first; });
  if (found == words.end()) throw std::invalid_argument(no_such_word(word, names_of(words)));
  return found->second;
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
