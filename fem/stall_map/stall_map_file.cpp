#include "fem/stall_map/stall_map_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fem/pneumatics/pneumatic_supply_file.h"
#include "io/study/installed_folders.h"
#include "io/study/study_reader.h"
#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// Reads the curve of one body.
PlenumCompliance read_curve(const std::string& text, const fs::path& file) {
  const io::CsvContents csv = io::parse_csv(text, file);
  PlenumCompliance curve;
  for (std::size_t row = 0; row < csv.row_count(); ++row) {
    // The ranges make messages with file, line, column and value.
    curve.pressures_Pa.push_back(
        csv.number(row, "pressure_Pa",
                   row == 0 ? io::any_number() : io::Range{.lowest = curve.pressures_Pa.back(), .lowest_excluded = true}));
    curve.volumes_m3.push_back(csv.number(row, "volume_m3", row == 0 ? io::positive() : io::at_least(curve.volumes_m3.back())));
  }
  if (curve.pressures_Pa.size() < 2) throw io::InputError(file.string() + ": needs at least two rows");
  return curve;
}

void describe_points(io::StudyVisitor& visitor, PlenumCompliance& curve) {
  visitor.numbers({"pressures_Pa", "Gauge pressures, increasing.", "[0, 4000, 8000]"}, curve.pressures_Pa, io::any_number(),
                  {.fewest = 2});
  visitor.numbers({"volumes_m3", "Volumes of a body's plenum at these pressures, never decreasing.", "[1e-5, 1.2e-5, 1.5e-5]"},
                  curve.volumes_m3, io::positive(), {.fewest = 2});
  visitor.check(curve.volumes_m3.size() == curve.pressures_Pa.size(), "volumes_m3", "must have as many values as pressures_Pa");
  for (std::size_t n = 1; n < std::min(curve.pressures_Pa.size(), curve.volumes_m3.size()); ++n) {
    visitor.check(curve.pressures_Pa[n] > curve.pressures_Pa[n - 1], "pressures_Pa", "must be more than the value before it",
                  {n});
    visitor.check(curve.volumes_m3[n] >= curve.volumes_m3[n - 1], "volumes_m3", "must not be less than the value before it", {n});
  }
}

void describe_plenum(io::StudyVisitor& visitor, StallMapStudy& study) {
  PlenumCompliance& curve = study.plenum;
  const auto keep = [] {};
  fs::path file;
  const auto describe_file = [&] {
    visitor.path({"curve", "A CSV table with the columns pressure_Pa and volume_m3.", "\"curve.csv\""}, file);
    if (visitor.source() == nullptr) return;
    const auto read = [&] {
      const std::string text = io::read_whole(file);
      io::note_input(study.inputs, file, text);
      return read_curve(text, file);
    };
    curve = visitor.source()->reading("curve", read);
  };
  visitor.one_of({{"pressures_Pa", !curve.pressures_Pa.empty(), keep, [&] { describe_points(visitor, curve); }},
                  {"curve", false, keep, describe_file}},
                 "give the volume as a function of the pressure");
  int count = 1;  // in a study that was read, the curve is that of all bodies
  visitor.integer({"count", "Number of equal bodies with this curve."}, count, io::at_least(1));
  const io::TomlTable* table = visitor.source();
  if (table == nullptr) return;
  visitor.check(curve.pressures_Pa.front() > -study.gas.ambient_pressure_Pa, table->has("curve") ? "curve" : "pressures_Pa",
                "begins at a perfect vacuum or less");
  for (double& volume_m3 : curve.volumes_m3) volume_m3 *= count;
}

void describe_piston(io::StudyVisitor& visitor, StallMapStudy& study) {
  study.piston.name = "piston";
  visitor.number({"bore_m", "Diameter of the cylinder.", "0.02"}, study.piston.bore_m, io::positive());
  visitor.optional_number(
      {"cylinder_length_m",
       "Length of the air in the cylinder when the piston is withdrawn. If not given: the length of the stroke.", "0.1"},
      study.cylinder_length_m, io::positive());
  // required if it is the only room for air at the end of a stroke
  const bool has_room = study.cylinder_length_m || study.line_length_m || study.line_volume_m3 > 0.0;
  visitor.number({"dead_volume_m3", "Air in ports and fittings.", has_room ? "" : "1e-6"}, study.piston.dead_volume_m3,
                 io::non_negative());
  visitor.number({"fill_pressure_Pa", "Gauge pressure of all air at the start."}, study.piston.fill_pressure_Pa);
  const bool is_on_curve = visitor.source() == nullptr || study.plenum.contains(study.piston.fill_pressure_Pa);
  visitor.check(is_on_curve, "fill_pressure_Pa", "lies outside the curve of the plenum");
}

void describe_line(io::StudyVisitor& visitor, StallMapStudy& study) {
  const auto describe_volume = [&] {
    visitor.number({"volume_m3", "Volume of a line with laminar flow."}, study.line_volume_m3, io::non_negative());
  };
  const auto describe_length = [&] {
    double length_m = study.line_length_m.value_or(0.0);
    visitor.number({"length_m", "Length of a round tube. Its width follows from each resistance.", "2"}, length_m,
                   io::positive());
    study.line_length_m = length_m;
  };
  visitor.one_of({{"volume_m3", !study.line_length_m, [&] { study.line_length_m.reset(); }, describe_volume},
                  {"length_m", study.line_length_m.has_value(), [] {}, describe_length}});
}

void describe_count(io::StudyVisitor& visitor, std::size_t& count, std::size_t fewest) {
  visitor.integer({"count", "Number of values.", "5"}, count, io::within(static_cast<double>(fewest), 1000));
}

/// Describes resistances in equal ratios; both ends are exact.
void describe_resistances(io::StudyVisitor& visitor, std::vector<double>& values) {
  double lowest = values.empty() ? 0.0 : values.front();
  double highest = values.empty() ? 0.0 : values.back();
  std::size_t count = values.size();
  visitor.number({"lowest", "First value.", "1e6"}, lowest, io::positive());
  visitor.number({"highest", "Last value, more than the first.", "1e9"}, highest, {.lowest = lowest, .lowest_excluded = true});
  describe_count(visitor, count, 2);
  values.clear();
  for (std::size_t n = 0; n < count; ++n)
    values.push_back(lowest * std::pow(highest / lowest, static_cast<double>(n) / static_cast<double>(count - 1)));
  if (!values.empty()) values.back() = highest;
}

/// Describes strokes in equal steps; the last is exact.
void describe_strokes(io::StudyVisitor& visitor, StallMapStudy& study) {
  double longest = study.strokes_m.empty() ? 0.0 : study.strokes_m.back();
  std::size_t count = study.strokes_m.size();
  visitor.number({"longest", "Longest stroke, within the cylinder.", "0.02"}, longest, io::positive());
  describe_count(visitor, count, 1);
  const double cylinder = study.cylinder_length_m.value_or(longest);
  visitor.check(longest <= cylinder, "longest", "is longer than the air in the cylinder");
  const bool has_room =
      longest < cylinder || study.piston.dead_volume_m3 > 0.0 || study.line_volume_m3 > 0.0 || study.line_length_m.has_value();
  visitor.check(has_room, "longest", "leaves no room for the air: give a dead volume or a volume of the line");
  study.strokes_m.clear();
  for (std::size_t n = 1; n <= count; ++n)
    study.strokes_m.push_back(longest * static_cast<double>(n) / static_cast<double>(count));
  if (!study.strokes_m.empty()) study.strokes_m.back() = longest;
}

/// Returns the range of pressures that a stroke can reach: above the fill, on the curve. It may be empty in a study that is not
/// being read.
io::Range reachable_pressures(const io::StudyVisitor& visitor, const StallMapStudy& study) {
  const std::vector<double>& curve_Pa = study.plenum.pressures_Pa;
  const double lowest_Pa = std::max(0.0, study.piston.fill_pressure_Pa);
  const bool has_some = !curve_Pa.empty() && curve_Pa.back() > lowest_Pa;
  if (!has_some && visitor.source() == nullptr) return io::positive();
  return {.lowest = lowest_Pa, .highest = curve_Pa.back(), .lowest_excluded = true};
}

void describe_map(io::StudyVisitor& visitor, StallMapStudy& study) {
  visitor.numbers({"frequencies_Hz", "Strokes per second. There is one map for each frequency.", "[1, 3]"}, study.frequencies_Hz,
                  io::positive(), {.fewest = 1});
  std::vector<double> frequencies = study.frequencies_Hz;
  std::ranges::sort(frequencies);
  visitor.check(std::ranges::adjacent_find(frequencies) == frequencies.end(), "frequencies_Hz", "must not hold a value twice");
  visitor.table({"resistances_Pa_s_per_m3", "Resistances of the line, evenly spaced on a logarithmic scale."},
                [&] { describe_resistances(visitor, study.resistances_Pa_s_per_m3); });
  visitor.table({"strokes_m", "Strokes of the piston, evenly spaced up to the longest."},
                [&] { describe_strokes(visitor, study); });
  visitor.numbers({"isobars_Pa", "Pressures for which the shortest strokes are found."}, study.isobars_Pa,
                  reachable_pressures(visitor, study));
  visitor.integer({"steps_per_period", "Smallest number of steps per period."}, study.steps_per_period, io::within(20, 1e6));
  visitor.integer({"most_periods", "Largest number of periods. A cycle that has not settled by then is stopped."},
                  study.most_periods, io::within(2, 1e6));
  visitor.number(
      {"settled", "A cycle has settled if the peak changes by at most this fraction of itself from one period to the next."},
      study.settled, io::between(0.0, 1.0));
}

void describe_walker_design(io::StudyVisitor& visitor, StallWalker& walker, std::map<std::string, std::string>& inputs) {
  std::optional<fs::path> file;
  meshes::describe_design(visitor, walker.design, file);
  if (file) io::note_input(inputs, *file);
  visitor.integer({.name = "level",
                   .help = "Level of the fractal: 1 is the design itself, in 2 each cell is a copy of it.",
                   .earlier = "/travel.level"},
                  walker.level, io::within(1, 3));
}

void describe_walker(io::StudyVisitor& visitor, StallWalker& walker, std::map<std::string, std::string>& inputs) {
  visitor.table({.name = "design", .help = "The robot.", .earlier_text = "design.file"},
                [&] { describe_walker_design(visitor, walker, inputs); });
  visitor.path({.name = "parameters",
                .help = "File of the voxel parameters of its cells, or the name of some that come with menger: "
                        "dragon_skin_10_1cm for example.",
                .example = "\"parameters.toml\"",
                .data = io::parameter_data},
               walker.parameters);
  if (visitor.source() != nullptr) {
    walker.parameters_text = visitor.source()->reading("parameters", [&] { return io::read_whole(walker.parameters); });
    io::note_input(inputs, walker.parameters, walker.parameters_text);
  }
  visitor.number({"kinetic_friction", "Coefficient of friction while sliding."}, walker.kinetic_friction, io::non_negative());
  visitor.number({"static_friction", "Coefficient of friction at rest, at least the kinetic one."}, walker.static_friction,
                 io::non_negative());
  visitor.check(walker.static_friction >= walker.kinetic_friction, "static_friction",
                "is less than kinetic_friction = " + io::number_text(walker.kinetic_friction));
  visitor.integer({"periods", "Number of simulated periods. The first is not evaluated."}, walker.periods, io::within(2, 1000));
  visitor.integer({"every_resistance", "The robot walks at the first resistance, then at every n-th, with this n."},
                  walker.every_resistance, io::within(1, 1000));
  visitor.integer({"every_stroke", "The robot walks at the longest stroke, then at every n-th shorter one, with this n."},
                  walker.every_stroke, io::within(1, 1000));
}

void describe_mark(io::StudyVisitor& visitor, StallMark& mark, const StallMapStudy& study) {
  visitor.text({"label", "Label of the mark.", "\"here\""}, mark.label);
  visitor.number({"pressure_Pa", "Gauge pressure.", "2000"}, mark.pressure_Pa, reachable_pressures(visitor, study));
  visitor.number({"frequency_Hz", "One of map.frequencies_Hz.", "3"}, mark.frequency_Hz, io::positive());
  visitor.check(std::ranges::find(study.frequencies_Hz, mark.frequency_Hz) != study.frequencies_Hz.end(), "frequency_Hz",
                "must be one of map.frequencies_Hz");
}

}  // namespace

void describe(io::StudyVisitor& visitor, StallMapStudy& study) {
  visitor.table({"gas", "Air in piston, line and plenum."}, [&] { describe(visitor, study.gas); });
  visitor.table({"plenum", "The plenum at the end of the piston's line."}, [&] { describe_plenum(visitor, study); });
  visitor.table({"line", "The line between piston and plenum."}, [&] { describe_line(visitor, study); });
  visitor.table({"piston", "A piston that pushes closed air through the line."}, [&] { describe_piston(visitor, study); });
  visitor.table({"map", "The points of the map."}, [&] { describe_map(visitor, study); });
  visitor.optional_table({"travel", "A robot of calibrated voxels that walks at some points of the map."}, study.walker,
                         [&](StallWalker& walker) { describe_walker(visitor, walker, study.inputs); });
  visitor.tables({"mark", "Pressures at a frequency that are marked on the map."}, study.marks,
                 [&](StallMark& mark) { describe_mark(visitor, mark, study); });
}

StallMapStudy read_stall_map_study(const fs::path& file) {
  StallMapStudy study;
  study.file = file;
  const std::string text = io::read_whole(file);
  io::note_input(study.inputs, file, text);
  io::read_described(io::parse_toml(text, file), study);
  return study;
}

}  // namespace menger::fem
