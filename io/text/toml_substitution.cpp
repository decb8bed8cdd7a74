#include "io/text/toml_substitution.h"

#include <toml++/toml.h>

#include <cstddef>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_checks.h"

namespace menger::io {
namespace {

/// Returns the position at which a line begins. @param line counted from 1
std::size_t line_start(std::string_view text, std::size_t line) {
  std::size_t start = 0;
  for (std::size_t n = 1; n < line; ++n) start = text.find('\n', start) + 1;
  return start;
}

/// Returns the number of bytes before a column. @param column counted from 1 in characters of UTF-8
std::size_t bytes_before(std::string_view line, std::size_t column) {
  std::size_t at = 0;
  for (std::size_t n = 1; n < column; ++n) {
    ++at;
    while (at < line.size() && (static_cast<unsigned char>(line[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

}  // namespace

std::string with_number(std::string_view text, std::string_view key, double value, const std::filesystem::path& file) {
  const auto fault = [&](const std::string& reason) {
    return InputError(file.string() + ": " + std::string(key) + ": " + reason);
  };
  require_shallow_toml(text, file);
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw fault("the file is not TOML: " + std::string(error.description()));
  }
  const toml::node* node = &table;
  for (std::string_view rest = key; node != nullptr;) {
    const std::size_t dot = rest.find('.');
    node = node->is_table() ? node->as_table()->get(rest.substr(0, dot)) : nullptr;
    if (dot == std::string_view::npos) break;
    rest.remove_prefix(dot + 1);
  }
  if (node == nullptr) throw fault("the file does not contain this number");
  if (!node->is_number()) throw fault("must be a number");
  const toml::source_position begin = node->source().begin;
  const std::size_t first_of_line = line_start(text, begin.line);
  const std::size_t first = first_of_line + bytes_before(text.substr(first_of_line), begin.column);
  const std::size_t end = text.find_first_not_of("0123456789+-._eExXoObBaAcCdDfFinfINF", first);
  std::string result(text.substr(0, first));
  result += number_text(value);
  if (end != std::string_view::npos) result += text.substr(end);
  return result;
}

}  // namespace menger::io
