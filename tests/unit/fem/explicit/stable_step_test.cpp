#include "fem/explicit/stable_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "fem/explicit/thin_wall_elements.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// Largest eigenvalue of M^-1 K (or, with a viscosity, of M^-1 C for the rate of forces by velocities) by power iteration: from
/// below, and within 1e-3 after the iterations. Forces are differentiated along the iterate; noise of single precision is far
/// below that. @param branches of the body @param touch a touch of the body with itself; null: none
double largest_eigenvalue(const ExplicitBody& body, const std::vector<double>& displacements, bool of_damping,
                          BranchNumbers& branches, const SelfTouch* touch = nullptr) {
  const std::unique_ptr<ElementForces> elements = body.elements().make_forces();
  const auto force = [&](const std::vector<double>& at) {
    std::vector<double> forces(at.size());
    const NodalMotion motion = of_damping ? NodalMotion{displacements.data(), at.data()} : NodalMotion{at.data()};
    elements->place(motion, BlockLoop(1));
    elements->compute({0, elements->batch_count()}, branches, 0.0);
    elements->sum({0, body.node_count()}, forces.data());
    for (std::size_t i = 0; i < (touch != nullptr ? 3 : 0); ++i) {
      double gap = at[3 * touch->node + i];
      for (std::size_t c = 0; c < 4; ++c) gap -= touch->weights[c] * at[3 * touch->face_nodes[c] + i];
      forces[3 * touch->node + i] += touch->spring_N_per_m * gap;
      for (std::size_t c = 0; c < 4; ++c) forces[3 * touch->face_nodes[c] + i] -= touch->weights[c] * touch->spring_N_per_m * gap;
    }
    return forces;
  };
  std::vector<double> mode = random_numbers(displacements.size(), 1.0, 7);
  double eigenvalue = 0.0;
  for (int iteration = 0; iteration < 400; ++iteration) {
    double norm_square = 0.0;
    for (std::size_t n = 0; n < mode.size(); ++n) {
      if (body.inverse_masses_per_kg()[n] == 0.0) mode[n] = 0.0;
      norm_square += body.masses_kg()[n / 3] * mode[n] * mode[n];
    }
    for (double& value : mode) value /= std::sqrt(norm_square);
    const double step = of_damping ? 1e-3 : 1e-8;  // of modes whose largest component is about 1e2
    std::vector<double> ahead = of_damping ? std::vector<double>(mode.size()) : displacements;
    std::vector<double> behind = ahead;
    for (std::size_t n = 0; n < mode.size(); ++n) {
      ahead[n] += step * mode[n];
      behind[n] -= step * mode[n];
    }
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

double largest_eigenvalue(const ExplicitBody& body, const std::vector<double>& displacements, bool of_damping) {
  BranchNumbers none = body.elements().branches_at_rest(displacements);
  return largest_eigenvalue(body, displacements, of_damping, none);
}

LargestEigenvalues estimate(const ExplicitBody& body, const std::vector<double>& displacements, BranchNumbers& branches,
                            int threads = 1) {
  const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
  const BlockLoop loop(threads);
  return EigenvalueEstimate(body, loop, *forces).at(displacements, branches, *forces);
}

LargestEigenvalues estimate(const ExplicitBody& body, const std::vector<double>& displacements, int threads = 1) {
  BranchNumbers branches = body.elements().branches_at_rest(displacements);
  return estimate(body, displacements, branches, threads);
}

/// States at rest, stretched by 60 %, with every node moved by a tenth of an edge, and with the elements at one corner crushed.
std::vector<std::vector<double>> states(const meshes::HexahedralMesh& mesh, double edge_m) {
  std::vector<double> stretched;
  for (const Point& X : mesh.points) {
    stretched.push_back(0.6 * X[0]);
    stretched.push_back((1.0 / std::sqrt(1.6) - 1.0) * X[1]);
    stretched.push_back((1.0 / std::sqrt(1.6) - 1.0) * X[2]);
  }
  std::vector<double> crushed(stretched.size(), 0.0);
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (norm(mesh.points[n]) < 1e-9) crushed[3 * n] = 0.4 * edge_m;
  return {std::vector<double>(stretched.size(), 0.0), stretched, random_numbers(stretched.size(), 0.1 * edge_m, 8), crushed};
}

/// An estimate is within its residual, 1 %, of the true value, which power iteration finds from below within 1e-3.
void expect_estimate(double estimated, double truth) {
  EXPECT_GE(estimated, 0.99 * truth);
  EXPECT_LE(estimated, 1.012 * truth);
}

/// All kinds of elements and precisions.
std::vector<ElementOptions> all_elements() {
  return {ThreeFieldOptions{}, ThinWallOptions{.precision = Precision::double_precision},
          ThinWallOptions{.precision = Precision::single_precision}};
}

TEST(StableStep, IsThatOfTheLargestMode) {
  const std::vector<std::pair<meshes::HexahedralMesh, double>> bodies{{hollow_cube(), 2e-3},
                                                                      {meshes::box({10e-3, 2e-3, 2e-3}, {5, 1, 1}), 2e-3},
                                                                      {meshes::box({8e-3, 8e-3, 8e-3}, {4, 4, 4}), 2e-3},
                                                                      {meshes::box({10e-3, 8e-3, 1e-3}, {5, 4, 1}), 1e-3}};
  for (const auto& [mesh, edge] : bodies) {
    for (const ElementOptions& elements : all_elements()) {
      ExplicitBodyOptions options = silicone_options(mesh);
      options.elements = elements;
      const ExplicitBody body(mesh, options);
      for (const std::vector<double>& displacements : states(mesh, edge)) {
        SCOPED_TRACE(std::to_string(mesh.elements.size()) + " elements, " + body.elements().text());
        expect_estimate(estimate(body, displacements).stiffness_per_s2, largest_eigenvalue(body, displacements, false));
      }
    }
  }
}

// Held nodes take part in no mode, and a law that stiffens has another tangent at each state.
TEST(StableStep, CountsSupportsStiffeningLawsAndViscosity) {
  const meshes::HexahedralMesh mesh = meshes::box({8e-3, 4e-3, 4e-3}, {4, 2, 2});
  for (const ElementOptions& elements : all_elements()) {
    ExplicitBodyOptions options = silicone_options(mesh, 5.0);
    options.regions[0].material.law = materials::Yeoh{25e3, 5e3, 3e3};
    options.supports = {{meshes::label_index(mesh, "x min"), {true, true, true}}};
    options.elements = elements;
    const ExplicitBody body(mesh, options);
    for (const std::vector<double>& displacements : states(mesh, 2e-3)) {
      SCOPED_TRACE(body.elements().text());
      const LargestEigenvalues found = estimate(body, displacements);
      expect_estimate(found.stiffness_per_s2, largest_eigenvalue(body, displacements, false));
      expect_estimate(found.damping_per_s, largest_eigenvalue(body, displacements, true));
    }
  }
}

// A branch ten times as stiff as usual, as it is after slow motion (at rest in each state), after a jump (at rest at first), and
// on the way back from where the material was stretched.
TEST(StableStep, CountsBranches) {
  const meshes::HexahedralMesh mesh = meshes::box({8e-3, 4e-3, 4e-3}, {4, 2, 2});
  for (const ElementOptions& elements : all_elements()) {
    ExplicitBodyOptions options = silicone_options(mesh);
    options.regions[0].material.branches = {{.shear_modulus_Pa = 100e3, .relaxation_time_s = 1e-3}};
    options.elements = elements;
    const ExplicitBody body(mesh, options);
    const std::vector<std::vector<double>> all = states(mesh, 2e-3);
    for (const std::vector<double>& past : all) {
      BranchNumbers branches = body.elements().branches_at_rest(past);
      for (const std::vector<double>& displacements : all) {
        SCOPED_TRACE(body.elements().text());
        expect_estimate(estimate(body, displacements, branches).stiffness_per_s2,
                        largest_eigenvalue(body, displacements, false, branches));
      }
    }
  }
}

// A spring between a node at one end and a face at the other, as stiff as the elements, and ten and a hundred times as stiff.
TEST(StableStep, CountsTouches) {
  const meshes::HexahedralMesh mesh = meshes::box({8e-3, 4e-3, 4e-3}, {4, 2, 2});
  ExplicitBodyOptions options = silicone_options(mesh);
  options.elements = ThinWallOptions{.precision = Precision::double_precision};
  const ExplicitBody body(mesh, options);
  const std::vector<double> rest(3 * mesh.points.size(), 0.0);
  const auto node_at = [&](const Point& place) {
    const auto found = std::ranges::find_if(mesh.points, [&](const Point& X) { return norm(difference(X, place)) < 1e-9; });
    return static_cast<std::uint32_t>(found - mesh.points.begin());
  };
  SelfTouch touch{.node = node_at({0.0, 0.0, 0.0}),
                  .surface = 0,
                  .face_nodes = {node_at({8e-3, 0.0, 0.0}), node_at({8e-3, 2e-3, 0.0}), node_at({8e-3, 2e-3, 2e-3}),
                                 node_at({8e-3, 0.0, 2e-3})},
                  .weights = {0.4, 0.3, 0.2, 0.1},
                  .behind_m = {},
                  .spring_N_per_m = 0.0};
  const double alone = estimate(body, rest).stiffness_per_s2;
  for (const double stiffness : {1.0, 10.0, 100.0}) {
    touch.spring_N_per_m = stiffness * alone * body.masses_kg()[touch.node];
    BranchNumbers branches = body.elements().branches_at_rest(rest);
    const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
    const BlockLoop loop(1);
    const double found =
        EigenvalueEstimate(body, loop, *forces).at(rest, branches, *forces, {}, std::span(&touch, 1)).stiffness_per_s2;
    EXPECT_GT(found, 1.2 * alone);
    expect_estimate(found, largest_eigenvalue(body, rest, false, branches, &touch));
  }
}

TEST(StableStep, DoesNotDependOnThreads) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  for (const ElementOptions& elements : all_elements()) {
    ExplicitBodyOptions options = silicone_options(mesh, 5.0);
    options.elements = elements;
    const ExplicitBody body(mesh, options);
    const std::vector<double> displacements = states(mesh, 2e-3)[2];
    const LargestEigenvalues alone = estimate(body, displacements);
    const LargestEigenvalues three = estimate(body, displacements, 3);
    EXPECT_EQ(alone.stiffness_per_s2, three.stiffness_per_s2);
    EXPECT_EQ(alone.damping_per_s, three.damping_per_s);
  }
}

// x'' + c x' + k x = 0 in central differences with the velocity of the last half step stays bounded up to this step.
TEST(StableStep, IsThatOfTheDampedOscillator) {
  const LargestEigenvalues oscillator{.stiffness_per_s2 = 4e4, .damping_per_s = 100.0};
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
TEST(StableStep, SeesTheLightestRegion) {
  meshes::HexahedralMesh mesh = meshes::box({10e-3, 2e-3, 2e-3}, {5, 1, 1});
  mesh.region_names = {"light", "heavy"};
  mesh.regions = {0, 0, 0, 0, 1};
  ExplicitBodyOptions options = silicone_options(mesh);
  options.regions[1].density_kg_per_m3 *= 10.0;
  const ExplicitBody body(mesh, options);
  const std::vector<double> rest(3 * mesh.points.size(), 0.0);
  expect_estimate(estimate(body, rest).stiffness_per_s2, largest_eigenvalue(body, rest, false));
}

// All nodes held: nothing moves, and no step is too long.
TEST(StableStep, OfAHeldBodyIsUnlimited) {
  const meshes::HexahedralMesh mesh = meshes::box({2e-3, 2e-3, 2e-3}, {1, 1, 1});
  ExplicitBodyOptions options = silicone_options(mesh);
  options.supports = {{meshes::label_index(mesh, "x min"), {true, true, true}},
                      {meshes::label_index(mesh, "x max"), {true, true, true}}};
  const ExplicitBody body(mesh, options);
  EXPECT_EQ(estimate(body, std::vector<double>(24, 0.0)).stiffness_per_s2, 0.0);
}

}  // namespace
}  // namespace menger::fem
