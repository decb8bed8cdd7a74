#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "evolution/genome/offspring.h"

namespace menger::evolution {
namespace {

/// Counts over a large sample of random genomes with the options of the released program.
struct Figures {
  int draws = 0;
  int valid = 0;
  int several_consumers = 0;  ///< draws with a hidden node that feeds several consumers
  int changed = 0;            ///< valid ones whose phenotype changes if every consumer gets the activated value
  int full_cube = 0;
  int single_material = 0;
  int apart_at_level_two = 0;
};

bool feeds_several_consumers(const Cppn& network) {
  std::vector<int> consumers(network.nodes.size(), 0);
  for (const CppnEdge& edge : network.edges) ++consumers[edge.from];
  return std::any_of(consumers.begin() + static_cast<std::ptrdiff_t>(network.first_hidden()), consumers.end(),
                     [](int count) { return count > 1; });
}

Figures count_figures(const VariationOptions& variation, const ExpressionOptions& expression, int draws) {
  const ConstraintOptions constraints{3, 27, DisconnectedPolicy::allow, {1, 2, 3}};
  const DecoderOptions decoder{BodyPlan::fractal, expression};
  const DecoderOptions proper{BodyPlan::fractal, {Expression::every_consumer_activated, expression.axes}};
  RandomStream random(1, "figures");
  Figures figures;
  figures.draws = draws;
  for (int draw = 0; draw < draws; ++draw) {
    const Genome genome = random_genome(BodyPlan::fractal, variation, random);
    figures.several_consumers += feeds_several_consumers(genome.networks[0]) ? 1 : 0;
    const Phenotype phenotype = decode(genome, decoder);
    if (!is_valid(phenotype, constraints)) continue;
    ++figures.valid;
    figures.changed += decode(genome, proper) != phenotype ? 1 : 0;
    figures.full_cube += phenotype.body.count() == basal_cells ? 1 : 0;
    const std::string digits = phenotype.body.digits();
    figures.single_material += digits.find('1') == std::string::npos || digits.find('2') == std::string::npos ? 1 : 0;
    figures.apart_at_level_two += aggregate_is_connected(phenotype, 2) ? 0 : 1;
  }
  return figures;
}

constexpr int sample_size = 60000;

const Figures& released_figures() {
  static const Figures figures = count_figures({ActivationSet::released_code, OutputFunction::mutable_},
                                               {Expression::first_consumer_activated, AxisMap::zyx}, sample_size);
  return figures;
}

const Figures& paper_figures() {
  static const Figures figures = count_figures({ActivationSet::paper, OutputFunction::kept},
                                               {Expression::every_consumer_activated, AxisMap::xyz}, sample_size);
  return figures;
}

/// Checks a share of a sample against a published figure that is exact to `known_to`. The tolerance adds four standard deviations
/// of the sample.
void expect_share(const char* what, int count, int of, double figure, double known_to) {
  const double share = count / static_cast<double>(of);
  std::printf("%s: %.4f of %d\n", what, share, of);
  EXPECT_NEAR(share, figure, known_to + 4.0 * std::sqrt(figure * (1.0 - figure) / of)) << what;
}

// The figures were published in whole percent, hence they are exact to half a percent.
constexpr double whole_percent = 0.005;

TEST(PresetFigures, TheRememberedSumChangesTwentySevenPercentOfTheBodies) {
  const Figures& figures = released_figures();
  expect_share("changed by the remembered sum", figures.changed, figures.valid, 0.27, whole_percent);
}

TEST(PresetFigures, NinetySixPercentOfTheNetworksHaveANodeOfSeveralConsumers) {
  const Figures& figures = released_figures();
  expect_share("networks with a node of several consumers", figures.several_consumers, figures.draws, 0.96, whole_percent);
}

TEST(PresetFigures, EighteenToTwentyPercentOfTheBodiesFallApartAtLevelTwo) {
  const Figures& figures = released_figures();
  expect_share("bodies that fall apart at level 2", figures.apart_at_level_two, figures.valid, 0.19, 0.01);
}

TEST(PresetFigures, ThirtyNinePercentOfTheDrawsAreInvalid) {
  const Figures& figures = released_figures();
  expect_share("invalid draws", figures.draws - figures.valid, figures.draws, 0.39, whole_percent);
}

// 60 % full cubes and 72 % bodies of one material have been reported, for a sample whose size is not stated. 80,000 draws of an
// independent program (with dictionaries and the generator of Python, 49,276 valid bodies) give 57.70 % and 73.50 %. These are
// the references here, with four standard deviations of that sample.
TEST(PresetFigures, MostBodiesAreFullCubesAndOfOneMaterial) {
  constexpr double independent_sample = 49276.0;
  const auto scatter = [](double share) { return 4.0 * std::sqrt(share * (1.0 - share) / independent_sample); };
  const Figures& figures = released_figures();
  expect_share("full cubes", figures.full_cube, figures.valid, 0.57695, scatter(0.57695));
  expect_share("bodies of one material", figures.single_material, figures.valid, 0.73500, scatter(0.73500));
}

TEST(PresetFigures, ThePaperOptionsGiveMoreVariedBodies) {
  const Figures& paper = paper_figures();
  const Figures& released = released_figures();
  EXPECT_EQ(paper.changed, 0) << "nothing to change where every consumer gets the activated value";
  const auto share = [](int count, int of) { return count / static_cast<double>(of); };
  std::printf("paper: invalid %.4f, full %.4f, one material %.4f, apart %.4f\n", share(paper.draws - paper.valid, paper.draws),
              share(paper.full_cube, paper.valid), share(paper.single_material, paper.valid),
              share(paper.apart_at_level_two, paper.valid));
  EXPECT_GT(paper.valid, released.valid);
  EXPECT_LT(share(paper.full_cube, paper.valid), 0.5 * share(released.full_cube, released.valid));
  EXPECT_LT(share(paper.single_material, paper.valid), 0.5 * share(released.single_material, released.valid));
}

TEST(PresetFigures, KeepingTheOutputFunctionAloneChangesTheBodies) {
  const Figures kept = count_figures({ActivationSet::released_code, OutputFunction::kept},
                                     {Expression::first_consumer_activated, AxisMap::zyx}, sample_size / 3);
  const Figures& released = released_figures();
  // An output of one sign everywhere (absolute, square, root, their negatives) gives a full or an empty cube.
  EXPECT_LT(kept.full_cube / static_cast<double>(kept.valid), 0.5 * released.full_cube / static_cast<double>(released.valid));
}

}  // namespace
}  // namespace menger::evolution
