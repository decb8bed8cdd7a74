#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/study/study_section.h"
#include "io/study/study_visitor.h"

namespace menger::io {

/// Writes a study file that explains itself: every key with its meaning, its values and its default. Keys without a default have
/// an example; what excludes something else, or is not there unless it is asked for, is a comment.
///
/// The study that is gone through is used up: it must have its defaults before, and is of no use after.
class StudyTemplateWriter : public StudyVisitor {
 public:
  /// @param enabled the number of the alternative that is written instead of what a study has by default: a word, a table, a key
  /// of several; for tests. See alternative_count().
  explicit StudyTemplateWriter(std::optional<std::size_t> enabled = std::nullopt) : enabled_(enabled) {}

  [[nodiscard]] std::string text() const { return top_.text("\n"); }
  /// How many alternatives there were on the way.
  [[nodiscard]] std::size_t alternative_count() const { return alternatives_; }
  /// The alternative that was enabled, for messages: "dynamics.method = \"implicit\"".
  [[nodiscard]] const std::string& enabled_name() const { return enabled_name_; }

 protected:
  void visit(const StudyEntry& entry, std::optional<StudyValue>& value) override;
  void visit_table(const Key& key, const std::function<void()>& describe) override;
  void visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                            const std::function<void()>& describe) override;
  void visit_tables(const Key& key, const Count& count, std::size_t size, const std::function<void(std::size_t)>& resize,
                    const std::function<void(std::size_t)>& describe) override;
  void visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) override;
  void visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) override;

 private:
  /// Whether the next alternative is the one to be written. @param name for enabled_name(), without the tables above
  bool takes_next(const std::string& name);
  void comment(std::string_view text);
  void inside(const Key& key, bool is_entry, const std::function<void()>& describe);
  /// Goes through keys that are written as comments.
  void as_comment(const std::function<void()>& describe);

  std::optional<std::size_t> enabled_;
  std::string enabled_name_{};
  std::size_t alternatives_ = 0;
  bool is_comment_ = false;
  StudySection top_{};
  StudySection* section_ = &top_;
  std::string prefix_{};
};

}  // namespace menger::io
