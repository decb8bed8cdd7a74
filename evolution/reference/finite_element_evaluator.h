#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/evaluation/reference_evaluator.h"
#include "evolution/reference/reevaluation_study.h"

namespace menger::evolution {

/// Options that decide how the finite elements of a search run. They do not change the results.
struct FiniteElementEvaluatorOptions {
  /// Folder with a folder per run, from which an interrupted round is resumed. Empty: nothing is kept.
  std::filesystem::path runs{};
  int jobs = 1;  ///< number of runs at the same time

  /// Called during a round. @param done, total numbers of robots @param name a robot that is being evaluated
  std::function<void(std::size_t done, std::size_t total, const std::string& name)> progress{};
};

/// Evaluates silicone robots by their locomotion on finite elements, as menger reevaluate does: in this process, see fem::walk.
///
/// A run that diverges, fails or exceeds the study's time limit has no displacement. Through this time limit alone the speed of
/// the machine could change a search, so it should be much longer than any run.
class FiniteElementEvaluator final : public ReferenceEvaluator {
 public:
  FiniteElementEvaluator(ReevaluationStudy study, FiniteElementEvaluatorOptions options);

  [[nodiscard]] Distinction distinction() const override;
  [[nodiscard]] std::string obstacle(const meshes::Polycube& body) const override;

  /// @throws io::InputError if finite elements refuse every body, or the folder cannot be written
  [[nodiscard]] std::optional<std::vector<ReferenceResult>> evaluate(std::span<const meshes::Polycube> bodies,
                                                                     const std::atomic<bool>* stop) override;
  [[nodiscard]] std::string protocol() const override;
  [[nodiscard]] double duration_s() const override { return study_.duration_s; }
  [[nodiscard]] double time_factor() const override;

  [[nodiscard]] const ReevaluationStudy& study() const { return study_; }

 private:
  ReevaluationStudy study_;
  FiniteElementEvaluatorOptions options_;
  mutable std::map<std::string, std::string> obstacles_;  ///< by the digits of the body; every round asks about the survivors
};

/// Makes the reference evaluator that a study names, and sets search.reference->protocol of the study. Returns null if the study
/// names none.
/// @param file that of the study, for messages
/// @param threads number of threads of the search; the runs of finite elements share them
/// @throws io::InputError as read_reevaluation_study
std::unique_ptr<FiniteElementEvaluator> reference_evaluator_of(Study& study, const std::filesystem::path& file,
                                                               const FiniteElementEvaluatorOptions& options, int threads);

}  // namespace menger::evolution
