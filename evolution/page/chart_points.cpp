#include "evolution/page/chart_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/picture/chart.h"

namespace menger::evolution {
namespace {

bool is_gap(const PageSeries& series, std::size_t n) { return !std::isfinite(series.x[n]) || !std::isfinite(series.y[n]); }

/// The numbers of the points that stay.
std::vector<std::size_t> kept_points(const PageSeries& series) {
  const std::size_t count = series.y.size();
  constexpr std::size_t stretches = (most_chart_points - 2) / 3;
  std::set<std::size_t> kept{0, count - 1};
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * count / stretches;
    const std::size_t end = (s + 1) * count / stretches;
    std::size_t lowest = end;
    std::size_t highest = end;
    std::size_t gap = end;
    for (std::size_t n = begin; n < end; ++n) {
      if (is_gap(series, n)) {
        gap = std::min(gap, n);
        continue;
      }
      if (lowest == end || series.y[n] < series.y[lowest]) lowest = n;
      if (highest == end || series.y[n] > series.y[highest]) highest = n;
    }
    for (const std::size_t n : {lowest, highest, gap})
      if (n < end) kept.insert(n);
  }
  return {kept.begin(), kept.end()};
}

template <class Value>
void keep_some(std::vector<Value>& values, const std::vector<std::size_t>& kept) {
  if (values.empty()) return;
  std::vector<Value> some;
  some.reserve(kept.size());
  for (const std::size_t n : kept) some.push_back(values[n]);
  values = std::move(some);
}

}  // namespace

void join_equal_series(PageChart& chart) {
  std::array<double, 2> lowest{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  std::array<double, 2> highest{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (const PageSeries& series : chart.series) {
    for (const std::size_t axis : {0U, 1U}) {
      for (const double value : axis == 0 ? series.x : series.y) {
        if (!std::isfinite(value)) continue;
        lowest.at(axis) = std::min(lowest.at(axis), value);
        highest.at(axis) = std::max(highest.at(axis), value);
      }
    }
  }
  if (chart.x.logarithmic || chart.y.logarithmic) return;  // there a share of the range says nothing
  const auto is_hidden_by = [&](const PageSeries& one, const PageSeries& other) {
    return one.marks == other.marks && one.dashed == other.dashed && one.marks != PageMarks::points && one.labels.empty() &&
           other.labels.empty() && io::look_alike(one.x, other.x, highest[0] - lowest[0]) &&
           io::look_alike(one.y, other.y, highest[1] - lowest[1]);
  };
  std::vector<PageSeries> kept;
  for (PageSeries& series : chart.series) {
    const auto same = std::ranges::find_if(kept, [&](const PageSeries& other) { return is_hidden_by(series, other); });
    if (same == kept.end()) {
      kept.push_back(std::move(series));
      continue;
    }
    same->name += ", " + series.name;
    if (same->material != series.material) same->material = 0;
  }
  chart.series = std::move(kept);
}

void thin_series(PageChart& chart) {
  std::size_t longest = 0;
  for (PageSeries& series : chart.series) {
    if (series.y.size() <= most_chart_points) continue;
    longest = std::max(longest, series.y.size());
    const std::vector<std::size_t> kept = kept_points(series);
    keep_some(series.x, kept);
    keep_some(series.y, kept);
    keep_some(series.labels, kept);
  }
  if (longest == 0) return;
  if (!chart.note.empty()) chart.note += " ";
  chart.note += "Of long tables (up to " + std::to_string(longest) + " rows here), at most " + std::to_string(most_chart_points) +
                " rows are drawn, with the lowest and the highest values among them.";
}

}  // namespace menger::evolution
