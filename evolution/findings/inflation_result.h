#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "meshes/robot/robot.h"

namespace menger::evolution {

/// A chamber, or several that are joined, in the states of an inflation.
struct InflatedChamber {
  std::vector<double> pressures_Pa;
  std::vector<double> volumes_m3;
};

/// Returns whether two pressures are of one state: they differ by 1 Pa at most.
bool are_of_one_state(double a_Pa, double b_Pa);

/// Returns the first state that has a pressure; nothing if none has.
std::optional<std::size_t> state_at(const std::vector<double>& pressures_Pa, double pressure_Pa);

/// Returns the pressure of the last state in curves.csv of an inflation: of several plena that in which a vacuum can make walls
/// touch, or else the highest. Nothing without states.
std::optional<double> last_pressure_Pa(const io::CsvContents& curves);

/// Returns the chambers in curves.csv of an inflation.
std::vector<InflatedChamber> chambers_in(const io::CsvContents& curves);

/// How chambers grow at a pressure, as multiples of their volumes at rest.
struct ChamberGrowth {
  double whole = 0.0;  ///< of all together
  double least = 0.0;  ///< of that which grows least
  double most = 0.0;
};

/// Returns the growth of chambers, each where its pressure is the drive's; nothing if that was not reached.
std::optional<ChamberGrowth> growth_at(const std::vector<InflatedChamber>& chambers, double pressure_Pa);

/// Returns the pressure of the drive that is furthest from 0.
double strongest_pressure_Pa(const meshes::Robot& robot);

/// Returns "6 kPa", and in which chambers where a drive loads them by turns.
std::string driven_text(const meshes::Robot& robot, double pressure_Pa);

/// Returns how the inflation to the states of the drive ended early, and where; empty if it did not.
std::string inflation_end(const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns the pressure of the last state before walls of a chamber touched; nothing if they did not, or it is not known.
std::optional<double> contact_pressure_Pa(const std::filesystem::path& results);

/// Returns what the stage inflate found, for people.
std::string inflation_text(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
