#include "evolution/reevaluation/reevaluation_run.h"

#include <algorithm>
#include <utility>

#include "evolution/genome/balance.h"
#include "evolution/reevaluation/reevaluation_output.h"
#include "io/process/child_program.h"
#include "io/process/file_lock.h"
#include "io/process/side_by_side.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

class Reevaluator {
 public:
  /// @param designs of the archive, the best first
  Reevaluator(const ReevaluationStudy& study, fs::path archive_file, std::vector<FitDesign> designs, const fs::path& folder,
              const ReevaluationOptions& options)
      : study_(study), archive_file_(std::move(archive_file)), designs_(std::move(designs)), folder_(folder), options_(options) {}

  ReevaluationResult run() {
    const fs::path program = io::program_in(options_.programs, "menger-locomote");
    { const io::FileLock lock(archive_file_); }  // whoever else writes is found before the work begins
    choose();
    io::require_writable_folder(folder_);
    if (!walk_surrogates() || !walk_elements(program)) {
      result_.status = io::RunStatus::stopped;
      return std::move(result_);
    }
    findings().rankings = rank_all(study_, findings().designs);
    if (std::ranges::none_of(findings().designs, [](const JudgedDesign& design) {
          return design.surrogate.result.displacement_m && design.elements.displacement_m;
        })) {
      result_.status = io::RunStatus::not_converged;
      result_.notes.emplace_back("no design completed in both models");
    }
    RunArchive::open_to_extend(archive_file_).add_reevaluations(archive_rows());
    write_reevaluation(study_, folder_, options_.pictures, findings(), result_.notes);
    return std::move(result_);
  }

 private:
  ReevaluationFindings& findings() { return result_.findings; }

  void choose() {
    const std::vector<FitDesign>& designs = designs_;
    const std::string file = archive_file_.string();
    if (designs.empty()) throw io::InputError(file + ": no design has a fitness");
    if (study_.level > 1 && designs.front().phenotype.has_arrangements())
      throw io::InputError(file + ": bodies with arrangements are no fractals: only level 1 can be judged");
    const SelectionOptions options{
        .top = study_.top, .sample = study_.sample, .seed = study_.sample_seed, .distinction = distinction_of(study_.search)};
    Selection selection =
        choose_designs(designs, options, [&](const meshes::Polycube& body) { return obstacle_to_judging(study_, body); });
    if (selection.chosen.empty())
      throw io::InputError(file + ": no design can be judged, the best because: " + selection.refused.front().reason);
    const auto top = static_cast<std::size_t>(std::ranges::count(selection.chosen, true, &ChosenDesign::is_top));
    note_less("best designs", top, study_.top);
    note_less("designs of the sample", selection.chosen.size() - top, study_.sample);
    for (ChosenDesign& design : selection.chosen)
      findings().designs.push_back({.design = std::move(design), .surrogate = {}, .elements = {}});
    for (JudgedDesign& design : findings().designs)
      design.is_balanced = is_balanced(meshes::fractal(design.design.body, study_.level));
    findings().refused = std::move(selection.refused);
    findings().distinct = selection.distinct;
  }

  void note_less(const char* what, std::size_t count, std::size_t wanted) {
    if (count >= wanted) return;
    result_.notes.push_back("only " + std::to_string(count) + " of " + std::to_string(wanted) + " " + what +
                            " can be judged: there are no more");
  }

  /// @return false if the user stopped it
  bool walk_surrogates() {
    std::vector<JudgedDesign>& designs = findings().designs;
    const bool is_whole = io::side_by_side(designs.size(), options_.jobs, options_.stop, [&](std::size_t n) {
      designs[n].surrogate = surrogate_walk(study_, designs[n].design.body, n == 0, options_.stop);
      return designs[n].surrogate.result.status != io::RunStatus::stopped;
    });
    return is_whole;
  }

  /// @return false if the user stopped it
  bool walk_elements(const fs::path& program) {
    std::vector<LocomotionJob> jobs;
    std::vector<JudgedDesign>& designs = findings().designs;
    for (std::size_t n = 0; n < designs.size(); ++n) {
      const ChosenDesign& design = designs[n].design;
      jobs.push_back(locomotion_job(study_, study_.elements, design.body, "rank " + std::to_string(design.rank), n == 0));
    }
    const std::size_t judged = study_.judge ? std::min(study_.judge->designs, designs.size()) : 0;
    for (std::size_t n = 0; n < judged; ++n) {
      for (const JudgeVariant& variant : judge_variants(study_)) {
        const ChosenDesign& design = designs[n].design;
        const std::string name = "rank " + std::to_string(design.rank) + ", " + variant.name;
        jobs.push_back(locomotion_job(study_, variant.options, design.body, name, false));
        findings().variants.push_back({.design = n, .variant = variant, .run = {}});
      }
    }
    const LocomotionRunOptions run_options{.program = program,
                                           .runs = folder_ / "runs",
                                           .time_limit_s = study_.time_limit_s,
                                           .jobs = options_.jobs,
                                           .stop = options_.stop,
                                           .progress = [&](std::size_t done, const std::string& name) {
                                             if (options_.progress) options_.progress(done, jobs.size(), name);
                                           }};
    auto runs = run_locomotions(jobs, run_options);
    if (!runs) return false;
    require_accepted(*runs);
    result_.repeated = static_cast<std::size_t>(std::ranges::count(*runs, true, &LocomotionRun::is_repeated));
    for (std::size_t n = 0; n < runs->size(); ++n) {
      leave_out((*runs)[n], study_.measure_from_s);
      LocomotionRun& place = n < designs.size() ? designs[n].elements : findings().variants[n - designs.size()].run;
      place = std::move((*runs)[n]);
    }
    return true;
  }

  [[nodiscard]] Reevaluation archive_row(const JudgedDesign& design, const LocomotionOptions& options, const std::string& variant,
                                         const LocomotionRun& run) const {
    const Phenotype simulated = as_simulated(study_.search.search, design.design.phenotype);
    return {.design_hash = design_hash(simulated, study_.level),
            .level = study_.level,
            .protocol = protocol_text(study_, options),
            .variant = variant,
            .duration_s = study_.duration_s,
            .result = evaluation_of(run),
            .has_result = run.status.has_value()};
  }

  [[nodiscard]] std::vector<Reevaluation> archive_rows() const {
    std::vector<Reevaluation> rows;
    const ReevaluationFindings& found = result_.findings;
    for (const JudgedDesign& design : found.designs)
      rows.push_back(archive_row(design, study_.elements, "judge", design.elements));
    for (const VariantRun& run : found.variants)
      rows.push_back(archive_row(found.designs.at(run.design), run.variant.options, run.variant.name, run.run));
    return rows;
  }

  const ReevaluationStudy& study_;
  fs::path archive_file_;
  std::vector<FitDesign> designs_;
  const fs::path& folder_;
  const ReevaluationOptions& options_;
  ReevaluationResult result_;
};

}  // namespace

ReevaluationResult reevaluate(const ReevaluationStudy& study, RunArchive archive, const fs::path& folder,
                              const ReevaluationOptions& options) {
  fs::path file;
  std::vector<FitDesign> designs;
  {
    const RunArchive read = std::move(archive);
    file = read.file();
    designs = read.fit_designs();
  }  // closed from here on: a reader would keep the changes in the log beside the file
  return Reevaluator(study, std::move(file), std::move(designs), folder, options).run();
}

}  // namespace menger::evolution
