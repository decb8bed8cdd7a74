// Studies in which voxels screen bodies for finite elements.

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

/// A study whose voxels have the parameters that come with menger. @param evaluation, more further keys and tables
std::string screened(const std::string& evaluation = "", const std::string& more = "") {
  return "preset = \"paper\"\n[evaluation]\nmodel = \"both\"\nstand = true\n" + evaluation +
         "[body]\nlevels = [1]\ncell_edge_m = 0.01\ncastable = true\n[time]\nduration_s = 0.05\n"
         "[surrogate]\nparameters = \"" MENGER_SOURCE_DIR
         "/voxel/parameters/dragon_skin_10_1cm.toml\"\noutside_range = \"warn\"\n"
         "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 40\n" +
         more;
}

class ScreenedStudy : public testing::Test {
 protected:
  [[nodiscard]] Study read(const std::string& text) const { return tests::read_walking_study(folder_ / "study.toml", text); }
  void expect_refused(const std::string& text, const std::string& fault) const {
    const std::string message = tests::message_of([&] { (void)read(text); });
    EXPECT_NE(message.find(fault), std::string::npos) << message;
  }

  const tests::TestFolder folder_;
};

TEST_F(ScreenedStudy, HasVoxelsAndFiniteElementsOfTheSameBodies) {
  const Study study = read(screened("drawn_share = 0.25\nleast_passing_share = 0.5\n"));
  EXPECT_EQ(study.search.screening, (ScreeningPlan{.least_share = 0.5, .drawn_share = 0.25}));
  EXPECT_EQ(study_from_text(resolved_text(study), "archive"), study);
  const auto elements = evaluator_of(study);
  const auto voxels = screening_evaluator_of(study);
  ASSERT_TRUE(voxels);
  EXPECT_NE(elements->physics(), voxels->physics());
  const std::atomic<bool> never{false};
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "110000000100000000000000000");
  EXPECT_GT(elements->evaluate(body, 1, never).elements, 0U);
  EXPECT_EQ(voxels->evaluate(body, 1, never).elements, 0U);
  // Finite elements alone, or voxels alone, give the same results.
  std::string alone = screened();
  alone.replace(alone.find("\"both\""), 6, "\"finite_elements\"");
  EXPECT_EQ(evaluator_of(read(alone))->physics(), elements->physics());
  alone.replace(alone.find("\"finite_elements\""), 17, "\"voxels\"");
  EXPECT_EQ(evaluator_of(read(alone))->physics(), voxels->physics());
  EXPECT_FALSE(screening_evaluator_of(read(alone)));
  EXPECT_FALSE(read(alone).search.screening);
}

TEST_F(ScreenedStudy, SharesBelongToTheIdentity) {
  EXPECT_NE(identity_text(read(screened())), identity_text(read(screened("drawn_share = 0.25\n"))));
  EXPECT_NE(identity_text(read(screened())), identity_text(read(screened("least_passing_share = 0.25\n"))));
}

TEST_F(ScreenedStudy, IsRefusedWithoutParametersForTheSilicone) {
  std::string text = tests::walking_study_text();
  text.replace(text.find("\"finite_elements\""), 17, "\"both\"");
  expect_refused(text, "evaluation.model = \"both\": needs parameters of voxels for this silicone");
  expect_refused(text, "menger comes with some: parameters = \"dragon_skin_10_1cm\"");
  const std::string other = screened("", "[material]\nsilicone = \"ecoflex_00_30\"\n");
  expect_refused(other, "the silicone of [material] is");
  expect_refused(other, "menger loop NAME/robot.toml --until calibrate");
  expect_refused(screened("drawn_share = 0\n"), "drawn_share = 0");
  expect_refused(screened("least_passing_share = 2\n"), "least_passing_share = 2");
  expect_refused("preset = \"paper\"\n[evaluation]\ndrawn_share = 0.2\n", "belongs to model = \"both\"");
  expect_refused(screened("", "[population]\nselection = \"steady_state\"\n"),
                 "population.selection = \"steady_state\": cannot be combined with evaluation.model = \"both\"");
}

}  // namespace
}  // namespace menger::evolution
