#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Returns the phase of the drive of every voxel, in periods.
std::vector<double> actuation_phases(const Lattice& lattice, const Actuation& actuation);

/// Whether the drive changes the size of any solid voxel.
inline bool is_driven(const Actuation& actuation) { return actuation.mode != ActuationMode::none && actuation.amplitude != 0.0; }

/// Sine and cosine of the angle of the drive, 2 pi t / T.
struct DriveAngle {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Returns the angle of the drive at a time in seconds. Only the fraction of the period enters the sine, so that long runs keep
/// their digits.
inline DriveAngle drive_angle(double time_s, double period_s) {
  const double periods = time_s / period_s;
  const double angle = 2.0 * std::numbers::pi * (periods - std::floor(periods));
  return {std::sin(angle), std::cos(angle)};
}

/// Whether the drive is not a plain sine from the start (it is held or has a ramp), so that the kernels cannot compute it.
inline bool is_shaped(const Actuation& actuation) { return actuation.mode == ActuationMode::hold || actuation.ramp_s > 0.0; }

/// The drive at one instant.
///
/// The wave at the phase phi is w = sine cos(2 pi phi) + cosine sin(2 pi phi). That is ramp sin(2 pi (t / T + phi)), or the ramp
/// alone with ActuationMode::hold. The rate of the wave is the same sum of sine_rate and cosine_rate.
struct DriveMoment {
  double ramp = 1.0;
  double ramp_rate = 0.0;  ///< 1/s
  double sine = 0.0;
  double cosine = 1.0;
  double sine_rate = 0.0;  ///< 1/s
  double cosine_rate = 0.0;
};

/// Returns the drive at a time.
/// @param time_s >= 0
DriveMoment drive_moment(const Actuation& actuation, double time_s);

}  // namespace menger::voxel
