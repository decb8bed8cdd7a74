#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/genome/decoder.h"
#include "evolution/genome/robot_form.h"

namespace menger::evolution {

/// The result of a reference evaluation of one robot.
struct ReferenceResult {
  Evaluation result;
  bool has_result = true;  ///< false: the reference evaluator failed for `result.reason`, and `result.status` means nothing
  std::uint64_t element_steps = 0;  ///< cost, as far as it is known
};

/// Evaluates robots by a more expensive model than the evaluator of a search.
///
/// Implementations must be pure: the same robots always give the same results, apart from `seconds`.
class ReferenceEvaluator {
 public:
  virtual ~ReferenceEvaluator() = default;

  /// Returns what makes two bodies different robots, for this reference evaluator and for the evaluator of the search.
  [[nodiscard]] virtual Distinction distinction() const = 0;

  /// Returns why it cannot evaluate a standing basal body, or an empty text if it can.
  [[nodiscard]] virtual std::string obstacle(const meshes::Polycube& body) const = 0;

  /// Evaluates standing basal bodies. A failure of one does not end the others.
  /// @return results in the order of `bodies`; nothing if `stop` became true: a second call then continues from what is done
  /// @throws io::InputError if the reference evaluator cannot work at all
  [[nodiscard]] virtual std::optional<std::vector<ReferenceResult>> evaluate(std::span<const meshes::Polycube> bodies,
                                                                             const std::atomic<bool>* stop) = 0;

  /// Returns everything that decides a result besides the body, as canonical text.
  [[nodiscard]] virtual std::string protocol() const = 0;

  /// Returns the simulated time of a reference evaluation, in seconds.
  [[nodiscard]] virtual double duration_s() const = 0;

  /// Returns the ratio of the time over which the evaluator of the search measures displacement to the time over which the
  /// reference evaluator does. Displacements of the reference evaluator are multiplied by it before they are scored, so that both
  /// scores are over the same time.
  [[nodiscard]] virtual double time_factor() const = 0;
};

}  // namespace menger::evolution
