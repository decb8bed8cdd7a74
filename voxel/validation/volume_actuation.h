#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/load_cases/response_curve.h"

namespace menger::voxel {

/// The changes of volume that the drive of solid voxels assumes: edges grow and shrink by an amplitude, volumes by (1 +-
/// amplitude)^3 - 1.
struct ActuationAim {
  double pressure_Pa = 6000.0;   ///< > 0, at which the change of volume is reported
  double largest_change = 0.0;   ///< of the outer volume, divided by the volume at rest, > 0
  double smallest_change = 0.0;  ///< < 0
};
ActuationAim actuation_aim(double pressure_Pa, double amplitude);

/// How much the pressure in a chamber changes the outer volume of a body, from finite elements. Changes are relative to the
/// volume at rest.
struct VolumeActuation {
  std::string body;
  double chamber_share = 0.0;  ///< chamber volume / outer volume at rest, with joints counted as wall

  std::optional<double> change_at_pressure{};        ///< at ActuationAim::pressure_Pa; nothing if the curve ends before
  std::optional<double> pressure_for_largest_Pa{};   ///< pressure of the largest change; nothing if the curve ends before
  std::optional<double> pressure_for_smallest_Pa{};  ///< pressure of the smallest change, < 0; nothing if the curve ends before

  double highest_pressure_Pa = 0.0;  ///< where the curve ends
  double change_at_highest = 0.0;
  double lowest_pressure_Pa = 0.0;
  double change_at_lowest = 0.0;
  std::optional<double> limit_pressure_Pa{};    ///< beyond it there is no equilibrium; nothing if not found
  std::optional<double> contact_pressure_Pa{};  ///< at which walls first touch, < 0; nothing if not found
};

/// Computes the change of outer volume from an inflation curve. It is the change of chamber volume times the chamber's share of
/// the outer volume, because the wall is nearly incompressible. It is linear between the states of the curve and the state at
/// rest.
/// @param curve of kind inflation
VolumeActuation volume_actuation(const meshes::ResponseCurve& curve, const std::string& body, const ActuationAim& aim);

/// Sentences that explain the result.
std::vector<std::string> actuation_sentences(const VolumeActuation& actuation, const ActuationAim& aim);

}  // namespace menger::voxel
