#include "evolution/genome/cppn_expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace menger::evolution {
namespace {

constexpr ExpressionOptions proper{Expression::every_consumer_activated, AxisMap::xyz};
constexpr ExpressionOptions remembered{Expression::first_consumer_activated, AxisMap::xyz};

std::size_t cell(int x, int y, int z) {
  return static_cast<std::size_t>(x) + 3 * static_cast<std::size_t>(y) + 9 * static_cast<std::size_t>(z);
}

TEST(CppnExpression, ActivationsAreTheStatedFunctions) {
  for (const double s : {-2.5, -0.3, 0.0, 0.4, 3.0}) {
    EXPECT_EQ(activate(Activation::identity, s), s);
    EXPECT_NEAR(activate(Activation::sigmoid, s), std::tanh(s / 2.0), 1e-15);
    EXPECT_EQ(activate(Activation::sine, s), std::sin(s));
    EXPECT_EQ(activate(Activation::absolute, s), std::abs(s));
    EXPECT_EQ(activate(Activation::negative_absolute, s), -std::abs(s));
    EXPECT_EQ(activate(Activation::square, s), s * s);
    EXPECT_EQ(activate(Activation::negative_square, s), -s * s);
    EXPECT_EQ(activate(Activation::root, s), std::sqrt(std::abs(s)));
    EXPECT_EQ(activate(Activation::negative_root, s), -std::sqrt(std::abs(s)));
    EXPECT_EQ(activate(Activation::sign, s), s > 0.0 ? 1.0 : (s < 0.0 ? -1.0 : 0.0));
    EXPECT_EQ(activate(Activation::negative_sign, s), -activate(Activation::sign, s));
    EXPECT_EQ(activate(Activation::step, s), s > 0.0 ? 1.0 : 0.0);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(activate(Activation::sign, nan)));
  EXPECT_EQ(activate(Activation::step, nan), 0.0);
}

TEST(CppnExpression, InputsSpanTheUnitCube) {
  const auto inputs = input_values(AxisMap::xyz);
  EXPECT_EQ(inputs[0][cell(0, 1, 2)], -1.0);
  EXPECT_EQ(inputs[1][cell(0, 1, 2)], 0.0);
  EXPECT_EQ(inputs[2][cell(0, 1, 2)], 1.0);
  EXPECT_EQ(inputs[3][cell(1, 1, 1)], -1.0);
  EXPECT_EQ(inputs[3][cell(0, 0, 0)], 1.0);
  EXPECT_EQ(inputs[3][cell(2, 0, 2)], 1.0);
  EXPECT_NEAR(inputs[3][cell(1, 0, 1)], 2.0 / std::sqrt(3.0) - 1.0, 1e-15);
  for (const double bias : inputs[4]) EXPECT_EQ(bias, 1.0);
}

TEST(CppnExpression, AxisMapTurnsTheNetworksXUp) {
  const Cppn network = cppn_from_text("outputs identity identity identity\nedge x out0 1\nedge y out1 1\nedge z out2 1\n");
  const auto straight = express(network, {Expression::every_consumer_activated, AxisMap::xyz});
  const auto turned = express(network, {Expression::every_consumer_activated, AxisMap::zyx});
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 3; ++z) {
        EXPECT_EQ(straight[0][cell(x, y, z)], x - 1);
        EXPECT_EQ(straight[1][cell(x, y, z)], y - 1);
        EXPECT_EQ(straight[2][cell(x, y, z)], z - 1);
        EXPECT_EQ(turned[0][cell(x, y, z)], z - 1);
        EXPECT_EQ(turned[1][cell(x, y, z)], y - 1);
        EXPECT_EQ(turned[2][cell(x, y, z)], x - 1);
      }
    }
  }
}

TEST(CppnExpression, SumsWeightedInputsBeforeTheFunction) {
  const Cppn network =
      cppn_from_text("outputs sigmoid\nhidden 0 square\nedge x h0 2\nedge b h0 -0.5\nedge h0 out0 0.25\nedge y out0 0.5\n");
  const auto values = express(network, proper);
  EXPECT_EQ(values[0][cell(2, 0, 1)], activate(Activation::sigmoid, 0.25 * 1.5 * 1.5 - 0.5));
}

TEST(CppnExpression, EveryConsumerGetsTheActivatedValueOrOnlyTheFirst) {
  const Cppn network = cppn_from_text(
      "outputs identity identity\nhidden 0 square\nhidden 1 identity\nedge x h0 1\nedge h0 out0 1\nedge h0 h1 1\nedge h1 out0 "
      "10\nedge h0 out1 1\n");
  const auto activated = express(network, proper);
  const auto raw = express(network, remembered);
  // At x = −1 the node gives 1 activated and −1 raw: out0 asks it first, then h1 asks it, then out1.
  EXPECT_EQ(activated[0][cell(0, 0, 0)], 11.0);
  EXPECT_EQ(activated[1][cell(0, 0, 0)], 1.0);
  EXPECT_EQ(raw[0][cell(0, 0, 0)], -9.0);
  EXPECT_EQ(raw[1][cell(0, 0, 0)], -1.0);
}

TEST(CppnExpression, TheFirstConsumerIsTheFirstInDepthFirstOrderOfTheEdges) {
  // h1 comes first among the edges into out0, and so asks h0 before out0 itself does.
  const Cppn network = cppn_from_text(
      "outputs identity\nhidden 0 square\nhidden 1 identity\nedge x h0 1\nedge h1 out0 10\nedge h0 out0 1\nedge h0 h1 1\n");
  EXPECT_EQ(express(network, remembered)[0][cell(0, 0, 0)], 9.0);
}

TEST(CppnExpression, InputsAreTheSameForEveryConsumer) {
  const Cppn network = cppn_from_text("outputs sigmoid sigmoid\nedge d out0 1\nedge d out1 1\n");
  const auto values = express(network, remembered);
  EXPECT_EQ(values[0], values[1]);
}

TEST(CppnExpression, OptionsHaveOneWordEach) {
  EXPECT_EQ(to_string(Expression::every_consumer_activated), "every-consumer");
  EXPECT_EQ(to_string(Expression::first_consumer_activated), "first-consumer");
  EXPECT_EQ(to_string(AxisMap::xyz), "xyz");
  EXPECT_EQ(to_string(AxisMap::zyx), "zyx");
}

}  // namespace
}  // namespace menger::evolution
