#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/study/every_key_visitor.h"

namespace menger::io {

/// A row of the table of keys: one key of a study.
struct KeyRow {
  std::string name;      ///< with the tables that contain it: "ground.height_m", "plates[].name"
  std::string kind;      ///< "number", "word"
  std::string unit;      ///< "m"; empty if there is none
  std::string standard;  ///< the default in TOML, "must be given", "one of several" (it or the keys of another form) or "none"
  std::string values;    ///< "> 0"; empty if every value of its kind is accepted
  std::string help;
  std::string condition;  ///< when the key has a meaning: `method = "implicit"`; empty if always
};

/// Makes the table of the keys of a study. The study must have its defaults before; do not use it afterwards.
class StudyKeyTable : public EveryKeyVisitor {
 public:
  StudyKeyTable() : EveryKeyVisitor(true) {}

  [[nodiscard]] const std::vector<KeyRow>& rows() const { return rows_; }
  /// Returns the table for a terminal: one line per key, columns aligned.
  [[nodiscard]] std::string text() const;

 protected:
  void visit(const StudyEntry& entry, std::optional<StudyValue>& value) override;
  void inside(const Key& key, bool is_entry, const std::function<void()>& describe) override;
  void under(std::string_view condition, const std::function<void()>& describe) override;
  void visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) override;

 private:
  std::vector<KeyRow> rows_;
  std::string prefix_;
  std::string condition_;
  std::size_t forms_ = 1;  ///< of which a file uses one
};

}  // namespace menger::io
