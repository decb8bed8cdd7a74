#include "fem/thin_walls/thin_wall_kernel.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/fem/thin_walls/thin_wall_samples.h"

namespace menger::fem {
namespace {

// Edges of 3, 2 and 1 mm; steps of 1e-8 m are strains of 1e-5. The error of a central difference is about the square of it times
// the third derivative, some 1e-9 of the force, and that of rounding the energy 1e-16 / 1e-5 of the modulus.
constexpr double step_m = 1e-8;
constexpr double difference_tolerance = 5e-8;

std::string description(std::string_view instruction_set, ThinWallElement element, const ThinWallMaterial& material) {
  return std::string(instruction_set) + ", " + name_of(element) + ", " + std::string(materials::name_of(material.law));
}

void expect_forces_are_differences(Patch<double>& patch, const ThinWallMaterial& material, const std::vector<double>& u) {
  const std::vector<double> forces = patch.forces(material, u);
  ASSERT_FALSE(patch.outcome.is_inverted());
  for (unsigned seed = 20; seed < 26; ++seed) {
    const std::vector<double> direction = random_values(u.size(), 1.0, seed);
    const double ahead = patch.energy(material, moved(u, direction, step_m));
    const double behind = patch.energy(material, moved(u, direction, -step_m));
    EXPECT_NEAR(product(forces, direction), (ahead - behind) / (2.0 * step_m), difference_tolerance * largest(forces));
  }
}

TEST(ThinWallKernels, ForcesAreTheDerivativesOfTheEnergy) {
  const auto kernels = best_thin_wall_kernels<double>();
  for (const ThinWallElement element : both_elements) {
    for (const auto& law : all_laws()) {
      const ThinWallMaterial material = silicone_of(law);
      SCOPED_TRACE(description(kernels.instruction_set, element, material));
      for (unsigned seed = 1; seed < 4; ++seed) {
        const Grid grid = one_box(seed % 3);
        Patch<double> patch(kernels, element, grid);
        patch.press(4e3, 1e3);
        expect_forces_are_differences(patch, material, strained(grid, 0.2, 0.1e-3, seed));
      }
    }
  }
}

// One pattern of corners at a time on top of a stretch, so that no term hides behind a larger one.
TEST(ThinWallKernels, ForcesOfEveryTermAreTheDerivativesOfItsEnergy) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  const ThinWallMaterial material = silicone_of(materials::NeoHookean{50e3});
  for (const ThinWallElement element : both_elements) {
    Patch<double> patch(kernels, element, grid);
    for (std::size_t pattern = 1; pattern < 8; ++pattern) {
      for (std::size_t i = 0; i < 3; ++i) {
        SCOPED_TRACE(name_of(element) + ", pattern " + std::to_string(pattern) + ", component " + std::to_string(i));
        std::vector<double> u = strained(grid, 0.1, 0.0, 5);
        for (std::size_t corner = 0; corner < 8; ++corner) {
          double sign = 1.0;
          for (std::size_t axis = 0; axis < 3; ++axis)
            if ((pattern >> axis & 1U) != 0 && (corner >> axis & 1U) == 0) sign = -sign;
          u[3 * corner + i] += 0.1e-3 * sign;
        }
        expect_forces_are_differences(patch, material, u);
      }
    }
  }
}

// A Gent layer near the end of its chains, where the first order in mu / kappa has long failed.
TEST(ThinWallKernels, ForcesOfALawNearItsLimitAreTheDerivativesOfTheEnergy) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  const ThinWallMaterial material = silicone_of(materials::Gent{46e3, 2.0});
  Patch<double> patch(kernels, ThinWallElement::wall, grid);
  std::vector<double> u = strained(grid, 0.02, 0.02e-3, 3);
  for (std::size_t corner = 0; corner < 8; ++corner) u[3 * corner] += 0.75 * grid.position(corner)[0];
  expect_forces_are_differences(patch, material, u);
}

TEST(ThinWallKernels, ForcesAreInBalance) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box(1);
  for (const ThinWallElement element : both_elements) {
    for (const auto& law : all_laws()) {
      Patch<double> patch(kernels, element, grid);
      patch.press(4e3, 0.0);
      const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 7);
      const std::vector<double> f = patch.forces(silicone_of(law), u);
      std::array<double, 3> force{};
      std::array<double, 3> moment{};
      for (std::size_t n = 0; n < 8; ++n) {
        const auto X = grid.position(n);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3;
          const std::size_t k = (i + 2) % 3;
          force[i] += f[3 * n + i];
          moment[i] += (X[j] + u[3 * n + j]) * f[3 * n + k] - (X[k] + u[3 * n + k]) * f[3 * n + j];
        }
      }
      for (std::size_t i = 0; i < 3; ++i) {  // rounding of eight terms
        EXPECT_NEAR(force[i], 0.0, 1e-14 * largest(f));
        EXPECT_NEAR(moment[i], 0.0, 1e-14 * 5e-3 * largest(f));
      }
    }
  }
}

TEST(ThinWallKernels, NeitherRotationNorRestGivesForces) {
  const double angle = 1.1;
  for (const auto& kernels : available_thin_wall_kernels<double>()) {
    for (const ThinWallElement element : both_elements) {
      for (const auto& law : all_laws()) {
        const ThinWallMaterial material = silicone_of(law);
        SCOPED_TRACE(description(kernels.instruction_set, element, material));
        const Grid grid = one_box(2);
        const auto turned = grid.displacements([&](const std::array<double, 3>& X) {
          const double y = std::cos(angle) * X[1] - std::sin(angle) * X[2];
          const double z = std::sin(angle) * X[1] + std::cos(angle) * X[2];
          return std::array{std::cos(0.7) * X[0] - std::sin(0.7) * y - X[0] + 1e-3,
                            std::sin(0.7) * X[0] + std::cos(0.7) * y - X[1], z - X[2]};
        });
        Patch<double> patch(kernels, element, grid);
        const double scale = materials::shear_modulus_at_rest_Pa(law) * 6e-6;  // a modulus times a face
        EXPECT_LT(largest(patch.forces(material, std::vector<double>(24, 0.0))), 1e-15 * scale);
        // rounding of products of order 1, times moduli up to 50 mu
        EXPECT_LT(largest(patch.forces(material, turned)), 3e-13 * scale);
        EXPECT_NEAR(patch.energy(material, turned), 0.0, 1e-14 * scale * 1e-3);
      }
    }
  }
}

TEST(ThinWallKernels, ForcesTurnWithTheElement) {
  const auto kernels = best_thin_wall_kernels<double>();
  for (const ThinWallElement element : both_elements) {
    const Grid grid = one_box();
    Patch<double> patch(kernels, element, grid);
    const ThinWallMaterial material = silicone_of(materials::NeoHookean{50e3});
    const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 9);
    const std::vector<double> f = patch.forces(material, u);
    const double c = std::cos(0.8);
    const double s = std::sin(0.8);
    std::vector<double> turned(24);
    std::vector<double> expected(24);
    for (std::size_t n = 0; n < 8; ++n) {
      const auto X = grid.position(n);
      const double x = X[0] + u[3 * n];
      const double z = X[2] + u[3 * n + 2];
      turned[3 * n] = c * x - s * z - X[0];
      turned[3 * n + 1] = u[3 * n + 1];
      turned[3 * n + 2] = s * x + c * z - X[2];
      expected[3 * n] = c * f[3 * n] - s * f[3 * n + 2];
      expected[3 * n + 1] = f[3 * n + 1];
      expected[3 * n + 2] = s * f[3 * n] + c * f[3 * n + 2];
    }
    const std::vector<double> response = patch.forces(material, turned);
    for (std::size_t n = 0; n < 24; ++n) EXPECT_NEAR(response[n], expected[n], 1e-12 * largest(f));  // rounding
  }
}

// The same wall with its normal along z, x and y.
TEST(ThinWallKernels, TheAxisOfTheNormalDoesNotMatter) {
  const auto kernels = best_thin_wall_kernels<double>();
  for (const ThinWallElement element : both_elements) {
    for (const auto& law : all_laws()) {
      const ThinWallMaterial material = silicone_of(law);
      const Grid first = one_box(2);
      const std::vector<double> u = strained(first, 0.2, 0.1e-3, 11);
      Patch<double> patch(kernels, element, first);
      patch.press(3e3, 1e3);
      const double energy = patch.energy(material, u);
      const std::vector<double> forces = patch.forces(material, u);
      for (std::size_t normal = 0; normal < 2; ++normal) {
        const Grid other = one_box(normal);
        const std::size_t shift = normal + 1;  // axis a of the first box is a + shift of the other one
        std::vector<double> v(24);
        for (std::size_t n = 0; n < 8; ++n) {
          const auto place = first.place(n);
          std::array<std::size_t, 3> there{};
          for (std::size_t a = 0; a < 3; ++a) there[(a + shift) % 3] = place[a];
          for (std::size_t a = 0; a < 3; ++a) v[3 * other.node(there) + (a + shift) % 3] = u[3 * n + a];
        }
        Patch<double> other_patch(kernels, element, other);
        other_patch.press(3e3, 1e3);
        EXPECT_EQ(other_patch.energy(material, v), energy);  // the same operations
        const std::vector<double> g = other_patch.forces(material, v);
        EXPECT_EQ(largest(g), largest(forces));
      }
    }
  }
}

// A block has no normal: its energy does not change when its local axes are named differently.
TEST(ThinWallKernels, ABlockTakesAnyAxisAsItsThird) {
  const auto kernels = best_thin_wall_kernels<double>();
  for (const auto& law : all_laws()) {
    const ThinWallMaterial material = silicone_of(law);
    Grid grid = one_box(2);
    const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 12);
    const double energy = Patch<double>(kernels, ThinWallElement::block, grid).energy(material, u);
    for (std::size_t normal = 0; normal < 2; ++normal) {
      grid.normal = normal;
      // rounding in another order
      EXPECT_NEAR(Patch<double>(kernels, ThinWallElement::block, grid).energy(material, u), energy, 1e-13 * energy);
    }
  }
}

TEST(ThinWallKernels, EveryInstructionSetGivesTheSame) {
  Grid grid = one_box();
  grid.lines[0] = {0.0, 1e-3, 2.5e-3, 4e-3, 5e-3, 6.5e-3};
  grid.lines[1] = {0.0, 2e-3, 3e-3, 4.5e-3, 6e-3};
  const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 13);
  const std::vector<double> v = random_values(u.size(), 0.1, 14);
  for (const ThinWallElement element : both_elements) {
    for (const auto& law : all_laws()) {
      ThinWallMaterial material = silicone_of(law);
      material.viscosity_Pa_s = 10.0;
      material.branches = {{10e3, 5e-3}};
      std::vector<double> expected;
      double energy = 0.0;
      for (const auto& kernels : available_thin_wall_kernels<double>()) {
        SCOPED_TRACE(description(kernels.instruction_set, element, material));
        Patch<double> patch(kernels, element, grid);
        patch.press(4e3, 1e3);
        patch.rest_branches(std::vector<double>(u.size(), 0.0));
        const std::vector<double> forces = patch.forces(material, u, v, 1e-3);
        if (expected.empty()) {  // scalar, the first
          expected = forces;
          energy = patch.energy(material, u);
          ASSERT_FALSE(patch.outcome.is_inverted());
          continue;
        }
        // rounding of some hundred operations; Newton's method for the stretch across stops at the square root of it
        for (std::size_t n = 0; n < forces.size(); ++n) ASSERT_NEAR(forces[n], expected[n], 1e-12 * largest(expected)) << n;
        EXPECT_NEAR(patch.energy(material, u), energy, 1e-12 * energy);
      }
    }
  }
}

// The lanes beside an element, whole batches of others and where it stands in them change no byte of its response.
TEST(ThinWallKernels, WhatAnElementAnswersDoesNotDependOnItsNeighbours) {
  Grid grid = one_box();
  grid.lines[0][1] = 0.00390625;  // whose multiples have no rounding
  Grid many = grid;
  many.lines[0] = {0.0, 0.00390625, 0.0078125, 0.01171875};
  for (const auto& kernels : available_thin_wall_kernels<double>()) {
    for (const auto& law : all_laws()) {
      const ThinWallMaterial material = silicone_of(law);
      SCOPED_TRACE(description(kernels.instruction_set, ThinWallElement::wall, material));
      const std::vector<double> u = strained(many, 0.15, 0.1e-3, 15);
      const std::vector<double> energies = Patch<double>(kernels, ThinWallElement::wall, many).energies(material, u);
      for (std::size_t e = 0; e < 3; ++e) {
        std::vector<double> own(24);
        for (std::size_t n = 0; n < 8; ++n) {
          auto place = grid.place(n);
          place[0] += e;
          for (std::size_t i = 0; i < 3; ++i) own[3 * n + i] = u[3 * many.node(place) + i];
        }
        EXPECT_EQ(Patch<double>(kernels, ThinWallElement::wall, grid).energy(material, own), energies[e]);
      }
    }
  }
}

TEST(ThinWallKernels, SinglePrecisionAgreesWithDouble) {
  const Grid grid = one_box();
  for (const auto& kernels : available_thin_wall_kernels<float>()) {
    for (const ThinWallElement element : both_elements) {
      for (const auto& law : all_laws()) {
        ThinWallMaterial material = silicone_of(law);
        SCOPED_TRACE(description(kernels.instruction_set, element, material));
        for (const double strain : {0.2, 1e-3}) {
          // numbers that both types have
          std::vector<double> u = strained(grid, strain, 0.5e-3 * strain, 16);
          for (double& value : u) value = static_cast<double>(static_cast<float>(value));
          Patch<float> rough(kernels, element, grid);
          const auto exact_kernels = best_thin_wall_kernels<double>();
          Patch<double> exact(exact_kernels, element, grid);
          const std::vector<double> expected = exact.forces(material, u);
          const std::vector<double> forces = rough.forces(material, u);
          // 6e-8 times moduli of up to 5 mu times faces, beside the forces' own rounding
          const double tolerance = 2e-6 * largest(expected) + 3e-7 * materials::shear_modulus_at_rest_Pa(law) * 6e-6;
          for (std::size_t n = 0; n < 24; ++n) EXPECT_NEAR(forces[n], expected[n], tolerance) << strain;
        }
      }
    }
  }
}

TEST(ThinWallKernels, AnElementBelowTheFloorIsInverted) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  const ThinWallMaterial material = silicone_of(materials::NeoHookean{50e3});
  const auto pressed = [&](double x, double z) {
    return grid.displacements([&](const std::array<double, 3>& X) {
      return std::array{(x - 1.0) * X[0], 0.0, (z - 1.0) * X[2]};
    });
  };
  for (const ThinWallElement element : both_elements) {
    Patch<double> patch(kernels, element, grid);
    static_cast<void>(patch.forces(material, pressed(1.0, 0.31)));
    EXPECT_NEAR(patch.outcome.smallest_ratio, 0.31, 1e-14);
    EXPECT_FALSE(patch.outcome.is_inverted());
    static_cast<void>(patch.forces(material, pressed(1.0, 0.29)));
    EXPECT_TRUE(patch.outcome.is_inverted());
    static_cast<void>(patch.forces(material, pressed(1.0, -0.5)));
    EXPECT_TRUE(patch.outcome.is_inverted());
    auto missing = pressed(1.0, 1.0);
    missing[5] = std::nan("");
    static_cast<void>(patch.forces(material, missing));
    EXPECT_TRUE(patch.outcome.is_inverted());
    EXPECT_EQ(patch.outcome.smallest_ratio, -1.0);
  }
  // an area can vanish in a wall that is thick enough to keep its volume
  Patch<double> patch(kernels, ThinWallElement::wall, grid);
  static_cast<void>(patch.forces(material, pressed(0.29, 3.4)));
  EXPECT_NEAR(patch.outcome.smallest_ratio, 0.29, 1e-14);
  EXPECT_TRUE(patch.outcome.is_inverted());
}

TEST(ThinWallKernels, ALawBeyondItsLimitHasNoAnswer) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  const auto pulled = grid.displacements([](const std::array<double, 3>& X) {
    return std::array{2.0 * X[0], (1.0 / std::sqrt(3.0) - 1.0) * X[1], (1.0 / std::sqrt(3.0) - 1.0) * X[2]};
  });
  for (const ThinWallElement element : both_elements) {
    Patch<double> patch(kernels, element, grid);
    // I1 - 3 = 9 + 2/3 - 3 = 6.67
    static_cast<void>(patch.forces(silicone_of(materials::Gent{50e3, 7.0}), pulled));
    EXPECT_FALSE(patch.outcome.is_inverted());
    ThinWallMaterial stiff = silicone_of(materials::Gent{50e3, 5.0});
    stiff.bulk_modulus_Pa *= 1e9;  // so that the volume cannot give way
    static_cast<void>(patch.forces(stiff, pulled));
    EXPECT_EQ(patch.outcome.smallest_ratio, -1.0);
  }
}

// With walls that thin by p / (2 kappa') without it; half of the pressure acts on a wall with one side at rest.
TEST(ThinWallKernels, PressuresDoNotThinAWall) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  const ThinWallMaterial material = silicone_of(materials::NeoHookean{50e3});
  const double p = 6e3;
  Patch<double> patch(kernels, ThinWallElement::wall, grid);
  patch.press(p, 0.0);
  const std::vector<double> f = patch.forces(material, std::vector<double>(24, 0.0));
  // In balance with the mean stress -p/2 on all faces, as in a layer that keeps its volume.
  for (std::size_t n = 0; n < 8; ++n) {
    const std::array<double, 3> quarter{2.0 * 1.0 * 1e-6 / 4.0, 3.0 * 1.0 * 1e-6 / 4.0, 3.0 * 2.0 * 1e-6 / 4.0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double outwards = (n >> i & 1U) != 0 ? 1.0 : -1.0;
      EXPECT_NEAR(f[3 * n + i], -0.5 * p * quarter[i] * outwards, 1e-12 * p * quarter[i]);
    }
  }
}

TEST(ThinWallShape, SharesOfShearAreThoseOfResidualBending) {
  const auto shape = shape_of({3e-3, 2e-3, 1e-3});
  const double mu = 1.0;
  const double k_mu = 5.0 / 6.0 * mu;
  EXPECT_NEAR(shape[0], 1.0 / (4.0 * 3e-3), 1e-12);
  EXPECT_NEAR(shape[3], 6e-9, 1e-21);
  EXPECT_NEAR(shape[4] * shape[4] * k_mu, 1.0 / (1.0 / k_mu + 9.0 / (4.0 * mu)), 1e-14);
  EXPECT_NEAR(shape[5] * shape[5] * k_mu, 1.0 / (1.0 / k_mu + 4.0 / (4.0 * mu)), 1e-14);
}

}  // namespace
}  // namespace menger::fem
