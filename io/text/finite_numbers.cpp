#include "io/text/finite_numbers.h"

#include <toml++/toml.h>

#include <cmath>
#include <string>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

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

void require_finite_numbers(const std::filesystem::path& file) {
  const std::string text = read_whole(file);
  static_cast<void>(parse_toml(text, file));  // tells what is no TOML
  require_finite(file, toml::parse(text, file.string()), "");
}

}  // namespace menger::io
