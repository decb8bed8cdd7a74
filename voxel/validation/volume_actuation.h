#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/load_cases/response_curve.h"

namespace menger::voxel {

/// What the drive of solid voxels asks of a body: edges that grow and shrink by an amplitude, volumes by (1 +- amplitude)^3 - 1.
struct ActuationAim {
  double pressure_Pa = 6000.0;   ///< > 0, at which the change of volume is stated
  double largest_change = 0.0;   ///< of the outer volume, by its size at rest, > 0
  double smallest_change = 0.0;  ///< < 0
};
ActuationAim actuation_aim(double pressure_Pa, double amplitude);

/// How far the pressure of a chamber changes the outer volume of a body. Changes are by the volume at rest, from finite elements.
struct VolumeActuation {
  std::string body;
  double chamber_share = 0.0;  ///< chamber volume by outer volume at rest, joints counted as wall

  std::optional<double> change_at_pressure{};        ///< at ActuationAim::pressure_Pa; none where the curve ends before
  std::optional<double> pressure_for_largest_Pa{};   ///< that gives the largest change; none where the curve ends before
  std::optional<double> pressure_for_smallest_Pa{};  ///< that gives the smallest change, < 0

  double highest_pressure_Pa = 0.0;  ///< where the curve ends
  double change_at_highest = 0.0;
  double lowest_pressure_Pa = 0.0;
  double change_at_lowest = 0.0;
  std::optional<double> limit_pressure_Pa{};    ///< beyond which there is no equilibrium, where it was found
  std::optional<double> contact_pressure_Pa{};  ///< at which walls first touch, < 0, where it was found
};

/// Reads the change of outer volume off an inflation curve: change of chamber volume times the chamber's share of the outer
/// volume, since the wall is nearly incompressible; linear between the states of the curve and the state at rest.
/// @param curve of kind inflation
VolumeActuation volume_actuation(const meshes::ResponseCurve& curve, const std::string& body, const ActuationAim& aim);

/// What it means, in sentences for people.
std::vector<std::string> actuation_sentences(const VolumeActuation& actuation, const ActuationAim& aim);

}  // namespace menger::voxel
