#include "evolution/reference/reevaluation_locomotion.h"

#include <cmath>
#include <cstddef>
#include <string_view>

#include "evolution/reference/reevaluation_surrogate.h"
#include "evolution/study/walk_evaluator.h"
#include "io/text/toml_text.h"
#include "materials/laws/study_law.h"
#include "meshes/design/kept_geometry.h"

namespace menger::evolution {
namespace {

fem::WalkSilicone silicone_of(const ReevaluationStudy& study, const LocomotionOptions& options) {
  fem::WalkSilicone silicone;
  if (uses_elements(study.search))
    silicone = study.search.silicone.silicone;
  else
    silicone.law = materials::recommended_law(study.silicone_file);
  silicone.youngs_modulus_Pa = options.youngs_modulus_Pa;
  silicone.bulk_modulus_ratio = options.bulk_modulus_ratio;
  silicone.damping_model = options.damping_model;
  state_what_the_record_has(silicone);
  return silicone;
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
  walk.drive = pressure_drive(study.search);
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
  if (const auto last = measured_periods(study.search)) text.comment("measured").add("measure_periods", last->count);
  text.comment("a body that has gone through itself has not completed");
  // Thin walls were refused where partitions have another place than before.
  const std::string_view geometry = meshes::kept_geometry(module_of(study.search).chambers);
  if (options.elements.kind == fem::ElementKind::three_field && !geometry.empty()) text.comment(geometry);
  return text.text();
}

LocomotionJob locomotion_job(const ReevaluationStudy& study, const LocomotionOptions& options, const meshes::Polycube& body,
                             const std::string& name, bool with_frames) {
  return {.name = name, .study = locomotion_study(study, options, body, with_frames)};
}

}  // namespace menger::evolution
