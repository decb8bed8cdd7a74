#include "evolution/study/study.h"

#include <SQLiteCpp/Database.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "evolution/archive/run_archive.h"
#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "io/study/study_reader.h"
#include "io/study/study_template.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/described_study.h"
#include "tests/support/earlier_archive.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

const fs::path paper = fs::path(MENGER_SOURCE_DIR) / "paper";

/// Returns the lines of a TOML text without comments, blank lines and spaces around lines.
std::vector<std::string> bare_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    line.erase(std::min(line.find('#'), line.size()));
    line.erase(line.find_last_not_of(' ') + 1);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

class StudyFile : public testing::Test {
 protected:
  [[nodiscard]] Study read(const std::string& text, const StudyOverrides& overrides = {}) const {
    io::write_whole(folder_ / "study.toml", text);
    return read_study(folder_ / "study.toml", overrides);
  }

  void expect_refused(const std::string& text, const std::vector<std::string>& words,
                      const StudyOverrides& overrides = {}) const {
    try {
      (void)read(text, overrides);
      FAIL() << "accepted:\n" << text;
    } catch (const io::InputError& error) {
      for (const std::string& word : words) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what() << "\ndoes not say: " << word;
      }
    }
  }

  const tests::TestFolder folder_;
};

TEST_F(StudyFile, PresetFilesSpellEveryOptionOut) {
  for (const std::string name : {"paper", "released-code"}) {
    const std::string text = io::read_whole(paper / "presets" / (name + ".toml"));
    EXPECT_EQ(preset_text(name), text) << "the programs carry another text";
    EXPECT_EQ(bare_lines(text), bare_lines(resolved_text(study_from_text(text, name)))) << name;
    EXPECT_EQ(read("preset = \"" + name + "\"\n"), study_from_text(text, name));
  }
}

TEST_F(StudyFile, PresetsDifferInTheseOptionsOnly) {
  const std::vector<std::string> first = bare_lines(resolved_text(read("preset = \"paper\"\n")));
  const std::vector<std::string> second = bare_lines(resolved_text(read("preset = \"released-code\"\n")));
  ASSERT_EQ(first.size(), second.size());
  std::set<std::string> keys;
  for (std::size_t line = 0; line < first.size(); ++line) {
    if (first[line] != second[line]) keys.insert(first[line].substr(0, first[line].find(' ')));
  }
  EXPECT_EQ(keys, (std::set<std::string>{"generations", "activations", "output_function", "expression", "axes", "disconnected",
                                         "duration_s", "objective", "duplicates", "material_phase", "wave_periods_per_body",
                                         "wave_over_gaps"}));
}

TEST_F(StudyFile, PaperPresetHasThePapersNumbers) {
  const Study study = read("preset = \"paper\"\n");
  EXPECT_EQ(study.search.survivors, 15);
  EXPECT_EQ(study.search.levels(), (std::vector{1, 2, 3}));
  EXPECT_EQ(study.duration_s, 5.0);
  EXPECT_EQ(study.search.objective, Objective::body_lengths);
  EXPECT_EQ(study.physics.materials[0].youngs_modulus_Pa, 1e4);
  EXPECT_EQ(study.physics.materials[1].density_kg_m3, 10.0);
  EXPECT_EQ(study.physics.actuation.frequency_Hz, 5.0);
  EXPECT_TRUE(study.physics.stop_rotation_in_static_friction);
  EXPECT_EQ(study.physics.collisions.exclusion_depth, 1);
}

TEST_F(StudyFile, OwnKeysOverrideThePreset) {
  const Study study = read(R"(
preset = "released-code"
seed = 42
[population]
newcomers = 2
[genome]
encoding = "nonfractal"
mutants_may_keep_body = false
[body]
levels = [1, 3]
disconnected = "penalise"
[evaluation]
pruning = false
[materials]
youngs_modulus_Pa = 20000
[collisions]
exclusion_depth = "off"
)");
  EXPECT_EQ(study.search.seed, 42U);
  EXPECT_EQ(study.search.newcomers, 2);
  EXPECT_EQ(study.search.offspring.decoder.plan, BodyPlan::nonfractal);
  EXPECT_FALSE(study.search.offspring.mutants_may_keep_body);
  EXPECT_EQ(study.search.levels(), (std::vector{1, 3}));
  EXPECT_EQ(study.search.offspring.constraints.disconnected, DisconnectedPolicy::penalise);
  EXPECT_FALSE(study.search.pruning);
  EXPECT_EQ(study.physics.materials[1].youngs_modulus_Pa, 20000.0);
  EXPECT_FALSE(study.physics.collisions.exclusion_depth);
  EXPECT_EQ(study.duration_s, 2.0) << "the rest is the preset's";
  EXPECT_EQ(study_from_text(resolved_text(study), "resolved"), study);
}

TEST_F(StudyFile, CommandLineOverridesTheFile) {
  StudyOverrides overrides;
  overrides.generations = 7;
  overrides.levels = std::vector{2};
  overrides.duration_s = 0.1;
  overrides.seed = 9;
  const Study study = read("preset = \"paper\"\ngenerations = 3\n", overrides);
  EXPECT_EQ(study.search.generations, 7);
  EXPECT_EQ(study.search.levels(), std::vector{2});
  EXPECT_EQ(study.duration_s, 0.1);
  EXPECT_EQ(study.search.seed, 9U);
}

TEST_F(StudyFile, CommandLineIsCheckedLikeTheFile) {
  StudyOverrides overrides;
  overrides.generations = -1;
  expect_refused("preset = \"paper\"\n", {"command line", "generations = -1"}, overrides);
  overrides = {};
  overrides.levels = std::vector{2, 1};
  expect_refused("preset = \"paper\"\n", {"command line", "levels", "ascend"}, overrides);
}

TEST_F(StudyFile, IdentityLeavesOutOnlyTheNumberOfGenerations) {
  const Study study = read("preset = \"paper\"\n");
  EXPECT_EQ(identity_text(study), identity_text(read("preset = \"paper\"\ngenerations = 2\n")));
  for (const std::string change :
       {"seed = 2\n", "[time]\nduration_s = 4\n", "[damping]\nglobal = 0.02\n", "[body]\nlevels = [1]\n"}) {
    EXPECT_NE(identity_text(study), identity_text(read("preset = \"paper\"\n" + change))) << change;
  }
}

TEST_F(StudyFile, RefusesWhatDoesNotFitWithPlaceKeyAndValue) {
  const std::string place = (folder_ / "study.toml").string() + ":";
  expect_refused("generations = 3\n", {"preset is missing"});
  expect_refused("preset = \"paper2\"\n", {place + "1", "preset = ", "paper2", "released-code"});
  const std::string head = "preset = \"paper\"\n";
  expect_refused(head + "generation = 3\n", {place + "2", "generation", "unknown key", "generations"});
  expect_refused(head + "[population]\nsurvivers = 3\n", {place + "3", "population.survivers", "unknown key"});
  expect_refused(head + "generations = \"many\"\n", {place + "2", "generations = ", "many", "integer"});
  expect_refused(head + "generations = -3\n", {place + "2", "generations = -3"});
  expect_refused(head + "seed = -1\n", {place + "2", "seed = -1"});
  expect_refused(head + "[population]\nsurvivors = 0\n", {place + "3", "survivors = 0"});
  expect_refused(head + "[genome]\naxes = \"yxz\"\n", {place + "3", "genome.axes", "yxz", "zyx"});
  expect_refused(head + "[body]\nlevels = [2, 1]\n", {place + "3", "levels", "ascend"});
  expect_refused(head + "[body]\nlevels = []\n", {place + "3", "levels", "at least one"});
  expect_refused(head + "[body]\nlevels = [1.5]\n", {place + "3", "levels[1] = 1.5", "integer"});
  expect_refused(head + "[body]\nlevels = [0]\n", {place + "3", "levels[1] = 0"});
  expect_refused(head + "[body]\ncell_edge_m = 0\n", {place + "3", "cell_edge_m = 0"});
  expect_refused(head + "[time]\nduration_s = -2\n", {place + "3", "duration_s = -2"});
  expect_refused(head + "[materials]\nyoungs_modulus_Pa = -1e4\n", {place + "3", "youngs_modulus_Pa = -10000"});
  expect_refused(head + "[materials]\nyoungs_modulus_Pa = 1e200\n",
                 {"study.toml", "youngs_modulus_Pa = 1e+200", "no model bears more"});
  expect_refused(head + "[time]\nduration_s = 1e300\n", {"study.toml", "duration_s = 1e+300", "steps"});
  for (const std::string ratio : {"0.5", "0"})
    expect_refused(head + "[materials]\npoissons_ratio = " + ratio + "\n",
                   {place + "3", "poissons_ratio = " + ratio, "had to be 0"});
  expect_refused(head + "[genome]\nencoding = \"nonfractal\"\n[body]\nlevels = [4]\n",
                 {place + "5", "nonfractal", "highest level", "is 3"});
  expect_refused(head + "[body]\nlevels = [1, 9]\n", {place + "3", "levels", "memory"});
  expect_refused(head + "[ground]\nkinetic_friction = 1.5\n",
                 {place + "3", "ground.kinetic_friction = 1.5", "is more than static_friction = 1"});
}

TEST_F(StudyFile, LimitsOfMutantsBelongToTheIdentityOfAStudyThatHasThem) {
  const std::string head = "preset = \"paper\"\n[genome]\n";
  const std::string control = head + "encoding = \"nonfractal\"\n";
  const Study study = read(control + "mutants_may_keep_body = false\n");
  EXPECT_EQ(study_from_text(resolved_text(study), "resolved"), study);
  EXPECT_NE(identity_text(study), identity_text(read(control)));
  EXPECT_EQ(identity_text(read(control)).find("mutants_may_keep_body"), std::string::npos);
  EXPECT_EQ(identity_text(read(control)).find("most_changed_cells"), std::string::npos);
  EXPECT_NE(identity_text(read(head + "most_changed_cells = 26\n")), identity_text(read(head)));
  EXPECT_EQ(identity_text(read(head + "most_changed_cells = 27\n")), identity_text(read(head))) << "a fractal has 27 cells";
  for (const std::string cells : {"0", "82"})
    expect_refused(head + "most_changed_cells = " + cells + "\n", {"study.toml:3", "genome.most_changed_cells = " + cells});
  expect_refused(head + "mutants_may_keep_body = false\n", {"study.toml:3", "genome.mutants_may_keep_body", "nonfractal"});
}

TEST_F(StudyFile, ChecksOfTheTimeStepBelongToTheIdentityOfAStudyThatHasThem) {
  const Study study = read("preset = \"paper\"\n[check_dt]\nevery = 10\n");
  EXPECT_EQ(study.search.step_checks, (StepCheckPlan{.every = 10, .designs = 1}));
  EXPECT_EQ(study_from_text(resolved_text(study), "resolved"), study);
  const std::string usual = identity_text(read("preset = \"paper\"\n"));
  EXPECT_EQ(usual.find("check_dt"), std::string::npos);
  EXPECT_NE(identity_text(study), usual);
  EXPECT_NE(half_step_evaluator_of(study)->physics().find("time_step_fraction = 0.45\n"), std::string::npos);
  expect_refused("preset = \"paper\"\n[check_dt]\nevery = 0\n", {"study.toml:3", "check_dt.every = 0"});
  expect_refused("preset = \"paper\"\n[check_dt]\ndesigns = 0\n", {"study.toml:3", "check_dt.designs = 0"});
  expect_refused("preset = \"paper\"\n[check_dt]\nfraction = 0.5\n", {"study.toml:3", "check_dt.fraction", "unknown key"});
}

TEST_F(StudyFile, KeysOfEarlierVersionsAreToldTheirNewNames) {
  const std::string head = "preset = \"paper\"\n[evaluation]\n";
  for (const std::string key : {"duration_s", "measure_from_s"}) {
    expect_refused(head + key + " = 1\n", {"study.toml:3", "evaluation." + key + " = 1", "is called time." + key + " now"});
  }
}

TEST_F(StudyFile, StudiesOfEarlierArchivesAreRead) {
  const auto archived = [&](const std::string& text) {
    const fs::path file = folder_ / "run.sqlite";
    fs::remove(file);
    (void)RunArchive::open(file, "seed = 1\n", 2);
    tests::make_earlier(file, text);
    return archived_study(RunArchive::open_to_read(file));
  };
  StudyOverrides overrides;
  overrides.generations = 2;
  EXPECT_EQ(archived(tests::demo_study_of_version_3), read_study(paper / "demo/study.toml", overrides));

  const Study silicone = archived(tests::silicone_study_of_version_3);
  EXPECT_EQ(silicone.search.survivors, 2);
  EXPECT_EQ(silicone.duration_s, 0.05);
  EXPECT_EQ(silicone.measure_from_s, 0.01);
  EXPECT_TRUE(silicone.search.stand);
  EXPECT_TRUE(silicone.search.offspring.constraints.castable);
  EXPECT_EQ(silicone.physics.gravity_m_s2, 9.81);
  EXPECT_EQ(silicone.physics.actuation.mode, voxel::ActuationMode::in_phase);
  EXPECT_EQ(silicone.physics.actuation.frequency_Hz, 3.0);
  EXPECT_EQ(silicone.physics.actuation.ramp_s, 0.3333333333333333);
  ASSERT_TRUE(silicone.physics.surrogate);
  EXPECT_EQ(silicone.physics.surrogate->pressure_Pa, (std::array{0.0, 6000.0}));
  EXPECT_EQ(silicone.physics.surrogate->outside_range, voxel::OutsideRange::warn);
  EXPECT_EQ(silicone.physics.surrogate->parameters.silicone, "Dragon Skin 10");
  EXPECT_EQ(study_from_text(resolved_text(silicone), "archive"), silicone);
}

TEST_F(StudyFile, ItsTemplateAndItsTextsAreReadBack) {
  const auto parse = [](const std::string& text) {
    PresetStudy file;
    io::read_described(io::parse_toml(text, "study.toml"), file);
    return file;
  };
  tests::expect_template_is_read<PresetStudy>(parse, {"evaluation.model = \"both\"", "evaluation.model = \"finite_elements\"",
                                                      "integration.number = \"float32\"", "robust", "surrogate"});
  // Half of the random studies are on finite elements, and half of those name a silicone that does not exist. Random levels
  // hardly ever ascend. Some twenty are valid; how many, changes with every key that is drawn.
  tests::expect_texts_are_read_back<PresetStudy>(parse, 10, {"levels"});
  // Most pairs of a smallest and a largest body are refused where whole studies are checked.
  tests::expect_texts_are_read_back<Study>([](const std::string& text) { return study_from_text(text, "study.toml"); }, 10,
                                           {"levels", "largest_body_cells"});
}

// A key that the template stated would hide the value of the preset.
TEST_F(StudyFile, ItsTemplateHasTheValuesOfWhicheverPresetItNames) {
  io::StudyTemplateWriter writer;
  PresetStudy told;
  describe(writer, told);
  const std::string text = writer.text();
  EXPECT_EQ(read(text), read("preset = \"paper\"\n"));
  const std::string named = "\npreset = \"paper\"\n";
  ASSERT_NE(text.find(named), std::string::npos) << text;
  const auto with_preset = [&](const std::string& name, std::string changed) {
    return changed.replace(changed.find(named), named.size(), "\npreset = \"" + name + "\"\n");
  };
  EXPECT_EQ(read(with_preset("released-code", text)), read("preset = \"released-code\"\n"));

  // Each value of the preset is there as a comment. With every # removed, nothing is left to the preset.
  std::string stated = text;
  for (const std::string& line : bare_lines(resolved_text(told.study))) {
    if (line.front() == '[') continue;
    const std::size_t at = stated.find("\n#" + line + "\n");
    ASSERT_NE(at, std::string::npos) << line << "\nis not in\n" << stated;
    stated.erase(at + 1, 1);
  }
  EXPECT_EQ(read(with_preset("released-code", stated)), read("preset = \"paper\"\n"));
}

TEST_F(StudyFile, WhatIsMeasuredBelongsToTheIdentity) {
  const std::string head = "preset = \"paper\"\n";
  const Study study = read(head + "[evaluation]\nstand = true\n[time]\nmeasure_from_s = 0.5\n");
  EXPECT_TRUE(study.search.stand);
  EXPECT_EQ(study.measure_from_s, 0.5);
  EXPECT_EQ(study_from_text(resolved_text(study), "resolved"), study);
  const std::string usual = identity_text(read("preset = \"paper\"\n"));
  EXPECT_EQ(identity_text(read(head + "[evaluation]\nstand = false\n[time]\nmeasure_from_s = 0\n")), usual);
  EXPECT_EQ(usual.find("reference"), std::string::npos);
  EXPECT_NE(identity_text(read(head + "[evaluation]\nstand = true\n")), usual);
  EXPECT_NE(identity_text(read(head + "[time]\nmeasure_from_s = 1\n")), usual);
}

TEST_F(StudyFile, MomentsOfBeamsBelongToTheIdentityUnlessTheyArePublished) {
  const Study usual = read("preset = \"paper\"\n");
  EXPECT_EQ(identity_text(usual).find("beam_moments"), std::string::npos) << "archives of earlier versions go on";
  EXPECT_NE(resolved_text(usual).find("beam_moments = \"published\""), std::string::npos);
  const Study balanced = read("preset = \"paper\"\n[materials]\nbeam_moments = \"balanced\"\n");
  EXPECT_NE(identity_text(balanced), identity_text(usual));
  EXPECT_EQ(study_from_text(resolved_text(balanced), "resolved.toml"), balanced);
  EXPECT_NE(evaluator_of(balanced)->physics(), evaluator_of(usual)->physics());
}

TEST_F(StudyFile, TheDeviceBelongsToTheIdentityUnlessItIsTheProcessor) {
  const Study usual = read("preset = \"paper\"\n");
  EXPECT_EQ(usual.device, io::Device::cpu);
  EXPECT_EQ(identity_text(usual).find("device"), std::string::npos) << "archives of earlier versions go on";
  const Study on_device = read("preset = \"paper\"\n[evaluation]\ndevice = \"cuda\"\n");
  EXPECT_EQ(on_device.device, io::Device::cuda);
  EXPECT_NE(identity_text(on_device), identity_text(usual));
  EXPECT_EQ(study_from_text(resolved_text(on_device), "resolved.toml"), on_device);
  EXPECT_NE(evaluator_of(on_device)->physics(), evaluator_of(usual)->physics());
}

TEST_F(StudyFile, RefusesAWindowThatIsNoPartOfTheEvaluation) {
  const std::string head = "preset = \"paper\"\n[time]\nduration_s = 2\n";
  expect_refused(head + "measure_from_s = -0.5\n", {"study.toml:4", "time.measure_from_s = -0.5"});
  expect_refused(head + "measure_from_s = 2\n", {"study.toml", "measure_from_s = 2", "less than duration_s = 2"});
  expect_refused(head + "[evaluation]\nstand = 1\n", {"evaluation.stand"});
  StudyOverrides overrides;
  overrides.duration_s = 0.25;
  expect_refused(head + "measure_from_s = 0.5\n", {"measure_from_s = 0.5", "less than duration_s = 0.25"}, overrides);
}

TEST_F(StudyFile, RefusesTheTableOfCorrectionsAndSaysWhatToWriteInstead) {
  for (const std::string name : {"reference", "judge"}) {
    const std::string text = "preset = \"paper\"\n[body]\nlevels = [1]\n[" + name + "]\nstudy = \"a.toml\"\n";
    expect_refused(text, {"study.toml:4", name, "is not a table any more", "[evaluation] model = \"both\""});
  }
}

TEST_F(StudyFile, ArchivesOfCorrectedSearchesAreReadAndNotContinued) {
  const Study study = read("preset = \"paper\"\n[body]\nlevels = [1]\n");
  const std::string corrected =
      identity_text(study) + "[reference]\nprotocol = \"0\"\nevery = 10\ndesigns = 2\nbudget_element_steps = 1\n";
  const fs::path file = folder_ / "corrected.sqlite";
  { const RunArchive made = RunArchive::open(file, corrected, study.search.generations); }
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 6");  // the last one with corrections
  const RunArchive archive = RunArchive::open_to_read(file);
  EXPECT_TRUE(was_corrected(archive));
  EXPECT_EQ(archived_study(archive), study);
  for (const std::string& text : {corrected, identity_text(study)}) {
    const std::string message = tests::message_of([&] { (void)RunArchive::open(file, text, study.search.generations); });
    for (const char* words : {"corrected.sqlite", "[reference]", "no search can be resumed from it", "choose another archive"})
      EXPECT_NE(message.find(words), std::string::npos) << message;
  }
  const fs::path plain = folder_ / "plain.sqlite";
  { const RunArchive made = RunArchive::open(plain, identity_text(study), study.search.generations); }
  EXPECT_FALSE(was_corrected(RunArchive::open_to_read(plain)));
}

TEST_F(StudyFile, MayKeepAnArchiveOfElites) {
  const std::string head = "preset = \"paper\"\n";
  const Study study = read(head + "[map_elites]\ncells_per_niche = 5\n");
  ASSERT_TRUE(study.search.map_elites);
  EXPECT_EQ(study.search.map_elites->cells_per_niche, 5U);
  EXPECT_EQ(study_from_text(resolved_text(study), "resolved"), study);
  EXPECT_NE(identity_text(study), identity_text(read(head)));
  EXPECT_EQ(identity_text(read(head)).find("map_elites"), std::string::npos);
  expect_refused(head + "[map_elites]\ncells_per_niche = 0\n", {"map_elites.cells_per_niche = 0"});
}

TEST_F(StudyFile, MaySelectInASteadyState) {
  const std::string head = "preset = \"paper\"\n[population]\nselection = \"steady_state\"\n";
  const Study study = read(head);
  EXPECT_EQ(study.search.selection_time, SelectionTime::steady_state);
  EXPECT_FALSE(study.search.pruning) << "nothing waits for other evaluations";
  EXPECT_EQ(read(head + "[evaluation]\npruning = false\n"), study);
  EXPECT_EQ(study_from_text(resolved_text(study), "resolved"), study);
  EXPECT_NE(identity_text(study).find("selection = \"steady_state\"\n"), std::string::npos);
  const std::string usual = "preset = \"paper\"\n[population]\nselection = \"generational\"\n";
  EXPECT_EQ(read(usual), read("preset = \"paper\"\n"));
  EXPECT_EQ(identity_text(read(usual)).find("selection"), std::string::npos) << "as archives without the key have it";
  expect_refused("preset = \"paper\"\n[population]\nselection = \"steady\"\n",
                 {"study.toml:3", "population.selection = \"steady\"", "generational"});
}

TEST_F(StudyFile, RefusesWithASteadyStateWhatWaitsForOthers) {
  const std::string head = "preset = \"paper\"\n[population]\nselection = \"steady_state\"\n";
  const std::string given = "study.toml: population.selection = \"steady_state\": cannot be combined with ";
  expect_refused(head + "[map_elites]\n", {given + "[map_elites]"});
  expect_refused(head + "[check_dt]\n", {given + "[check_dt]"});
  expect_refused(head + "[evaluation]\nduplicates = \"redrawn\"\n", {given + "evaluation.duplicates = \"redrawn\""});
  expect_refused(head + "mutants = 0\nnewcomers = 0\n", {given + "population.mutants = 0 and newcomers = 0"});
  expect_refused(head + "[evaluation]\npruning = true\n",
                 {"study.toml:5", "evaluation.pruning = true", "must be false", "population.selection = \"steady_state\""});
}

TEST_F(StudyFile, RefusesALevelThatWouldNotFitTheMemory) {
  io::write_whole(folder_ / "study.toml", "preset = \"paper\"\n");
  EXPECT_NO_THROW((void)read_study(folder_ / "study.toml", {}, std::size_t{1} << 30));
  EXPECT_THROW((void)read_study(folder_ / "study.toml", {}, std::size_t{1} << 20), io::InputError);
}

TEST_F(StudyFile, StudiesOfThePaperAreValid) {
  const auto plan_of = [](const std::string& name) {
    return read_study(paper / name / "study.toml").search.offspring.decoder.plan;
  };
  EXPECT_EQ(plan_of("fractal"), BodyPlan::fractal);
  EXPECT_EQ(plan_of("non_fractal"), BodyPlan::nonfractal);
  EXPECT_EQ(read_study(paper / "phase_wave/study.toml").physics.actuation.mode, voxel::ActuationMode::wave);
  EXPECT_EQ(read_study(paper / "single_actuator/study.toml").physics.actuation.mode, voxel::ActuationMode::in_phase);
  EXPECT_EQ(read_study(paper / "demo/study.toml").search.generations, 8);
  for (const std::string name : {"fractal", "non_fractal", "phase_wave", "single_actuator"}) {
    Study full = read_study(paper / name / "study.toml");
    const Study small = read_study(paper / name / "small.toml");
    EXPECT_EQ(full.search.generations, 325);
    EXPECT_EQ(full.duration_s, 5.0);
    // The small study differs in size only.
    full.search.generations = small.search.generations;
    full.search.survivors = small.search.survivors;
    full.search.mutants = small.search.mutants;
    full.search.offspring.constraints.levels = small.search.levels();
    full.duration_s = small.duration_s;
    EXPECT_EQ(full, small) << name;
  }
}

TEST_F(StudyFile, NotesThatPoissonsRatioIsNotThePapers) {
  const auto notes = study_notes(read("preset = \"paper\"\n"));
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("0.5"), std::string::npos);
}

TEST_F(StudyFile, NotesWhatKeepsAGraphicsProcessorIdle) {
  const auto noted = [&](const std::string& evaluation, const std::string& text) {
    const auto notes = study_notes(read("preset = \"paper\"\n[evaluation]\n" + evaluation));
    return std::ranges::any_of(notes, [&](const std::string& note) { return note.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(noted("device = \"cuda\"\n", "pruning = false"));
  EXPECT_FALSE(noted("device = \"cuda\"\npruning = false\n", "graphics processor"));
  EXPECT_FALSE(noted("device = \"cpu\"\n", "graphics processor"));
  EXPECT_FALSE(noted("device = \"cuda\"\n[population]\nselection = \"steady_state\"\n", "graphics processor"));
}

// A schema knows each key alone; which go together only the reader knows.
TEST(StudiesOfTheTree, CanBeRead) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MENGER_SOURCE_DIR "/paper")) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".toml" || file.parent_path().filename() == "presets") continue;
    if (io::read_whole(file).find("\npreset = ") == std::string::npos) continue;
    ++count;
    EXPECT_NO_THROW((void)read_study(file)) << file;
  }
  EXPECT_GT(count, 20U);
}

}  // namespace
}  // namespace menger::evolution
