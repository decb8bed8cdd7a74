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

/// Returns a text as lines of a comment. Lines break between words.
std::string comment_lines(std::string_view text) {
  constexpr std::size_t width = 110;
  std::string lines;
  while (text.size() > width) {
    const std::size_t space = text.rfind(' ', width);
    if (space == std::string_view::npos || space == 0) break;
    lines.append("# ").append(text.substr(0, space)).append("\n");
    text.remove_prefix(space + 1);
  }
  return lines.append("# ").append(text).append("\n");
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

void StudyTemplateWriter::comment(std::string_view text) { section_->lines += comment_lines(text); }

void StudyTemplateWriter::visit(const StudyEntry& entry, std::optional<StudyValue>& value) {
  if (entry.is_required() && !((has_defaults_ || (keeps_values_ && !is_comment_)) && value)) value = example_of(entry);
  bool is_default = has_defaults_;
  const auto take = [&](StudyValue other) {
    value = std::move(other);
    is_default = false;
  };
  if (value && std::holds_alternative<std::string>(*value)) {
    const std::string usual = std::get<std::string>(*value);
    for (const std::string_view word : entry.words) {
      if (word != usual && takes_next(std::string(entry.key.name) + " = " + toml_quoted(word))) take(std::string(word));
    }
  }
  const bool is_left_out = !value;
  if (is_left_out && takes_next(std::string(entry.key.name))) take(example_of(entry));
  std::string values = extended(unit_of(entry.key.name), values_of(entry));
  if (entry.is_required()) values = extended(std::move(values), required_);
  if (entry.is_optional) values = extended(std::move(values), "may be left out");
  comment(std::string(entry.key.help) + (values.empty() ? "" : " (" + values + ")"));
  std::string given = value ? study_value_text(*value) : std::string(entry.key.example);
  if (shows_examples_ && entry.is_required()) given = study_value_text(example_of(entry));
  section_->lines.append(is_comment_ || is_default || !value ? "#" : "")
      .append(entry.key.name)
      .append(" = ")
      .append(given)
      .append("\n");
}

void StudyTemplateWriter::inside(const Key& key, bool is_entry, const std::function<void()>& describe) {
  const std::string outer_prefix = prefix_;
  StudySection* const outer = section_;
  const std::string whole = prefix_ + std::string(key.name);
  const std::string header = std::string(is_comment_ ? "#" : "") + (is_entry ? "[[" + whole + "]]" : "[" + whole + "]");
  StudySection section{.header = comment_lines(key.help) + header, .lines = {}, .is_kept = true};
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

void StudyTemplateWriter::as_comment_with_examples(const std::function<void()>& describe) {
  const bool outer = std::exchange(shows_examples_, true);
  as_comment(describe);
  shows_examples_ = outer;
}

void StudyTemplateWriter::as_comment_with_title(const std::string& title, const std::function<void()>& describe) {
  const std::size_t line_start = section_->lines.size();
  const std::size_t section_count = section_->sections.size();
  as_comment_with_examples(describe);
  const std::string line = "# " + title + "\n";
  if (section_->lines.size() > line_start) section_->lines.insert(line_start, line);
  // Tables come after all lines, so they need a title of their own.
  if (section_->sections.size() > section_count) section_->sections[section_count].header.insert(0, line);
}

void StudyTemplateWriter::as_addition(const std::function<void()>& describe) {
  const bool outer = std::exchange(has_defaults_, false);
  describe();
  has_defaults_ = outer;
}

void StudyTemplateWriter::visit_table(const Key& key, const std::function<void()>& describe) { inside(key, false, describe); }

void StudyTemplateWriter::visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                                               const std::function<void()>& describe) {
  if (has) return inside(key, false, describe);
  const bool writes = takes_next(std::string(key.name));
  set(true);
  const auto add = [&] { as_addition([&] { inside(key, false, describe); }); };
  if (writes) return add();
  as_comment(add);
  set(false);
}

void StudyTemplateWriter::visit_tables(const Key& key, const Count& count, std::size_t size,
                                       const std::function<void(std::size_t)>& resize,
                                       const std::function<void(std::size_t)>& describe) {
  const std::size_t needed = std::max(size, count.fewest);
  const bool is_default = has_defaults_ && size > 0;
  const bool writes = !is_default && (needed > 0 || takes_next(std::string(key.name)));
  resize(std::max<std::size_t>(needed, 1));
  const auto write = [&] {
    for (std::size_t n = 0; n < std::max<std::size_t>(needed, 1); ++n) inside(key, true, [&] { describe(n); });
  };
  if (writes) return as_addition(write);
  if (is_default) return as_comment(write);
  as_comment([&] { as_addition(write); });
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
  const std::string_view required = required_;
  const auto is_shown = [](const Alternative& alternative) { return !alternative.is_for_programs; };
  if (std::ranges::count_if(alternatives, is_shown) > 1) required_ = "must be given, or what stands in its place below";
  const auto write = [&] {
    written->choose();
    if (written == usual) return written->describe();
    as_addition(written->describe);
  };
  const std::size_t counted = alternatives_;
  if (written != nullptr) write();
  required_ = "";  // the line before each of the others says what it stands in place of
  bool has_others = false;
  for (const Alternative& alternative : alternatives) {
    if (&alternative == written || alternative.is_for_programs) continue;
    has_others = true;
    const auto describe = [&alternative] {
      alternative.choose();
      alternative.describe();
    };
    if (written == nullptr) {
      as_comment_with_examples(describe);
    } else {
      as_comment_with_title("In place of " + std::string(written->key) + ":", describe);
    }
  }
  required_ = required;
  if (written == nullptr || !has_others) return;
  // Once more without a text, so that the study has this form afterwards.
  const StudySection text = *section_;
  alternatives_ = counted;
  write();
  *section_ = text;
}

void StudyTemplateWriter::visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) {
  if (holds) return describe();
  as_comment_with_title("Only with " + std::string(condition) + ":", describe);
}

void StudyTemplateWriter::visit_defaults(std::string_view key, const std::function<void()>& describe) {
  comment("The other keys have the values that this " + std::string(key) +
          " gives them. To give one another value, remove its #.");
  const bool outer = std::exchange(has_defaults_, true);
  describe();
  has_defaults_ = outer;
}

}  // namespace menger::io
