#include "io/text/number_text.h"

#include <array>
#include <charconv>

namespace menger::io {

std::string number_text(double value) {
  std::array<char, 32> buffer{};  // the shortest form of a double needs at most 24 characters
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

}  // namespace menger::io
