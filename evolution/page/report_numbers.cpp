#include "evolution/page/report_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "io/text/formatted.h"

namespace menger::evolution {
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

std::string shown_number(double value) { return io::shown(value, 3); }

std::string shown_number(const std::optional<double>& value) { return value ? shown_number(*value) : "\u2013"; }

std::string shown_whole(double value) { return io::formatted("%.0f", std::round(value) + 0.0); }

std::string shown_percent(double fraction) { return io::shown(100.0 * fraction, std::abs(fraction) < 1.0 ? 2 : 3) + " %"; }

std::string shown_pressure(double pressure_Pa) { return io::shown(1e-3 * pressure_Pa, 3) + " kPa"; }

std::string text_in(const io::CsvContents& table, std::size_t row, std::string_view column) {
  return table.has(column) ? table.text(row, column) : std::string();
}

std::optional<double> number_in(const io::CsvContents& table, std::size_t row, std::string_view column) {
  const std::string text = text_in(table, row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<double> column_of(const io::CsvContents& table, std::string_view column, double factor) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.row_count(); ++row)
    values.push_back(factor * number_in(table, row, column).value_or(std::numeric_limits<double>::quiet_NaN()));
  return values;
}

std::optional<double> median_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

ShownColumn shown_column(const std::string& name) {
  for (const UnitOfName& known : units_of_names) {
    if (name == known.ending.substr(1)) return {name, std::string(known.unit), known.factor};
    if (!name.ends_with(known.ending)) continue;
    const std::string_view quantity = std::string_view(name).substr(0, name.size() - known.ending.size());
    return {name, spaced(quantity) + " (" + std::string(known.unit) + ")", known.factor};
  }
  return {name, spaced(name), 1.0};
}

std::string shown_cell(const io::CsvContents& table, std::size_t row, const ShownColumn& column) {
  constexpr std::size_t most_digits = 12;  // more without a point are no count: a body's digits
  std::string text = text_in(table, row, column.name);
  if (text.size() > most_digits && text.find('.') == std::string::npos) return text;
  if (const std::optional<double> value = number_in(table, row, column.name)) {
    const double shown = *value * column.factor;
    // Counts keep all their digits.
    if (shown == std::round(shown) && std::abs(shown) < 1e9) return io::formatted("%.0f", shown);
    return io::shown(shown, 4);
  }
  return text;
}

}  // namespace menger::evolution
