#include "evolution/genome/cppn_variation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "evolution/genome/cppn_expression.h"

namespace menger::evolution {
namespace {

constexpr VariationOptions paper{ActivationSet::paper, OutputFunction::kept};
constexpr VariationOptions released{ActivationSet::released_code, OutputFunction::mutable_};

double tolerance(double probability, int draws) { return 4.0 * std::sqrt(probability * (1.0 - probability) / draws); }

/// Returns whether the reader of networks, which checks every invariant, accepts the network.
bool keeps_invariants(const Cppn& network) { return cppn_from_text(to_text(network)) == network; }

TEST(CppnVariation, AddNodeSplitsAnEdgeInTwo) {
  RandomStream random(1, "add node");
  std::set<std::size_t> split;
  for (int sample = 0; sample < 200; ++sample) {
    Cppn network = bare_cppn(2, Activation::sigmoid);
    for (std::size_t edge = 0; edge < network.edges.size(); ++edge) network.edges[edge].weight = static_cast<double>(edge);
    const Cppn before = network;
    add_node(network, released, random);
    ASSERT_EQ(network.edges.size(), before.edges.size() + 1);
    ASSERT_EQ(network.hidden_count(), 1U);
    const CppnEdge& out = network.edges[network.edges.size() - 2];
    const CppnEdge& in = network.edges.back();
    EXPECT_EQ(out.from, 7U);
    EXPECT_EQ(out.weight, 1.0);
    EXPECT_EQ(in.to, 7U);
    EXPECT_FALSE(network.find_edge(in.from, out.to));
    const auto original = before.find_edge(in.from, out.to);
    ASSERT_TRUE(original);
    EXPECT_EQ(in.weight, before.edges[*original].weight);
    split.insert(*original);
  }
  EXPECT_EQ(split.size(), 10U) << "every edge is drawn";
}

TEST(CppnVariation, AddNodeLabelsOneAboveTheLargest) {
  RandomStream random(1, "labels");
  Cppn network = cppn_from_text("outputs sine\nhidden 4 sine\nedge x h4 1\nedge h4 out0 1\n");
  add_node(network, paper, random);
  EXPECT_EQ(network.nodes.back().hidden_label, 5);
}

TEST(CppnVariation, RemoveNodeJoinsItsNeighboursByTheProductsOfTheirWeights) {
  RandomStream random(2, "remove node");
  Cppn network = cppn_from_text(
      "outputs sine sine\nhidden 0 identity\nedge x out0 9\nedge x h0 2\nedge y h0 3\nedge h0 out0 5\nedge z out1 8\nedge h0 "
      "out1 7\n");
  remove_node(network, random);
  EXPECT_EQ(to_text(network),
            "outputs sine sine\nedge x out0 10\nedge z out1 8\nedge x out1 14\nedge y out0 15\nedge y out1 21\n");
}

TEST(CppnVariation, AddLinkKeepsTheNetworkAcyclicAndSimple) {
  RandomStream random(3, "add link");
  int positive = 0;
  constexpr int samples = 2000;
  for (int sample = 0; sample < samples; ++sample) {
    Cppn network = bare_cppn(2, Activation::sigmoid);
    for (int repeat = 0; repeat < 4; ++repeat) add_node(network, paper, random);
    const std::size_t before = network.edges.size();
    add_link(network, random);
    ASSERT_EQ(network.edges.size(), before + 1);
    ASSERT_TRUE(keeps_invariants(network)) << to_text(network);
    EXPECT_EQ(std::abs(network.edges.back().weight), 0.1);
    positive += network.edges.back().weight > 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(positive / static_cast<double>(samples), 0.5, tolerance(0.5, samples));
}

TEST(CppnVariation, AddLinkReachesEveryLegalPair) {
  RandomStream random(3, "legal pairs");
  const Cppn start = cppn_from_text("outputs sine\nhidden 0 sine\nhidden 1 sine\nedge x h0 1\nedge h0 h1 1\nedge h1 out0 1\n");
  std::map<std::pair<std::size_t, std::size_t>, int> counts;
  constexpr int samples = 15000;
  for (int sample = 0; sample < samples; ++sample) {
    Cppn network = start;
    add_link(network, random);
    ++counts[{network.edges.back().from, network.edges.back().to}];
  }
  // From 5 inputs and 2 hidden nodes to 2 hidden nodes and 1 output there are 5 * 3 + 2 + 1 pairs without a cycle or a loop. Of
  // these 3 are joined.
  EXPECT_EQ(counts.size(), 15U);
  for (const auto& [pair, count] : counts)
    EXPECT_NEAR(count / static_cast<double>(samples), 1.0 / 15.0, tolerance(1.0 / 15.0, samples));
}

TEST(CppnVariation, AddLinkLeavesAFullNetworkAsItIs) {
  RandomStream random(3, "full");
  Cppn network = bare_cppn(2, Activation::sigmoid);
  add_link(network, random);
  EXPECT_EQ(network, bare_cppn(2, Activation::sigmoid));
}

TEST(CppnVariation, OperatorsLeaveAnEmptyNetworkAsItIs) {
  RandomStream random(3, "empty");
  Cppn network = bare_cppn(1, Activation::sigmoid);
  network.edges.clear();
  const Cppn before = network;
  add_node(network, paper, random);
  remove_node(network, random);
  remove_link(network, random);
  mutate_weight(network, random);
  mutate_function(network, paper, random);
  EXPECT_EQ(network, before);
}

TEST(CppnVariation, RemoveLinkDeletesOneEdge) {
  RandomStream random(4, "remove link");
  Cppn network = bare_cppn(2, Activation::sigmoid);
  remove_link(network, random);
  EXPECT_EQ(network.edges.size(), 9U);
}

TEST(CppnVariation, MutateFunctionAlwaysChangesTheFunctionAndDrawsTheOthersAlike) {
  RandomStream random(5, "function");
  std::map<Activation, int> counts;
  constexpr int samples = 16000;
  for (int sample = 0; sample < samples; ++sample) {
    Cppn network = cppn_from_text("outputs identity\nhidden 0 sine\nedge x h0 1\nedge h0 out0 1\n");
    mutate_function(network, released, random);
    ++counts[network.nodes.back().activation];
  }
  EXPECT_EQ(counts.size(), 8U);
  EXPECT_FALSE(counts.contains(Activation::sine));
  for (const auto& [activation, count] : counts)
    EXPECT_NEAR(count / static_cast<double>(samples), 1.0 / 8.0, tolerance(1.0 / 8.0, samples));
}

TEST(CppnVariation, ActivationSetsDifferAsThePresetsSay) {
  RandomStream random(6, "sets");
  std::set<Activation> drawn_by_paper;
  std::set<Activation> drawn_by_released;
  for (int sample = 0; sample < 100; ++sample) {
    const Cppn by_paper = random_cppn(2, Activation::sigmoid, paper, random);
    for (std::size_t node = by_paper.first_hidden(); node < by_paper.nodes.size(); ++node)
      drawn_by_paper.insert(by_paper.nodes[node].activation);
    const Cppn by_released = random_cppn(2, Activation::sigmoid, released, random);
    for (std::size_t node = by_released.first_hidden(); node < by_released.nodes.size(); ++node) {
      drawn_by_released.insert(by_released.nodes[node].activation);
    }
  }
  EXPECT_EQ(drawn_by_paper,
            (std::set{Activation::sine, Activation::absolute, Activation::square, Activation::root, Activation::step}));
  EXPECT_EQ(drawn_by_released, (std::set{Activation::sine, Activation::absolute, Activation::negative_absolute,
                                         Activation::square, Activation::negative_square, Activation::root,
                                         Activation::negative_root, Activation::sign, Activation::negative_sign}));
}

TEST(CppnVariation, KeptOutputsStayInTheUnitIntervalAndMutableOnesDoNot) {
  RandomStream random(7, "outputs");
  bool left_the_interval = false;
  for (int sample = 0; sample < 300; ++sample) {
    const Cppn kept = random_cppn(2, Activation::sigmoid, paper, random);
    EXPECT_EQ(kept.nodes[kept.output(0)].activation, Activation::sigmoid);
    for (const GridValues& values : express(kept, {})) {
      for (const double value : values) EXPECT_LE(std::abs(value), 1.0);
    }
    const Cppn mutated = random_cppn(2, Activation::sigmoid, released, random);
    for (const GridValues& values : express(mutated, {})) {
      for (const double value : values) left_the_interval = left_the_interval || std::abs(value) > 1.0;
    }
  }
  EXPECT_TRUE(left_the_interval);
}

TEST(CppnVariation, AMutatedSigmoidNeverReturnsAndASumStaysASum) {
  RandomStream random(8, "sigmoid");
  Cppn network = bare_cppn(1, Activation::sigmoid);
  for (int repeat = 0; repeat < 500; ++repeat) {
    mutate_function(network, released, random);
    EXPECT_NE(network.nodes[network.output(0)].activation, Activation::sigmoid);
  }
  Cppn sum = bare_cppn(1, Activation::identity);
  mutate_function(sum, released, random);
  EXPECT_EQ(sum, bare_cppn(1, Activation::identity));
}

TEST(CppnVariation, MutateWeightDrawsAroundTheOldWeightAndClips) {
  RandomStream random(9, "weight");
  constexpr int samples = 20000;
  int clipped = 0;
  int within_half = 0;
  for (int sample = 0; sample < samples; ++sample) {
    Cppn network = cppn_from_text("outputs sine\nedge x out0 0\n");
    mutate_weight(network, random);
    const double weight = network.edges[0].weight;
    ASSERT_LE(std::abs(weight), 1.0);
    clipped += std::abs(weight) == 1.0 ? 1 : 0;
    within_half += std::abs(weight) < 0.5 ? 1 : 0;
    network.edges[0].weight = 1.0;
    mutate_weight(network, random);
    ASSERT_LT(network.edges[0].weight, 1.0) << "a clipped weight that would stay is drawn again";
  }
  EXPECT_NEAR(clipped / static_cast<double>(samples), 0.0455003, tolerance(0.0455003, samples));
  EXPECT_NEAR(within_half / static_cast<double>(samples), 0.682689, tolerance(0.682689, samples));
}

TEST(CppnVariation, PruneDeletesEveryHiddenNodeOffThePathsFromInputsToOutputs) {
  Cppn network = cppn_from_text(
      "outputs sine\nhidden 0 sine\nhidden 1 sine\nhidden 2 sine\nhidden 3 sine\nhidden 4 sine\n"
      "edge x h0 1\nedge h0 out0 1\nedge h1 h2 1\nedge h2 out0 1\nedge y h3 1\nedge h3 h4 1\n");
  prune(network);
  EXPECT_EQ(to_text(network), "outputs sine\nhidden 0 sine\nedge x h0 1\nedge h0 out0 1\n");
}

TEST(CppnVariation, DrawsTheSixOperatorsAlike) {
  RandomStream random(10, "operators");
  const Cppn start = cppn_from_text(
      "outputs sigmoid\nhidden 0 sine\nhidden 1 sine\nedge x h0 0.5\nedge y h0 0.5\nedge x h1 0.5\nedge y h1 0.5\nedge h0 h1 "
      "0.5\n"
      "edge h0 out0 0.5\nedge h1 out0 0.5\nedge z out0 0.5\n");
  const auto activations = [](const Cppn& network) {
    std::vector<Activation> result;
    for (const CppnNode& node : network.nodes) result.push_back(node.activation);
    return result;
  };
  std::array<int, 6> counts{};
  constexpr int samples = 30000;
  for (int sample = 0; sample < samples; ++sample) {
    Cppn network = start;
    vary(network, released, random);
    if (network.hidden_count() > start.hidden_count()) {
      ++counts[0];
    } else if (network.edges.size() > start.edges.size()) {
      ++counts[2];
    } else if (activations(network) != activations(start) && network.hidden_count() == start.hidden_count()) {
      ++counts[4];
    } else if (network.edges.size() == start.edges.size()) {
      ++counts[5];
    } else {
      // Removing a link may leave h1 without an outgoing edge, so that it is pruned. Removing a node leaves edges from x and y to
      // the output.
      const bool node_removed =
          network.hidden_count() < start.hidden_count() && network.find_edge(0, network.output(0)).has_value();
      ++counts[node_removed ? 1 : 3];
    }
  }
  for (const int count : counts) EXPECT_NEAR(count / static_cast<double>(samples), 1.0 / 6.0, tolerance(1.0 / 6.0, samples));
}

TEST(CppnVariation, KeepsTheInvariantsOverLongLineages) {
  for (const VariationOptions& options : {paper, released}) {
    RandomStream random(11, "lineage");
    Cppn network = random_cppn(2, Activation::sigmoid, options, random);
    for (int step = 0; step < 500; ++step) {
      vary(network, options, random);
      ASSERT_TRUE(keeps_invariants(network)) << to_text(network);
      Cppn pruned = network;
      prune(pruned);
      ASSERT_EQ(pruned, network);
    }
  }
}

}  // namespace
}  // namespace menger::evolution
