#pragma once

#include <string>
#include <string_view>

#include "io/study/study_section.h"
#include "io/study/study_visitor.h"

namespace menger::io {

/// Returns a value as TOML.
std::string study_value_text(const StudyValue& value);

/// Writes a study as TOML with every value, always in the same order, and exactly. Equal texts mean equal studies; reading the
/// text gives the same study.
class StudyTextWriter : public StudyVisitor {
 public:
  /// @param table name of the table that holds these keys, used in the names of the tables in it. The caller writes the header of
  /// that table. Empty: the top of the file.
  explicit StudyTextWriter(std::string_view table = {}) : prefix_(table.empty() ? "" : std::string(table) + ".") {}

  [[nodiscard]] std::string text() const { return top_.text(); }

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
  void inside(std::string name, bool is_entry, bool is_kept, const std::function<void()>& describe);

  StudySection top_{};
  StudySection* section_ = &top_;
  std::string prefix_;  ///< path of the open table, with a dot at its end
};

/// Returns the text of a study that has a `describe` function. It works on a copy because `describe` takes a reference.
template <class Study>
std::string described_text(Study study) {
  StudyTextWriter writer;
  describe(writer, study);
  return writer.text();
}

}  // namespace menger::io
