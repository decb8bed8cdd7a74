#include "fem/locomotion/locomotion_study_file.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fem/locomotion/locomotion_drive.h"
#include "fem/walk/walk_input_error.h"
#include "fem/walk/walk_silicone_file.h"
#include "io/study/study_reader.h"
#include "io/text/content_hash.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr int schema_version = 2;
constexpr double largest_record_count = 1e6;

/// The highest level: 27 cells per side for a design of three.
constexpr int largest_level = 3;

enum class Method { explicit_dynamics, implicit_dynamics };

void describe_version(io::StudyVisitor& visitor) {
  int version = schema_version;
  visitor.integer({"schema_version", "Version of these keys."}, version);
  visitor.check(version != 1, "schema_version",
                "some keys have new names since version 1, but none of this file: remove this line, or write " +
                    std::to_string(schema_version));
  visitor.check(version == 1 || version == schema_version, "schema_version", "must be " + std::to_string(schema_version));
}

void describe_body(io::StudyVisitor& visitor, LocomotionStudy& study) {
  std::optional<fs::path> file;
  meshes::describe_design(visitor, study.design, file);
  if (file) io::note_input(study.inputs, *file);
  describe(visitor, study.hollow, study.elements.kind == ElementKind::three_field);
  visitor.check(study.hollow.level <= largest_level, "level", "must be at most " + std::to_string(largest_level));
}

/// Describes the elements. They come before the body, whose keys depend on them; so it is looked up whether dynamics, which come
/// last, are implicit.
void describe_elements(io::StudyVisitor& visitor, LocomotionStudy& study) {
  const io::TomlTable* top = visitor.source();
  bool is_implicit = study.implicit.has_value();
  if (top != nullptr && top->has("dynamics")) {
    const io::TomlTable dynamics = top->table("dynamics");
    is_implicit = dynamics.has("method") && dynamics.is_text("method") && dynamics.text("method") == "implicit";
  }
  if (top != nullptr && is_implicit) study.elements.kind = ElementKind::three_field;
  visitor.table(
      {"elements", "The finite elements of the body. Implicit dynamics has only three_field, which is then the default."}, [&] {
        describe(visitor, study.elements, true);
        int degree = study.implicit.value_or(LocomotionImplicit{}).degree;
        visitor.only_if(is_implicit, "dynamics.method = \"implicit\"", [&] {
          visitor.integer(
              {.name = "degree", .help = "Degree of the displacements: 1 is Q1/P0, 2 is Q2/P1.", .earlier = "/dynamics.degree"},
              degree, io::within(1, 2));
        });
        if (is_implicit) study.implicit = study.implicit.value_or(LocomotionImplicit{});
        if (study.implicit) study.implicit->degree = degree;
        visitor.check(!is_implicit || study.elements.kind == ElementKind::three_field, "kind",
                      "dynamics.method = \"implicit\" has only \"three_field\"");
      });
}

void describe_silicone(io::StudyVisitor& visitor, LocomotionStudy& study) {
  describe(visitor, study.silicone);
  if (visitor.source() != nullptr && study.silicone.law.record) io::note_input(study.inputs, study.silicone.law.file);
}

/// Describes the pressures: either the surrogate's drive, or a schedule or supply of each plenum.
void describe_pressures(io::StudyVisitor& visitor, LocomotionStudy& study) {
  const auto choose_drive = [&] {
    if (!study.drive) study.drive.emplace();
  };
  const auto describe_drive = [&] {
    for (const char* other : {"piston", "gas"}) {
      const bool has_other = visitor.source() != nullptr && visitor.source()->has(other);
      visitor.check(!has_other, other, "the table [drive] already drives all plena: keep one of them");
    }
    visitor.table({"drive", "Pressure in all chambers, as in the surrogate."}, [&] { describe(visitor, *study.drive); });
  };
  const auto describe_supply = [&] {
    describe(visitor, study.stated_supply);
    if (visitor.source() == nullptr) return;
    for (const StudyPlenum& plenum : study.stated_supply.plena) {
      if (plenum.file) io::note_input(study.inputs, *plenum.file);
    }
  };
  const bool has_plena = !study.drive && !study.stated_supply.plena.empty();
  visitor.one_of({{"drive", study.drive.has_value(), choose_drive, describe_drive},
                  {"pressure", has_plena, [&] { study.drive.reset(); }, describe_supply}},
                 "give a table [drive] or [[pressure]]");
}

void describe_time(io::StudyVisitor& visitor, LocomotionStudy& study) {
  visitor.number({"duration_s", "Simulated time.", "0.1"}, study.duration_s, io::positive());
  study.record_interval_s = std::min(study.record_interval_s, study.duration_s);
  visitor.number({"record_interval_s", "Time between the lines of trajectory.csv, at most the duration."},
                 study.record_interval_s, {.lowest = 0.0, .highest = study.duration_s, .lowest_excluded = true});
  const bool has_interval = visitor.source() != nullptr && visitor.source()->has("record_interval_s");
  visitor.check(study.duration_s / study.record_interval_s <= largest_record_count,
                has_interval ? "record_interval_s" : "duration_s", "makes more than a million records");
}

void describe_implicit(io::StudyVisitor& visitor, LocomotionImplicit& implicit) {
  visitor.number({"tolerance", "Largest error of a step: its root mean square divided by the diameter of the body."},
                 implicit.tolerance, io::positive());
  visitor.number(
      {"stick_stiffness", "Stiffness of the springs of points that stick, divided by that of the springs against depth."},
      implicit.stick_stiffness, io::positive());
}

/// Describes the friction of self-contact. It is that of the ground if nothing else is stated.
void describe_self_friction(io::StudyVisitor& visitor, const Friction& ground, SelfContactLaw& law) {
  std::optional<double> kinetic;
  std::optional<double> statical;
  if (law.friction) kinetic = law.friction->kinetic_coefficient;
  if (law.friction) statical = law.friction->static_coefficient;
  visitor.optional_number({.name = "self_contact_kinetic_friction",
                           .help = "Coefficient of friction of walls that slide on each other. If not given: that of the ground.",
                           .example = "0.5",
                           .earlier = "self_contact_kinetic_coefficient"},
                          kinetic, io::non_negative());
  const double sliding = kinetic.value_or(ground.kinetic_coefficient);
  visitor.optional_number({.name = "self_contact_static_friction",
                           .help = "Coefficient of friction of walls that are at rest on each other, at least the kinetic one. "
                                   "If not given: that of the ground, or the kinetic one if that is larger.",
                           .example = "1",
                           .earlier = "self_contact_static_coefficient"},
                          statical, io::at_least(sliding));
  law.friction.reset();
  if (kinetic || statical)
    law.friction = {.static_coefficient = statical.value_or(std::max(ground.static_coefficient, sliding)),
                    .kinetic_coefficient = sliding};
}

void describe_explicit(io::StudyVisitor& visitor, LocomotionStudy& study) {
  visitor.number({"step_safety", "Time step divided by the largest stable time step."}, study.step_safety,
                 {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true});
  visitor.integer({"threads", "Threads; results do not depend on them."}, study.threads, io::within(1, 1024));
  bool has_contact = study.self_contact.has_value();
  visitor.boolean({"self_contact", "Whether walls may touch each other. false: the run ends when walls touch."}, has_contact);
  SelfContactLaw law = study.self_contact.value_or(SelfContactLaw{});
  visitor.only_if(has_contact, "self_contact = true", [&] {
    visitor.optional_number({"self_contact_stiffness_Pa_per_m",
                             "Pressure of walls that touch, divided by depth. If not given: a fraction of the stiffness of an "
                             "element, and less at edges and "
                             "corners of the body, which have little mass. A stated value holds everywhere.",
                             "6e7"},
                            law.stiffness_Pa_per_m, io::positive());
    describe_self_friction(visitor, study.stated_ground.friction, law);
  });
  study.self_contact.reset();
  if (has_contact) study.self_contact = law;
}

void describe_dynamics(io::StudyVisitor& visitor, LocomotionStudy& study) {
  Method method = study.implicit ? Method::implicit_dynamics : Method::explicit_dynamics;
  visitor.word({"method", "explicit: many cheap steps; implicit: steps with error control."}, method,
               {{"explicit", Method::explicit_dynamics}, {"implicit", Method::implicit_dynamics}});
  const bool is_implicit = method == Method::implicit_dynamics;
  visitor.optional_number({"largest_step_s", "Largest time step.", "1e-3"}, study.largest_step_s, io::positive());
  LocomotionImplicit implicit = study.implicit.value_or(LocomotionImplicit{});
  visitor.only_if(is_implicit, "method = \"implicit\"", [&] { describe_implicit(visitor, implicit); });
  visitor.only_if(!is_implicit, "method = \"explicit\"", [&] { describe_explicit(visitor, study); });
  study.implicit.reset();
  if (!is_implicit) return;
  study.implicit = implicit;
  study.self_contact.reset();
}

void describe_output(io::StudyVisitor& visitor, LocomotionStudy& study) {
  LocomotionOutput& output = study.output;
  visitor.boolean({"frames", "Whether frames for ParaView are written."}, output.frames);
  visitor.boolean({"pictures", "Whether PNG pictures are made."}, output.pictures);
  if (visitor.source() != nullptr) {
    const auto frequency_Hz = study.drive ? stroke_frequency_Hz(*study.drive) : std::nullopt;
    output.records_per_frame = usual_records_per_frame(study.record_interval_s, study.duration_s, frequency_Hz);
  }
  visitor.integer(
      {"records_per_frame",
       "Lines of trajectory.csv per frame. If not given: so many that a stroke of the drive has 8 frames and a second 10, "
       "if there are so many lines, but a walk no more than 300."},
      output.records_per_frame, io::at_least(1));
}

void describe_sweep(io::StudyVisitor& visitor, LocomotionSweep& sweep) {
  visitor.key_names({"keys", "Keys of numbers of this study, with their tables.", R"(["ground.kinetic_friction"])"}, sweep.keys,
                    {.fewest = 1});
  visitor.numbers({"values", "Values of these keys. In each run all keys have the same value.", "[0.4, 0.5]"}, sweep.values,
                  io::any_number(), {.fewest = 1});
}

/// Returns the error for a walk that cannot be made, with the place of its key.
io::InputError located(const io::TomlTable& top, const WalkInputError& error) {
  if (error.key() == "design") return io::InputError(top.file().string() + ": [design]: " + error.reason());
  return top.error(error.key(), error.reason());
}

/// Refuses branches and supplies through lines, which only explicit dynamics has.
void refuse_what_implicit_has_not(const io::TomlTable& top, const LocomotionStudy& study) {
  if (study.material.damping_model == DampingModel::maxwell)
    throw top.error("material.damping_model", "dynamics.method = \"implicit\" has only \"kelvin_voigt\"");
  for (std::size_t n = 0; n < study.stated_supply.plena.size(); ++n) {
    if (study.stated_supply.plena[n].supply == SupplyKind::schedule) continue;
    throw top.tables("pressure")[n].error(
        "supply", "dynamics.method = \"implicit\" has no lines: choose supply = \"schedule\" or dynamics.method = \"explicit\"");
  }
}

/// Computes the members that are derived from what was read, and fills in what the study does not state.
void complete(const io::TomlTable& top, LocomotionStudy& study) {
  try {
    prepare(study, study.implicit ? DampingModel::kelvin_voigt : DampingModel::maxwell);
  } catch (const WalkInputError& error) {
    throw located(top, error);
  }
  if (!study.drive) study.supply = supply_of(study.stated_supply, study.mesh.plenum_names, top);
  if (!study.implicit) return;
  refuse_what_implicit_has_not(top, study);
  study.notes.push_back("dynamics: there is no self-contact: the run ends when walls touch or other parts go through each other");
}

}  // namespace

void describe(io::StudyVisitor& visitor, LocomotionStudy& study) {
  describe_version(visitor);
  describe_elements(visitor, study);
  visitor.table({"design", "The body and how it is hollowed out."}, [&] { describe_body(visitor, study); });
  visitor.table({"material", "The material of the body."}, [&] { describe_silicone(visitor, study); });
  visitor.table({"ground", "The ground: a plane below the body."}, [&] { describe(visitor, study.stated_ground); });
  visitor.table({"loads", "Forces on the whole body."}, [&] {
    visitor.number({"gravity_m_per_s2", "Acceleration downwards."}, study.gravity_m_per_s2, io::non_negative());
    visitor.number({"mass_damping_per_s", "Damping force divided by mass and velocity."}, study.mass_damping_per_s,
                   io::non_negative());
  });
  describe_pressures(visitor, study);
  visitor.table({"time", "The simulated time."}, [&] { describe_time(visitor, study); });
  visitor.table({"dynamics", "The method that computes the motion."}, [&] { describe_dynamics(visitor, study); });
  visitor.table({"output", "What is written."}, [&] { describe_output(visitor, study); });
  visitor.optional_table({"sweep", "Runs the study several times, with different values of some of its numbers."}, study.sweep,
                         [&](LocomotionSweep& sweep) { describe_sweep(visitor, sweep); });
}

LocomotionStudy read_locomotion_study(const fs::path& file) { return parse_locomotion_study(io::read_whole(file), file); }

LocomotionStudy parse_locomotion_study(std::string_view text, const fs::path& file) {
  const io::TomlTable top = io::parse_toml(text, file);
  LocomotionStudy study;
  study.file = file;
  study.text = text;
  io::note_input(study.inputs, file, text);
  io::read_described(top, study);
  complete(top, study);
  return study;
}

}  // namespace menger::fem
