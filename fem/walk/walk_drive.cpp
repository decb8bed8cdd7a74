#include "fem/walk/walk_drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "fem/walk/walk_input_error.h"
#include "io/text/number_text.h"
#include "meshes/design/modular_body.h"

namespace menger::fem {
namespace {

/// Returns the phase of a cell, as a fraction of a period.
double phase_of(const SurrogateDrive& drive, const meshes::Polycube& body, const meshes::CellIndex& cell) {
  if (drive.mode == DriveMode::antiphase) return drive.material_phase.at(body.at(cell) == 2 ? 1 : 0);
  if (drive.mode != DriveMode::wave) return 0.0;
  const std::array<int, 3> position{cell.x, cell.y, cell.z};
  const std::array<int, 3> widths{body.nx(), body.ny(), body.nz()};
  const auto axis = static_cast<std::size_t>(drive.wave_axis);
  const int length = drive.wave_over_gaps ? std::max(widths[axis] - 1, 1) : widths[axis];
  return drive.wave_periods_per_body * position[axis] / length;
}

/// Returns whether two phases are the same moment of a period, except for rounding.
bool are_equal(double a, double b) { return std::abs(std::remainder(a - b, 1.0)) < 1e-9; }

std::string cell_text(const meshes::CellIndex& cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " + std::to_string(cell.z) + ")";
}

/// Returns the phase of each plenum. All of its cells must have it.
std::vector<double> plenum_phases(const SurrogateDrive& drive, const meshes::ModularBody& body,
                                  const meshes::HexahedralMesh& mesh) {
  struct Found {
    meshes::CellIndex cell;
    double phase;
  };
  std::vector<std::optional<Found>> found(mesh.plenum_names.size());
  for (const meshes::CellIndex& cell : body.cells().occupied()) {
    const std::size_t plenum = mesh.chambers[*body.region_of(cell)].plenum;
    const double phase = phase_of(drive, body.cells(), cell);
    if (!found[plenum]) found[plenum] = Found{cell, phase};
    if (are_equal(found[plenum]->phase, phase)) continue;
    throw WalkInputError("drive.mode", "cells " + cell_text(found[plenum]->cell) + " and " + cell_text(cell) +
                                           " share the air of \"" + mesh.plenum_names[plenum] + "\" and cannot have the phases " +
                                           io::number_text(found[plenum]->phase) + " and " + io::number_text(phase));
  }
  std::vector<double> result;
  result.reserve(found.size());
  for (const auto& entry : found) result.push_back(entry ? entry->phase : 0.0);
  return result;
}

}  // namespace

std::optional<double> stroke_frequency_Hz(const SurrogateDrive& drive) {
  if (drive.mode == DriveMode::none || drive.mode == DriveMode::hold) return std::nullopt;
  return drive.frequency_Hz;
}

std::vector<PlenumSchedule> plenum_schedules(const SurrogateDrive& drive, const meshes::Design& design,
                                             const meshes::HollowBodyOptions& hollow, const meshes::HexahedralMesh& mesh) {
  const auto& [lowest_Pa, highest_Pa] = drive.pressure_Pa;
  const double ramp_s = drive.ramp_s.value_or(1.0 / drive.frequency_Hz);
  const meshes::ModularBody body(design.body, hollow.level, hollow.chambers);
  std::vector<PlenumSchedule> schedules;
  for (const double phase : plenum_phases(drive, body, mesh)) {
    PlenumSchedule plenum{ConstantPressure{}, ramp_s};
    if (drive.mode == DriveMode::hold) plenum.schedule = ConstantPressure{highest_Pa};
    // The sine of the drive is the lowered cosine of SinePressure, a quarter of a period later.
    if (drive.mode != DriveMode::hold && drive.mode != DriveMode::none)
      plenum.schedule =
          SinePressure{.low_Pa = lowest_Pa, .high_Pa = highest_Pa, .frequency_Hz = drive.frequency_Hz, .phase = phase + 0.25};
    schedules.push_back(plenum);
  }
  return schedules;
}

}  // namespace menger::fem
