#include "fem/locomotion/locomotion_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fem/locomotion/locomotion_sweep.h"
#include "io/study/study_reader.h"
#include "io/study/study_template.h"
#include "meshes/design/design_file.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/unit/fem/locomotion/locomotion_samples.h"

namespace menger::fem {
namespace {

using namespace locomotion_samples;
using tests::message_of;

std::string message_for(const std::string& text) {
  return message_of([&] { (void)sample_study(text); });
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = message_for(text);
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " not in " << message;
}

TEST(LocomotionStudy, ReadsWhatItStates) {
  const LocomotionStudy study = sample_study(cube_study +
                                             "[dynamics]\nstep_safety = 0.5\nthreads = 2\nself_contact = false\n"
                                             "[loads]\ngravity_m_per_s2 = 1.62\nmass_damping_per_s = 3\n");
  EXPECT_EQ(study.mesh.elements.size(), 98U);
  EXPECT_EQ(study.mesh.plenum_names, std::vector<std::string>{"plenum 0"});
  EXPECT_EQ(study.step_safety, 0.5);
  EXPECT_EQ(study.threads, 2);
  EXPECT_FALSE(study.self_contact);
  EXPECT_EQ(study.ground.friction.static_coefficient, 1.0);
  EXPECT_EQ(study.output.records_per_frame, 4U);
  const ExplicitOptions options = dynamics_options(study);
  EXPECT_EQ(options.loads.gravity_m_per_s2[2], -1.62);
  EXPECT_EQ(options.loads.mass_damping_per_s, 3.0);
  EXPECT_DOUBLE_EQ(meshes::body_length_m(study.design, 2), 0.02) << "one cell per side at every level";
}

TEST(LocomotionStudy, HasFramesThatResolveEachStroke) {
  EXPECT_EQ(usual_records_per_frame(0.01, 5.0, std::nullopt), 10U) << "a tenth of a second";
  EXPECT_EQ(usual_records_per_frame(0.01, 5.0, 1.0), 10U);
  EXPECT_EQ(usual_records_per_frame(0.01, 5.0, 3.0), 4U) << "8.3 frames of a stroke";
  EXPECT_EQ(usual_records_per_frame(0.01, 2.0, 10.0), 1U);
  EXPECT_EQ(usual_records_per_frame(0.01, 2.0, 100.0), 1U) << "a record is the least";
  EXPECT_EQ(usual_records_per_frame(0.01, 5.0, 10.0), 2U) << "251 frames of the walk, not 501";
  const std::string slow_drive = "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 4000]\nfrequency_Hz = 5\n";
  EXPECT_EQ(sample_study(cube + silicone + ground + slow_drive + time).output.records_per_frame, 2U);
  const std::string held = "[drive]\nmode = \"hold\"\npressure_Pa = [0, 4000]\nfrequency_Hz = 5\n";
  EXPECT_EQ(sample_study(cube + silicone + ground + held + time).output.records_per_frame, 10U) << "it has no strokes";
}

TEST(LocomotionStudy, HasAsManyFramesAsAPageShowsAtMost) {
  for (const double duration_s : {0.1, 1.0, 5.0, 29.99, 30.0, 60.0, 1000.0}) {
    for (const double interval_s : {0.001, 0.01, 1.0 / 30.0, 0.1}) {
      for (const double frequency_Hz : {0.5, 3.0, 10.0, 50.0}) {
        const auto per_frame = static_cast<double>(usual_records_per_frame(interval_s, duration_s, frequency_Hz));
        const double records = std::ceil(duration_s / interval_s);
        EXPECT_LE(2.0 + std::floor(records / per_frame), static_cast<double>(most_frames_of_walk)) << duration_s << " s";
      }
    }
  }
}

TEST(LocomotionStudy, SurfacesRubAsOnTheGroundUnlessStated) {
  const LocomotionStudy plain = sample_study(cube_study);
  ASSERT_TRUE(plain.self_contact && plain.self_contact->friction);
  EXPECT_EQ(plain.self_contact->friction->static_coefficient, plain.ground.friction.static_coefficient);
  EXPECT_EQ(plain.self_contact->friction->kinetic_coefficient, plain.ground.friction.kinetic_coefficient);
  const LocomotionStudy slippery =
      sample_study(cube_study + "[dynamics]\nself_contact_static_friction = 0.2\nself_contact_kinetic_friction = 0.1\n");
  EXPECT_EQ(slippery.self_contact->friction->static_coefficient, 0.2);
  EXPECT_EQ(slippery.self_contact->friction->kinetic_coefficient, 0.1);
  EXPECT_NE(locomotion_text(plain), locomotion_text(slippery));
  expect_refused(cube_study + "[dynamics]\nself_contact_static_friction = 0.1\nself_contact_kinetic_friction = 0.2\n",
                 {"self_contact_static_friction"});
  expect_refused(cube_study + "[dynamics]\nself_contact = false\nself_contact_kinetic_friction = 0.2\n",
                 {"belongs to self_contact = true"});
}

TEST(LocomotionStudy, ElementsAreThinWallsUnlessStated) {
  const auto elements = [](const std::string& lines) { return hook_study + "[elements]\n" + lines; };
  const LocomotionStudy standard = sample_study(hook_study);
  EXPECT_EQ(standard.elements, ElementChoice{});
  EXPECT_TRUE(std::holds_alternative<ThinWallOptions>(body_options(standard).elements));
  EXPECT_EQ(locomotion_text(sample_study(elements("fidelity = \"standard\"\n"))), locomotion_text(standard));
  std::size_t last_count = 0;
  for (const std::string fidelity : {"draft", "standard", "fine"}) {
    const std::size_t count = sample_study(elements("fidelity = \"" + fidelity + "\"\n")).mesh.elements.size();
    EXPECT_GT(count, last_count) << fidelity;
    last_count = count;
  }
  const LocomotionStudy layers = sample_study(elements("kind = \"three_field\"\n"));
  EXPECT_TRUE(std::holds_alternative<ThreeFieldOptions>(body_options(layers).elements));
  const double expected = ground_stiffness_Pa_per_m(20.0 * 5e4, 2e-3);  // edges of the mesh are rounded
  EXPECT_NEAR(standard.ground.stiffness_Pa_per_m, expected, 1e-12 * expected) << "by the shear modulus";
  EXPECT_NEAR(layers.ground.stiffness_Pa_per_m, expected, 1e-12 * expected) << "by this bulk modulus";
  for (const std::string& other : {elements("precision = \"double\"\n"), elements("kind = \"three_field\"\n")})
    EXPECT_NE(locomotion_text(sample_study(other)), locomotion_text(standard));
}

TEST(LocomotionStudy, RefusesElementsThatDoNotFit) {
  const std::string layers = "[design]\ncells = [1, 1, 1]\ndigits = \"1\"\ncell_edge_m = 0.01\nelements_through_wall = 2\n";
  const std::string rest = silicone + ground + drive + time;
  expect_refused(layers + rest, {"design.elements_through_wall = 2", "belongs to elements.kind = \"three_field\""});
  EXPECT_NO_THROW((void)sample_study(layers + rest + "[elements]\nkind = \"three_field\"\n"));
  expect_refused(hook_study + "[elements]\nkind = \"three_field\"\nfidelity = \"fine\"\n", {"elements.fidelity", "thin_wall"});
}

TEST(LocomotionStudy, MeasuresLengthByTheLongestSideOfTheGrid) {
  const LocomotionStudy study = sample_study(hook_study);
  EXPECT_DOUBLE_EQ(meshes::body_length_m(study.design, 1), 0.02);
  EXPECT_DOUBLE_EQ(meshes::body_length_m(study.design, 3), 0.08);
}

TEST(LocomotionStudy, StandsOnItsLowestPoint) {
  const std::string floating = "[design]\ncells = [1, 1, 2]\ndigits = \"01\"\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n" +
                               silicone + ground + drive + time;
  EXPECT_DOUBLE_EQ(sample_study(floating).ground.height_m, 0.01);
  const std::string stated = "[ground]\nstatic_friction = 1\nkinetic_friction = 1\nheight_m = -0.002\n";
  EXPECT_EQ(sample_study(cube + silicone + stated + drive + time).ground.height_m, -0.002);
  const std::string above = "[ground]\nstatic_friction = 1\nkinetic_friction = 1\nheight_m = 0.001\n";
  expect_refused(cube + silicone + above + drive + time, {"ground.height_m = 0.001", "above the body's lowest point"});
}

TEST(LocomotionStudy, RecordsAtTheIntervalAndAtTheEnd) {
  LocomotionStudy study = sample_study(cube_study);
  study.duration_s = 0.25;
  study.record_interval_s = 0.1;
  EXPECT_EQ(record_times_s(study), (std::vector<double>{0.1, 0.2, 0.25}));
  study.duration_s = 0.3;  // three times 0.1 is not 0.3 in floating point
  EXPECT_EQ(record_times_s(study), (std::vector<double>{0.1, 0.2, 0.3}));
}

TEST(LocomotionStudy, DampsByABranchUnlessStated) {
  const LocomotionStudy branched = sample_study(cube + rubber + ground + drive + time + no_pictures);
  const ExplicitMaterial material = body_options(branched).regions[0].material;
  EXPECT_FALSE(material.branches.empty());
  EXPECT_EQ(material.viscosity_Pa_s, 0.0);
  const LocomotionStudy viscous = sample_study(cube_study);
  EXPECT_TRUE(body_options(viscous).regions[0].material.branches.empty());
  EXPECT_GT(body_options(viscous).regions[0].material.viscosity_Pa_s, 0.0);
  EXPECT_NE(locomotion_text(branched), locomotion_text(viscous));
}

// Whatever changes the records changes the text, and threads do not.
TEST(LocomotionStudy, IsTheSameRunIfItsTextIsTheSame) {
  const std::string text = locomotion_text(sample_study(cube_study));
  EXPECT_EQ(locomotion_text(sample_study(cube_study + "[dynamics]\nthreads = 2\n")), text);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"4000", "4001"},
                                                        {"frequency_Hz = 20", "frequency_Hz = 20.1"},
                                                        {"kinetic_friction = 0.5", "kinetic_friction = 0.4"},
                                                        {"shear_modulus_Pa = 5e4", "shear_modulus_Pa = 5.1e4"},
                                                        {"loss_factor = 0.1", "loss_factor = 0.2"},
                                                        {"wall_thickness_m = 0.004", "wall_thickness_m = 0.003"},
                                                        {"digits = \"1\"", "digits = \"2\""},
                                                        {"duration_s = 0.1", "duration_s = 0.2"}}) {
    std::string changed = cube_study;
    ASSERT_NE(changed.find(from), std::string::npos);
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_NE(locomotion_text(sample_study(changed)), text) << to;
  }
  const std::string piston =
      "[[pressure]]\nplenum = \"plenum 0\"\nsupply = \"piston\"\npiston = \"cam\"\nresistance_Pa_s_per_m3 = 1e8\n"
      "[[piston]]\nname = \"cam\"\nbore_m = 0.02\ncylinder_length_m = 0.05\nstroke_m = 0.03\nfrequency_Hz = ";
  EXPECT_NE(locomotion_text(sample_study(cube + silicone + ground + piston + "1.2\n" + time)),
            locomotion_text(sample_study(cube + silicone + ground + piston + "1.3\n" + time)));
  // Turbulence needs the bore: a tube is not only its resistance and volume.
  const LocomotionStudy tube =
      sample_study(cube + silicone + ground +
                   "[[pressure]]\nplenum = \"plenum 0\"\nsupply = \"line\"\nschedule = \"sine\"\nlow_Pa = 0\nhigh_Pa = 4000\n"
                   "frequency_Hz = 2\nlength_m = 1\ndiameter_m = 0.002\n" +
                   time);
  EXPECT_NE(locomotion_text(tube).find("diameter_m = 0.002"), std::string::npos) << locomotion_text(tube);
}

TEST(LocomotionStudy, NamesFileAndKeyOfWhatDoesNotFit) {
  expect_refused(cube_study + "colour = 1\n", {"study.toml:", "output.colour"});
  expect_refused(cube_study + "[floor]\nheight = 1\n", {"study.toml", "floor"});
  expect_refused(cube + silicone + drive + time, {"study.toml", "ground.kinetic_friction is missing"});
  expect_refused("[design]\ncells = [2, 1, 1]\ndigits = \"12\"\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n" + silicone +
                     ground + "[drive]\nmode = \"antiphase\"\npressure_Pa = [0, 4000]\nfrequency_Hz = 20\n" + time,
                 {"study.toml:17: drive.mode = \"antiphase\": cells (0, 0, 0) and (1, 0, 0) share the air of \"plenum 0\""});
  expect_refused(cube + silicone + ground + time,
                 {"study.toml", "drive or pressure is missing: give a table [drive] or [[pressure]]"});
  expect_refused(cube + silicone + ground + drive, {"study.toml", "time.duration_s is missing"});
  expect_refused(cube_study + "[dynamics]\nmethod = \"magic\"\n", {"dynamics.method = \"magic\""});
  expect_refused(cube_study + "[[pressure]]\nplenum = \"plenum 0\"\nschedule = \"constant\"\npressure_Pa = 0\n",
                 {"keep one of them"});
  expect_refused("schema_version = 3\n" + cube_study, {"schema_version = 3"});
  expect_refused("schema_version = 1\n" + cube_study, {"schema_version = 1", "new names"});
  expect_refused(cube_study + "[gas]\nexponent = 1.4\n", {"gas = {...}: the table [drive] already drives all plena"});
  expect_refused(cube + silicone + "[ground]\nkinetic_coefficient = 0.5\n" + drive + time,
                 {"ground.kinetic_coefficient = 0.5", "is called ground.kinetic_friction now"});
  expect_refused(cube + silicone + ground + drive + "[time]\nduration_s = 1e6\nrecord_interval_s = 1e-3\n",
                 {"a million records"});
  expect_refused(cube + silicone + "[ground]\nstatic_friction = 0.2\nkinetic_friction = 0.5\n" + drive + time,
                 {"ground.static_friction = 0.2"});
}

// Also in the list of a sweep, and also if the study says that its keys are of version 1.
TEST(LocomotionStudy, TellsAllPresentNamesAtOnce) {
  std::string old_drive = drive;
  old_drive.replace(old_drive.find("frequency_Hz"), 12, "period_s");
  const std::string sweep =
      "[sweep]\nkeys = [\"loads.gravity_m_per_s2\", \"ground.kinetic_coefficient\", \"drive.period_s\"]\nvalues = [1]\n";
  expect_refused("schema_version = 1\n" + cube + "[material]\nrecord = \"dragon_skin_10\"\n" +
                     "[ground]\nkinetic_coefficient = 0.5\nstatic_coefficient = 1\n" + old_drive + time +
                     "[dynamics]\nself_contact_kinetic_coefficient = 0.5\n" + sweep,
                 {"material.record = \"dragon_skin_10\": is called material.silicone now\n",
                  "ground.kinetic_coefficient = 0.5: is called ground.kinetic_friction now\n",
                  "ground.static_coefficient = 1: is called ground.static_friction now\n",
                  "drive.period_s = ", "is called drive.frequency_Hz now, the reciprocal of this number\n",
                  "dynamics.self_contact_kinetic_coefficient = 0.5: is called dynamics.self_contact_kinetic_friction now\n",
                  "sweep.keys[2] = \"ground.kinetic_coefficient\": is called ground.kinetic_friction now\n",
                  "sweep.keys[3] = \"drive.period_s\": is called drive.frequency_Hz now"});
  expect_refused(cube_study + "[sweep]\nkeys = [\"ground.static_coefficient\"]\nvalues = [1]\n",
                 {"sweep.keys[1] = \"ground.static_coefficient\": is called ground.static_friction now"});
}

TEST(LocomotionStudy, ReadsWhatMovesItImplicitly) {
  const std::string implicit = cube_study + "[dynamics]\nmethod = \"implicit\"\n";
  const LocomotionStudy study = sample_study("[elements]\ndegree = 2\n" + implicit + "tolerance = 1e-4\nlargest_step_s = 1e-3\n");
  ASSERT_TRUE(study.implicit);
  EXPECT_EQ(study.implicit->degree, 2);
  EXPECT_EQ(study.implicit->tolerance, 1e-4);
  EXPECT_EQ(study.largest_step_s, 1e-3);
  EXPECT_FALSE(study.self_contact);
  EXPECT_NE(locomotion_text(study), locomotion_text(sample_study(implicit)));
  EXPECT_NE(locomotion_text(sample_study(cube_study)), locomotion_text(sample_study(implicit)));
  EXPECT_EQ(study.material.damping_model, DampingModel::kelvin_voigt);
  EXPECT_GT(study.material.viscosity_Pa_s, 0.0);
}

TEST(LocomotionStudy, RefusesWhatImplicitDynamicsHasNot) {
  const std::string implicit = "[dynamics]\nmethod = \"implicit\"\n";
  expect_refused(cube + rubber + "damping_model = \"maxwell\"\n" + ground + drive + time + implicit,
                 {"study.toml:", "material.damping_model = \"maxwell\"", "only \"kelvin_voigt\""});
  expect_refused(cube_study + implicit + "self_contact = true\n", {"study.toml:", "dynamics.self_contact = true"});
  expect_refused(cube_study + implicit + "step_safety = 0.5\n", {"dynamics.step_safety = 0.5", "method = \"explicit\""});
  expect_refused(cube_study + implicit + "threads = 2\n", {"dynamics.threads = 2"});
  expect_refused("[elements]\ndegree = 3\n" + cube_study + implicit, {"elements.degree = 3"});
  expect_refused("[elements]\ndegree = 2\n" + cube_study, {"elements.degree", "dynamics.method = \"implicit\""});
  expect_refused(cube_study + implicit + "degree = 2\n", {"dynamics.degree = 2: is called elements.degree now"});
  expect_refused(cube_study + implicit + "tolerance = 0\n", {"dynamics.tolerance = 0"});
  expect_refused(cube_study + "[dynamics]\ntolerance = 1e-4\n", {"dynamics.tolerance = 1e-04", "method = \"implicit\""});
  const std::string piston =
      "[[pressure]]\nplenum = \"plenum 0\"\nsupply = \"piston\"\npiston = \"cam\"\nresistance_Pa_s_per_m3 = 1e8\n"
      "[[piston]]\nname = \"cam\"\nbore_m = 0.02\ncylinder_length_m = 0.05\nstroke_m = 0.03\nfrequency_Hz = 1\n";
  expect_refused(cube + silicone + ground + piston + time + implicit,
                 {"study.toml:", "pressure[1].supply = \"piston\"", "\"implicit\" has no lines"});
}

/// The keys alone, without a mesh of their body.
LocomotionStudy parse_keys(const std::string& text) {
  LocomotionStudy study;
  io::read_described(io::parse_toml(text, "study.toml"), study);
  return study;
}

/// A study whose values fit to each other, whatever they are one by one.
struct PossibleStudy {
  LocomotionStudy study;
};

void describe(io::StudyVisitor& visitor, PossibleStudy& possible) {
  LocomotionStudy& study = possible.study;
  describe(visitor, study);
  if (visitor.source() != nullptr) return;
  if (study.design.body.count() == 0) study.design.body = meshes::Polycube::from_digits(1, 1, 1, "1");
  study.hollow.level = std::min(study.hollow.level, 3);
  materials::HyperelasticLaw& law = study.silicone.law.law;
  if (!(materials::shear_modulus_at_rest_Pa(law) > 0.0)) law = materials::NeoHookean{5e4};
  if (!study.silicone.density_kg_per_m3) study.silicone.density_kg_per_m3 = 1000.0;
  if (!study.drive) study.drive.emplace();  // supplies have a test of their own
  std::ranges::sort(study.drive->pressure_Pa);
  if (study.implicit) study.elements.kind = ElementKind::three_field;
}

TEST(LocomotionStudy, TemplateAndTextsAreRead) {
  const auto adopt = [](LocomotionStudy& told, const LocomotionStudy& read) { told.silicone.law = read.silicone.law; };
  tests::expect_template_is_read<LocomotionStudy>(parse_keys, {"design.file", "material.law", "dynamics.method = \"implicit\""},
                                                  adopt);  // no file, no density, other elements
  tests::expect_texts_are_read_back<PossibleStudy>([](const std::string& text) { return PossibleStudy{parse_keys(text)}; }, 100);
}

TEST(LocomotionStudy, TemplateRuns) {
  LocomotionStudy told;
  io::StudyTemplateWriter writer;
  describe(writer, told);
  const LocomotionStudy study = sample_study(writer.text());
  EXPECT_GT(study.mesh.elements.size(), 100U);
  EXPECT_EQ(study.duration_s, 0.1);
}

// Designs, laws and points of pressures stand in the text, and what a study leaves open.
TEST(LocomotionStudy, IsReadBackFromItsText) {
  const tests::TestFolder folder;
  const std::filesystem::path table = folder / "pressure.csv";
  io::write_whole(table, "time_s,pressure_Pa\n0,0\n0.1,1000\n0.2,2000\n");
  const std::string points = "[[pressure]]\nplenum = \"plenum 0\"\nschedule = \"table\"\nfile = \"" + table.string() + "\"\n";
  const std::string tube =
      "[[pressure]]\nplenum = \"plenum 0\"\nsupply = \"piston\"\npiston = \"cam\"\nlength_m = 1\ndiameter_m = 0.002\n"
      "[[piston]]\nname = \"cam\"\nbore_m = 0.02\ncylinder_length_m = 0.05\nstroke_m = 0.03\nfrequency_Hz = 1\n";
  const std::string record = "[material]\nsilicone = \"dragon_skin_10\"\n";
  const std::string bristles = ground + "[ground.directional]\nforward = [3, 4]\n";
  for (const std::string& text :
       {cube_study, hook_study, cube_study + "[dynamics]\nmethod = \"implicit\"\n", cube + record + ground + drive + time,
        cube + rubber + bristles + points + time, cube + silicone + ground + tube + time}) {
    const LocomotionStudy study = sample_study(text);
    const LocomotionStudy again = sample_study(locomotion_text(study));
    EXPECT_EQ(locomotion_text(again), locomotion_text(study));
    EXPECT_EQ(again.ground.friction.directional.has_value(), study.ground.friction.directional.has_value());
    EXPECT_EQ(again.material.bulk_modulus_Pa, study.material.bulk_modulus_Pa);
    EXPECT_EQ(again.supply->plena().size(), study.supply->plena().size());
  }
  EXPECT_EQ(sample_study(cube + silicone + ground + points + time).inputs.count(table.string()), 1U);
}

TEST(LocomotionStudy, ReadsTheStudiesThatAreThere) {
  const std::filesystem::path root = MENGER_SOURCE_DIR;
  EXPECT_EQ(read_locomotion_study(root / "fem/studies/locomotion.toml").design.name, "hook");
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "paper/locomotion")) {
    if (entry.path().extension() != ".toml") continue;
    const LocomotionStudy study = read_locomotion_study(entry.path());
    EXPECT_GT(study.mesh.elements.size(), 500U) << entry.path();
    EXPECT_EQ(study.notes.size(), 1U) << entry.path() << ": nothing but damping is assumed";
    if (study.sweep) {
      EXPECT_EQ(sweep_studies(study).size(), study.sweep->values.size()) << entry.path();
    }
    ++count;
  }
  EXPECT_GE(count, 7U);
}

TEST(LocomotionStudy, RefusesBodiesThatCannotBeCast) {
  const std::string rest = silicone + ground + drive + time;
  expect_refused("[design]\ncells = [1, 1, 1]\ndigits = \"1\"\ncell_edge_m = 0.02\nwall_thickness_m = 0.01\n" + rest,
                 {"study.toml: [design]", "wall_thickness_m = 0.01", "smaller than half a cell"});
  expect_refused("[design]\ncells = [3, 1, 1]\ndigits = \"101\"\ncell_edge_m = 0.02\n" + rest,
                 {"study.toml: [design]", "consists of 2 parts"});
  // One piece, but its copies in an aggregate do not touch each other face to face.
  expect_refused("[design]\ncells = [3, 3, 1]\ndigits = \"110011001\"\nlevel = 2\ncell_edge_m = 0.01\n" + rest,
                 {"study.toml: [design]", "level 2"});
  expect_refused("[design]\ncells = [2, 2, 1]\ndigits = \"1001\"\ncell_edge_m = 0.02\n" + rest, {"study.toml: [design]"});
  expect_refused("[design]\ncells = [1, 1, 1]\ndigits = \"0\"\ncell_edge_m = 0.02\n" + rest, {"the body is empty"});
  expect_refused("[design]\ncells = [1, 1, 1]\ndigits = \"11\"\ncell_edge_m = 0.02\n" + rest, {"design.digits = \"11\""});
  expect_refused("[design]\ncells = [1, 1, 1]\ndigits = \"1\"\ncell_edge_m = 0.02\nlevel = 4\n" + rest, {"design.level = 4"});
}

TEST(LocomotionStudy, RefusesPressuresThatArePossibleNowhere) {
  const auto with_pressure = [](const std::string& pressure) { return message_for(cube + silicone + ground + pressure + time); };
  EXPECT_NE(with_pressure("[[pressure]]\nplenum = \"plenum 7\"\nschedule = \"constant\"\npressure_Pa = 1\n")
                .find("pressure[1].plenum = \"plenum 7\": the body has \"plenum 0\""),
            std::string::npos);
  const tests::TestFolder folder;
  const std::filesystem::path table = folder / "backwards.csv";
  io::write_whole(table, "time_s,pressure_Pa\n0,0\n0.2,1000\n0.1,2000\n");
  const std::string message =
      with_pressure("[[pressure]]\nplenum = \"plenum 0\"\nschedule = \"table\"\nfile = \"" + table.string() + "\"\n");
  EXPECT_NE(message.find("backwards.csv:4: time_s = 0.1"), std::string::npos) << message;
}

}  // namespace
}  // namespace menger::fem
