#include "io/text/toml_text.h"

#include "io/text/number_text.h"
#include "io/text/toml_document.h"

namespace menger::io {
namespace {

template <class Values>
std::string list_text(const Values& values) {
  std::string text = "[";
  for (const auto& value : values) text.append(text.size() > 1 ? ", " : "").append(toml_value_text(value));
  return text + "]";
}

}  // namespace

std::string toml_value_text(double value) { return number_text(value); }
std::string toml_value_text(bool value) { return value ? "true" : "false"; }
std::string toml_value_text(std::string_view value) { return toml_quoted(value); }
std::string toml_value_text(std::span<const double> values) { return list_text(values); }
std::string toml_value_text(std::span<const std::int64_t> values) { return list_text(values); }

std::string toml_value_text(std::span<const std::string> values) {
  return list_text(std::vector<std::string_view>(values.begin(), values.end()));
}

std::string toml_value_text(std::span<const std::vector<std::string>> rows) { return list_text(rows); }

TomlText& TomlText::line(std::string_view text) { return lines(std::string(text) + "\n"); }

TomlText& TomlText::lines(std::string_view text) {
  text_.append(text);
  return *this;
}

}  // namespace menger::io
