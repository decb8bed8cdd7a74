#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"

namespace menger::voxel {

/// A TOML table as text, one `key = value` per line, numbers exact.
class TableText {
 public:
  explicit TableText(std::string_view table) { text_.append("[").append(table).append("]\n"); }

  TableText& add(std::string_view key, std::string_view value) {
    text_.append(key).append(" = ").append(value).append("\n");
    return *this;
  }
  TableText& number(std::string_view key, double value) { return add(key, io::number_text(value)); }
  TableText& numbers(std::string_view key, std::span<const double> values) {
    std::string list;
    for (const double value : values) list.append(list.empty() ? "[" : ", ").append(io::number_text(value));
    return add(key, list.append("]"));
  }
  TableText& boolean(std::string_view key, bool value) { return add(key, value ? "true" : "false"); }
  TableText& word(std::string_view key, std::string_view value) { return add(key, io::toml_quoted(value)); }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace menger::voxel
