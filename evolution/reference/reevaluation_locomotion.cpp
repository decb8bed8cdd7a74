#include "evolution/reference/reevaluation_locomotion.h"

#include <array>
#include <cmath>
#include <utility>

#include "evolution/reference/reevaluation_surrogate.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::evolution {
namespace {

std::string line(std::string key, const std::string& value) { return std::move(key) + " = " + value + "\n"; }
std::string number(std::string key, double value) { return line(std::move(key), io::number_text(value)); }
std::string pair(std::string key, const std::array<double, 2>& values) {
  return line(std::move(key), "[" + io::number_text(values[0]) + ", " + io::number_text(values[1]) + "]");
}

std::string material_text(const LocomotionOptions& options) {
  std::string text = "[material]\nrecord = \"silicone.toml\"\n" + number("bulk_modulus_ratio", options.bulk_modulus_ratio);
  if (options.youngs_modulus_Pa) text += number("youngs_modulus_Pa", *options.youngs_modulus_Pa);
  return text + line("damping_model", io::toml_quoted(options.damping_model));
}

std::string ground_text(const voxel::VoxelMaterial& material) {
  return "[ground]\n" + number("static_coefficient", material.static_friction) +
         number("kinetic_coefficient", material.kinetic_friction);
}

/// The drive of the search; what its mode does not use is left out.
std::string drive_text(const voxel::Physics& physics) {
  const voxel::Actuation& drive = physics.actuation;
  std::string text = "[drive]\n" + pair("pressure_Pa", physics.surrogate->pressure_Pa) +
                     line("mode", io::toml_quoted(voxel::to_string(drive.mode)));
  if (drive.mode == voxel::ActuationMode::none) return text;
  text += number("period_s", drive.period_s) + number("ramp_s", drive.ramp_s);
  if (drive.mode == voxel::ActuationMode::antiphase) text += pair("material_phase", drive.material_phase);
  if (drive.mode == voxel::ActuationMode::wave) {
    constexpr std::array axes{"x", "y", "z"};
    text += line("wave_axis", io::toml_quoted(axes.at(static_cast<std::size_t>(drive.wave_axis)))) +
            number("wave_periods_per_body", drive.wave_periods_per_body) +
            line("wave_over_gaps", drive.wave_over_gaps ? "true" : "false");
  }
  return text;
}

}  // namespace

std::string locomotion_text(const ReevaluationStudy& study, const LocomotionOptions& options, bool with_frames) {
  const voxel::Physics& physics = study.search.physics;
  std::string text = "[design]\nfile = \"design.toml\"\n";
  text += meshes::hollow_body_text(casting_of(study, options.elements_through_wall));
  text += material_text(options) + ground_text(physics.materials[0]);
  text += "[loads]\n" + number("gravity_m_per_s2", physics.gravity_m_s2);
  text += drive_text(physics);
  text += "[time]\n" + number("duration_s", study.duration_s) + number("record_interval_s", study.record_interval_s);
  text += "[dynamics]\nmethod = \"explicit\"\n" + number("step_safety", options.step_safety) +
          line("threads", std::to_string(options.threads));
  const auto per_frame = std::lround(study.frame_interval_s / study.record_interval_s);
  text += "[output]\n" + line("frames", with_frames ? "true" : "false") + "pictures = false\n";
  if (with_frames) text += line("records_per_frame", std::to_string(per_frame));
  return text;
}

std::string protocol_text(const ReevaluationStudy& study, const LocomotionOptions& options) {
  LocomotionOptions shown = options;
  shown.threads = 1;  // results are the same for any number
  std::string text = locomotion_text(study, shown, false);
  if (study.measure_from_s > 0.0) text += "# measured\n" + number("measure_from_s", study.measure_from_s);
  text += "# a body that has gone through itself has not completed\n";
  return text + "# silicone.toml\n" + io::read_whole(study.silicone_file);
}

LocomotionJob locomotion_job(const ReevaluationStudy& study, const LocomotionOptions& options, const meshes::Polycube& body,
                             const std::string& name, bool with_frames) {
  return {.name = name,
          .study = locomotion_text(study, options, with_frames),
          .design = meshes::design_text(design_of(study, body)),
          .silicone = io::read_whole(study.silicone_file)};
}

}  // namespace menger::evolution
