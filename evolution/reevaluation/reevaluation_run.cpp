#include "evolution/reevaluation/reevaluation_run.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "evolution/archive/archive_log.h"
#include "evolution/genome/balance.h"
#include "evolution/reevaluation/reevaluation_chart.h"
#include "evolution/reevaluation/reevaluation_scene.h"
#include "evolution/reference/kept_walk.h"
#include "evolution/report/confirmation.h"
#include "evolution/study/study_file.h"
#include "fem/locomotion/locomotion_run.h"
#include "io/process/file_lock.h"
#include "io/process/run_folder.h"
#include "io/process/side_by_side.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

std::string rank_file(std::size_t rank) { return "rank_" + io::padded(rank, 4) + ".csv"; }

void note_missing(const std::string& file, const io::PictureOutcome& picture, std::vector<std::string>& notes) {
  if (!picture.written && !picture.missing.empty()) notes.push_back(file + ": not drawn: " + picture.missing);
}

void write_winner(const ReevaluationStudy& study, const fs::path& folder, bool pictures, const ReevaluatedDesign& winner,
                  std::vector<std::string>& notes) {
  meshes::write_design(folder / "design.toml", design_of(study, winner.design.body));
  if (pictures) {
    note_missing(
        "trajectories.png",
        io::write_chart(folder / "trajectories.png", trajectories_chart(study, winner), {.width_px = 2100, .height_px = 750}),
        notes);
  }
  try {
    const SceneOutcome scene = write_both_models(folder, winner, pictures);
    notes.insert(notes.end(), scene.notes.begin(), scene.notes.end());
    if (pictures) note_missing("strip.png", scene.picture, notes);
  } catch (const io::InputError& error) {  // missing or damaged frames do not affect the numbers
    notes.push_back(std::string("the winner is not shown in both models: ") + error.what());
  }
}

/// Writes tables, pictures and the winner's scene into a folder, each file whole or not at all. Removes files of earlier calls
/// first.
/// @param shown place of the winner among the designs @param notes gets a note for everything that could not be drawn or shown
void write_reevaluation(const ReevaluationStudy& study, const fs::path& folder, bool pictures,
                        const ReevaluationFindings& findings, std::size_t shown, std::vector<std::string>& notes) {
  io::RunFolder("menger-reevaluate", folder)
      .begin({"variants.csv", "reevaluation.png", "winner/trajectories.png", "trajectories/rank_*.csv"});
  reevaluation_table(study, findings).write(folder / "reevaluation.csv");
  refused_table(findings).write(folder / "refused.csv");
  if (!findings.variants.empty()) variant_table(study, findings).write(folder / "variants.csv");
  ranking_table(findings).write(folder / "ranking.csv");
  io::write_whole(folder / "summary.txt", findings_text(study, findings));
  for (const ReevaluatedDesign& design : findings.designs)
    trajectory_comparison(design).write(folder / "trajectories" / rank_file(design.design.rank));
  write_winner(study, folder / "winner", pictures, findings.designs.at(shown), notes);
  if (!pictures) return;
  const io::PictureStyle style{.width_px = 2000, .height_px = 900};
  note_missing("reevaluation.png", io::write_chart(folder / "reevaluation.png", scatter_chart(study, findings), style), notes);
}

class Reevaluator {
 public:
  /// @param designs of the archive, the best first @param confirmed the individual that finer elements confirmed, if any
  Reevaluator(const ReevaluationStudy& study, fs::path archive_file, std::vector<FitDesign> designs,
              std::optional<std::uint64_t> confirmed, const fs::path& folder, const ReevaluationOptions& options)
      : study_(study),
        archive_file_(std::move(archive_file)),
        designs_(std::move(designs)),
        confirmed_(confirmed),
        folder_(folder),
        options_(options) {}

  ReevaluationResult run() {
    const bool is_extended = can_be_extended(archive_file_);
    if (is_extended) {
      const io::FileLock lock(archive_file_);  // throws before the work begins if another process writes to the archive
    } else {
      result_.notes.push_back(archive_file_.string() + ": cannot be written to: the results are not added to it");
    }
    choose();
    io::require_writable_folder(folder_);
    if (!walk_surrogates() || !walk_elements()) {
      result_.status = io::RunStatus::stopped;
      return std::move(result_);
    }
    findings().rankings = rank_all(study_, findings().designs);
    if (std::ranges::none_of(findings().designs, [](const ReevaluatedDesign& design) {
          return design.surrogate.result.displacement_m && design.elements.displacement_m;
        })) {
      result_.status = io::RunStatus::not_converged;
      result_.notes.emplace_back("no design completed in both models");
    }
    if (is_extended) RunArchive::open_to_extend(archive_file_).add_reevaluations(archive_rows());
    write_reevaluation(study_, folder_, options_.pictures, findings(), shown_, result_.notes);
    return std::move(result_);
  }

  /// Makes walks for the first rank.
  void serve() {
    choose();
    const std::vector<LocomotionJob> jobs = element_jobs();
    serve_locomotions(jobs, run_options(jobs.size()));
  }

 private:
  ReevaluationFindings& findings() { return result_.findings; }

  void choose() {
    const std::vector<FitDesign>& designs = designs_;
    const std::string file = archive_file_.string();
    if (designs.empty()) throw io::InputError(file + ": no design has a fitness");
    if (study_.level > 1 && designs.front().phenotype.has_arrangements())
      throw io::InputError(file + ": nonfractal bodies can be re-evaluated at level 1 only");
    const SelectionOptions options{
        .top = study_.top, .sample = study_.sample, .seed = study_.sample_seed, .distinction = distinction_of(study_.search)};
    DesignSelection selection =
        choose_designs(designs, options, [&](const meshes::Polycube& body) { return obstacle_to_reference(study_, body); });
    if (selection.chosen.empty())
      throw io::InputError(file + ": no design can be evaluated; reason for the best one: " + selection.refused.front().reason);
    const auto top = static_cast<std::size_t>(std::ranges::count(selection.chosen, true, &ChosenDesign::is_top));
    note_less("best designs", top, study_.top);
    note_less("designs of the sample", selection.chosen.size() - top, study_.sample);
    for (ChosenDesign& design : selection.chosen)
      findings().designs.push_back({.design = std::move(design), .surrogate = {}, .elements = {}});
    for (ReevaluatedDesign& design : findings().designs)
      design.is_balanced = is_balanced(meshes::fractal(design.design.body, study_.level));
    findings().refused = std::move(selection.refused);
    findings().distinct = selection.distinct;
    show_confirmed();
  }

  void show_confirmed() {
    if (!confirmed_) return;
    const auto confirmed = std::ranges::find(findings().designs, *confirmed_,
                                             [](const ReevaluatedDesign& design) { return design.design.individual; });
    if (confirmed == findings().designs.end()) return;
    shown_ = static_cast<std::size_t>(confirmed - findings().designs.begin());
    if (shown_ > 0)
      result_.notes.push_back("winner/ has rank " + std::to_string(confirmed->design.rank) +
                              ": the champion of the search by its walks on finer elements");
  }

  void note_less(const char* what, std::size_t count, std::size_t wanted) {
    if (count >= wanted) return;
    result_.notes.push_back("only " + std::to_string(count) + " of the requested " + std::to_string(wanted) + " " + what +
                            " exist and can be evaluated");
  }

  /// Evaluates all designs on the surrogate. @return false if the user stopped it
  bool walk_surrogates() {
    std::vector<ReevaluatedDesign>& designs = findings().designs;
    const bool is_whole = io::side_by_side(designs.size(), options_.jobs, options_.stop, [&](std::size_t n) {
      designs[n].surrogate = surrogate_walk(study_, designs[n].design.body, n == shown_, options_.stop);
      return designs[n].surrogate.result.status != io::RunStatus::stopped;
    });
    return is_whole;
  }

  /// Returns the walks of all designs and variants on finite elements.
  std::vector<LocomotionJob> element_jobs() {
    std::vector<LocomotionJob> jobs;
    std::vector<ReevaluatedDesign>& designs = findings().designs;
    for (std::size_t n = 0; n < designs.size(); ++n) {
      const ChosenDesign& design = designs[n].design;
      jobs.push_back(locomotion_job(study_, study_.elements, design.body, "rank " + std::to_string(design.rank), n == shown_));
    }
    const std::size_t evaluated = study_.variants ? std::min(study_.variants->designs, designs.size()) : 0;
    for (std::size_t n = 0; n < evaluated; ++n) {
      for (const ReferenceVariant& variant : reference_variants(study_)) {
        const ChosenDesign& design = designs[n].design;
        const std::string name = "rank " + std::to_string(design.rank) + ", " + variant.name;
        jobs.push_back(locomotion_job(study_, variant.options, design.body, name, false));
        findings().variants.push_back({.design = n, .variant = variant, .run = {}});
      }
    }
    return jobs;
  }

  /// @param count of jobs
  [[nodiscard]] LocomotionRunOptions run_options(std::size_t count) const {
    return {.walker = options_.walker,
            .runs = folder_ / "runs",
            .time_limit_s = study_.time_limit_s,
            .jobs = options_.jobs,
            .stop = options_.stop,
            .ranks = options_.ranks,
            .rank_patience_s = options_.rank_patience_s,
            .note = options_.note,
            .progress = [this, count](std::size_t done, const std::string& name) {
              if (options_.progress) options_.progress(done, count, name);
            }};
  }

  /// Evaluates all designs and variants on finite elements. @return false if the user stopped it
  bool walk_elements() {
    const std::vector<LocomotionJob> jobs = element_jobs();
    const std::vector<ReevaluatedDesign>& designs = findings().designs;
    auto runs = run_locomotions(jobs, run_options(jobs.size()));
    if (!runs) return false;
    require_accepted(*runs);
    result_.repeated = static_cast<std::size_t>(std::ranges::count(*runs, true, &LocomotionRun::is_repeated));
    for (std::size_t n = 0; n < runs->size(); ++n) {
      measure_as_search(study_, (*runs)[n]);
      LocomotionRun& place = n < designs.size() ? findings().designs[n].elements : findings().variants[n - designs.size()].run;
      place = std::move((*runs)[n]);
    }
    return true;
  }

  [[nodiscard]] Reevaluation archive_row(const ReevaluatedDesign& design, const LocomotionOptions& options,
                                         const std::string& variant, const LocomotionRun& run) const {
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
    for (const ReevaluatedDesign& design : found.designs)
      rows.push_back(archive_row(design, study_.elements, "reference", design.elements));
    for (const VariantRun& run : found.variants)
      rows.push_back(archive_row(found.designs.at(run.design), run.variant.options, run.variant.name, run.run));
    return rows;
  }

  const ReevaluationStudy& study_;
  fs::path archive_file_;
  std::vector<FitDesign> designs_;
  std::optional<std::uint64_t> confirmed_;
  std::size_t shown_ = 0;  ///< place of the design whose walk is shown
  const fs::path& folder_;
  const ReevaluationOptions& options_;
  ReevaluationResult result_;
};

}  // namespace

fem::LocomotionResult walk_with_frames(const LocomotionJob& job, const fs::path& folder, const std::atomic<bool>& stop) {
  if (!job.study.output.frames) return kept_walk(job, folder, stop);
  fem::LocomotionStudy study = job.study;
  study.file = job.name;
  fem::prepare(study);
  const fs::path results = folder / "result";
  try {
    return fem::run_locomotion(study, results, {.stop = &stop});
  } catch (const io::InputError&) {
    // A checkpoint that is damaged, or was made by another version or instruction set, must not prevent the run.
    if (!fs::exists(results / "locomotion.checkpoint")) throw;
    return fem::run_locomotion(study, results, {.restart = true, .stop = &stop});
  }
}

namespace {

Reevaluator reevaluator_of(const ReevaluationStudy& study, RunArchive archive, const fs::path& folder,
                           const ReevaluationOptions& options) {
  fs::path file;
  std::vector<FitDesign> designs;
  std::optional<std::uint64_t> confirmed;
  {
    const RunArchive read = std::move(archive);
    file = read.file();
    designs = read.fit_designs();
    const Study search = archived_study(read);  // the search of the re-evaluation may have another friction
    const std::vector<Confirmation> walks = confirmations(search, read);
    if (const auto best = best_confirmed(walks); !best.empty()) confirmed = best.front().design.individual;
  }  // the archive is closed from here on: an open reader would keep later changes in the log beside the file
  return {study, std::move(file), std::move(designs), confirmed, folder, options};
}

}  // namespace

ReevaluationResult reevaluate(const ReevaluationStudy& study, RunArchive archive, const fs::path& folder,
                              const ReevaluationOptions& options) {
  return reevaluator_of(study, std::move(archive), folder, options).run();
}

void walk_for_first_rank(const ReevaluationStudy& study, RunArchive archive, const fs::path& folder,
                         const ReevaluationOptions& options) {
  reevaluator_of(study, std::move(archive), folder, options).serve();
}

}  // namespace menger::evolution
