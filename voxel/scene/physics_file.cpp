#include "voxel/scene/physics_file.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/number_text.h"
#include "io/text/range.h"
#include "voxel/scene/calibrated_body_file.h"

namespace menger::voxel {
namespace {

constexpr io::Range fraction_below_one{.lowest = 0.0, .highest = 1.0, .highest_excluded = true};
constexpr std::string_view by_itself = "a body without [surrogate]; with [surrogate] its parameters give this value";
constexpr std::string_view as_voxels = "bodies that move as voxels";

/// Which keys of voxels have a meaning.
struct VoxelKeys {
  bool are_voxels = true;     ///< those of every voxel
  bool are_by_itself = true;  ///< those that the parameters of a calibrated body give
};

/// Returns when the keys that calibrated parameters give have a meaning.
std::string_view condition_of(const VoxelKeys& keys) { return keys.are_voxels ? by_itself : as_voxels; }

/// Whether a file has a key that leads through tables.
bool has_key(const io::TomlTable& table, std::string_view key) {
  const auto dot = key.find('.');
  if (dot == std::string_view::npos) return table.has(key);
  return table.is_table(key.substr(0, dot)) && has_key(table.table(key.substr(0, dot)), key.substr(dot + 1));
}

/// Describes a key of both materials. A written study has it if both materials have the same value.
void describe_both(io::StudyVisitor& visitor, const io::Key& key, std::array<VoxelMaterial, 2>& materials,
                   double VoxelMaterial::*value, const io::Range& range) {
  std::optional<double> both;
  if (materials[0].*value == materials[1].*value) both = materials[0].*value;
  visitor.optional_number(key, both, range);
  if (!both) return;
  for (VoxelMaterial& material : materials) material.*value = *both;
}

/// Describes the same key for one material, if its value differs from that of the other.
void describe_own(io::StudyVisitor& visitor, const io::Key& key, VoxelMaterial& material, const VoxelMaterial& other,
                  double VoxelMaterial::*value, const io::Range& range) {
  std::optional<double> own;
  if (material.*value != other.*value) own = material.*value;
  visitor.optional_number(key, own, range);
  material.*value = own.value_or(material.*value);
}

void describe_own(io::StudyVisitor& visitor, VoxelMaterial& material, const VoxelMaterial& other, const VoxelKeys& keys) {
  visitor.only_if(keys.are_by_itself, condition_of(keys), [&] {
    describe_own(visitor, {"youngs_modulus_Pa", "Young's modulus of this material only.", "2e4"}, material, other,
                 &VoxelMaterial::youngs_modulus_Pa, io::positive());
    const io::Key density{
        .name = "density_kg_per_m3", .help = "Density of this material only.", .example = "20", .earlier = "density_kg_m3"};
    describe_own(visitor, density, material, other, &VoxelMaterial::density_kg_m3, io::positive());
  });
  describe_own(visitor, {"static_friction", "Coefficient of static friction of this material only.", "0.9"}, material, other,
               &VoxelMaterial::static_friction, io::non_negative());
  describe_own(visitor, {"kinetic_friction", "Coefficient of kinetic friction of this material only.", "0.4"}, material, other,
               &VoxelMaterial::kinetic_friction, io::non_negative());
}

void describe_materials(io::StudyVisitor& visitor, Physics& physics, const VoxelKeys& keys, bool is_identity) {
  std::array<VoxelMaterial, 2>& materials = physics.materials;
  visitor.only_if(keys.are_by_itself, condition_of(keys), [&] {
    describe_both(visitor, {"youngs_modulus_Pa", "Young's modulus of both materials.", "1e4"}, materials,
                  &VoxelMaterial::youngs_modulus_Pa, io::positive());
    const io::Key density{
        .name = "density_kg_per_m3", .help = "Density of both materials.", .example = "10", .earlier = "density_kg_m3"};
    describe_both(visitor, density, materials, &VoxelMaterial::density_kg_m3, io::positive());
    visitor.number({"lateral_coupling", "How much a body becomes thinner when it is stretched. 0 means not at all."},
                   physics.lateral_coupling, fraction_below_one);
    if (is_identity && physics.beam_moments == BeamMoments::published) return;
    visitor.word(
        {"beam_moments",
         "Whether moments on the ends of a beam balance its forces. published: as in Voxelyze, where they do not while a "
         "body is driven, so that it turns by itself; balanced: they do."},
        physics.beam_moments, io::words_of(BeamMoments::published, BeamMoments::balanced));
  });
  // Each material is compared with the values before, so that reading the first does not hide a difference of the second.
  const std::array<VoxelMaterial, 2> before = materials;
  visitor.table({"material_1", "Properties of material 1 that differ from those of both materials."},
                [&] { describe_own(visitor, materials[0], before[1], keys); });
  visitor.table({"material_2", "Properties of material 2 that differ from those of both materials."},
                [&] { describe_own(visitor, materials[1], before[0], keys); });
}

void describe_ground(io::StudyVisitor& visitor, Physics& physics, const VoxelKeys& keys) {
  visitor.boolean({.name = "present", .help = "Whether there is a ground.", .earlier = "/environment.floor"}, physics.floor);
  describe_both(visitor,
                {.name = "static_friction",
                 .help = "Coefficient of static friction of both materials.",
                 .example = "1",
                 .earlier = "/materials.static_friction"},
                physics.materials, &VoxelMaterial::static_friction, io::non_negative());
  describe_both(visitor,
                {.name = "kinetic_friction",
                 .help = "Coefficient of kinetic friction of both materials.",
                 .example = "0.5",
                 .earlier = "/materials.kinetic_friction"},
                physics.materials, &VoxelMaterial::kinetic_friction, io::non_negative());
  visitor.only_if(
      keys.are_by_itself,
      keys.are_voxels ? "a body without [surrogate]; with [surrogate] the body stands on the feet of its walls" : as_voxels, [&] {
        visitor.boolean({.name = "stop_rotation",
                         .help = "Whether a voxel in static friction with the ground also stops rotating.",
                         .earlier = "/environment.stop_rotation_in_static_friction"},
                        physics.stop_rotation_in_static_friction);
      });
}

/// Describes the key of the pressures. @param brings_pressure whether the study had no pressure before
void describe_pressure(io::StudyVisitor& visitor, std::optional<CalibratedBody>& body, const PhysicsUse& use,
                       bool brings_pressure) {
  std::array<double, 2>* const other = use.pressure_Pa;
  visitor.only_if(body || other != nullptr, use.pressure_condition, [&] {
    std::array<double, 2> pressure_Pa = CalibratedBody{}.pressure_Pa;
    if (other != nullptr) pressure_Pa = *other;
    if (body) pressure_Pa = body->pressure_Pa;
    visitor.numbers({.name = "pressure_Pa",
                     .help = "Lowest and highest pressure of the chambers.",
                     .example = brings_pressure ? "[0, 6e3]" : "",
                     .earlier = "/surrogate.pressure_Pa"},
                    pressure_Pa);
    visitor.check(pressure_Pa[0] <= pressure_Pa[1], "pressure_Pa", "must ascend: lowest, then highest");
    if (body)
      body->pressure_Pa = pressure_Pa;
    else if (other != nullptr)
      *other = pressure_Pa;
  });
}

/// Describes the keys of the drive. @param brings_pressure whether pressures are being read that there were not before
void describe_drive(io::StudyVisitor& visitor, Actuation& drive, const VoxelKeys& keys, bool brings_pressure) {
  using enum ActuationMode;
  visitor.word({"mode", "Phase with which each voxel is driven."}, drive.mode,
               io::words_of(none, in_phase, antiphase, wave, hold));
  visitor.only_if(keys.are_by_itself, condition_of(keys), [&] {
    visitor.number({"amplitude", "Amplitude of the edge of a voxel, as a fraction of the edge."}, drive.amplitude,
                   fraction_below_one);
  });
  visitor.number({.name = "frequency_Hz", .help = "Frequency of the drive.", .earlier = "period_s", .was_reciprocal = true},
                 drive.frequency_Hz, io::positive());
  if (brings_pressure) drive.ramp_s = drive.period_s();
  visitor.number({"ramp_s", "Time in which the drive grows from zero to its full size. Of pressures the default is one period."},
                 drive.ramp_s, io::non_negative());
  visitor.numbers({"material_phase", "Phases of the two materials in periods, for antiphase only."}, drive.material_phase);
  const io::Words<int> axes{{"x", 0}, {"y", 1}, {"z", 2}};
  visitor.word({"wave_axis", "Axis along which a wave travels."}, drive.wave_axis, axes);
  visitor.number(
      {"wave_periods_per_body", "Periods of a wave along a body. If negative, the wave travels towards larger coordinates."},
      drive.wave_periods_per_body);
  visitor.boolean({"wave_over_gaps", "Whether the last layer of a body has the full phase of a wave."}, drive.wave_over_gaps);
}

void describe_integration(io::StudyVisitor& visitor, Integration& integration, bool is_calibrated) {
  visitor.number({"time_step_fraction", "Time step, as a fraction of the recommended step."}, integration.time_step_fraction,
                 io::positive());
  visitor.word({"damping", "How the damping of beams is computed: from changes of position, or from velocities."},
               integration.damping, io::words_of(DampingMode::increments, DampingMode::velocity));
  visitor.word({"number", "Floating-point type of the computation. float32 needs damping from velocities."}, integration.number,
               io::words_of(NumberType::float64, NumberType::float32));
  visitor.boolean({"single_precision_rest_lengths", "Whether rest lengths are rounded as the public engine rounds them."},
                  integration.single_precision_rest_lengths);
  visitor.only_if(!is_calibrated, by_itself, [&] {
    visitor.word({"bond_damping", "Whether the damping of beams limits the time step, or is reduced so that it does not."},
                 integration.bond_damping, io::words_of(BondDamping::explicit_step, BondDamping::semi_implicit));
  });
  if (const io::TomlTable* table = visitor.source()) {
    const bool holds = integration.number != NumberType::float32 || integration.damping != DampingMode::increments;
    visitor.check(holds, table->has("number") ? "number" : "damping",
                  "float32 does not work with damping from increments: choose damping = \"velocity\" or number = \"float64\"");
  }
}

/// Sets all values that the parameters of a calibrated body decide to their defaults.
void forget_what_parameters_decide(Physics& physics) {
  for (VoxelMaterial& material : physics.materials) {
    material.youngs_modulus_Pa = VoxelMaterial{}.youngs_modulus_Pa;
    material.density_kg_m3 = VoxelMaterial{}.density_kg_m3;
  }
  physics.lateral_coupling = 0.0;
  physics.damping_ratios.bond = DampingRatios{}.bond;
  physics.beam_moments = BeamMoments::published;
  physics.actuation.amplitude = Actuation{}.amplitude;
  physics.integration.bond_damping = BondDamping::explicit_step;
  physics.stop_rotation_in_static_friction = false;
}

/// Sets all values of voxels to their defaults, but not the friction of the ground.
void forget_voxels(Physics& physics) {
  forget_what_parameters_decide(physics);
  physics.damping_ratios = {};
  physics.collisions = {};
  physics.integration = {};
  physics.limits = {};
}

}  // namespace

void describe(io::StudyVisitor& visitor, Physics& physics, const PhysicsUse& use) {
  const bool had_body = physics.surrogate.has_value();
  const bool brings_body = visitor.source() != nullptr && visitor.source()->has("surrogate");
  visitor.optional_table({"surrogate", "Hollow cells driven by pressure, instead of solid voxels driven by their size."},
                         physics.surrogate, [&](CalibratedBody& body) { describe(visitor, body); });
  const bool is_calibrated = physics.surrogate.has_value();
  const VoxelKeys keys{.are_voxels = use.has_voxels, .are_by_itself = use.has_voxels && !is_calibrated};
  if (visitor.source() != nullptr && is_calibrated) forget_what_parameters_decide(physics);
  if (visitor.source() != nullptr && !use.has_voxels) forget_voxels(physics);
  visitor.table({"loads", "Loads on all bodies."}, [&] {
    visitor.number({.name = "gravity_m_per_s2", .help = "Gravity, downwards.", .earlier = "/environment.gravity_m_s2"},
                   physics.gravity_m_s2, io::non_negative());
  });
  visitor.table({"ground", "Ground: a plane below the lowest voxels."}, [&] { describe_ground(visitor, physics, keys); });
  visitor.table({"materials", "Materials of the voxels."}, [&] { describe_materials(visitor, physics, keys, use.is_identity); });
  visitor.only_if(use.has_voxels, as_voxels, [&] {
    visitor.table({"damping", "Damping, as fractions of critical damping."}, [&] {
      visitor.only_if(!is_calibrated, by_itself, [&] {
        visitor.number({"bond", "Damping ratio of beams."}, physics.damping_ratios.bond, io::non_negative());
      });
      visitor.number({"collision", "Damping ratio of contacts with the ground and between voxels."},
                     physics.damping_ratios.collision, io::non_negative());
      visitor.number({"global", "Damping ratio of the motion of every voxel relative to the fixed surroundings."},
                     physics.damping_ratios.global, io::non_negative());
    });
  });
  visitor.table({.name = "drive", .help = "Drive of a body.", .earlier = "/actuation"}, [&] {
    describe_drive(visitor, physics.actuation, keys, brings_body || use.brings_pressure);
    const bool has_pressure = had_body || (use.pressure_Pa != nullptr && *use.pressure_Pa != std::array{0.0, 0.0});
    describe_pressure(visitor, physics.surrogate, use, brings_body || use.brings_pressure || !has_pressure);
  });
  visitor.only_if(use.has_voxels, as_voxels, [&] {
    visitor.table({"collisions", "Collisions between voxels."}, [&] {
      visitor.integer_or_word({"exclusion_depth", "Voxels that are at most this many beams apart never collide."},
                              physics.collisions.exclusion_depth, "off", io::at_least(1));
    });
    visitor.table({"integration", "Integration in time."},
                  [&] { describe_integration(visitor, physics.integration, is_calibrated); });
    visitor.table({"limits", "Limits beyond which a run has diverged."}, [&] {
      visitor.number({"speed_fraction", "Largest speed, as a fraction of the speed of the fastest wave."},
                     physics.limits.speed_fraction, io::positive());
      visitor.number({"strain", "Largest axial strain of beams."}, physics.limits.strain, io::positive());
    });
  });
}

Physics read_physics(const io::TomlTable& table, const Physics& defaults) {
  Physics physics = defaults;
  io::StudyReader reader(table);
  describe(reader, physics);
  return physics;
}

std::string physics_text(const Physics& physics) {
  Physics described = physics;
  io::StudyTextWriter writer;
  describe(writer, described, {.is_identity = true});
  return writer.text();
}

void check_friction(const io::TomlTable& table, const Physics& physics) {
  constexpr std::array<std::array<std::string_view, 2>, 2> keys{
      {{"materials.material_1.static_friction", "materials.material_1.kinetic_friction"},
       {"materials.material_2.static_friction", "materials.material_2.kinetic_friction"}}};
  for (std::size_t m = 0; m < physics.materials.size(); ++m) {
    const VoxelMaterial& material = physics.materials.at(m);
    if (material.static_friction >= material.kinetic_friction) continue;
    const std::string kinetic = "is less than kinetic_friction = " + io::number_text(material.kinetic_friction);
    const std::string still = "is more than static_friction = " + io::number_text(material.static_friction);
    if (has_key(table, keys.at(m)[0])) throw table.error(keys.at(m)[0], kinetic);
    if (has_key(table, keys.at(m)[1])) throw table.error(keys.at(m)[1], still);
    if (has_key(table, "ground.static_friction")) throw table.error("ground.static_friction", kinetic);
    throw table.error("ground.kinetic_friction", still);
  }
}

}  // namespace menger::voxel
