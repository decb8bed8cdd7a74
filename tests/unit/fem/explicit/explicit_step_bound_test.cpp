#include "fem/explicit/explicit_step_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// Largest eigenvalue of M^-1 K (or, with a viscosity, of M^-1 C for the rate of forces by velocities) by power iteration; forces
/// are differentiated along the iterate. From below, and within 1e-3 after the iterations. @param branch of the body's branches
double largest_eigenvalue(const ExplicitBody& body, const std::vector<double>& displacements, bool of_damping,
                          const BranchTensors& branch = {}) {
  std::vector<double> mode = random_numbers(displacements.size(), 1.0, 7);
  double eigenvalue = 0.0;
  for (int iteration = 0; iteration < 400; ++iteration) {
    double norm_square = 0.0;
    for (std::size_t n = 0; n < mode.size(); ++n) {
      if (body.inverse_masses_per_kg()[n] == 0.0) mode[n] = 0.0;
      norm_square += body.masses_kg()[n / 3] * mode[n] * mode[n];
    }
    for (double& value : mode) value /= std::sqrt(norm_square);
    const double step = 1e-9;  // of modes whose largest component is about 1e2
    std::vector<double> ahead = of_damping ? std::vector<double>(mode.size()) : displacements;
    std::vector<double> behind = ahead;
    for (std::size_t n = 0; n < mode.size(); ++n) {
      ahead[n] += step * mode[n];
      behind[n] -= step * mode[n];
    }
    const auto force = [&](const std::vector<double>& at) {
      return of_damping ? internal_forces(body, {displacements.data(), at.data()}) : internal_forces(body, {at.data()}, branch);
    };
    const std::vector<double> high = force(ahead);
    const std::vector<double> low = force(behind);
    eigenvalue = 0.0;
    std::vector<double> product(mode.size());
    for (std::size_t n = 0; n < mode.size(); ++n) {
      const double slope = (high[n] - low[n]) / (2.0 * step);
      eigenvalue += mode[n] * slope;
      product[n] = slope * body.inverse_masses_per_kg()[n];
    }
    mode = product;
  }
  return eigenvalue;
}

/// States at rest, stretched by 60 %, and with every node moved by a tenth of an edge.
std::vector<std::vector<double>> states(const meshes::HexahedralMesh& mesh, double edge_m) {
  std::vector<double> stretched;
  for (const Point& X : mesh.points) {
    stretched.push_back(0.6 * X[0]);
    stretched.push_back((1.0 / std::sqrt(1.6) - 1.0) * X[1]);
    stretched.push_back((1.0 / std::sqrt(1.6) - 1.0) * X[2]);
  }
  return {std::vector<double>(stretched.size(), 0.0), stretched, random_numbers(stretched.size(), 0.1 * edge_m, 8)};
}

TEST(StepBound, LiesBetweenTheTrueLimitAndSixTenthsOfIt) {
  const std::vector<std::pair<meshes::HexahedralMesh, double>> bodies{{hollow_cube(), 2e-3},
                                                                      {meshes::box({10e-3, 2e-3, 2e-3}, {5, 1, 1}), 2e-3},
                                                                      {meshes::box({8e-3, 8e-3, 8e-3}, {4, 4, 4}), 2e-3},
                                                                      {meshes::box({10e-3, 8e-3, 1e-3}, {5, 4, 1}), 1e-3}};
  for (const auto& [mesh, edge] : bodies) {
    const ExplicitBody body(mesh, silicone_options(mesh));
    for (const std::vector<double>& displacements : states(mesh, edge)) {
      const double truth = 2.0 / std::sqrt(largest_eigenvalue(body, displacements, false));
      const double step = stable_step_s(eigenvalue_bounds(body, displacements));
      EXPECT_LE(step, truth) << mesh.elements.size();
      EXPECT_GE(step, 0.6 * truth) << mesh.elements.size();
    }
  }
}

// Held nodes take part in no mode, and a law that stiffens has another tangent at each state.
TEST(StepBound, HoldsForSupportsAndStiffeningLaws) {
  const meshes::HexahedralMesh mesh = meshes::box({8e-3, 4e-3, 4e-3}, {4, 2, 2});
  ExplicitBodyOptions options = silicone_options(mesh, 5.0);
  options.regions[0].material.law = materials::Yeoh{25e3, 5e3, 3e3};
  options.supports = {{meshes::label_index(mesh, "x min"), {true, true, true}}};
  const ExplicitBody body(mesh, options);
  for (const std::vector<double>& displacements : states(mesh, 2e-3)) {
    const EigenvalueBounds bounds = eigenvalue_bounds(body, displacements);
    const double stiffness = largest_eigenvalue(body, displacements, false);
    EXPECT_GE(bounds.stiffness_per_s2, stiffness);
    EXPECT_LE(bounds.stiffness_per_s2, 3.0 * stiffness);
    EXPECT_GE(bounds.damping_per_s, largest_eigenvalue(body, displacements, true) * (1.0 - 1e-6));
    // Both together: what is stable for the bounds is stable for the true values.
    EXPECT_LT(stable_step_s(bounds), stable_step_s({stiffness, 0.0}));
    EXPECT_LT(stable_step_s(bounds), stable_step_s({bounds.stiffness_per_s2, 0.0}));
  }
}

// A branch ten times as stiff as usual, as it is after slow motion (at rest in each state), after a jump (at rest at first), and
// on the way back from where the material was stretched.
TEST(StepBound, CountsBranches) {
  for (const double bulk_modulus_Pa : {2.5e6, 1e5}) {  // soft enough for shear to decide, too
    const meshes::HexahedralMesh mesh = meshes::box({8e-3, 4e-3, 4e-3}, {4, 2, 2});
    ExplicitBodyOptions options = silicone_options(mesh);
    options.regions[0].material.volume = materials::SimoTaylorVolume{bulk_modulus_Pa};
    options.regions[0].material.branch = {.shear_modulus_Pa = 100e3, .relaxation_time_s = 1e-3};
    const ExplicitBody body(mesh, options);
    const std::vector<std::vector<double>> all = states(mesh, 2e-3);
    for (const std::vector<double>& past : all) {
      AlignedNumbers tensors = body.branches_at_rest(past);
      for (const std::vector<double>& displacements : all) {
        const double stiffness = largest_eigenvalue(body, displacements, false, {tensors.data(), 0.0});
        const double bound = eigenvalue_bounds(body, displacements, tensors).stiffness_per_s2;
        EXPECT_GE(bound, stiffness);
        EXPECT_LE(bound, 6.0 * stiffness);
        EXPECT_GT(bound, eigenvalue_bounds(body, displacements).stiffness_per_s2);
      }
    }
  }
}

TEST(StepBound, DoesNotDependOnThreads) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh, 5.0));
  const std::vector<double> displacements = states(mesh, 2e-3)[2];
  const EigenvalueBounds alone = eigenvalue_bounds(body, displacements);
  const EigenvalueBounds three = eigenvalue_bounds(body, displacements, {}, BlockLoop(3));
  EXPECT_EQ(alone.stiffness_per_s2, three.stiffness_per_s2);
  EXPECT_EQ(alone.damping_per_s, three.damping_per_s);
}

TEST(StepBound, CountsTheDampingOfTheMaterial) {
  const meshes::HexahedralMesh mesh = meshes::box({8e-3, 4e-3, 4e-3}, {4, 2, 2});
  const ExplicitBody body(mesh, silicone_options(mesh, 20.0));
  for (const std::vector<double>& displacements : states(mesh, 2e-3)) {
    const double damping = largest_eigenvalue(body, displacements, true);
    const double bound = eigenvalue_bounds(body, displacements).damping_per_s;
    EXPECT_GE(bound, damping * (1.0 - 1e-6));
    EXPECT_LE(bound, 6.0 * damping);
  }
}

// x'' + c x' + k x = 0 in central differences with the velocity of the last half step stays bounded up to this step.
TEST(StepBound, IsThatOfTheDampedOscillator) {
  const EigenvalueBounds oscillator{.stiffness_per_s2 = 4e4, .damping_per_s = 100.0};
  const double limit = stable_step_s(oscillator);
  const auto largest_after = [&](double step) {
    double x = 1.0;
    double v = 0.0;
    for (int n = 0; n < 2000; ++n) {
      v -= step * (oscillator.stiffness_per_s2 * x + oscillator.damping_per_s * v);
      x += step * v;
    }
    return std::abs(x);
  };
  EXPECT_LT(largest_after(0.99 * limit), 1.0);
  EXPECT_GT(largest_after(1.01 * limit), 1e3);
}

// A fifth part of the silicone made ten times as dense changes no light element; heavy nodes must not lengthen the step of
// others.
TEST(StepBound, SeesTheLightestRegion) {
  meshes::HexahedralMesh mesh = meshes::box({10e-3, 2e-3, 2e-3}, {5, 1, 1});
  mesh.region_names = {"light", "heavy"};
  mesh.regions = {0, 0, 0, 0, 1};
  ExplicitBodyOptions options = silicone_options(mesh);
  options.regions[1].density_kg_per_m3 *= 10.0;
  const ExplicitBody body(mesh, options);
  const std::vector<double> rest(3 * mesh.points.size(), 0.0);
  const double truth = 2.0 / std::sqrt(largest_eigenvalue(body, rest, false));
  const double step = stable_step_s(eigenvalue_bounds(body, rest));
  EXPECT_LE(step, truth);
  EXPECT_GE(step, 0.6 * truth);
}

}  // namespace
}  // namespace menger::fem
