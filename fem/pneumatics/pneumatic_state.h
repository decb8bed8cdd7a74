#pragma once

#include <vector>

namespace menger::fem {

/// Energy that went through a supply since its start, J, based on gauge pressures. It is integrated along with the air and with
/// the same accuracy, see PneumaticAccuracy.
struct PneumaticWork {
  double piston_J = 0.0;  ///< work of pistons on their air
  double source_J = 0.0;  ///< energy carried out of sources by the air that left them
  double plenum_J = 0.0;  ///< int p dV of the plena that are supplied through lines
  double line_J = 0.0;    ///< energy lost in lines; >= 0 except for errors of the integration
};

/// The distribution of the air of a supply at one time.
struct PneumaticState {
  double time_s = 0.0;
  std::vector<double> volumes_m3;     ///< of each plenum
  std::vector<double> plenum_air_m3;  ///< free air in each plenum and half of its line; without a line it has no meaning
  std::vector<double> piston_air_m3;  ///< free air in each cylinder and the near halves of its lines
  std::vector<double> source_air_m3;  ///< free air that left the source of each plenum; 0 for other plena
  PneumaticWork work;
};

}  // namespace menger::fem
