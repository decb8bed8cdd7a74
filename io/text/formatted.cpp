#include "io/text/formatted.h"

#include <cstddef>
#include <cstdio>

namespace menger::io {

std::string formatted(const char* format, double value) {
  const int length = std::snprintf(nullptr, 0, format, value);
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  std::snprintf(text.data(), text.size(), format, value);
  text.pop_back();  // the null that ends it
  return text;
}

}  // namespace menger::io
