#pragma once

#include <stdexcept>
#include <string>

namespace menger::io {

/// Wrong input from outside: a file, a key in it, a value, a command-line argument.
///
/// The message names file, key and offending value; programs print it and leave with exit code 2. Nothing has been written over
/// when it is thrown.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace menger::io
