#include "evolution/outputs/report_numbers.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "io/text/formatted.h"

namespace menger::evolution {

std::string shown_number(double value) {
  // Three digits of such numbers would need a power of ten.
  constexpr double least_whole = 1e3;
  constexpr double largest_whole = 1e7;
  const double size = std::abs(value);
  return size >= least_whole && size < largest_whole ? io::formatted("%.0f", value) : io::shown(value, 3);
}

std::string shown_number(const std::optional<double>& value) { return value ? shown_number(*value) : "\u2013"; }

std::string shown_whole(double value) { return io::formatted("%.0f", std::round(value) + 0.0); }

std::string with_rounded_numbers(const std::string& text) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::size_t least_decimals = 7;
  const auto is_of_word = [](char c) { return (std::isalnum(static_cast<unsigned char>(c)) != 0) || c == '_' || c == '.'; };
  std::string rounded;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789.", at), text.size());
    const std::size_t point = text.find('.', at);
    const bool begins = end > at && digits.find(text[at]) != std::string_view::npos && (at == 0 || !is_of_word(text[at - 1]));
    const bool is_number = begins && point < end && text.find('.', point + 1) >= end && end - point > least_decimals &&
                           (end == text.size() || !is_of_word(text[end]));
    double value = 0.0;
    if (is_number) std::from_chars(text.data() + at, text.data() + end, value);
    const std::size_t next = std::max(end, at + 1);
    rounded += is_number ? (value < 1e4 ? io::shown(value, 4) : io::formatted("%.0f", value)) : text.substr(at, next - at);
    at = next;
  }
  return rounded;
}

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

std::vector<double> progress_of(const io::CsvContents& trajectory, const std::optional<std::array<double, 2>>& direction) {
  const std::vector<double> x_m = column_of(trajectory, "centre_of_mass_x_m");
  const std::vector<double> y_m = column_of(trajectory, "centre_of_mass_y_m");
  std::vector<double> progress(x_m.size(), std::numeric_limits<double>::quiet_NaN());
  const auto is_known = [&](std::size_t row) { return std::isfinite(x_m[row]) && std::isfinite(y_m[row]); };
  std::size_t last = x_m.size();
  while (last > 0 && !is_known(last - 1)) --last;
  if (last == 0) return progress;
  const double along_x = direction ? (*direction)[0] : x_m[last - 1] - x_m[0];
  const double along_y = direction ? (*direction)[1] : y_m[last - 1] - y_m[0];
  const double length = std::hypot(along_x, along_y);
  for (std::size_t row = 0; row < progress.size(); ++row)
    if (is_known(row))
      progress[row] = length > 0.0 ? ((x_m[row] - x_m[0]) * along_x + (y_m[row] - y_m[0]) * along_y) / length : 0.0;
  return progress;
}

std::vector<double> distance_from_start(const io::CsvContents& trajectory) {
  std::vector<double> distance = column_of(trajectory, "centre_of_mass_x_m");
  const std::vector<double> y_m = column_of(trajectory, "centre_of_mass_y_m");
  const double first_x_m = distance.empty() ? 0.0 : distance.front();
  for (std::size_t row = 0; row < distance.size(); ++row)
    distance[row] = std::hypot(distance[row] - first_x_m, y_m[row] - y_m.front());
  return distance;
}

double largest_retreat(const std::vector<double>& progress) {
  double furthest = std::numeric_limits<double>::lowest();
  double retreat = 0.0;
  for (const double at : progress) {
    if (!std::isfinite(at)) continue;
    furthest = std::max(furthest, at);
    retreat = std::max(retreat, furthest - at);
  }
  return retreat;
}

std::optional<double> median_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

std::string shown_cell(const io::CsvContents& table, std::size_t row, const io::ShownColumn& column) {
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
