#include "voxel/scene/calibrated_body_file.h"

#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/range.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/model/table_text.h"

namespace menger::voxel {
namespace {

const io::Words<OutsideRange> outside_rules{{to_string(OutsideRange::refuse), OutsideRange::refuse},
                                            {to_string(OutsideRange::warn), OutsideRange::warn}};
const io::Words<meshes::ChamberLayout> chamber_layouts{
    {to_string(meshes::ChamberLayout::single), meshes::ChamberLayout::single},
    {to_string(meshes::ChamberLayout::per_phase), meshes::ChamberLayout::per_phase}};

/// A key that a table of the same file has no business with, because the calibrated parameters decide it.
void refuse_beside_surrogate(const io::TomlTable& table, std::string_view key) {
  if (table.has(key)) throw table.error(key, "contradicts [surrogate], whose parameters decide it");
}

void refuse_contradictions(const io::TomlTable& table) {
  const auto refuse = [](const std::optional<io::TomlTable>& part, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
      if (part) refuse_beside_surrogate(*part, key);
    }
  };
  if (const auto materials = table.optional_table("materials")) {
    refuse(materials, {"youngs_modulus_Pa", "density_kg_m3", "lateral_coupling"});
    for (const std::string_view name : {"material_1", "material_2"})
      refuse(materials->optional_table(name), {"youngs_modulus_Pa", "density_kg_m3"});
  }
  refuse(table.optional_table("damping"), {"bond"});
  refuse(table.optional_table("actuation"), {"amplitude"});
  constexpr std::string_view stop = "stop_rotation_in_static_friction";
  if (const auto environment = table.optional_table("environment"); environment && environment->has(stop))
    throw environment->error(stop, "means nothing beside [surrogate], whose bodies stand on the feet of their walls");
}

/// Parameters from a file, or from the tables that physics_text writes.
SurrogateParameters read_parameters(const io::TomlTable& table, const std::optional<std::filesystem::path>& file) {
  if (!file && !table.optional_table("parameters"))
    throw table.error("parameters", "is missing: the name of a file of voxel parameters, see menger calibrate");
  return file ? read_surrogate(*file) : read_surrogate(table.table("parameters"));
}

/// What the file expects the parameters to hold for, where it says so.
void check_expectations(const io::TomlTable& table, const SurrogateParameters& parameters) {
  if (const auto wall = table.optional_number("wall_thickness_m", io::positive());
      wall && std::abs(*wall - parameters.wall_thickness_m) > 1e-9 * *wall) {
    throw table.error("wall_thickness_m", "the parameters are calibrated for " + io::number_text(parameters.wall_thickness_m));
  }
  if (table.text_or("silicone", parameters.silicone) != parameters.silicone)
    throw table.error("silicone", "the parameters are calibrated for " + io::toml_quoted(parameters.silicone));
}

CalibratedBody read_body(const io::TomlTable& table, const std::optional<std::filesystem::path>& file) {
  CalibratedBody body;
  body.parameters = read_parameters(table, file);
  check_expectations(table, body.parameters);
  const std::vector<double> pressures = table.numbers("pressure_Pa");
  if (pressures.size() != 2)
    throw table.error("pressure_Pa",
                      "must be the lowest and the highest pressure, not " + std::to_string(pressures.size()) + " numbers");
  if (pressures[0] > pressures[1]) throw table.error("pressure_Pa", "must ascend: lowest, then highest");
  body.pressure_Pa = {pressures[0], pressures[1]};
  body.chambers = table.word_or("chambers", body.parameters.chambers, chamber_layouts);
  body.outside_range = table.word_or("outside_range", body.outside_range, outside_rules);
  return body;
}

}  // namespace

void read_calibrated_body(const io::TomlTable& table, Physics& physics) {
  if (const auto own = table.optional_table("surrogate")) physics.surrogate = read_body(*own, parameters_file(table));
  if (!physics.surrogate) return;
  refuse_contradictions(table);
  // A step from rest to the mean pressure makes the body ring, or throws it: the drive grows over its first period.
  const auto actuation = table.optional_table("actuation");
  if (table.has("surrogate") && !(actuation && actuation->has("ramp_s"))) physics.actuation.ramp_s = physics.actuation.period_s;
  // What the parameters decide keeps no value of its own, so that equal physics compare equal.
  for (VoxelMaterial& material : physics.materials) {
    material.youngs_modulus_Pa = VoxelMaterial{}.youngs_modulus_Pa;
    material.density_kg_m3 = VoxelMaterial{}.density_kg_m3;
  }
  physics.lateral_coupling = 0.0;
  physics.damping_ratios.bond = DampingRatios{}.bond;
  physics.actuation.amplitude = Actuation{}.amplitude;
  physics.stop_rotation_in_static_friction = false;
}

std::optional<std::filesystem::path> parameters_file(const io::TomlTable& table) {
  const auto surrogate = table.optional_table("surrogate");
  if (!surrogate) return std::nullopt;
  // The key holds a name or a table, so a name is tried first and quietly.
  std::string name;
  try {
    name = surrogate->text("parameters");
  } catch (const io::InputError&) {
    return std::nullopt;
  }
  return surrogate->path("parameters");
}

std::string calibrated_body_text(const CalibratedBody& body) {
  return TableText("surrogate")
             .numbers("pressure_Pa", body.pressure_Pa)
             .word("chambers", to_string(body.chambers))
             .word("outside_range", to_string(body.outside_range))
             .text() +
         surrogate_text(body.parameters, "surrogate.parameters.");
}

}  // namespace menger::voxel
