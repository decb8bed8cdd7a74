#include "voxel/model/surrogate_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/range.h"
#include "io/text/toml_checks.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::voxel {
namespace {

constexpr int most_voxels_per_cell = 64;

constexpr const char* seven_zeros = "[0, 0, 0, 0, 0, 0, 0]";
constexpr const char* seven_ones = "[1, 1, 1, 1, 1, 1, 1]";
constexpr const char* seven_moduli = "[5e4, 5e4, 5e4, 5e4, 5e4, 5e4, 5e4]";
constexpr const char* seven_pressures = "[5e3, 5e3, 5e3, 5e3, 5e3, 5e3, 5e3]";
constexpr const char* seven_vacua = "[-2e3, -2e3, -2e3, -2e3, -2e3, -2e3, -2e3]";

/// Returns the pressures between which the law of a wall class must have a value: the range of validity of the class. The voxels
/// of a divided cell have other classes than the cell, and any of them may be under any pressure; so then it is the range of all
/// classes together.
std::array<double, 2> law_range(const SurrogateParameters& parameters, std::size_t wall_class) {
  const ValidityRange& validity = parameters.validity;
  std::array<double, 2> range{0.0, 0.0};
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    if (parameters.voxels_per_cell == 1 && c != wall_class) continue;
    for (const auto& of_gap : validity.lowest_pressure_Pa) range[0] = std::min(range[0], of_gap[c]);
    range[1] = std::max(range[1], validity.highest_pressure_Pa[c]);
  }
  return range;
}

/// Checks that each law has a value, and leaves a length, over the range of validity of its class. The ends are enough, because
/// laws of wall classes have no arc and are monotone.
/// @throws io::InputError otherwise
void check_laws(const io::TomlTable& table, const SurrogateParameters& parameters, const ByWallClass<PressureLaw>& laws,
                bool is_extension) {
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const std::array entry{c};
    for (const double end : law_range(parameters, c)) {
      const std::string_view softening = end < 0.0 ? "vacuum_softening_per_Pa" : "pressure_softening_per_Pa";
      if (!laws[c].has_value(end)) {
        throw table.error(
            softening, "the law has its pole within the range of validity, which ends at " + io::number_text(end) + " Pa", entry);
      }
      if (is_extension && !(1.0 + laws[c].value(end) > 0.0)) {
        throw table.error("slope_per_Pa",
                          "the rest length is not positive at " + io::number_text(end) + " Pa, within the range of validity",
                          entry);
      }
    }
  }
}

/// Checks that plates keep a length over the range of validity of their classes. The ends are enough: only where the slope is
/// positive can the draw-in make a plate shortest in between, and there it leaves more than 1 - plate_draw_in of the length.
/// @throws io::InputError otherwise
void check_plates(const io::TomlTable& table, const SurrogateParameters& parameters) {
  for (std::size_t law_class = wall_class_count; law_class < law_class_count; ++law_class) {
    if (place_in_plate(law_class).is_face) continue;
    for (const double end : law_range(parameters, wall_class_of(law_class))) {
      if (1.0 + parameters.extension_of(law_class).value(end) > 0.0) continue;
      throw table.error("plate_stretch_ratio", "the rest length of " + law_class_text(law_class) + " is not positive at " +
                                                   io::number_text(end) + " Pa, within the range of validity");
    }
  }
}

/// Describes one value of the laws of all classes as one list.
void describe_of_laws(io::StudyVisitor& visitor, const io::Key& key, ByWallClass<PressureLaw>& laws, double PressureLaw::*value,
                      const io::Range& range = io::any_number()) {
  ByWallClass<double> values{};
  for (std::size_t c = 0; c < wall_class_count; ++c) values[c] = laws[c].*value;
  visitor.numbers(key, values, range);
  for (std::size_t c = 0; c < wall_class_count; ++c) laws[c].*value = values[c];
}

void describe_laws(io::StudyVisitor& visitor, ByWallClass<PressureLaw>& laws) {
  describe_of_laws(visitor, {"slope_per_Pa", "Change of length per pressure, at zero pressure.", seven_zeros}, laws,
                   &PressureLaw::slope_per_Pa);
  describe_of_laws(visitor, {"pressure_softening_per_Pa", "Reciprocal of the limit pressure.", seven_zeros}, laws,
                   &PressureLaw::pressure_softening_per_Pa);
  describe_of_laws(visitor, {"vacuum_softening_per_Pa", "Reciprocal of the limit pressure under vacuum.", seven_zeros}, laws,
                   &PressureLaw::vacuum_softening_per_Pa);
  describe_of_laws(visitor, {"fading_share", "Share of the response that fades under pressure.", seven_zeros}, laws,
                   &PressureLaw::fading_share, io::within(0.0, 1.0));
  describe_of_laws(visitor, {"fading_per_Pa", "Reciprocal of the pressure above which this share fades.", seven_zeros}, laws,
                   &PressureLaw::fading_per_Pa, io::non_negative());
}

void describe_subject(io::StudyVisitor& visitor, SurrogateParameters& parameters) {
  visitor.text({"silicone", "Name of the silicone.", "\"Dragon Skin 10\""}, parameters.silicone);
  visitor.text({"law", "Law of the silicone, on one line.", "\"neo-Hookean\""}, parameters.law);
  visitor.number({"cell_edge_m", "Edge of a cast cell.", "0.01"}, parameters.cell_edge_m, io::positive());
  visitor.number({"wall_thickness_m", "Thickness of the walls of a cell.", "0.002"}, parameters.wall_thickness_m, io::positive());
  visitor.check(parameters.wall_thickness_m < 0.5 * parameters.cell_edge_m, "wall_thickness_m",
                "must be less than half of cell_edge_m");
  visitor.integer({"voxels_per_cell", "Voxels along the edge of a cell.", "1"}, parameters.voxels_per_cell,
                  io::within(1, most_voxels_per_cell));
  visitor.word(
      {"chambers", "Cells that share one chamber: all cells of a module, or each connected region of cells of one phase.",
       "\"single\""},
      parameters.chambers, meshes::chamber_layout_words());
}

void describe(io::StudyVisitor& visitor, ValidityRange& range) {
  constexpr ByGap<std::array<const char*, 2>> lowest{
      {{"lowest_pressure_gap_1_Pa", "Lowest pressure of cells between walls that face each other one cell apart."},
       {"lowest_pressure_gap_2_Pa", "Lowest pressure of cells between walls that face each other two cells apart."},
       {"lowest_pressure_gap_3_Pa", "Lowest pressure of cells between walls that face each other three cells apart or more."}}};
  for (std::size_t gap = 0; gap < gap_count; ++gap)
    visitor.numbers({lowest[gap][0], lowest[gap][1], seven_vacua}, range.lowest_pressure_Pa[gap], io::at_most(0.0));
  visitor.numbers({"highest_pressure_Pa", "Highest pressure of cells.", seven_pressures}, range.highest_pressure_Pa,
                  io::non_negative());
  visitor.number({"lowest_joint_pressure_Pa", "Lowest pressure of bodies with joints.", "-2e3"}, range.lowest_joint_pressure_Pa,
                 io::at_most(0.0));
  visitor.number({"highest_joint_pressure_Pa", "Highest pressure of bodies with joints.", "5e3"}, range.highest_joint_pressure_Pa,
                 io::non_negative());
  visitor.number({"smallest_strain", "Lowest axial strain of beams, relative to their rest length.", "-0.1"},
                 range.smallest_strain, io::at_most(0.0));
  visitor.number({"largest_strain", "Highest axial strain of beams, relative to their rest length.", "0.1"}, range.largest_strain,
                 io::non_negative());
  visitor.integer({"longest_body_cells", "Largest number of cells along the longest side of a module.", "3"},
                  range.longest_body_cells, io::at_least(1));
  visitor.integer({"longest_aggregate_modules", "Largest number of modules along the longest side of a body.", "1"},
                  range.longest_aggregate_modules, io::at_least(1));
}

void describe_stiffness(io::StudyVisitor& visitor, SurrogateParameters& parameters) {
  visitor.numbers({"axial_Pa", "Axial modulus of beams.", seven_moduli}, parameters.axial_Pa, io::positive());
  visitor.numbers({"bending_Pa", "Bending modulus of beams.", seven_moduli}, parameters.bending_Pa, io::positive());
  visitor.numbers({"torsion_Pa", "Torsion modulus of beams.", seven_moduli}, parameters.torsion_Pa, io::positive());
  visitor.numbers({"shear_compliance_per_Pa", "Shear compliance of beams. 0 means that sections stay normal to the axis."},
                  parameters.shear_compliance_per_Pa, io::non_negative());
  visitor.number({"lateral_coupling", "How much a body becomes thinner when it is stretched.", "0"}, parameters.lateral_coupling,
                 {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
}

/// Accepts a table without reading what is in it, because the calibration's report may hold any table and any key. Asking for the
/// key counts as having seen the table, but not as having entered it.
void leave_unread(const io::TomlTable& top, std::string_view key) {
  if (top.asks_for(key) && !top.is_table(key)) throw top.error(key, "must be a table");
}

/// Checks that the report of a fit has no interval for a value that the curves do not determine, but the word for it.
void check_intervals(const io::TomlTable& fit) {
  const auto intervals = fit.optional_table("confidence_95");
  if (!intervals) return;
  for (const char* list : {"at_bound", "not_separable", "no_influence"}) {
    if (!fit.has(list)) continue;
    for (const std::string& name : fit.texts(list)) {
      if (!intervals->has(name)) continue;  // as in files of earlier versions
      const std::string reason = "must be " + io::toml_quoted(not_determined) + ", because fit." + list + " names it";
      if (!intervals->is_text(name) || intervals->text(name) != not_determined) throw intervals->error(name, reason);
    }
  }
}

}  // namespace

std::string_view to_string(meshes::ChamberLayout layout) {
  return layout == meshes::ChamberLayout::single ? "single" : "per-phase";
}

void describe(io::StudyVisitor& visitor, SurrogateParameters& parameters) {
  visitor.table({"holds_for", "Silicone and cells that the parameters were fitted for."},
                [&] { describe_subject(visitor, parameters); });
  visitor.table({"validity", "Range of validity of the parameters."}, [&] { describe(visitor, parameters.validity); });
  visitor.table({"mass", "Mass of the silicone."}, [&] {
    const io::Key density{
        .name = "density_kg_per_m3", .help = "Density of the silicone.", .example = "1070", .earlier = "density_kg_m3"};
    visitor.number(density, parameters.density_kg_m3, io::positive());
  });
  visitor.table({"stiffness", "Stiffness of beams, by wall class."}, [&] { describe_stiffness(visitor, parameters); });
  visitor.table(
      {"joint", "Factors on the stiffness of beams between two modules or two chambers, relative to all other beams."}, [&] {
        visitor.number({"axial_factor", "Factor on the axial stiffness.", "1"}, parameters.joint.axial, io::positive());
        visitor.number({"bending_factor", "Factor on the bending stiffness.", "1"}, parameters.joint.bending, io::positive());
        visitor.number({"torsion_factor", "Factor on the torsional stiffness.", "1"}, parameters.joint.torsion, io::positive());
      });
  visitor.table({"extension", "How the rest length of beams depends on pressure, by wall class."}, [&] {
    describe_laws(visitor, parameters.extension);
    visitor.number({"elbow_ratio",
                    "Turn of a beam where a tube bends or branches (rad), divided by the strain that pressure gives the beam."},
                   parameters.elbow_ratio, io::non_negative());
    visitor.number({"plate_stretch_ratio", "Slope inside a plate, divided by that of wall class 2o."},
                   parameters.plate_stretch_ratio, io::positive());
    visitor.number({"plate_draw_in", "By what share of its length a plate becomes shorter at most because its walls bulge."},
                   parameters.plate_draw_in, {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
    visitor.number(
        {"plate_rise", "How much further the faces of a plate stand out at most than those of a block, by the edge of a voxel."},
        parameters.plate_rise, io::non_negative());
    visitor.number({"plate_draw_in_per_Pa", "Reciprocal of the pressure at which half of both is reached."},
                   parameters.plate_draw_in_per_Pa, io::non_negative());
    visitor.number({"plate_edge_share", "What is left of all three at the edges of plates: 0 nothing, 1 all."},
                   parameters.plate_edge_share, io::within(0.0, 1.0));
    if (const io::TomlTable* table = visitor.source()) {
      check_laws(*table, parameters, parameters.extension, true);
      check_plates(*table, parameters);
    }
  });
  visitor.table({"bulge", "How far faces with a wall bulge under pressure, by wall class."}, [&] {
    describe_laws(visitor, parameters.bulge);
    if (const io::TomlTable* table = visitor.source()) check_laws(*table, parameters, parameters.bulge, false);
    visitor.numbers({"peak_ratio", "Largest bulge of a face, divided by its mean bulge.", seven_ones},
                    parameters.bulge_peak_ratio, io::at_least(1.0));
    visitor.number({"neck_ratio", "How far a plate stands out where a limb leaves it, divided by its crown."},
                   parameters.neck_ratio, io::positive());
    visitor.number({"plate_arm_ratio", "How far a face of a plate bulges beside an arm, divided by its bulge without the arm."},
                   parameters.plate_arm_ratio, io::positive());
    visitor.number({"wide_volume_ratio", "Volume below a face of a plate or a block, divided by its mean bulge times its area."},
                   parameters.wide_volume_ratio, io::positive());
  });
  visitor.table({"ground", "Contact with the ground."}, [&] {
    visitor.number({"stiffness_N_per_m", "Contact stiffness of a voxel that stands on all feet of a wall.", "500"},
                   parameters.ground_stiffness_N_per_m, io::positive());
  });
  visitor.table({"damping", "Damping of beams."}, [&] {
    visitor.number({"bond_ratio", "Fraction of critical damping.", "1"}, parameters.bond_damping_ratio, io::non_negative());
    visitor.boolean({"measured", "Whether the ratio comes from a measured loss; otherwise it is assumed.", "false"},
                    parameters.damping_measured);
  });
}

std::string surrogate_text(const SurrogateParameters& parameters) { return io::described_text(parameters); }

SurrogateParameters read_surrogate(const std::filesystem::path& file) {
  const std::string text = io::read_whole(file);
  const io::TomlTable top = io::parse_toml(text, file);
  SurrogateParameters parameters;
  io::StudyReader reader(top, io::StudyReader::EarlierNames::read);
  describe(reader, parameters);
  leave_unread(top, "fit");
  top.finish();
  // Only status and intervals of the report matter, and its other keys are not refused. But a number that is none, anywhere in
  // it, tells of a fit that failed.
  io::require_finite_numbers(text, file);
  if (const auto fit = top.unasked().optional_table("fit")) {
    check_intervals(*fit);
    const std::string status = fit->text_or("status", "completed");
    if (status != "completed") throw fit->error("status", "the calibration did not complete: do not use its parameters");
  }
  return parameters;
}

}  // namespace menger::voxel
