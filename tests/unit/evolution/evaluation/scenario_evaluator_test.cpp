#include "evolution/evaluation/scenario_evaluator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace menger::evolution {
namespace {

/// Gives a remark, and no results.
class RemarkingEvaluator final : public DesignEvaluator {
 public:
  explicit RemarkingEvaluator(std::string remark) : remark_(std::move(remark)) {}

  [[nodiscard]] Evaluation evaluate(const meshes::Polycube&, int, const std::atomic<bool>&) const override { return {}; }
  [[nodiscard]] std::string physics() const override { return "physics"; }
  [[nodiscard]] std::string remark() const override { return remark_; }
  [[nodiscard]] double cost(const meshes::Polycube&, int) const override { return 1.0; }

 private:
  std::string remark_;
};

std::string remark_of(const std::vector<std::string>& remarks) {
  std::vector<std::unique_ptr<DesignEvaluator>> scenarios;
  for (const std::string& remark : remarks) scenarios.push_back(std::make_unique<RemarkingEvaluator>(remark));
  return ScenarioEvaluator(std::move(scenarios)).remark();
}

TEST(ScenarioEvaluator, PassesTheRemarksOfItsScenariosOn) {
  EXPECT_EQ(remark_of({"", ""}), "");
  EXPECT_EQ(remark_of({"2 bodies were slow", "", "2 bodies were slow"}),
            "in scenario 1: 2 bodies were slow; in scenario 3: 2 bodies were slow");
}

}  // namespace
}  // namespace menger::evolution
