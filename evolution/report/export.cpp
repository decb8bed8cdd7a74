#include "evolution/report/export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "evolution/report/confirmation.h"
#include "evolution/report/cost_table.h"
#include "evolution/report/evaluated_tasks.h"
#include "evolution/report/fall_table.h"
#include "evolution/report/individual_table.h"
#include "evolution/report/niche_table.h"
#include "evolution/report/refusal_table.h"
#include "evolution/report/scenario_table.h"
#include "evolution/report/step_check_table.h"
#include "evolution/report/study_view.h"
#include "evolution/study/scenarios.h"
#include "evolution/study/study_file.h"
#include "evolution/study/walk_evaluator.h"
#include "fem/locomotion/locomotion_run.h"
#include "fem/locomotion/locomotion_study_file.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "meshes/load_cases/observables.h"
#include "voxel/picture/preview.h"
#include "voxel/scene/scene_file.h"

namespace menger::evolution {

namespace {

namespace fs = std::filesystem;

using Displacement = std::optional<std::array<double, 3>>;

/// Returns the displacement of an archived evaluation with the part that does not count.
Displacement whole_displacement_m(const Evaluation& result) {
  Displacement whole_m = result.displacement_m;
  if (!whole_m || !result.left_out_m) return whole_m;
  for (std::size_t axis = 0; axis < 3; ++axis) whole_m->at(axis) += result.left_out_m->at(axis);
  return whole_m;
}

std::string displacement_text(const Displacement& displacement_m) {
  if (!displacement_m) return "none";
  return io::toml_value_text(std::span<const double>(*displacement_m)) + " m";
}

class Exporter {
 public:
  Exporter(const RunArchive& archive, const fs::path& folder, const ExportOptions& options)
      : archive_(archive), folder_(folder), options_(options), study_(archived_study(archive)), run_(view_of(archive, study_)) {}

  ExportResult write() {
    const auto last = archive_.last_generation();
    if (!last) throw io::InputError(archive_.file().string() + ": has no finished generation");
    const std::vector<Confirmation> confirmed = confirmations(study_, archive_);
    if (std::optional<Champion> champion = champion_of(run_, study_, *last, confirmed)) {
      result_.champion_line = champion_text(*champion);
      result_.champion = std::move(champion->design);
    }
    if (result_.champion) require_levels();
    // Everything is read from the archive before a file of an earlier export is touched: reading may find a fault in it.
    make_tables(confirmed);
    if (result_.champion && uses_elements(study_)) make_walk();
    io::require_writable_folder(folder_);
    if (options_.begins) options_.begins();
    for (const char* name :
         {"reference.csv", "corrections.csv", "scenarios.csv", "timings.csv", "schedule.csv", "check_dt.csv", "confirmed.csv",
          "falls.csv", "individuals.csv", "niches.csv", "periods.csv", "refused.csv", "champion_walk.toml", "lineage.csv"})
      io::remove_if_there(folder_ / name);  // this export may not write them, and those of an earlier one would mislead
    remove_other_champion();
    for (const auto& [name, table] : tables_) table.write(folder_ / name);
    if (result_.champion) write_champion();
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Individual& champion() const { return result_.champion->individual; }
  [[nodiscard]] bool arranged() const { return champion().phenotype.has_arrangements(); }

  void make_tables(const std::vector<Confirmation>& confirmed) {
    const auto add = [&](const char* name, io::CsvTable table) { tables_.emplace_back(name, std::move(table)); };
    add("generations.csv", generations_table(run_));
    add("costs.csv", cost_table(run_));
    if (was_corrected(archive_)) {
      add_note(
          "finite elements corrected the scores of this search: its fitness is the corrected one, and costs.csv leaves these "
          "finite elements out; their walks are among the re-evaluations of the archive");
    }
    if (study_.search.map_elites) add("niches.csv", niche_table(run_));
    if (study_.robust) add("scenarios.csv", scenario_table(run_, study_));
    if (tells_falls(study_)) add("falls.csv", fall_table(run_));
    if (uses_elements(study_)) {
      const Refusals refusals = refusals_of(run_);
      add("refused.csv", refusal_table(refusals));
      if (const std::string text = refusal_text(refusals); !text.empty()) add_note(text + " (refused.csv)");
    }
    if (options_.individuals) add("individuals.csv", individual_table(run_));
    if (options_.timings) {
      add("timings.csv", timing_table(run_));
      add("schedule.csv", schedule_table(run_, options_.workers));
      if (run_.plan.selection_time == SelectionTime::steady_state)
        add_note("no generation of this search waited for its end: schedule.csv estimates times of generations that do");
    }
    if (study_.search.step_checks) add("check_dt.csv", step_check_table(run_));
    if (!confirmed.empty()) add("confirmed.csv", confirmation_table(study_, confirmed));
    if (!result_.champion) return;
    add("lineage.csv", lineage_table(run_, champion().id));
    if (std::optional<io::CsvTable> periods = period_table()) add("periods.csv", std::move(*periods));
  }

  /// Returns the champion as the search simulated it.
  [[nodiscard]] Phenotype simulated() const { return as_simulated(study_.search, champion().phenotype); }

  void require_levels() const {
    if (uses_elements(study_)) return;
    for (const int level : options_.levels) {
      const std::string name = "level " + std::to_string(level);
      const BodyPlan plan = study_.search.offspring.decoder.plan;
      if (level > largest_level(plan)) {
        throw io::InputError(name + ": the highest level of a " + std::string(to_string(plan)) + " body is " +
                             std::to_string(largest_level(plan)));
      }
      // Bodies with arrangements fit into any memory up to their largest level.
      if (!arranged() && voxel::estimated_memory_bytes(champion().phenotype.body, level, voxel::voxels_per_cell(study_.physics)) >
                             voxel::machine_memory_bytes()) {
        throw io::InputError(name + ": the simulation would need more memory than this machine has");
      }
    }
  }

  /// Removes what an earlier export left of another champion, at levels that this one may not write, too.
  void remove_other_champion() const {
    const fs::path file = folder_ / "champion.toml";
    if (!io::is_file(file) || (result_.champion && io::read_whole(file) == meshes::design_text(design(1)))) return;
    io::remove_if_there(folder_ / "champion.png");
    for (int level = 1; level <= largest_exported_level; ++level) {
      io::remove_if_there(folder_ / ("champion_level_" + std::to_string(level) + ".toml"));
      io::remove_files(place_of(level),
                       {"scene.toml", "result.toml", "trajectory.csv", "check_dt.csv", "robot.png", "trajectory.png",
                        "frames.pvd", "frames/*.vtu", "locomotion.toml", "locomotion.checkpoint", "manifest.json"});
    }
    io::remove_if_there(file);  // last: it tells that there is something to remove
  }

  void write_champion() {
    write_design(folder_ / "champion.toml", design(1));
    if (uses_elements(study_)) return walk_champion();
    if (std::vector<LevelResult> there = finished_levels(); there.size() == options_.levels.size()) {
      result_.levels = std::move(there);
      add_note("the simulations in " + folder_.string() + " are already those of this champion");
      return;
    }
    io::remove_if_there(folder_ / "champion.png");  // of another champion, if no picture is drawn now
    for (const int level : options_.levels) {
      if (arranged()) write_design(folder_ / ("champion_level_" + std::to_string(level) + ".toml"), design(level));
      simulate(level);
      if (result_.status == io::RunStatus::stopped) return;
    }
    if (options_.pictures) draw();
  }

  /// Returns the champion's displacement in every period, by level, if the archive has it.
  [[nodiscard]] std::optional<io::CsvTable> period_table() const {
    io::CsvTable table({"level", "period", "dx_m", "dy_m", "dz_m", "body_lengths"});
    bool has_rows = false;
    for (const int level : study_.search.levels()) {
      const std::optional<Evaluation> result = archived(level);
      if (!result) continue;
      std::uint64_t period = 0;
      for (const std::array<double, 3>& moved_m : result->period_displacements_m) {
        const double lengths = body_lengths(moved_m, level, study_.search.cell_edge_m);
        table.add_row(level, ++period, moved_m[0], moved_m[1], moved_m[2], lengths);
        has_rows = true;
      }
    }
    return has_rows ? std::optional(std::move(table)) : std::nullopt;
  }

  /// Returns the scenario that decided the champion's score, if one has.
  [[nodiscard]] std::optional<std::size_t> champion_scenario() const {
    const int level = study_.search.first_level();
    return shown_scenario(study_.search, level, archived_results(run_, simulated()));
  }

  /// Returns the study of that scenario, or of the first one; without scenarios, the study of the search.
  [[nodiscard]] Study study_of_champion() const {
    if (!study_.robust) return study_;
    return in_scenario(study_, scenarios_of(study_).at(champion_scenario().value_or(0)));
  }

  void add_note_of_scenario() {
    if (!study_.robust) return;
    const std::optional<std::size_t> decided = champion_scenario();
    add_note((decided ? "the champion walks in the scenario that decided its score: "
                      : "no scenario has decided the champion's score; it walks in the first one: ") +
             scenario_text(scenarios_of(study_).at(decided.value_or(0))) + "; scenarios.csv has the others");
  }

  /// Makes the walk of the champion on the finite elements of the search, and checks it.
  void make_walk() {
    fem::LocomotionStudy& walk = walk_;
    static_cast<fem::WalkInput&>(walk) = walk_of(study_of_champion(), simulated().body, study_.search.first_level());
    walk.device = io::Device::cpu;  // a walk more does not ask for a graphics processor
    walk.design = design(1);
    walk.file = folder_ / "champion_walk.toml";
    walk.output.frames = options_.frames;
    walk.output.pictures = options_.pictures;
    const double records = std::round(options_.record_interval_s / walk.record_interval_s);
    walk.output.records_per_frame = static_cast<std::size_t>(std::max(1.0, records));
    walk_text_ = io::described_text(walk);
    fem::prepare(walk);
  }

  /// Writes that walk, and its study for menger locomote.
  void walk_champion() {
    const fem::LocomotionStudy& walk = walk_;
    const int level = study_.search.first_level();
    io::remove_if_there(folder_ / "champion.png");  // of an export of another search
    io::write_whole(walk.file, walk_text_);
    fem::LocomotionRunOptions run{.restart = true, .stop = options_.stop};
    if (options_.progress)
      run.progress = [&](double time_s) { options_.progress(level, {.time_s = time_s, .duration_s = walk.duration_s}); };
    const fem::LocomotionResult walked = fem::run_locomotion(walk, place_of(level), run);
    LevelResult done{level, aggregate_cell_count(champion().phenotype, level), {}};
    done.scene.status = walked.status;
    done.scene.reason = walked.reason;
    if (const auto travel = fem::travel_of(walked)) done.scene.displacement_m = travel->displacement_m;
    if (walked.status != io::RunStatus::completed) result_.status = walked.status;
    for (const std::string& note : walked.notes) add_note(note);
    compare_with_archive(done);
    result_.levels.push_back(std::move(done));
    add_note_of_scenario();
    add_note("the search was on finite elements: only level " + std::to_string(level) +
             " is written; menger reevaluate lets its robots walk on "
             "finer elements, and menger locomote " +
             walk.file.string() + " this one as you change its study");
  }

  /// Returns the champion as a design: a fractal by its basal body, whatever the level; any other body by all its cells.
  [[nodiscard]] meshes::Design design(int level) const {
    return {"champion " + std::to_string(champion().id), arranged() ? aggregate(simulated(), level) : simulated().body,
            study_.search.cell_edge_m};
  }

  [[nodiscard]] voxel::Scene scene(int level) const {
    voxel::Scene scene;
    scene.design = design(level);
    scene.level = arranged() ? 1 : level;
    scene.physics = study_of_champion().physics;
    scene.duration_s = study_.duration_s;
    scene.record_interval_s = std::min(options_.record_interval_s, study_.duration_s);
    scene.output.frames = options_.frames;
    scene.output.pictures = options_.pictures;
    return scene;
  }

  [[nodiscard]] fs::path place_of(int level) const { return folder_ / ("level_" + std::to_string(level)); }

  /// Returns the results of the first levels whose folders have a completed run of exactly this scene, with all files asked for.
  [[nodiscard]] std::vector<LevelResult> finished_levels() const {
    std::vector<LevelResult> there;
    if (options_.pictures && !fs::exists(folder_ / "champion.png")) return there;
    for (const int level : options_.levels) {
      const fs::path place = place_of(level);
      const bool files_are_there =
          fs::exists(place / "scene.toml") && fs::exists(place / "result.toml") && fs::exists(place / "trajectory.csv") &&
          (!options_.frames || fs::exists(place / "frames.pvd")) && (!options_.pictures || fs::exists(place / "robot.png"));
      if (!files_are_there || io::read_whole(place / "scene.toml") != scene_text(scene(level))) return there;
      const io::TomlTable table = io::read_toml(place / "result.toml");
      if (table.text("status") != io::to_string(io::RunStatus::completed)) return there;
      const std::vector<double> moved_m = table.numbers("displacement_m");
      if (moved_m.size() != 3) return there;
      LevelResult level_result{level, aggregate_cell_count(champion().phenotype, level), {}};
      level_result.scene.status = io::RunStatus::completed;
      level_result.scene.displacement_m = {moved_m[0], moved_m[1], moved_m[2]};
      if (differs_from_archive(level_result)) return there;
      there.push_back(std::move(level_result));
    }
    return there;
  }

  void simulate(int level) {
    const voxel::Scene scene = this->scene(level);
    const fs::path place = place_of(level);
    io::write_whole(place / "scene.toml", scene_text(scene));
    voxel::RunOptions run;
    run.stop = options_.stop;
    if (options_.progress)
      run.progress = [this, level](const voxel::RunProgress& progress) { options_.progress(level, progress); };
    LevelResult done{level, aggregate_cell_count(champion().phenotype, level), voxel::run_scene(scene, place, run)};
    if (done.scene.status != io::RunStatus::completed && result_.status == io::RunStatus::completed)
      result_.status = done.scene.status;
    for (const std::string& note : done.scene.notes) add_note(note);
    add_note_of_scenario();
    compare_with_archive(done);
    result_.levels.push_back(std::move(done));
  }

  [[nodiscard]] std::optional<Evaluation> archived(int level) const {
    const KnownResults results = archived_results(run_, simulated());
    const std::optional<std::size_t> scenario = shown_scenario(study_.search, level, results);
    if (!scenario) return std::nullopt;
    const auto found = results.find({level, *scenario});
    return found == results.end() ? std::nullopt : std::optional(found->second);
  }

  [[nodiscard]] bool differs_from_archive(const LevelResult& done) const {
    const std::optional<Evaluation> result = archived(done.level);
    if (!result) return false;
    const Displacement whole_m = whole_displacement_m(*result);
    if (!result->left_out_m || !whole_m || !done.scene.displacement_m) return whole_m != done.scene.displacement_m;
    // The archive has two parts of the displacement. Their sum is rounded differently.
    constexpr double rounding_m = 1e-12;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::abs(whole_m->at(axis) - done.scene.displacement_m->at(axis)) > rounding_m) return true;
    return false;
  }

  void compare_with_archive(const LevelResult& done) {
    if (done.scene.status == io::RunStatus::stopped || !differs_from_archive(done)) return;
    add_note("level " + std::to_string(done.level) +
             ": the displacement differs from that in the archive: " + displacement_text(done.scene.displacement_m) + " here, " +
             displacement_text(whole_displacement_m(*archived(done.level))) + " there");
  }

  void draw() {
    std::vector<voxel::Frame> frames;
    std::vector<std::string> captions;
    for (const LevelResult& level : result_.levels) {
      if (level.scene.recorded_frames.empty()) continue;
      frames.push_back(level.scene.recorded_frames.back());
      captions.push_back("level " + std::to_string(level.level) + ": " + std::to_string(level.cells) + " cells");
    }
    const io::PictureOutcome picture = voxel::render_row(folder_ / "champion.png", frames, captions);
    if (!picture.written) add_note("no pictures: " + picture.missing);
  }

  /// Adds a note once: the same note would come for every picture.
  void add_note(const std::string& note) {
    if (std::ranges::find(result_.notes, note) == result_.notes.end()) result_.notes.push_back(note);
  }

  const RunArchive& archive_;
  const fs::path& folder_;
  const ExportOptions& options_;
  Study study_;
  RunView run_;
  ExportResult result_;
  std::vector<std::pair<std::string, io::CsvTable>> tables_;  ///< by the name of their file
  fem::LocomotionStudy walk_;                                 ///< of the champion, of a search on finite elements
  std::string walk_text_;
};

}  // namespace

namespace {

/// Refuses options that cannot be met, before anything is written.
void check_options(const Study& study, const ExportOptions& options) {
  const double interval_s = options.record_interval_s;
  if (!(interval_s > 0.0 && study.duration_s / interval_s <= voxel::largest_record_count)) {
    throw io::InputError("--record-interval " + io::number_text(interval_s) +
                         ": must be > 0 and make at most a million records of " + io::number_text(study.duration_s) + " s");
  }
}

}  // namespace

ExportResult export_run(const RunArchive& archive, const fs::path& folder, const ExportOptions& options) {
  check_options(archived_study(archive), options);
  return Exporter(archive, folder, options).write();
}

std::string export_text(const Study& study, const ExportResult& result) {
  std::string text;
  text +=
      io::formatted("%5s %8s %16s %14s %12s  %s\n", "level", "cells", "displacement/m", "body lengths", "per minute", "status");
  for (const LevelResult& level : result.levels) {
    const std::string status(io::to_string(level.scene.status));
    if (!level.scene.displacement_m) {
      text += io::formatted("%5d %8zu %16s %14s %12s  %s\n", level.level, level.cells, "-", "-", "-", status.c_str());
      continue;
    }
    const double lengths = body_lengths(*level.scene.displacement_m, level.level, study.search.cell_edge_m);
    const double distance_m = meshes::horizontal_displacement(*level.scene.displacement_m);
    text += io::formatted("%5d %8zu %16.6f %14.4f %12.2f  %s\n", level.level, level.cells, distance_m, lengths,
                          lengths * 60.0 / study.duration_s, status.c_str());
  }
  return text;
}

}  // namespace menger::evolution
