#include "evolution/reference/reevaluation_locomotion.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "evolution/reference/reevaluation_surrogate.h"
#include "io/text/toml_text.h"
#include "materials/laws/study_law.h"

namespace menger::evolution {
namespace {

fem::DriveMode drive_mode(voxel::ActuationMode mode) {
  switch (mode) {
    case voxel::ActuationMode::none:
      return fem::DriveMode::none;
    case voxel::ActuationMode::in_phase:
      return fem::DriveMode::in_phase;
    case voxel::ActuationMode::antiphase:
      return fem::DriveMode::antiphase;
    case voxel::ActuationMode::wave:
      return fem::DriveMode::wave;
    case voxel::ActuationMode::hold:
      return fem::DriveMode::hold;
  }
  assert(false && "a mode without a name in fem");
  return fem::DriveMode::none;
}

fem::WalkSilicone silicone_of(const ReevaluationStudy& study, const LocomotionOptions& options) {
  fem::WalkSilicone silicone;
  silicone.law = materials::recommended_law(study.silicone_file);
  silicone.youngs_modulus_Pa = options.youngs_modulus_Pa;
  silicone.bulk_modulus_ratio = options.bulk_modulus_ratio;
  silicone.damping_model = options.damping_model;
  std::vector<std::string> notes;
  (void)fem::material_of(silicone, options.damping_model, notes);  // states density and loss, which the record has
  return silicone;
}

fem::SurrogateDrive drive_of(const voxel::Physics& physics) {
  const voxel::Actuation& drive = physics.actuation;
  return {.mode = drive_mode(drive.mode),
          .pressure_Pa = physics.surrogate->pressure_Pa,
          .frequency_Hz = drive.frequency_Hz,
          .ramp_s = drive.ramp_s,
          .material_phase = drive.material_phase,
          .wave_axis = drive.wave_axis,
          .wave_periods_per_body = drive.wave_periods_per_body,
          .wave_over_gaps = drive.wave_over_gaps};
}

}  // namespace

fem::LocomotionStudy locomotion_study(const ReevaluationStudy& study, const LocomotionOptions& options,
                                      const meshes::Polycube& body, bool with_frames) {
  const voxel::Physics& physics = study.search.physics;
  const voxel::VoxelMaterial& material = physics.materials[0];
  fem::LocomotionStudy walk;
  walk.design = design_of(study, body);
  walk.hollow = casting_of(study, options);
  walk.elements = options.elements;
  walk.silicone = silicone_of(study, options);
  walk.stated_ground.friction = {.static_coefficient = options.friction_factor * material.static_friction,
                                 .kinetic_coefficient = options.friction_factor * material.kinetic_friction};
  walk.gravity_m_per_s2 = physics.gravity_m_s2;
  walk.drive = drive_of(physics);
  for (double& pressure_Pa : walk.drive->pressure_Pa) pressure_Pa *= options.pressure_factor;
  walk.duration_s = study.duration_s;
  walk.record_interval_s = study.record_interval_s;
  walk.step_safety = options.step_safety;
  walk.threads = options.threads;
  walk.output.frames = with_frames;
  walk.output.pictures = false;
  if (with_frames)
    walk.output.records_per_frame = static_cast<std::size_t>(std::lround(study.frame_interval_s / study.record_interval_s));
  return walk;
}

std::string protocol_text(const ReevaluationStudy& study, const LocomotionOptions& options) {
  const meshes::Polycube any_body = meshes::Polycube::from_digits(1, 1, 1, "1");
  io::TomlText text;
  text.lines(fem::locomotion_text(locomotion_study(study, options, any_body, false)));
  if (study.measure_from_s > 0.0) text.comment("measured").add("measure_from_s", study.measure_from_s);
  text.comment("a body that has gone through itself has not completed");
  return text.text();
}

LocomotionJob locomotion_job(const ReevaluationStudy& study, const LocomotionOptions& options, const meshes::Polycube& body,
                             const std::string& name, bool with_frames) {
  return {.name = name, .study = locomotion_study(study, options, body, with_frames)};
}

}  // namespace menger::evolution
