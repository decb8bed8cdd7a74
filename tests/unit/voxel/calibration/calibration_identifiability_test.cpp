#include <gtest/gtest.h>

#include "tests/unit/voxel/calibration/calibration_samples.h"
#include "voxel/calibration/identifiability.h"

namespace menger::voxel {
namespace {

std::vector<FittedParameter> parameters_of(const CalibrationProblem& problem) {
  return fitted_parameters(samples::by_class, determined_classes(problem), problem.bounds, problem.start);
}

TEST(Identifiability, LikelyHitsCutTheTailsOfTheBinomialDistribution) {
  // sums of C(n, k) 0.95^k 0.05^(n - k): P(hits <= 33 of 40) = 0.0034, <= 34: 0.0139; P(40 of 40) = 0.1285
  EXPECT_EQ(likely_hits(40, 0.95), (std::pair{34, 40}));
  // of a fair coin thrown ten times: P(0) = 0.00098, P(<= 1) = 0.0107
  EXPECT_EQ(likely_hits(10, 0.5), (std::pair{1, 9}));
}

TEST(Identifiability, IntervalsHoldTheTruthAsOftenAsTheyClaim) {
  const CalibrationProblem problem = samples::problem(samples::noisy_curves(samples::truth(), 1, 0.0));
  const std::vector<FittedParameter> parameters = parameters_of(problem);
  const Identifiability result =
      identifiability(problem.curves, parameters, samples::truth(), problem.responder, {.fit_count = 200, .seed = 1000});
  EXPECT_EQ(result.fit_count, 200);
  EXPECT_EQ(result.failed_count, 0);
  ASSERT_EQ(result.coverage.size(), parameters.size());
  int outside = 0;
  for (const Coverage& coverage : result.coverage) {
    EXPECT_GE(coverage.interval_count, 195) << coverage.name;
    const auto [lowest, highest] = likely_hits(coverage.interval_count, 0.95);
    if (coverage.hit_count < lowest || coverage.hit_count > highest) ++outside;
    EXPECT_GE(coverage.hit_count, lowest - 3) << coverage.name;
    EXPECT_NEAR(coverage.mean, coverage.truth, 0.1 * std::abs(coverage.truth)) << coverage.name;
  }
  // each leaves its range by chance once in a hundred times; of fifteen, two at once are a matter of one in a hundred
  EXPECT_LE(outside, 1);
}

TEST(Identifiability, NoiseBeyondWhatIsStatedIsNoticed) {
  const CalibrationProblem problem = samples::problem(samples::noisy_curves(samples::truth(), 1, 0.0));
  int hits = 0;
  int intervals = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::vector<FittedCurve> curves = samples::noisy_curves(samples::truth(), seed, 1.5);
    const CalibrationFit fit = fit_parameters(curves, parameters_of(problem), samples::truth(), problem.responder);
    for (const FittedValue& value : fit.values) {
      if (!value.confidence_95) continue;
      const double truth = value_in(samples::truth(), value.parameter);
      ++intervals;
      hits += value.confidence_95->first <= truth && truth <= value.confidence_95->second ? 1 : 0;
    }
    // 1.5 times the noise is 2.25 times chi2; its 99 % quantile for about 140 degrees of freedom is 1.3 times as large
    EXPECT_FALSE(fit.explained) << "seed " << seed;
  }
  EXPECT_GT(hits, intervals * 9 / 10) << "and the intervals are widened to hold the truth all the same";
}

TEST(Identifiability, StopsWhenAskedTo) {
  const std::atomic<bool> stop{true};
  const CalibrationProblem problem = samples::problem(samples::noisy_curves(samples::truth(), 1, 0.0));
  const Identifiability result =
      identifiability(problem.curves, parameters_of(problem), samples::truth(), problem.responder, {.stop = &stop});
  EXPECT_EQ(result.fit_count, 0);
}

TEST(Identifiability, TableNamesWhatChanceLeaves) {
  Identifiability result;
  result.coverage.push_back({.name = "axial_Pa", .truth = 2.0, .mean = 2.5, .interval_count = 40, .hit_count = 38});
  EXPECT_EQ(identifiability_table(result).text(),
            "parameter,truth,mean,intervals,hits,lowest_likely_hits,highest_likely_hits\naxial_Pa,2,2.5,40,38,34,40\n");
}

}  // namespace
}  // namespace menger::voxel
