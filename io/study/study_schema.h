#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"

namespace menger::io {

/// Describes a study as JSON Schema (draft 2020-12), with which editors complete and check TOML files as they are typed.
///
/// It holds kinds, ranges, words, defaults, keys that must be there and keys that exclude each other. Demands that depend on
/// other values are left to the reader: a second writer goes through another study, and what differs is left out. The study that
/// is gone through must have its defaults before, and is of no use after.
class StudySchemaWriter : public StudyVisitor {
 public:
  /// @param varies whether values are changed on the way, for leave_out_what_differs
  explicit StudySchemaWriter(bool varies = false);
  ~StudySchemaWriter() override;

  /// @param title of the schema: "study of menger inflate"
  [[nodiscard]] std::string text(std::string_view title) const;

  /// Leaves out the ranges, lengths and required keys that another writer, which varied the values, did not find the same.
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
  /// Describes a table apart. @return its schema
  void inside(Table& table, const std::function<void()>& describe);

  std::unique_ptr<Table> top_;
  Table* table_;
  bool varies_;
  bool may_be_missing_ = false;  ///< inside alternatives and conditions, where nothing is required for good
};

}  // namespace menger::io
