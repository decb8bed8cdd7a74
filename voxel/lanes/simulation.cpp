#include "voxel/lanes/simulation.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/text/formatted.h"
#include "io/text/joined_text.h"
#include "meshes/load_cases/observables.h"
#include "voxel/engine/engine.h"
#include "voxel/engine/scale_check.h"
#include "voxel/lanes/aggregate_engine.h"
#include "voxel/model/actuation.h"

namespace menger::voxel {

namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }

/// Checks a calibrated body and its drive. @return see check
std::vector<std::string> check_calibrated(const meshes::Polycube& body, double cell_edge_m, const Physics& physics,
                                          const VoxelLoads& loads) {
  const CalibratedBody& calibrated = *physics.surrogate;
  require(loads.size_factor.empty(), "a calibrated body has no size factors");
  require(calibrated.level >= 1, "level must be >= 1");
  require(std::isfinite(calibrated.pressure_Pa[0]) && calibrated.pressure_Pa[0] <= calibrated.pressure_Pa[1],
          "pressure_Pa must ascend");
  const meshes::Polycube basal = basal_body_of(body, calibrated.level);
  std::vector<std::string> outside = outside_validity(calibrated, basal);
  std::string sizeless = sizeless_walls(calibrated, basal);
  const bool has_sizes = sizeless.empty();
  if (!has_sizes) outside.push_back(std::move(sizeless));
  if (!has_sizes || (!outside.empty() && calibrated.outside_range == OutsideRange::refuse))
    throw OutsideValidity(io::joined(outside, "; "));
  std::string problem = unusable_parameters(calibrated, cell_edge_m);
  require(problem.empty(), problem.c_str());
  const HollowVoxels voxels = calibrated_voxels(body, calibrated);
  problem = unrealisable_phases(voxels, actuation_phases(Lattice(voxels.body), physics.actuation));
  require(problem.empty(), problem.c_str());
  return outside;
}

/// Checks all arguments of a simulation. @return sentences on a calibrated body and its drive outside the range of validity
std::vector<std::string> check(const meshes::Polycube& body, double cell_edge_m, const Physics& physics,
                               const VoxelLoads& loads) {
  require(body.count() > 0, "the body has no voxels");
  require(positive(cell_edge_m), "cell_edge_m must be > 0");
  for (const VoxelMaterial& material : physics.materials) {
    require(positive(material.youngs_modulus_Pa), "youngs_modulus_Pa must be > 0");
    require(positive(material.density_kg_m3), "density_kg_m3 must be > 0");
    require(not_negative(material.static_friction) && not_negative(material.kinetic_friction),
            "friction coefficients must be >= 0");
  }
  require(not_negative(physics.damping_ratios.bond) && not_negative(physics.damping_ratios.collision) &&
              not_negative(physics.damping_ratios.global),
          "damping ratios must be >= 0");
  require(not_negative(physics.gravity_m_s2), "gravity_m_s2 must be >= 0");
  require(not_negative(physics.actuation.amplitude) && physics.actuation.amplitude < 1.0,
          "the actuation amplitude must be in [0, 1)");
  require(positive(physics.actuation.frequency_Hz), "frequency_Hz must be > 0");
  require(not_negative(physics.actuation.ramp_s), "ramp_s must be >= 0");
  require(not_negative(physics.lateral_coupling) && physics.lateral_coupling < 1.0, "lateral_coupling must be in [0, 1)");
  require(physics.actuation.wave_axis >= 0 && physics.actuation.wave_axis <= 2, "wave_axis must be 0, 1 or 2");
  require(positive(physics.integration.time_step_fraction), "time_step_fraction must be > 0");
  require(!physics.collisions.exclusion_depth || *physics.collisions.exclusion_depth >= 1, "exclusion_depth must be >= 1");
  for (const double phase : physics.actuation.material_phase) require(std::isfinite(phase), "phases must be finite");
  require(std::isfinite(physics.actuation.wave_periods_per_body), "wave_periods_per_body must be finite");
  require(physics.integration.number == NumberType::float64 || physics.integration.damping == DampingMode::velocity,
          "float32 does not work with damping from increments");
  require(!physics.surrogate || physics.integration.bond_damping == BondDamping::explicit_step,
          "the damping of a calibrated body is part of its parameters");
  require(!physics.surrogate || physics.beam_moments == BeamMoments::published,
          "a calibrated body has published moments of beams, with which its parameters were fitted");
  require(positive(physics.limits.speed_fraction) && positive(physics.limits.strain), "divergence limits must be > 0");
  std::size_t voxels = body.count();
  std::vector<std::string> outside;
  if (physics.surrogate) {
    outside = check_calibrated(body, cell_edge_m, physics, loads);
    for (int axis = 0; axis < 3; ++axis) voxels *= static_cast<std::size_t>(physics.surrogate->parameters.voxels_per_cell);
  }
  const auto fits = [&](std::size_t size) { return size == 0 || size == voxels; };
  require(fits(loads.force_N.size()) && fits(loads.moment_N_m.size()) && fits(loads.initial_displacement_m.size()) &&
              fits(loads.initial_velocity_m_s.size()) && fits(loads.initial_angular_velocity_rad_s.size()) &&
              fits(loads.size_factor.size()) && fits(loads.fixed.size()),
          "loads need one entry per voxel");
  for (const auto& displacement : loads.initial_displacement_m) {
    for (const double value : displacement) require(std::isfinite(value), "initial displacements must be finite");
  }
  for (const double factor : loads.size_factor) require(positive(factor), "size factors must be > 0");
  const std::string problem = unusable_scales(physics, cell_edge_m, 0.0);
  require(problem.empty(), problem.c_str());
  return outside;
}

}  // namespace

Simulation::Simulation(const meshes::Polycube& body, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
                       const KernelOptions& options)
    : outside_validity_(check(body, cell_edge_m, physics, loads)) {
  if (physics.integration.number == NumberType::float64) {
    engine_ = std::make_unique<AggregateEngine<double>>(body, cell_edge_m, physics, loads, options);
  } else {
    engine_ = std::make_unique<AggregateEngine<float>>(body, cell_edge_m, physics, loads, options);
  }
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

io::RunStatus Simulation::advance(std::uint64_t steps, const std::atomic<bool>* stop) { return engine_->advance(steps, stop); }

io::RunStatus Simulation::advance_to(double time, const std::atomic<bool>* stop) {
  const std::uint64_t needed = steps_until(time, time_step_s());
  return engine_->advance(needed > steps() ? needed - steps() : 0, stop);
}

void Simulation::set_threads(int threads) { engine_->set_threads(threads); }

double Simulation::time_s() const { return static_cast<double>(steps()) * time_step_s(); }
std::uint64_t Simulation::steps() const { return engine_->record().steps; }
double Simulation::time_step_s() const { return engine_->body().time_step_s; }
std::size_t Simulation::voxel_count() const { return engine_->body().lattice.voxel_count(); }
std::size_t Simulation::beam_count() const { return engine_->body().lattice.beam_count(); }
const std::optional<Divergence>& Simulation::divergence() const { return engine_->record().divergence; }

std::array<double, 3> Simulation::centre_of_mass_m() const {
  std::vector<std::array<double, 3>> positions;
  positions.reserve(voxel_count());
  for (std::size_t i = 0; i < voxel_count(); ++i) positions.push_back(engine_->view(i).position_m);
  return meshes::centre_of_mass(positions, engine_->body().classes.mass_kg);
}

Frame Simulation::frame() const {
  Frame frame;
  frame.time_s = time_s();
  frame.cell_edge_m = engine_->body().edge_m;
  frame.material.assign(engine_->body().lattice.material.begin(), engine_->body().lattice.material.end());
  frame.phase = engine_->body().phases;
  frame.strain = engine_->strains();
  const std::vector<bool> touching = engine_->in_contact_with_others();
  for (std::size_t i = 0; i < voxel_count(); ++i) {
    const Engine::VoxelView voxel = engine_->view(i);
    frame.position_m.push_back(voxel.position_m);
    const meshes::CellIndex& cell = engine_->body().lattice.cells[i];
    frame.rest_position_m.push_back({frame.cell_edge_m * static_cast<double>(cell.x),
                                     frame.cell_edge_m * static_cast<double>(cell.y),
                                     frame.cell_edge_m * static_cast<double>(cell.z)});
    frame.orientation.push_back(voxel.orientation);
    frame.size_m.push_back(voxel.size_m);
    if (engine_->body().physics.surrogate) frame.reach_m.push_back(voxel.reach_m);
    frame.speed_m_s.push_back(std::hypot(voxel.velocity_m_s[0], voxel.velocity_m_s[1], voxel.velocity_m_s[2]));
    std::uint8_t bits = touching[i] ? contact::other_voxel : contact::none;
    if (voxel.touches_floor)
      bits = static_cast<std::uint8_t>(bits | (voxel.is_static ? contact::floor_static : contact::floor_sliding));
    frame.contact.push_back(bits);
  }
  return frame;
}

std::array<double, 3> Simulation::position_m(std::size_t voxel) const { return engine_->view(voxel).position_m; }
std::array<double, 4> Simulation::orientation(std::size_t voxel) const { return engine_->view(voxel).orientation; }
std::array<double, 3> Simulation::velocity_m_s(std::size_t voxel) const { return engine_->view(voxel).velocity_m_s; }
std::array<double, 3> Simulation::angular_velocity_rad_s(std::size_t voxel) const {
  return engine_->view(voxel).angular_velocity_rad_s;
}
bool Simulation::is_in_static_friction(std::size_t voxel) const { return engine_->view(voxel).is_static; }
std::size_t Simulation::large_angle_beams() const { return engine_->large_angle_beams(); }
std::vector<std::string> Simulation::kernel_report() const { return engine_->kernel_report(); }
CollisionCounts Simulation::collision_counts() const { return engine_->collision_counts(); }
std::optional<StrainRange> Simulation::strain_range() const { return engine_->record().strain_range; }

std::vector<std::string> Simulation::outside_validity() const {
  std::vector<std::string> faults = outside_validity_;
  if (!engine_->body().physics.surrogate) return faults;
  const ValidityRange& validity = engine_->body().physics.surrogate->parameters.validity;
  const StrainRange& strains = *engine_->record().strain_range;
  if (strains.smallest < validity.smallest_strain || strains.largest > validity.largest_strain) {
    faults.push_back("beams had strains from " + io::shown(strains.smallest) + " to " + io::shown(strains.largest) +
                     ", but the fit had strains from " + io::shown(validity.smallest_strain) + " to " +
                     io::shown(validity.largest_strain));
  }
  return faults;
}

const std::optional<EnergyLedger>& Simulation::energy() const { return engine_->energy(); }

}  // namespace menger::voxel
