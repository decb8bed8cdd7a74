#include "voxel/engine/time_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "voxel/model/bond_damping.h"
#include "voxel/model/calibrated_body.h"
#include "voxel/model/wall_feet.h"

namespace menger::voxel {

namespace {

/// Returns half of the largest stable step of the contacts of voxels of some materials, s; infinity without contacts.
/// @param used whether the body has voxels of each material
double step_of_contacts_s(const std::array<bool, 2>& used, double cell_edge_m, const Physics& physics) {
  double largest_s = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < used.size(); ++m) {
    const VoxelMaterial& material = physics.materials[m];
    if (physics.floor && used[m]) {
      const double own = std::sqrt(material.youngs_modulus_Pa * cell_edge_m / voxel_mass_kg(material, cell_edge_m));
      largest_s = std::min(largest_s, largest_contact_step_s(2.0 * own * own, 2.0 * physics.damping_ratios.collision * own));
    }
    for (std::size_t other = m; physics.collisions.exclusion_depth.has_value() && other < used.size(); ++other) {
      if (used[m] && used[other])
        largest_s = std::min(largest_s, largest_collision_step_s(material, physics.materials[other], cell_edge_m, physics));
    }
  }
  return 0.5 * largest_s;
}

}  // namespace

double slower_by_damping(const Physics& physics, const VoxelMaterial& a, const VoxelMaterial& b) {
  if (physics.integration.bond_damping != BondDamping::explicit_step) return 1.0;
  const double factor = bond_rate_factor(physics, a.density_kg_m3, b.density_kg_m3);
  return std::max(1.0, physics.damping_ratios.bond * factor);
}

double voxel_mass_kg(const VoxelMaterial& material, double cell_edge_m) {
  return material.density_kg_m3 * cell_edge_m * cell_edge_m * cell_edge_m;
}

double beam_modulus_Pa(const VoxelMaterial& a, const VoxelMaterial& b) {
  return 2.0 * a.youngs_modulus_Pa * b.youngs_modulus_Pa / (a.youngs_modulus_Pa + b.youngs_modulus_Pa);
}

double largest_contact_step_s(double stiffness_per_mass, double damping_per_mass) {
  // Steps with the damping of the last velocity are stable for k dt^2 + 2 c dt < 4.
  const double k = stiffness_per_mass;
  const double c = damping_per_mass;
  return 4.0 / (c + std::sqrt(c * c + 4.0 * k));
}

double largest_collision_step_s(const VoxelMaterial& a, const VoxelMaterial& b, double cell_edge_m, const Physics& physics) {
  const auto damping = [&](const VoxelMaterial& material) {
    return physics.damping_ratios.collision *
           std::sqrt(voxel_mass_kg(material, cell_edge_m) * material.youngs_modulus_Pa * cell_edge_m);
  };
  const double per_mass = 1.0 / voxel_mass_kg(a, cell_edge_m) + 1.0 / voxel_mass_kg(b, cell_edge_m);
  return largest_contact_step_s(2.0 * beam_modulus_Pa(a, b) * cell_edge_m * per_mass, (damping(a) + damping(b)) * per_mass);
}

double recommended_time_step_s(const Lattice& lattice, double cell_edge_m, const Physics& physics) {
  const auto material_of = [&](std::int32_t voxel) -> const VoxelMaterial& {
    return physics.materials[static_cast<std::size_t>(lattice.material[static_cast<std::size_t>(voxel)] - 1)];
  };
  double largest = 0.0;
  for (const AxisBeams& beams : lattice.beams) {
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const VoxelMaterial& a = material_of(beams.lower[i]);
      const VoxelMaterial& b = material_of(beams.upper[i]);
      const double lighter = std::min(voxel_mass_kg(a, cell_edge_m), voxel_mass_kg(b, cell_edge_m));
      const double slower = slower_by_damping(physics, a, b);
      largest = std::max(largest, beam_modulus_Pa(a, b) * cell_edge_m / lighter * (slower * slower));
    }
  }
  const bool has_contacts = physics.floor || physics.collisions.exclusion_depth.has_value();
  std::array<bool, 2> used{};
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    used.at(static_cast<std::size_t>(lattice.material[i] - 1)) = true;
    const VoxelMaterial& material = material_of(static_cast<std::int32_t>(i));
    const double mass = voxel_mass_kg(material, cell_edge_m);
    const bool alone =
        std::all_of(lattice.neighbours[i].begin(), lattice.neighbours[i].end(), [](std::int32_t other) { return other < 0; });
    if (!alone && !has_contacts) continue;
    // The mean of two equal moduli may differ from them in its last digit. So bodies of one modulus keep the step of their beams.
    const double modulus_Pa = alone ? material.youngs_modulus_Pa : beam_modulus_Pa(material, material);
    largest = std::max(largest, modulus_Pa * cell_edge_m / mass);
  }
  largest *= 1.0 + 2.0 * effective_coupling(physics);
  return std::min(1.0 / (2.0 * std::numbers::pi * std::sqrt(largest)), step_of_contacts_s(used, cell_edge_m, physics));
}

double largest_standing_step_s(const FloorCoefficients<double>& floor, double mass_kg, double inertia_kg_m2, double edge_m) {
  // Middle and corners of a wall, and four crowns of a quarter each, all of them half an edge below the centre.
  constexpr double feet = feet_of_a_wall + 1.0;
  constexpr double feet_beside = 5.0;  // half an edge to the side
  const double below = 0.5 * edge_m;
  // A shift and the rotation about the axis perpendicular to it, coupled by the friction at the feet.
  const double shift = feet / mass_kg;
  const double turn = (feet + feet_beside) * below * below / inertia_kg_m2;
  const double coupled = feet * below / std::sqrt(mass_kg * inertia_kg_m2);
  const double stiffest = 0.5 * (shift + turn) + std::hypot(0.5 * (shift - turn), coupled);
  return largest_contact_step_s(floor.stiffness / feet_of_a_wall * stiffest, floor.damping / feet_of_a_wall * stiffest);
}

double recommended_time_step_s(const Lattice& lattice, const BodyClasses& classes, double edge_m, const Physics& physics) {
  const double coupling = effective_coupling(physics);
  double largest = 0.0;
  double damping = 0.0;  // ratio of beams, each end's to its own mass
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const auto lower = static_cast<std::size_t>(beams.lower[i]);
      const auto upper = static_cast<std::size_t>(beams.upper[i]);
      const BeamCoefficients<double>& beam = classes.beam[classes.beam_class[axis][i]];
      const double mass = std::min(classes.mass_kg[lower], classes.mass_kg[upper]);
      const double inertia = std::min(classes.inertia_kg_m2[lower], classes.inertia_kg_m2[upper]);
      const double stretch = (1.0 + 2.0 * coupling) * beam.axial_root * beam.axial_root;
      // Shear reduces the stiffness against equal turns of both ends, but not that against the curvature between them.
      const double turn = beam.turn + beam.turn_difference;
      largest = std::max({largest, stretch / mass, beam.shear / mass, turn / inertia, beam.twist / inertia});
      damping = std::max({damping, beam.damping_lower / std::sqrt(classes.mass_kg[lower]),
                          beam.damping_upper / std::sqrt(classes.mass_kg[upper])});
    }
  }
  // The damping is explicit. From twice the paper's ratio on it shortens the step in proportion.
  constexpr double undamped = 2.0;
  double recommended_s = 1.0 / (2.0 * std::numbers::pi * std::sqrt(largest) * std::max(1.0, damping / undamped));
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    // Voxels press on other voxels with the same stiffness as on the ground.
    const FloorCoefficients<double>& floor = classes.voxel[classes.voxel_class[i]].floor;
    const double pressed = 0.5 * floor.stiffness / classes.mass_kg[i];
    recommended_s = std::min(recommended_s, 1.0 / (2.0 * std::numbers::pi * std::sqrt(pressed)));
    if (!physics.floor) continue;
    const double standing_s = largest_standing_step_s(floor, classes.mass_kg[i], classes.inertia_kg_m2[i], edge_m);
    recommended_s = std::min(recommended_s, 0.5 * standing_s);
  }
  return recommended_s;
}

double recommended_time_step_s(const meshes::Polycube& body, double cell_edge_m, const Physics& physics) {
  if (!physics.surrogate) return recommended_time_step_s(Lattice(body), cell_edge_m, physics);
  const HollowVoxels voxels = calibrated_voxels(body, *physics.surrogate);
  const Lattice lattice(voxels.body);
  return recommended_time_step_s(lattice, calibrated_classes(lattice, voxels, physics, {}),
                                 physics.surrogate->parameters.voxel_edge_m(), physics);
}

}  // namespace menger::voxel
