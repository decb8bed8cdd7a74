#include "voxel/model/surrogate_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text/input_error.h"
#include "io/text/range.h"
#include "io/text/toml_document.h"
#include "voxel/model/table_text.h"

namespace menger::voxel {
namespace {

constexpr int most_voxels_per_cell = 64;

/// Keys of the lowest pressures, by the cells between facing walls.
constexpr ByGap<std::string_view> lowest_pressure_keys{"lowest_pressure_gap_1_Pa", "lowest_pressure_gap_2_Pa",
                                                       "lowest_pressure_gap_3_Pa"};

ByWallClass<double> read_by_class(const io::TomlTable& table, std::string_view key, const io::Range& range) {
  const std::vector<double> values = table.numbers(key, range);
  if (values.size() != wall_class_count) {
    throw table.error(key, "must be " + std::to_string(wall_class_count) + " numbers, one per wall class, not " +
                               std::to_string(values.size()));
  }
  ByWallClass<double> by_class{};
  std::copy(values.begin(), values.end(), by_class.begin());
  return by_class;
}

/// Where the law of a class of voxels must have a value: over the range of the class. Voxels of a divided cell have other classes
/// than it, and any of them may come under any pressure.
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

/// Pressure laws of a table, each sound over the range of validity of its class.
/// @param parameters with validity and voxels_per_cell set
ByWallClass<PressureLaw> read_laws(const io::TomlTable& table, const SurrogateParameters& parameters, bool is_extension) {
  const ByWallClass<double> slope = read_by_class(table, "slope_per_Pa", io::any_number());
  const ByWallClass<double> pressure = read_by_class(table, "pressure_softening_per_Pa", io::any_number());
  const ByWallClass<double> vacuum = read_by_class(table, "vacuum_softening_per_Pa", io::any_number());
  const ByWallClass<double> share = read_by_class(table, "fading_share", io::within(0.0, 1.0));
  const ByWallClass<double> fading = read_by_class(table, "fading_per_Pa", io::non_negative());
  ByWallClass<PressureLaw> laws{};
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    laws[c] = {.slope_per_Pa = slope[c],
               .pressure_softening_per_Pa = pressure[c],
               .vacuum_softening_per_Pa = vacuum[c],
               .fading_share = share[c],
               .fading_per_Pa = fading[c]};
    const std::array entry{c};
    for (const double end : law_range(parameters, c)) {
      const std::string_view softening = end < 0.0 ? "vacuum_softening_per_Pa" : "pressure_softening_per_Pa";
      if (!laws[c].has_value(end)) {
        throw table.error(
            softening, "the law has its pole within the range of validity, which ends at " + io::number_text(end) + " Pa", entry);
      }
      if (is_extension && !(1.0 + laws[c].value(end) > 0.0)) {
        throw table.error("slope_per_Pa", "no length is left at " + io::number_text(end) + " Pa, within the range of validity",
                          entry);
      }
    }
  }
  return laws;
}

void read_holds_for(const io::TomlTable& table, SurrogateParameters& parameters) {
  const io::Words<meshes::ChamberLayout> layouts{{to_string(meshes::ChamberLayout::single), meshes::ChamberLayout::single},
                                                 {to_string(meshes::ChamberLayout::per_phase), meshes::ChamberLayout::per_phase}};
  parameters.silicone = table.text("silicone");
  parameters.law = table.text("law");
  parameters.cell_edge_m = table.number("cell_edge_m", io::positive());
  parameters.wall_thickness_m = table.number("wall_thickness_m", io::positive());
  if (!(parameters.wall_thickness_m < 0.5 * parameters.cell_edge_m))
    throw table.error("wall_thickness_m", "must be less than half of cell_edge_m");
  parameters.voxels_per_cell = table.integer("voxels_per_cell", io::within(1, most_voxels_per_cell));
  parameters.chambers = table.word("chambers", layouts);
}

ValidityRange read_validity(const io::TomlTable& table) {
  ByGap<ByWallClass<double>> lowest{};
  for (std::size_t gap = 0; gap < gap_count; ++gap)
    lowest[gap] = read_by_class(table, lowest_pressure_keys[gap], io::at_most(0.0));
  return {.lowest_pressure_Pa = lowest,
          .highest_pressure_Pa = read_by_class(table, "highest_pressure_Pa", io::non_negative()),
          .lowest_joint_pressure_Pa = table.number("lowest_joint_pressure_Pa", io::at_most(0.0)),
          .highest_joint_pressure_Pa = table.number("highest_joint_pressure_Pa", io::non_negative()),
          .smallest_strain = table.number("smallest_strain", io::at_most(0.0)),
          .largest_strain = table.number("largest_strain", io::non_negative()),
          .longest_body_cells = table.integer("longest_body_cells", io::at_least(1)),
          .longest_aggregate_modules = table.integer("longest_aggregate_modules", io::at_least(1))};
}

/// The calibration's report may hold any table and any key. Asking for it as a text counts as having seen the table, but not as
/// having entered it.
void leave_unread(const io::TomlTable& top, std::string_view key) {
  if (!top.has(key)) return;
  try {
    (void)top.text(key);
  } catch (const io::InputError&) {
    return;
  }
  throw top.error(key, "must be a table");
}

std::string laws_text(const std::string& name, const ByWallClass<PressureLaw>& laws, const ByWallClass<double>* peak_ratio) {
  ByWallClass<double> slope{}, pressure{}, vacuum{}, share{}, fading{};
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    slope[c] = laws[c].slope_per_Pa;
    pressure[c] = laws[c].pressure_softening_per_Pa;
    vacuum[c] = laws[c].vacuum_softening_per_Pa;
    share[c] = laws[c].fading_share;
    fading[c] = laws[c].fading_per_Pa;
  }
  TableText table(name);
  table.numbers("slope_per_Pa", slope).numbers("pressure_softening_per_Pa", pressure).numbers("vacuum_softening_per_Pa", vacuum);
  table.numbers("fading_share", share).numbers("fading_per_Pa", fading);
  if (peak_ratio != nullptr) table.numbers("peak_ratio", *peak_ratio);
  return table.text();
}

}  // namespace

std::string_view to_string(meshes::ChamberLayout layout) {
  return layout == meshes::ChamberLayout::single ? "single" : "per-phase";
}

std::string surrogate_text(const SurrogateParameters& p, std::string_view prefix) {
  const auto name = [&](std::string_view table) { return std::string(prefix).append(table); };
  return TableText(name("holds_for"))
             .word("silicone", p.silicone)
             .word("law", p.law)
             .number("cell_edge_m", p.cell_edge_m)
             .number("wall_thickness_m", p.wall_thickness_m)
             .add("voxels_per_cell", std::to_string(p.voxels_per_cell))
             .word("chambers", to_string(p.chambers))
             .text() +
         TableText(name("validity"))
             .numbers(lowest_pressure_keys[gaps::one_cell], p.validity.lowest_pressure_Pa[gaps::one_cell])
             .numbers(lowest_pressure_keys[gaps::two_cells], p.validity.lowest_pressure_Pa[gaps::two_cells])
             .numbers(lowest_pressure_keys[gaps::three_or_more_cells], p.validity.lowest_pressure_Pa[gaps::three_or_more_cells])
             .numbers("highest_pressure_Pa", p.validity.highest_pressure_Pa)
             .number("lowest_joint_pressure_Pa", p.validity.lowest_joint_pressure_Pa)
             .number("highest_joint_pressure_Pa", p.validity.highest_joint_pressure_Pa)
             .number("smallest_strain", p.validity.smallest_strain)
             .number("largest_strain", p.validity.largest_strain)
             .add("longest_body_cells", std::to_string(p.validity.longest_body_cells))
             .add("longest_aggregate_modules", std::to_string(p.validity.longest_aggregate_modules))
             .text() +
         TableText(name("mass")).number("density_kg_m3", p.density_kg_m3).text() +
         TableText(name("stiffness"))
             .numbers("axial_Pa", p.axial_Pa)
             .numbers("bending_Pa", p.bending_Pa)
             .numbers("torsion_Pa", p.torsion_Pa)
             .numbers("shear_compliance_per_Pa", p.shear_compliance_per_Pa)
             .number("lateral_coupling", p.lateral_coupling)
             .text() +
         TableText(name("joint"))
             .number("axial_factor", p.joint.axial)
             .number("bending_factor", p.joint.bending)
             .number("torsion_factor", p.joint.torsion)
             .text() +
         laws_text(name("extension"), p.extension, nullptr) + laws_text(name("bulge"), p.bulge, &p.bulge_peak_ratio) +
         TableText(name("ground")).number("stiffness_N_per_m", p.ground_stiffness_N_per_m).text() +
         TableText(name("damping")).number("bond_ratio", p.bond_damping_ratio).boolean("measured", p.damping_measured).text();
}

SurrogateParameters read_surrogate(const std::filesystem::path& file) {
  const io::TomlTable top = io::read_toml(file);
  SurrogateParameters parameters = read_surrogate(top);
  top.finish();
  // Of the report only this matters, and what else stands in it is nobody's fault: so it is read apart.
  const io::TomlTable again = io::read_toml(file);
  if (const auto fit = again.optional_table("fit")) {
    const std::string status = fit->text_or("status", "completed");
    if (status != "completed") throw fit->error("status", "the calibration did not complete; its parameters are not to be used");
  }
  return parameters;
}

SurrogateParameters read_surrogate(const io::TomlTable& top) {
  SurrogateParameters parameters;
  read_holds_for(top.table("holds_for"), parameters);
  parameters.validity = read_validity(top.table("validity"));
  parameters.density_kg_m3 = top.table("mass").number("density_kg_m3", io::positive());
  const io::TomlTable stiffness = top.table("stiffness");
  parameters.axial_Pa = read_by_class(stiffness, "axial_Pa", io::positive());
  parameters.bending_Pa = read_by_class(stiffness, "bending_Pa", io::positive());
  parameters.torsion_Pa = read_by_class(stiffness, "torsion_Pa", io::positive());
  if (stiffness.has("shear_compliance_per_Pa"))
    parameters.shear_compliance_per_Pa = read_by_class(stiffness, "shear_compliance_per_Pa", io::non_negative());
  parameters.lateral_coupling = stiffness.number("lateral_coupling", {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
  const io::TomlTable joint = top.table("joint");
  parameters.joint = {.axial = joint.number("axial_factor", io::positive()),
                      .bending = joint.number("bending_factor", io::positive()),
                      .torsion = joint.number("torsion_factor", io::positive())};
  parameters.extension = read_laws(top.table("extension"), parameters, true);
  const io::TomlTable bulge = top.table("bulge");
  parameters.bulge = read_laws(bulge, parameters, false);
  parameters.bulge_peak_ratio = read_by_class(bulge, "peak_ratio", io::at_least(1.0));
  parameters.ground_stiffness_N_per_m = top.table("ground").number("stiffness_N_per_m", io::positive());
  const io::TomlTable damping = top.table("damping");
  parameters.bond_damping_ratio = damping.number("bond_ratio", io::non_negative());
  parameters.damping_measured = damping.boolean("measured");
  leave_unread(top, "fit");
  return parameters;
}

}  // namespace menger::voxel
