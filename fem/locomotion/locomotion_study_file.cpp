#include "fem/locomotion/locomotion_study_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/contact/rigid_ground_file.h"
#include "fem/contact/self_contact_surface.h"
#include "fem/locomotion/locomotion_drive.h"
#include "fem/pneumatics/pneumatic_supply_file.h"
#include "io/text/content_hash.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr int schema_version = 1;
constexpr double largest_record_count = 1e6;

/// Deepest fractal: 27 cells per side of a design of three.
constexpr int largest_level = 3;

enum class Method { explicit_dynamics, implicit_dynamics };

/// An optional table: the keys of one that is missing have their defaults.
io::TomlTable table_or_empty(const io::TomlTable& table, std::string_view key) {
  if (const auto found = table.optional_table(key)) return *found;
  return io::parse_toml("", table.file());
}

void read_design_table(const io::TomlTable& table, LocomotionStudy& study) {
  if (table.has("file")) {
    if (table.has("digits")) throw table.error("digits", "a design file beside it gives another body: keep one of them");
    const fs::path file = table.path("file");
    study.inputs[file.string()] = io::file_hash(file);
    study.design = meshes::read_design(file);
    study.design.cell_edge_m = table.number_or("cell_edge_m", study.design.cell_edge_m, io::positive());
  } else {
    study.design = meshes::read_drawn_design(table);
    study.design.cell_edge_m = table.number("cell_edge_m", io::positive());
  }
  study.hollow = meshes::read_hollow_body_options(table);
  if (study.hollow.level > largest_level) throw table.error("level", "must be at most " + std::to_string(largest_level));
  try {
    study.mesh = meshes::hollow_polycube(study.design, study.hollow).mesh;
  } catch (const io::InputError& error) {
    throw io::InputError(table.file().string() + ": [design]: " + error.what());
  } catch (const std::length_error& error) {
    throw io::InputError(table.file().string() + ": [design]: " + error.what());
  }
}

/// Where the body's lowest point is.
double lowest_m(const meshes::HexahedralMesh& mesh) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const meshes::Point& point : mesh.points) lowest = std::min(lowest, point[2]);
  return lowest;
}

void read_ground_table(const io::TomlTable& table, LocomotionStudy& study) {
  const double stiffness = ground_stiffness_Pa_per_m(study.material.bulk_modulus_Pa, shortest_edge_m(study.mesh));
  study.ground = read_rigid_ground(table, stiffness);
  const double lowest = lowest_m(study.mesh);
  if (!table.has("height_m")) study.ground.height_m = lowest;
  // Springs that are loaded at the start would throw the body up.
  if (study.ground.height_m > lowest)
    throw table.error("height_m", "is above the body's lowest point, which is at " + io::number_text(lowest));
}

/// Branches, too, are moved by explicit dynamics alone.
void refuse_branch(const io::TomlTable& top, const LocomotionStudy& study) {
  if (study.implicit && study.material.damping_model == DampingModel::maxwell)
    throw top.table("material").error("damping_model", "dynamics.method = \"implicit\" has \"kelvin_voigt\" alone");
}

/// Air through lines is moved by explicit dynamics alone.
void refuse_lines(const io::TomlTable& top, const LocomotionStudy& study) {
  if (!study.implicit || !study.supply->has_lines()) return;
  for (const io::TomlTable& table : top.tables("pressure")) {
    if (table.text_or("supply", "schedule") != "schedule")
      throw table.error("supply", "dynamics.method = \"implicit\" has no lines: prescribe the pressure, or use \"explicit\"");
  }
}

/// Either the surrogate's drive or what the study says of each plenum.
void read_pressures(const io::TomlTable& top, LocomotionStudy& study) {
  const auto drive = top.optional_table("drive");
  if (drive) {
    for (const char* other : {"pressure", "piston", "gas"})
      if (top.has(other)) throw top.error(other, "a table [drive] beside it drives all plena: keep one of them");
    const std::vector<PlenumSchedule> schedules = read_surrogate_drive(*drive, study.design, study.hollow, study.mesh);
    study.supply.emplace(std::vector<PlenumSupply>(schedules.begin(), schedules.end()));
    return;
  }
  if (!top.has("pressure")) throw io::InputError(top.file().string() + ": a table [drive] or [[pressure]] is missing");
  study.supply = read_pneumatic_supply(top, study.mesh.plenum_names);
  for (const io::TomlTable& table : top.tables("pressure")) {
    if (!table.has("file")) continue;
    const fs::path file = table.path("file");
    study.inputs[file.string()] = io::file_hash(file);
  }
}

void read_time(const io::TomlTable& table, LocomotionStudy& study) {
  study.duration_s = table.number("duration_s", io::positive());
  study.record_interval_s = table.number_or("record_interval_s", std::min(study.record_interval_s, study.duration_s),
                                            {.lowest = 0.0, .highest = study.duration_s, .lowest_excluded = true});
  if (study.duration_s / study.record_interval_s > largest_record_count)
    throw table.error(table.has("record_interval_s") ? "record_interval_s" : "duration_s", "makes more than a million records");
}

/// Refuses what implicit dynamics has not, rather than leave it out.
void read_implicit(const io::TomlTable& table, LocomotionStudy& study) {
  for (const char* key : {"step_safety", "self_contact_stiffness_Pa_per_m", "threads"})
    if (table.has(key)) throw table.error(key, "belongs to method = \"explicit\"");
  if (table.boolean_or("self_contact", false)) throw table.error("self_contact", "method = \"implicit\" has none");
  study.self_contact.reset();
  LocomotionImplicit implicit;
  implicit.degree = table.integer_or("degree", implicit.degree, io::within(1, 2));
  implicit.tolerance = table.number_or("tolerance", implicit.tolerance, io::positive());
  implicit.stick_stiffness = table.number_or("stick_stiffness", implicit.stick_stiffness, io::positive());
  study.implicit = implicit;
  study.notes.push_back(
      "dynamics: without self-contact: walls that touch end the run, and so do other parts that go through each other");
}

/// As on the ground where nothing else is stated.
SurfaceFriction read_self_friction(const io::TomlTable& table, const Friction& ground) {
  SurfaceFriction friction;
  friction.kinetic_coefficient =
      table.number_or("self_contact_kinetic_coefficient", ground.kinetic_coefficient, io::non_negative());
  friction.static_coefficient =
      table.number_or("self_contact_static_coefficient", std::max(ground.static_coefficient, friction.kinetic_coefficient),
                      io::at_least(friction.kinetic_coefficient));
  return friction;
}

Method read_method(const io::TomlTable& table) {
  return table.word_or<Method>("method", Method::explicit_dynamics,
                               {{"explicit", Method::explicit_dynamics}, {"implicit", Method::implicit_dynamics}});
}

void read_dynamics(const io::TomlTable& table, Method method, LocomotionStudy& study) {
  study.largest_step_s = table.optional_number("largest_step_s", io::positive());
  if (method == Method::implicit_dynamics) {
    read_implicit(table, study);
    return;
  }
  for (const char* key : {"degree", "tolerance", "stick_stiffness"})
    if (table.has(key)) throw table.error(key, "belongs to method = \"implicit\"");
  study.step_safety = table.number_or("step_safety", study.step_safety, {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true});
  const auto contact_stiffness = table.optional_number("self_contact_stiffness_Pa_per_m", io::positive());
  study.self_contact = SelfContactLaw{contact_stiffness, read_self_friction(table, study.ground.friction)};
  if (!table.boolean_or("self_contact", true)) {
    for (const char* key :
         {"self_contact_stiffness_Pa_per_m", "self_contact_static_coefficient", "self_contact_kinetic_coefficient"})
      if (table.has(key)) throw table.error(key, "has no use with self_contact = false");
    study.self_contact.reset();
  }
  study.threads = table.integer_or("threads", study.threads, io::within(1, 1024));
}

LocomotionSweep read_sweep(const io::TomlTable& table) {
  LocomotionSweep sweep{.keys = table.texts("keys"), .values = {}};
  if (sweep.keys.empty()) throw table.error("keys", "must name a number of the study at least");
  const std::vector<double> values = table.numbers("values");
  if (values.empty()) throw table.error("values", "must hold a value at least");
  for (const double value : values) sweep.values.emplace_back(sweep.keys.size(), value);
  return sweep;
}

}  // namespace

LocomotionStudy read_locomotion_study(const fs::path& file) { return parse_locomotion_study(io::read_whole(file), file); }

LocomotionStudy parse_locomotion_study(std::string_view text, const fs::path& file) {
  const io::TomlTable top = io::parse_toml(text, file);
  LocomotionStudy study;
  study.file = file;
  study.text = text;
  study.inputs[file.string()] = io::content_hash(text);
  (void)top.integer_or("schema_version", schema_version, io::within(schema_version, schema_version));
  read_design_table(top.table("design"), study);
  const auto read_input = [&](const fs::path& input) { study.inputs[input.string()] = io::file_hash(input); };
  const io::TomlTable dynamics = table_or_empty(top, "dynamics");
  const Method method = read_method(dynamics);
  const DampingModel damping = method == Method::implicit_dynamics ? DampingModel::kelvin_voigt : DampingModel::maxwell;
  study.material = read_locomotion_material(top.table("material"), damping, read_input, study.notes);
  read_ground_table(top.table("ground"), study);
  const io::TomlTable loads = table_or_empty(top, "loads");
  study.gravity_m_per_s2 = loads.number_or("gravity_m_per_s2", study.gravity_m_per_s2, io::non_negative());
  study.mass_damping_per_s = loads.number_or("mass_damping_per_s", study.mass_damping_per_s, io::non_negative());
  read_pressures(top, study);
  read_time(top.table("time"), study);
  read_dynamics(dynamics, method, study);
  refuse_branch(top, study);
  refuse_lines(top, study);
  const io::TomlTable output = table_or_empty(top, "output");
  study.output.frames = output.boolean_or("frames", study.output.frames);
  study.output.pictures = output.boolean_or("pictures", study.output.pictures);
  study.output.records_per_frame = output.integer_or("records_per_frame", study.output.records_per_frame, io::at_least(1));
  if (const auto sweep = top.optional_table("sweep")) study.sweep = read_sweep(*sweep);
  top.finish();
  return study;
}

}  // namespace menger::fem
