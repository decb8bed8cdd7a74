#pragma once

#include <filesystem>
#include <vector>

namespace menger::fem {

/// Volume of a plenum over its gauge pressure as a soft body's quasi-static states give it: straight lines between points,
/// constant beyond the first and the last. It stands in for a body without inertia and loads.
struct PlenumCompliance {
  std::vector<double> pressures_Pa;  ///< strictly increasing, at least one
  std::vector<double> volumes_m3;    ///< > 0, never decreasing

  [[nodiscard]] double volume_m3(double pressure_Pa) const;
  [[nodiscard]] double derivative_m3_per_Pa(double pressure_Pa) const;  ///< >= 0, to the right of a point
  [[nodiscard]] double work_J(double from_Pa, double to_Pa) const;      ///< int p dV on the way between two pressures
  [[nodiscard]] bool contains(double pressure_Pa) const;
};

}  // namespace menger::fem
