#include <cmath>
#include <map>
#include <tuple>

#include "voxel/engine/voxel_classes.h"
#include "voxel/model/surrogate_beams.h"

namespace menger::voxel {
namespace {

/// What decides the coefficients of a voxel: mass, moment of inertia, wall classes, material, and whether it is fixed.
using VoxelKey = std::tuple<double, double, std::array<std::uint8_t, 3>, meshes::Material, bool>;

/// What decides the coefficients of a beam: classes and masses of its ends, and whether it crosses a joint.
using BeamKey = std::tuple<std::uint8_t, std::uint8_t, double, double, bool>;

VoxelCoefficients<double> voxel_row(const Physics& physics, const VoxelKey& key) {
  const auto& [mass, inertia, wall_class, material, fixed] = key;
  const SurrogateParameters& parameters = physics.surrogate->parameters;
  const double edge = parameters.voxel_edge_m();
  double spring = 0.0;
  for (const std::uint8_t c : wall_class) spring += section_of(parameters, c).axial_N / (3.0 * edge);
  const double ground = parameters.ground_stiffness_N_per_m;
  const VoxelMaterial& friction = physics.materials[static_cast<std::size_t>(material - 1)];
  const DampingRatios& ratios = physics.damping_ratios;
  return {.inverse_mass = fixed ? 0.0 : 1.0 / mass,
          .inverse_inertia = fixed ? 0.0 : 1.0 / inertia,
          .weight = mass * physics.gravity_m_s2,
          .global_damping = 2.0 * ratios.global * std::sqrt(mass * spring),
          .global_rotation_damping = 2.0 * ratios.global * std::sqrt(inertia * spring * edge * edge),
          .floor = {ground, 2.0 * ratios.collision * std::sqrt(mass * ground / 2.0), friction.static_friction,
                    friction.kinetic_friction}};
}

BeamCoefficients<double> beam_row(const Physics& physics, const BeamKey& key) {
  const auto& [lower_class, upper_class, lower_mass, upper_mass, crosses_joint] = key;
  const SurrogateParameters& parameters = physics.surrogate->parameters;
  BeamCoefficients<double> row =
      beam_coefficients(beam_section(parameters, lower_class, upper_class, crosses_joint), parameters.voxel_edge_m());
  set_damping(row, parameters.bond_damping_ratio, lower_mass, upper_mass, physics.integration.damping == DampingMode::velocity);
  return row;
}

/// Returns the index of the row of a key. A new key appends its row.
template <class Key, class Row, class Make>
std::size_t class_of(std::map<Key, std::size_t>& known, std::vector<Row>& rows, const Key& key, const Make& make) {
  const auto [entry, is_new] = known.try_emplace(key, rows.size());
  if (is_new) rows.push_back(make(key));
  return entry->second;
}

}  // namespace

BodyClasses calibrated_classes(const Lattice& lattice, const HollowVoxels& voxels, const Physics& physics,
                               const std::vector<bool>& fixed) {
  const SurrogateParameters& parameters = physics.surrogate->parameters;
  const double edge = parameters.voxel_edge_m();
  BodyClasses classes;
  classes.mass_kg = voxel_masses(voxels, parameters.density_kg_m3);
  std::map<VoxelKey, std::size_t> known_voxels;
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    const double mass = classes.mass_kg[i];
    const double inertia = voxels.inertia_factor[i] * mass * edge * edge / 6.0;
    classes.inertia_kg_m2.push_back(inertia);
    const VoxelKey key{mass, inertia, voxels.wall_class[i], lattice.material[i], !fixed.empty() && fixed[i]};
    classes.voxel_class.push_back(
        class_of(known_voxels, classes.voxel, key, [&](const VoxelKey& k) { return voxel_row(physics, k); }));
  }
  std::map<BeamKey, std::size_t> known_beams;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const auto lower = static_cast<std::size_t>(beams.lower[i]);
      const auto upper = static_cast<std::size_t>(beams.upper[i]);
      const BeamKey key{voxels.wall_class[lower][axis], voxels.wall_class[upper][axis], classes.mass_kg[lower],
                        classes.mass_kg[upper], voxels.chamber[lower] != voxels.chamber[upper]};
      classes.beam_class[axis].push_back(
          class_of(known_beams, classes.beam, key, [&](const BeamKey& k) { return beam_row(physics, k); }));
    }
  }
  // Padding beams carry nothing, but need a row.
  if (classes.beam.empty()) classes.beam.push_back(beam_row(physics, {0, 0, classes.mass_kg[0], classes.mass_kg[0], false}));
  return classes;
}

}  // namespace menger::voxel
