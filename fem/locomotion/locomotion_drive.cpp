#include "fem/locomotion/locomotion_drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "fem/surfaces/gas_law.h"
#include "io/text/number_text.h"
#include "meshes/design/modular_body.h"

namespace menger::fem {
namespace {

enum class Mode { none, in_phase, antiphase, wave, hold };

/// When each cell is driven, as fraction of a period.
struct CellPhases {
  Mode mode = Mode::in_phase;
  std::array<double, 2> material_phase{0.0, 0.5};
  int wave_axis = 1;
  double wave_periods_per_body = -1.0;
  bool wave_over_gaps = false;

  [[nodiscard]] double of(const meshes::Polycube& body, const meshes::CellIndex& cell) const {
    if (mode == Mode::antiphase) return material_phase.at(body.at(cell) == 2 ? 1 : 0);
    if (mode != Mode::wave) return 0.0;
    const std::array<int, 3> position{cell.x, cell.y, cell.z};
    const std::array<int, 3> widths{body.nx(), body.ny(), body.nz()};
    const auto axis = static_cast<std::size_t>(wave_axis);
    const int length = wave_over_gaps ? std::max(widths[axis] - 1, 1) : widths[axis];
    return wave_periods_per_body * position[axis] / length;
  }
};

CellPhases read_phases(const io::TomlTable& table, Mode mode) {
  CellPhases phases{.mode = mode};
  if (table.has("material_phase")) {
    const std::vector<double> given = table.numbers("material_phase");
    if (given.size() != 2) throw table.error("material_phase", "must be two numbers, not " + std::to_string(given.size()));
    phases.material_phase = {given[0], given[1]};
  }
  phases.wave_axis = table.word_or<int>("wave_axis", phases.wave_axis, {{"x", 0}, {"y", 1}, {"z", 2}});
  phases.wave_periods_per_body = table.number_or("wave_periods_per_body", phases.wave_periods_per_body);
  phases.wave_over_gaps = table.boolean_or("wave_over_gaps", phases.wave_over_gaps);
  return phases;
}

double read_period_s(const io::TomlTable& table, Mode mode) {
  const bool is_given = table.has("period_s") || table.has("frequency_Hz");
  if (mode == Mode::none && !is_given) return 1.0;  // nothing depends on it
  if (table.has("period_s") && table.has("frequency_Hz"))
    throw table.error("frequency_Hz", "period_s beside it: keep one of them");
  return table.has("frequency_Hz") ? 1.0 / table.number("frequency_Hz", io::positive())
                                   : table.number("period_s", io::positive());
}

/// Whether two phases are the same moment of a period, but for rounding.
bool are_equal(double a, double b) { return std::abs(std::remainder(a - b, 1.0)) < 1e-9; }

std::string cell_text(const meshes::CellIndex& cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " + std::to_string(cell.z) + ")";
}

/// The phase of each plenum, which all its cells must share.
std::vector<double> plenum_phases(const io::TomlTable& table, const CellPhases& phases, const meshes::ModularBody& body,
                                  const meshes::HexahedralMesh& mesh) {
  struct Found {
    meshes::CellIndex cell;
    double phase;
  };
  std::vector<std::optional<Found>> found(mesh.plenum_names.size());
  for (const meshes::CellIndex& cell : body.cells().occupied()) {
    const std::size_t plenum = mesh.chambers[*body.region_of(cell)].plenum;
    const double phase = phases.of(body.cells(), cell);
    if (!found[plenum]) found[plenum] = Found{cell, phase};
    if (are_equal(found[plenum]->phase, phase)) continue;
    throw table.error("mode", "cells " + cell_text(found[plenum]->cell) + " and " + cell_text(cell) + " share the air of \"" +
                                  mesh.plenum_names[plenum] + "\" and cannot have the phases " +
                                  io::number_text(found[plenum]->phase) + " and " + io::number_text(phase));
  }
  std::vector<double> result;
  result.reserve(found.size());
  for (const auto& entry : found) result.push_back(entry ? entry->phase : 0.0);
  return result;
}

}  // namespace

std::vector<PlenumSchedule> read_surrogate_drive(const io::TomlTable& table, const meshes::Design& design,
                                                 const meshes::HollowBodyOptions& hollow, const meshes::HexahedralMesh& mesh) {
  const std::vector<double> pressures = table.numbers("pressure_Pa");
  if (pressures.size() != 2)
    throw table.error("pressure_Pa",
                      "must be the lowest and the highest pressure, not " + std::to_string(pressures.size()) + " numbers");
  if (pressures[0] <= -standard_atmosphere_Pa) throw table.error("pressure_Pa", "reaches a perfect vacuum or less");
  if (pressures[0] > pressures[1]) throw table.error("pressure_Pa", "must ascend: lowest, then highest");
  const Mode mode = table.word<Mode>("mode", {{"none", Mode::none},
                                              {"in_phase", Mode::in_phase},
                                              {"antiphase", Mode::antiphase},
                                              {"wave", Mode::wave},
                                              {"hold", Mode::hold}});
  const double period_s = read_period_s(table, mode);
  const double ramp_s = table.number_or("ramp_s", period_s, io::non_negative());
  const CellPhases phases = read_phases(table, mode);
  const meshes::ModularBody body(design.body, hollow.level, hollow.chambers);

  std::vector<PlenumSchedule> schedules;
  for (const double phase : plenum_phases(table, phases, body, mesh)) {
    PlenumSchedule plenum{ConstantPressure{}, ramp_s};
    if (mode == Mode::hold) plenum.schedule = ConstantPressure{pressures[1]};
    // A sine is the lowered cosine of SinePressure a quarter of a period later.
    if (mode != Mode::hold && mode != Mode::none)
      plenum.schedule =
          SinePressure{.low_Pa = pressures[0], .high_Pa = pressures[1], .frequency_Hz = 1.0 / period_s, .phase = phase + 0.25};
    schedules.push_back(plenum);
  }
  return schedules;
}

}  // namespace menger::fem
