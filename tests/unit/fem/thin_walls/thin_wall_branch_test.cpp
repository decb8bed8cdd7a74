// The Maxwell branch and the viscosity of walls and blocks.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fem/thin_walls/element_branch.h"
#include "tests/unit/fem/thin_walls/thin_wall_samples.h"

namespace menger::fem {
namespace {

constexpr double mu = 50e3;

ThinWallMaterial branched(double modulus_Pa = 11e3) {
  ThinWallMaterial material = silicone_of(materials::NeoHookean{mu});
  material.branches = {{modulus_Pa, 4e-3}};
  return material;
}

/// Three branches, which relax at different rates.
ThinWallMaterial branched_thrice() {
  ThinWallMaterial material = silicone_of(materials::NeoHookean{mu});
  material.branches = {{3e3, 150e-3}, {5e3, 20e-3}, {15e3, 4e-3}};
  return material;
}

std::vector<ThinWallMaterial> once_and_thrice() { return {branched(), branched_thrice()}; }

// Branches that have relaxed from different states, and so rest in different ones.
TEST(ThinWallBranch, ForcesAreTheDerivativesOfTheEnergy) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box(1);
  for (const ThinWallMaterial& material : once_and_thrice()) {
    for (const ThinWallElement element : both_elements) {
      Patch<double> patch(kernels, element, grid);
      patch.rest_branches(strained(grid, 0.2, 0.1e-3, 31), material.branches.size());
      static_cast<void>(patch.forces(material, strained(grid, 0.2, 0.1e-3, 30), {}, 5e-3));
      const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 32);
      const std::vector<double> forces = patch.forces(material, u);
      for (unsigned seed = 33; seed < 39; ++seed) {
        const std::vector<double> direction = random_values(u.size(), 1.0, seed);
        const double step_m = 1e-8;  // errors as without a branch
        const double ahead = patch.energy(material, moved(u, direction, step_m));
        const double behind = patch.energy(material, moved(u, direction, -step_m));
        EXPECT_NEAR(product(forces, direction), (ahead - behind) / (2.0 * step_m), 5e-8 * largest(forces))
            << name_of(element) << ", " << material.branches.size();
      }
    }
  }
}

// Branches of one rate are one with all of their modulus, whatever they go through.
TEST(ThinWallBranch, BranchesOfOneRateAreOne) {
  for (const auto& kernels : available_thin_wall_kernels<double>()) {
    const Grid grid = one_box(2);
    ThinWallMaterial parted = branched(11e3);
    parted.branches = {{2e3, 4e-3}, {4e3, 4e-3}, {5e3, 4e-3}};
    for (const ThinWallElement element : both_elements) {
      Patch<double> one(kernels, element, grid);
      Patch<double> three(kernels, element, grid);
      one.rest_branches(strained(grid, 0.2, 0.1e-3, 31));
      three.rest_branches(strained(grid, 0.2, 0.1e-3, 31), 3);
      for (unsigned n = 0; n < 5; ++n) {
        const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 32 + n);
        const double relaxed_s = n % 2 == 0 ? 1e-3 : 0.0;
        const std::vector<double> expected = one.forces(branched(), u, {}, relaxed_s);
        const std::vector<double> forces = three.forces(parted, u, {}, relaxed_s);
        // the change of a metric and its shares, each to rounding
        for (std::size_t k = 0; k < 24; ++k) EXPECT_NEAR(forces[k], expected[k], 1e-13 * largest(expected));
        EXPECT_NEAR(three.outcome.relaxed_J, one.outcome.relaxed_J, 1e-13 * one.energy(branched(), u));
        EXPECT_NEAR(three.energy(parted, u), one.energy(branched(), u), 1e-13 * one.energy(branched(), u));
      }
    }
  }
}

TEST(ThinWallBranch, AtRestItCarriesNothing) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  for (const ThinWallElement element : both_elements) {
    Patch<double> patch(kernels, element, grid);
    const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 41);
    const std::vector<double> elastic = patch.forces(branched(), u);
    const double energy = patch.energy(branched(), u);
    patch.rest_branches(u);
    const std::vector<double> forces = patch.forces(branched(), u);
    for (std::size_t n = 0; n < 24; ++n) EXPECT_NEAR(forces[n], elastic[n], 1e-13 * largest(elastic));  // rounding
    EXPECT_NEAR(patch.energy(branched(), u), energy, 1e-13 * energy);
  }
}

// Without what only volume responses, a sudden small strain meets mu + m in place of mu in every term.
TEST(ThinWallBranch, FastStrainMeetsBothModuli) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  ThinWallMaterial material = branched();
  material.bulk_modulus_Pa = 1e9 * mu;
  material.wall_penalty_ratio = 1e-9;
  material.block_stiffness_ratio = 1e-9;
  for (const ThinWallElement element : both_elements) {
    for (unsigned seed = 51; seed < 55; ++seed) {
      Patch<double> patch(kernels, element, grid);
      const std::vector<double> u = strained(grid, 1e-5, 1e-8, seed);
      const double slow = patch.energy(material, u);
      patch.rest_branches(std::vector<double>(24, 0.0));
      // strains of the next order, and rounding of the branch's energy
      EXPECT_NEAR(patch.energy(material, u) / slow, 1.0 + 11e3 / mu, 1e-4) << name_of(element);
    }
  }
}

// Near rest a fall is of second order in what is left of the strain, here 1e-6 of the energy: differences of energies would lose
// it in the rounding of single precision.
TEST(ThinWallBranch, NearRestSinglePrecisionReleasesWhatDoublePrecisionDoes) {
  const Grid grid = one_box(1);
  const std::vector<double> rest = strained(grid, 0.2, 0.1e-3, 71);
  const std::vector<double> u = moved(rest, strained(grid, 1.0, 0.0, 72), 1e-3);
  for (const ThinWallMaterial& material : once_and_thrice()) {
    for (const ThinWallElement element : both_elements) {
      Patch<double> exact(best_thin_wall_kernels<double>(), element, grid);
      exact.rest_branches(rest, material.branches.size());
      static_cast<void>(exact.forces(material, u, {}, 1e-3));
      EXPECT_GT(exact.outcome.relaxed_J, 0.0);
      for (const auto& kernels : available_thin_wall_kernels<float>()) {
        Patch<float> patch(kernels, element, grid);
        patch.rest_branches(rest, material.branches.size());
        static_cast<void>(patch.forces(material, u, {}, 1e-3));
        // strains of 1e-3 that are rounded by some 1e-7
        EXPECT_NEAR(patch.outcome.relaxed_J / exact.outcome.relaxed_J, 1.0, 2e-3) << name_of(element);
      }
    }
  }
}

/// A : C - ln det A, of tensors as energy_fall takes them.
long double branch_energy(const detail::SymmetricTensor<long double>& A, const detail::SymmetricTensor<long double>& C) {
  const long double determinant =
      A[0] * (A[1] * A[2] - A[3] * A[3]) - A[5] * (A[5] * A[2] - A[3] * A[4]) + A[4] * (A[5] * A[3] - A[1] * A[4]);
  return A[0] * C[0] + A[1] * C[1] + A[2] * C[2] + 2.0L * (A[3] * C[3] + A[4] * C[4] + A[5] * C[5]) - std::log(determinant);
}

template <class To, class From>
detail::SymmetricTensor<To> rounded(const detail::SymmetricTensor<From>& a) {
  detail::SymmetricTensor<To> result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = static_cast<To>(a[i]);
  return result;
}

/// Expects what falls on the way from one tensor to another, in numbers of one precision. Tensors are rounded to it first. What
/// is left to round is the distance of the branch from rest, some 1, by as much as the number type does; it counts times the way.
template <class Number>
void expect_fall(const detail::SymmetricTensor<double>& before, const detail::SymmetricTensor<double>& after,
                 const detail::SymmetricTensor<double>& C, double way) {
  const auto from = rounded<Number>(before);
  const auto to = rounded<Number>(after);
  const auto metric = rounded<Number>(C);
  const auto expected = static_cast<double>(branch_energy(rounded<long double>(from), rounded<long double>(metric)) -
                                            branch_energy(rounded<long double>(to), rounded<long double>(metric)));
  const double rounding = 10.0 * static_cast<double>(std::numeric_limits<Number>::epsilon());
  EXPECT_NEAR(static_cast<double>(detail::energy_fall<Number>(from, to, metric)), expected,
              rounding * (way + std::abs(expected)) + 1e-18)
      << "way " << way << ", " << sizeof(Number) << " bytes";
}

TEST(ThinWallBranch, EnergyFallsByWhatIsLeftOfTheStrain) {
  // inverse of each other
  const detail::SymmetricTensor<double> C{1.25, 1.0, 1.0, 0.0, 0.0, 0.5};
  const detail::SymmetricTensor<double> rest{1.0, 1.25, 1.0, 0.0, 0.0, -0.5};
  const detail::SymmetricTensor<double> shape{0.3, -0.2, 0.25, 0.1, -0.15, 0.2};
  for (const double way : {1e-6, 1e-4, 1e-2, 0.5}) {
    detail::SymmetricTensor<double> before;
    detail::SymmetricTensor<double> after;
    for (std::size_t i = 0; i < 6; ++i) {
      before[i] = rest[i] + way * shape[i];
      after[i] = rest[i] + 0.4 * way * shape[i];
    }
    expect_fall<float>(before, after, C, way);
    expect_fall<double>(before, after, C, way);
    EXPECT_EQ(detail::energy_fall<float>(rounded<float>(before), rounded<float>(before), rounded<float>(C)), 0.0F);
  }
}

TEST(ThinWallBranch, RelaxingReleasesWhatTheEnergyFallsBy) {
  for (const auto& kernels : available_thin_wall_kernels<double>()) {
    const Grid grid = one_box(0);
    for (const ThinWallMaterial& material : once_and_thrice()) {
      for (const ThinWallElement element : both_elements) {
        Patch<double> patch(kernels, element, grid);
        const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 61);
        patch.rest_branches(strained(grid, 0.1, 0.1e-3, 62), material.branches.size());
        double before = patch.energy(material, u);
        const double elastic = Patch<double>(kernels, element, grid).energy(material, u);
        EXPECT_GT(before, elastic);
        for (int n = 0; n < 3; ++n) {
          static_cast<void>(patch.forces(material, u, {}, 1e-3));
          const double after = patch.energy(material, u);
          EXPECT_GT(patch.outcome.relaxed_J, 0.0);
          EXPECT_NEAR(patch.outcome.relaxed_J, before - after, 1e-13 * before);  // rounding
          before = after;
        }
        static_cast<void>(patch.forces(material, u, {}, 40.0));  // at least 250 relaxation times
        EXPECT_NEAR(patch.energy(material, u), elastic, 1e-13 * elastic);
      }
    }
  }
}

// At a held deformation tensors go to rest as exp(-t / tau), in one step or in several.
TEST(ThinWallBranch, RelaxationIsExponential) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  for (const ThinWallElement element : both_elements) {
    const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 71);
    Patch<double> once(kernels, element, grid);
    once.rest_branches(std::vector<double>(24, 0.0));
    Patch<double> often = once;
    static_cast<void>(once.forces(branched(), u, {}, 4e-3));
    for (int n = 0; n < 4; ++n) static_cast<void>(often.forces(branched(), u, {}, 1e-3));
    for (std::size_t n = 0; n < once.branch.size(); ++n) EXPECT_NEAR(once.branch[n], often.branch[n], 1e-14);
  }
}

TEST(ThinWallViscosity, ForcesWorkWhatIsDissipated) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box(1);
  ThinWallMaterial material = silicone_of(materials::NeoHookean{mu});
  material.viscosity_Pa_s = 20.0;
  for (const ThinWallElement element : both_elements) {
    Patch<double> patch(kernels, element, grid);
    const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 81);
    const std::vector<double> elastic = patch.forces(material, u);
    std::vector<double> velocities_1 = random_values(24, 0.1, 82);
    std::vector<double> velocities_2 = random_values(24, 0.1, 83);
    const std::vector<double> first = moved(patch.forces(material, u, velocities_1), elastic, -1.0);
    EXPECT_GT(patch.outcome.dissipated_W, 0.0);
    EXPECT_NEAR(product(first, velocities_1), patch.outcome.dissipated_W, 1e-12 * patch.outcome.dissipated_W);
    // They are the derivatives of a quadratic function of the velocities.
    const std::vector<double> second = moved(patch.forces(material, u, velocities_2), elastic, -1.0);
    EXPECT_NEAR(product(first, velocities_2), product(second, velocities_1), 1e-12 * patch.outcome.dissipated_W);
  }
}

TEST(ThinWallViscosity, TurningIsFreeAndStretchingCostsTheRateOfStrain) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  ThinWallMaterial material = silicone_of(materials::NeoHookean{mu});
  material.viscosity_Pa_s = 20.0;
  for (const ThinWallElement element : both_elements) {
    Patch<double> patch(kernels, element, grid);
    const std::vector<double> u = strained(grid, 0.2, 0.1e-3, 91);
    const std::vector<double> elastic = patch.forces(material, u);
    std::vector<double> turning(24);
    for (std::size_t n = 0; n < 8; ++n) {
      const auto X = grid.position(n);
      turning[3 * n] = -(X[1] + u[3 * n + 1]) + 0.4 * (X[2] + u[3 * n + 2]);
      turning[3 * n + 1] = X[0] + u[3 * n];
      turning[3 * n + 2] = -0.4 * (X[0] + u[3 * n]) + 7.0;
    }
    const std::vector<double> forces = patch.forces(material, u, turning);
    for (std::size_t n = 0; n < 24; ++n) EXPECT_NEAR(forces[n], elastic[n], 1e-12 * largest(elastic));
    EXPECT_NEAR(patch.outcome.dissipated_W, 0.0, 1e-20);
    // 2 eta d : d of a layer that is stretched in one direction in its plane and keeps its volume
    const auto stretching = grid.displacements([](const std::array<double, 3>& X) {
      return std::array{2.0 * X[0], 0.0, -2.0 * X[2]};
    });
    static_cast<void>(patch.forces(material, std::vector<double>(24, 0.0), stretching));
    EXPECT_NEAR(patch.outcome.dissipated_W, 2.0 * 20.0 * 8.0 * 6e-9, 1e-18);
  }
}

}  // namespace
}  // namespace menger::fem
