// Studies whose bodies walk on finite elements.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using tests::walking_study_text;

const std::string with_parameters =
    "preset = \"paper\"\n[evaluation]\nmodel = \"finite_elements\"\nstand = true\n[body]\nlevels = [1]\ncell_edge_m = 0.01\n"
    "[surrogate]\nparameters = \"" MENGER_SOURCE_DIR
    "/voxel/parameters/dragon_skin_10_1cm.toml\"\noutside_range = \"warn\"\n"
    "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 3\n";

class SiliconeStudy : public testing::Test {
 protected:
  [[nodiscard]] Study read(const std::string& text = walking_study_text()) const {
    return tests::read_walking_study(folder_ / "study.toml", text);
  }
  void expect_refused(const std::string& text, const std::string& fault) const {
    const std::string message = tests::message_of([&] { (void)read(text); });
    EXPECT_NE(message.find(fault), std::string::npos) << message;
    EXPECT_NE(message.find("study.toml"), std::string::npos) << message;
  }
  [[nodiscard]] static std::string changed(const std::string& from, const std::string& to,
                                           std::string text = walking_study_text()) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  const tests::TestFolder folder_;
};

TEST_F(SiliconeStudy, NeedsNoParametersOfASurrogate) {
  const Study study = read();
  EXPECT_EQ(study.model, EvaluationModel::finite_elements);
  EXPECT_FALSE(study.physics.surrogate);
  EXPECT_EQ(study.silicone.elements.kind, fem::ElementKind::thin_wall);
  EXPECT_EQ(study.silicone.elements.fidelity, fem::Fidelity::draft);
  EXPECT_EQ(study.silicone.elements.precision, fem::Precision::single_precision);
  EXPECT_EQ(study.silicone.silicone.law.record->name, "Dragon Skin 10");
  const HollowModule module = module_of(study);
  EXPECT_EQ(module.wall_thickness_m, 0.002);
  EXPECT_EQ(module.chambers, meshes::ChamberLayout::single);
  EXPECT_EQ(module.pressure_Pa, (std::array{0.0, 6000.0}));
  EXPECT_EQ(study.physics.actuation.ramp_s, 0.025) << "a period";
  EXPECT_EQ(read(walking_study_text("", "ramp_s = 0\n")).physics.actuation.ramp_s, 0.0);
}

TEST_F(SiliconeStudy, IsReadBackFromItsTextWithoutTheSilicone) {
  for (const std::string more :
       {"", "youngs_modulus_Pa = 2e5\n", "[elements]\nkind = \"three_field\"\nelements_through_wall = 2\n"}) {
    const Study study = read(walking_study_text("", "", more));
    const Study archived = study_from_text(resolved_text(study), "archive");
    EXPECT_EQ(archived, study);
    EXPECT_FALSE(archived.silicone.silicone.law.record);
    EXPECT_EQ(evaluator_of(archived)->physics(), evaluator_of(study)->physics());
  }
  const Study shared = read(with_parameters);
  EXPECT_EQ(study_from_text(resolved_text(shared), "archive"), shared);
}

TEST_F(SiliconeStudy, NothingIsConfirmedWhereNoElementsAreFiner) {
  const std::string note = "it does not confirm the best robots";
  const auto says_so = [&](const Study& study) {
    return std::ranges::any_of(study_notes(study), [&](const std::string& one) { return one.find(note) != std::string::npos; });
  };
  EXPECT_FALSE(says_so(read(walking_study_text())));
  for (const std::string elements : {"kind = \"three_field\"", "fidelity = \"fine\""}) {
    const std::string text = walking_study_text("", "", "[elements]\n" + elements + "\n");
    const Study silent = read(changed("confirm = 0\n", "", text));
    EXPECT_EQ(silent.confirm, 0U);
    EXPECT_TRUE(says_so(silent));
    EXPECT_EQ(study_from_text(resolved_text(silent), "text"), silent);
    for (const std::string word : {"study.toml", "evaluation.confirm = 2", elements.c_str()})
      expect_refused(changed("confirm = 0", "confirm = 2", text), word);
  }
  EXPECT_EQ(read(changed("confirm = 0\n", "", walking_study_text())).confirm, 3U);
}

TEST_F(SiliconeStudy, ConfirmationIsNoPartOfTheIdentityAndTheLeanIs) {
  const std::string last = "measure = \"last_periods\"\n";
  const auto of = [&](const std::string& evaluation) {
    return read(changed("duration_s = 0.05", "duration_s = 0.15", walking_study_text(evaluation)));
  };
  const Study study = of(last);
  EXPECT_EQ(study.largest_lean_deg, 45.0);
  Study other = study;
  other.confirm = 9;
  EXPECT_EQ(identity_text(other), identity_text(study));
  EXPECT_NE(resolved_text(other), resolved_text(study));
  EXPECT_EQ(study_from_text(resolved_text(other), "text"), other);
  EXPECT_NE(identity_text(of(last + "largest_lean_deg = 60\n")), identity_text(study));
  expect_refused(walking_study_text("largest_lean_deg = 60\n"), "belongs to measure = \"last_periods\"");
  expect_refused(changed("confirm = 0", "confirm = -1"), "evaluation.confirm = -1");
  expect_refused("preset = \"paper\"\n[evaluation]\nconfirm = 1\n", "belongs to model = \"finite_elements\" or \"both\"");
  // Voxels tell falls, too.
  const Study of_voxels = read("preset = \"paper\"\n[evaluation]\n" + last);
  EXPECT_EQ(of_voxels.largest_lean_deg, 45.0);
  EXPECT_NE(evaluator_of(of_voxels)->physics().find("largest_lean_deg = 45\n"), std::string::npos);
  // Without falls, it is the study of an archive from before voxels told them.
  const Study silent = read("preset = \"paper\"\n[evaluation]\n" + last + "largest_lean_deg = 180\n");
  EXPECT_EQ(identity_text(silent).find("lean"), std::string::npos);
  EXPECT_NE(resolved_text(silent).find("largest_lean_deg = 180\n"), std::string::npos);
  // An archive from before bodies could fall.
  std::string text = identity_text(study);
  const std::string line = "largest_lean_deg = 45\n";
  ASSERT_NE(text.find(line), std::string::npos) << text;
  const fs::path file = folder_ / "earlier.sqlite";
  { const RunArchive made = RunArchive::open(file, text.erase(text.find(line), line.size()), 2); }
  const Study archived = archived_study(RunArchive::open_to_read(file));
  EXPECT_EQ(archived.largest_lean_deg, 180.0);
  EXPECT_EQ(evaluator_of(archived)->physics().find("lean"), std::string::npos) << "its results are found by the physics of then";
}

TEST_F(SiliconeStudy, SharesTheValuesOfASurrogate) {
  const Study study = read(with_parameters);
  ASSERT_TRUE(study.physics.surrogate);
  EXPECT_EQ(module_of(study).wall_thickness_m, study.physics.surrogate->parameters.wall_thickness_m);
  EXPECT_EQ(module_of(study).pressure_Pa, (std::array{0.0, 6000.0}));
  EXPECT_EQ(materials::law_line(study.silicone.silicone.law.law), study.physics.surrogate->parameters.law);
  EXPECT_EQ(study.silicone.silicone.law.record->name, "Dragon Skin 10");
  expect_refused(changed("cell_edge_m = 0.01\n", "cell_edge_m = 0.01\nwall_thickness_m = 0.002\n", with_parameters),
                 "body.wall_thickness_m = 0.002: belongs to evaluation.model = \"finite_elements\" without [surrogate]");
  // One key chooses the model of a study with calibrated parameters.
  const Study voxels = read(changed("model = \"finite_elements\"", "model = \"voxels\"", with_parameters));
  EXPECT_EQ(voxels.physics, study_from_text(resolved_text(voxels), "archive").physics);
  EXPECT_NE(evaluator_of(voxels)->physics(), evaluator_of(study)->physics());
}

TEST_F(SiliconeStudy, CommandLineOverridesTheFile) {
  for (const std::string& text : {walking_study_text(), with_parameters}) {
    io::write_whole(folder_ / "study.toml", text);
    const Study study =
        read_study(folder_ / "study.toml", {.generations = 7, .levels = {}, .duration_s = 0.125, .seed = 9, .device = {}});
    EXPECT_EQ(study.search.generations, 7);
    EXPECT_EQ(study.duration_s, 0.125);
    EXPECT_EQ(study.silicone, read(text).silicone);
    EXPECT_EQ(study.physics, read(text).physics);
  }
}

TEST_F(SiliconeStudy, RefusesWhatFiniteElementsCannotDo) {
  expect_refused(changed("duration_s = 0.05", "duration_s = 3600"), "makes more than a million records");
  expect_refused(changed("levels = [1]", "levels = [1, 2]"), "body.levels: must be [1], single modules, or [2]");
  expect_refused(changed("levels = [1]", "levels = [3]"), "body.levels: must be [1], single modules, or [2]");
  expect_refused(changed("levels = [1]", "levels = [2]", walking_study_text("", "", "[genome]\nencoding = \"nonfractal\"\n")),
                 "body.levels = [2]: genome.encoding = \"nonfractal\" needs voxels");
  expect_refused(
      changed("levels = [1]", "levels = [2]", changed("model = \"finite_elements\"", "model = \"both\"", with_parameters)),
      "body.levels = [2]: evaluation.model = \"both\" needs [1]");
  expect_refused(changed("levels = [1]", "levels = [2]", walking_study_text("device = \"cuda\"\n")),
                 "body.levels = [2]: evaluation.device = \"cuda\" needs [1]");
  expect_refused(changed("levels = [1]", "levels = [1]\nlargest_body_cells = 2"), "must be at least smallest_body_cells = 3");
  expect_refused(changed("stand = true", "stand = false"), "evaluation.stand = false: must be true");
  expect_refused(changed("wall_thickness_m = 0.002", "wall_thickness_m = 0.005"),
                 "wall_thickness_m = 0.005: must be less than half");
  expect_refused(changed("mode = \"in_phase\"", "mode = \"antiphase\""),
                 "drive.mode = \"antiphase\": with chambers = \"single\"");
  expect_refused(changed("mode = \"in_phase\"", "mode = \"wave\""), "drive.mode = \"wave\"");
  expect_refused(changed("pressure_Pa = [0, 6000]\n", ""), "drive.pressure_Pa");
  expect_refused(changed("pressure_Pa = [0, 6000]", "pressure_Pa = [6000, 0]"), "must ascend");
  expect_refused(changed("pressure_Pa = [0, 6000]", "pressure_Pa = [-123456, 0]"),
                 "finite elements refuse all bodies: drive.pressure_Pa: -123456: reaches a perfect vacuum or less");
  expect_refused(changed("silicone = \"dragon_skin_10\"\n", ""), "give a silicone or a law");
  expect_refused(changed("dragon_skin_10", "dragon_skin"), "material.silicone");
  expect_refused(walking_study_text("", "", "[ground]\npresent = false\n"), "ground.present = false");
  expect_refused(walking_study_text("", "", "[ground]\nkinetic_friction = 2\n"), "kinetic_friction = 2: must be at most");
  expect_refused(walking_study_text("", "", "[materials.material_1]\nstatic_friction = 0.9\n"), "the same friction");
  expect_refused(walking_study_text("", "", "[collisions]\nexclusion_depth = 2\n"), "belongs to bodies that move as voxels");
  expect_refused(walking_study_text("", "amplitude = 0.125\n"), "drive.amplitude = 0.125: belongs to bodies that move as voxels");
  expect_refused(walking_study_text("", "", "[elements]\nfidelity = \"coarse\"\n"), "elements.fidelity");
  expect_refused(walking_study_text("", "", "[elements]\nelements_through_wall = 2\n"), "kind = \"three_field\"");
  expect_refused(walking_study_text("", "", "[reference]\nstudy = \"a.toml\"\n"), "[evaluation] model = \"both\"");
  expect_refused(walking_study_text("measure = \"last_periods\"\n"),
                 "evaluation.measure_periods = 5: time.duration_s = 0.05 must hold");
  expect_refused(walking_study_text("measure = \"last_periods\"\nmeasure_periods = 4\n"), "measure_periods = 4: must be >= 5");
  expect_refused(walking_study_text("measure_periods = 5\n"), "belongs to measure = \"last_periods\"");
  const std::string voxels = "preset = \"paper\"\n";
  expect_refused(voxels + "[elements]\nfidelity = \"draft\"\n", "belongs to evaluation.model = \"finite_elements\"");
  expect_refused(voxels + "[material]\nsilicone = \"dragon_skin_10\"\n", "belongs to evaluation.model = \"finite_elements\"");
  expect_refused(voxels + "[evaluation]\nmodel = \"elements\"\n", "evaluation.model = \"elements\"");
}

TEST_F(SiliconeStudy, LastPeriodsCountAfterTheFirstAndAfterTheTimeThatIsLeftOut) {
  const auto study = [](const std::string& duration, const std::string& more = "") {
    return changed("duration_s = 0.05", "duration_s = " + duration + more, walking_study_text("measure = \"last_periods\"\n"));
  };
  EXPECT_EQ(read(study("0.15")).measure_periods, 5U);
  expect_refused(study("0.149"), "must hold one whole period more");
  EXPECT_NO_THROW((void)read(study("0.15", "\nmeasure_from_s = 0.025")));
  expect_refused(study("0.15", "\nmeasure_from_s = 0.03"), "begin before time.measure_from_s = 0.03");
  EXPECT_NE(identity_text(read(study("0.15"))), identity_text(read(changed("duration_s = 0.05", "duration_s = 0.15"))));
}

TEST_F(SiliconeStudy, TellsWhatIsNotMeasured) {
  const auto count = [&](const Study& study, const std::string& words) {
    const std::vector<std::string> notes = study_notes(study);
    return std::ranges::count_if(notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  const Study study = read();
  EXPECT_EQ(count(study, "damping of Dragon Skin 10 is not measured"), 1);
  EXPECT_EQ(count(study, "friction of Dragon Skin 10 on a ground is not measured, that of silicones lies between 0.25 and 1 ("),
            1);
  EXPECT_EQ(count(study, "bulk_modulus_ratio = 50 is assumed"), 1);
  EXPECT_EQ(count(study, "Poisson"), 0);
  EXPECT_EQ(count(study, "cannot be cast"), 0);
  EXPECT_EQ(count(read(changed("castable = true\n", "")), "cannot be cast"), 1);
  EXPECT_EQ(count(read(walking_study_text("", "", "bulk_modulus_ratio = 50\n")), "is assumed"), 0);
  EXPECT_EQ(count(read(with_parameters), "damping of Dragon Skin 10 is not measured"), 1);
  EXPECT_EQ(count(read(changed("duration_s = 0.05", "duration_s = 0.15", walking_study_text("measure = \"last_periods\"\n"))),
                  "displacement in one period"),
            1);
}

TEST_F(SiliconeStudy, NamesTheFilesThatDecideIt) {
  (void)read();
  EXPECT_EQ(study_inputs(folder_ / "study.toml"),
            (std::vector<fs::path>{folder_ / "study.toml", materials::silicone_of_menger("dragon_skin_10").value()}));
}

TEST_F(SiliconeStudy, TellsHowFarAFitnessWalks) {
  EXPECT_EQ(walked_body_lengths(read(), 0.3), 0.3);
  const Study periods =
      read(changed("duration_s = 0.05", "duration_s = 0.15", walking_study_text("measure = \"last_periods\"\n")));
  const double walked = walked_body_lengths(periods, 0.02).value_or(0.0);
  EXPECT_DOUBLE_EQ(walked, 0.02 * 0.15 / periods.physics.actuation.period_s());
  Study area = periods;
  area.search.objective = Objective::squared_metres_per_scale;
  EXPECT_FALSE(walked_body_lengths(area, 0.02));
}

}  // namespace
}  // namespace menger::evolution
