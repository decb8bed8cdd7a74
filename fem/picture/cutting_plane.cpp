#include "fem/picture/cutting_plane.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace menger::fem {
namespace {

/// Returns the planes between which boxes lie, along one axis; of very many, some.
std::vector<double> planes_along(std::size_t axis, const std::vector<ElementBox>& elements) {
  constexpr std::size_t most = 400;
  std::vector<double> all;
  for (const auto& [low, high] : elements) {
    all.push_back(low[axis]);
    all.push_back(high[axis]);
  }
  std::ranges::sort(all);
  const double length = all.back() - all.front();
  const auto apart_by = [&](double step) {
    std::vector<double> planes{all.front()};
    for (const double plane : all) {
      if (plane - planes.back() > step) planes.push_back(plane);
    }
    return planes;
  };
  std::vector<double> planes = apart_by(1e-6 * length);
  return planes.size() <= most ? planes : apart_by(length / most);
}

/// Where a body has silicone, on the grid of the planes of its mesh.
class SiliconeGrid {
 public:
  explicit SiliconeGrid(const std::vector<ElementBox>& elements) {
    for (std::size_t axis = 0; axis < 3; ++axis) planes_[axis] = planes_along(axis, elements);
    is_silicone_.assign(count(0) * count(1) * count(2), 0);
    for (const auto& [low, high] : elements) {
      std::array<std::size_t, 3> first{};
      std::array<std::size_t, 3> last{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = nearest(axis, low[axis]);
        last[axis] = nearest(axis, high[axis]);
      }
      for (std::size_t k = first[2]; k < last[2]; ++k) {
        for (std::size_t j = first[1]; j < last[1]; ++j) {
          for (std::size_t i = first[0]; i < last[0]; ++i) is_silicone_[place({i, j, k})] = 1;
        }
      }
    }
  }

  [[nodiscard]] std::size_t count(std::size_t axis) const { return planes_[axis].size() - 1; }
  [[nodiscard]] double low(std::size_t axis, std::size_t n) const { return planes_[axis][n]; }
  [[nodiscard]] double high(std::size_t axis, std::size_t n) const { return planes_[axis][n + 1]; }
  [[nodiscard]] double size(std::size_t axis, std::size_t n) const { return high(axis, n) - low(axis, n); }
  [[nodiscard]] bool has(const std::array<std::size_t, 3>& at) const { return is_silicone_[place(at)] != 0; }

 private:
  [[nodiscard]] std::size_t place(const std::array<std::size_t, 3>& at) const {
    return at[0] + count(0) * (at[1] + count(1) * at[2]);
  }
  [[nodiscard]] std::size_t nearest(std::size_t axis, double x) const {
    const std::vector<double>& planes = planes_[axis];
    const auto above = std::ranges::lower_bound(planes, x);
    if (above == planes.begin()) return 0;
    if (above == planes.end()) return planes.size() - 1;
    const auto n = static_cast<std::size_t>(above - planes.begin());
    return planes[n] - x < x - planes[n - 1] ? n : n - 1;
  }

  std::array<std::vector<double>, 3> planes_;
  std::vector<char> is_silicone_;
};

/// A square of a layer of a grid, by its numbers along both sides of the layer.
struct Square {
  std::size_t u;
  std::size_t v;
};

/// Visits the squares of a layer of nu x nv that are connected with one of them and belong to them, and marks each as visited.
template <class Belongs, class Visit>
void visit_connected(Square begin, std::size_t nu, std::size_t nv, std::vector<char>& visited, Belongs belongs, Visit visit) {
  std::vector<Square> open{begin};
  visited[begin.u + nu * begin.v] = 1;
  const auto reach = [&](std::size_t u, std::size_t v) {
    if (visited[u + nu * v] != 0 || !belongs(Square{u, v})) return;
    visited[u + nu * v] = 1;
    open.push_back({u, v});
  };
  while (!open.empty()) {
    const Square at = open.back();
    open.pop_back();
    visit(at);
    if (at.u > 0) reach(at.u - 1, at.v);
    if (at.u + 1 < nu) reach(at.u + 1, at.v);
    if (at.v > 0) reach(at.u, at.v - 1);
    if (at.v + 1 < nv) reach(at.u, at.v + 1);
  }
}

/// Returns the area, m2, that silicone encloses in a layer across y.
double hollow_area(const SiliconeGrid& grid, std::size_t j) {
  const std::size_t nx = grid.count(0);
  const std::size_t nz = grid.count(2);
  std::vector<char> visited(nx * nz, 0);
  double area = 0.0;
  const auto is_hollow = [&](Square at) { return !grid.has({at.u, j, at.v}); };
  for (std::size_t v = 0; v < nz; ++v) {
    for (std::size_t u = 0; u < nx; ++u) {
      if (visited[u + nx * v] != 0 || !is_hollow({u, v})) continue;
      double part = 0.0;
      bool is_enclosed = true;
      visit_connected({u, v}, nx, nz, visited, is_hollow, [&](Square at) {
        part += grid.size(0, at.u) * grid.size(2, at.v);
        is_enclosed = is_enclosed && at.u > 0 && at.v > 0 && at.u + 1 < nx && at.v + 1 < nz;
      });
      if (is_enclosed) area += part;
    }
  }
  return area;
}

/// A part of a layer that hangs together.
struct LayerPart {
  double front = 0.0;      ///< its least depth y, m
  double back = 0.0;       ///< its largest, m
  double thickness = 0.0;  ///< of the layer, m
};

/// Appends the parts of the layers across an axis, x or z.
void add_parts(std::size_t axis, const SiliconeGrid& grid, std::vector<LayerPart>& parts) {
  const std::size_t other = 2 - axis;
  const std::size_t nu = grid.count(other);
  const std::size_t ny = grid.count(1);
  for (std::size_t layer = 0; layer < grid.count(axis); ++layer) {
    const auto belongs = [&](Square at) {
      std::array<std::size_t, 3> place{0, at.v, 0};
      place[axis] = layer;
      place[other] = at.u;
      return grid.has(place);
    };
    std::vector<char> visited(nu * ny, 0);
    for (std::size_t v = 0; v < ny; ++v) {
      for (std::size_t u = 0; u < nu; ++u) {
        if (visited[u + nu * v] != 0 || !belongs({u, v})) continue;
        LayerPart part{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), grid.size(axis, layer)};
        visit_connected({u, v}, nu, ny, visited, belongs, [&](Square at) {
          part.front = std::min(part.front, grid.low(1, at.v));
          part.back = std::max(part.back, grid.high(1, at.v));
        });
        parts.push_back(part);
      }
    }
  }
}

/// Returns over which thickness of layers a plane takes limbs away, m.
double lost_thickness(double depth, const std::vector<LayerPart>& parts) {
  constexpr double largest_share = 0.6;
  double lost = 0.0;
  for (const LayerPart& part : parts) {
    if (depth > part.front + largest_share * (part.back - part.front)) lost += part.thickness;
  }
  return lost;
}

}  // namespace

double cutting_depth(const std::vector<ElementBox>& elements) {
  assert(!elements.empty());
  constexpr double least_opened = 0.5;
  const SiliconeGrid grid(elements);
  std::vector<LayerPart> parts;
  add_parts(0, grid, parts);
  add_parts(2, grid, parts);
  const std::size_t layers = grid.count(1);
  std::vector<double> areas(layers);
  for (std::size_t j = 0; j < layers; ++j) areas[j] = hollow_area(grid, j);
  const double enough = least_opened * *std::ranges::max_element(areas);

  const double front = grid.low(1, 0);
  const double back = grid.high(1, layers - 1);
  const double middle = 0.5 * (front + back);
  const double close = 1e-6 * (back - front);  // lengths that differ by less are the same
  double best = middle;
  double least_lost = std::numeric_limits<double>::max();
  double nearest = std::numeric_limits<double>::max();
  const auto try_depth = [&](double depth) {
    const double lost = lost_thickness(depth, parts);
    const double away = std::abs(depth - middle);
    if (lost > least_lost + close || (lost > least_lost - close && away >= nearest - close)) return;
    best = depth;
    least_lost = lost;
    nearest = away;
  };
  for (std::size_t j = 0; j < layers; ++j) {
    if (areas[j] < enough) continue;
    if (grid.low(1, j) <= middle + close && middle <= grid.high(1, j) + close) try_depth(middle);
    try_depth(0.5 * (grid.low(1, j) + grid.high(1, j)));
  }
  return best;
}

}  // namespace menger::fem
