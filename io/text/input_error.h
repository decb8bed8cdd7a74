#pragma once

#include <stdexcept>
#include <string>

namespace menger::io {

/// An error for wrong input from outside: a file, a key in it, a value or a command-line argument.
///
/// The message names file, key and wrong value. Programs print it and end with exit code 2. When it is thrown, nothing has been
/// overwritten.
class InputError : public std::runtime_error {
 public:
  /// @param message may hold text of the input as it is: what cannot be shown on a terminal is escaped here (io::printable)
  explicit InputError(const std::string& message);
};

}  // namespace menger::io
