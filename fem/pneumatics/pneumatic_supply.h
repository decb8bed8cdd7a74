#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "fem/pneumatics/pneumatic_gas.h"
#include "fem/pneumatics/pneumatic_line.h"
#include "fem/pneumatics/pneumatic_piston.h"
#include "fem/pneumatics/pneumatic_state.h"
#include "fem/pneumatics/pressure_schedule.h"

namespace menger::fem {

/// A source with a scheduled gauge pressure, and the line from it to a plenum. The plenum starts at ambient pressure.
struct LineSupply {
  PlenumSchedule source;
  PneumaticLine line;
};

/// A line from a piston to a plenum. Several plena may be connected to one piston, each by its own line.
struct PistonSupply {
  std::size_t piston = 0;
  PneumaticLine line;
};

/// The supply of a plenum: a given pressure, or air through a line from a source or piston.
using PlenumSupply = std::variant<PlenumSchedule, LineSupply, PistonSupply>;

/// All supplies of a body. It gives the pressures of the plena from their volumes and amounts of air. PneumaticIntegrator
/// integrates the flow of the air.
class PneumaticSupply {
 public:
  /// The plena that share a supply: one for a source, all plena of a piston.
  struct Group {
    std::optional<std::size_t> piston{};
    std::vector<std::size_t> plena{};
  };

  /// @param plena one per plenum; indices of pistons must exist, resistances and volumes must not be negative (asserts) @param
  /// gas exponent and ambient pressure > 0 (asserts)
  PneumaticSupply(std::vector<PlenumSupply> plena, std::vector<Piston> pistons = {}, const PneumaticGas& gas = {});

  [[nodiscard]] std::size_t plenum_count() const { return plena_.size(); }
  [[nodiscard]] const std::vector<PlenumSupply>& plena() const { return plena_; }
  [[nodiscard]] const std::vector<Piston>& pistons() const { return pistons_; }
  [[nodiscard]] const PneumaticGas& gas() const { return gas_; }
  [[nodiscard]] bool has_line(std::size_t plenum) const;
  [[nodiscard]] bool has_lines() const;                                       ///< if false, volumes do not matter
  [[nodiscard]] const PneumaticLine* line(std::size_t plenum) const;          ///< null without a line
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }  ///< pistons first, then sources
  [[nodiscard]] const PlenumSchedule& source(const Group& group) const;       ///< of a group without a piston

  /// Returns the state in which the air is closed in at a time. @param volumes_m3 of each plenum, > 0 (asserts)
  [[nodiscard]] PneumaticState start(double time_s, std::span<const double> volumes_m3) const;

  /// Returns the gauge pressure in a plenum, Pa.
  [[nodiscard]] double pressure_Pa(const PneumaticState& state, std::size_t plenum) const;
  [[nodiscard]] std::vector<double> pressures_Pa(const PneumaticState& state) const;
  [[nodiscard]] double root_pressure_Pa(const PneumaticState& state, const Group& group) const;  ///< in the cylinder or source
  [[nodiscard]] double piston_pressure_Pa(const PneumaticState& state, std::size_t piston) const;

  /// Returns the free air that flows into a plenum through its line now, m^3/s; nothing without a line or where the line has no
  /// resistance.
  [[nodiscard]] std::optional<double> flow_m3_per_s(const PneumaticState& state, std::size_t plenum) const;

  /// Returns -dp/dV of a plenum whose line is shut, Pa/m^3: n P / V, where V includes half of the line. 0 without a line.
  [[nodiscard]] double stiffness_Pa_per_m3(const PneumaticState& state, std::size_t plenum) const;

  /// Returns the free air in all cylinders, lines and plena, minus the air that left the sources, m^3. It is constant.
  [[nodiscard]] double free_air_m3(const PneumaticState& state) const;

  /// Returns the energy of the air in all cylinders, lines and plena, J. It grows by the work of pistons and sources, and falls
  /// by the work on plena and the losses in lines.
  [[nodiscard]] double stored_J(const PneumaticState& state) const;

  /// Checks that a time step resolves all schedules and pistons.
  /// @throws io::InputError naming plenum or piston if the step is too long for a schedule (see check_resolved of schedules), or
  /// a piston has fewer than 20 steps in a period or 2 in its ramp
  void check_resolved(std::span<const std::string> plenum_names, double step_s) const;

 private:
  [[nodiscard]] double root_volume_m3(const Group& group, double time_s) const;

  std::vector<PlenumSupply> plena_;
  std::vector<Piston> pistons_;
  PneumaticGas gas_;
  std::vector<Group> groups_;
};

}  // namespace menger::fem
