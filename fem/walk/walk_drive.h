#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fem/pneumatics/pressure_schedule.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The mode of a drive: which cells are driven when. The words are those of the surrogate.
enum class DriveMode { none, in_phase, antiphase, wave, hold };

/// The pressure drive of the surrogate's scenes. With it both models have the same pressure in the same chamber at the same time.
///
/// Let m be the mean and a the amplitude of the lowest and highest pressure, r = min(1, t / ramp), f the frequency, and phi the
/// phase of a cell:
///
///   p(t) = r (m + a sin(2 pi (f t + phi))).
///
/// For `hold`, p is r times the highest pressure. For `none`, p = 0.
struct SurrogateDrive {
  DriveMode mode = DriveMode::in_phase;
  std::array<double, 2> pressure_Pa{};             ///< lowest and highest, gauge
  double frequency_Hz = 1.0;                       ///< f > 0
  std::optional<double> ramp_s{};                  ///< >= 0; empty: one period
  std::array<double, 2> material_phase{0.0, 0.5};  ///< of antiphase
  int wave_axis = 1;
  double wave_periods_per_body = -1.0;
  bool wave_over_gaps = false;
};

/// Returns the frequency of the strokes of a drive; nothing for one that does nothing or holds its pressure.
std::optional<double> stroke_frequency_Hz(const SurrogateDrive& drive);

/// Returns one schedule per plenum.
/// @param mesh of the design, hollowed out with these options
/// @throws WalkInputError for a plenum whose cells differ in phase, because they share their air
std::vector<PlenumSchedule> plenum_schedules(const SurrogateDrive& drive, const meshes::Design& design,
                                             const meshes::HollowBodyOptions& hollow, const meshes::HexahedralMesh& mesh);

}  // namespace menger::fem
