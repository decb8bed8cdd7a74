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

/// What a judge found of one robot.
struct JudgeResult {
  Evaluation result;
  bool has_result = true;           ///< false: the judge failed, result.reason says how; there is no status
  std::uint64_t element_steps = 0;  ///< what it took, as far as that is known
};

/// Judges robots by a dearer model than the evaluator of a search does.
///
/// Implementations must be pure but for `seconds`: the same robots give the same results, however often they are asked for.
class DesignJudge {
 public:
  virtual ~DesignJudge() = default;

  /// What makes two bodies different robots to this judge and to the evaluator.
  [[nodiscard]] virtual Distinction distinction() const = 0;

  /// Why it cannot judge a standing basal body; empty if it can.
  [[nodiscard]] virtual std::string obstacle(const meshes::Polycube& body) const = 0;

  /// Judges standing basal bodies; results in their order. No failure ends the others.
  /// @return nothing if `stop` became true; a second call goes on from what is done
  /// @throws io::InputError if the judge cannot work at all
  [[nodiscard]] virtual std::optional<std::vector<JudgeResult>> judge(std::span<const meshes::Polycube> bodies,
                                                                      const std::atomic<bool>* stop) = 0;

  /// All that decides a result beside the body, as canonical text.
  [[nodiscard]] virtual std::string protocol() const = 0;

  /// Seconds that a judgement simulates.
  [[nodiscard]] virtual double duration_s() const = 0;

  /// The time over which the evaluator measures displacement by that over which the judge does: its displacements times this are
  /// scored, so that both scores are over the same time.
  [[nodiscard]] virtual double time_factor() const = 0;
};

}  // namespace menger::evolution
