#include "io/text/toml_checks.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::io {
namespace {

constexpr std::size_t most_levels = 100;

/// Counts the levels of a TOML text from its signs alone: brackets and braces that are open, and the dots of the keys before
/// them. A number counts as a key with one dot, which does no harm.
class LevelCounter {
 public:
  explicit LevelCounter(std::string_view text) : text_(text) {}

  /// Returns the line on which the text becomes too deep; 0 if it does not.
  std::size_t line_of_fault() {
    while (position_ < text_.size()) {
      take_sign();
      if (levels_ > most_levels) return line();
    }
    return 0;
  }

 private:
  void take_sign() {
    switch (text_[position_]) {
      case '#':
        position_ = std::min(text_.find('\n', position_), text_.size());
        return;
      case '"':
      case '\'':
        return skip_string(text_[position_]);
      case '.':
        ++dots_.back();
        ++levels_;
        break;
      case '[':
      case '{':
        dots_.push_back(0);
        ++levels_;
        break;
      case ']':
      case '}':
        end_key();
        if (dots_.size() > 1) {
          dots_.pop_back();
          --levels_;
        }
        break;
      case ',':
      case '\n':
        end_key();
        break;
      default:
        break;
    }
    ++position_;
  }

  /// The next key begins at the level of the brackets that are open.
  void end_key() {
    levels_ -= dots_.back();
    dots_.back() = 0;
  }

  void skip_string(char quote) {
    const std::string whole(3, quote);
    const bool has_lines = text_.substr(position_).starts_with(whole);
    position_ += has_lines ? 3 : 1;
    while (position_ < text_.size()) {
      if (text_[position_] == '\\' && quote == '"') {
        position_ += 2;
      } else if (has_lines && text_.substr(position_).starts_with(whole)) {
        position_ += 3;
        while (position_ < text_.size() && text_[position_] == quote) ++position_;  // quotes that the string ends with
        return;
      } else if (!has_lines && text_[position_] == quote) {
        ++position_;
        return;
      } else if (!has_lines && text_[position_] == '\n') {
        return;  // no TOML: the parser stops here
      } else {
        ++position_;
      }
    }
    position_ = text_.size();
  }

  [[nodiscard]] std::size_t line() const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position_, text_.size()));
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
  }

  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t levels_ = 0;            ///< open brackets, and all dots that count
  std::vector<std::size_t> dots_{0};  ///< of the present key, for each bracket that is open
};

void require_finite(const std::filesystem::path& file, const toml::node& node, const std::string& name) {
  if (const auto* value = node.as_floating_point(); value != nullptr && !std::isfinite(value->get())) {
    throw InputError(file.string() + ":" + std::to_string(node.source().begin.line) + ": " + name + " = " +
                     number_text(value->get()) + ": must be a finite number");
  }
  if (const auto* table = node.as_table()) {
    for (const auto& [key, inner] : *table)
      require_finite(file, inner, (name.empty() ? "" : name + ".") + std::string(key.str()));
  }
  if (const auto* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) require_finite(file, (*array)[i], name + "[" + std::to_string(i + 1) + "]");
  }
}

}  // namespace

void require_shallow_toml(std::string_view text, const std::filesystem::path& file) {
  if (const std::size_t line = LevelCounter(text).line_of_fault(); line > 0) {
    throw InputError(file.string() + ":" + std::to_string(line) + ": keys, tables or arrays lie more than " +
                     std::to_string(most_levels) + " levels deep");
  }
}

void require_finite_numbers(std::string_view text, const std::filesystem::path& file) {
  require_finite(file, toml::parse(text, file.string()), "");
}

}  // namespace menger::io
