#include "fem/walk/walk_input.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "fem/contact/self_contact_surface.h"
#include "fem/surfaces/gas_law.h"
#include "fem/walk/walk_input_error.h"
#include "io/text/number_text.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::fem {
namespace {

constexpr double largest_record_count = 1e6;

/// Returns the height of the body's lowest point.
double lowest_m(const meshes::HexahedralMesh& mesh) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const meshes::Point& point : mesh.points) lowest = std::min(lowest, point[2]);
  return lowest;
}

void mesh_body(PreparedWalk& walk) {
  try {
    set_elements(walk.elements, walk.hollow);
    walk.mesh = meshes::hollow_polycube(walk.design, walk.hollow).mesh;
  } catch (const io::InputError& error) {
    throw WalkInputError("design", error.what());
  } catch (const std::length_error& error) {
    throw WalkInputError("design", error.what());
  }
}

void lay_ground(PreparedWalk& walk) {
  const double lowest = lowest_m(walk.mesh);
  walk.ground =
      walk.stated_ground.ground(lowest, ground_stiffness_Pa_per_m(contact_modulus_Pa(walk), shortest_edge_m(walk.mesh)));
  // Springs that are compressed at the start would throw the body up.
  if (walk.ground.height_m > lowest)
    throw WalkInputError("ground.height_m", "is above the body's lowest point, which is at " + io::number_text(lowest));
  walk.stated_ground.height_m = walk.ground.height_m;
  walk.stated_ground.stiffness_Pa_per_m = walk.ground.stiffness_Pa_per_m;
  const Friction& friction = walk.ground.friction;
  if (walk.self_contact && !walk.self_contact->friction)
    walk.self_contact->friction = {friction.static_coefficient, friction.kinetic_coefficient};
}

void drive_plena(PreparedWalk& walk) {
  if (!walk.drive) return;
  if (!walk.drive->ramp_s) walk.drive->ramp_s = 1.0 / walk.drive->frequency_Hz;
  const std::vector<PlenumSchedule> schedules = plenum_schedules(*walk.drive, walk.design, walk.hollow, walk.mesh);
  walk.supply.emplace(std::vector<PlenumSupply>(schedules.begin(), schedules.end()));
}

/// Written so that NaN fails, too.
void demand(bool is_met, const char* key, double value, const char* reason) {
  if (!is_met) throw WalkInputError(key, io::number_text(value) + ": " + reason);
}

void check(const WalkSilicone& silicone) {
  demand(silicone.modulus_factor > 0.0, "material.modulus_factor", silicone.modulus_factor, "must be > 0");
  const double modulus_Pa = silicone.youngs_modulus_Pa.value_or(1.0);
  demand(modulus_Pa > 0.0, "material.youngs_modulus_Pa", modulus_Pa, "must be > 0");
  demand(silicone.bulk_modulus_ratio >= 1.0, "material.bulk_modulus_ratio", silicone.bulk_modulus_ratio, "must be at least 1");
  const double density = silicone.density_kg_per_m3.value_or(1.0);
  demand(density > 0.0, "material.density_kg_per_m3", density, "must be > 0");
  const double loss = silicone.loss_factor.value_or(0.0);
  demand(loss >= 0.0, "material.loss_factor", loss, "must be >= 0");
  demand(silicone.loss_frequency_Hz > 0.0, "material.loss_frequency_Hz", silicone.loss_frequency_Hz, "must be > 0");
  if (!silicone.loss_factors) return;
  const std::vector<double>& frequencies_Hz = silicone.loss_frequencies_Hz;
  const auto count = static_cast<double>(frequencies_Hz.size());
  demand(!frequencies_Hz.empty() && frequencies_Hz.size() == silicone.loss_factors->size(), "material.loss_frequencies_Hz", count,
         "there must be as many as loss_factors");
  demand(std::ranges::is_sorted(frequencies_Hz) && frequencies_Hz.front() > 0.0, "material.loss_frequencies_Hz",
         frequencies_Hz.front(), "must be > 0 and ascend");
  demand(std::ranges::all_of(*silicone.loss_factors, [](double factor) { return factor > 0.0; }), "material.loss_factors", count,
         "must be > 0");
}

void check(const SurrogateDrive& drive) {
  const auto& [lowest_Pa, highest_Pa] = drive.pressure_Pa;
  demand(lowest_Pa > -standard_atmosphere_Pa, "drive.pressure_Pa", lowest_Pa, "reaches a perfect vacuum or less");
  demand(lowest_Pa <= highest_Pa, "drive.pressure_Pa", highest_Pa, "must ascend: lowest, then highest");
  demand(drive.frequency_Hz > 0.0, "drive.frequency_Hz", drive.frequency_Hz, "must be > 0");
  demand(drive.ramp_s.value_or(0.0) >= 0.0, "drive.ramp_s", drive.ramp_s.value_or(0.0), "must be >= 0");
  demand(drive.wave_axis >= 0 && drive.wave_axis <= 2, "drive.wave_axis", drive.wave_axis, "must be 0, 1 or 2");
}

void check(const StudyGround& ground) {
  const Friction& friction = ground.friction;
  demand(friction.kinetic_coefficient >= 0.0, "ground.kinetic_friction", friction.kinetic_coefficient, "must be >= 0");
  demand(friction.static_coefficient >= friction.kinetic_coefficient, "ground.static_friction", friction.static_coefficient,
         "must be at least the kinetic one");
  const double stiffness = ground.stiffness_Pa_per_m.value_or(1.0);
  demand(stiffness > 0.0, "ground.stiffness_Pa_per_m", stiffness, "must be > 0");
  demand(friction.regularisation_speed_m_per_s >= 0.0, "ground.regularisation_speed_m_per_s",
         friction.regularisation_speed_m_per_s, "must be >= 0");
  if (!friction.directional) return;
  const double backward = friction.directional->backward_factor;
  const double sideways = friction.directional->sideways_factor;
  demand(backward >= 0.0, "ground.directional.backward_factor", backward, "must be >= 0");
  demand(sideways >= 0.0, "ground.directional.sideways_factor", sideways, "must be >= 0");
  const auto& [x, y] = friction.directional->forward;
  demand(std::hypot(x, y) > 0.0, "ground.directional.forward", x, "must be two numbers that are not both 0");
}

}  // namespace

void prepare(PreparedWalk& walk, DampingModel usual) {
  mesh_body(walk);
  walk.material = material_of(walk.silicone, usual, walk.notes);
  lay_ground(walk);
  drive_plena(walk);
}

void check(const WalkInput& input) {
  demand(input.design.cell_edge_m > 0.0, "design.cell_edge_m", input.design.cell_edge_m, "must be > 0");
  demand(input.gravity_m_per_s2 >= 0.0, "loads.gravity_m_per_s2", input.gravity_m_per_s2, "must be >= 0");
  demand(input.duration_s > 0.0, "time.duration_s", input.duration_s, "must be > 0");
  demand(input.record_interval_s > 0.0 && input.record_interval_s <= input.duration_s, "time.record_interval_s",
         input.record_interval_s, "must be > 0 and at most the duration");
  demand(input.duration_s / input.record_interval_s <= largest_record_count, "time.record_interval_s", input.record_interval_s,
         "makes more than a million records");
  check(input.silicone);
  check(input.stated_ground);
  if (input.drive && input.supply) throw WalkInputError("drive", "there is a supply of all plena, too: keep one of them");
  if (input.drive) check(*input.drive);
}

double contact_modulus_Pa(const PreparedWalk& walk) {
  if (walk.elements.kind == ElementKind::three_field) return walk.material.bulk_modulus_Pa;
  return contact_modulus_Pa(materials::shear_modulus_at_rest_Pa(walk.material.law));
}

ExplicitBodyOptions body_options(const PreparedWalk& walk) {
  ExplicitBodyOptions options;
  const WalkMaterial& material = walk.material;
  const ExplicitMaterial elements{material.law, materials::SimoTaylorVolume{material.bulk_modulus_Pa}, material.viscosity_Pa_s,
                                  material.branches};
  options.regions.assign(walk.mesh.region_names.size(), {elements, material.density_kg_per_m3});
  if (walk.elements.kind == ElementKind::thin_wall)
    options.elements = ThinWallOptions{.precision = walk.elements.precision, .constants = ThinWallConstants{}};
  return options;
}

ExplicitOptions dynamics_options(const PreparedWalk& walk) {
  ExplicitOptions options;
  options.loads.gravity_m_per_s2 = {0.0, 0.0, -walk.gravity_m_per_s2};
  options.loads.mass_damping_per_s = walk.mass_damping_per_s;
  options.loads.ground = walk.ground;
  options.supply = walk.supply;
  options.step_safety = walk.step_safety;
  options.largest_step_s = walk.largest_step_s;
  options.self_contact = walk.self_contact;
  options.threads = walk.threads;
  return options;
}

std::vector<double> record_times_s(const WalkInput& walk) {
  // The last record is at the duration itself, which need not be a multiple of the interval.
  const auto intervals = static_cast<std::uint64_t>(std::ceil(walk.duration_s / walk.record_interval_s * (1.0 - 1e-12)));
  std::vector<double> times;
  for (std::uint64_t i = 1; i < intervals; ++i) times.push_back(static_cast<double>(i) * walk.record_interval_s);
  times.push_back(walk.duration_s);
  return times;
}

}  // namespace menger::fem
