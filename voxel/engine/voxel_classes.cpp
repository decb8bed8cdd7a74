#include "voxel/engine/voxel_classes.h"

#include <algorithm>
#include <cmath>

#include "voxel/engine/time_step.h"
#include "voxel/model/bond_damping.h"

namespace menger::voxel {

namespace {

BeamCoefficients<double> beam_between(const Physics& physics, std::size_t lower, std::size_t upper, double edge) {
  const double modulus = beam_modulus_Pa(physics.materials[lower], physics.materials[upper]);
  const double edge2 = edge * edge;
  BeamCoefficients<double> c{};
  c.axial = modulus * edge2;
  c.twist = modulus * edge2 * edge / 12.0;
  c.shear = modulus * edge;
  c.bend = modulus * edge2 / 2.0;
  c.turn = modulus * edge2 * edge / 6.0;
  c.axial_root = std::sqrt(modulus * edge);
  c.shear_root = std::sqrt(c.shear);
  c.bend_root = std::sqrt(c.bend * edge / 2.0);
  c.turn_root = std::sqrt(c.turn * edge2 / 6.0);
  c.twist_root = std::sqrt(c.twist * edge2 / 6.0);
  const double ratio = effective_bond_ratio(physics);
  c.damping_lower = ratio * std::sqrt(voxel_mass_kg(physics.materials[lower], edge));
  c.damping_upper = ratio * std::sqrt(voxel_mass_kg(physics.materials[upper], edge));
  const bool balances = physics.beam_moments == BeamMoments::balanced;
  if (balances || physics.integration.damping == DampingMode::velocity)
    c.damping_lower = c.damping_upper = 0.5 * (c.damping_lower + c.damping_upper);
  return c;
}

}  // namespace

ClassTables class_tables(const Physics& physics, double cell_edge_m) {
  const double edge = cell_edge_m;
  ClassTables tables;
  for (const VoxelMaterial& material : physics.materials) {
    const double mass = voxel_mass_kg(material, edge);
    tables.mass_kg.push_back(mass);
    tables.inertia_kg_m2.push_back(mass * edge * edge / 6.0);
  }
  for (const bool fixed : {false, true}) {
    for (std::size_t m = 0; m < 2; ++m) {
      const VoxelMaterial& material = physics.materials[m];
      const double mass = tables.mass_kg[m];
      const double inertia = tables.inertia_kg_m2[m];
      const double spring = material.youngs_modulus_Pa * edge;
      VoxelCoefficients<double> c{};
      c.inverse_mass = fixed ? 0.0 : 1.0 / mass;
      c.inverse_inertia = fixed ? 0.0 : 1.0 / inertia;
      c.weight = mass * physics.gravity_m_s2;
      c.global_damping = 2.0 * physics.damping_ratios.global * std::sqrt(mass * spring);
      c.global_rotation_damping = 2.0 * physics.damping_ratios.global * std::sqrt(inertia * spring * edge * edge);
      c.floor = {2.0 * spring, 2.0 * physics.damping_ratios.collision * std::sqrt(mass * spring), material.static_friction,
                 material.kinetic_friction};
      tables.voxel.push_back(c);
    }
  }
  for (std::size_t upper = 0; upper < 2; ++upper) {
    for (std::size_t lower = 0; lower < 2; ++lower) tables.beam.push_back(beam_between(physics, lower, upper, edge));
  }
  return tables;
}

BodyClasses solid_classes(const Lattice& lattice, double cell_edge_m, const Physics& physics, const std::vector<bool>& fixed) {
  ClassTables tables = class_tables(physics, cell_edge_m);
  BodyClasses classes;
  std::array<bool, 2> used{};
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    const auto material = static_cast<std::size_t>(lattice.material[i] - 1);
    used[material] = true;
    classes.voxel_class.push_back(material + (!fixed.empty() && fixed[i] ? 2 : 0));
    classes.mass_kg.push_back(tables.mass_kg[material]);
    classes.inertia_kg_m2.push_back(tables.inertia_kg_m2[material]);
  }
  const auto material_of = [&](std::int32_t voxel) {
    return static_cast<std::size_t>(lattice.material[static_cast<std::size_t>(voxel)] - 1);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i)
      classes.beam_class[axis].push_back(material_of(beams.lower[i]) + 2 * material_of(beams.upper[i]));
  }
  const bool any_fixed = std::find(fixed.begin(), fixed.end(), true) != fixed.end();
  classes.uniform = !any_fixed && (!(used[0] && used[1]) || physics.materials[0] == physics.materials[1]);
  classes.beam_of_uniform = 3 * material_of(0);
  classes.voxel = std::move(tables.voxel);
  classes.beam = std::move(tables.beam);
  return classes;
}

}  // namespace menger::voxel
