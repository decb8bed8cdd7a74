#include "fem/statics/path_drives.h"

#include <algorithm>
#include <cmath>

namespace menger::fem {

namespace {

/// Values of s that differ by less than this count as equal.
constexpr double rounding = 1e-12;

/// Linear interpolation between knots 0, 1, 2, ...
double interpolated(const std::vector<double>& knots, double s) {
  const double clamped = std::clamp(s, 0.0, static_cast<double>(knots.size() - 1));
  const auto leg = std::min(static_cast<std::size_t>(clamped), knots.size() < 2 ? 0 : knots.size() - 2);
  const double part = clamped - static_cast<double>(leg);
  return part == 0.0 ? knots[leg] : (1.0 - part) * knots[leg] + part * knots[leg + 1];
}

}  // namespace

PathSchedule::PathSchedule(const PathDrives& drives) : drives_(drives) {
  const auto reach = [&](std::size_t knots) { end_ = std::max(end_, static_cast<double>(knots) - 1.0); };
  for (const PlenumDrive& drive : drives.plena) reach(drive.values.size());
  for (const PlateDrive& drive : drives.plates) reach(drive.values.size());
  reach(drives.dead_load_factors.size());
}

std::vector<PlenumControl> PathSchedule::controls_at(double s, std::span<const double> rest_volumes_m3) const {
  std::vector<PlenumControl> controls;
  for (std::size_t p = 0; p < drives_.plena.size(); ++p) {
    const PlenumDrive& drive = drives_.plena[p];
    const double value = interpolated(drive.values, s);
    switch (drive.kind) {
      case DriveKind::pressure:
        controls.emplace_back(PressureControl{value});
        break;
      case DriveKind::volume:
        controls.emplace_back(VolumeControl{value * rest_volumes_m3[p]});
        break;
      case DriveKind::gas:
        controls.emplace_back(GasLaw{drive.gas_exponent, drive.ambient_pressure_Pa, 0.0, rest_volumes_m3[p], value});
        break;
    }
  }
  return controls;
}

double PathSchedule::dead_load_factor_at(double s) const {
  if (!drives_.dead_load_factors.empty()) return interpolated(drives_.dead_load_factors, s);
  return s < 0.0 ? 1.0 + s : 1.0;
}

std::vector<PlateMotion> PathSchedule::plate_motions_at(double s, std::size_t plate_count) const {
  std::vector<PlateMotion> motions(plate_count);
  for (std::size_t p = 0; p < drives_.plates.size(); ++p) motions[p] = motion_at(drives_.plates[p], s);
  return motions;
}

bool PathSchedule::is_driven(std::size_t plenum, double s) const {
  const std::vector<double>& values = drives_.plena[plenum].values;
  for (std::size_t leg = 0; leg + 1 < values.size(); ++leg) {
    const auto start = static_cast<double>(leg);
    if (start <= s && s < start + 1.0 && values[leg] != values[leg + 1]) return true;
  }
  return false;
}

bool PathSchedule::any_is_driven(double s) const {
  for (std::size_t p = 0; p < drives_.plena.size(); ++p)
    if (is_driven(p, s)) return true;
  return false;
}

bool PathSchedule::is_given_pressure(std::size_t plenum) const { return drives_.plena[plenum].kind == DriveKind::pressure; }

bool PathSchedule::all_given_pressures() const {
  return std::ranges::all_of(drives_.plena, [](const PlenumDrive& drive) { return drive.kind == DriveKind::pressure; });
}

double PathSchedule::value_at(std::size_t plenum, double s) const { return interpolated(drives_.plena[plenum].values, s); }

std::size_t PathSchedule::fastest_plenum(double s, double length) const {
  std::size_t fastest = 0;
  double most = -1.0;
  for (std::size_t p = 0; p < drives_.plena.size(); ++p) {
    const double change = std::abs(value_at(p, std::min(end_, s + length)) - value_at(p, s));
    if (is_given_pressure(p) && change > most) {
      fastest = p;
      most = change;
    }
  }
  return fastest;
}

double PathSchedule::next_station(double s, std::span<const double> stations) const {
  double next = std::min(end_, std::floor(s + rounding) + 1.0);
  for (const double station : stations)
    if (station > s + rounding) next = std::min(next, station);
  return next;
}

bool is_knot(double s) { return std::abs(s - std::round(s)) < rounding; }

bool is_knot_or_station(double s, std::span<const double> stations) {
  return is_knot(s) || std::ranges::any_of(stations, [s](double station) { return std::abs(s - station) < rounding; });
}

}  // namespace menger::fem
