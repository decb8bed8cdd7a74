#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Phase of the drive of every voxel, in periods.
std::vector<double> actuation_phases(const Lattice& lattice, const Actuation& actuation);

/// Whether the drive changes any size of solid voxels.
inline bool is_driven(const Actuation& actuation) { return actuation.mode != ActuationMode::none && actuation.amplitude != 0.0; }

/// sin and cos of 2 pi t / T.
struct DriveAngle {
  double sine = 0.0;
  double cosine = 1.0;
};

/// The drive at a time in seconds; only the fraction of the period enters the sine, so that long runs keep their digits.
inline DriveAngle drive_angle(double time_s, double period_s) {
  const double periods = time_s / period_s;
  const double angle = 2.0 * std::numbers::pi * (periods - std::floor(periods));
  return {std::sin(angle), std::cos(angle)};
}

/// Whether the drive is more than a sine from the start on, so that the kernels cannot compute it.
inline bool is_shaped(const Actuation& actuation) { return actuation.mode == ActuationMode::hold || actuation.ramp_s > 0.0; }

/// A drive at one instant. The wave of a phase phi is w = sine cos(2 pi phi) + cosine sin(2 pi phi), that is ramp sin(2 pi (t / T
/// + phi)), or the ramp itself with ActuationMode::hold; its rate is made of the rates in the same way.
struct DriveMoment {
  double ramp = 1.0;
  double ramp_rate = 0.0;  ///< 1/s
  double sine = 0.0;
  double cosine = 1.0;
  double sine_rate = 0.0;  ///< 1/s
  double cosine_rate = 0.0;
};

/// @param time_s >= 0
DriveMoment drive_moment(const Actuation& actuation, double time_s);

}  // namespace menger::voxel
