#pragma once

#include <new>

#include "io/study/earlier_names.h"
#include "io/study/study_visitor.h"

namespace menger::io {

/// Reads the value of an entry from a table that has its key. @throws InputError if the entry does not accept the value
StudyValue read_study_value(const TomlTable& table, const StudyEntry& entry);

/// Reads a study from a TOML table and checks every value. Keys that are missing keep the values that the study has.
///
/// The owner of the table must call TomlTable::finish() at the end, which refuses keys that no description has named. Each
/// function throws InputError with file, line, key and value.
class StudyReader : public StudyVisitor {
 public:
  /// How a key with a name of an earlier version is handled.
  enum class EarlierNames {
    /// An error gives the present name of the key. So people learn it once, and others can read their files.
    refused,
    read  ///< the value is read: for files that programs wrote, archives and checkpoints
  };

  /// @param table the top table of the file
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
  /// Whether the reader is inside a condition that does not hold: then each key is only refused.
  [[nodiscard]] bool is_refusing() const { return !refused_because_.empty(); }
  void refuse(std::string_view key) const;
  void inside(std::string_view name, const TomlTable& table, const std::function<void()>& describe);

  /// A key found under its name of an earlier version, and the table that contains it.
  struct EarlierKey {
    TomlTable table;
    std::string name;
  };
  /// Finds a key by its name of an earlier version; returns nothing if the key had none or the file does not have it.
  /// @throws InputError if earlier names are refused
  [[nodiscard]] std::optional<EarlierKey> find_earlier(const Key& key) const;

  TomlTable top_;
  TomlTable table_;
  EarlierNames earlier_names_;
  std::string prefix_{};  ///< path of the open table, with a dot at its end
  std::string refused_because_{};
};

/// Reads the whole table of a file into a study that has a `describe` function. If earlier names of keys are refused, one error
/// gives the present names of all of them. @throws InputError
template <class Study>
void read_described(const TomlTable& table, Study& study,
                    StudyReader::EarlierNames earlier_names = StudyReader::EarlierNames::refused) {
  if (earlier_names == StudyReader::EarlierNames::refused) {
    refuse_earlier_names(table, [](StudyVisitor& visitor) {
      Study usual{};
      describe(visitor, usual);
    });
  }
  try {
    StudyReader reader(table, earlier_names);
    describe(reader, study);
  } catch (const std::bad_alloc&) {
    throw InputError(table.file().string() + ": needs more memory than there is");
  }
  table.finish();
}

}  // namespace menger::io
