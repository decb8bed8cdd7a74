#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "fem/pneumatics/pneumatic_gas.h"
#include "fem/surfaces/plenum_compliance.h"

namespace menger::fem {

/// Air at the far end of a line: half of the line and its plenum.
struct LineEnd {
  double resistance_Pa_s_per_m3 = 0.0;                                ///< R >= 0
  double laminar_drive_Pa = std::numeric_limits<double>::infinity();  ///< D* of the line
  double volume_m3 = 0.0;                                             ///< > 0, without that of a compliant plenum
  const PlenumCompliance* plenum = nullptr;                           ///< adds its volume at the pressure of the end
  double free_air_m3 = 0.0;
  double pressure_Pa = 0.0;  ///< gauge

  [[nodiscard]] double volume_at_m3(double at_Pa) const;
};

/// A supply with its lines: a source of given pressure, or a closed cylinder.
struct Manifold {
  std::optional<double> source_pressure_Pa{};  ///< gauge; of a source
  double volume_m3 = 0.0;                      ///< > 0, of a cylinder with the near halves of its lines
  double free_air_m3 = 0.0;                    ///< in there
  double pressure_Pa = 0.0;                    ///< gauge, in there
  std::vector<LineEnd> ends{};
};

/// Lets air flow for a time (> 0) by Euler's implicit rule, whatever the resistances:
/// R_j (N_j(p_j) - N_j) = time R dN/dt(p, p_j) for each end (see PneumaticLine), and no air is lost between cylinder and ends.
/// Newton's method from the pressures given; sets the pressures, volumes and air stay.
/// @return whether positive absolute pressures were found; false after steps so long that they would empty a volume
[[nodiscard]] bool relax(const PneumaticGas& gas, double time_s, Manifold& manifold);

}  // namespace menger::fem
