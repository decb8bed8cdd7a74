#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "evolution/evaluation/reference_evaluator.h"
#include "io/text/content_hash.h"

namespace menger::test_support {

/// A reference evaluator that is a cheap pure function of the form of a robot. A robot of n cells goes n mm and takes 10 n
/// element-steps; some fail.
class FakeReferenceEvaluator final : public evolution::ReferenceEvaluator {
 public:
  struct Options {
    double failing = 0.0;          ///< fraction of robots that diverge
    double crashing = 0.0;         ///< fraction of robots for which there is no result
    std::size_t fewest_cells = 0;  ///< robots with fewer cells cannot be evaluated
    double time_factor = 1.0;
    std::function<void(std::uint64_t call)> before_results;  ///< called in every round with the number of rounds so far
  };

  FakeReferenceEvaluator() = default;
  explicit FakeReferenceEvaluator(Options options) : options_(std::move(options)) {}

  [[nodiscard]] evolution::Distinction distinction() const override { return {.materials = false, .place = false}; }
  [[nodiscard]] std::string obstacle(const meshes::Polycube& body) const override {
    return body.count() < options_.fewest_cells ? "too few cells" : "";
  }

  [[nodiscard]] std::optional<std::vector<evolution::ReferenceResult>> evaluate(std::span<const meshes::Polycube> bodies,
                                                                                const std::atomic<bool>* stop) override {
    ++calls_;
    if (options_.before_results) options_.before_results(calls_);
    if (stop != nullptr && *stop) return std::nullopt;
    std::vector<evolution::ReferenceResult> results;
    for (const meshes::Polycube& body : bodies) results.push_back(result_of(body));
    return results;
  }

  [[nodiscard]] std::string protocol() const override { return "fake reference evaluator"; }
  [[nodiscard]] double duration_s() const override { return 1.0; }
  [[nodiscard]] double time_factor() const override { return options_.time_factor; }

  [[nodiscard]] evolution::ReferenceResult result_of(const meshes::Polycube& body) const {
    const double chance = fraction(io::content_hash(robot_form(body, distinction())));
    evolution::ReferenceResult evaluated;
    evaluated.element_steps = 10 * body.count();
    if (chance < options_.crashing) {
      evaluated.has_result = false;
      evaluated.result.reason = "exit code 1";
      evaluated.element_steps = 0;
    } else if (chance < options_.crashing + options_.failing) {
      evaluated.result.status = io::RunStatus::diverged;
      evaluated.result.reason = "too fast";
    } else {
      evaluated.result.status = io::RunStatus::completed;
      evaluated.result.displacement_m = {1e-3 * static_cast<double>(body.count()), 0.0, 0.0};
    }
    return evaluated;
  }

  [[nodiscard]] std::uint64_t calls() const { return calls_; }

 private:
  /// Returns a number in [0, 1) from eight hexadecimal digits.
  static double fraction(const std::string& hash) {
    return static_cast<double>(std::stoull(hash.substr(0, 8), nullptr, 16)) / 4294967296.0;
  }

  Options options_;
  std::uint64_t calls_ = 0;
};

}  // namespace menger::test_support
