#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/motion_energy.h"
#include "fem/surfaces/point.h"
#include "io/text/run_status.h"
#include "meshes/load_cases/lean.h"

namespace menger::fem {

/// The observed quantities of a body at one time of its walk.
struct WalkRecord {
  double time_s = 0.0;
  Point centre_of_mass_m{};
  std::vector<double> plenum_pressures_Pa{};  ///< gauge
  std::vector<double> chamber_volumes_m3{};
  MotionEnergies energies{};
  double ground_force_N = 0.0;   ///< upwards
  Point upright{0.0, 0.0, 1.0};  ///< the body's own upright axis, see meshes::OutermostPoints
};

/// The result of a walk.
struct WalkResult {
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason{};  ///< empty if completed; otherwise what failed, where and when
  double time_s = 0.0;   ///< reached
  std::size_t steps = 0;
  std::size_t elements = 0;
  std::size_t nodes = 0;
  double body_length_m = 0.0;
  double ground_height_m = 0.0;
  /// The first is that of the start. If the walk failed, the last is that of the time that it reached.
  std::vector<WalkRecord> records{};

  /// Returns the cost of the walk: steps times elements.
  [[nodiscard]] std::uint64_t element_steps() const { return std::uint64_t{steps} * std::uint64_t{elements}; }
};

/// The displacement of a body over a walk: its length and direction.
struct Travel {
  Point displacement_m{};                  ///< of the centre of mass
  double horizontal_displacement_m = 0.0;  ///< length of the displacement in the plane of the ground
  double horizontal_displacement_body_lengths = 0.0;
  double body_lengths_per_minute = 0.0;
  double direction_deg = 0.0;  ///< from +x towards +y, in (-180, 180]; 0 without displacement
};

/// Returns the travel from the first record to the last. Empty for a walk that did not complete, since its displacement cannot be
/// compared.
std::optional<Travel> travel_of(const WalkResult& result);

/// Returns the largest height of the centre of mass above the ground over all records, m.
double peak_height_m(const WalkResult& result);

/// Returns the centre of mass at a time, linear between two records; before the first or after the last one that of this record.
/// Precondition: there is a record.
Point centre_of_mass_at(const WalkResult& result, double time_s);

/// Returns how far a body leans at the end of a whole period of its walk, see meshes::largest_lean.
/// @param period_s > 0, a multiple of the interval of the records
meshes::Lean largest_lean(const WalkResult& result, double period_s);

/// Returns the displacement of the centre of mass in each whole period since the start, as far as the records go. Exact where
/// the interval of the records divides the period, see centre_of_mass_at.
/// @param period_s > 0
std::vector<Point> period_displacements_m(const WalkResult& result, double period_s);

}  // namespace menger::fem
