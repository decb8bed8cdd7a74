#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fem/statics/grips.h"
#include "fem/surfaces/gas_law.h"

namespace menger::fem {

/// What drives a plenum along a path.
enum class DriveKind {
  pressure,  ///< values: gauge pressure, Pa
  volume,    ///< values: volume of its air by that at rest
  gas        ///< values: amount of gas by that at rest and ambient pressure
};

/// How a plenum is driven: its value at every knot of the path, linear between them.
struct PlenumDrive {
  DriveKind kind = DriveKind::pressure;
  std::vector<double> values;  ///< one per knot of the path; the first at its start
  double gas_exponent = 1.0;
  double ambient_pressure_Pa = standard_atmosphere_Pa;
};

/// All that is prescribed along a path.
struct PathDrives {
  std::vector<PlenumDrive> plena{};         ///< one per plenum
  std::vector<PlateDrive> plates{};         ///< one per plate of the body, or none: they stay where they are
  std::vector<double> dead_load_factors{};  ///< on gravity and tractions at the knots; none: 1, and they grow before the path
};

/// What is prescribed at a parameter s of a path: knot k lies at s = k, between two of them all is linear.
class PathSchedule {
 public:
  /// @param drives outlives this
  explicit PathSchedule(const PathDrives& drives);

  /// The last knot.
  [[nodiscard]] double end() const { return end_; }

  /// What every plenum has to fulfil.
  /// @param rest_volumes_m3 of the air of each plenum at rest
  [[nodiscard]] std::vector<PlenumControl> controls_at(double s, std::span<const double> rest_volumes_m3) const;

  /// On gravity and tractions. Without knots of its own they grow from s = -1 to 0.
  [[nodiscard]] double dead_load_factor_at(double s) const;

  /// Where plates are; at rest where there are no drives for them.
  [[nodiscard]] std::vector<PlateMotion> plate_motions_at(double s, std::size_t plate_count) const;

  /// Whether the drive of a plenum changes on the leg that leads on from s: at a knot the one that begins there.
  [[nodiscard]] bool is_driven(std::size_t plenum, double s) const;
  [[nodiscard]] bool any_is_driven(double s) const;

  /// Whether all plena are driven by pressure.
  [[nodiscard]] bool all_given_pressures() const;
  [[nodiscard]] bool is_given_pressure(std::size_t plenum) const;

  /// The value of a plenum's drive.
  [[nodiscard]] double value_at(std::size_t plenum, double s) const;

  /// The plenum whose given pressure changes most from s on within some length of the path; 0 if none does.
  [[nodiscard]] std::size_t fastest_plenum(double s, double length) const;

  /// The next value of s that must be met: a knot or one of the stations.
  [[nodiscard]] double next_station(double s, std::span<const double> stations) const;

 private:
  const PathDrives& drives_;
  double end_ = 0.0;
};

/// Whether a parameter of a path is that of a knot, where drives have corners.
bool is_knot(double s);

}  // namespace menger::fem
