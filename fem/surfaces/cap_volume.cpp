#include "fem/surfaces/cap_volume.h"

#include <cassert>

namespace menger::fem {
namespace {

/// The terms of a segment's share of A: the sum of weight x_first x x_second over these pairs of its nodes.
struct AreaTerm {
  std::size_t first;
  std::size_t second;
  double weight;  ///< 1/2 int (L_first L_second' - L_second L_first') along the segment
};

template <std::size_t k>
constexpr auto area_terms() {
  if constexpr (k == 2) {
    return std::array<AreaTerm, 1>{{{0, 1, 0.5}}};
  } else {
    return std::array<AreaTerm, 3>{{{0, 1, 2.0 / 3.0}, {1, 2, 2.0 / 3.0}, {0, 2, -1.0 / 6.0}}};
  }
}

/// The integral of each L along the segment.
template <std::size_t k>
constexpr std::array<double, k> mean_weights() {
  if constexpr (k == 2) {
    return {0.5, 0.5};
  } else {
    return {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
  }
}

/// The quantities that V and its derivatives are computed from.
struct Fan {
  std::vector<Point> x;         ///< positions relative to the origin
  std::vector<double> weights;  ///< weights of the nodes in c
  Point c{};                    ///< relative to the origin
  Point area{};                 ///< A
  std::vector<Point> levers;    ///< l_a = sum_b w_ab x_b, so that dA = -sum_a l_a x dx_a
};

template <std::size_t k>
Fan fan_of(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin) {
  assert(!rim.segments.empty());
  Fan fan;
  fan.weights.assign(nodes.size(), 0.0);
  fan.levers.assign(nodes.size(), Point{});
  for (const Point& node : nodes) fan.x.push_back(difference(node, origin));
  const double share = 1.0 / static_cast<double>(rim.segments.size());
  for (const auto& segment : rim.segments) {
    for (std::size_t a = 0; a < k; ++a) {
      assert(segment[a] < nodes.size());
      fan.weights[segment[a]] += share * mean_weights<k>()[a];
    }
    for (const AreaTerm& term : area_terms<k>()) {
      const std::size_t a = segment[term.first];
      const std::size_t b = segment[term.second];
      fan.area = sum(fan.area, scaled(term.weight, cross(fan.x[a], fan.x[b])));
      fan.levers[a] = sum(fan.levers[a], scaled(term.weight, fan.x[b]));
      fan.levers[b] = difference(fan.levers[b], scaled(term.weight, fan.x[a]));
    }
  }
  for (std::size_t a = 0; a < nodes.size(); ++a) fan.c = sum(fan.c, scaled(fan.weights[a], fan.x[a]));
  for (std::size_t i = 0; i < 3; ++i)
    if (rim.mirrored[i]) fan.c[i] = 0.0;
  return fan;
}

/// Component (i, j) of the matrix that maps v to v x p.
double crossing(const Point& p, std::size_t i, std::size_t j) {
  if (i == j) return 0.0;
  const std::size_t k = 3 - i - j;
  return (i + 1) % 3 == j ? p[k] : -p[k];
}

}  // namespace

template <std::size_t k>
double cap_volume(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin) {
  const Fan fan = fan_of(rim, nodes, origin);
  return dot(fan.c, fan.area) / 3.0;
}

template <std::size_t k>
std::vector<double> cap_volume_gradient(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin) {
  const Fan fan = fan_of(rim, nodes, origin);
  std::vector<double> gradient(3 * nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const Point turned = cross(fan.levers[a], fan.c);
    for (std::size_t i = 0; i < 3; ++i) {
      const double from_centre = rim.mirrored[i] ? 0.0 : fan.weights[a] * fan.area[i];
      gradient[3 * a + i] = (from_centre + turned[i]) / 3.0;
    }
  }
  return gradient;
}

template <std::size_t k>
std::vector<double> cap_volume_hessian(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin) {
  const Fan fan = fan_of(rim, nodes, origin);
  const std::size_t size = 3 * nodes.size();
  std::vector<double> hessian(size * size);
  const auto entry = [&](std::size_t a, std::size_t i, std::size_t b, std::size_t j) -> double& {
    return hessian[(3 * a + i) * size + 3 * b + j];
  };
  // dV/dx_a contains A, which depends on every lever, and c, which depends on every node.
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          const double from_area = rim.mirrored[i] ? 0.0 : fan.weights[a] * crossing(fan.levers[b], i, j);
          const double from_centre = rim.mirrored[j] ? 0.0 : fan.weights[b] * crossing(fan.levers[a], j, i);
          entry(a, i, b, j) = (from_area + from_centre) / 3.0;
        }
      }
    }
  }
  // It also contains the levers of the segment's nodes.
  for (const auto& segment : rim.segments) {
    for (const AreaTerm& term : area_terms<k>()) {
      const std::size_t a = segment[term.first];
      const std::size_t b = segment[term.second];
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          const double value = term.weight * crossing(fan.c, i, j) / 3.0;
          entry(a, i, b, j) += value;
          entry(b, j, a, i) += value;
        }
      }
    }
  }
  return hessian;
}

template double cap_volume(const Rim<2>&, std::span<const Point>, const Point&);
template double cap_volume(const Rim<3>&, std::span<const Point>, const Point&);
template std::vector<double> cap_volume_gradient(const Rim<2>&, std::span<const Point>, const Point&);
template std::vector<double> cap_volume_gradient(const Rim<3>&, std::span<const Point>, const Point&);
template std::vector<double> cap_volume_hessian(const Rim<2>&, std::span<const Point>, const Point&);
template std::vector<double> cap_volume_hessian(const Rim<3>&, std::span<const Point>, const Point&);

}  // namespace menger::fem
