#include "fem/thin_walls/thin_wall_stiffness.h"

#include <gtest/gtest.h>

#include "fem/thin_walls/wall_rise.h"
#include "fem/thin_walls/wall_volume.h"
#include "tests/unit/fem/thin_walls/thin_wall_samples.h"

namespace menger::fem {
namespace {

constexpr std::array<double, 3> edges_m{3e-3, 2e-3, 1e-3};

BoxNumbers box_numbers(const std::vector<double>& values) {
  BoxNumbers result{};
  std::copy_n(values.begin(), 24, result.begin());
  return result;
}

/// The displacements of a box of the edges above: a gradient of some tenths, and corners that move on their own.
std::vector<double> deformed(unsigned seed) {
  const std::vector<double> G = random_values(9, 0.15, seed);
  std::vector<double> u = random_values(24, 0.05e-3, seed + 100);
  for (std::size_t corner = 0; corner < 8; ++corner)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if ((corner >> j & 1U) != 0U) u[3 * corner + i] += G[3 * i + j] * edges_m[j];
  return u;
}

/// The derivative of a vector along a direction, of sixth order: 1e-12 of it at a step of 0.005 edges.
template <class Function>
std::vector<double> derivative(const Function& function, const std::vector<double>& u, const std::vector<double>& direction,
                               double step) {
  constexpr std::array<double, 3> weights{45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};
  std::vector<double> sum;
  for (std::size_t n = 0; n < 3; ++n) {
    const double distance = step * static_cast<double>(n + 1);
    const auto ahead = function(moved(u, direction, distance));
    const auto behind = function(moved(u, direction, -distance));
    sum.resize(ahead.size(), 0.0);
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += weights[n] * (ahead[m] - behind[m]) / step;
  }
  return sum;
}

/// Product of a matrix of 24 x 24 and a vector.
std::vector<double> times(std::span<const double> matrix, const std::vector<double>& vector) {
  std::vector<double> result(24, 0.0);
  for (std::size_t row = 0; row < 24; ++row)
    for (std::size_t column = 0; column < 24; ++column) result[row] += matrix[24 * row + column] * vector[column];
  return result;
}

std::vector<double> unit(std::size_t n) {
  std::vector<double> result(24, 0.0);
  result[n] = 1.0;
  return result;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) result = std::max(result, std::abs(a[n] - b[n]));
  return result;
}

TEST(ThinWallStiffness, IsTheDerivativeOfTheForcesToOnePartInABillion) {
  ThinWallStiffness kernel;
  for (const ThinWallElement element : both_elements) {
    for (const auto& law : all_laws()) {
      for (std::size_t normal = 0; normal < 3; ++normal) {
        SCOPED_TRACE(name_of(element) + ' ' + std::string(materials::name_of(law)) + ' ' + std::to_string(normal));
        const ThinWallMaterial material = silicone_of(law);
        const ThinWallBatch batch{element, normal, {edges_m}};
        const auto forces = [&](const std::vector<double>& u) {
          kernel.place(batch, u);
          kernel.compute_forces(material);
          return std::vector<double>(kernel.forces_N(0).begin(), kernel.forces_N(0).end());
        };
        const std::vector<double> u = deformed(static_cast<unsigned>(17 + normal));
        kernel.place(batch, u);
        kernel.compute_stiffness(material);
        const std::vector<double> K(kernel.stiffness(0).begin(), kernel.stiffness(0).end());
        double error = 0.0;
        for (std::size_t column = 0; column < 24; ++column)
          error = std::max(error, largest_difference(times(K, unit(column)), derivative(forces, u, unit(column), 2e-6)));
        EXPECT_LT(error, 1e-9 * largest(K));
        for (std::size_t row = 0; row < 24; ++row)
          for (std::size_t column = 0; column < row; ++column) EXPECT_EQ(K[24 * row + column], K[24 * column + row]);
      }
    }
  }
}

TEST(ThinWallStiffness, ForcesAreTheDerivativeOfTheEnergy) {
  ThinWallStiffness kernel;
  const ThinWallMaterial material = silicone_of(materials::Yeoh{21e3, 2.5e3, 0.1e3});
  for (const ThinWallElement element : both_elements) {
    const ThinWallBatch batch{element, 1, {edges_m}};
    const auto energy = [&](const std::vector<double>& u) {
      kernel.place(batch, u);
      kernel.compute_energies(material);
      return std::vector<double>{kernel.energy_J(0)};
    };
    const std::vector<double> u = deformed(5);
    const std::vector<double> direction = random_values(24, 1.0, 6);
    kernel.place(batch, u);
    kernel.compute_forces(material);
    const std::vector<double> forces(kernel.forces_N(0).begin(), kernel.forces_N(0).end());
    const double work = product(forces, direction);
    EXPECT_NEAR(derivative(energy, u, direction, 2e-6).front(), work, 1e-9 * std::abs(work));
  }
}

// Lanes must not see one another, nor what was computed before.
TEST(ThinWallStiffness, OfABatchIsThatOfEachElement) {
  ThinWallStiffness kernel;
  const ThinWallMaterial material = silicone_of(materials::NeoHookean{86.7e3});
  for (std::size_t count = 1; count <= kernel.width(); ++count) {
    ThinWallBatch batch{ThinWallElement::wall, 0, {}};
    std::vector<double> all;
    for (std::size_t n = 0; n < count; ++n) {
      batch.edges_m.push_back({edges_m[0], edges_m[1] * (1.0 + 0.1 * static_cast<double>(n)), edges_m[2]});
      const std::vector<double> u = deformed(static_cast<unsigned>(n));
      all.insert(all.end(), u.begin(), u.end());
    }
    kernel.place(batch, all);
    kernel.compute_energies(material);
    kernel.compute_forces(material);
    kernel.compute_stiffness(material);
    ThinWallStiffness alone;
    for (std::size_t n = 0; n < count; ++n) {
      alone.place({ThinWallElement::wall, 0, {batch.edges_m[n]}}, std::span(all).subspan(24 * n, 24));
      alone.compute_energies(material);
      alone.compute_forces(material);
      alone.compute_stiffness(material);
      EXPECT_EQ(kernel.energy_J(n), alone.energy_J(0));
      EXPECT_EQ(kernel.smallest_ratio(n), alone.smallest_ratio(0));
      EXPECT_EQ(kernel.forces_N(n), alone.forces_N(0));
      EXPECT_TRUE(std::equal(kernel.stiffness(n).begin(), kernel.stiffness(n).end(), alone.stiffness(0).begin()));
    }
  }
}

TEST(WallVolume, TimesPressureIsTheEnergyThatPressuresHaveInTheKernels) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box(2);
  Patch<double> patch(kernels, ThinWallElement::wall, grid);
  const ThinWallMaterial material = silicone_of(materials::NeoHookean{86.7e3});
  const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 7);
  const double without = patch.energy(material, u);
  patch.press(5e3, 2e3);
  const double volume = wall_volume_change(edges_m, box_numbers(u));
  EXPECT_NEAR(patch.energy(material, u) - without, -3.5e3 * volume, 1e-12 * std::abs(without));
  EXPECT_GT(std::abs(3.5e3 * volume), 1e-4 * std::abs(without)) << "a change that shows";
}

TEST(WallVolume, HasItsGradientAndHessian) {
  const std::vector<double> u = deformed(3);
  const auto volume = [](const std::vector<double>& at) {
    return std::vector<double>{wall_volume_change(edges_m, box_numbers(at))};
  };
  const auto gradient = [](const std::vector<double>& at) {
    const BoxNumbers g = wall_volume_gradient(edges_m, box_numbers(at));
    return std::vector<double>(g.begin(), g.end());
  };
  const std::vector<double> g = gradient(u);
  const std::vector<double> H = wall_volume_hessian(edges_m, box_numbers(u));
  for (std::size_t n = 0; n < 24; ++n) {
    EXPECT_NEAR(derivative(volume, u, unit(n), 2e-6).front(), g[n], 1e-11 * largest(g));
    EXPECT_LT(largest_difference(derivative(gradient, u, unit(n), 2e-6), times(H, unit(n))), 1e-11 * largest(H));
  }
}

TEST(WallBulge, HasItsGradient) {
  for (std::size_t normal = 0; normal < 3; ++normal) {
    const std::vector<double> u = deformed(static_cast<unsigned>(30 + normal));
    const auto bulge = [&](const std::vector<double>& at) {
      return std::vector<double>{wall_bulge(edges_m, normal, box_numbers(at))};
    };
    const BoxNumbers g = wall_bulge_gradient(edges_m, normal, box_numbers(u));
    const std::vector<double> gradient(g.begin(), g.end());
    for (std::size_t n = 0; n < 24; ++n)
      EXPECT_NEAR(derivative(bulge, u, unit(n), 2e-6).front(), g[n], 1e-11 * largest(gradient));
  }
}

// A wall bent to a circular cylinder: what its chord leaves of the segment, at small and at large strain of the middle.
TEST(WallBulge, OfABentWallIsTheSegmentOfItsMiddle) {
  const double length = 3e-3;
  const double width = 2e-3;
  const double thick = 0.5e-3;
  for (const double stretch : {1.0, 1.3}) {
    for (const double angle : {0.02, 0.2}) {  // of the whole element
      const double radius = stretch * length / angle;
      const double thickness = thick / stretch;  // keeps the volume, for a width that stays
      BoxNumbers u{};
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const double side = (corner & 1U) != 0U ? 0.5 : -0.5;
        const double across = (corner >> 2U & 1U) != 0U ? 0.5 : -0.5;
        const double distance = radius + across * thickness;
        u[3 * corner] = distance * std::sin(side * angle) - side * length;
        u[3 * corner + 2] = distance * std::cos(side * angle) - radius - across * thick;
      }
      const double segment = 0.5 * radius * radius * (angle - std::sin(angle)) * width;
      const double bulge = wall_bulge({length, width, thick}, 2, u);
      EXPECT_NEAR(bulge, segment, 0.3 * angle * angle * segment) << stretch << ' ' << angle;
    }
  }
}

/// Simpson's rule over the two axes of a wall in its plane, exact for parabolas.
template <class Function>
std::array<double, 3> mean_over_wall(std::size_t normal, const Function& function) {
  constexpr std::array<double, 3> weights{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  std::array<double, 3> mean{};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      std::array<double, 3> place{0.3, 0.3, 0.3};
      place[(normal + 1) % 3] = 0.5 * static_cast<double>(a);
      place[(normal + 2) % 3] = 0.5 * static_cast<double>(b);
      const std::array<double, 3> value = function(place);
      for (std::size_t i = 0; i < 3; ++i) mean[i] += weights[a] * weights[b] * value[i];
    }
  }
  return mean;
}

TEST(WallRise, OverTheDeformedAreaIsTheBulge) {
  for (std::size_t normal = 0; normal < 3; ++normal) {
    const BoxNumbers u = box_numbers(deformed(static_cast<unsigned>(50 + normal)));
    const std::array<double, 2> rises = wall_bending_rises_m(edges_m, normal, u);
    const auto rise = [&](const std::array<double, 3>& place) { return wall_rise_m(edges_m, normal, u, place, rises); };
    const auto f = centre_gradient(edges_m, u);
    const auto& a = f[(normal + 1) % 3];
    const auto& b = f[(normal + 2) % 3];
    const std::array<double, 3> area{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const std::array<double, 3> mean = mean_over_wall(normal, rise);
    const double rest_m2 = edges_m[(normal + 1) % 3] * edges_m[(normal + 2) % 3];
    const double volume = rest_m2 * (area[0] * mean[0] + area[1] * mean[1] + area[2] * mean[2]);
    const double bulge = wall_bulge(edges_m, normal, u);
    EXPECT_NEAR(volume, bulge, 1e-12 * std::abs(bulge));
    std::array<double, 3> corner{0.0, 0.0, 0.0};
    corner[(normal + 1) % 3] = 1.0;
    for (const double component : rise(corner)) EXPECT_EQ(component, 0.0) << "corners are where they are";
  }
}

TEST(WallRise, UnderPressureOverTheAreaIsTheBulge) {
  const std::array<double, 2> rises = wall_shear_rises(edges_m, 2, 86.7e3);
  EXPECT_NEAR(rises[0], 9e-6 / (10.0 * 86.7e3 * 1e-3), 1e-15 * rises[0]);  // 12 k = 10
  EXPECT_NEAR(rises[1] / rises[0], 4.0 / 9.0, 1e-15);
  const double bulge = wall_shear_bulge(edges_m, 2, 86.7e3);
  EXPECT_NEAR(6e-6 * (rises[0] + rises[1]), bulge, 1e-15 * bulge);
}

}  // namespace
}  // namespace menger::fem
