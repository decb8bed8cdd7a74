#include "voxel/scene/physics_file.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/input_error.h"
#include "io/text/range.h"
#include "voxel/model/table_text.h"
#include "voxel/scene/calibrated_body_file.h"

namespace menger::voxel {
namespace {

/// Words of an enumeration whose to_string is the one place that knows them.
template <class Value, std::size_t count>
io::Words<Value> words_of(const std::array<Value, count>& values) {
  io::Words<Value> words;
  for (const Value value : values) words.emplace_back(to_string(value), value);
  return words;
}

const std::array actuation_modes{ActuationMode::none, ActuationMode::in_phase, ActuationMode::antiphase, ActuationMode::wave,
                                 ActuationMode::hold};
const std::array damping_modes{DampingMode::increments, DampingMode::velocity};
const std::array bond_dampings{BondDamping::explicit_step, BondDamping::semi_implicit};
const std::array number_types{NumberType::float64, NumberType::float32};
constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

VoxelMaterial read_material(const io::TomlTable& table, const VoxelMaterial& defaults) {
  return {.youngs_modulus_Pa = table.number_or("youngs_modulus_Pa", defaults.youngs_modulus_Pa, io::positive()),
          .density_kg_m3 = table.number_or("density_kg_m3", defaults.density_kg_m3, io::positive()),
          .static_friction = table.number_or("static_friction", defaults.static_friction, io::non_negative()),
          .kinetic_friction = table.number_or("kinetic_friction", defaults.kinetic_friction, io::non_negative())};
}

void read_materials(const io::TomlTable& table, Physics& physics) {
  physics.lateral_coupling =
      table.number_or("lateral_coupling", physics.lateral_coupling, {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
  std::array<VoxelMaterial, 2>& materials = physics.materials;
  constexpr std::array<std::string_view, 2> names{"material_1", "material_2"};
  for (std::size_t i = 0; i < materials.size(); ++i) {
    materials[i] = read_material(table, materials[i]);
    if (const auto own = table.optional_table(names[i])) materials[i] = read_material(*own, materials[i]);
  }
}

void read_damping(const io::TomlTable& table, DampingRatios& ratios) {
  ratios.bond = table.number_or("bond", ratios.bond, io::non_negative());
  ratios.collision = table.number_or("collision", ratios.collision, io::non_negative());
  ratios.global = table.number_or("global", ratios.global, io::non_negative());
}

void read_environment(const io::TomlTable& table, Physics& physics) {
  physics.gravity_m_s2 = table.number_or("gravity_m_s2", physics.gravity_m_s2, io::non_negative());
  physics.floor = table.boolean_or("floor", physics.floor);
  physics.stop_rotation_in_static_friction =
      table.boolean_or("stop_rotation_in_static_friction", physics.stop_rotation_in_static_friction);
}

void read_actuation(const io::TomlTable& table, Actuation& actuation) {
  actuation.mode = table.word_or("mode", actuation.mode, words_of(actuation_modes));
  actuation.amplitude =
      table.number_or("amplitude", actuation.amplitude, {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
  actuation.period_s = table.number_or("period_s", actuation.period_s, io::positive());
  actuation.ramp_s = table.number_or("ramp_s", actuation.ramp_s, io::non_negative());
  if (table.has("material_phase")) {
    const auto phases = table.numbers("material_phase");
    if (phases.size() != actuation.material_phase.size())
      throw table.error("material_phase", "must be two numbers, not " + std::to_string(phases.size()));
    actuation.material_phase = {phases[0], phases[1]};
  }
  const io::Words<int> axes{{axis_names[0], 0}, {axis_names[1], 1}, {axis_names[2], 2}};
  actuation.wave_axis = table.word_or("wave_axis", actuation.wave_axis, axes);
  actuation.wave_periods_per_body = table.number_or("wave_periods_per_body", actuation.wave_periods_per_body);
  actuation.wave_over_gaps = table.boolean_or("wave_over_gaps", actuation.wave_over_gaps);
}

/// The key holds either a number or a word, so a text is tried first and quietly.
std::optional<int> read_exclusion_depth(const io::TomlTable& table, std::string_view key) {
  std::string word;
  try {
    word = table.text(key);
  } catch (const io::InputError&) {
    return table.integer<int>(key, io::at_least(1));
  }
  if (word != "off") throw table.error(key, "must be an integer >= 1 or \"off\"");
  return std::nullopt;
}

void read_integration(const io::TomlTable& table, Integration& integration) {
  integration.time_step_fraction = table.number_or("time_step_fraction", integration.time_step_fraction, io::positive());
  integration.damping = table.word_or("damping", integration.damping, words_of(damping_modes));
  integration.number = table.word_or("number", integration.number, words_of(number_types));
  integration.single_precision_rest_lengths =
      table.boolean_or("single_precision_rest_lengths", integration.single_precision_rest_lengths);
  integration.bond_damping = table.word_or("bond_damping", integration.bond_damping, words_of(bond_dampings));
  if (integration.number == NumberType::float32 && integration.damping == DampingMode::increments) {
    throw table.error(table.has("number") ? "number" : "damping",
                      "float32 cannot carry damping from increments: use damping = \"velocity\" or number = \"float64\"");
  }
}

std::string integration_text(const Integration& integration) {
  TableText table("integration");
  table.number("time_step_fraction", integration.time_step_fraction)
      .word("damping", to_string(integration.damping))
      .word("number", to_string(integration.number))
      .boolean("single_precision_rest_lengths", integration.single_precision_rest_lengths);
  if (integration.bond_damping != BondDamping::explicit_step) table.word("bond_damping", to_string(integration.bond_damping));
  return table.text();
}

std::string material_text(std::string_view name, const VoxelMaterial& material, bool friction_only) {
  TableText table(name);
  if (!friction_only)
    table.number("youngs_modulus_Pa", material.youngs_modulus_Pa).number("density_kg_m3", material.density_kg_m3);
  return table.number("static_friction", material.static_friction).number("kinetic_friction", material.kinetic_friction).text();
}

std::string actuation_text(const Actuation& actuation, bool by_pressure) {
  TableText table("actuation");
  table.word("mode", to_string(actuation.mode));
  if (!by_pressure) table.number("amplitude", actuation.amplitude);
  table.number("period_s", actuation.period_s);
  if (actuation.ramp_s != 0.0 || by_pressure) table.number("ramp_s", actuation.ramp_s);
  return table.numbers("material_phase", actuation.material_phase)
      .word("wave_axis", axis_names.at(static_cast<std::size_t>(actuation.wave_axis)))
      .number("wave_periods_per_body", actuation.wave_periods_per_body)
      .boolean("wave_over_gaps", actuation.wave_over_gaps)
      .text();
}

}  // namespace

Physics read_physics(const io::TomlTable& table, const Physics& defaults) {
  Physics physics = defaults;
  if (const auto materials = table.optional_table("materials")) read_materials(*materials, physics);
  if (const auto damping = table.optional_table("damping")) read_damping(*damping, physics.damping_ratios);
  if (const auto environment = table.optional_table("environment")) read_environment(*environment, physics);
  if (const auto actuation = table.optional_table("actuation")) read_actuation(*actuation, physics.actuation);
  if (const auto collisions = table.optional_table("collisions"); collisions && collisions->has("exclusion_depth")) {
    physics.collisions.exclusion_depth = read_exclusion_depth(*collisions, "exclusion_depth");
  }
  if (const auto integration = table.optional_table("integration")) read_integration(*integration, physics.integration);
  if (const auto limits = table.optional_table("limits")) {
    physics.limits.speed_fraction = limits->number_or("speed_fraction", physics.limits.speed_fraction, io::positive());
    physics.limits.strain = limits->number_or("strain", physics.limits.strain, io::positive());
  }
  read_calibrated_body(table, physics);
  if (physics.surrogate && physics.integration.bond_damping != BondDamping::explicit_step) {
    const auto integration = table.optional_table("integration");
    const char* reason = "must be \"explicit\": the damping of a [surrogate] is part of its parameters";
    throw integration ? integration->error("bond_damping", reason) : table.error("integration.bond_damping", reason);
  }
  return physics;
}

std::string physics_text(const Physics& physics) {
  const auto& depth = physics.collisions.exclusion_depth;
  const bool calibrated = physics.surrogate.has_value();
  TableText damping("damping");
  if (!calibrated) damping.number("bond", physics.damping_ratios.bond);
  damping.number("collision", physics.damping_ratios.collision).number("global", physics.damping_ratios.global);
  TableText environment("environment");
  environment.number("gravity_m_s2", physics.gravity_m_s2).boolean("floor", physics.floor);
  if (!calibrated) environment.boolean("stop_rotation_in_static_friction", physics.stop_rotation_in_static_friction);
  std::string coupling;
  if (physics.lateral_coupling != 0.0)
    coupling = TableText("materials").number("lateral_coupling", physics.lateral_coupling).text();
  return coupling + material_text("materials.material_1", physics.materials[0], calibrated) +
         material_text("materials.material_2", physics.materials[1], calibrated) + damping.text() + environment.text() +
         actuation_text(physics.actuation, calibrated) +
         TableText("collisions").add("exclusion_depth", depth ? std::to_string(*depth) : io::toml_quoted("off")).text() +
         integration_text(physics.integration) +
         TableText("limits")
             .number("speed_fraction", physics.limits.speed_fraction)
             .number("strain", physics.limits.strain)
             .text() +
         (calibrated ? calibrated_body_text(*physics.surrogate) : std::string());
}

}  // namespace menger::voxel
