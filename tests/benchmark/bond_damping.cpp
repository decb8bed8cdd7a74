// What the time step and the way in which bonds are damped do to displacements: designs, scales, fractions of the recommended
// step and treatments of the damping, against a fortieth of the recommended step. bond_damping.md holds an outcome.
//   bench-bond-damping [table.csv] [highest level] [design]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "io/process/program.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "meshes/design/fractal.h"
#include "meshes/load_cases/observables.h"
#include "voxel/lanes/simulation.h"

namespace {

using namespace menger;

struct Design {
  std::string name;
  std::string digits;
};

/// The designs of the reference trajectories.
std::vector<Design> designs() {
  return {{"bar of 3", "112000000000000000000000000"},        {"plate of 9", "112122112000000000000000000"},
          {"12 random cells", "000010211000200112100200120"}, {"Menger", "211201211201000201211201211"},
          {"arch of 21", "201201201201201201111111222"},      {"full cube", "111111111111111111222222222"}};
}

constexpr double duration_s = 1.0;
constexpr double reference_fraction = 0.025;

struct Walk {
  io::RunStatus status = io::RunStatus::stopped;
  std::array<double, 3> displacement_m{};
  double seconds = 0.0;  ///< of the processor
};

Walk walk(const meshes::Polycube& body, double fraction, voxel::BondDamping bond_damping) {
  voxel::Physics physics;
  physics.stop_rotation_in_static_friction = true;
  physics.integration.time_step_fraction = fraction;
  physics.integration.bond_damping = bond_damping;
  voxel::Simulation simulation(body, 0.01, physics);
  const auto from_m = simulation.centre_of_mass_m();
  const std::clock_t start = std::clock();
  Walk walk;
  walk.status = simulation.advance_to(duration_s);
  walk.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const auto to_m = simulation.centre_of_mass_m();
  for (std::size_t axis = 0; axis < 3; ++axis) walk.displacement_m.at(axis) = to_m.at(axis) - from_m.at(axis);
  return walk;
}

double distance_m(const Walk& a, const Walk& b) {
  const auto& p = a.displacement_m;
  const auto& q = b.displacement_m;
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// The largest fraction of the recommended step, to 1 %, with which a body walks to the end at every fraction tried below it.
double largest_stable_fraction(const meshes::Polycube& body, voxel::BondDamping bond_damping) {
  double stable = 0.5;
  double unstable = 8.0;
  while (unstable / stable > 1.01) {
    const double middle = std::sqrt(stable * unstable);
    (walk(body, middle, bond_damping).status == io::RunStatus::completed ? stable : unstable) = middle;
  }
  return stable;
}

int measure(int argc, char** argv) {
  const std::filesystem::path file = argc > 1 ? argv[1] : "bond_damping.csv";
  const int highest = argc > 2 ? std::atoi(argv[2]) : 2;
  const std::string only = argc > 3 ? argv[3] : "";
  const std::array treatments{voxel::BondDamping::explicit_step, voxel::BondDamping::semi_implicit};
  io::CsvTable table({"design", "level", "voxels", "bond_damping", "largest_stable_fraction", "time_step_fraction", "status",
                      "horizontal_displacement_m", "error_m", "error_share", "seconds"});
  for (int level = 1; level <= highest; ++level) {
    for (const Design& design : designs()) {
      if (!only.empty() && design.name != only) continue;
      const meshes::Polycube body = meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, design.digits), level);
      const Walk reference = walk(body, reference_fraction, voxel::BondDamping::explicit_step);
      const double path_m = std::hypot(reference.displacement_m[0], reference.displacement_m[1]);
      for (const voxel::BondDamping treatment : treatments) {
        const double stable = largest_stable_fraction(body, treatment);
        for (const double fraction : {0.025, 0.09, 0.225, 0.45, 0.9, 1.2, 1.8, 2.7}) {
          if (treatment == voxel::BondDamping::explicit_step && fraction == reference_fraction) continue;  // the reference itself
          const Walk tried = walk(body, fraction, treatment);
          const bool completed = tried.status == io::RunStatus::completed;
          const double error_m = distance_m(tried, reference);
          const auto if_completed = [&](double value) { return completed ? std::optional(value) : std::nullopt; };
          table.add_row(design.name, level, std::uint64_t{body.count()}, voxel::to_string(treatment), stable, fraction,
                        io::to_string(tried.status), if_completed(std::hypot(tried.displacement_m[0], tried.displacement_m[1])),
                        if_completed(error_m), if_completed(error_m / path_m), tried.seconds);
        }
        std::cout << design.name << ", level " << level << ", " << voxel::to_string(treatment) << ": stable up to "
                  << io::formatted("%.3g", stable) << std::endl;
      }
      table.write(file);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("bench-bond-damping", [&] { return measure(argc, argv); });
}
