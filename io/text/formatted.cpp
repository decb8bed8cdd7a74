#include "io/text/formatted.h"

#include <cctype>

namespace menger::io {

std::string shown(double value, int digits) { return formatted(("%." + std::to_string(digits) + "g").c_str(), value); }

std::string counted(std::size_t number, std::string_view one, std::string_view many) {
  const std::string text = std::to_string(number) + " ";
  if (number == 1) return text + std::string(one);
  return text + (many.empty() ? std::string(one) + "s" : std::string(many));
}

std::string padded(std::size_t number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

std::string column_part(std::string name) {
  for (char& sign : name) {
    if (std::isalnum(static_cast<unsigned char>(sign)) == 0) sign = '_';
  }
  return name;
}

}  // namespace menger::io
