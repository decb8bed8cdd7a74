#include "fem/statics/nodal_fields.h"

#include <algorithm>
#include <functional>

#include "fem/surfaces/face.h"

namespace menger::fem {
namespace {

/// The values, at the nodes of an edge of an element, of the polynomials that are 1 at one point of Gauss's rule and 0 at the
/// others. One row per node, one column per point.
template <std::size_t m>
constexpr std::array<std::array<double, m>, m> extrapolation() {
  constexpr auto rule = gauss_rule<m>();
  std::array<std::array<double, m>, m> values{};
  for (std::size_t node = 0; node < m; ++node) {
    const double s = static_cast<double>(node) / static_cast<double>(m - 1);
    for (std::size_t q = 0; q < m; ++q) {
      double value = 1.0;
      for (std::size_t r = 0; r < m; ++r) {
        if (r != q) value *= (s - rule[r].position) / (rule[q].position - rule[r].position);
      }
      values[node][q] = value;
    }
  }
  return values;
}

constexpr std::size_t component_count = 15;  // F, sigma

/// Extrapolates one element's values from its quadrature points to its nodes, both in lexicographic order.
template <std::size_t m>
void add_element(std::span<const Index> nodes, const std::function<double(std::size_t point, std::size_t component)>& value,
                 std::vector<std::vector<double>>& sums) {
  static constexpr auto table = extrapolation<m>();
  for (std::size_t a = 0; a < m * m * m; ++a) {
    const std::array<std::size_t, 3> i{a % m, a / m % m, a / (m * m)};
    for (std::size_t q = 0; q < m * m * m; ++q) {
      const double weight = table[i[0]][q % m] * table[i[1]][q / m % m] * table[i[2]][q / (m * m)];
      for (std::size_t c = 0; c < component_count; ++c)
        sums[c / 3][3 * static_cast<std::size_t>(nodes[a]) + c % 3] += weight * value(q, c);
    }
    // The last group of three has room for the number of elements.
    sums[component_count / 3][3 * static_cast<std::size_t>(nodes[a]) + component_count % 3] += 1.0;
  }
}

constexpr std::array<std::size_t, 6> symmetric_places{0, 4, 8, 1, 5, 2};  // xx, yy, zz, xy, yz, xz in a row-by-row tensor

std::vector<ElementState> element_states(const Space& space, const Body& body, std::span<const double> displacements) {
  const std::size_t count = space.nodes_per_element();
  std::vector<double> positions(3 * count);
  std::vector<double> moved(3 * count);
  std::vector<ElementState> states;
  states.reserve(space.local_element_count());
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    for (std::size_t a = 0; a < count; ++a) {
      const auto node = static_cast<std::size_t>(space.element_nodes[e * count + a]);
      for (std::size_t i = 0; i < 3; ++i) {
        positions[3 * a + i] = space.positions[node][i];
        moved[3 * a + i] = displacements[3 * node + i];
      }
    }
    states.push_back(element_state(body.regions[space.element_regions[e]].law, mean_deformation(space.degree, positions, moved)));
  }
  return states;
}

}  // namespace

NodalFields nodal_fields(Assembly& assembly, std::span<const double> displacements, std::span<const double> plenum_pressures_Pa) {
  const Space& space = assembly.space();
  const std::size_t count = space.positions.size();
  // The exchange transfers three numbers per node.
  std::vector<std::vector<double>> sums(component_count / 3 + 1, std::vector<double>(3 * count, 0.0));
  const auto add_points = [&](const PointResult& points) {
    const auto nodes =
        std::span(space.element_nodes).subspan(points.element * space.nodes_per_element(), space.nodes_per_element());
    const auto value = [&](std::size_t q, std::size_t c) {
      if (c < 9) return points.deformation_gradient[9 * q + c];
      return points.cauchy_stress[9 * q + symmetric_places[c - 9]];
    };
    if (space.degree == 1) {
      add_element<2>(nodes, value, sums);
    } else {
      add_element<3>(nodes, value, sums);
    }
  };
  assembly.elements().evaluate_points(displacements, add_points, plenum_pressures_Pa);
  for (std::vector<double>& values : sums) {
    assembly.exchange().add_from_ghosts(values);
    assembly.exchange().update_ghosts(values);
  }
  NodalFields fields;
  fields.deformation_gradient.resize(count);
  fields.cauchy_stress.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double elements = std::max(1.0, sums[component_count / 3][3 * n + component_count % 3]);
    const auto mean = [&](std::size_t c) { return sums[c / 3][3 * n + c % 3] / elements; };
    for (std::size_t c = 0; c < 9; ++c) fields.deformation_gradient[n][c] = mean(c);
    for (std::size_t c = 0; c < 6; ++c) fields.cauchy_stress[n][c] = mean(9 + c);
  }
  fields.elements = element_states(space, assembly.body(), displacements);
  return fields;
}

}  // namespace menger::fem
