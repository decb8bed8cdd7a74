#include "evolution/genome/cppn.h"

#include <gtest/gtest.h>

#include <string>

#include "evolution/genome/cppn_variation.h"
#include "io/text/input_error.h"

namespace menger::evolution {
namespace {

TEST(Cppn, IsBornWithEveryInputJoinedToEveryOutput) {
  const Cppn network = bare_cppn(2, Activation::sigmoid);
  EXPECT_EQ(network.nodes.size(), 7U);
  EXPECT_EQ(network.edges.size(), 10U);
  EXPECT_EQ(network.hidden_count(), 0U);
  for (const CppnEdge& edge : network.edges) {
    EXPECT_TRUE(network.is_input(edge.from) && network.is_output(edge.to));
    EXPECT_EQ(edge.weight, 0.0);
  }
}

TEST(Cppn, ReadsBackEveryBitOfItsText) {
  RandomStream random(1, "cppn");
  for (int sample = 0; sample < 300; ++sample) {
    const auto set = sample % 2 == 0 ? ActivationSet::paper : ActivationSet::released_code;
    const Cppn network = random_cppn(2, Activation::sigmoid, {set, OutputFunction::mutable_}, random);
    EXPECT_EQ(cppn_from_text(to_text(network)), network);
  }
  Cppn extreme = bare_cppn(1, Activation::identity);
  extreme.edges[0].weight = 5e-324;
  extreme.edges[1].weight = -0.1;
  extreme.edges[2].weight = 1.0 / 3.0;
  EXPECT_EQ(cppn_from_text(to_text(extreme)), extreme);
}

TEST(Cppn, TextNamesNodesAndActivations) {
  const std::string text = "outputs sigmoid negative-root\nhidden 3 sine\nedge x h3 0.5\nedge h3 out1 -1\nedge b out0 0.25\n";
  const Cppn network = cppn_from_text(text);
  EXPECT_EQ(to_text(network), text);
  EXPECT_EQ(network.edges[0], (CppnEdge{0, 7, 0.5}));
  EXPECT_EQ(network.nodes[7], (CppnNode{Activation::sine, 3}));
}

TEST(Cppn, RefusesTextsThatBreakAnInvariant) {
  const std::string head = "outputs sigmoid\nhidden 0 sine\nhidden 1 sine\n";
  for (const std::string& text :
       {std::string(), std::string("hidden 0 sine\n"), std::string("outputs\n"), std::string("outputs cosine\n"),
        head + "outputs sine\n", head + "hidden 0 sine\n", head + "hidden -1 sine\n", head + "hidden 2\n",
        head + "edge h0 h2 1\n", head + "edge h0 h0 1\n", head + "edge h0 x 1\n", head + "edge out0 h0 1\n",
        head + "edge x h0 1\nedge x h0 1\n", head + "edge h0 h1 1\nedge h1 h0 1\n", head + "edge x h0 nan\n",
        head + "edge x h0 1 2\n", head + "edge x h0 1x\n", head + "link x h0 1\n", head + "\n"}) {
    EXPECT_THROW(cppn_from_text(text), io::InputError) << text;
  }
}

TEST(Cppn, ErrorNamesTheLine) {
  try {
    cppn_from_text("outputs sigmoid\nedge x out0 much\n");
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("edge x out0 much"), std::string::npos) << error.what();
  }
}

TEST(Cppn, ErasingAHiddenNodeKeepsTheOthersTogether) {
  Cppn network =
      cppn_from_text("outputs sine\nhidden 0 sine\nhidden 1 square\nedge x h0 1\nedge h0 h1 2\nedge y h1 3\nedge h1 out0 4\n");
  network.erase_hidden(6);
  EXPECT_EQ(to_text(network), "outputs sine\nhidden 1 square\nedge y h1 3\nedge h1 out0 4\n");
}

TEST(Activation, HasOneWordEach) {
  for (int number = 0; number <= static_cast<int>(Activation::step); ++number) {
    const auto activation = static_cast<Activation>(number);
    EXPECT_EQ(activation_from_string(to_string(activation)), activation);
  }
  EXPECT_FALSE(activation_from_string("cosine"));
}

}  // namespace
}  // namespace menger::evolution
