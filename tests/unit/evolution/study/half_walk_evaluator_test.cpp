#include "evolution/study/half_walk_evaluator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "evolution/study/walk_evaluator.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

const std::atomic<bool> on{false};
const std::atomic<bool> stopped{true};

meshes::Polycube small_hook() { return meshes::Polycube::from_digits(2, 1, 2, "1110"); }
meshes::Polycube short_bar() { return meshes::Polycube::from_digits(2, 1, 1, "11"); }

/// A study of six periods of which five are measured.
class HalfWalks : public testing::Test {
 protected:
  HalfWalks() : study_(tests::read_walking_study(folder_ / "study.toml")) {
    study_.measure = Measure::last_periods;
    study_.duration_s = 0.15;
  }

  const tests::TestFolder folder_;
  Study study_;
};

void expect_equal(const Evaluation& a, const Evaluation& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.displacement_m, b.displacement_m);
  EXPECT_EQ(a.left_out_m, b.left_out_m);
  EXPECT_EQ(a.period_displacements_m, b.period_displacements_m);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.fidelity, b.fidelity);
  EXPECT_EQ(a.reason, b.reason);
}

TEST_F(HalfWalks, MeasureThePeriodsThatTheyHave) {
  const Study half = first_half_of(study_);
  EXPECT_DOUBLE_EQ(half.duration_s, 0.075);
  EXPECT_EQ(half.measure_periods, 2U) << "the first one does not count";
  study_.duration_s = 0.425;
  EXPECT_DOUBLE_EQ(first_half_of(study_).duration_s, 0.2) << "eight of seventeen periods";
  EXPECT_EQ(first_half_of(study_).measure_periods, 5U);
}

TEST_F(HalfWalks, AreWhatShortWalksAre) {
  const Evaluation half = HalfWalkEvaluator(study_, nullptr).evaluate(small_hook(), 1, on);
  ASSERT_EQ(half.status, io::RunStatus::completed) << half.reason;
  EXPECT_EQ(half.period_displacements_m.size(), 3U);
  expect_equal(half, WalkEvaluator(first_half_of(study_)).evaluate(small_hook(), 1, on));
  EXPECT_NE(HalfWalkEvaluator(study_, nullptr).physics(), WalkEvaluator(first_half_of(study_)).physics());
}

TEST_F(HalfWalks, GoOnToTheSameResultAsWholeOnes) {
  const auto paused = std::make_shared<PausedWalks>(2);
  const HalfWalkEvaluator halves(study_, paused);
  const WalkEvaluator whole(study_, paused);
  const Evaluation half = halves.evaluate(small_hook(), 1, on);
  auto walk = paused->take(small_hook());
  ASSERT_TRUE(walk);
  EXPECT_EQ(walk->result().steps, half.steps);
  EXPECT_FALSE(paused->take(small_hook())) << "it is taken once";
  paused->put(small_hook(), std::move(walk));
  const Evaluation expected = WalkEvaluator(study_).evaluate(small_hook(), 1, on);
  EXPECT_EQ(whole.physics(), WalkEvaluator(study_).physics());
  expect_equal(whole.evaluate(small_hook(), 1, on), expected);
  EXPECT_GT(expected.steps, half.steps) << "the first half is among its steps";
  EXPECT_FALSE(paused->take(small_hook()));
  expect_equal(whole.evaluate(small_hook(), 1, on), expected);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(half.period_displacements_m[n], expected.period_displacements_m[n]);
}

TEST_F(HalfWalks, TheOldestOfTooManyIsDropped) {
  PausedWalks paused(1);
  paused.put(small_hook(), std::make_unique<WalkInParts>(walk_of(study_, small_hook(), 1)));
  paused.put(short_bar(), std::make_unique<WalkInParts>(walk_of(study_, short_bar(), 1)));
  EXPECT_FALSE(paused.take(small_hook()));
  EXPECT_TRUE(paused.take(short_bar()));
  paused.put(small_hook(), std::make_unique<WalkInParts>(walk_of(study_, small_hook(), 1)));
  EXPECT_TRUE(paused.take(small_hook())) << "what was taken needs no place";
}

TEST_F(HalfWalks, StopAndAreRefusedAsWholeOnes) {
  const auto paused = std::make_shared<PausedWalks>(2);
  const HalfWalkEvaluator halves(study_, paused);
  EXPECT_EQ(halves.evaluate(small_hook(), 1, stopped).status, io::RunStatus::stopped);
  EXPECT_FALSE(paused->take(small_hook()));
  ASSERT_EQ(halves.evaluate(small_hook(), 1, on).status, io::RunStatus::completed);
  EXPECT_EQ(WalkEvaluator(study_, paused).evaluate(small_hook(), 1, stopped).status, io::RunStatus::stopped);
  const meshes::Polycube apart = meshes::Polycube::from_digits(3, 1, 1, "101");
  expect_equal(halves.evaluate(apart, 1, on), WalkEvaluator(study_).evaluate(apart, 1, on));
}

TEST_F(HalfWalks, BelongToStudiesThatMeasureTheLastPeriodsOnFiniteElements) {
  const std::string six = "measure = \"last_periods\"\nshorter_walks = true\n";
  const auto read = [&](const std::string& evaluation) {
    std::string text = tests::walking_study_text(evaluation);
    text.replace(text.find("duration_s = 0.05"), 17, "duration_s = 0.15");
    return tests::read_walking_study(folder_ / "study.toml", text);
  };
  const Study study = read(six + "drawn_share = 0.3\n");
  ASSERT_TRUE(study.search.screening);
  EXPECT_EQ(study.search.screening->by, Screener::half_walks);
  EXPECT_EQ(study.search.screening->drawn_share, 0.3);
  EXPECT_EQ(study_from_text(resolved_text(study), "again.toml"), study);
  EXPECT_FALSE(read("measure = \"last_periods\"\n").search.screening);
  EXPECT_THROW((void)read("shorter_walks = true\n"), io::InputError) << "of the net displacement";
  EXPECT_THROW((void)read("measure = \"last_periods\"\ndrawn_share = 0.3\n"), io::InputError);
  std::string steady = tests::walking_study_text(six);
  steady.replace(steady.find("mutants = 3\n"), 12, "mutants = 3\nselection = \"steady_state\"\n");
  const std::string message = tests::message_of([&] { (void)tests::read_walking_study(folder_ / "study.toml", steady); });
  EXPECT_NE(message.find("population.selection = \"steady_state\": cannot be combined with evaluation.shorter_walks = true"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace menger::evolution
