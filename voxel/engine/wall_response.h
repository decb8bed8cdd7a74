#pragma once

#include <cstddef>

#include "voxel/model/pressure_law.h"

namespace menger::voxel {

/// Returns the length (m) of half a beam of voxels with this edge: (L / 2)(1 + extension(p)).
MENGER_HOST_DEVICE inline double half_length_m(double edge_m, const PressureLaw& extension, double pressure_Pa) {
  return 0.5 * edge_m * (1.0 + extension.value(pressure_Pa));
}

/// Returns the rate (m/s) of half_length_m at a rate of the pressure (Pa/s).
MENGER_HOST_DEVICE inline double half_length_rate_m_s(double edge_m, const PressureLaw& extension, double pressure_Pa,
                                                      double pressure_rate_Pa_s) {
  return 0.5 * edge_m * extension.derivative(pressure_Pa) * pressure_rate_Pa_s;
}

/// What pressure does to the walls of one class.
struct WallLaws {
  PressureLaw extension, bulge;
  double bulge_peak_ratio = 0.0;
};

/// Values of the laws of a wall class at a pressure.
struct WallResponse {
  double half_length_m, half_length_rate_m_s, bulge_peak_m, bulge_peak_rate_m_s, bulge_m;
};

MENGER_HOST_DEVICE inline WallResponse wall_response(double edge_m, const WallLaws& laws, double pressure_Pa,
                                                     double pressure_rate_Pa_s) {
  const double bulge = laws.bulge.value(pressure_Pa);
  const double peak = edge_m * laws.bulge_peak_ratio;
  return {half_length_m(edge_m, laws.extension, pressure_Pa),
          half_length_rate_m_s(edge_m, laws.extension, pressure_Pa, pressure_rate_Pa_s), peak * bulge,
          peak * laws.bulge.derivative(pressure_Pa) * pressure_rate_Pa_s, edge_m * bulge};
}

/// Mean and amplitude of the pressure in the chambers of a body, Pa.
struct PressureWave {
  double mean_Pa = 0.0, amplitude_Pa = 0.0;

  /// Returns the pressure of a chamber, and its rate (Pa/s).
  /// @param moment of the drive, a DriveMoment
  /// @param cosine, sine of 2 pi times the phase of the chamber
  template <class Moment>
  [[nodiscard]] MENGER_HOST_DEVICE double value(const Moment& moment, double cosine, double sine) const {
    return mean_Pa * moment.ramp + amplitude_Pa * (moment.sine * cosine + moment.cosine * sine);
  }
  template <class Moment>
  [[nodiscard]] MENGER_HOST_DEVICE double rate(const Moment& moment, double cosine, double sine) const {
    return mean_Pa * moment.ramp_rate + amplitude_Pa * (moment.sine_rate * cosine + moment.cosine_rate * sine);
  }
};

/// What the walls of one class add to a beam that leaves a plate (WallOpening), or what an elbow adds to a beam (elbow_turns).
struct NeckOrElbow {
  std::size_t beam, bulge;  ///< along an axis; index of the response of the walls
  double lift;              ///< times the peak of the wall: longer by that
  double turn[2];           ///< times the peak of the wall over the voxel edge: turned by that
  double elbow[2];          ///< times the strain that pressure gives the beam: turned by that
};

/// Half the turns of a beam about the two axes after its own (rad), and their rates (rad/s), for one entry of its necks and
/// elbows.
/// @param per_edge 1 / m
/// @param strain, strain_rate of the beam without necks, by pressure
MENGER_HOST_DEVICE inline void add_half_kink(double (&half_kink)[4], const NeckOrElbow& entry, const WallResponse& wall,
                                             double per_edge, double strain, double strain_rate) {
  const double slope = per_edge * wall.bulge_peak_m;
  const double slope_rate = per_edge * wall.bulge_peak_rate_m_s;
  for (std::size_t k = 0; k < 2; ++k) {
    half_kink[k] += 0.5 * (entry.turn[k] * slope + entry.elbow[k] * strain);
    half_kink[k + 2] += 0.5 * (entry.turn[k] * slope_rate + entry.elbow[k] * strain_rate);
  }
}

}  // namespace menger::voxel
