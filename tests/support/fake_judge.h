#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "evolution/evaluation/design_judge.h"
#include "io/text/content_hash.h"

namespace menger::test_support {

/// Judges robots by a cheap pure function of their form: n cells go n mm, some fail, and each takes n element-steps times ten.
class FakeJudge final : public evolution::DesignJudge {
 public:
  struct Options {
    double failing = 0.0;          ///< share of robots that diverge
    double crashing = 0.0;         ///< share of which the judge gives no result
    std::size_t fewest_cells = 0;  ///< robots of fewer cannot be judged
    double time_factor = 1.0;
    std::function<void(std::uint64_t call)> before_results;  ///< called in every round, with the number of rounds so far
  };

  FakeJudge() = default;
  explicit FakeJudge(Options options) : options_(std::move(options)) {}

  [[nodiscard]] evolution::Distinction distinction() const override { return {.materials = false, .place = false}; }
  [[nodiscard]] std::string obstacle(const meshes::Polycube& body) const override {
    return body.count() < options_.fewest_cells ? "too few cells" : "";
  }

  [[nodiscard]] std::optional<std::vector<evolution::JudgeResult>> judge(std::span<const meshes::Polycube> bodies,
                                                                         const std::atomic<bool>* stop) override {
    ++calls_;
    if (options_.before_results) options_.before_results(calls_);
    if (stop != nullptr && *stop) return std::nullopt;
    std::vector<evolution::JudgeResult> results;
    for (const meshes::Polycube& body : bodies) results.push_back(result_of(body));
    return results;
  }

  [[nodiscard]] std::string protocol() const override { return "fake judge"; }
  [[nodiscard]] double duration_s() const override { return 1.0; }
  [[nodiscard]] double time_factor() const override { return options_.time_factor; }

  [[nodiscard]] evolution::JudgeResult result_of(const meshes::Polycube& body) const {
    const double chance = fraction(io::content_hash(robot_form(body, distinction())));
    evolution::JudgeResult judged;
    judged.element_steps = 10 * body.count();
    if (chance < options_.crashing) {
      judged.has_result = false;
      judged.result.reason = "exit code 1";
      judged.element_steps = 0;
    } else if (chance < options_.crashing + options_.failing) {
      judged.result.status = io::RunStatus::diverged;
      judged.result.reason = "too fast";
    } else {
      judged.result.status = io::RunStatus::completed;
      judged.result.displacement_m = {1e-3 * static_cast<double>(body.count()), 0.0, 0.0};
    }
    return judged;
  }

  [[nodiscard]] std::uint64_t calls() const { return calls_; }

 private:
  /// A number of [0, 1) from eight hexadecimal digits.
  static double fraction(const std::string& hash) {
    return static_cast<double>(std::stoull(hash.substr(0, 8), nullptr, 16)) / 4294967296.0;
  }

  Options options_;
  std::uint64_t calls_ = 0;
};

}  // namespace menger::test_support
