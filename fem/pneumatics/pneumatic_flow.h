#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fem/pneumatics/pneumatic_gas.h"
#include "fem/pneumatics/pneumatic_supply.h"
#include "fem/surfaces/plenum_compliance.h"

namespace menger::fem {

/// A volume that changes linearly with time and with its gauge pressure: V = V0 + rate (t - t0) + compliance p.
struct LinearVolume {
  double volume_m3 = 0.0;  ///< at t0 and 0 Pa
  double rate_m3_per_s = 0.0;
  double compliance_m3_per_Pa = 0.0;  ///< >= 0
};

/// The gauge pressure of air and its derivative by the amount of air.
struct AirPressure {
  double pressure_Pa = 0.0;
  double by_air_Pa_per_m3 = 0.0;
};

/// Returns the pressure p that satisfies V(p) (1 + p / P_ambient)^(1/n) = N, with V(p) = volume + compliance p and the free air
/// N. @param volume_m3 at 0 Pa @return nothing if no p > -P_ambient satisfies it
std::optional<AirPressure> pressure_in(const PneumaticGas& gas, double volume_m3, double compliance_m3_per_Pa, double air_m3);

/// How the volumes of plena change in a step: they change evenly to given volumes, or follow the pressure by compliances. One of
/// the two is given.
struct PlenumWalls {
  std::span<const double> volumes_m3{};
  std::span<const PlenumCompliance> compliances{};
};

/// The differential equations of a supply in one step: the flows of free air and of energy as functions of time and amounts of
/// air.
///
/// The unknowns are the free air behind each line with resistance, m^3, and, if works are wanted, the four integrals of
/// PneumaticWork since the start of the step, J. A line without resistance makes its plenum part of the cylinder, or gives it the
/// pressure of its source. No algebraic equation is left. The air in a cylinder is its closed amount minus the air elsewhere.
///
/// Each line is in a mode, laminar or turbulent. A mode ends where one of the functions of events() changes its sign. The rates
/// continue smoothly beyond this point: an integrator finds no kink before it stops there and calls pass() for the next mode.
/// Points of a compliance's curve are kinks that it does meet. They are many and slight, and its error control handles them.
class PneumaticFlow {
 public:
  PneumaticFlow(const PneumaticSupply& supply, bool with_works);

  [[nodiscard]] std::size_t line_count() const { return lines_.size(); }  ///< with resistance
  [[nodiscard]] std::size_t unknown_count() const { return lines_.size() + (with_works_ ? 4 : 0); }

  /// Begins a step. The spans in `walls` must stay valid during the step. @param duration_s > 0
  void begin(const PneumaticState& from, double duration_s, const PlenumWalls& walls);

  /// Sets the part of the step, in times since its start, in which schedules have no corner. Schedules are not evaluated exactly
  /// at its ends, where they may jump.
  void set_smooth_part(double begin_s, double end_s);
  /// Returns the end of the next part without a corner; the duration of the step if there is no further corner. @param begin_s
  /// since the start of the step
  [[nodiscard]] double smooth_part_end_s(double begin_s) const;

  void start_unknowns(std::span<double> unknowns) const;
  [[nodiscard]] double energy_scale_J() const {
    return energy_scale_J_;
  }  ///< energy of the air; works below 1e-12 of it are rounding

  /// Computes the rates of the unknowns. @param since_s since the start of the step @return false where a volume or its air is
  /// not positive
  [[nodiscard]] bool rates(double since_s, std::span<const double> unknowns, std::span<double> result);
  /// Computes the derivatives of the rates by the unknowns, column by column. Each column is as long as the unknowns.
  [[nodiscard]] bool jacobian(double since_s, std::span<const double> unknowns, std::span<double* const> columns);

  /// Functions that cross zero at events. Those of modes come first; they are positive in the mode. Those of turning points
  /// follow: rates of pressures and of the drives of lines.
  [[nodiscard]] std::size_t mode_event_count() const { return mode_events_.size(); }
  [[nodiscard]] std::size_t turning_point_count() const { return turning_points_.size(); }
  [[nodiscard]] bool events(double since_s, std::span<const double> unknowns, std::span<double> modes,
                            std::span<double> turning_points);
  /// Changes to the mode beyond an event. The unknowns are those of the last call of events or rates.
  void pass(std::size_t mode_event);

  /// Computes the supply's state at a time of the step. @return false where air is not positive
  [[nodiscard]] bool settle(double since_s, std::span<const double> unknowns, PneumaticState& to);

 private:
  struct Line {
    std::size_t plenum = 0;
    std::size_t group = 0;
    double resistance_Pa_s_per_m3 = 0.0;
    double laminar_drive_Pa = 0.0;
    double turbulent_sign = 0.0;  ///< sign of the drive in turbulent flow; 0: laminar
    AirPressure air{};
    double rate_Pa_per_s = 0.0;
    double drive_Pa = 0.0;
    double flow_m3_per_s = 0.0;
    double flow_by_drive = 0.0;
  };
  struct Root {
    std::vector<std::size_t> lines{};
    std::vector<std::size_t> joined{};  ///< plena whose line has no resistance
    double half_lines_m3 = 0.0;
    double closed_air_m3 = 0.0;  ///< air of a piston and all its plena together
    AirPressure air{};           ///< pressure in the cylinder or source; that of a source does not depend on air
    /// dp/dt in the cylinder, from the last evaluate_rates(); 0 for a source.
    double rate_Pa_per_s = 0.0;
    double cylinder_rate_m3_per_s = 0.0;
  };
  enum class Turn { plenum, drive, piston };
  struct TurningPoint {
    Turn turn{};
    std::size_t index = 0;  ///< index of a line or a group
  };
  [[nodiscard]] bool evaluate(double since_s, std::span<const double> unknowns);
  [[nodiscard]] bool evaluate_root(std::size_t group, double since_s, std::span<const double> unknowns);
  [[nodiscard]] bool evaluate_line(std::size_t line, double since_s, double air_m3);
  void evaluate_rates();
  [[nodiscard]] double schedule_time_s(double since_s) const;
  [[nodiscard]] double volume_m3(std::size_t plenum, double since_s) const;  ///< at 0 Pa
  void take_curve(std::size_t plenum);
  void set_piece(std::size_t plenum, std::size_t piece);
  int move_piece(const Root& root);
  [[nodiscard]] double distance_to_turbulence_Pa(const Line& line) const;
  [[nodiscard]] double rate_of(const TurningPoint& point) const;
  void settle_end(std::size_t plenum, double air_m3, double pressure_Pa, double since_s, PneumaticState& to) const;

  const PneumaticSupply& supply_;
  bool with_works_;
  std::vector<Line> lines_;
  std::vector<Root> roots_;  ///< one per group of the supply
  std::vector<std::size_t> group_of_;
  std::vector<std::optional<std::size_t>> line_of_;
  std::vector<std::size_t> mode_events_;  ///< lines whose flow can become turbulent
  std::vector<TurningPoint> turning_points_;

  PneumaticState from_;
  double duration_s_ = 0.0;
  double begin_s_ = 0.0;
  double end_s_ = 0.0;
  PlenumWalls walls_;
  std::vector<LinearVolume> volumes_;               ///< of each plenum together with half of its line
  std::vector<std::size_t> pieces_;                 ///< number of points of the compliance below the plenum's pressure
  std::vector<std::vector<double>> curve_airs_m3_;  ///< free air of each plenum at the points of its compliance
  double energy_scale_J_ = 0.0;
  bool is_evaluated_ = false;  ///< whether the values below hold, so that a Jacobian reuses those of its residual
  double evaluated_s_ = 0.0;
  std::vector<double> evaluated_airs_m3_;  ///< of lines
};

}  // namespace menger::fem
