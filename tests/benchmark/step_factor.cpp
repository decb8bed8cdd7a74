// How long may a step of explicit dynamics be? Bodies that ring, with and without damping, at several factors on the stable step:
// the largest error of their energy balance over the energy that they began with. step_factor.md holds an outcome.
//   bench-step-factor [table.csv]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "fem/explicit/explicit_dynamics.h"
#include "fem/explicit/material_damping.h"
#include "fem/explicit/thin_wall_elements.h"
#include "fem/explicit/three_field_elements.h"
#include "fem/thin_walls/element_choice.h"
#include "io/process/program.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/run_status.h"
#include "materials/laws/hyperelastic_law.h"
#include "meshes/design/polycube.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace {

using namespace menger;

constexpr double speed_m_per_s = 0.5;
constexpr double duration_s = 1.0;
constexpr double interval_s = 0.01;
constexpr double shear_modulus_Pa = 50e3;
constexpr double bulk_modulus_Pa = 50.0 * shear_modulus_Pa;
constexpr double density_kg_per_m3 = 1070.0;

/// What the body is made of.
struct Elements {
  std::string name;
  bool are_thin_walls = true;
  fem::Fidelity fidelity = fem::Fidelity::standard;
};

/// What has become of the energy.
struct Outcome {
  io::RunStatus status = io::RunStatus::completed;
  double time_s = 0.0;
  std::size_t steps = 0;
  /// Smallest factor on the step beside that of the case: below 1 intervals were repeated with shorter steps, because an element
  /// turned inside out or the stable step fell below the one that was taken.
  double smallest_step_share = 1.0;
  double largest_imbalance =
      0.0;  ///< over the energy at the start; by its amount, with its sign: positive where energy was gained
};

/// An L of three cells of 10 mm with walls of 2 mm.
meshes::HexahedralMesh hook(const Elements& elements) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  if (elements.are_thin_walls) fem::set_elements({.fidelity = elements.fidelity}, options);
  return meshes::hollow_polycube({"hook", meshes::Polycube::from_digits(2, 1, 2, "1110"), 10e-3}, options).mesh;
}

fem::ExplicitBodyOptions silicone(const meshes::HexahedralMesh& mesh, const Elements& elements, bool is_damped) {
  fem::ExplicitRegion region{{materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{bulk_modulus_Pa}, 0.0},
                             density_kg_per_m3};
  if (is_damped) region.material.branches = {fem::maxwell_branch(shear_modulus_Pa, fem::assumed_silicone_loss())};
  fem::ExplicitBodyOptions options;
  options.regions.assign(mesh.region_names.size(), region);
  if (elements.are_thin_walls)
    options.elements = fem::ThinWallOptions{.precision = fem::Precision::double_precision, .constants = {}};
  return options;
}

/// Velocities that set every part of a body in another motion: each component is a wave over the body with this amplitude.
void set_ringing(const meshes::HexahedralMesh& mesh, fem::ExplicitState& state) {
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const auto& X = mesh.points[n];
    const std::array v{std::sin(400.0 * X[2]), std::cos(300.0 * X[0]), std::sin(350.0 * X[0] + 200.0 * X[1])};
    for (std::size_t i = 0; i < 3; ++i) state.velocities_m_per_s[3 * n + i] = speed_m_per_s * v[i];
  }
}

Outcome ring(const Elements& elements, bool is_damped, double factor, std::size_t steps_per_estimate) {
  const meshes::HexahedralMesh mesh = hook(elements);
  const fem::ExplicitBody body(mesh, silicone(mesh, elements, is_damped));
  fem::ExplicitOptions options;
  options.step_safety = factor;
  options.steps_per_bound = steps_per_estimate;
  options.largest_imbalance = std::numeric_limits<double>::max();  // what steps do by themselves
  fem::ExplicitDynamics dynamics(mesh, body, options);
  fem::ExplicitState state = dynamics.state();
  state.at_start_J.reset();
  set_ringing(mesh, state);
  dynamics.set_state(state);
  const double energy_J = dynamics.energies().kinetic_J;
  Outcome outcome;
  for (int n = 1; n * interval_s <= duration_s * (1.0 + 1e-9) && outcome.status == io::RunStatus::completed; ++n) {
    outcome.status = dynamics.advance_to(n * interval_s).status;
    const double imbalance = dynamics.energies().imbalance_J() / energy_J;
    if (std::abs(imbalance) > std::abs(outcome.largest_imbalance)) outcome.largest_imbalance = imbalance;
    outcome.smallest_step_share = std::min(outcome.smallest_step_share, dynamics.state().step_share);
  }
  outcome.time_s = dynamics.state().time_s;
  outcome.steps = dynamics.state().steps;
  return outcome;
}

int measure(int argc, char** argv) {
  const std::filesystem::path file = argc > 1 ? argv[1] : "step_factor.csv";
  io::CsvTable table({"elements", "damped", "factor", "most_steps_per_estimate", "status", "time_s", "steps",
                      "smallest_step_share", "largest_imbalance"});
  const std::array all{Elements{"draft", true, fem::Fidelity::draft}, Elements{"standard", true, fem::Fidelity::standard},
                       Elements{"fine", true, fem::Fidelity::fine}, Elements{"three_field", false, {}}};
  for (const Elements& elements : all) {
    for (const bool is_damped : {false, true}) {
      for (const std::size_t steps_per_estimate : {std::size_t{1000}, std::size_t{50}}) {
        for (const double factor : {0.5, 0.7, 0.8, 0.85, 0.9, 0.95}) {
          const Outcome outcome = ring(elements, is_damped, factor, steps_per_estimate);
          table.add_row(elements.name, is_damped ? "yes" : "no", factor, std::uint64_t{steps_per_estimate},
                        io::to_string(outcome.status), outcome.time_s, std::uint64_t{outcome.steps}, outcome.smallest_step_share,
                        outcome.largest_imbalance);
          table.write(file);
          std::cout << elements.name << (is_damped ? ", damped, " : ", ") << factor << " of the stable step, an estimate every "
                    << steps_per_estimate << " steps at most: " << io::formatted("%+.2g", 100.0 * outcome.largest_imbalance)
                    << " %, " << outcome.steps << " steps, " << io::to_string(outcome.status) << std::endl;
        }
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("bench-step-factor", [&] { return measure(argc, argv); });
}
