#include "io/shown/shown_column.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

namespace menger::io {
namespace {

/// A unit at the end of the name of a column, and how people read it.
struct UnitOfName {
  std::string_view ending;
  std::string_view unit;
  double factor;
};

// The longest that fits comes first.
constexpr std::array units_of_names{
    UnitOfName{"_body_lengths_per_minute", "body lengths / min", 1.0},
    UnitOfName{"_kg_per_m3", "kg/m\u00b3", 1.0},
    UnitOfName{"_m_per_s", "mm/s", 1e3},
    UnitOfName{"_body_lengths", "body lengths", 1.0},
    UnitOfName{"_per_Pa", "1/kPa", 1e3},
    UnitOfName{"_seconds", "s", 1.0},
    UnitOfName{"_N_per_m", "N/m", 1.0},
    UnitOfName{"_N_m", "N mm", 1e3},
    UnitOfName{"_deg", "degrees", 1.0},
    UnitOfName{"_rad", "degrees", 180.0 / std::numbers::pi},
    UnitOfName{"_m3", "cm\u00b3", 1e6},
    UnitOfName{"_Pa", "kPa", 1e-3},
    UnitOfName{"_Hz", "Hz", 1.0},
    UnitOfName{"_MB", "MB", 1.0},
    UnitOfName{"_mm", "mm", 1.0},
    UnitOfName{"_J", "mJ", 1e3},
    UnitOfName{"_N", "N", 1.0},
    UnitOfName{"_m", "mm", 1e3},
    UnitOfName{"_s", "s", 1.0},
};

std::string spaced(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, '_', ' ');
  return text;
}

}  // namespace

std::string ShownColumn::title() const {
  if (unit.empty()) return quantity;
  return quantity.empty() ? unit : quantity + " (" + unit + ")";
}

ShownColumn shown_column(const std::string& name) {
  if (name.ends_with("volume_change")) return {name, spaced(name), "%", 100.0};
  for (const UnitOfName& known : units_of_names) {
    if (name == known.ending.substr(1)) return {name, "", std::string(known.unit), known.factor};
    if (!name.ends_with(known.ending)) continue;
    const std::string_view quantity = std::string_view(name).substr(0, name.size() - known.ending.size());
    return {name, spaced(quantity), std::string(known.unit), known.factor};
  }
  return {name, spaced(name), "", 1.0};
}

std::string displacement_words(const std::string& name) {
  for (const char axis : {'x', 'y', 'z'}) {
    if (name == std::string("extent_") + axis + "_m") return std::string("the extent along ") + axis;
  }
  return name == "top_m" ? "the height of the top" : shown_column(name).quantity;
}

}  // namespace menger::io
