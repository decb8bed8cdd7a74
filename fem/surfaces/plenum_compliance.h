#pragma once

#include <filesystem>
#include <vector>

namespace menger::fem {

/// The volume of a plenum as a function of its gauge pressure, from the quasi-static states of a soft body. It is linear between
/// points and constant before the first and after the last one. It replaces a body without inertia and loads.
struct PlenumCompliance {
  std::vector<double> pressures_Pa;  ///< strictly increasing, at least one
  std::vector<double> volumes_m3;    ///< > 0, never decreasing

  [[nodiscard]] double volume_m3(double pressure_Pa) const;
  [[nodiscard]] double derivative_m3_per_Pa(double pressure_Pa) const;  ///< >= 0, to the right of a point
  [[nodiscard]] double work_J(double from_Pa, double to_Pa) const;      ///< int p dV between two pressures
  [[nodiscard]] bool contains(double pressure_Pa) const;
};

}  // namespace menger::fem
