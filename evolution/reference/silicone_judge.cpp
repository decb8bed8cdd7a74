#include "evolution/reference/silicone_judge.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "evolution/reference/reevaluation_locomotion.h"
#include "evolution/reference/reevaluation_runner.h"
#include "evolution/reference/reevaluation_surrogate.h"
#include "io/process/child_program.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"

namespace menger::evolution {

std::unique_ptr<SiliconeJudge> judge_of(Study& study, const std::filesystem::path& file, const SiliconeJudgeOptions& options,
                                        int threads) {
  if (!study.search.judging) return nullptr;
  ReevaluationStudy judging = read_reevaluation_study({.archive = file, .file = study.judge_file}, study);
  SiliconeJudgeOptions chosen = options;
  chosen.jobs = std::max(1, threads / judging.elements.threads);
  auto judge = std::make_unique<SiliconeJudge>(std::move(judging), std::move(chosen));
  study.search.judging->protocol = io::content_hash(judge->protocol());
  return judge;
}

SiliconeJudge::SiliconeJudge(ReevaluationStudy study, SiliconeJudgeOptions options)
    : study_(std::move(study)), options_(std::move(options)), program_(io::program_in(options_.programs, "menger-locomote")) {}

Distinction SiliconeJudge::distinction() const { return distinction_of(study_.search); }

std::string SiliconeJudge::obstacle(const meshes::Polycube& body) const {
  const auto [place, is_new] = obstacles_.try_emplace(body.digits());
  if (is_new) place->second = obstacle_to_judging(study_, body);
  return place->second;
}

std::optional<std::vector<JudgeResult>> SiliconeJudge::judge(std::span<const meshes::Polycube> bodies,
                                                             const std::atomic<bool>* stop) {
  std::vector<LocomotionJob> jobs;
  for (const meshes::Polycube& body : bodies) {
    const std::string name = std::to_string(jobs.size() + 1) + " of " + std::to_string(bodies.size());
    jobs.push_back(locomotion_job(study_, study_.elements, body, name, false));
  }
  const LocomotionRunOptions run_options{.program = program_,
                                         .runs = options_.runs,
                                         .time_limit_s = study_.time_limit_s,
                                         .jobs = options_.jobs,
                                         .stop = stop,
                                         .progress = [&](std::size_t done, const std::string& name) {
                                           if (options_.progress) options_.progress(done, jobs.size(), name);
                                         }};
  auto runs = run_locomotions(jobs, run_options);
  if (!runs) return std::nullopt;
  require_accepted(*runs);
  std::vector<JudgeResult> results;
  for (LocomotionRun& run : *runs) {
    leave_out(run, study_.measure_from_s);
    results.push_back(
        {.result = evaluation_of(run), .has_result = run.status.has_value(), .element_steps = run.steps * run.elements});
  }
  return results;
}

std::string SiliconeJudge::protocol() const { return protocol_text(study_, study_.elements); }

double SiliconeJudge::time_factor() const {
  return (study_.search.duration_s - study_.search.measure_from_s) / study_.measured_s();
}

}  // namespace menger::evolution
