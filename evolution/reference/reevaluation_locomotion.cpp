#include "evolution/reference/reevaluation_locomotion.h"

#include <array>
#include <cmath>

#include "evolution/reference/reevaluation_surrogate.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::evolution {
namespace {

void add_material(io::TomlText& text, const LocomotionOptions& options) {
  text.table("material").add("silicone", "silicone.toml").add("bulk_modulus_ratio", options.bulk_modulus_ratio);
  if (options.youngs_modulus_Pa) text.add("youngs_modulus_Pa", *options.youngs_modulus_Pa);
  text.add("damping_model", options.damping_model);
}

void add_ground(io::TomlText& text, const voxel::VoxelMaterial& material) {
  text.table("ground").add("static_friction", material.static_friction).add("kinetic_friction", material.kinetic_friction);
}

/// The drive of the search; what its mode does not use is left out.
void add_drive(io::TomlText& text, const voxel::Physics& physics) {
  const voxel::Actuation& drive = physics.actuation;
  text.table("drive").add("pressure_Pa", physics.surrogate->pressure_Pa).add("mode", voxel::to_string(drive.mode));
  if (drive.mode == voxel::ActuationMode::none) return;
  text.add("frequency_Hz", drive.frequency_Hz).add("ramp_s", drive.ramp_s);
  if (drive.mode == voxel::ActuationMode::antiphase) text.add("material_phase", drive.material_phase);
  if (drive.mode == voxel::ActuationMode::wave) {
    constexpr std::array axes{"x", "y", "z"};
    text.add("wave_axis", axes.at(static_cast<std::size_t>(drive.wave_axis)))
        .add("wave_periods_per_body", drive.wave_periods_per_body)
        .add("wave_over_gaps", drive.wave_over_gaps);
  }
}

}  // namespace

std::string locomotion_text(const ReevaluationStudy& study, const LocomotionOptions& options, bool with_frames) {
  const voxel::Physics& physics = study.search.physics;
  io::TomlText text;
  text.table("design").add("file", "design.toml");
  text.lines(meshes::hollow_body_text(casting_of(study, options.elements_through_wall), "design"));
  add_material(text, options);
  add_ground(text, physics.materials[0]);
  text.table("loads").add("gravity_m_per_s2", physics.gravity_m_s2);
  add_drive(text, physics);
  text.table("time").add("duration_s", study.duration_s).add("record_interval_s", study.record_interval_s);
  text.table("dynamics").add("method", "explicit").add("step_safety", options.step_safety).add("threads", options.threads);
  text.table("output").add("frames", with_frames).add("pictures", false);
  if (with_frames) text.add("records_per_frame", std::lround(study.frame_interval_s / study.record_interval_s));
  return text.text();
}

std::string protocol_text(const ReevaluationStudy& study, const LocomotionOptions& options) {
  LocomotionOptions shown = options;
  shown.threads = 1;  // results are the same for any number
  io::TomlText text;
  text.lines(locomotion_text(study, shown, false));
  if (study.measure_from_s > 0.0) text.comment("measured").add("measure_from_s", study.measure_from_s);
  text.comment("a body that has gone through itself has not completed").comment("silicone.toml");
  return text.text() + io::read_whole(study.silicone_file);
}

LocomotionJob locomotion_job(const ReevaluationStudy& study, const LocomotionOptions& options, const meshes::Polycube& body,
                             const std::string& name, bool with_frames) {
  return {.name = name,
          .study = locomotion_text(study, options, with_frames),
          .design = meshes::design_text(design_of(study, body)),
          .silicone = io::read_whole(study.silicone_file)};
}

}  // namespace menger::evolution
