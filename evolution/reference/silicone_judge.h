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

#include "evolution/evaluation/design_judge.h"
#include "evolution/reference/reevaluation_study.h"

namespace menger::evolution {

/// How finite elements judge in a search, never what comes out of it, but for the time limit of a run.
struct SiliconeJudgeOptions {
  std::filesystem::path programs;  ///< folder of menger-locomote
  std::filesystem::path runs;      ///< folder with a folder per run, by which an interrupted round goes on
  int jobs = 1;                    ///< runs at the same time

  /// @param done, total robots of the round @param name of one that is under way
  std::function<void(std::size_t done, std::size_t total, const std::string& name)> progress{};
};

/// Judges robots of silicone by the locomotion of finite elements, as menger reevaluate does, in another process.
///
/// A run that diverges, fails or exceeds the study's time limit has no displacement. The time limit is the one thing by which the
/// speed of the machine could change a search: it should be far beyond any run.
class SiliconeJudge final : public DesignJudge {
 public:
  /// @throws io::InputError if the program is missing
  SiliconeJudge(ReevaluationStudy study, SiliconeJudgeOptions options);

  [[nodiscard]] Distinction distinction() const override;
  [[nodiscard]] std::string obstacle(const meshes::Polycube& body) const override;

  /// @throws io::InputError if the program refuses every body, or cannot be started
  [[nodiscard]] std::optional<std::vector<JudgeResult>> judge(std::span<const meshes::Polycube> bodies,
                                                              const std::atomic<bool>* stop) override;
  [[nodiscard]] std::string protocol() const override;
  [[nodiscard]] double duration_s() const override { return study_.duration_s; }
  [[nodiscard]] double time_factor() const override;

  [[nodiscard]] const ReevaluationStudy& study() const { return study_; }

 private:
  ReevaluationStudy study_;
  SiliconeJudgeOptions options_;
  std::filesystem::path program_;
  mutable std::map<std::string, std::string> obstacles_;  ///< by the digits of the body: a survivor is asked about every round
};

/// The judge that a study names, if it names one; notes its protocol in the study. @param file of the study, for messages
/// @param threads of the search, which its runs share
/// @throws io::InputError as read_reevaluation_study, or if the program is missing
std::unique_ptr<SiliconeJudge> judge_of(Study& study, const std::filesystem::path& file, const SiliconeJudgeOptions& options,
                                        int threads);

}  // namespace menger::evolution
