#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/input_error.h"

namespace menger::io {

/// A file from which an interrupted run can be resumed. The file records which run it belongs to and shows whether it is whole.
class CheckpointFile {
 public:
  /// @param title first line of the file: its kind and the version of its layout
  /// @param identity text of everything that determines the results; a run can be resumed if the texts are equal
  CheckpointFile(std::filesystem::path file, std::string_view title, std::string_view identity);

  /// Writes the state of the run, whole or not at all. @throws InputError naming path and reason
  void write(std::string_view state) const;

  /// Returns the state of the run; nothing if there is no file.
  /// @throws InputError naming the file if it is of another version, belongs to another run or is damaged
  [[nodiscard]] std::optional<std::string> read() const;

  /// Returns the error for a state that cannot be read. @param reason "is of another build of menger"
  [[nodiscard]] InputError error(std::string_view reason) const;

 private:
  std::filesystem::path file_;
  std::string head_;  ///< the title and the hash of the identity
};

}  // namespace menger::io
