#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "voxel/model/calibrated_body.h"

namespace menger::voxel {

/// Properties of one of the two voxel materials.
struct VoxelMaterial {
  double youngs_modulus_Pa = 1e4;  ///< E > 0
  double density_kg_m3 = 10.0;     ///< rho > 0
  double static_friction = 1.0;    ///< mu_s >= 0, against the floor
  double kinetic_friction = 0.5;   ///< mu_k >= 0, against the floor

  bool operator==(const VoxelMaterial&) const = default;
};

/// Damping ratios: fractions of the critical damping of the oscillator formed by one voxel and one beam (or one contact).
struct DampingRatios {
  double bond = 1.0;       ///< zeta, of beams; a calibrated body has its own
  double collision = 0.8;  ///< zeta_c, of contacts with the floor and between voxels
  double global = 0.01;    ///< zeta_g, of every voxel against the resting world

  bool operator==(const DampingRatios&) const = default;
};

/// The phase that each voxel is driven with.
enum class ActuationMode {
  none,       ///< nothing is driven
  in_phase,   ///< all voxels together, phase 0
  antiphase,  ///< by material, Actuation::material_phase
  wave,       ///< a wave travels along Actuation::wave_axis
  hold        ///< all voxels together, held at the top of the cycle: the sine is 1 at all times
};

/// Drive of the voxel sizes: s = L (1 + amplitude sin(2 pi (t / period + phase))). Over the ramp the amplitude grows from zero.
///
/// With ActuationMode::hold and a ramp a body is brought to a state and settles there under its damping. It can then be compared
/// with an equilibrium.
struct Actuation {
  ActuationMode mode = ActuationMode::antiphase;
  double amplitude = 0.144714;                     ///< a, fraction of the edge, 0 <= a < 1
  double frequency_Hz = 5.0;                       ///< > 0
  double ramp_s = 0.0;                             ///< >= 0: the drive is multiplied by min(1, t / ramp_s)
  std::array<double, 2> material_phase{0.0, 0.5};  ///< phases of materials 1 and 2, in periods (antiphase only)
  int wave_axis = 1;                               ///< 0, 1, 2 for x, y, z (wave only)

  /// Wave only: phase = periods_per_body * i / W, with i the cell index along the axis and W the cells of the grid along it
  /// (3^level for a fractal). Negative: the wave travels towards growing index.
  double wave_periods_per_body = -1.0;
  bool wave_over_gaps = false;  ///< wave only: divide by W - 1 instead of W (the last layer then gets the full phase)

  [[nodiscard]] double period_s() const { return 1.0 / frequency_Hz; }
  bool operator==(const Actuation&) const = default;
};

/// How beams are damped.
enum class DampingMode {
  increments,  ///< from the change of a beam's displacements since the last step, as in the public engines; needs double
  velocity     ///< from the velocities of the ends and the rate of the rest length: conserves momentum, works in float
};

/// Whether the moments on the ends of a beam balance its forces; see balanced in beam.h.
enum class BeamMoments {
  published,  ///< those of Voxelyze and voxcraft-sim, which do not while a body is driven: it turns by itself
  balanced    ///< those that do: floating bodies keep their momentum and angular momentum. Needs solid voxels
};

/// How a step takes the damping of beams; see effective_bond_ratio.
enum class BondDamping {
  explicit_step,  ///< with the velocities at the start of the step: limits the step in full bodies
  semi_implicit   ///< weakened so that it does not limit the step: for steps up to three times as long, with less damping
};

enum class NumberType { float64, float32 };

/// The time step and how it is taken.
struct Integration {
  double time_step_fraction = 0.9;  ///< of the recommended step, > 0
  DampingMode damping = DampingMode::increments;
  NumberType number = NumberType::float64;
  BondDamping bond_damping = BondDamping::explicit_step;

  /// Rounds rest lengths to 24 bits, as the public engine stores them. For comparisons only. Damping from increments divides that
  /// rounding error by the step. At a tenth of the paper's step this is a force noise of about one percent of the friction of a
  /// light robot, enough to start a slip early.
  bool single_precision_rest_lengths = false;

  bool operator==(const Integration&) const = default;
};

/// Contact between surface voxels, taken as spheres with a radius of 0.625 of their size.
struct Collisions {
  /// Voxels that are at most this many beams apart never collide. 1 excludes direct neighbours (voxcraft-sim), 5 is the rule of
  /// Voxelyze. None: collisions are off.
  std::optional<int> exclusion_depth = 1;

  bool operator==(const Collisions&) const = default;
};

/// Limits beyond which a run has diverged. They are tested over all voxels and beams at every step.
struct DivergenceLimits {
  /// Largest speed as a fraction of the wave speed: sqrt(E / rho) of the stiffest and lightest material, or in a calibrated body
  /// the largest sqrt(axial_Pa L^3 / m) of any voxel and axis.
  double speed_fraction = 0.2;
  double strain = 1.0;  ///< largest magnitude of a beam's axial strain

  bool operator==(const DivergenceLimits&) const = default;
};

/// Everything that decides how a body of voxels moves.
struct Physics {
  /// Materials 1 and 2. A calibrated body takes only the friction from them.
  std::array<VoxelMaterial, 2> materials{};

  /// Coefficient c of LateralCoupling, 0 <= c < 1. A stretched body gets thinner, by c / (1 + c) of its strain where it is wide.
  /// 0: not computed at all. A calibrated body has its own value; see effective_coupling.
  double lateral_coupling = 0.0;

  /// Hollow cells driven by pressure; Actuation::amplitude then has no effect. None: solid voxels driven by size.
  std::optional<CalibratedBody> surrogate;

  DampingRatios damping_ratios;
  BeamMoments beam_moments = BeamMoments::published;
  double gravity_m_s2 = 9.81;  ///< downwards, >= 0
  bool floor = true;           ///< rigid plane at half a voxel edge below the centres of the lowest layer of the grid

  /// Whether a voxel in static friction also loses its angular momentum (voxcraft-sim does, Voxelyze does not).
  bool stop_rotation_in_static_friction = false;

  Actuation actuation;
  Collisions collisions;
  Integration integration;
  DivergenceLimits limits;

  bool operator==(const Physics&) const = default;
};

/// Returns the lateral coupling in use: that of the calibrated parameters where there are any, otherwise that of the physics.
inline double effective_coupling(const Physics& physics) {
  return physics.surrogate ? physics.surrogate->parameters.lateral_coupling : physics.lateral_coupling;
}

std::string_view to_string(ActuationMode mode);
std::string_view to_string(DampingMode mode);
std::string_view to_string(NumberType number);
std::string_view to_string(BondDamping treatment);  ///< "explicit" or "semi-implicit"
std::string_view to_string(BeamMoments moments);

}  // namespace menger::voxel
