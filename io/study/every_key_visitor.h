#pragma once

#include "io/study/study_visitor.h"

namespace menger::io {

/// Goes through all keys that a study can have: also those of every alternative, of tables that are not there and of conditions
/// that do not hold. The study must have its defaults before; do not use it afterwards.
class EveryKeyVisitor : public StudyVisitor {
 protected:
  /// @param leaves_out_forms_for_programs whether alternatives that only programs use are left out
  explicit EveryKeyVisitor(bool leaves_out_forms_for_programs) : for_people_(leaves_out_forms_for_programs) {}

  /// Describes the keys of a table. @param is_entry whether it stands for each table of an array
  virtual void inside(const Key& key, bool is_entry, const std::function<void()>& describe) = 0;
  /// Describes keys under a condition that does not hold. @param condition for people
  virtual void under(std::string_view condition, const std::function<void()>& describe);

  void visit_table(const Key& key, const std::function<void()>& describe) override;
  void visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                            const std::function<void()>& describe) override;
  void visit_tables(const Key& key, const Count& count, std::size_t size, const std::function<void(std::size_t)>& resize,
                    const std::function<void(std::size_t)>& describe) override;
  void visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) override;
  void visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) override;

 private:
  bool for_people_;
};

}  // namespace menger::io
