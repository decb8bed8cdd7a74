#include "io/picture/chart_scale.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "io/text/formatted.h"

namespace menger::io {
namespace {

constexpr double margin = 0.04;       // of the span of the data, on either side
constexpr double near_zero = 0.3;     // data that begin within this part of their largest value are shown from zero on
constexpr double rounding = 1e-9;     // of a step, by which a tick may lie outside; of a value, below which a span counts as zero
constexpr int most_decades = 8;       // with a label each
constexpr int most_fine_decades = 5;  // with small ticks between

/// Returns the distance of ticks: 1, 2 or 5 times a power of ten, so that about six ticks fit in the span.
double step_of(double span) {
  const double rough = span / 6.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough) + rounding));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (rough <= step * decade * (1.0 + rounding)) return step * decade;
  }
  return 10.0 * decade;
}

std::vector<ChartTick> linear_ticks(double low, double high) {
  const double step = step_of(high - low);
  const double largest = std::max(std::abs(low), std::abs(high));
  const bool plain = largest < 1e6 && step >= 1e-4 * (1.0 - rounding);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + rounding)));
  const int digits = 1 + static_cast<int>(std::ceil(std::log10(largest / step)));
  std::vector<ChartTick> ticks;
  for (double i = std::ceil(low / step - rounding); i * step <= high + rounding * step; ++i) {
    const double at = i == 0.0 ? 0.0 : i * step;  // never -0
    ticks.push_back({at, plain ? formatted("%.*f", decimals, at) : formatted("%.*g", digits, at)});
  }
  return ticks;
}

bool is_shown(double at, double low, double high) { return at >= low - rounding && at <= high + rounding; }

std::vector<ChartTick> logarithmic_ticks(double low, double high) {
  const int first = static_cast<int>(std::floor(low + rounding));
  const int last = static_cast<int>(std::ceil(high - rounding));
  const int decades = last - first;
  const int stride = 1 + decades / most_decades;
  const bool few = std::floor(high + rounding) - std::ceil(low - rounding) < 1.0;
  std::vector<ChartTick> ticks;
  int labels = 0;
  for (int decade = first; decade <= last; ++decade) {
    for (int part = 1; part < 10; ++part) {
      const double at = decade + std::log10(part);
      if (!is_shown(at, low, high) || (part > 1 && decades > most_fine_decades)) continue;
      const bool named = part == 1 ? decade % stride == 0 : few && (part == 2 || part == 5);
      if (named) ++labels;
      ticks.push_back({at, named ? formatted("%.*g", 4, part * std::pow(10.0, decade)) : ""});
    }
  }
  if (labels >= 2) return ticks;
  ticks = linear_ticks(std::pow(10.0, low), std::pow(10.0, high));
  for (ChartTick& tick : ticks) tick.at = std::log10(tick.at);
  return ticks;
}

struct Range {
  double low = 0.0;
  double high = 1.0;
};

/// Returns the range of the coordinates of all finite values; 0 to 1 if there are none.
Range range_of(const std::vector<double>& values, const ChartScale& scale) {
  std::optional<Range> range;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    const double at = scale.coordinate(value);
    range = range ? Range{std::min(range->low, at), std::max(range->high, at)} : Range{at, at};
  }
  return range.value_or(Range{});
}

}  // namespace

double ChartScale::coordinate(double value) const {
  assert(!logarithmic || value > 0.0);
  return logarithmic ? std::log10(value) : value;
}

std::vector<ChartTick> ChartScale::ticks() const { return logarithmic ? logarithmic_ticks(low, high) : linear_ticks(low, high); }

ChartScale scale_of(const ChartAxis& axis, const std::vector<double>& values) {
  ChartScale scale{.logarithmic = axis.logarithmic};
  const Range data = range_of(values, scale);
  const double least_span = axis.logarithmic ? 0.0 : axis.least_span;
  // Data without a span, except for rounding, get a tenth of their value, or one unit about zero.
  double span = data.high - data.low;
  const double largest = std::max(std::abs(data.low), std::abs(data.high));
  if (span <= rounding * largest) span = axis.logarithmic || largest == 0.0 ? 1.0 : 0.1 * largest;

  const double middle = 0.5 * (data.low + data.high);
  const double half = 0.5 * std::max(span, least_span) + margin * span;
  scale.low = middle - half;
  scale.high = middle + half;
  if (!axis.logarithmic && data.high > 0.0 && data.low >= 0.0 && data.low <= near_zero * data.high) {
    scale.low = 0.0;
    scale.high = std::max((1.0 + margin) * data.high, least_span);
  } else if (!axis.logarithmic && data.low < 0.0 && data.high <= 0.0 && data.high >= near_zero * data.low) {
    scale.low = std::min((1.0 + margin) * data.low, -least_span);
    scale.high = 0.0;
  }
  if (axis.lowest) scale.low = scale.coordinate(*axis.lowest);
  if (axis.highest) scale.high = scale.coordinate(*axis.highest);
  // A given end may lie beyond the data, or too close to the other end.
  const double least = std::max(least_span, margin * span);
  if (axis.lowest && !axis.highest) scale.high = std::max(scale.high, scale.low + least);
  if (axis.highest && !axis.lowest) scale.low = std::min(scale.low, scale.high - least);
  assert(scale.low < scale.high);
  return scale;
}

void make_equal(ChartScale& x, ChartScale& y, double aspect) {
  assert(!x.logarithmic && !y.logarithmic);
  const double height = std::max(y.high - y.low, (x.high - x.low) / aspect);
  const auto widen = [](ChartScale& scale, double span) {
    const double middle = 0.5 * (scale.low + scale.high);
    scale.low = middle - 0.5 * span;
    scale.high = middle + 0.5 * span;
  };
  widen(x, aspect * height);
  widen(y, height);
}

}  // namespace menger::io
