#include "io/study/study_template.h"

#include <algorithm>
#include <utility>

#include "io/study/key_text.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"

namespace menger::io {
namespace {

StudyValue example_of(const StudyEntry& entry) {
  const std::string text = std::string(entry.key.name) + " = " + std::string(entry.key.example);
  return read_study_value(parse_toml(text, "example"), entry);
}

std::string extended(std::string text, std::string_view addition) {
  if (addition.empty()) return text;
  return text.append(text.empty() ? "" : "; ").append(addition);
}

}  // namespace

bool StudyTemplateWriter::takes_next(const std::string& name) {
  if (is_comment_) return false;
  const bool takes = enabled_ == alternatives_++;
  if (takes) enabled_name_ = prefix_ + name;
  return takes;
}

void StudyTemplateWriter::comment(std::string_view text) { section_->lines.append("# ").append(text).append("\n"); }

void StudyTemplateWriter::visit(const StudyEntry& entry, std::optional<StudyValue>& value) {
  if (entry.is_required()) value = example_of(entry);
  if (value && std::holds_alternative<std::string>(*value)) {
    const std::string usual = std::get<std::string>(*value);
    for (const std::string_view word : entry.words) {
      if (word != usual && takes_next(std::string(entry.key.name) + " = " + toml_quoted(word))) value = std::string(word);
    }
  }
  const bool is_left_out = !value;
  if (is_left_out && takes_next(std::string(entry.key.name))) value = example_of(entry);
  std::string values = extended(unit_of(entry.key.name), values_of(entry));
  if (entry.is_required()) values = extended(std::move(values), "must be given");
  if (entry.is_optional) values = extended(std::move(values), "may be left out");
  comment(std::string(entry.key.help) + (values.empty() ? "" : " (" + values + ")"));
  const std::string given = value ? study_value_text(*value) : std::string(entry.key.example);
  section_->lines.append(is_comment_ || !value ? "#" : "").append(entry.key.name).append(" = ").append(given).append("\n");
}

void StudyTemplateWriter::inside(const Key& key, bool is_entry, const std::function<void()>& describe) {
  const std::string outer_prefix = prefix_;
  StudySection* const outer = section_;
  const std::string whole = prefix_ + std::string(key.name);
  const std::string header = std::string(is_comment_ ? "#" : "") + (is_entry ? "[[" + whole + "]]" : "[" + whole + "]");
  StudySection section{.header = "# " + std::string(key.help) + "\n" + header, .lines = {}, .is_kept = true};
  section_ = &section;
  prefix_ = whole + ".";
  describe();
  section_ = outer;
  prefix_ = outer_prefix;
  section_->sections.push_back(std::move(section));
}

void StudyTemplateWriter::as_comment(const std::function<void()>& describe) {
  const bool outer = std::exchange(is_comment_, true);
  describe();
  is_comment_ = outer;
}

void StudyTemplateWriter::visit_table(const Key& key, const std::function<void()>& describe) { inside(key, false, describe); }

void StudyTemplateWriter::visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                                               const std::function<void()>& describe) {
  const bool writes = has || takes_next(std::string(key.name));
  set(true);
  if (writes) return inside(key, false, describe);
  as_comment([&] { inside(key, false, describe); });
  set(false);
}

void StudyTemplateWriter::visit_tables(const Key& key, const Count& count, std::size_t size,
                                       const std::function<void(std::size_t)>& resize,
                                       const std::function<void(std::size_t)>& describe) {
  const std::size_t needed = std::max(size, count.fewest);
  const bool writes = needed > 0 || takes_next(std::string(key.name));
  resize(std::max<std::size_t>(needed, 1));
  const auto write = [&] {
    for (std::size_t n = 0; n < std::max<std::size_t>(needed, 1); ++n) inside(key, true, [&] { describe(n); });
  };
  if (writes) return write();
  as_comment(write);
  resize(0);
}

void StudyTemplateWriter::visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) {
  const Alternative* written = nullptr;
  for (const Alternative& alternative : alternatives) {
    if (alternative.is_chosen) written = &alternative;
  }
  if (written == nullptr && !missing.empty()) written = &alternatives.front();
  const Alternative* const usual = written;
  for (const Alternative& alternative : alternatives) {
    if (&alternative != usual && !alternative.is_for_programs && takes_next(std::string(alternative.key))) written = &alternative;
  }
  // The written alternative comes last, so that the study has this form afterwards.
  for (const Alternative& alternative : alternatives) {
    if (&alternative == written || alternative.is_for_programs) continue;
    if (written != nullptr) comment("In place of " + std::string(written->key) + ":");
    as_comment([&] {
      alternative.choose();
      alternative.describe();
    });
  }
  if (written == nullptr) return;
  written->choose();
  written->describe();
}

void StudyTemplateWriter::visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) {
  if (holds) return describe();
  comment("Only with " + std::string(condition) + ":");
  as_comment(describe);
}

}  // namespace menger::io
