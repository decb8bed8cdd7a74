#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/study/study_section.h"
#include "io/study/study_visitor.h"

namespace menger::io {

/// Writes a study file with explanations: every key with its meaning, its values and its default.
///
/// Keys without a default have an example. Alternatives that exclude the written one, and optional parts that are not there by
/// default, are comments. So are keys with defaults from an earlier key (StudyVisitor::defaults_from); of those, keys that must
/// be given have their example where that earlier key gives them no value: in such alternatives, and under conditions that do not
/// hold. The study must have its defaults before; do not use it afterwards.
class StudyTemplateWriter : public StudyVisitor {
 public:
  /// @param enabled for tests: the number of the alternative to write instead of the default, which may be a word, a table or one
  /// of several keys. See alternative_count().
  explicit StudyTemplateWriter(std::optional<std::size_t> enabled = std::nullopt) : enabled_(enabled) {}

  /// From now on keys without a default are written with the value that the study has, not with their example.
  void keep_values() { keeps_values_ = true; }

  [[nodiscard]] std::string text() const { return top_.text("\n"); }
  /// Returns the number of alternatives that were visited.
  [[nodiscard]] std::size_t alternative_count() const { return alternatives_; }
  /// Returns the name of the enabled alternative, for messages: "dynamics.method = \"implicit\"".
  [[nodiscard]] const std::string& enabled_name() const { return enabled_name_; }

 protected:
  /// The lines of the table that is being described, the last key at their end: for tests.
  [[nodiscard]] const std::string& lines_so_far() const { return section_->lines; }

  void visit(const StudyEntry& entry, std::optional<StudyValue>& value) override;
  void visit_table(const Key& key, const std::function<void()>& describe) override;
  void visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                            const std::function<void()>& describe) override;
  void visit_tables(const Key& key, const Count& count, std::size_t size, const std::function<void(std::size_t)>& resize,
                    const std::function<void(std::size_t)>& describe) override;
  void visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) override;
  void visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) override;
  void visit_defaults(std::string_view key, const std::function<void()>& describe) override;

 private:
  /// Counts an alternative and returns whether it is the enabled one. @param name for enabled_name(), without the tables around
  /// it
  bool takes_next(const std::string& name);
  void comment(std::string_view text);
  void inside(const Key& key, bool is_entry, const std::function<void()>& describe);
  /// Describes keys that are written as comments.
  void as_comment(const std::function<void()>& describe);
  /// The same of keys to which an earlier key gives no value, so that those which must be given are shown with their example.
  void as_comment_with_examples(const std::function<void()>& describe);
  /// The same, with a line of its own before the keys, and before the first of the tables.
  void as_comment_with_title(const std::string& title, const std::function<void()>& describe);
  /// Describes keys that are not there without this file, so that no earlier key gives their defaults.
  void as_addition(const std::function<void()>& describe);

  std::optional<std::size_t> enabled_;
  std::string enabled_name_{};
  std::size_t alternatives_ = 0;
  bool is_comment_ = false;
  std::string_view required_ = "must be given";  ///< what is said of a key without a default
  bool keeps_values_ = false;
  bool has_defaults_ = false;    ///< whether an earlier key gives the defaults, so that only other values are written
  bool shows_examples_ = false;  ///< whether a key that must be given is shown with its example, whatever the study holds
  StudySection top_{};
  StudySection* section_ = &top_;
  std::string prefix_{};
};

}  // namespace menger::io
