#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "voxel/lattice.h"
#include "voxel/parameters.h"

namespace menger::voxel {

/// Phase of the drive of every voxel, in periods.
std::vector<double> actuation_phases(const Lattice& lattice, const Actuation& actuation);

/// Whether the drive changes any size.
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

}  // namespace menger::voxel
