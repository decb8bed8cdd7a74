#pragma once

#include <string_view>

namespace menger::materials {

/// Whether a law is valid at a deformation.
enum class LawStatus {
  valid,
  inverted,                  ///< the volume ratio is not positive
  locking_stretch_exceeded,  ///< the deformation exceeds the limited extension of the chains of the law
};

/// Returns the word for a status: "valid", "inverted", "locking_stretch_exceeded".
constexpr std::string_view to_string(LawStatus status) {
  switch (status) {
    case LawStatus::valid:
      return "valid";
    case LawStatus::inverted:
      return "inverted";
    case LawStatus::locking_stretch_exceeded:
      return "locking_stretch_exceeded";
  }
  return "unknown";
}

}  // namespace menger::materials
