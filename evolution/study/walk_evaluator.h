#pragma once

#include <memory>
#include <optional>
#include <string>

#include "evolution/evaluation/evaluator.h"
#include "evolution/study/study.h"
#include "fem/walk/walk.h"
#include "io/text/input_error.h"

namespace menger::evolution {

/// Returns the drive of a study of silicone, for finite elements.
fem::SurrogateDrive pressure_drive(const Study& study);

/// Returns the time between the records of a walk of a study: a thirtieth of the period of the drive, but no more than 0.02 s.
/// Positions between records are interpolated; the body is checked for passing through itself at every record.
double record_interval_s(const Study& study);

/// Returns the module whose fractal of a level an aggregate is. @throws io::InputError if it is none
meshes::Polycube module_of_aggregate(const meshes::Polycube& aggregate, int level);

/// Returns the walk of a body of a study that finite elements evaluate. @param body one standing module @param level of the
/// fractal of this module that walks; 1: the module
fem::WalkInput walk_of(const Study& study, const meshes::Polycube& body, int level);

/// Sets the displacements of a completed walk as a study measures them. A walk without as many whole periods as are measured
/// becomes `diverged`, with a reason; one whose body has fallen (Study::largest_lean_deg) `fell`: all of its displacement is left
/// out.
void measure(const Study& study, const fem::WalkResult& walk, Evaluation& result);

/// Returns a result of a walk of a study that is still to be made.
Evaluation blank_result(const Study& study);

/// Sets a result from a walk, as a study measures it.
void take_result(const Study& study, const fem::WalkResult& walk, Evaluation& result);

/// Sets the result of a body that cannot walk.
void set_refused(const io::InputError& error, Evaluation& result);

/// Returns why finite elements refused the body of a result; none if they did not.
std::optional<std::string> refusal_of(const Evaluation& result);

class PausedWalks;

/// Evaluates single modules, or aggregates that are the fractals of a module, by walks on finite elements, in the process (see
/// fem::walk). An aggregate has a chamber in every module.
///
/// A body that finite elements refuse has the status `diverged` and the reason, as a body outside of a range of validity has: it
/// has no displacement, and the search goes on without it. The result has the displacement in every whole period of the drive.
class WalkEvaluator final : public DesignEvaluator {
 public:
  /// @param study of finite elements, with a stated silicone
  /// @param paused walks that go on instead of beginning anew; may be null
  explicit WalkEvaluator(Study study, std::shared_ptr<PausedWalks> paused = nullptr);

  /// A body that is not the fractal of a module at this level is one that finite elements refuse.
  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override;
  [[nodiscard]] std::string physics() const override;

  /// Returns about how many elements the body has: those of its walls. All bodies make about as many steps.
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override;

 private:
  Study study_;
  std::shared_ptr<PausedWalks> paused_;
};

}  // namespace menger::evolution
