#pragma once

#include <string>

#include "io/text/input_error.h"

namespace menger::fem {

/// Thrown for a walk that cannot be made as it was stated. Its key is that of the studies of `menger locomote`, so that a reader
/// of a file can say where it stands.
class WalkInputError : public io::InputError {
 public:
  /// @param key with the table that it is in: "ground.height_m"; or a table alone: "design"
  WalkInputError(std::string key, std::string reason)
      : io::InputError(key + ": " + reason), key_(std::move(key)), reason_(std::move(reason)) {}

  [[nodiscard]] const std::string& key() const { return key_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string key_;
  std::string reason_;
};

}  // namespace menger::fem
