#include "io/picture/path_panel.h"

#include <utility>

namespace menger::io {

ChartPanel path_panel(std::vector<double> x, std::vector<double> y) {
  ChartSeries start{.name = "start", .x = {x.front()}, .y = {y.front()}, .marks = Marks::points, .colour = chart_ink};
  ChartSeries end{.name = "end", .x = {x.back()}, .y = {y.back()}, .marks = Marks::points, .colour = chart_colour(1)};
  ChartSeries path{.x = std::move(x), .y = std::move(y), .colour = chart_colour(0)};
  return {.x = {.title = "path from above: x (body lengths)", .least_span = least_path_span},
          .y = {.title = "y (body lengths)", .least_span = least_path_span},
          .series = {std::move(start), std::move(end), std::move(path)},
          .equal_scale = true};
}

}  // namespace menger::io
