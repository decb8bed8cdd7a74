#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fem/statics/grips.h"
#include "fem/surfaces/gas_law.h"

namespace menger::fem {

/// The quantity that drives a plenum along a path.
enum class DriveKind {
  pressure,  ///< values: gauge pressure, Pa
  volume,    ///< volume of its air, divided by that at rest
  gas        ///< amount of gas, divided by that at rest and ambient pressure
};

/// The drive of a plenum: its value at every knot of the path, linear between them.
struct PlenumDrive {
  DriveKind kind = DriveKind::pressure;
  std::vector<double> values;  ///< one per knot of the path; the first is that at the start
  double gas_exponent = 1.0;
  double ambient_pressure_Pa = standard_atmosphere_Pa;
};

/// Everything that is prescribed along a path.
struct PathDrives {
  std::vector<PlenumDrive> plena{};  ///< one per plenum
  std::vector<PlateDrive> plates{};  ///< one per plate of the body, or empty: the plates stay where they are
  /// Factor on gravity and tractions at the knots. Empty: it is 1, and dead loads grow to it before the path.
  std::vector<double> dead_load_factors{};
};

/// The prescribed values at any parameter s of a path. Knot k lies at s = k; between two knots everything is linear.
class PathSchedule {
 public:
  /// @param drives must outlive this object
  explicit PathSchedule(const PathDrives& drives);

  /// The parameter of the last knot.
  [[nodiscard]] double end() const { return end_; }

  /// Returns the condition that every plenum has to satisfy.
  /// @param rest_volumes_m3 volume of the air of each plenum at rest
  [[nodiscard]] std::vector<PlenumControl> controls_at(double s, std::span<const double> rest_volumes_m3) const;

  /// Returns the factor on gravity and tractions. Without values at the knots it grows from s = -1 to 0.
  [[nodiscard]] double dead_load_factor_at(double s) const;

  /// Returns the motions of the plates; they are at rest if no drives are given for them.
  [[nodiscard]] std::vector<PlateMotion> plate_motions_at(double s, std::size_t plate_count) const;

  /// Whether the drive of a plenum changes on the leg after s; at a knot this is the leg that begins there.
  [[nodiscard]] bool is_driven(std::size_t plenum, double s) const;
  [[nodiscard]] bool any_is_driven(double s) const;

  /// Whether all plena are driven by pressure.
  [[nodiscard]] bool all_given_pressures() const;
  [[nodiscard]] bool is_given_pressure(std::size_t plenum) const;

  /// Returns the value of a plenum's drive.
  [[nodiscard]] double value_at(std::size_t plenum, double s) const;

  /// Returns the plenum whose given pressure changes most from s on within some length of the path; 0 if none changes.
  [[nodiscard]] std::size_t fastest_plenum(double s, double length) const;

  /// Returns the next value of s at which the path must stop: a knot or one of the stations.
  [[nodiscard]] double next_station(double s, std::span<const double> stations) const;

 private:
  const PathDrives& drives_;
  double end_ = 0.0;
};

/// Whether a parameter of a path is a knot, where drives may have corners.
bool is_knot(double s);

/// Whether a parameter of a path is a knot or one of the stations, at which states are asked for.
bool is_knot_or_station(double s, std::span<const double> stations);

}  // namespace menger::fem
