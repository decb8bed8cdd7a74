#include "fem/stall_map/stall_map_file.h"

#include <algorithm>
#include <cmath>

#include "fem/pneumatics/pneumatic_supply_file.h"
#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

PlenumCompliance read_compliance(const io::TomlTable& table, std::map<std::string, std::string>& inputs) {
  const fs::path file = table.path("curve");
  const double count = table.integer_or("count", 1, io::at_least(1));
  const std::string text = io::read_whole(file);
  inputs[file.string()] = io::content_hash(text);
  const io::CsvContents csv = io::parse_csv(text, file);
  PlenumCompliance plenum;
  double last_volume_m3 = 0.0;  // of one body: count times it, divided again, would be rounded
  for (std::size_t row = 0; row < csv.row_count(); ++row) {
    // The ranges name file, line, column and value.
    plenum.pressures_Pa.push_back(
        csv.number(row, "pressure_Pa",
                   row == 0 ? io::any_number() : io::Range{.lowest = plenum.pressures_Pa.back(), .lowest_excluded = true}));
    last_volume_m3 = csv.number(row, "volume_m3", row == 0 ? io::positive() : io::at_least(last_volume_m3));
    plenum.volumes_m3.push_back(count * last_volume_m3);
  }
  if (plenum.pressures_Pa.size() < 2) throw io::InputError(file.string() + ": needs at least two rows");
  return plenum;
}

void read_piston(const io::TomlTable& table, StallMapStudy& study) {
  study.piston = {.name = "piston",
                  .bore_m = table.number("bore_m", io::positive()),
                  .dead_volume_m3 = table.number_or("dead_volume_m3", 0.0, io::non_negative())};
  study.cylinder_length_m = table.optional_number("cylinder_length_m", io::positive());
  study.piston.fill_pressure_Pa = table.number_or("fill_pressure_Pa", 0.0);
  if (!study.plenum.contains(study.piston.fill_pressure_Pa))
    throw table.error("fill_pressure_Pa", "lies outside the curve of the plenum");
}

/// Numbers in equal ratios, the ends exact.
std::vector<double> read_resistances(const io::TomlTable& table) {
  const double lowest = table.number("lowest", io::positive());
  const double highest = table.number("highest", {.lowest = lowest, .lowest_excluded = true});
  const auto count = table.integer<std::size_t>("count", io::within(2, 1000));
  std::vector<double> values;
  for (std::size_t n = 0; n < count; ++n)
    values.push_back(lowest * std::pow(highest / lowest, static_cast<double>(n) / static_cast<double>(count - 1)));
  values.back() = highest;
  return values;
}

std::vector<double> read_strokes(const io::TomlTable& table, const StallMapStudy& study) {
  const double longest = table.number("longest", io::positive());
  const auto count = table.integer<std::size_t>("count", io::within(1, 1000));
  const double cylinder = study.cylinder_length_m.value_or(longest);
  if (longest > cylinder) throw table.error("longest", "is longer than the cylinder's air");
  if (longest == cylinder && study.piston.dead_volume_m3 == 0.0 && study.line_volume_m3 == 0.0 && !study.line_length_m)
    throw table.error("longest", "leaves the air no room, without dead volume and volume of the line");
  std::vector<double> values;
  for (std::size_t n = 1; n <= count; ++n) values.push_back(longest * static_cast<double>(n) / static_cast<double>(count));
  return values;
}

/// Those that a stroke can have raised: above the fill, on the curve.
io::Range reachable_pressures(const StallMapStudy& study) {
  return {.lowest = std::max(0.0, study.piston.fill_pressure_Pa),
          .highest = study.plenum.pressures_Pa.back(),
          .lowest_excluded = true};
}

void read_map(const io::TomlTable& table, StallMapStudy& study) {
  study.frequencies_Hz = table.numbers("frequencies_Hz", io::positive());
  study.resistances_Pa_s_per_m3 = read_resistances(table.table("resistances_Pa_s_per_m3"));
  study.strokes_m = read_strokes(table.table("strokes_m"), study);
  std::vector<double> frequencies = study.frequencies_Hz;
  std::ranges::sort(frequencies);
  if (frequencies.empty() || std::ranges::adjacent_find(frequencies) != frequencies.end())
    throw table.error("frequencies_Hz", "must be some frequencies, none of them twice");
  if (table.has("isobars_Pa")) study.isobars_Pa = table.numbers("isobars_Pa", reachable_pressures(study));
  study.steps_per_period = table.integer_or("steps_per_period", study.steps_per_period, io::within(20, 1e6));
  study.most_periods = table.integer_or("most_periods", study.most_periods, io::within(2, 1e6));
  study.settled = table.number_or("settled", study.settled, io::between(0.0, 1.0));
}

StallWalker read_walker(const io::TomlTable& table, std::map<std::string, std::string>& inputs) {
  const auto content = [&](const char* key) {
    const fs::path file = table.path(key);
    std::string text = io::read_whole(file);
    inputs[file.string()] = io::content_hash(text);
    return text;
  };
  StallWalker walker{.design = table.path("design"),
                     .parameters = table.path("parameters"),
                     .design_text = content("design"),
                     .parameters_text = content("parameters")};
  walker.level = table.integer_or("level", walker.level, io::within(1, 3));
  walker.static_friction = table.number_or("static_friction", walker.static_friction, io::non_negative());
  walker.kinetic_friction = table.number_or("kinetic_friction", walker.kinetic_friction, io::non_negative());
  if (walker.kinetic_friction > walker.static_friction)
    throw table.error("static_friction", "is less than kinetic_friction = " + io::number_text(walker.kinetic_friction));
  walker.periods = table.integer_or("periods", walker.periods, io::within(2, 1000));
  walker.every_resistance = table.integer_or("every_resistance", walker.every_resistance, io::within(1, 1000));
  walker.every_stroke = table.integer_or("every_stroke", walker.every_stroke, io::within(1, 1000));
  return walker;
}

std::string line(const char* key, double value) { return std::string(key) + " = " + io::number_text(value) + "\n"; }

std::string list(const char* key, const std::vector<double>& values) {
  std::string text = std::string(key) + " = [";
  for (const double value : values) text += (text.back() == '[' ? "" : ", ") + io::number_text(value);
  return text + "]\n";
}

std::string walker_text(const StallWalker& walker) {
  return "[travel]\ndesign = " + io::toml_quoted(walker.design.string()) +
         "\nparameters = " + io::toml_quoted(walker.parameters.string()) + "\n" + line("level", walker.level) +
         line("static_friction", walker.static_friction) + line("kinetic_friction", walker.kinetic_friction) +
         line("periods", static_cast<double>(walker.periods)) +
         line("every_resistance", static_cast<double>(walker.every_resistance)) +
         line("every_stroke", static_cast<double>(walker.every_stroke));
}

}  // namespace

std::string resolved_text(const StallMapStudy& study) {
  std::string text = "[plenum]\n" + list("pressures_Pa", study.plenum.pressures_Pa) + list("volumes_m3", study.plenum.volumes_m3);
  text += "[piston]\n" + line("bore_m", study.piston.bore_m) + line("dead_volume_m3", study.piston.dead_volume_m3) +
          line("fill_pressure_Pa", study.piston.fill_pressure_Pa);
  if (study.cylinder_length_m) text += line("cylinder_length_m", *study.cylinder_length_m);
  text += "[line]\n";
  text += study.line_length_m ? line("length_m", *study.line_length_m) : line("volume_m3", study.line_volume_m3);
  text += "[gas]\n" + line("exponent", study.gas.exponent) + line("ambient_pressure_Pa", study.gas.ambient_pressure_Pa);
  text += "[map]\n" + list("frequencies_Hz", study.frequencies_Hz) +
          list("resistances_Pa_s_per_m3", study.resistances_Pa_s_per_m3) + list("strokes_m", study.strokes_m) +
          list("isobars_Pa", study.isobars_Pa) + line("steps_per_period", static_cast<double>(study.steps_per_period)) +
          line("most_periods", static_cast<double>(study.most_periods)) + line("settled", study.settled);
  if (study.walker) text += walker_text(*study.walker);
  for (const StallMark& mark : study.marks)
    text += "[[mark]]\nlabel = " + io::toml_quoted(mark.label) + "\n" + line("pressure_Pa", mark.pressure_Pa) +
            line("frequency_Hz", mark.frequency_Hz);
  return text;
}

StallMapStudy read_stall_map_study(const fs::path& file) {
  StallMapStudy study;
  study.file = file;
  const std::string text = io::read_whole(file);
  study.inputs[file.string()] = io::content_hash(text);
  const io::TomlTable top = io::parse_toml(text, file);
  study.plenum = read_compliance(top.table("plenum"), study.inputs);
  study.gas = read_pneumatic_gas(top);
  if (study.plenum.pressures_Pa.front() <= -study.gas.ambient_pressure_Pa)
    throw top.table("plenum").error("curve", "begins at a perfect vacuum or less");
  read_piston(top.table("piston"), study);
  if (const auto line = top.optional_table("line")) {
    study.line_length_m = line->optional_number("length_m", io::positive());
    if (!study.line_length_m) study.line_volume_m3 = line->number_or("volume_m3", 0.0, io::non_negative());
  }
  read_map(top.table("map"), study);
  if (const auto travel = top.optional_table("travel")) study.walker = read_walker(*travel, study.inputs);
  for (const io::TomlTable& table : top.optional_tables("mark")) {
    study.marks.push_back({table.text("label"), table.number("pressure_Pa", reachable_pressures(study)),
                           table.number("frequency_Hz", io::positive())});
    if (std::ranges::find(study.frequencies_Hz, study.marks.back().frequency_Hz) == study.frequencies_Hz.end())
      throw table.error("frequency_Hz", "is none of map.frequencies_Hz");
  }
  top.finish();
  return study;
}

}  // namespace menger::fem
