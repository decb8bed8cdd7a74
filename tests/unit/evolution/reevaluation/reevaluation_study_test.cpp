#include "evolution/reference/reevaluation_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <string>

#include "evolution/reevaluation/reference_error.h"
#include "evolution/reference/reevaluation_locomotion.h"
#include "evolution/reference/reevaluation_runner.h"
#include "evolution/reference/reevaluation_surrogate.h"
#include "evolution/study/voxel_evaluator.h"
#include "evolution/study/walk_evaluator.h"
#include "fem/locomotion/locomotion_study_file.h"
#include "io/study/study_reader.h"
#include "io/study/study_template.h"
#include "io/study/study_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"
#include "tests/support/described_study.h"
#include "tests/support/earlier_archive.h"
#include "tests/support/input_error_message.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using tests::message_of;

const std::string bar = "111000000000000000000000000";

class ReevaluationStudyTest : public testing::Test {
 protected:
  [[nodiscard]] ReevaluationStudy read(const std::string& text, const Study& search = tests::silicone_study(),
                                       std::size_t top = 1) const {
    const fs::path archive = folder_ / "run.sqlite";
    fs::remove(archive);
    tests::make_archive(archive, search, {bar});
    io::write_whole(folder_ / "study.toml", text);
    return read_reevaluation_study({.archive = archive, .file = folder_ / "study.toml", .top = top},
                                   RunArchive::open_to_read(archive));
  }

  /// Returns the message with which a study is refused.
  [[nodiscard]] std::string refusal(const std::string& text, const Study& search = tests::silicone_study()) const {
    return message_of([&] { (void)read(text, search); });
  }

  const tests::TestFolder folder_;
};

TEST_F(ReevaluationStudyTest, WithoutKeysItEvaluatesAsTheSearchDid) {
  const ReevaluationStudy study = read("");
  EXPECT_EQ(study.level, 1);
  EXPECT_EQ(study.duration_s, 2.0);
  EXPECT_EQ(study.search.physics.materials[0].static_friction, 1.0);
  EXPECT_FALSE(study.variants);
  EXPECT_EQ(study.elements, LocomotionOptions{});
  EXPECT_TRUE(reference_variants(study).empty());
}

TEST_F(ReevaluationStudyTest, ReadsEveryKeyAndItsTextIsReadBackTheSame) {
  const ReevaluationStudy study = read(
      "level = 1\nsilicone = \"dragon_skin_10\"\nsample_seed = 9\nleast_body_lengths = 0.01\ntime_limit_s = 60\n"
      "[time]\nduration_s = 0.6\nrecord_interval_s = 0.01\nframe_interval_s = 0.05\n"
      "[elements]\nkind = \"three_field\"\nelements_through_wall = 2\nbulk_modulus_ratio = 100\nstep_safety = "
      "0.8\nyoungs_modulus_Pa = 2e5\n"
      "damping_model = \"kelvin_voigt\"\nthreads = 2\n"
      "[ground]\nstatic_friction = 0.7\nkinetic_friction = 0.6\n"
      "[variants]\ndesigns = 4\nelements_through_wall = 3\nbulk_modulus_factor = 3\nstep_factor = 0.25\nfriction_factor = "
      "2\npressure_factor = 3\nyoungs_moduli_Pa = "
      "[1e5]\n");
  EXPECT_EQ(study.duration_s, 0.6);
  EXPECT_EQ(study.elements.elements_through_wall, 2);
  EXPECT_EQ(study.elements.youngs_modulus_Pa, 2e5);
  EXPECT_EQ(study.elements.damping_model, fem::DampingModel::kelvin_voigt);
  for (const voxel::VoxelMaterial& material : study.search.physics.materials) {
    EXPECT_EQ(material.static_friction, 0.7);
    EXPECT_EQ(material.kinetic_friction, 0.6);
  }
  ASSERT_TRUE(study.variants);
  EXPECT_EQ(study.variants->designs, 4U);
  const std::string text = resolved_text(study);
  std::string without_request = text;
  for (const char* key : {"top = 1\n", "sample = 0\n"}) without_request.erase(without_request.find(key), std::string(key).size());
  EXPECT_EQ(resolved_text(read(without_request)), text);
}

TEST_F(ReevaluationStudyTest, KeysOfEarlierVersionsAreToldTheirNewNames) {
  for (const std::string key : {"duration_s", "measure_from_s", "record_interval_s", "frame_interval_s"})
    EXPECT_NE(refusal(key + " = 1\n").find(key + " = 1: is called time." + key + " now"), std::string::npos) << key;
}

/// The study of re-evaluation of a search, without a file.
struct StudyOfSearch : ReevaluationStudy {
  StudyOfSearch() : ReevaluationStudy(read_reevaluation_study({.archive = "run.sqlite", .file = {}}, tests::silicone_study())) {}
};

TEST_F(ReevaluationStudyTest, ItsTemplateAndItsTextsAreReadBack) {
  const auto parse = [](const std::string& text) {
    StudyOfSearch study;
    io::read_described(io::parse_toml(text, "study.toml"), study);
    return study;
  };
  tests::expect_template_is_read<StudyOfSearch>(parse);
  tests::expect_texts_are_read_back<StudyOfSearch>(parse, 5, {}, {"silicone"});
}

TEST_F(ReevaluationStudyTest, ATemplateWithoutASearchEvaluatesAsTheSearchDid) {
  io::StudyTemplateWriter writer;
  ReevaluationStudy nothing;
  describe(writer, nothing);
  EXPECT_EQ(resolved_text(read(writer.text())), resolved_text(read("")));
}

TEST_F(ReevaluationStudyTest, VariantsDifferFromTheReferenceInOneThing) {
  const ReevaluationStudy study = read("[variants]\n");
  const std::vector<ReferenceVariant> variants = reference_variants(study);
  ASSERT_EQ(variants.size(), 7U);
  EXPECT_EQ(variants[0].options, (LocomotionOptions{.elements = {.fidelity = fem::Fidelity::fine}}));
  EXPECT_EQ(variants[1].options, (LocomotionOptions{.bulk_modulus_ratio = 100.0}));
  EXPECT_EQ(variants[2].options, (LocomotionOptions{.step_safety = 0.4}));
  EXPECT_EQ(variants[3].options, (LocomotionOptions{.friction_factor = 1.01}));
  EXPECT_EQ(variants[4].options, (LocomotionOptions{.pressure_factor = 1.01}));
  EXPECT_EQ(variants[5].options, (LocomotionOptions{.youngs_modulus_Pa = 107e3}));
  EXPECT_EQ(variants[6].options, (LocomotionOptions{.youngs_modulus_Pa = 264e3}));
  EXPECT_EQ(variants[2].kind, VariantKind::numerical);
  EXPECT_EQ(variants[4].kind, VariantKind::sensitivity);
  EXPECT_EQ(variants[5].kind, VariantKind::stiffness);
  const std::vector<ReferenceVariant> of_draft = reference_variants(read("[elements]\nfidelity = \"draft\"\n[variants]\n"));
  EXPECT_EQ(of_draft[0].options, (LocomotionOptions{.elements = {.fidelity = fem::Fidelity::standard}}));
  const std::vector<ReferenceVariant> of_layers = reference_variants(read("[elements]\nkind = \"three_field\"\n[variants]\n"));
  EXPECT_EQ(of_layers[0].options,
            (LocomotionOptions{.elements = {.kind = fem::ElementKind::three_field}, .elements_through_wall = 2}));
  const ReevaluationStudy none = read(
      "[elements]\nfidelity = \"fine\"\n[variants]\nbulk_modulus_factor = 1\nstep_factor = 1\nfriction_factor = "
      "1\npressure_factor = 1\n"
      "youngs_moduli_Pa = []\n");
  EXPECT_TRUE(reference_variants(none).empty()) << "what is the reference evaluator itself is no variant";
}

TEST_F(ReevaluationStudyTest, FiniteElementsGetTheBodyTheDriveAndTheGroundOfTheSearch) {
  const ReevaluationStudy study = read("[time]\nduration_s = 0.6\nrecord_interval_s = 0.01\n[ground]\nkinetic_friction = 0.25\n");
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, bar);
  const LocomotionJob job = locomotion_job(study, study.elements, body, "winner", true);
  const io::TomlTable table = io::parse_toml(io::described_text(job.study), "study.toml");
  EXPECT_EQ(table.table("design").number("wall_thickness_m"), 0.002);
  EXPECT_EQ(table.table("design").text("chambers"), "single");
  EXPECT_EQ(table.table("material").text("damping_model"), "maxwell");
  EXPECT_EQ(table.table("ground").number("static_friction"), 1.0);
  EXPECT_EQ(table.table("ground").number("kinetic_friction"), 0.25);
  EXPECT_EQ(table.table("drive").numbers("pressure_Pa"), (std::vector<double>{0.0, 6000.0}));
  EXPECT_EQ(table.table("drive").text("mode"), "in_phase");
  EXPECT_EQ(table.table("drive").number("frequency_Hz"), study.search.physics.actuation.frequency_Hz);
  EXPECT_EQ(table.table("drive").number("ramp_s"), study.search.physics.actuation.ramp_s);
  EXPECT_EQ(table.table("loads").number("gravity_m_per_s2"), 9.81);
  EXPECT_EQ(table.table("time").number("duration_s"), 0.6);
  ASSERT_EQ(study.search.physics.actuation.frequency_Hz, 3.0);
  EXPECT_EQ(table.table("output").integer("records_per_frame"), 4) << "eight frames of a stroke";
  fem::LocomotionStudy walk = job.study;
  fem::prepare(walk);
  const fem::LocomotionStudy read_back = fem::parse_locomotion_study(io::described_text(job.study), "study.toml");
  EXPECT_EQ(fem::locomotion_text(walk), fem::locomotion_text(read_back)) << "in memory as by a file";
  EXPECT_EQ(walk.design.body, body);
  EXPECT_EQ(walk.material.density_kg_per_m3, materials::read_silicone(study.silicone_file).data_sheet.density_kg_per_m3);
  EXPECT_EQ(materials::law_line(walk.material.law),
            materials::law_line(materials::read_silicone(study.silicone_file).recommended.law));

  LocomotionOptions other = study.elements;
  other.threads = 2;
  EXPECT_EQ(protocol_text(study, other), protocol_text(study, study.elements)) << "threads change no result";
  other.step_safety = 0.45;
  EXPECT_NE(protocol_text(study, other), protocol_text(study, study.elements));
  other.step_safety = study.elements.step_safety;
  other.damping_model = fem::DampingModel::kelvin_voigt;
  EXPECT_NE(protocol_text(study, other), protocol_text(study, study.elements));
}

TEST_F(ReevaluationStudyTest, TakesTheSiliconeOfTheSearch) {
  EXPECT_EQ(read("").silicone_file.stem(), "dragon_skin_10");
  Study soft = tests::silicone_study();
  soft.physics.surrogate->parameters.silicone = "Ecoflex 00-30";
  soft.physics.surrogate->parameters.law = materials::law_line(
      materials::read_silicone(materials::silicone_with_record_name("Ecoflex 00-30").value()).recommended.law);
  EXPECT_EQ(read("", soft).silicone_file.stem(), "ecoflex_00_30");
  soft.physics.surrogate->parameters.silicone = "Home-made";
  EXPECT_NE(refusal("", soft).find("calibrated for \"Home-made\", which is not a silicone of menger"), std::string::npos)
      << refusal("", soft);
}

TEST_F(ReevaluationStudyTest, TheSurrogateMovesAsInTheSearch) {
  const ReevaluationStudy study = read("[time]\nduration_s = 0.05\nrecord_interval_s = 0.01\nframe_interval_s = 0.02\n");
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, bar);
  const SurrogateWalk walk = surrogate_walk(study, body, true, nullptr);
  EXPECT_EQ(walk.result.status, io::RunStatus::completed) << walk.result.reason;
  ASSERT_EQ(walk.trajectory.size(), 6U);
  EXPECT_NEAR(walk.trajectory.back().time_s, 0.05, 1e-3);
  EXPECT_EQ(walk.frames.size(), 3U) << "at 0, 0.02 and 0.04 s";
  EXPECT_EQ(walk.result.displacement_m, voxel::displacement_m(walk.trajectory, walk.trajectory.back()));
  EXPECT_EQ(surrogate_walk(study, body, false, nullptr).result.displacement_m, walk.result.displacement_m);
  const std::atomic<bool> never{false};
  const VoxelEvaluator search(study.search.physics, study.search.search.cell_edge_m, study.duration_s);
  EXPECT_EQ(search.evaluate(body, 1, never).displacement_m, walk.result.displacement_m) << "to the last bit";
}

Study windowed_study() {
  Study search = tests::silicone_study();
  search.search.stand = true;
  search.duration_s = 0.05;
  search.measure_from_s = 0.021;
  return search;
}

TEST_F(ReevaluationStudyTest, BothModelsMeasureOverTheWindowOfTheSearchUnlessTheStudySaysOtherwise) {
  const ReevaluationStudy own = read("", windowed_study());
  EXPECT_EQ(own.measure_from_s, 0.021);
  EXPECT_DOUBLE_EQ(own.record_interval_s, 0.021 / 2.0) << "the usual 0.02 s is made a part of what is left out";
  EXPECT_DOUBLE_EQ(own.measured_s(), 0.029);
  EXPECT_EQ(read("[time]\nmeasure_from_s = 0\n", windowed_study()).measure_from_s, 0.0);
  const ReevaluationStudy other =
      read("[time]\nduration_s = 1\nmeasure_from_s = 0.5\nrecord_interval_s = 0.1\n", windowed_study());
  EXPECT_EQ(other.measure_from_s, 0.5);
  EXPECT_EQ(other.record_interval_s, 0.1);
  EXPECT_EQ(read("").measure_from_s, 0.0) << "of a search that measures from the start";
  EXPECT_NE(protocol_text(own, own.elements),
            protocol_text(read("[time]\nmeasure_from_s = 0\n", windowed_study()), own.elements));
  EXPECT_NE(refusal("[time]\nmeasure_from_s = 0.05\n", windowed_study()).find("must be less than duration_s"), std::string::npos);
  EXPECT_NE(refusal("[time]\nduration_s = 0.02\n", windowed_study()).find("measure_from_s = 0.021"), std::string::npos);
  EXPECT_NE(refusal("[time]\nrecord_interval_s = 0.01\n", windowed_study()).find("a multiple of record_interval_s"),
            std::string::npos);
}

TEST_F(ReevaluationStudyTest, TheSurrogateIsMeasuredAsInTheSearch) {
  const ReevaluationStudy study = read("", windowed_study());
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "111100000100000000000000000");
  const SurrogateWalk walk = surrogate_walk(study, body, false, nullptr);
  const std::atomic<bool> never{false};
  const VoxelEvaluator search(study.search.physics, study.search.search.cell_edge_m, 0.05, 0.021);
  const Evaluation expected = search.evaluate(body, 1, never);
  ASSERT_TRUE(expected.displacement_m);
  EXPECT_EQ(walk.result.displacement_m, expected.displacement_m) << "to the last bit";
  EXPECT_EQ(walk.result.left_out_m, expected.left_out_m);
}

/// A search that measures the last periods of a drive whose period is no multiple of 0.02 s.
Study periodic_study() {
  Study search = tests::silicone_study();
  search.search.stand = true;
  search.duration_s = 0.25;
  search.measure = Measure::last_periods;
  search.measure_periods = 5;
  search.physics.actuation.frequency_Hz = 30.0;
  return search;
}

TEST_F(ReevaluationStudyTest, RecordsDivideThePeriodsThatAreMeasured) {
  const ReevaluationStudy study = read("", periodic_study());
  EXPECT_DOUBLE_EQ(study.record_interval_s, 1.0 / 60.0);
  Study slow = periodic_study();
  slow.duration_s = 2.0;
  slow.physics.actuation.frequency_Hz = 3.0;
  slow.measure_from_s = 0.3;
  EXPECT_DOUBLE_EQ(read("", slow).record_interval_s, 1.0 / 51.0);
  EXPECT_NE(refusal("[time]\nrecord_interval_s = 0.02\n", slow).find("must divide the period of the drive"), std::string::npos);
  EXPECT_EQ(refusal("[time]\nrecord_interval_s = 0.01666666666666666666\n", slow), "no error");
}

TEST_F(ReevaluationStudyTest, TheSurrogateMeasuresTheLastPeriodsOfTheSearch) {
  const ReevaluationStudy study = read("", periodic_study());
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "111100000100000000000000000");
  const SurrogateWalk walk = surrogate_walk(study, body, false, nullptr);
  const std::atomic<bool> never{false};
  const VoxelEvaluator search(study.search.physics, study.search.search.cell_edge_m, 0.25, 0.0, measured_periods(study.search));
  const Evaluation expected = search.evaluate(body, 1, never);
  ASSERT_TRUE(expected.displacement_m) << expected.reason;
  EXPECT_EQ(walk.result.displacement_m, expected.displacement_m) << "to the last bit";
  EXPECT_EQ(walk.result.left_out_m, expected.left_out_m);
}

TEST_F(ReevaluationStudyTest, ARunIsMeasuredAsTheSearchIs) {
  ReevaluationStudy study = read("", periodic_study());
  LocomotionRun run;
  run.displacement_m = {14.0, 0.0, 0.0};
  for (int n = 0; n <= 15; ++n)  // two records in a period; the body moves 2 in every period, and a last half of 0
    run.trajectory.push_back({n / 60.0, {std::min<double>(n, 14), 0.0, 0.0}, {}});
  LocomotionRun last = run;
  measure_as_search(study, last);
  ASSERT_TRUE(last.displacement_m && last.left_out_m);
  EXPECT_NEAR((*last.displacement_m)[0], 2.0, 1e-12);
  EXPECT_NEAR((*last.left_out_m)[0], 12.0, 1e-12);
  study.search.measure = Measure::net_displacement;
  study.measure_from_s = 0.1;
  measure_as_search(study, run);
  EXPECT_NEAR((*run.displacement_m)[0], 8.0, 1e-12);
  LocomotionRun failed;
  study.search.measure = Measure::last_periods;
  measure_as_search(study, failed);
  EXPECT_FALSE(failed.displacement_m);
}

TEST(LeaveOut, TakesWhatCameBeforeATimeOutOfTheDisplacement) {
  LocomotionRun run;
  run.displacement_m = {9.0, -3.0, 1.0};
  run.trajectory = {
      {0.0, {1.0, 1.0, 0.0}, {}}, {0.1, {2.0, 1.0, 0.0}, {}}, {0.2, {4.0, 0.0, 0.5}, {}}, {0.3, {10.0, -2.0, 1.0}, {}}};
  LocomotionRun at_record = run;
  leave_out(at_record, 0.2);
  EXPECT_EQ(at_record.left_out_m, (std::array{3.0, -1.0, 0.5}));
  EXPECT_EQ(at_record.displacement_m, (std::array{6.0, -2.0, 0.5}));
  LocomotionRun between = run;
  leave_out(between, 0.15);
  EXPECT_NEAR((*between.left_out_m)[0], 2.0, 1e-12) << "halfway from 2 to 4, from a start at 1";
  EXPECT_NEAR((*between.displacement_m)[0], 7.0, 1e-12);
  LocomotionRun whole = run;
  leave_out(whole, 0.0);
  EXPECT_EQ(whole.displacement_m, run.displacement_m);
  EXPECT_FALSE(whole.left_out_m);
  LocomotionRun failed = run;
  failed.displacement_m.reset();
  leave_out(failed, 0.2);
  EXPECT_FALSE(failed.displacement_m);
  EXPECT_FALSE(failed.left_out_m);
}

TEST_F(ReevaluationStudyTest, NamesWhatStandsAgainstABody) {
  const ReevaluationStudy study = read("");
  const auto obstacle = [&](const std::string& digits) {
    return obstacle_to_reference(study, meshes::Polycube::from_digits(3, 3, 3, digits));
  };
  EXPECT_EQ(obstacle(bar), "");
  EXPECT_NE(obstacle("100010000000000000000000000"), "") << "cells that touch along an edge";
  EXPECT_NE(obstacle("101000000000000000000000000"), "") << "two pieces";
  Study antiphase = tests::silicone_study();
  antiphase.physics.actuation.mode = voxel::ActuationMode::antiphase;
  antiphase.physics.actuation.material_phase = {0.0, 0.5};
  const ReevaluationStudy phases = read("", antiphase);
  const std::string reason = obstacle_to_reference(phases, meshes::Polycube::from_digits(3, 3, 3, "112000000000000000000000000"));
  EXPECT_NE(reason.find("chamber"), std::string::npos) << reason;
  EXPECT_EQ(obstacle_to_reference(phases, meshes::Polycube::from_digits(3, 3, 3, bar)), "") << "one phase";
}

TEST_F(ReevaluationStudyTest, WrongInputIsNamed) {
  EXPECT_NE(refusal("depth = 3\n").find("depth"), std::string::npos) << "an unknown key";
  EXPECT_NE(refusal("[variants]\nwinners = 3\n").find("variants.winners"), std::string::npos);
  EXPECT_NE(refusal("level = 2\n").find("level = 2"), std::string::npos) << "the search knows level 1 only";
  EXPECT_NE(refusal("[time]\nduration_s = 0\n").find("duration_s"), std::string::npos);
  EXPECT_NE(refusal("[time]\nrecord_interval_s = 0.02\nframe_interval_s = 0.03\n").find("frame_interval_s"), std::string::npos);
  EXPECT_NE(refusal("[ground]\nkinetic_friction = 1.5\n").find("kinetic_friction = 1.5"), std::string::npos);
  EXPECT_NE(refusal("silicone = \"ecoflex_00_30\"\n").find("calibrated for"), std::string::npos);
  EXPECT_NE(refusal("silicone = \"/\"\n").find("silicone = \"/\": /: cannot be read"), std::string::npos)
      << refusal("silicone = \"/\"\n");
  EXPECT_NE(message_of([&] { (void)read("", tests::silicone_study(), 0); }).find("--top"), std::string::npos);
}

TEST_F(ReevaluationStudyTest, RobotsOfAnEarlierArchiveCanBeEvaluated) {
  const fs::path archive = folder_ / "run.sqlite";
  tests::make_archive(archive, tests::silicone_study(), {bar});
  tests::make_earlier(archive, tests::silicone_study_of_version_3);
  const ReevaluationStudy study = read_reevaluation_study({.archive = archive, .file = {}}, RunArchive::open_to_read(archive));
  EXPECT_EQ(study.duration_s, 0.05);
  EXPECT_EQ(study.measure_from_s, 0.01);
  EXPECT_EQ(study.search.physics.surrogate->pressure_Pa, (std::array{0.0, 6000.0}));
  RunArchive::open_to_extend(archive).add_reevaluations({});
}

TEST_F(ReevaluationStudyTest, SearchesThatFiniteElementsCannotEvaluateAreRefused) {
  Study solid = tests::silicone_study();
  solid.physics.surrogate.reset();
  EXPECT_NE(refusal("", solid).find("[surrogate]"), std::string::npos) << refusal("", solid);
  Study still = tests::silicone_study();
  still.physics.surrogate->pressure_Pa = {0.0, 0.0};
  EXPECT_NE(refusal("", still).find("pressure_Pa"), std::string::npos);
  Study two_grounds = tests::silicone_study();
  two_grounds.physics.materials[1].kinetic_friction = 0.1;
  EXPECT_NE(refusal("", two_grounds).find("ground.kinetic_friction is missing"), std::string::npos) << refusal("", two_grounds);
  EXPECT_EQ(refusal("[ground]\nkinetic_friction = 0.5\n", two_grounds), "no error");
  two_grounds.physics.materials[0].static_friction = 2.0;
  EXPECT_NE(refusal("[ground]\nkinetic_friction = 0.5\n", two_grounds).find("ground.static_friction is missing"),
            std::string::npos);
  Study levels = tests::silicone_study();
  levels.search.offspring.constraints.levels = {1, 2};
  EXPECT_NE(refusal("", levels).find("level is missing"), std::string::npos);
  EXPECT_EQ(refusal("level = 2\n", levels), "no error");
}

/// A search on finite elements whose pressure comes from the study itself.
class OnElements : public ReevaluationStudyTest {
 protected:
  [[nodiscard]] Study search(const std::string& evaluation = "", const std::string& more = "") const {
    return tests::read_walking_study(folder_ / "search.toml", tests::walking_study_text(evaluation, "", more));
  }
};

TEST_F(OnElements, WithoutKeysItEvaluatesOnStandardElementsWhatTheSearchEvaluated) {
  const ReevaluationStudy study =
      read("", search("", "bulk_modulus_ratio = 60\nyoungs_modulus_Pa = 2e5\n[elements]\nstep_safety = 0.7\n"));
  EXPECT_TRUE(study.silicone_file.empty());
  EXPECT_EQ(study.elements.elements.fidelity, fem::Fidelity::standard);
  EXPECT_EQ(study.elements.bulk_modulus_ratio, 60.0);
  EXPECT_EQ(study.elements.youngs_modulus_Pa, 2e5);
  EXPECT_EQ(study.elements.step_safety, 0.7);
  EXPECT_EQ(study.duration_s, 0.05);
  EXPECT_DOUBLE_EQ(study.record_interval_s, 0.025 / 30.0) << "as in the search";
  EXPECT_EQ(read("[elements]\nfidelity = \"fine\"\n", search()).elements.elements.fidelity, fem::Fidelity::fine);
}

TEST_F(OnElements, OnTheElementsOfTheSearchAWalkIsThatOfTheSearch) {
  const ReevaluationStudy study = read("[elements]\nfidelity = \"draft\"\n", search());
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "110000000100000000000000000");
  const fem::LocomotionStudy walk = locomotion_study(study, study.elements, body, false);
  const std::atomic<bool> never{false};
  const Evaluation expected = WalkEvaluator(study.search).evaluate(body, 1, never);
  ASSERT_TRUE(expected.displacement_m) << expected.reason;
  EXPECT_EQ(fem::travel_of(fem::walk(walk))->displacement_m, *expected.displacement_m) << "to the last bit";
  EXPECT_EQ(surrogate_walk(study, body, false, nullptr).result.displacement_m, expected.displacement_m);
}

TEST_F(OnElements, CanBeComparedWithVoxelsIfTheSearchHasParameters) {
  const Study with_parameters = tests::read_walking_study(
      folder_ / "search.toml",
      "preset = \"paper\"\n[evaluation]\nmodel = \"finite_elements\"\nstand = true\n[body]\nlevels = [1]\ncastable = true\n"
      "[time]\nduration_s = 0.02\n[surrogate]\nparameters = \"" MENGER_SOURCE_DIR
      "/voxel/parameters/dragon_skin_10_1cm.toml\"\noutside_range = \"warn\"\n"
      "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 3\n");
  const ReevaluationStudy study = read("compare_with = \"voxels\"\n", with_parameters);
  EXPECT_FALSE(study.compares_elements());
  EXPECT_TRUE(read("", with_parameters).compares_elements());
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, bar);
  const std::atomic<bool> never{false};
  const Evaluation voxels =
      VoxelEvaluator(study.search.physics, study.search.search.cell_edge_m, study.duration_s).evaluate(body, 1, never);
  const SurrogateWalk walk = surrogate_walk(study, body, true, nullptr);
  ASSERT_TRUE(voxels.displacement_m) << voxels.reason;
  EXPECT_EQ(walk.result.displacement_m, voxels.displacement_m);
  EXPECT_FALSE(walk.frames.empty()) << "to be shown beside the elements";
  EXPECT_EQ(obstacle_to_reference(study, body), "");
  const std::string refused = refusal("compare_with = \"voxels\"\n", search());
  EXPECT_NE(refused.find("compare_with"), std::string::npos) << refused;
  EXPECT_NE(refused.find("no parameters of voxels"), std::string::npos) << refused;
}

TEST_F(OnElements, NamesWhatStandsAgainstABody) {
  const ReevaluationStudy study = read("", search());
  EXPECT_EQ(obstacle_to_reference(study, meshes::Polycube::from_digits(3, 3, 3, bar)), "");
  EXPECT_NE(obstacle_to_reference(study, meshes::Polycube::from_digits(3, 3, 3, "100010000000000000000000000")), "");
  Study antiphase = search();
  antiphase.physics.actuation.mode = voxel::ActuationMode::antiphase;
  antiphase.physics.actuation.material_phase = {0.0, 0.5};
  antiphase.silicone.module.chambers = meshes::ChamberLayout::per_phase;
  const meshes::Polycube corner = meshes::Polycube::from_digits(3, 3, 3, "120100000000000000000000000");
  for (const char* kind : {"three_field", "thin_wall"})
    EXPECT_EQ(obstacle_to_reference(read(std::string("[elements]\nkind = \"") + kind + "\"\n", antiphase), corner), "") << kind;
}

TEST_F(OnElements, AnotherSiliconeIsRefused) {
  EXPECT_EQ(read("silicone = \"dragon_skin_10\"\n", search()).silicone_file.stem(), "dragon_skin_10");
  EXPECT_NE(refusal("silicone = \"ecoflex_00_30\"\n", search()).find("its recommended law is"), std::string::npos);
  EXPECT_NE(refusal("[variants]\n", search()).find("youngs_moduli_Pa"), std::string::npos)
      << "the archive has a law, and does not know of which silicone";
}

TEST_F(OnElements, MeasuresAsTheSearch) {
  Study last = search();
  last.duration_s = 0.15;
  last.measure = Measure::last_periods;
  last.measure_periods = 5;
  const ReevaluationStudy study = read("[elements]\nfidelity = \"draft\"\n", last);
  EXPECT_DOUBLE_EQ(study.measured_s(), 0.025);
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "110000000100000000000000000");
  const std::atomic<bool> never{false};
  const Evaluation expected = WalkEvaluator(study.search).evaluate(body, 1, never);
  ASSERT_TRUE(expected.displacement_m) << expected.reason;
  const Evaluation found = surrogate_walk(study, body, false, nullptr).result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((*found.displacement_m)[axis], (*expected.displacement_m)[axis], 1e-15);
  for (const char* duration : {"0.09", "0.125"})  // of five periods the first would count
    EXPECT_NE(
        refusal("[time]\nduration_s = " + std::string(duration) + "\n", last).find("the search measures the last 5 periods"),
        std::string::npos)
        << duration;
}

}  // namespace
}  // namespace menger::evolution
