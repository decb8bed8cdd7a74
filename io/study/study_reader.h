#pragma once

#include "io/study/study_visitor.h"

namespace menger::io {

/// The value of an entry in a table that has it. @throws InputError if it is none that the entry takes
StudyValue read_study_value(const TomlTable& table, const StudyEntry& entry);

/// Reads a study from a TOML table: keys that are missing keep the values that the study has, all others are checked.
///
/// The table's owner ends with TomlTable::finish(), which refuses keys that no description has named.
/// Each call throws InputError with file, line, key and value.
class StudyReader : public StudyVisitor {
 public:
  /// What is done with a key that has the name of an earlier version.
  enum class EarlierNames {
    refused,  ///< the message says what the key is called now: people are told once, and files stay readable to others
    read      ///< for what programs wrote, archives and checkpoints
  };

  /// @param table the top of the file
  explicit StudyReader(const TomlTable& table, EarlierNames earlier_names = EarlierNames::refused)
      : top_(table), table_(table), earlier_names_(earlier_names) {}

  [[nodiscard]] const TomlTable* source() const override { return is_refusing() ? nullptr : &table_; }

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
  /// Whether keys of a condition that does not hold are gone through, only to refuse them.
  [[nodiscard]] bool is_refusing() const { return !refused_because_.empty(); }
  void refuse(std::string_view key) const;
  void inside(std::string_view name, const TomlTable& table, const std::function<void()>& describe);

  /// A key under the name of an earlier version, and the table that has it; nothing if the file has none, or no such key ever
  /// was.
  struct EarlierKey {
    TomlTable table;
    std::string name;
  };
  [[nodiscard]] std::optional<EarlierKey> find_earlier(const Key& key) const;

  TomlTable top_;
  TomlTable table_;
  EarlierNames earlier_names_;
  std::string prefix_{};  ///< of the table that is open, with a dot at its end
  std::string refused_because_{};
};

/// Reads the whole table of a file into a study that has a description. @throws InputError
template <class Study>
void read_described(const TomlTable& table, Study& study,
                    StudyReader::EarlierNames earlier_names = StudyReader::EarlierNames::refused) {
  StudyReader reader(table, earlier_names);
  describe(reader, study);
  table.finish();
}

}  // namespace menger::io
