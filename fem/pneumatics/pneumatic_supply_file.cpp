#include "fem/pneumatics/pneumatic_supply_file.h"

#include <algorithm>

namespace menger::fem {
namespace {

enum class Supply { schedule, line, piston };

PneumaticLine read_line(const io::TomlTable& table) {
  if (!table.has("length_m") && !table.has("diameter_m"))
    return {.resistance_Pa_s_per_m3 = table.number("resistance_Pa_s_per_m3", io::non_negative()),
            .volume_m3 = table.number_or("volume_m3", 0.0, io::non_negative())};
  return round_line(
      table.number("length_m", io::positive()),
      {table.number("diameter_m", io::positive()), table.number_or("viscosity_Pa_s", air_viscosity_Pa_s, io::positive())});
}

Piston read_piston(const io::TomlTable& table, const PneumaticGas& gas) {
  Piston piston{.name = table.text("name"),
                .bore_m = table.number("bore_m", io::positive()),
                .cylinder_length_m = table.number("cylinder_length_m", io::positive()),
                .stroke_m = table.number("stroke_m", io::positive()),
                .dead_volume_m3 = table.number_or("dead_volume_m3", 0.0, io::non_negative()),
                .frequency_Hz = table.number("frequency_Hz", io::positive()),
                .phase = table.number_or("phase", 0.0),
                .ramp_s = table.number_or("ramp_s", 0.0, io::non_negative())};
  piston.fill_pressure_Pa =
      table.number_or("fill_pressure_Pa", 0.0, {.lowest = -gas.ambient_pressure_Pa, .lowest_excluded = true});
  if (piston.stroke_m > piston.cylinder_length_m) throw table.error("stroke_m", "is longer than the cylinder's air");
  return piston;
}

/// The piston that a table names.
std::size_t named_piston(const io::TomlTable& table, const std::vector<Piston>& pistons) {
  const auto at = std::ranges::find(pistons, table.text("piston"), &Piston::name);
  if (at != pistons.end()) return static_cast<std::size_t>(at - pistons.begin());
  throw table.error("piston", pistons.empty() ? "the file has no [[piston]]" : "no piston has this name");
}

PlenumSupply read_supply(const io::TomlTable& table, const std::vector<Piston>& pistons, const PneumaticGas& gas) {
  const auto supply = table.word_or("supply", Supply::schedule,
                                    {{"schedule", Supply::schedule}, {"line", Supply::line}, {"piston", Supply::piston}});
  if (supply == Supply::piston) return PistonSupply{named_piston(table, pistons), read_line(table)};
  const PlenumSchedule schedule = read_plenum_schedule(table);
  if (lowest_pressure_Pa(schedule) <= -gas.ambient_pressure_Pa)
    throw table.error("schedule", "reaches a perfect vacuum or less, beside the ambient pressure of the gas");
  if (supply == Supply::line) return LineSupply{schedule, read_line(table)};
  return schedule;
}

void check_piston(const io::TomlTable& table, std::size_t piston, const Piston& values, const std::vector<PlenumSupply>& plena) {
  bool is_used = false;
  bool has_room = values.dead_volume_m3 > 0.0 || values.stroke_m < values.cylinder_length_m;
  for (const PlenumSupply& plenum : plena) {
    const auto* supply = std::get_if<PistonSupply>(&plenum);
    if (supply == nullptr || supply->piston != piston) continue;
    is_used = true;
    has_room = has_room || supply->line.volume_m3 > 0.0;
  }
  if (!is_used) throw table.error("name", "this piston supplies no plenum");
  if (!has_room) throw table.error("stroke_m", "leaves the air no room, without dead volume and volume of lines");
}

}  // namespace

PneumaticGas read_pneumatic_gas(const io::TomlTable& study) {
  PneumaticGas gas;
  if (const auto table = study.optional_table("gas")) {
    gas.exponent = table->number_or("exponent", gas.exponent, io::positive());
    gas.ambient_pressure_Pa = table->number_or("ambient_pressure_Pa", gas.ambient_pressure_Pa, io::positive());
  }
  return gas;
}

PneumaticSupply read_pneumatic_supply(const io::TomlTable& study, std::span<const std::string> plenum_names) {
  const PneumaticGas gas = read_pneumatic_gas(study);
  std::vector<Piston> pistons;
  const std::vector<io::TomlTable> piston_tables = study.optional_tables("piston");
  for (const io::TomlTable& table : piston_tables) {
    Piston piston = read_piston(table, gas);
    if (std::ranges::find(pistons, piston.name, &Piston::name) != pistons.end())
      throw table.error("name", "another piston has this name");
    pistons.push_back(std::move(piston));
  }
  std::vector<PlenumSupply> plena(plenum_names.size(), PlenumSchedule{ConstantPressure{}, 0.0});
  std::vector<bool> is_named(plenum_names.size(), false);
  for (const io::TomlTable& table : study.tables("pressure")) {
    const std::size_t plenum = named_plenum(table, plenum_names);
    if (is_named[plenum]) throw table.error("plenum", "has a supply already");
    is_named[plenum] = true;
    plena[plenum] = read_supply(table, pistons, gas);
  }
  for (std::size_t p = 0; p < pistons.size(); ++p) check_piston(piston_tables[p], p, pistons[p], plena);
  return PneumaticSupply(std::move(plena), std::move(pistons), gas);
}

}  // namespace menger::fem
