#include "evolution/reference/finite_element_evaluator.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "evolution/reference/reevaluation_locomotion.h"
#include "evolution/reference/reevaluation_runner.h"
#include "evolution/reference/reevaluation_surrogate.h"
#include "io/text/content_hash.h"

namespace menger::evolution {

std::unique_ptr<FiniteElementEvaluator> reference_evaluator_of(Study& study, const std::filesystem::path& file,
                                                               const FiniteElementEvaluatorOptions& options, int threads) {
  if (!study.search.reference) return nullptr;
  ReevaluationStudy reevaluation = read_reevaluation_study({.archive = file, .file = study.reference_file}, study);
  FiniteElementEvaluatorOptions chosen = options;
  chosen.jobs = std::max(1, threads / reevaluation.elements.threads);
  auto reference = std::make_unique<FiniteElementEvaluator>(std::move(reevaluation), std::move(chosen));
  study.search.reference->protocol = io::content_hash(reference->protocol());
  return reference;
}

FiniteElementEvaluator::FiniteElementEvaluator(ReevaluationStudy study, FiniteElementEvaluatorOptions options)
    : study_(std::move(study)), options_(std::move(options)) {}

Distinction FiniteElementEvaluator::distinction() const { return distinction_of(study_.search); }

std::string FiniteElementEvaluator::obstacle(const meshes::Polycube& body) const {
  const auto [place, is_new] = obstacles_.try_emplace(body.digits());
  if (is_new) place->second = obstacle_to_reference(study_, body);
  return place->second;
}

std::optional<std::vector<ReferenceResult>> FiniteElementEvaluator::evaluate(std::span<const meshes::Polycube> bodies,
                                                                             const std::atomic<bool>* stop) {
  std::vector<LocomotionJob> jobs;
  for (const meshes::Polycube& body : bodies) {
    const std::string name = std::to_string(jobs.size() + 1) + " of " + std::to_string(bodies.size());
    jobs.push_back(locomotion_job(study_, study_.elements, body, name, false));
  }
  const LocomotionRunOptions run_options{.runs = options_.runs,
                                         .time_limit_s = study_.time_limit_s,
                                         .jobs = options_.jobs,
                                         .stop = stop,
                                         .progress = [&](std::size_t done, const std::string& name) {
                                           if (options_.progress) options_.progress(done, jobs.size(), name);
                                         }};
  auto runs = run_locomotions(jobs, run_options);
  if (!runs) return std::nullopt;
  require_accepted(*runs);
  std::vector<ReferenceResult> results;
  for (LocomotionRun& run : *runs) {
    measure_as_search(study_, run);
    results.push_back(
        {.result = evaluation_of(run), .has_result = run.status.has_value(), .element_steps = run.steps * run.elements});
  }
  return results;
}

std::string FiniteElementEvaluator::protocol() const { return protocol_text(study_, study_.elements); }

double FiniteElementEvaluator::time_factor() const {
  if (measured_periods(study_.search)) return 1.0;
  return (study_.search.duration_s - study_.search.measure_from_s) / study_.measured_s();
}

}  // namespace menger::evolution
