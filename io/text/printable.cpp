#include "io/text/printable.h"

#include <algorithm>
#include <cstdint>

namespace menger::io {
namespace {

constexpr std::string_view digits = "0123456789ABCDEF";

/// Returns the length that the first byte of a character of UTF-8 announces; 0 if no character begins with this byte.
std::size_t announced_length(unsigned char first) {
  if (first < 0x80U) return 1;
  if (first >= 0xC2U && first <= 0xDFU) return 2;
  if (first >= 0xE0U && first <= 0xEFU) return 3;
  return first >= 0xF0U && first <= 0xF4U ? 4 : 0;
}

struct Character {
  std::size_t length = 0;  ///< bytes; 0: the text does not begin with a character of UTF-8
  std::uint32_t code = 0;
};

/// Reads the first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = announced_length(first);
  if (length == 0 || length > text.size()) return {};
  if (length == 1) return {1, first};
  std::uint32_t code = first & (0x7FU >> length);
  for (std::size_t n = 1; n < length; ++n) {
    const auto next = static_cast<unsigned char>(text[n]);
    if ((next & 0xC0U) != 0x80U) return {};
    code = code << 6U | (next & 0x3FU);
  }
  const bool is_overlong = (length == 3 && code < 0x800U) || (length == 4 && code < 0x10000U);
  const bool is_none = code > 0x10FFFFU || (code >= 0xD800U && code <= 0xDFFFU);
  if (is_overlong || is_none) return {};
  return {length, code};
}

bool is_shown(std::uint32_t code) {
  if (code == '\n' || code == '\t') return true;
  const bool is_control = code < 0x20U || (code >= 0x7FU && code <= 0x9FU);
  const bool is_line_break = code == 0x2028U || code == 0x2029U;
  const bool is_direction = code == 0x200EU || code == 0x200FU || (code >= 0x202AU && code <= 0x202EU) ||
                            (code >= 0x2066U && code <= 0x2069U) || code == 0x061CU;
  return !is_control && !is_line_break && !is_direction;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const auto [length, code] = first_character(text);
    if (length == 0) {
      const auto byte = static_cast<unsigned char>(text.front());
      shown.append("\\x").append(1, digits[byte >> 4U]).append(1, digits[byte & 15U]);
    } else if (is_shown(code)) {
      shown.append(text.substr(0, length));
    } else {
      shown.append("\\u");
      for (const unsigned shift : {12U, 8U, 4U, 0U}) shown += digits[code >> shift & 15U];
    }
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return shown;
}

std::size_t unfinished_bytes(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xC0U) == 0x80U) continue;
    return announced_length(byte) > back ? back : 0;
  }
  return 0;
}

}  // namespace menger::io
