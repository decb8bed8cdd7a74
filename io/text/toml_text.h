#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// Returns a value as TOML. Numbers are exact: they read back as the same double.
std::string toml_value_text(double value);
std::string toml_value_text(bool value);
std::string toml_value_text(std::string_view value);
inline std::string toml_value_text(const char* value) { return toml_value_text(std::string_view(value)); }
template <std::integral Integer>
std::string toml_value_text(Integer value) {
  return std::to_string(value);
}
std::string toml_value_text(std::span<const double> values);
std::string toml_value_text(std::span<const std::int64_t> values);
std::string toml_value_text(std::span<const std::string> values);
std::string toml_value_text(std::span<const std::vector<std::string>> rows);

/// Builds a TOML text line by line, one `key = value` per line. It is the common writer of settings and results.
class TomlText {
 public:
  /// Begins a table. @param name the full name: "material.law"
  TomlText& table(std::string_view name) { return line("[" + std::string(name) + "]"); }
  /// Begins an entry of an array of tables.
  TomlText& entry(std::string_view name) { return line("[[" + std::string(name) + "]]"); }

  /// Adds a key with a number, a boolean, a text or a list.
  template <class Value>
  TomlText& add(std::string_view key, const Value& value) {
    return raw(key, toml_value_text(value));
  }
  /// Adds a key with a value that is already TOML.
  TomlText& raw(std::string_view key, std::string_view value) { return line(std::string(key) + " = " + std::string(value)); }
  TomlText& comment(std::string_view text) { return line("# " + std::string(text)); }
  TomlText& line(std::string_view text);
  /// Adds whole lines that were made elsewhere.
  TomlText& lines(std::string_view text);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace menger::io
