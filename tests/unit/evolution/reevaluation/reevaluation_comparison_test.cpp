#include "evolution/reevaluation/reevaluation_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "evolution/genome/balance.h"
#include "evolution/reevaluation/reevaluation_chart.h"
#include "evolution/reevaluation/reevaluation_table.h"
#include "tests/support/silicone_archive.h"

namespace menger::evolution {
namespace {

using Vector = std::array<double, 3>;

/// A study of two seconds with bodies of 3 cm. A displacement below 3 mm has no direction.
ReevaluationStudy some_study() {
  ReevaluationStudy study;
  study.search = tests::silicone_study();
  study.duration_s = 2.0;
  study.least_body_lengths = 0.1;
  study.top = 2;
  return study;
}

ReevaluatedDesign evaluated(std::size_t rank, double surrogate_m, double elements_m, bool is_top = true) {
  ReevaluatedDesign design;
  design.design.rank = rank;
  design.design.is_top = is_top;
  design.design.body = meshes::Polycube::from_digits(3, 3, 3, "111000000000000000000000000");
  design.design.phenotype.body = design.design.body;
  design.surrogate.result.status = io::RunStatus::completed;
  design.surrogate.result.displacement_m = Vector{surrogate_m, 0.0, 0.0};
  design.elements.status = io::RunStatus::completed;
  design.elements.displacement_m = Vector{0.0, elements_m, 0.0};
  return design;
}

TEST(ReevaluationComparison, SpeedsAreOverTheTimeThatCounts) {
  ReevaluationStudy study = some_study();
  const Motion whole = motion_of(study, {0.0, 0.03, 0.5});
  EXPECT_DOUBLE_EQ(whole.body_lengths, 1.0);
  EXPECT_DOUBLE_EQ(whole.body_lengths_per_minute, 30.0);
  EXPECT_DOUBLE_EQ(whole.direction_deg.value(), 90.0);
  study.measure_from_s = 0.5;
  EXPECT_DOUBLE_EQ(motion_of(study, {0.0, 0.03, 0.5}).body_lengths_per_minute, 40.0);
  EXPECT_DOUBLE_EQ(motion_of(study, {-0.03, -0.0, 0.0}).direction_deg.value(), 180.0);
  EXPECT_FALSE(motion_of(study, {0.0029, 0.0, 0.0}).direction_deg) << "too little for a direction";
}

TEST(ReevaluationComparison, AnglesAndChangesAreHorizontalAndNeedADistance) {
  EXPECT_NEAR(angle_between_deg({1.0, 0.0, 5.0}, {-1.0, 1.0, 0.0}, 0.1).value(), 135.0, 1e-12);
  EXPECT_NEAR(angle_between_deg({0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}, 0.1).value(), 0.0, 1e-12);
  EXPECT_FALSE(angle_between_deg({0.05, 0.0, 9.0}, {1.0, 0.0, 0.0}, 0.1));
  EXPECT_FALSE(angle_between_deg({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0));
  EXPECT_NEAR(relative_change({3.0, 4.0, 0.0}, {0.0, 0.0, 7.0}, 0.1).value(), 1.0, 1e-12);
  EXPECT_NEAR(relative_change({2.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, 0.1).value(), 0.5, 1e-12);
  EXPECT_FALSE(relative_change({0.05, 0.0, 0.0}, {2.0, 1.0, 0.0}, 0.1));
}

TEST(ReevaluationComparison, DistancesThatAreTooSmallAreTies) {
  const ReevaluationStudy study = some_study();
  // On finite elements, the order below 3 mm is opposite to the surrogate's, and above 3 mm it agrees.
  const std::vector<ReevaluatedDesign> designs{evaluated(1, 0.03, 0.02), evaluated(2, 0.02, 0.01), evaluated(3, 0.01, 1e-17),
                                               evaluated(4, 0.009, 1e-14), evaluated(5, 0.008, 2e-3)};
  const Ranking ranking = rank_all(study, designs).front();
  // Ranks 5 4 3 2 1 against 5 4 2 2 2: covariance 8, variances 10 and 8; with 5 4 1 2 3 it would be 0.6.
  EXPECT_NEAR(ranking.spearman.value().value, 8.0 / std::sqrt(80.0), 1e-12);
}

TEST(ReevaluationComparison, WhereTheBestAreAllNothingCanBeLost) {
  const ReevaluationStudy study = some_study();
  const std::vector<ReevaluatedDesign> two{evaluated(1, 0.03, 0.02), evaluated(2, 0.02, 0.03)};
  const Ranking all = rank_all(study, two).front();
  EXPECT_EQ(all.k, 2U);
  EXPECT_FALSE(all.best_of_k) << "the best two of two";
  EXPECT_NEAR(all.best.value().regret, 10.0, 1e-9) << "20 for 30 body lengths per minute";
  std::vector<ReevaluatedDesign> three = two;
  three.push_back(evaluated(3, 0.01, 0.04));
  EXPECT_NEAR(rank_all(study, three).front().best_of_k.value().regret, 10.0, 1e-9);
}

TEST(ReevaluationComparison, TheSampleComesFirstAndThoseThatStandAreRankedByThemselves) {
  const ReevaluationStudy study = some_study();
  std::vector<ReevaluatedDesign> designs{evaluated(1, 0.03, 0.02), evaluated(2, 0.02, 0.03), evaluated(4, 0.01, 0.01, false),
                                         evaluated(6, 0.01, 0.02, false)};
  designs[1].is_balanced = false;
  const std::vector<Ranking> rankings = rank_all(study, designs);
  ASSERT_EQ(rankings.size(), 4U);
  EXPECT_EQ(rankings[0].name, "sample");
  EXPECT_EQ(rankings[1].name, "top");
  EXPECT_EQ(rankings[2].name, "balanced");
  EXPECT_EQ(rankings[2].evaluated, 3U);
  EXPECT_EQ(rankings[3].name, "all");
}

TEST(ReevaluationText, SaysWhatBothModelsSaidOfEveryRobot) {
  const ReevaluationStudy study = some_study();
  ReevaluationFindings findings;
  findings.designs = {evaluated(1, 0.03, 0.02), evaluated(2, 0.02, 0.03)};
  findings.designs[1].surrogate.result.status = io::RunStatus::diverged;
  findings.designs[1].surrogate.result.displacement_m.reset();
  findings.designs[1].surrogate.result.reason = "voxel 3 too fast";
  findings.designs[1].is_balanced = false;
  findings.distinct = 9;
  findings.refused = {{.individual = 4, .phenotype = "", .fitness = 0.5, .rank = 3, .reason = "weak contact"}};
  findings.rankings = rank_all(study, findings.designs);
  const std::string text = findings_text(study, findings);
  for (const char* words : {"2 of 9 robots re-evaluated for 2 s", "surrogate diverged: voxel 3 too fast", "falls over by itself",
                            "(rank 3): weak contact", "1 of 2 designs completed in both models"})
    EXPECT_NE(text.find(words), std::string::npos) << text << "\ndoes not say: " << words;
}

TEST(ReevaluationText, NamesNoBestWhereNoneGoesFarEnough) {
  const ReevaluationStudy study = some_study();
  ReevaluationFindings findings;
  findings.designs = {evaluated(1, 0.03, 0.001), evaluated(2, 0.02, 0.002)};
  findings.rankings = rank_all(study, findings.designs);
  EXPECT_FALSE(findings.rankings.front().best);
  const std::string text = findings_text(study, findings);
  EXPECT_NE(text.find("none of them goes 0.1 body lengths on finite elements, the least that is ranked"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("loses"), std::string::npos) << text;
}

TEST(ReevaluationText, SaysThatOnePeriodIsMeasured) {
  ReevaluationStudy study = some_study();
  ReevaluationFindings findings;
  findings.designs = {evaluated(1, 0.03, 0.02)};
  findings.rankings = rank_all(study, findings.designs);
  EXPECT_EQ(findings_text(study, findings).find("in one period"), std::string::npos);
  study.search.measure = Measure::last_periods;
  study.search.measure_periods = 4;
  const std::string text = findings_text(study, findings);
  EXPECT_NE(text.find("re-evaluated for 2 s (displacement in one period of the last 4), body lengths"), std::string::npos)
      << text;
}

TEST(ReevaluationChart, HasAPointPerDesignThatCompletedInBothModels) {
  const ReevaluationStudy study = some_study();
  ReevaluationFindings findings;
  findings.designs = {evaluated(1, 0.03, 0.02), evaluated(2, 0.02, 0.03)};
  findings.designs[1].elements.displacement_m.reset();
  const io::Chart chart = scatter_chart(study, findings);
  ASSERT_EQ(chart.panels.size(), 2U);
  std::size_t points = 0;
  for (const io::ChartSeries& series : chart.panels[0].series)
    if (series.marks == io::Marks::points) points += series.x.size();
  EXPECT_EQ(points, 1U);
  ASSERT_EQ(chart.panels[1].markers.size(), 2U);
  for (const io::ChartMarker& marker : chart.panels[1].markers)
    EXPECT_NE(marker.label, "") << "a line without a name says nothing";
}

TEST(ReevaluationChart, HasItsTrajectoriesInBodyLengths) {
  const ReevaluationStudy study = some_study();
  for (const io::ChartPanel& panel : trajectories_chart(study, evaluated(1, 0.03, 0.02)).panels)
    EXPECT_TRUE(panel.y.title.ends_with("(body lengths)")) << panel.y.title;
}

meshes::Polycube layers(const std::string& first, const std::string& second, const std::string& third) {
  return meshes::Polycube::from_digits(3, 3, 3, first + second + third);
}

TEST(Balance, ABodyWhoseCentreIsBesideItsFootFallsOver) {
  EXPECT_TRUE(is_balanced(layers("111111111", "000000000", "000000000")));
  EXPECT_TRUE(is_balanced(layers("010000000", "010000000", "010000000"))) << "a post";
  // A beam of three cells with a foot at one end: the centre is one cell beside the foot.
  EXPECT_FALSE(is_balanced(layers("100000000", "111000000", "000000000")));
  EXPECT_FALSE(is_balanced(layers("100000000", "100000000", "111000000"))) << "the centre at 1.1 cells, the foot ends at 1";
  EXPECT_TRUE(is_balanced(layers("101000000", "111000000", "000000000"))) << "two feet, the centre between them";
  EXPECT_TRUE(is_balanced(layers("000000000", "111000000", "010000000"))) << "in a higher layer it stands as well";
}

}  // namespace
}  // namespace menger::evolution
