#include "evolution/ranks/evaluation_message.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"

namespace menger::evolution {
namespace {

meshes::Polycube two_materials() { return meshes::Polycube::from_digits(3, 2, 1, "120210"); }

TEST(EvaluationMessage, BringsTasksBack) {
  const TaskMessage sent{.evaluator = 3, .tasks = {{two_materials(), 1, 0}, {meshes::fractal(meshes::bar(3), 2), 2, 5}}};
  const TaskMessage received = task_message_from(bytes_of(sent));
  EXPECT_EQ(received.evaluator, 3U);
  ASSERT_EQ(received.tasks.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(received.tasks[n].body, sent.tasks[n].body);
    EXPECT_EQ(received.tasks[n].level, sent.tasks[n].level);
    EXPECT_EQ(received.tasks[n].scenario, sent.tasks[n].scenario);
  }
}

TEST(EvaluationMessage, HasFourCellsInAByte) {
  meshes::Polycube large(27, 27, 27);
  large.set({0, 0, 0}, 1);
  EXPECT_LT(bytes_of(TaskMessage{.evaluator = 0, .tasks = {{large, 3, 0}}}).size(), 27U * 27U * 27U / 4U + 30U);
}

TEST(EvaluationMessage, BringsEveryBitOfResultsBack) {
  Evaluation whole;
  whole.status = io::RunStatus::completed;
  whole.displacement_m = {0.1, -0.0, 1.0 / 3.0};
  whole.left_out_m = {std::nextafter(1.0, 2.0), std::numeric_limits<double>::denorm_min(), -1e300};
  whole.period_displacements_m = {{1e-9, 2.5, -3.0}, {0.0, 0.0, 0.0}};
  whole.outside_validity = "level 1: \xc3\xa4 \"quoted\"";
  whole.steps = std::uint64_t{1} << 60U;
  whole.elements = 712;
  whole.fidelity = "draft";
  whole.seconds = 1.25;
  Evaluation failed;
  failed.status = io::RunStatus::fell;
  failed.reason = "the body has fallen";
  const Evaluation sent[] = {whole, failed};
  const std::vector<Evaluation> received = results_from(bytes_of(sent));
  ASSERT_EQ(received.size(), 2U);
  EXPECT_EQ(received[0].status, whole.status);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>((*received[0].displacement_m)[axis]),
              std::bit_cast<std::uint64_t>((*whole.displacement_m)[axis]));
    EXPECT_EQ(std::bit_cast<std::uint64_t>((*received[0].left_out_m)[axis]),
              std::bit_cast<std::uint64_t>((*whole.left_out_m)[axis]));
  }
  EXPECT_EQ(received[0].period_displacements_m, whole.period_displacements_m);
  EXPECT_EQ(received[0].outside_validity, whole.outside_validity);
  EXPECT_EQ(received[0].steps, whole.steps);
  EXPECT_EQ(received[0].elements, whole.elements);
  EXPECT_EQ(received[0].fidelity, whole.fidelity);
  EXPECT_EQ(received[0].seconds, whole.seconds);
  EXPECT_EQ(received[1].status, io::RunStatus::fell);
  EXPECT_EQ(received[1].reason, failed.reason);
  EXPECT_FALSE(received[1].displacement_m || received[1].left_out_m);
}

TEST(EvaluationMessage, ThatIsCutOffIsRefused) {
  const std::string task = bytes_of(TaskMessage{.evaluator = 0, .tasks = {{two_materials(), 1, 0}}});
  const std::string result = bytes_of(std::vector<Evaluation>(1));
  for (std::size_t length = 0; length < task.size(); ++length)
    EXPECT_ANY_THROW((void)task_message_from(task.substr(0, length))) << length;
  for (std::size_t length = 0; length < result.size(); ++length)
    EXPECT_ANY_THROW((void)results_from(result.substr(0, length))) << length;
}

}  // namespace
}  // namespace menger::evolution
