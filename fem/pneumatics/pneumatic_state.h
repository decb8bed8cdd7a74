#pragma once

#include <vector>

namespace menger::fem {

/// Energy that went through a supply since its start, J, by gauge pressures; integrated along with the air and as exactly, see
/// PneumaticAccuracy.
struct PneumaticWork {
  double piston_J = 0.0;  ///< of pistons on their air
  double source_J = 0.0;  ///< carried out of sources by the air that left them
  double plenum_J = 0.0;  ///< int p dV of the plena that are supplied through lines
  double line_J = 0.0;    ///< lost in lines, >= 0 but for errors of that size
};

/// Where the air of a supply is at one time.
struct PneumaticState {
  double time_s = 0.0;
  std::vector<double> volumes_m3;     ///< of each plenum
  std::vector<double> plenum_air_m3;  ///< free air in each plenum and the half of its line; of no meaning without a line
  std::vector<double> piston_air_m3;  ///< free air in each cylinder and the halves of its lines
  std::vector<double> source_air_m3;  ///< free air that left the source of each plenum; 0 for other plena
  PneumaticWork work;
};

}  // namespace menger::fem
