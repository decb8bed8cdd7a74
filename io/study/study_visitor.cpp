#include "io/study/study_visitor.h"

namespace menger::io {

std::string no_such_word(std::string_view word, const std::vector<std::string_view>& words) {
  return toml_quoted(word) + " is none of the words of this key, " + list_of_words(words);
}

void StudyVisitor::boolean(const Key& key, bool& value) { value = visited({.key = key, .kind = ValueKind::boolean}, value); }

void StudyVisitor::number(const Key& key, double& value, const Range& range) {
  value = visited({.key = key, .kind = ValueKind::number, .range = range}, value);
}

void StudyVisitor::optional_number(const Key& key, std::optional<double>& value, const Range& range) {
  value = visited({.key = key, .kind = ValueKind::number, .range = range, .is_optional = true}, value);
}

void StudyVisitor::text(const Key& key, std::string& value) { value = visited({.key = key, .kind = ValueKind::text}, value); }

void StudyVisitor::optional_text(const Key& key, std::optional<std::string>& value) {
  value = visited({.key = key, .kind = ValueKind::text, .is_optional = true}, value);
}

void StudyVisitor::path(const Key& key, std::filesystem::path& value) {
  value = visited({.key = key, .kind = ValueKind::path}, value);
}

void StudyVisitor::optional_path(const Key& key, std::optional<std::filesystem::path>& value) {
  value = visited({.key = key, .kind = ValueKind::path, .is_optional = true}, value);
}

void StudyVisitor::numbers(const Key& key, std::vector<double>& values, const Range& range, const Count& count) {
  values = visited({.key = key, .kind = ValueKind::numbers, .range = range, .count = count}, values);
}

void StudyVisitor::texts(const Key& key, std::vector<std::string>& values, const Count& count) {
  values = visited({.key = key, .kind = ValueKind::texts, .count = count}, values);
}

void StudyVisitor::key_names(const Key& key, std::vector<std::string>& values, const Count& count) {
  values = visited({.key = key, .kind = ValueKind::texts, .count = count, .names_keys = true}, values);
}

void StudyVisitor::optional_numbers(const Key& key, std::optional<std::vector<double>>& values, const Range& range,
                                    const Count& count) {
  values = visited({.key = key, .kind = ValueKind::numbers, .range = range, .count = count, .is_optional = true}, values);
}

void StudyVisitor::optional_texts(const Key& key, std::optional<std::vector<std::string>>& values, const Count& count) {
  values = visited({.key = key, .kind = ValueKind::texts, .count = count, .is_optional = true}, values);
}

void StudyVisitor::paths(const Key& key, std::vector<std::filesystem::path>& values, const Count& count) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const std::filesystem::path& value : values) names.push_back(value.string());
  texts(key, names, count);
  const TomlTable* table = source();
  if (table != nullptr && !table->has(key.name)) return;
  const std::filesystem::path folder = table == nullptr ? std::filesystem::path() : table->file().parent_path();
  values.clear();
  for (const std::string& name : names) values.push_back(folder / name);
}

void StudyVisitor::text_rows(const Key& key, std::vector<std::vector<std::string>>& rows) {
  rows = visited({.key = key, .kind = ValueKind::text_rows}, rows);
}

}  // namespace menger::io
