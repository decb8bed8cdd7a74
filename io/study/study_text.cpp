#include "io/study/study_text.h"

#include "io/text/toml_text.h"

namespace menger::io {

std::string study_value_text(const StudyValue& value) {
  return std::visit(
      [](const auto& any) {
        if constexpr (std::is_same_v<std::decay_t<decltype(any)>, std::filesystem::path>)
          return toml_value_text(std::string_view(any.native()));
        else
          return toml_value_text(any);
      },
      value);
}

void StudyTextWriter::inside(std::string name, bool is_entry, bool is_kept, const std::function<void()>& describe) {
  const std::string outer_prefix = prefix_;
  StudySection* const outer = section_;
  const std::string whole = prefix_ + std::move(name);
  StudySection section{.header = is_entry ? "[[" + whole + "]]" : "[" + whole + "]", .lines = {}, .is_kept = is_kept};
  section_ = &section;
  prefix_ = whole + ".";
  describe();
  section_ = outer;
  prefix_ = outer_prefix;
  section_->sections.push_back(std::move(section));
}

void StudyTextWriter::visit(const StudyEntry& entry, std::optional<StudyValue>& value) {
  if (!value) return;
  section_->lines.append(entry.key.name).append(" = ").append(study_value_text(*value)).append("\n");
}

void StudyTextWriter::visit_table(const Key& key, const std::function<void()>& describe) {
  inside(std::string(key.name), false, false, describe);
}

void StudyTextWriter::visit_optional_table(const Key& key, bool has, const std::function<void(bool)>&,
                                           const std::function<void()>& describe) {
  if (has) inside(std::string(key.name), false, true, describe);
}

void StudyTextWriter::visit_tables(const Key& key, const Count&, std::size_t size, const std::function<void(std::size_t)>&,
                                   const std::function<void(std::size_t)>& describe) {
  for (std::size_t n = 0; n < size; ++n) inside(std::string(key.name), true, true, [&] { describe(n); });
}

void StudyTextWriter::visit_choice(const std::vector<Alternative>& alternatives, std::string_view) {
  const auto chosen = std::ranges::find_if(alternatives, &Alternative::is_chosen);
  if (chosen != alternatives.end()) chosen->describe();
}

void StudyTextWriter::visit_branch(bool holds, std::string_view, const std::function<void()>& describe) {
  if (holds) describe();
}

}  // namespace menger::io
