#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "fem/thin_walls/thin_wall_kernel.h"

namespace menger::fem {

inline std::vector<materials::HyperelasticLaw> all_laws() {
  return {
      materials::NeoHookean{50e3},
      materials::MooneyRivlin{20e3, 5e3},
      materials::Yeoh{21e3, 2.5e3, 0.1e3},
      materials::Ogden<1>{{materials::OgdenTerm{25e3, 3.25}}},
      materials::Ogden<2>{{materials::OgdenTerm{60e3, 1.5}, materials::OgdenTerm{-2.5e3, -4.0}}},
      materials::Ogden<3>{{materials::OgdenTerm{10e3, 2.0}, materials::OgdenTerm{20e3, 1.3}, materials::OgdenTerm{-3e3, -2.5}}},
      materials::Gent{46e3, 20.0},
      materials::ArrudaBoyce{32e3, 1.6}};
}

/// Bulk modulus 50 times the shear modulus.
inline ThinWallMaterial silicone_of(const materials::HyperelasticLaw& law) {
  return {.law = law, .bulk_modulus_Pa = 50.0 * materials::shear_modulus_at_rest_Pa(law)};
}

inline constexpr std::array<ThinWallElement, 2> both_elements{ThinWallElement::wall, ThinWallElement::block};

inline std::string name_of(ThinWallElement element) { return element == ThinWallElement::wall ? "wall" : "block"; }

/// Reproducible numbers in [-amplitude, amplitude].
inline std::vector<double> random_values(std::size_t count, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> values(count);
  for (double& value : values)
    value = amplitude * (2.0 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1.0);
  return values;
}

inline double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

inline double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum;
}

inline std::vector<double> moved(std::vector<double> values, const std::vector<double>& direction, double step) {
  for (std::size_t n = 0; n < values.size(); ++n) values[n] += step * direction[n];
  return values;
}

/// Boxes between grid lines along x, y and z, all of one kind and with one normal.
struct Grid {
  std::array<std::vector<double>, 3> lines;
  std::size_t normal = 2;

  [[nodiscard]] std::size_t nodes_along(std::size_t axis) const { return lines[axis].size(); }
  [[nodiscard]] std::size_t node_count() const { return nodes_along(0) * nodes_along(1) * nodes_along(2); }
  [[nodiscard]] std::size_t node(const std::array<std::size_t, 3>& place) const {
    return place[0] + nodes_along(0) * (place[1] + nodes_along(1) * place[2]);
  }
  [[nodiscard]] std::array<std::size_t, 3> place(std::size_t node) const {
    return {node % nodes_along(0), node / nodes_along(0) % nodes_along(1), node / (nodes_along(0) * nodes_along(1))};
  }
  [[nodiscard]] std::array<double, 3> position(std::size_t node) const {
    const auto p = place(node);
    return {lines[0][p[0]], lines[1][p[1]], lines[2][p[2]]};
  }
  /// Whether a node lies on an end of an axis.
  [[nodiscard]] bool is_at_end(std::size_t node, std::size_t axis) const {
    const std::size_t n = place(node)[axis];
    return n == 0 || n + 1 == nodes_along(axis);
  }
  /// Displacements from a function of the position.
  template <class Field>
  [[nodiscard]] std::vector<double> displacements(const Field& field) const {
    std::vector<double> values;
    for (std::size_t n = 0; n < node_count(); ++n)
      for (const double component : field(position(n))) values.push_back(component);
    return values;
  }
};

/// One box of 3 x 2 x 1 in units of a millimetre, the last along the normal; its axes in a circle from there.
inline Grid one_box(std::size_t normal = 2, double unit_m = 1e-3) {
  Grid grid;
  grid.normal = normal;
  grid.lines[normal] = {0.0, unit_m};
  grid.lines[(normal + 1) % 3] = {0.0, 3.0 * unit_m};
  grid.lines[(normal + 2) % 3] = {0.0, 2.0 * unit_m};
  return grid;
}

/// A plate of equal elements of edge m, thick m, its middle at z = 0.
inline Grid plate(std::size_t elements, double edge, double thick) {
  Grid grid;
  for (std::size_t n = 0; n <= elements; ++n) {
    grid.lines[0].push_back(edge * static_cast<double>(n));
    grid.lines[1].push_back(edge * static_cast<double>(n));
  }
  grid.lines[2] = {-0.5 * thick, 0.5 * thick};
  return grid;
}

/// The elements of a grid as one kernel takes them.
template <class Number>
class Patch {
 public:
  using Numbers = std::vector<Number, xsimd::aligned_allocator<Number, 64>>;

  Patch(ThinWallKernels<Number> kernels, ThinWallElement element, const Grid& grid)
      : kernels_(std::move(kernels)), element_(element), node_count_(grid.node_count()) {
    std::vector<std::array<std::size_t, 3>> boxes;
    for (std::size_t k = 0; k + 1 < grid.nodes_along(2); ++k)
      for (std::size_t j = 0; j + 1 < grid.nodes_along(1); ++j)
        for (std::size_t i = 0; i + 1 < grid.nodes_along(0); ++i) boxes.push_back({i, j, k});
    count_ = boxes.size();
    const std::size_t width = kernels_.width;
    const std::size_t batches = (count_ + width - 1) / width;
    shapes_.resize(shape_numbers_per_lane * width * batches);
    pressures_.resize(batches, 0.0);
    volume_changes_.resize(batches, 0.0);
    normals_.assign(batches, static_cast<std::uint8_t>(grid.normal));
    for (std::size_t lane = 0; lane < width * batches; ++lane) {
      const std::array<std::size_t, 3>& box = boxes[std::min(lane, count_ - 1)];
      std::array<double, 3> edges{};
      for (std::size_t local = 0; local < 3; ++local) {
        const std::size_t axis = (grid.normal + 1 + local) % 3;
        edges[local] = grid.lines[axis][box[axis] + 1] - grid.lines[axis][box[axis]];
      }
      auto shape = shape_of(edges);
      if (lane >= count_) shape[3] = 0.0;
      for (std::size_t n = 0; n < shape.size(); ++n) shapes_[at(lane, shape.size(), n)] = static_cast<Number>(shape[n]);
      for (std::size_t c = 0; c < 8; ++c) {
        const std::size_t corner = global_corner(grid.normal, c);
        const std::size_t node = grid.node({box[0] + (corner & 1U), box[1] + (corner >> 1U & 1U), box[2] + (corner >> 2U & 1U)});
        nodes_.push_back(static_cast<std::uint32_t>(3 * node));
      }
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }

  /// Sets the pressures on both faces of all walls.
  void press(double first_Pa, double second_Pa) { pressures_.assign(pressures_.size(), 0.5 * (first_Pa + second_Pa)); }

  /// The change of the walls' volume at the last forces.
  [[nodiscard]] double volume_change_m3() const { return std::accumulate(volume_changes_.begin(), volume_changes_.end(), 0.0); }

  /// Forces of the elements on the nodes; the outcome is kept.
  [[nodiscard]] std::vector<double> forces(const ThinWallMaterial& material, const std::vector<double>& displacements,
                                           const std::vector<double>& velocities = {}, double relaxed_s = 0.0) {
    Numbers slots(slot_numbers_per_lane * lanes());
    const Numbers u = converted(displacements);
    const Numbers v = converted(velocities);
    outcome = kernels_.forces(material, batches(), {u.data(), velocities.empty() ? nullptr : v.data()},
                              {branch.empty() ? nullptr : branch.data(), relaxed_s, sets_apart()}, slots.data());
    std::vector<double> result(displacements.size(), 0.0);
    for (std::size_t lane = 0; lane < count_; ++lane)
      for (std::size_t n = 0; n < 24; ++n)
        result[nodes_[8 * lane + n / 3] + n % 3] += static_cast<double>(slots[4 * kernels_.slot(lane, n / 3) + n % 3]);
    return result;
  }

  /// Energy of each element.
  [[nodiscard]] std::vector<double> energies(const ThinWallMaterial& material, const std::vector<double>& displacements) {
    Numbers energies(lanes());
    smallest_ratios.assign(lanes(), Number(0));
    const Numbers u = converted(displacements);
    kernels_.energies(material, batches(), {u.data()}, {branch.empty() ? nullptr : branch.data(), 0.0, sets_apart()},
                      energies.data(), smallest_ratios.data());
    std::vector<double> result;
    for (std::size_t lane = 0; lane < count_; ++lane) result.push_back(static_cast<double>(energies[lane]));
    return result;
  }
  [[nodiscard]] double energy(const ThinWallMaterial& material, const std::vector<double>& displacements) {
    double sum = 0.0;
    for (const double energy : energies(material, displacements)) sum += energy;
    return sum;
  }

  /// Branches at rest at the displacements.
  void rest_branches(const std::vector<double>& displacements, std::size_t branches = 1) {
    Numbers set(sets_apart(), Number(0));
    const Numbers u = converted(displacements);
    kernels_.rest_branches(batches(), {u.data()}, set.data());
    branch.clear();
    for (std::size_t n = 0; n < branch_set_count(branches); ++n) branch.insert(branch.end(), set.begin(), set.end());
  }

  ThinWallOutcome outcome;
  Numbers smallest_ratios;
  Numbers branch;

 private:
  [[nodiscard]] std::size_t lanes() const { return kernels_.width * normals_.size(); }
  [[nodiscard]] std::size_t sets_apart() const { return thin_wall_branch_numbers(element_) * lanes(); }
  [[nodiscard]] std::size_t at(std::size_t lane, std::size_t numbers, std::size_t n) const {
    return (lane / kernels_.width * numbers + n) * kernels_.width + lane % kernels_.width;
  }
  [[nodiscard]] ThinWallBatches<Number> batches() const {
    return {element_, normals_.size(), nodes_.data(), shapes_.data(), normals_.data(), pressures_.data(), volume_changes_.data()};
  }
  [[nodiscard]] Numbers converted(const std::vector<double>& values) const {
    Numbers result(3 * node_count_ + 1, Number(0));
    for (std::size_t n = 0; n < values.size(); ++n) result[n] = static_cast<Number>(values[n]);
    return result;
  }

  ThinWallKernels<Number> kernels_;
  ThinWallElement element_;
  std::size_t node_count_;
  std::size_t count_ = 0;
  std::vector<std::uint32_t> nodes_;
  std::vector<std::uint8_t> normals_;
  Numbers shapes_;
  std::vector<double> pressures_;
  mutable std::vector<double> volume_changes_;
};

/// A strain of a few tenths that differs from corner to corner.
inline std::vector<double> strained(const Grid& grid, double gradient_amplitude, double corner_amplitude, unsigned seed) {
  const std::vector<double> G = random_values(9, gradient_amplitude, seed);
  std::vector<double> u = grid.displacements([&](const std::array<double, 3>& X) {
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) value[i] += G[3 * i + j] * X[j];
    return value;
  });
  const std::vector<double> corners = random_values(u.size(), corner_amplitude, seed + 1);
  for (std::size_t n = 0; n < u.size(); ++n) u[n] += corners[n];
  return u;
}

}  // namespace menger::fem
