// Studies on hollow cells with calibrated parameters, and bodies that can be cast.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "evolution/genome/constraints.h"
#include "evolution/genome/offspring.h"
#include "evolution/study/study_file.h"
#include "evolution/study/voxel_errors.h"
#include "evolution/study/voxel_evaluator.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/fractal.h"
#include "meshes/design/weak_contacts.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/surrogate_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

const std::string head =
    "preset = \"paper\"\n[body]\ncell_edge_m = 0.01\nlevels = [1, 2]\n[surrogate]\nparameters = \"soft.toml\"\n";
const std::string pressed = "[drive]\npressure_Pa = [-500, 1500]\n";
const std::string in_phase = pressed + "mode = \"in_phase\"\n";

class CalibratedStudy : public testing::Test {
 protected:
  CalibratedStudy() { io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(tests::surrogate_example())); }
  [[nodiscard]] Study read(const std::string& text) const {
    io::write_whole(folder_ / "study.toml", text);
    return read_study(folder_ / "study.toml");
  }
  void expect_refused(const std::string& text, const std::string& fault) const {
    std::string message = "accepted";
    try {
      (void)read(text);
    } catch (const io::InputError& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(fault), std::string::npos) << message;
    EXPECT_NE(message.find("study.toml"), std::string::npos) << message;
  }

  const tests::TestFolder folder_;
};

TEST_F(CalibratedStudy, IsReadBackFromItsTextWithoutTheParametersFile) {
  const Study study = read(head + in_phase);
  ASSERT_TRUE(study.physics.surrogate);
  fs::remove(folder_ / "soft.toml");
  EXPECT_EQ(study_from_text(resolved_text(study), "archive"), study);
}

TEST_F(CalibratedStudy, HasItsParametersInItsIdentity) {
  const Study study = read(head + in_phase);
  Study other = study;
  other.physics.surrogate->parameters.bending_Pa[2] *= 1.0 + 1e-15;
  EXPECT_NE(identity_text(study), identity_text(other));
  EXPECT_NE(VoxelEvaluator(study.physics, 0.01, 1.0).physics(), VoxelEvaluator(other.physics, 0.01, 1.0).physics());
}

TEST_F(CalibratedStudy, KnowsTheErrorsOfItsVoxelsFromBesideItsParameters) {
  Study study = read(head + in_phase);
  const fs::path file = folder_ / "study.toml";
  const fs::path table = folder_ / "soft.errors.csv";
  const auto says = [&](const std::string& text) {
    const std::vector<std::string> lines = voxel_errors(study, file).value().text;
    return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(says("no table of errors lies beside soft.toml"));
  EXPECT_FALSE(voxel_errors(study, file)->table);
  voxel::ExpectedErrors errors{.parameters_hash = voxel::hash_of(tests::surrogate_example())};
  errors.kinds[static_cast<std::size_t>(voxel::BodyKind::limbs)] = {
      .bodies = {"l"}, .displacements = 5, .displacement_median = 0.07, .displacement_ninth_decile = 0.2};
  voxel::expected_errors_table(errors).write(table);
  EXPECT_EQ(voxel_errors(study, file)->table, table);
  EXPECT_TRUE(says("bodies of limbs: 7 % in displacement"));
  EXPECT_TRUE(says("covers aggregates")) << "the study has level 2";
  study.model = EvaluationModel::finite_elements;
  EXPECT_FALSE(voxel_errors(study, file));
  study.model = EvaluationModel::both;
  EXPECT_TRUE(voxel_errors(study, file));
  study.physics.surrogate.reset();
  EXPECT_FALSE(voxel_errors(study, file)) << "solid voxels";
}

TEST_F(CalibratedStudy, RefusesDrivesThatChambersCannotFollow) {
  expect_refused(head + pressed, "with chambers = \"single\" all voxels of a module share a phase");
  expect_refused(head + pressed + "mode = \"wave\"\n", "drive.mode = \"wave\"");
  EXPECT_NO_THROW((void)read(head + "chambers = \"per-phase\"\noutside_range = \"warn\"\n" + pressed));
}

TEST_F(CalibratedStudy, RefusesWhatItsParametersDoNotHoldFor) {
  expect_refused(
      "preset = \"paper\"\n[body]\ncell_edge_m = 0.02\n[surrogate]\nparameters = \"soft.toml\"\n"
      "[drive]\npressure_Pa = [0, 1]\nmode = \"in_phase\"\n",
      "cell_edge_m = 0.01, the design has cell_edge_m = 0.02");
  expect_refused(
      "preset = \"paper\"\n[body]\ncell_edge_m = 0.01\n[surrogate]\nparameters = \"soft.toml\"\n"
      "[drive]\npressure_Pa = [0, 3e3]\nmode = \"in_phase\"\n",
      "pressure_Pa = [0, 3000] is outside the range of the fit for every body");
  expect_refused(head + in_phase + "[genome]\nencoding = \"nonfractal\"\n", "genome.encoding = \"nonfractal\"");
  expect_refused(head + in_phase + "[materials]\ndensity_kg_per_m3 = 10\n",
                 "materials.density_kg_per_m3 = 10: belongs to a body without [surrogate]");
}

/// Parameters that were fitted under vacuum only for limbs of one cell width.
voxel::SurrogateParameters fitted_on_limbs() {
  voxel::SurrogateParameters parameters = tests::surrogate_example();
  parameters.validity.set_pressures(0.0, 2e3);
  for (const voxel::walls::WallClass c : {voxel::walls::limb, voxel::walls::three, voxel::walls::closed})
    for (auto& of_gap : parameters.validity.lowest_pressure_Pa) of_gap[c] = -1e3;
  parameters.validity.lowest_joint_pressure_Pa = -1e3;
  return parameters;
}

TEST_F(CalibratedStudy, StandsOnFeetWhateverThePresetSaysOfRotations) {
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(fitted_on_limbs()));
  EXPECT_FALSE(read(head + in_phase).physics.stop_rotation_in_static_friction) << "the preset's value is true";
  try {
    static_cast<void>(read(head + in_phase + "[ground]\nstop_rotation = true\n"));
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("ground.stop_rotation = true: belongs to a body without [surrogate]"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(CalibratedStudy, LeavesWallsThatBodiesNeedNotHaveToTheirEvaluation) {
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(fitted_on_limbs()));
  const Study study = read(head + in_phase);
  ASSERT_EQ(study.physics.surrogate->outside_range, voxel::OutsideRange::refuse);
  EXPECT_TRUE(outside_validity_of_all(study).empty());
  const std::vector<std::string> notes = study_notes(study);
  const auto tells = [](const std::string& note) { return note.find("pressure_Pa = -500 is outside") != std::string::npos; };
  EXPECT_TRUE(std::ranges::any_of(notes, tells));
  const VoxelEvaluator evaluator(study.physics, 0.01, 0.02);
  const std::atomic<bool> never{false};
  const Evaluation bar = evaluator.evaluate(meshes::Polycube::from_digits(3, 1, 1, "111"), 1, never);
  EXPECT_EQ(bar.status, io::RunStatus::completed) << bar.reason;
  const Evaluation plate = evaluator.evaluate(meshes::Polycube::from_digits(3, 3, 1, "111111111"), 1, never);
  EXPECT_EQ(plate.status, io::RunStatus::diverged);
  EXPECT_EQ(plate.steps, 0U);
  EXPECT_NE(plate.reason.find("pressure_Pa = -500"), std::string::npos) << plate.reason;
}

TEST_F(CalibratedStudy, RefusesDrivesThatNoWallWasFittedAt) {
  voxel::SurrogateParameters parameters = fitted_on_limbs();
  parameters.validity.highest_pressure_Pa = voxel::all_classes(0.0);
  parameters.validity.highest_pressure_Pa[voxel::walls::none] = 2e3;
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  // Some walls were fitted at one end of the drive, some at the other, none at both.
  expect_refused(head + in_phase, "pressure_Pa = [-500, 1500] is outside the range of the fit for every body");
  EXPECT_NO_THROW((void)read(head + "outside_range = \"warn\"\n" + in_phase));
  // Every body of a search at level 2 has joints.
  parameters = tests::surrogate_example();
  parameters.validity.lowest_joint_pressure_Pa = -400.0;
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  expect_refused(head + in_phase, "cover -400 to 2000 Pa (walls with joints)");
}

TEST_F(CalibratedStudy, LeavesWallsWithoutASizeToTheEvaluationOfTheirBodies) {
  voxel::SurrogateParameters parameters = tests::surrogate_example();
  const auto end_at_1400 = [&](std::size_t c) {
    parameters.bulge.at(c).pressure_softening_per_Pa = 1.0 / 1400.0;
    parameters.validity.highest_pressure_Pa.at(c) = 1300.0;
  };
  end_at_1400(voxel::walls::corner);
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  const std::atomic<bool> never{false};
  const std::string fault =
      "voxels with walls on two sides that meet, in a wide body (wall class 2a) have no equilibrium at pressure_Pa = 1500";
  for (const std::string rule : {"refuse", "warn"}) {
    const Study study = read(head + "outside_range = \"" + rule + "\"\n" + in_phase);
    const std::vector<std::string> notes = study_notes(study);
    EXPECT_EQ(std::ranges::count(notes, fault + ": bodies with such walls get no result"), 1) << rule;
    const VoxelEvaluator evaluator(study.physics, 0.01, 0.02);
    const Evaluation bar = evaluator.evaluate(meshes::Polycube::from_digits(3, 1, 1, "111"), 1, never);
    EXPECT_EQ(bar.status, io::RunStatus::completed) << bar.reason;
    const Evaluation square = evaluator.evaluate(meshes::Polycube::from_digits(2, 2, 1, "1111"), 1, never);
    EXPECT_EQ(square.status, io::RunStatus::diverged) << rule;
    EXPECT_FALSE(square.displacement_m);
    EXPECT_NE(square.reason.find(fault), std::string::npos) << square.reason;
  }
  for (std::size_t c = 0; c < voxel::wall_class_count; ++c) end_at_1400(c);
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  expect_refused(head + in_phase,
                 "voxels with no wall beside them (wall class 0) have no equilibrium at pressure_Pa = 1500, and the same holds "
                 "for all other classes");
}

TEST_F(CalibratedStudy, RefusesLengthsThatNoBodyCouldKeep) {
  voxel::SurrogateParameters parameters = tests::surrogate_example();
  parameters.validity.longest_body_cells = 2;
  parameters.validity.longest_aggregate_modules = 2;
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  const auto with_cells = [](const std::string& count) {
    return "preset = \"paper\"\n[body]\ncell_edge_m = 0.01\nlevels = [1, 2]\nsmallest_body_cells = " + count +
           "\n[surrogate]\nparameters = \"soft.toml\"\n" + in_phase;
  };
  EXPECT_NO_THROW((void)read(with_cells("8"))) << "they fit in a cube of two cells";
  expect_refused(with_cells("9"), "the body is 3 cells long, the longest of the fit was 2");
}

TEST_F(CalibratedStudy, EvaluatesBodiesOfEveryLevelAsHollowModules) {
  const Study study = read(head + in_phase);
  const VoxelEvaluator evaluator(study.physics, 0.01, 0.02);
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "102000201111211112000000000");
  const std::atomic<bool> never{false};
  for (const int level : {1, 2}) {
    const Evaluation first = evaluator.evaluate(meshes::fractal(body, level), level, never);
    ASSERT_EQ(first.status, io::RunStatus::completed) << first.reason;
    EXPECT_EQ(evaluator.evaluate(meshes::fractal(body, level), level, never).displacement_m, first.displacement_m);
  }
}

TEST_F(CalibratedStudy, MarksBodiesThatLeaveTheRangeOfValidity) {
  const Study study = read(head + in_phase);
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "102000201111211112000000000");
  const std::atomic<bool> never{false};
  const auto evaluated = [&](auto change, voxel::OutsideRange rule) {
    voxel::Physics physics = study.physics;
    physics.surrogate->outside_range = rule;
    change(physics.surrogate->parameters.validity);
    return VoxelEvaluator(physics, 0.01, 0.1).evaluate(body, 1, never);
  };
  const auto inside = [](voxel::ValidityRange&) {};
  const auto strained = [](voxel::ValidityRange& validity) { validity.smallest_strain = -1e-9; };
  const auto long_body = [](voxel::ValidityRange& validity) { validity.longest_body_cells = 2; };
  EXPECT_EQ(evaluated(inside, voxel::OutsideRange::warn).outside_validity, "");

  const Evaluation warned = evaluated(strained, voxel::OutsideRange::warn);
  EXPECT_EQ(warned.status, io::RunStatus::completed) << warned.reason;
  EXPECT_NE(warned.outside_validity.find("beams had strains from"), std::string::npos) << warned.outside_validity;
  EXPECT_EQ(warned.displacement_m, evaluated(inside, voxel::OutsideRange::warn).displacement_m) << "a mark changes nothing";
  EXPECT_EQ(evaluated(strained, voxel::OutsideRange::refuse).status, io::RunStatus::diverged);

  EXPECT_NE(evaluated(long_body, voxel::OutsideRange::warn).outside_validity.find("3 cells long"), std::string::npos);
  const Evaluation refused = evaluated(long_body, voxel::OutsideRange::refuse);
  EXPECT_EQ(refused.status, io::RunStatus::diverged);
  EXPECT_EQ(refused.steps, 0U) << "what is known beforehand costs nothing";
  EXPECT_FALSE(refused.displacement_m);
  EXPECT_NE(refused.reason.find("3 cells long"), std::string::npos) << refused.reason;
}

TEST_F(CalibratedStudy, NamesTheFilesThatDecideIt) {
  (void)read(head + in_phase);
  EXPECT_EQ(study_inputs(folder_ / "study.toml"), (std::vector<fs::path>{folder_ / "study.toml", folder_ / "soft.toml"}));
  (void)read("preset = \"paper\"\n");
  EXPECT_EQ(study_inputs(folder_ / "study.toml"), std::vector<fs::path>{folder_ / "study.toml"});
}

TEST_F(CalibratedStudy, RampsItsPressureOverAPeriodUnlessItSaysOtherwise) {
  const Study study = read(head + in_phase + "frequency_Hz = 2.5\n");
  EXPECT_EQ(study.physics.actuation.ramp_s, 0.4);
  EXPECT_EQ(read(head + in_phase + "ramp_s = 0\n").physics.actuation.ramp_s, 0.0) << "also beside overrides of the command line";
  EXPECT_EQ(study_from_text(resolved_text(read(head + in_phase + "ramp_s = 0\n")), "archive").physics.actuation.ramp_s, 0.0);
  EXPECT_EQ(read("preset = \"paper\"\n").physics.actuation.ramp_s, 0.0);
}

TEST_F(CalibratedStudy, ReadsCastableAndCoupling) {
  const Study study = read("preset = \"paper\"\n[body]\ncastable = true\n[materials]\nlateral_coupling = 0.3\n");
  EXPECT_TRUE(study.search.offspring.constraints.castable);
  EXPECT_EQ(study.physics.lateral_coupling, 0.3);
  EXPECT_EQ(study_from_text(resolved_text(study), "archive"), study);
  EXPECT_FALSE(read("preset = \"paper\"\n").search.offspring.constraints.castable);
}

Phenotype phenotype_of(const std::string& digits) {
  Phenotype phenotype;
  phenotype.body = meshes::Polycube::from_digits(3, 3, 3, digits);
  return phenotype;
}

TEST(Castable, RefusesBodiesThatHangOnAnEdge) {
  // A ring with a corner missing, so that its ends touch along an edge.
  const Phenotype weak = phenotype_of("111101110000000000000000000");
  ASSERT_TRUE(meshes::first_weak_contact(weak.body));
  ConstraintOptions options{.disconnected = DisconnectedPolicy::allow, .levels = {1}};
  EXPECT_TRUE(is_valid(weak, options));
  options.castable = true;
  EXPECT_EQ(refusal(weak, options), Refusal::weak_contact);
  const Phenotype sound = phenotype_of("111101111000000000000000000");
  EXPECT_EQ(refusal(sound, options), std::nullopt);
}

TEST(Castable, RefusesBodiesInPiecesWhateverThePolicy) {
  ConstraintOptions options{.disconnected = DisconnectedPolicy::allow, .levels = {1}, .castable = true};
  EXPECT_EQ(refusal(phenotype_of("111000111000000000000000000"), options), Refusal::falls_apart);
  EXPECT_EQ(refusal(phenotype_of("100000000000000000000000000"), options), Refusal::too_small);
}

TEST(Castable, BodiesAreBornCastable) {
  OffspringOptions options;
  options.constraints.castable = true;
  options.constraints.levels = {1};
  RandomStream random(11, "test");
  for (int i = 0; i < 20; ++i) {
    const Offspring parent = random_offspring(options, random);
    EXPECT_FALSE(meshes::first_weak_contact(parent.phenotype.body));
    const Offspring child = child_of(parent.genome, parent.phenotype, options, random);
    EXPECT_FALSE(meshes::first_weak_contact(child.phenotype.body));
  }
}

TEST(Castable, TellsWhyNoBodyWasValid) {
  OffspringOptions options;
  options.largest_draws = 20;
  options.constraints.smallest_body = 28;
  RandomStream random(11, "test");
  try {
    (void)random_offspring(options, random);
    FAIL() << "a body larger than its grid";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("too small: 20"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace menger::evolution
