#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/input_error.h"

namespace menger::io {

/// A file from which an interrupted run goes on. It knows which run it belongs to and whether it is whole.
class CheckpointFile {
 public:
  /// @param title first line of the file: what it is, and the version of its layout
  /// @param identity text of all that decides the results: equal texts mean that the run can go on
  CheckpointFile(std::filesystem::path file, std::string_view title, std::string_view identity);

  /// Writes the state of the run, whole or not at all. @throws InputError naming path and reason
  void write(std::string_view state) const;

  /// The state; nothing if there is no file.
  /// @throws InputError naming the file if it is of another version, belongs to another run or is damaged
  [[nodiscard]] std::optional<std::string> read() const;

  /// The error for a state that cannot be understood. @param reason "is of another build of menger"
  [[nodiscard]] InputError error(std::string_view reason) const;

 private:
  std::filesystem::path file_;
  std::string head_;  ///< the title and the hash of the identity
};

}  // namespace menger::io
