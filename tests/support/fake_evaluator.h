#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "evolution/evaluation/evaluator.h"
#include "io/text/content_hash.h"
#include "meshes/design/fractal.h"

namespace menger::test_support {

/// An evaluator that is a cheap pure function of the cells. Fuller bodies tend to go further; some diverge.
class FakeEvaluator final : public evolution::DesignEvaluator {
 public:
  struct Options {
    double failing = 0.1;  ///< fraction of bodies that diverge
    bool coarse = false;   ///< displacements in tenths of a body length, so that many are equal
    double cell_edge_m = 0.01;
    std::string scenario{};                                 ///< gives other displacements for every text
    std::function<void(std::uint64_t call)> before_result;  ///< called in every evaluation with the number of calls so far
  };

  FakeEvaluator() = default;
  explicit FakeEvaluator(Options options) : options_(std::move(options)) {}

  [[nodiscard]] evolution::Evaluation evaluate(const meshes::Polycube& body, int level,
                                               const std::atomic<bool>& stop) const override {
    const std::uint64_t call = ++calls_;
    if (options_.before_result) options_.before_result(call);
    evolution::Evaluation result;
    if (stop) return result;
    result.steps = 1000;
    result.seconds = 1e-9 * static_cast<double>(call);
    const std::string hash = io::content_hash(options_.scenario + body.digits() + "@" + std::to_string(level));
    if (fraction(hash, 0) < options_.failing) {
      result.status = io::RunStatus::diverged;
      result.reason = "of design " + hash;
      return result;
    }
    const double cells = static_cast<double>(body.nx()) * body.ny() * body.nz();
    double lengths = std::pow(static_cast<double>(body.count()) / cells, 1.0 / level) * (0.5 + fraction(hash, 8));
    if (options_.coarse) lengths = std::round(lengths * 10.0) / 10.0;
    const double distance_m = lengths * meshes::body_length_m(level, options_.cell_edge_m);
    const double direction = 6.28 * fraction(hash, 16);
    result.status = io::RunStatus::completed;
    // If many displacements are to be equal, they lie along an axis, since rounding could make them differ otherwise.
    if (options_.coarse) {
      result.displacement_m = {distance_m, 0.0, 0.0};
    } else {
      result.displacement_m = {distance_m * std::cos(direction), distance_m * std::sin(direction), -1e-4};
    }
    return result;
  }

  [[nodiscard]] std::string physics() const override {
    return options_.scenario + "fake, failing = " + std::to_string(options_.failing) +
           ", coarse = " + std::to_string(options_.coarse);
  }

  [[nodiscard]] double cost(const meshes::Polycube& body, int /*level*/) const override {
    return static_cast<double>(body.count());
  }

  [[nodiscard]] std::uint64_t calls() const { return calls_; }

 private:
  /// Returns a number in [0, 1) from eight hexadecimal digits.
  static double fraction(const std::string& hash, std::size_t from) {
    return static_cast<double>(std::stoull(hash.substr(from, 8), nullptr, 16)) / 4294967296.0;
  }

  Options options_;
  mutable std::atomic<std::uint64_t> calls_{0};
};

}  // namespace menger::test_support
