#include "fem/statics/free_supports.h"

#include <algorithm>
#include <cassert>

namespace menger::fem {

std::vector<PointSupport> free_supports(const std::vector<Point>& nodes) {
  assert(!nodes.empty());
  Point low = nodes.front();
  Point high = nodes.front();
  for (const Point& node : nodes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], node[axis]);
      high[axis] = std::max(high[axis], node[axis]);
    }
  }
  const auto nearest = [&](const Point& corner) {
    return *std::min_element(nodes.begin(), nodes.end(), [&](const Point& a, const Point& b) {
      return norm(difference(a, corner)) < norm(difference(b, corner));
    });
  };
  return {{nearest(low), {true, true, true}},
          {nearest({high[0], low[1], low[2]}), {false, true, true}},
          {nearest({low[0], high[1], low[2]}), {false, false, true}}};
}

}  // namespace menger::fem
