#include "fem/pneumatics/pneumatic_supply_file.h"

#include <algorithm>

#include "fem/pneumatics/pressure_schedule_file.h"

namespace menger::fem {
namespace {

void describe_tube(io::StudyVisitor& visitor, StudyLine& line) {
  StudyLine::Tube tube = line.tube.value_or(StudyLine::Tube{});
  visitor.number({"length_m", "Length of a round tube.", "2"}, tube.length_m, io::positive());
  visitor.number({"diameter_m", "Inner diameter of the tube.", "0.003"}, tube.bore.diameter_m, io::positive());
  visitor.number({"viscosity_Pa_s", "Dynamic viscosity of the gas in the tube."}, tube.bore.viscosity_Pa_s, io::positive());
  line.tube = tube;
}

void describe_resistance(io::StudyVisitor& visitor, StudyLine& line) {
  visitor.number({"resistance_Pa_s_per_m3", "Resistance of a line with laminar flow.", "1e8"}, line.resistance_Pa_s_per_m3,
                 io::non_negative());
  visitor.number({"volume_m3", "Volume of the line."}, line.volume_m3, io::non_negative());
}

void describe(io::StudyVisitor& visitor, StudyLine& line) {
  visitor.one_of({{"resistance_Pa_s_per_m3", !line.tube, [&] { line.tube.reset(); }, [&] { describe_resistance(visitor, line); }},
                  {"length_m", line.tube.has_value(), [] {}, [&] { describe_tube(visitor, line); }}});
}

void describe(io::StudyVisitor& visitor, Piston& piston, const PneumaticGas& gas) {
  visitor.text({"name", "Name of the piston.", "\"cam\""}, piston.name);
  visitor.number({"bore_m", "Diameter of the cylinder.", "0.02"}, piston.bore_m, io::positive());
  visitor.number({"cylinder_length_m", "Length of the air in the cylinder when the piston is withdrawn.", "0.02"},
                 piston.cylinder_length_m, io::positive());
  visitor.number({"stroke_m", "Distance that the piston moves into the cylinder.", "0.016"}, piston.stroke_m, io::positive());
  visitor.check(piston.stroke_m <= piston.cylinder_length_m, "stroke_m", "is longer than the air in the cylinder");
  visitor.number({"dead_volume_m3", "Air in ports and fittings."}, piston.dead_volume_m3, io::non_negative());
  visitor.number({"frequency_Hz", "Strokes per second.", "3"}, piston.frequency_Hz, io::positive());
  visitor.number({"phase", "Fraction of a period by which the piston is ahead."}, piston.phase);
  visitor.number({"ramp_s", "Time in which the displacement grows to the whole stroke."}, piston.ramp_s, io::non_negative());
  visitor.number({"fill_pressure_Pa", "Gauge pressure of all air of the piston at the start."}, piston.fill_pressure_Pa,
                 {.lowest = -gas.ambient_pressure_Pa, .lowest_excluded = true});
}

/// Whether an earlier entry has the same name.
template <class Entry>
bool is_named_before(const std::vector<Entry>& entries, const Entry& entry, std::string Entry::*name) {
  for (const Entry& other : entries) {
    if (&other == &entry) return false;
    if (other.*name == entry.*name) return true;
  }
  return false;
}

/// The index of a piston; the number of pistons if none has this name.
std::size_t place_of(const std::vector<Piston>& pistons, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(pistons, name, &Piston::name) - pistons.begin());
}

void describe(io::StudyVisitor& visitor, StudyPlenum& plenum, const StudySupply& supply) {
  visitor.text({"plenum", "Name of the plenum.", "\"plenum 0\""}, plenum.plenum);
  visitor.check(!is_named_before(supply.plena, plenum, &StudyPlenum::plenum), "plenum", "already has a supply");
  visitor.word(
      {"supply", "What drives the plenum: the pressure of a schedule, the pressure of a source behind a line, or a piston."},
      plenum.supply, {{"schedule", SupplyKind::schedule}, {"line", SupplyKind::line}, {"piston", SupplyKind::piston}});
  const bool has_piston = plenum.supply == SupplyKind::piston;
  visitor.only_if(has_piston, "supply = \"piston\"", [&] {
    visitor.text({"piston", "Name of the piston.", "\"cam\""}, plenum.piston);
    visitor.check(place_of(supply.pistons, plenum.piston) < supply.pistons.size(), "piston",
                  supply.pistons.empty() ? "the file has no [[piston]]" : "no piston has this name");
  });
  visitor.only_if(!has_piston, "supply = \"schedule\" or \"line\"", [&] {
    describe(visitor, plenum.schedule, plenum.file);
    if (visitor.source() == nullptr) return;
    visitor.check(lowest_pressure_Pa(plenum.schedule) > -supply.gas.ambient_pressure_Pa, "schedule",
                  "reaches a perfect vacuum or less, given the ambient pressure of the gas");
  });
  visitor.only_if(plenum.supply != SupplyKind::schedule, "supply = \"line\" or \"piston\"",
                  [&] { describe(visitor, plenum.line); });
}

/// Checks a piston and the plena that it supplies. @param table of the piston
void check_piston(const io::TomlTable& table, const Piston& piston, const std::vector<StudyPlenum>& plena) {
  bool is_used = false;
  bool has_room = piston.dead_volume_m3 > 0.0 || piston.stroke_m < piston.cylinder_length_m;
  for (const StudyPlenum& plenum : plena) {
    if (plenum.supply != SupplyKind::piston || plenum.piston != piston.name) continue;
    is_used = true;
    has_room = has_room || plenum.line.line().volume_m3 > 0.0;
  }
  if (!is_used) throw table.error("name", "this piston supplies no plenum");
  if (!has_room) throw table.error("stroke_m", "leaves no room for the air: give a dead volume or a volume of lines");
}

PlenumSupply supply_of(const StudyPlenum& plenum, const std::vector<Piston>& pistons) {
  switch (plenum.supply) {
    case SupplyKind::piston:
      return PistonSupply{place_of(pistons, plenum.piston), plenum.line.line()};
    case SupplyKind::line:
      return LineSupply{plenum.schedule, plenum.line.line()};
    case SupplyKind::schedule:
      break;
  }
  return plenum.schedule;
}

}  // namespace

PneumaticLine StudyLine::line() const {
  if (tube) return round_line(tube->length_m, tube->bore);
  return {.resistance_Pa_s_per_m3 = resistance_Pa_s_per_m3, .volume_m3 = volume_m3};
}

void describe(io::StudyVisitor& visitor, PneumaticGas& gas) {
  visitor.number(
      {"exponent", "Exponent of the gas law. 1: the air has the temperature of its surroundings; 1.4: it keeps its heat."},
      gas.exponent, io::positive());
  visitor.number({"ambient_pressure_Pa", "Absolute pressure of the surroundings."}, gas.ambient_pressure_Pa, io::positive());
}

void describe(io::StudyVisitor& visitor, StudySupply& supply) {
  visitor.table({"gas", "Air in lines and cylinders."}, [&] { describe(visitor, supply.gas); });
  visitor.tables({"piston", "Pistons that push closed air through lines."}, supply.pistons, [&](Piston& piston) {
    describe(visitor, piston, supply.gas);
    visitor.check(!is_named_before(supply.pistons, piston, &Piston::name), "name", "another piston has this name");
  });
  visitor.tables({"pressure", "What drives a plenum. A plenum without a table stays at 0 Pa."}, supply.plena,
                 [&](StudyPlenum& plenum) { describe(visitor, plenum, supply); }, {.fewest = 1});
  if (visitor.source() == nullptr || supply.pistons.empty()) return;
  const std::vector<io::TomlTable> tables = visitor.source()->tables("piston");
  for (std::size_t p = 0; p < tables.size(); ++p) check_piston(tables[p], supply.pistons[p], supply.plena);
}

PneumaticSupply supply_of(const StudySupply& given, std::span<const std::string> plenum_names, const io::TomlTable& study) {
  std::vector<PlenumSupply> plena(plenum_names.size(), PlenumSchedule{ConstantPressure{}, 0.0});
  std::string known;
  for (const std::string& name : plenum_names) known += (known.empty() ? "\"" : ", \"") + name + "\"";
  for (std::size_t n = 0; n < given.plena.size(); ++n) {
    const auto at = std::ranges::find(plenum_names, given.plena[n].plenum);
    if (at == plenum_names.end())
      throw study.tables("pressure").at(n).error("plenum", "the body has " + (known.empty() ? "no plenum" : known));
    plena[static_cast<std::size_t>(at - plenum_names.begin())] = supply_of(given.plena[n], given.pistons);
  }
  return {std::move(plena), given.pistons, given.gas};
}

}  // namespace menger::fem
