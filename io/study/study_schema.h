#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"

namespace menger::io {

/// Writes a JSON Schema (draft 2020-12) of a study, with which editors complete and check TOML files.
///
/// The schema holds kinds, ranges, words, defaults, required keys and keys that exclude each other. Demands that depend on other
/// values are left to the reader. To find them, a second writer describes the study again with other values, and demands that
/// then differ are left out. The study must have its defaults before; do not use it afterwards.
class StudySchemaWriter : public StudyVisitor {
 public:
  /// @param varies whether this writer changes the values that it visits, for leave_out_what_differs
  explicit StudySchemaWriter(bool varies = false);
  ~StudySchemaWriter() override;

  /// @param title title of the schema: "study of menger inflate"
  [[nodiscard]] std::string text(std::string_view title) const;

  /// Removes the ranges, lengths and required keys that are not the same in the schema of a second writer, which varied the
  /// values.
  void leave_out_what_differs(const StudySchemaWriter& varied);

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
  struct Table;
  /// Describes a table into a `Table` of its own.
  void inside(Table& table, const std::function<void()>& describe);

  std::unique_ptr<Table> top_;
  Table* table_;
  bool varies_;
  bool may_be_missing_ = false;  ///< inside alternatives and conditions, where no key is always required
};

}  // namespace menger::io
