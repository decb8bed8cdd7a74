#include "io/study/study_reader.h"

#include <array>
#include <utility>

#include "io/study/installed_folders.h"
#include "io/study/magnitude.h"

namespace menger::io {
namespace {

std::string number_word(std::size_t count) {
  constexpr std::array<std::string_view, 4> words{"no", "one", "two", "three"};
  return count < words.size() ? std::string(words.at(count)) : std::to_string(count);
}

/// Returns the message for a list of a wrong length.
std::string demand_of(const Count& count, std::string_view values, std::size_t found) {
  const std::string not_found = ", not " + std::to_string(found);
  if (count.fewest == count.most) return "must be " + number_word(count.fewest) + " " + std::string(values) + not_found;
  if (found < count.fewest) return "needs at least " + number_word(count.fewest) + " of its " + std::string(values);
  return "must be at most " + number_word(count.most) + " " + std::string(values) + not_found;
}

void check_count(const TomlTable& table, const StudyEntry& entry, std::string_view values, std::size_t found) {
  if (found < entry.count.fewest || found > entry.count.most)
    throw table.error(entry.key.name, demand_of(entry.count, values, found));
}

bool is_among(const std::vector<std::string_view>& words, std::string_view text) {
  return std::ranges::find(words, text) != words.end();
}

std::string read_text(const TomlTable& table, const StudyEntry& entry) {
  if (entry.words.empty()) return table.text(entry.key.name);
  Words<std::string_view> words;
  for (const std::string_view word : entry.words) words.emplace_back(word, word);
  return std::string(table.word(entry.key.name, words));
}

std::int64_t read_integer(const TomlTable& table, const StudyEntry& entry) {
  return table.integer(entry.key.name, entry.range, entry.limits);
}

std::vector<std::int64_t> read_integers(const TomlTable& table, const StudyEntry& entry) {
  std::vector<std::int64_t> values = table.integers(entry.key.name, entry.range, entry.limits);
  check_count(table, entry, "integers", values.size());
  return values;
}

std::vector<double> read_numbers(const TomlTable& table, const StudyEntry& entry) {
  std::vector<double> values = table.numbers(entry.key.name, entry.range);
  check_count(table, entry, "numbers", values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (const std::string fault = fault_of_magnitude(entry, values[n]); !fault.empty())
      throw table.error(entry.key.name, fault, std::array{n});
  }
  return values;
}

double read_number(const TomlTable& table, const StudyEntry& entry) {
  const double value = table.number(entry.key.name, entry.range);
  if (const std::string fault = fault_of_magnitude(entry, value); !fault.empty()) throw table.error(entry.key.name, fault);
  return value;
}

std::vector<std::string> read_texts(const TomlTable& table, const StudyEntry& entry) {
  std::vector<std::string> values = table.texts(entry.key.name);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!entry.words.empty() && !is_among(entry.words, values[n]))
      throw table.error(entry.key.name, "must be " + list_of_words(entry.words), std::array{n});
  }
  check_count(table, entry, "texts", values.size());
  return values;
}

/// Reads an integer, or the word that may replace it.
StudyValue read_integer_or_word(const TomlTable& table, const StudyEntry& entry) {
  if (!table.is_text(entry.key.name)) return read_integer(table, entry);
  const std::string word = table.text(entry.key.name);
  if (!is_among(entry.words, word)) {
    const std::string demand = entry.range.demand();
    throw table.error(entry.key.name, "must be an integer" + (demand.empty() ? demand : demand.substr(demand.find(' ', 5))) +
                                          " or " + toml_quoted(entry.words.front()));
  }
  return word;
}

}  // namespace

StudyValue read_study_value(const TomlTable& table, const StudyEntry& entry) {
  const std::string_view name = entry.key.name;
  switch (entry.kind) {
    case ValueKind::boolean:
      return table.boolean(name);
    case ValueKind::integer:
      return entry.words.empty() ? StudyValue(read_integer(table, entry)) : read_integer_or_word(table, entry);
    case ValueKind::number:
      return read_number(table, entry);
    case ValueKind::text:
      return read_text(table, entry);
    case ValueKind::path:
      return entry.key.data.empty() ? table.path(name) : file_or_data(table, name, entry.key.data);
    case ValueKind::integers:
      return read_integers(table, entry);
    case ValueKind::numbers:
      return read_numbers(table, entry);
    case ValueKind::texts:
      return read_texts(table, entry);
    case ValueKind::text_rows:
      break;
  }
  return table.text_rows(name);
}

void StudyReader::refuse(std::string_view key) const { table_.belongs_to(key, refused_because_); }

void StudyReader::inside(std::string_view name, const TomlTable& table, const std::function<void()>& describe) {
  const TomlTable outer = std::exchange(table_, table);
  const std::string outer_prefix = prefix_;
  prefix_.append(name).append(".");
  describe();
  prefix_ = outer_prefix;
  table_ = outer;
}

std::optional<StudyReader::EarlierKey> StudyReader::find_earlier(const Key& key) const {
  if (key.earlier.empty()) return std::nullopt;
  const bool is_from_top = key.earlier.front() == '/';
  std::string_view rest = is_from_top ? key.earlier.substr(1) : key.earlier;
  TomlTable table = is_from_top ? top_ : table_;
  for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    const std::string_view name = rest.substr(0, dot);
    if (!table.is_table(name)) return std::nullopt;
    table = table.table(name);
    rest.remove_prefix(dot + 1);
  }
  if (!table.has(rest)) return std::nullopt;
  if (earlier_names_ == EarlierNames::refused) {
    throw table.error(rest, "is called " + prefix_ + std::string(key.name) + " now" +
                                (key.was_reciprocal ? ", the reciprocal of this number" : ""));
  }
  (void)table.asks_for(rest);
  return EarlierKey{table, std::string(rest)};
}

void StudyReader::visit(const StudyEntry& entry, std::optional<StudyValue>& value) {
  if (is_refusing()) return refuse(entry.key.name);
  if (const auto earlier = find_earlier(entry.key)) {
    StudyEntry there = entry;
    there.key.name = earlier->name;
    if (entry.key.was_reciprocal)
      value = 1.0 / earlier->table.number(earlier->name, positive());
    else
      value = read_study_value(earlier->table, there);
    return;
  }
  if (!table_.asks_for(entry.key.name) && !entry.is_required()) return;
  value = read_study_value(table_, entry);
}

void StudyReader::visit_table(const Key& key, const std::function<void()>& describe) {
  if (is_refusing()) return refuse(key.name);
  if (const auto earlier = find_earlier(key)) return inside(key.name, earlier->table.table(earlier->name), describe);
  inside(key.name, key.example.empty() ? table_.table_or_empty(key.name) : table_.table(key.name), describe);
}

void StudyReader::visit_optional_table(const Key& key, bool, const std::function<void(bool)>& set,
                                       const std::function<void()>& describe) {
  if (is_refusing()) return refuse(key.name);
  const auto earlier = find_earlier(key);
  const std::optional<TomlTable> table = earlier ? earlier->table.optional_table(earlier->name) : table_.optional_table(key.name);
  if (!table) return;
  set(true);
  inside(key.name, *table, describe);
}

void StudyReader::visit_tables(const Key& key, const Count& count, std::size_t, const std::function<void(std::size_t)>& resize,
                               const std::function<void(std::size_t)>& describe) {
  if (is_refusing()) return refuse(key.name);
  if (!table_.asks_for(key.name) && count.fewest == 0) return;
  const std::vector<TomlTable> tables = count.fewest == 0 ? table_.optional_tables(key.name) : table_.tables(key.name);
  if (tables.size() < count.fewest || tables.size() > count.most)
    throw table_.error(key.name, demand_of(count, "tables", tables.size()));
  resize(0);
  resize(tables.size());
  for (std::size_t n = 0; n < tables.size(); ++n)
    inside(std::string(key.name) + "[" + std::to_string(n + 1) + "]", tables[n], [&] { describe(n); });
}

void StudyReader::visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) {
  if (is_refusing()) {
    for (const Alternative& alternative : alternatives) refuse(alternative.key);
    return;
  }
  const Alternative* given = nullptr;
  for (const Alternative& alternative : alternatives) {
    const Key key{.name = alternative.key, .help = {}, .earlier = alternative.earlier};
    if (!table_.asks_for(alternative.key) && !find_earlier(key)) continue;
    if (given != nullptr) throw table_.error(alternative.key, std::string(given->key) + " is also given: keep one of them");
    given = &alternative;
  }
  if (given != nullptr) {
    given->choose();
    given->describe();
    return;
  }
  const auto chosen = std::ranges::find_if(alternatives, &Alternative::is_chosen);
  if (chosen != alternatives.end()) return chosen->describe();
  if (missing.empty()) return;
  std::string keys;
  for (const Alternative& alternative : alternatives) keys.append(keys.empty() ? "" : " or ").append(alternative.key);
  throw table_.missing(keys, missing);
}

void StudyReader::visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) {
  if (holds || is_refusing()) return describe();
  refused_because_ = condition;
  describe();
  refused_because_.clear();
}

}  // namespace menger::io
