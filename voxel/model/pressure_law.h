#pragma once

#include <cmath>

#include "voxel/laws/number.h"

namespace menger::voxel {

/// How much a voxel lengthens, or a wall bulges, with the gauge pressure p of its chamber, as a fraction x of the voxel edge:
///
///   p >= 0:  x(p) = a * p * (w / (1 + k * p) + (1 - w) / (1 - q * p)) + d * (1 - 1 / (1 + (h * p)^2))
///   p < 0:   x(p) = a * p / (1 - v * |p|)
///
/// Flat walls bend first and then stretch. The share w of bending fades beyond p = 1 / k. The rest softens towards the limit
/// pressure 1 / q, where no equilibrium is left; it stiffens if q is negative. The slope at p = 0 is a from both sides. Vacuum
/// has a softening v of its own, because walls that fold inwards behave differently from walls that stretch.
///
/// The last term is that of plates, whose walls become arcs. An arc is longer than its chord: so the chord becomes shorter (d <
/// 0), and the arc rises (d > 0). This grows with the square of small pressures, and towards its limit d beyond p = 1 / h, where
/// walls stretch rather than bend.
struct PressureLaw {
  double slope_per_Pa = 0.0;               ///< a
  double pressure_softening_per_Pa = 0.0;  ///< q, of either sign
  double vacuum_softening_per_Pa = 0.0;    ///< v, of either sign
  double fading_share = 0.0;               ///< w, 0 <= w <= 1
  double fading_per_Pa = 0.0;              ///< k >= 0
  double arc = 0.0;                        ///< d, of either sign
  double arc_per_Pa = 0.0;                 ///< h >= 0

  bool operator==(const PressureLaw&) const = default;

  [[nodiscard]] MENGER_HOST_DEVICE double softening_per_Pa(double pressure_Pa) const {
    return pressure_Pa >= 0.0 ? pressure_softening_per_Pa : vacuum_softening_per_Pa;
  }
  /// Whether the law has a value at a pressure: q |p| < 1.
  [[nodiscard]] MENGER_HOST_DEVICE bool has_value(double pressure_Pa) const {
    return softening_per_Pa(pressure_Pa) * std::abs(pressure_Pa) < 1.0;
  }

  /// Returns x(p). Only where has_value(p).
  [[nodiscard]] MENGER_HOST_DEVICE double value(double pressure_Pa) const {
    const double share = pressure_Pa >= 0.0 ? fading_share : 0.0;
    const double rest = 1.0 - softening_per_Pa(pressure_Pa) * std::abs(pressure_Pa);
    const double bend = arc_per_Pa * (pressure_Pa >= 0.0 ? pressure_Pa : 0.0);
    return slope_per_Pa * pressure_Pa * (share / (1.0 + fading_per_Pa * std::abs(pressure_Pa)) + (1.0 - share) / rest) +
           arc * (1.0 - 1.0 / (1.0 + bend * bend));
  }
  /// Returns dx/dp, 1/Pa.
  [[nodiscard]] MENGER_HOST_DEVICE double derivative(double pressure_Pa) const {
    const double share = pressure_Pa >= 0.0 ? fading_share : 0.0;
    const double rest = 1.0 - softening_per_Pa(pressure_Pa) * std::abs(pressure_Pa);
    const double fading = 1.0 + fading_per_Pa * std::abs(pressure_Pa);
    const double bend = arc_per_Pa * (pressure_Pa >= 0.0 ? pressure_Pa : 0.0);
    const double widened = 1.0 + bend * bend;
    return slope_per_Pa * (share / (fading * fading) + (1.0 - share) / (rest * rest)) +
           arc * 2.0 * arc_per_Pa * bend / (widened * widened);
  }
};

}  // namespace menger::voxel
