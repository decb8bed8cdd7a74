#include "fem/locomotion/locomotion_study.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <variant>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::fem {
namespace {

/// Lines "key = value" of tables.
class SettingsText {
 public:
  void table(std::string_view name) { text_.append(text_.empty() ? "[" : "\n[").append(name).append("]\n"); }
  void number(std::string_view key, double value) { text_.append(key).append(" = ").append(io::number_text(value)).append("\n"); }
  void word(std::string_view key, std::string_view value) {
    text_.append(key).append(" = ").append(io::toml_quoted(value)).append("\n");
  }
  void numbers(std::string_view key, const std::vector<double>& values) {
    std::string list;
    for (const double value : values) list.append(list.empty() ? "" : ", ").append(io::number_text(value));
    text_.append(key).append(" = [").append(list).append("]\n");
  }
  void lines(std::string_view text) { text_.append(text); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void add_schedule(SettingsText& text, const ConstantPressure& schedule) {
  text.word("schedule", "constant");
  text.number("pressure_Pa", schedule.pressure_Pa);
}

void add_schedule(SettingsText& text, const SinePressure& schedule) {
  text.word("schedule", "sine");
  text.number("low_Pa", schedule.low_Pa);
  text.number("high_Pa", schedule.high_Pa);
  text.number("frequency_Hz", schedule.frequency_Hz);
  text.number("phase", schedule.phase);
}

void add_schedule(SettingsText& text, const SquarePressure& schedule) {
  text.word("schedule", "square");
  text.number("low_Pa", schedule.low_Pa);
  text.number("high_Pa", schedule.high_Pa);
  text.number("frequency_Hz", schedule.frequency_Hz);
  text.number("phase", schedule.phase);
  text.number("duty", schedule.duty);
  text.number("rise_s", schedule.rise_s);
}

/// The points themselves and not the name of their file: they decide.
void add_schedule(SettingsText& text, const PressureTable& schedule) {
  text.word("schedule", "table");
  text.numbers("times_s", schedule.times_s);
  text.numbers("pressures_Pa", schedule.pressures_Pa);
}

void add_schedule(SettingsText& text, const PlenumSchedule& schedule) {
  std::visit([&](const auto& kind) { add_schedule(text, kind); }, schedule.schedule);
  text.number("ramp_s", schedule.ramp_s);
}

void add_line(SettingsText& text, const PneumaticLine& line) {
  text.number("resistance_Pa_s_per_m3", line.resistance_Pa_s_per_m3);
  text.number("volume_m3", line.volume_m3);
  if (!line.bore) return;
  text.number("diameter_m", line.bore->diameter_m);
  text.number("viscosity_Pa_s", line.bore->viscosity_Pa_s);
}

void add_plenum(SettingsText& text, const PneumaticSupply& supply, std::size_t plenum) {
  const PlenumSupply& drive = supply.plena()[plenum];
  if (const auto* schedule = std::get_if<PlenumSchedule>(&drive)) {
    text.word("supply", "schedule");
    add_schedule(text, *schedule);
  } else if (const auto* source = std::get_if<LineSupply>(&drive)) {
    text.word("supply", "line");
    add_schedule(text, source->source);
    add_line(text, source->line);
  } else {
    const auto& piston = std::get<PistonSupply>(drive);
    text.word("supply", "piston");
    text.word("piston", supply.pistons()[piston.piston].name);
    add_line(text, piston.line);
  }
}

void add_supply(SettingsText& text, const PneumaticSupply& supply, const std::vector<std::string>& plenum_names) {
  for (std::size_t p = 0; p < plenum_names.size(); ++p) {
    text.table("[pressure]");
    text.word("plenum", plenum_names[p]);
    add_plenum(text, supply, p);
  }
  for (const Piston& piston : supply.pistons()) {
    text.table("[piston]");
    text.word("name", piston.name);
    text.number("bore_m", piston.bore_m);
    text.number("cylinder_length_m", piston.cylinder_length_m);
    text.number("stroke_m", piston.stroke_m);
    text.number("dead_volume_m3", piston.dead_volume_m3);
    text.number("frequency_Hz", piston.frequency_Hz);
    text.number("phase", piston.phase);
    text.number("ramp_s", piston.ramp_s);
    text.number("fill_pressure_Pa", piston.fill_pressure_Pa);
  }
  if (!supply.has_lines()) return;
  text.table("gas");
  text.number("exponent", supply.gas().exponent);
  text.number("ambient_pressure_Pa", supply.gas().ambient_pressure_Pa);
}

void add_material(SettingsText& text, const LocomotionMaterial& material) {
  text.table("material");
  text.word("name", material.name);
  text.number("density_kg_per_m3", material.density_kg_per_m3);
  text.number("bulk_modulus_Pa", material.bulk_modulus_Pa);
  text.word("volumetric", "simo_taylor");
  if (material.damping_model == DampingModel::maxwell) {
    text.word("damping_model", "maxwell");
    text.number("branch_modulus_Pa", material.branch.shear_modulus_Pa);
    text.number("relaxation_time_s", material.branch.relaxation_time_s);
  } else {
    text.word("damping_model", "kelvin_voigt");
    text.number("viscosity_Pa_s", material.viscosity_Pa_s);
  }
  text.word("loss_source", material.loss.source);
  text.number("loss_factor", material.loss.tan_delta);
  text.number("loss_frequency_Hz", material.loss.frequency_Hz);
  text.table("material.law");
  text.lines(materials::law_text(material.law));
}

void add_ground(SettingsText& text, const RigidGround& ground) {
  text.table("ground");
  text.number("height_m", ground.height_m);
  text.number("stiffness_Pa_per_m", ground.stiffness_Pa_per_m);
  text.number("static_coefficient", ground.friction.static_coefficient);
  text.number("kinetic_coefficient", ground.friction.kinetic_coefficient);
  text.number("regularisation_speed_m_per_s", ground.friction.regularisation_speed_m_per_s);
  if (const auto& directional = ground.friction.directional) {
    text.table("ground.directional");
    text.numbers("forward", {directional->forward[0], directional->forward[1]});
    text.number("backward_factor", directional->backward_factor);
    text.number("sideways_factor", directional->sideways_factor);
  }
}

void add_dynamics(SettingsText& text, const LocomotionStudy& study) {
  text.table("dynamics");
  text.word("method", study.implicit ? "implicit" : "explicit");
  if (study.implicit) {
    text.number("degree", study.implicit->degree);
    text.number("tolerance", study.implicit->tolerance);
    text.number("stick_stiffness", study.implicit->stick_stiffness);
  } else {
    text.number("step_safety", study.step_safety);
  }
  if (study.largest_step_s) text.number("largest_step_s", *study.largest_step_s);
  if (study.implicit) return;
  text.lines(std::string("self_contact = ") + (study.self_contact ? "true" : "false") + "\n");
  if (study.self_contact && study.self_contact->stiffness_Pa_per_m)
    text.number("self_contact_stiffness_Pa_per_m", *study.self_contact->stiffness_Pa_per_m);
  if (study.self_contact && study.self_contact->friction) {
    text.number("self_contact_static_coefficient", study.self_contact->friction->static_coefficient);
    text.number("self_contact_kinetic_coefficient", study.self_contact->friction->kinetic_coefficient);
  }
}

}  // namespace

double body_length_m(const meshes::Design& design, int level) {
  const int cells = std::max({design.body.nx(), design.body.ny(), design.body.nz()});
  double length = design.cell_edge_m;
  for (int i = 0; i < level; ++i) length *= cells;
  return length;
}

std::string locomotion_text(const LocomotionStudy& study) {
  SettingsText text;
  text.table("design");
  text.lines(meshes::design_text(study.design));
  text.lines(meshes::hollow_body_text(study.hollow));
  add_material(text, study.material);
  add_ground(text, study.ground);
  text.table("loads");
  text.number("gravity_m_per_s2", study.gravity_m_per_s2);
  text.number("mass_damping_per_s", study.mass_damping_per_s);
  add_supply(text, *study.supply, study.mesh.plenum_names);
  text.table("time");
  text.number("duration_s", study.duration_s);
  text.number("record_interval_s", study.record_interval_s);
  add_dynamics(text, study);
  text.table("output");
  text.lines(std::string("frames = ") + (study.output.frames ? "true" : "false") + "\n");
  text.number("records_per_frame", static_cast<double>(study.output.records_per_frame));
  return text.text();
}

ExplicitBodyOptions body_options(const LocomotionStudy& study) {
  ExplicitBodyOptions options;
  const LocomotionMaterial& material = study.material;
  const ExplicitMaterial elements{material.law, materials::SimoTaylorVolume{material.bulk_modulus_Pa}, material.viscosity_Pa_s,
                                  material.branch};
  options.regions.assign(study.mesh.region_names.size(), {elements, material.density_kg_per_m3});
  return options;
}

ExplicitOptions dynamics_options(const LocomotionStudy& study) {
  ExplicitOptions options;
  options.loads.gravity_m_per_s2 = {0.0, 0.0, -study.gravity_m_per_s2};
  options.loads.mass_damping_per_s = study.mass_damping_per_s;
  options.loads.ground = study.ground;
  options.supply = study.supply;
  options.step_safety = study.step_safety;
  options.largest_step_s = study.largest_step_s;
  options.self_contact = study.self_contact;
  options.threads = study.threads;
  return options;
}

std::vector<double> record_times_s(const LocomotionStudy& study) {
  // The last record lies at the duration itself, which need not be a multiple of the interval.
  const auto intervals = static_cast<std::uint64_t>(std::ceil(study.duration_s / study.record_interval_s * (1.0 - 1e-12)));
  std::vector<double> times;
  for (std::uint64_t i = 1; i < intervals; ++i) times.push_back(static_cast<double>(i) * study.record_interval_s);
  times.push_back(study.duration_s);
  return times;
}

}  // namespace menger::fem
