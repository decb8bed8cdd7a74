// Lateral coupling up to a Poisson's ratio near a half.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "meshes/design/reference_shapes.h"
#include "tests/extremes/voxel_rows.h"
#include "voxel/engine/time_step.h"

namespace menger::extremes {

namespace {

/// The response of the middle of a bar to forces on its ends.
struct Pulled {
  double contraction = 0.0;  ///< transverse strain divided by axial strain, positive if the bar becomes narrower
  double stiffness = 0.0;    ///< axial stress divided by axial strain and by the modulus of the beams
};

Pulled middle_of(const voxel::Simulation& simulation, int n, int length, double stress_by_modulus) {
  const auto at = [&](int x, int y, int z) {
    const int voxel = x + n * (y + n * z);
    return simulation.position_m(static_cast<std::size_t>(voxel));
  };
  const int low = length / 2 - 1;
  double width_m = 0.0;
  double height_m = 0.0;
  for (int y = 0; y < n; ++y) {
    for (const int z : {low, low + 1}) width_m += 0.5 * (at(n - 1, y, z)[0] - at(0, y, z)[0]) / n;
    for (int x = 0; x < n; ++x) height_m += (at(x, y, low + 1)[2] - at(x, y, low)[2]) / (n * n);
  }
  const double strain = height_m / edge_m - 1.0;
  return {(1.0 - width_m / (edge_m * (n - 1))) / strain, stress_by_modulus / strain};
}

/// Wide bars are longer and softer, so their slowest modes need more time to decay.
constexpr double settling_s_by_width = 0.015;

/// Computes a bar of n x n voxels, slightly more than twice as long as wide, that is stretched by forces on its ends.
Pulled pulled(Outcome& outcome, double coupling, int n) {
  const int length = 2 * n + 2;
  meshes::Polycube body(n, n, length);
  for (int z = 0; z < length; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) body.set({x, y, z}, 1);
  voxel::Physics physics = floating_physics();
  physics.lateral_coupling = coupling;
  physics.damping_ratios.global = 0.02;
  const std::size_t layer = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  const double stress_by_modulus = 1e-3 * wide_bar_stiffness(coupling);
  const double force_N = stress_by_modulus * modulus_Pa * edge_m * edge_m;
  voxel::VoxelLoads loads;
  loads.force_N.assign(body.count(), {0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < layer; ++i) {
    loads.force_N[i][2] = -force_N;
    loads.force_N[body.count() - 1 - i][2] = force_N;
  }
  voxel::Simulation simulation(body, edge_m, physics, loads);
  const io::RunStatus status = simulation.advance_to(std::max(0.12, settling_s_by_width * n));
  if (status != io::RunStatus::completed) expect_completed(outcome, simulation, status);
  return middle_of(simulation, n, length, stress_by_modulus);
}

/// Bars of three widths, and the results expected for them relative to finite elements.
struct Pull {
  double poissons_ratio;
  int narrowest;                               ///< voxels across; the other bars are 2 and 4 times as wide
  double stiffness_tolerance;                  ///< relative, of the value extrapolated from the three bars to a wide bar
  double least_stiffness, most_stiffness;      ///< of the widest bar
  double least_contraction, most_contraction;  ///< of the widest bar

  [[nodiscard]] int widest() const { return 4 * narrowest; }
};

/// The relative error of the stiffness is a / n for n voxels across, because the beams on the surface have half the neighbours: a
/// is 0.3 for nu = 0.3, 6 for 0.49 and 22 for 0.4975. The extrapolation removes the first two orders in a / n. So its error is
/// less than a thousandth if the narrowest bar is wider than a voxels, and of the order of a tenth otherwise.
constexpr std::array pulls{Pull{0.3, 2, 0.001, 1.02, 1.04, 1.04, 1.06}, Pull{0.45, 2, 0.005, 1.15, 1.17, 1.07, 1.09},
                           Pull{0.49, 2, 0.2, 1.79, 1.83, 1.08, 1.10}, Pull{0.49, 4, 0.001, 1.33, 1.35, 1.03, 1.05},
                           Pull{0.4975, 4, 0.05, 2.32, 2.38, 1.04, 1.06}};

/// Under forces on the ends the deformation of finite elements is homogeneous, so their result is exactly nu and Young's modulus.
void run_pull(Outcome& outcome, const Pull& pull) {
  const double coupling = coupling_of(pull.poissons_ratio);
  const Pulled narrow = pulled(outcome, coupling, pull.narrowest);
  const Pulled middle = pulled(outcome, coupling, 2 * pull.narrowest);
  const Pulled wide = pulled(outcome, coupling, pull.widest());
  const double stiffness = wide_bar_stiffness(coupling);
  const auto errors = [&](int width, const Pulled& one) {
    return std::to_string(width) + " voxels wide: contraction " + shown(one.contraction / pull.poissons_ratio, 3) +
           " and stiffness " + shown(one.stiffness / stiffness, 3) + " times those of finite elements";
  };
  outcome.note(errors(pull.narrowest, narrow) + "; " + errors(2 * pull.narrowest, middle));
  const std::string widest = std::to_string(pull.widest()) + " voxels wide: ";
  outcome.expect_between(widest + "contraction by that of finite elements", wide.contraction / pull.poissons_ratio,
                         pull.least_contraction, pull.most_contraction);
  outcome.expect_between(widest + "stiffness by that of finite elements", wide.stiffness / stiffness, pull.least_stiffness,
                         pull.most_stiffness);
  outcome.expect_near("contraction of a wide bar", extrapolated(narrow.contraction, middle.contraction, wide.contraction),
                      coupling / (1.0 + coupling), 0.01);
  outcome.expect_near("stiffness of a wide bar by E", extrapolated(narrow.stiffness, middle.stiffness, wide.stiffness), stiffness,
                      pull.stiffness_tolerance);
  outcome.expect(narrow.contraction > middle.contraction && middle.contraction > wide.contraction &&
                     narrow.stiffness > middle.stiffness && middle.stiffness > wide.stiffness,
                 "both fall with the width");
}

/// An undamped cube of 5 x 5 x 5 voxels. Each voxel starts with another velocity.
void run_step(Outcome& outcome) {
  constexpr int n = 5;
  constexpr double coupling = 0.999;
  const meshes::Polycube body = meshes::full_cube(n);
  voxel::Physics physics = floating_physics();
  const double uncoupled_s = voxel::recommended_time_step_s(body, edge_m, physics);
  physics.lateral_coupling = coupling;
  outcome.expect_near("step without coupling by that with it",
                      uncoupled_s / voxel::recommended_time_step_s(body, edge_m, physics), std::sqrt(1.0 + 2.0 * coupling),
                      1e-12);
  constexpr double poissons_ratio = 0.49;
  voxel::Physics solid = physics;
  solid.lateral_coupling = coupling_of(poissons_ratio);
  const double stiffer = 1.0 / wide_bar_stiffness(solid.lateral_coupling);
  for (voxel::VoxelMaterial& material : solid.materials) material.youngs_modulus_Pa *= stiffer;
  outcome.expect_near("the same for one Young's modulus and nu = 0.49",
                      uncoupled_s / voxel::recommended_time_step_s(body, edge_m, solid),
                      std::sqrt((1.0 + 2.0 * solid.lateral_coupling) * stiffer), 1e-12);
  physics.damping_ratios.bond = 0.0;
  voxel::VoxelLoads loads;
  double start_energy_J = 0.0;
  for (std::size_t i = 0; i < body.count(); ++i) {
    const auto phase = static_cast<double>(i);
    loads.initial_velocity_m_s.push_back(
        {1e-4 * std::sin(17.0 * phase), 1e-4 * std::sin(29.0 * phase), 1e-4 * std::cos(23.0 * phase)});
    for (const double speed : loads.initial_velocity_m_s.back()) start_energy_J += 0.5 * mass_kg * speed * speed;
  }
  voxel::Simulation simulation(body, edge_m, physics, loads, with_ledger);
  expect_completed(outcome, simulation, simulation.advance(10000));
  outcome.expect_between("largest energy by that at the start", simulation.energy()->largest_energy_J / start_energy_J, 0.5, 1.1);
  expect_energy_error(outcome, simulation, 1e-5);
}

}  // namespace

std::vector<Row> voxel_coupling_rows() {
  std::vector<Row> rows;
  for (const Pull& pull : pulls) {
    const double coupling = coupling_of(pull.poissons_ratio);
    const std::string widths =
        std::to_string(pull.narrowest) + ", " + std::to_string(2 * pull.narrowest) + " and " + std::to_string(pull.widest());
    rows.push_back({.name = "lateral coupling for nu of " + shown(pull.poissons_ratio) + " from " +
                            std::to_string(pull.narrowest) + " voxels across",
                    .done = "bars " + widths + " voxels wide stretched by forces on their ends, c = " + shown(coupling),
                    .expected = "the widest contracts " + shown(pull.least_contraction) + " to " + shown(pull.most_contraction) +
                                " times as much as finite elements and is " + shown(pull.least_stiffness) + " to " +
                                shown(pull.most_stiffness) +
                                " times as stiff; in a wide bar, after taking out errors in 1/width and its square, their "
                                "contraction, c / (1 + c) = nu, to 1 %, and their stiffness, (1 - c)(1 + 2 c) / (1 + c) = " +
                                shown(wide_bar_stiffness(coupling)) + " of that of the beams, to " +
                                shown(100.0 * pull.stiffness_tolerance) + " %: what the cube of 1/width leaves",
                    .is_slow = pull.narrowest > 2,
                    .run = [pull](Outcome& outcome) { run_pull(outcome, pull); }});
  }
  rows.push_back(
      {.name = "step under lateral coupling of 0.999",
       .done = "undamped cube of 5 x 5 x 5 in random motion at 0.9 of the recommended step, 10000 steps",
       .expected = "the step is shorter by sqrt(1 + 2 c), sqrt 3 at most, at one modulus of the beams; for one Young's modulus "
                   "these have to be stiffer, too, at nu = 0.49 by 17.1, and the step is shorter by 7.1; stable: the energy "
                   "stays that of the start but for "
                   "the oscillation of the scheme, 10 %, and the energy balance closes to 1e-5",
       .run = run_step});
  return rows;
}

}  // namespace menger::extremes
